// The mesh of a gathered solution and its light, from round to round: gathered at its points, cut
// where they are too few.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "Common/Core/Progress.h"
#include "Radiosity/Core/ClosePlaces.h"
#include "Radiosity/Core/ContactLines.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/GatheredPoints.h"
#include "Radiosity/Core/MiddleTrends.h"
#include "Radiosity/Core/RefinedMesh.h"
#include "Reference/Core/SolutionError.h"

namespace lambert {

class GatheredMesh {
 public:
  /// All by reference; `skip` is the length that rays skip, m.
  GatheredMesh(ElementHierarchy* hierarchy, const FinalGather& gather, float skip,
               const std::vector<uint8_t>& litSides, const GatheredPointsOptions& options)
      : hierarchy_(hierarchy),
        gather_(gather),
        seed_(options.seed),
        gathered_(gather, options),
        skip_(skip),
        receives_(ReceivingFaces(hierarchy->GetScene().mesh)),
        mesh_(hierarchy, litSides, RefinedMesh::Use::Gather),
        firstTriangles_(int64_t(mesh_.Triangles().size())),
        closePlaces_(gather.PlacesCloseToOthers()),
        middleOfTriangle_(mesh_.Triangles().size(), nullptr) {}

  /// Light at the points that have none yet.
  void GatherAtPoints(int64_t* rays, const ProgressCallback& progress);
  /// More rays at the points that have light, as `options` ask for.
  void Improve(const GatheredPointsOptions& options, int64_t* rays,
               const ProgressCallback& progress) {
    gathered_.Improve(options, rays, progress);
  }
  /// How far interpolation was off where triangles were cut.
  void LearnNonlinearity();
  /// Asks for light in the middle of some triangles of every kind, or where something lies close to
  /// them; `wanted` is the relative RMS error that is.
  void ProbeSome(double wanted, int64_t* rays);
  bool HasProbedSome() const { return !alike_.empty(); }
  /// In those of all others that may hold more error than their corners tell, by what some told.
  void ProbeRest(double wanted, int64_t* rays);
  /// Cuts the triangles that hold the most of the error, along the feet of what stands on them or
  /// the edges of shadows where they find one, until interpolation leaves about `wanted`; false
  /// where it does, or nothing can be cut.
  bool CutTriangles(double wanted, int64_t* rays);
  /// There are as many triangles as there may be.
  bool IsFull() const;
  /// Light at the points, fitted to what is known in the middles of triangles.
  RadiositySolution Deliver() const;

 private:
  /// A patch that was cut in this round, as it was: what its points would have interpolated.
  struct Before {
    std::vector<std::array<Vec3f, 3>> corners;
    std::vector<std::array<Spectrum, 3>> light;
    double difference = 0;  ///< largest squared difference between the corners of a triangle
  };

  /// A patch that is to be cut.
  struct ChosenPatch {
    int32_t patch;
    double error;  ///< largest of its triangles'
    std::vector<int64_t> triangles;
  };
  /// A piece of a patch's border between two of its points.
  struct BorderSegment {
    std::array<int32_t, 2> points, vertices;  ///< counter-clockwise about the patch
    Vec3f normal;                             ///< of the face, unit
    double change;  ///< squared difference of light, beyond scatter, (W/m2)^2
  };
  /// Two lines across a patch that is to be cut; none where it is to be halved.
  using CutLines = std::optional<std::array<LeafLine, 2>>;
  /// Where an edge of light enters a patch and where it leaves.
  struct Crossing {
    size_t chosen;        ///< index of the patch among those
    Vec3f middle;         ///< of the patch
    double area, length;  ///< of the patch, m2 and m
    std::array<BorderSegment, 2> segments;
    std::array<size_t, 2> searched;  ///< of the segments that are asked for light
  };

