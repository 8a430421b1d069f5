// What judges links: by what each goes, and what certainty about visibility is worth.
#include "Radiosity/Core/RefinementOracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "Common/Core/Error.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

/// A floor under a lamp of the same size, all within a unit cube, with a screen between them at
/// half height over all x below `screen`.
struct LampOverFloor : testing::ModelledScene {
  explicit LampOverFloor(float screen) {
    testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
    testing::AddQuad(&scene.mesh, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.5f), Spectrum(10.f),
                     1, 1);
    if (screen > 0) {
      testing::AddTriangle(&scene.mesh, {screen, -9, 0.5f}, {screen, 10, 0.5f}, {-99, 0, 0.5f},
                           Spectrum(0.5f));
    }
    this->Model();
  }

  /// The whole of the side at height `z` that faces the middle.
  const Element& ElementAt(float z) const {
    for (const int32_t root : hierarchy->SurfaceSides()) {
      const Element& element = (*hierarchy)[root];
      if (element.frame.center.z == z && (element.axis.z > 0) == (z < 0.5f)) return element;
    }
    throw Error("The scene has no such side.");
  }
  LinkEvidence Evidence(float visibility) const {
    const Element &lamp = ElementAt(1), &floor = ElementAt(0);
    LinkEvidence evidence{lamp, floor, BoundPair(*hierarchy, lamp, floor), 10};
    evidence.visibility = visibility;
    return evidence;
  }
  std::unique_ptr<RefinementOracle> Oracle(OracleKind kind) const {
    return MakeRefinementOracle(kind, *hierarchy, *rayScene);
  }
};

TEST(RefinementOracle, DoubtIsLeastWhereAllSamplesAreClear) {
  const LampOverFloor room(0);
  const auto oracle = room.Oracle(OracleKind::Doubt);
  const auto error = [&](float visibility) {
    return oracle->Estimate(room.Evidence(visibility)).Sum();
  };
  const auto doubt = [&](float visibility) { return error(visibility) - visibility * error(-1); };
  EXPECT_GT(doubt(1), 0);
  EXPECT_LT(doubt(1), doubt(0.5f));
  EXPECT_GT(error(0), 0);  // What a few rays do not see may be there all the same.
}

TEST(RefinementOracle, GeometryAsksNothingOfVisibility) {
  const LampOverFloor room(0);
  const auto geometric = room.Oracle(OracleKind::Geometric);
  const float unseen = room.Oracle(OracleKind::Doubt)->Estimate(room.Evidence(-1)).Sum();
  for (const float visibility : {-1.f, 0.f, 0.5f, 1.f}) {
    EXPECT_EQ(geometric->Estimate(room.Evidence(visibility)).Sum(), unseen);
  }
}

TEST(RefinementOracle, BfaIsThePowerThatSamplesFind) {
  const LampOverFloor room(0);
  const auto bfa = room.Oracle(OracleKind::Bfa);
  EXPECT_TRUE(bfa->HasFixedSamples());
  EXPECT_EQ(bfa->Estimate(room.Evidence(-1)).Sum(), 0);
  LinkEvidence evidence = room.Evidence(1);
  evidence.transfer = {0.1f, 0, 0.2f};
  EXPECT_FLOAT_EQ(bfa->Estimate(evidence).Sum(), 2);  // The vector on the floor's normal, times 10.
  EXPECT_EQ(bfa->Estimate(evidence).bySource, 0);     // Of equal ends the receiver.
}

TEST(RefinementOracle, BfaSeesLightFromWhereNormalsCancel) {
  // Four walls that face each other make one cluster, to whose mean normal light from above is
  // none.
  Element walls;
  walls.kind = ElementKind::Face;
  walls.area = 4;
  walls.axis = {1, 0, 0};
  walls.coneAngle = 1.5f;
  const LampOverFloor room(0);
  LinkEvidence evidence{room.ElementAt(1), walls, PairBound(), 10, 0, 1, {0, 0, 0.2f}};
  EXPECT_FLOAT_EQ(room.Oracle(OracleKind::Bfa)->Estimate(evidence).Sum(), 2);
}