  /// Of what receives: its area, m2, mean irradiance and mean square (W/m2, norm over bands).
  struct LightScale {
    double area = 0, mean = 0, meanSquare = 0;
  };
  /// What is found in the middle of a triangle, or in the place in it that something lies close to:
  /// its irradiance, W/m2, and the squared deviation of that from what the corners interpolate,
  /// beyond scatter.
  struct Middle {
    Vec3f position;
    Spectrum irradiance;
    double deviation = 0;
    bool isCentred = true;
  };
  /// Triangles that are alike; the first of them were asked in their middle.
  struct AlikeTriangles {
    std::vector<int64_t> triangles;
    size_t asked = 0;
    double error = 0;  ///< squared, of each, by those that were asked
  };
  LightScale MeasureLight() const;
  Spectrum MeanOfCorners(int64_t triangle) const;
  double MeanLight(int64_t triangle) const;
  double DarkestLight(int64_t triangle) const;
  void RecallMiddles();
  Vec3f WeightsOfMiddle(int64_t triangle) const;
  void Probe(const std::vector<int64_t>& triangles, int64_t* rays);
  double Difference(int64_t triangle) const;
  double ErrorOfCorners(int64_t triangle, const LightScale& scale) const;
  double Error(int64_t triangle, const LightScale& scale) const;
  std::vector<double> Errors(const LightScale& scale) const;
  double ErrorOfMiddle(int64_t triangle, const Middle& middle, const LightScale& scale) const;
  MiddleTrends FindTrends(const std::vector<MiddleTrends::Kind>& kinds) const;
  double Area(int64_t triangle) const;
  uint64_t Key(int64_t triangle) const;
  bool Receives(int64_t triangle) const;
  bool IsNew(int64_t triangle) const;
  int32_t PatchOf(int64_t triangle);
  bool IsAtFloor(int64_t triangle) const;
  bool IsPatchAtFloor(int32_t patch) const;

  std::vector<ChosenPatch> ChoosePatches(double wanted, double* threshold);
  void Remember(const std::vector<ChosenPatch>& chosen);
  std::vector<BorderSegment> BorderOf(const std::vector<int64_t>& triangles) const;
  std::vector<Crossing> FindCrossings(const std::vector<ChosenPatch>& chosen,
                                      const std::vector<CutLines>& lines) const;
  GatherPoint PlaceOf(int32_t point, const Vec3f& inside, const Vec3f& normal) const;
  void FindEdges(const std::vector<ChosenPatch>& chosen, std::vector<CutLines>* lines,
                 int64_t* rays) const;
  std::vector<KnownLight> KnownIn(const std::vector<int64_t>& triangles) const;
  CutLines FindContact(const ChosenPatch& chosen, int64_t* rays) const;
  std::vector<CutLines> FindContacts(const std::vector<ChosenPatch>& chosen, int64_t* rays) const;

  ElementHierarchy* hierarchy_;
  const FinalGather& gather_;
  const uint64_t seed_;
  GatheredPoints gathered_;
  const float skip_;
  const std::vector<bool> receives_;  ///< by face: its light counts in the error
  RefinedMesh mesh_;
  const int64_t firstTriangles_;
  ClosePlaces closePlaces_;
  std::vector<const ClosePlace*> closePlaceOf_;  ///< by triangle, while middles are asked
  std::vector<Spectrum> irradiance_;             ///< per point
  std::vector<float> variance_;                  ///< per point, of the irradiance
  std::unordered_map<uint64_t, Middle> probed_;  ///< by the key of the triangle
  std::vector<AlikeTriangles> alike_;            ///< of which some were asked in this round
  std::vector<const Middle*> middleOfTriangle_;  ///< of them; null where it was not asked
  std::vector<uint8_t> isNew_;                   ///< per point: gathered in this round
  std::vector<float> nonlinearity_;              ///< per patch
  std::vector<Before> before_;
  std::vector<int32_t> beforeOfPatch_;  ///< per patch: of the one it was cut from in this round; -1
};

}  // namespace lambert