TEST(RefinementOracle, CertaintyTakesTheDoubtAway) {
  const LampOverFloor open(0), part(0.5f), closed(30);
  const auto sure = open.Oracle(OracleKind::Visibility);
  LinkEvidence clear = open.Evidence(1);
  EXPECT_TRUE(sure->IsCertain(clear));
  EXPECT_FALSE(sure->IsCertain(open.Evidence(0.5f)));
  const float doubted = sure->Estimate(clear).Sum();
  clear.isCertain = true;
  EXPECT_LT(sure->Estimate(clear).Sum(), doubted);
  EXPECT_FLOAT_EQ(sure->Estimate(clear).Sum(), sure->Estimate(open.Evidence(-1)).Sum());

  // A screen under half of the lamp leaves neither certain, one under all of it the one.
  EXPECT_FALSE(part.Oracle(OracleKind::Visibility)->IsCertain(part.Evidence(1)));
  EXPECT_FALSE(part.Oracle(OracleKind::Visibility)->IsCertain(part.Evidence(0)));
  EXPECT_TRUE(closed.Oracle(OracleKind::Visibility)->IsCertain(closed.Evidence(0)));
  EXPECT_FALSE(open.Oracle(OracleKind::Doubt)->IsCertain(open.Evidence(1)));
}

TEST(RefinementOracle, PerceptionWeighsByWhatAPictureShows) {
  const LampOverFloor room(0);
  const auto perceptual = room.Oracle(OracleKind::Perceptual);
  const TransferError doubted = room.Oracle(OracleKind::Doubt)->Estimate(room.Evidence(0.5f));
  const auto weight = [&](float reflected) {
    LinkEvidence evidence = room.Evidence(0.5f);
    evidence.reflected = reflected;
    const TransferError error = perceptual->Estimate(evidence);
    EXPECT_FLOAT_EQ(error.bySource * doubted.byReceiver, error.byReceiver * doubted.bySource);
    return error.byReceiver / doubted.byReceiver;
  };
  // Before there is light nothing is known of a picture.
  EXPECT_FLOAT_EQ(weight(0), 1);

  // All that reflects shows 4 W/m2: there the weight is 1, and half of that again for what goes on
  // to other places. What is darker counts for more, what is brighter for less, but as a source.
  ElementLight light;
  light.Grow(*room.hierarchy);
  for (Spectrum& radiosity : light.radiosity) radiosity += Spectrum(4.f);
  perceptual->Adapt(*room.hierarchy, light);
  EXPECT_NEAR(weight(4), 1.5f, 1e-4f);
  EXPECT_GT(weight(1), weight(4));
  EXPECT_GT(weight(4), weight(16));
  EXPECT_NEAR(weight(4e4f), 0.5f, 1e-3f);
  // Darker than can be told from black: d/dL of (L / (1 + L))^(1/2.2) at 0.009 over that at 0.18.
  const auto slope = [](double l) {
    return std::pow(l / (1 + l), 1 / 2.2 - 1) / ((1 + l) * (1 + l));
  };
  EXPECT_NEAR(weight(0), slope(0.009) / slope(0.18) + 0.5, 1e-3);
  EXPECT_EQ(weight(0), weight(1e-3f));
}

TEST(RefinementOracle, WhatIsEmittedIsNotReflected) {
  Element lamp;
  lamp.emittance = Spectrum(10.f);
  EXPECT_FLOAT_EQ(ReflectedLuminance(lamp, Spectrum(13.f)), 3);
  EXPECT_EQ(ReflectedLuminance(lamp, Spectrum(10.f)), 0);
}

TEST(RefinementOracle, NamesAreThoseOfTheCommandLine) {
  EXPECT_EQ(OracleName(OracleKind::Doubt), std::string("doubt"));
  EXPECT_EQ(OracleName(OracleKind::Visibility), std::string("visibility"));
  EXPECT_EQ(OracleName(OracleKind::Perceptual), std::string("perceptual"));
}

}  // namespace
}  // namespace lambert
