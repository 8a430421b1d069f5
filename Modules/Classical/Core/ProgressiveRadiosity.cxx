#include "Classical/Core/ProgressiveRadiosity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Classical/Core/ElementBalance.h"
#include "Classical/Core/ExposedPlaces.h"
#include "Classical/Core/LampsAndSky.h"
#include "Classical/Core/LitFaces.h"
#include "Classical/Core/PointFormFactors.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Common/Core/Timer.h"

namespace lambert {

namespace {

/// An observer hears of a run when this part of the unshot light is left of what it last heard.
constexpr double kIterationFactor = 0.5;

void CheckOptions(const ProgressiveRadiosityOptions& options) {
  if (!(options.unshot > 0 && options.unshot < 1)) {
    throw Error("The part of the light that may stay unshot is " + std::to_string(options.unshot) +
                "; it must lie in (0, 1).");
  }
  if (!(options.patchSize >= 0) || !std::isfinite(options.patchSize)) {
    throw Error("The patch size is " + std::to_string(options.patchSize) +
                " m; give a positive length, or 0 for 4 times the element size.");
  }
  if (options.skyRays < 1) throw Error("A vertex takes at least 1 ray to the sky.");
  if (options.shots < 0) throw Error("The number of shots is negative.");
}

UniformMesh CutScene(const Scene& scene, const ProgressiveRadiosityOptions& options) {
  CheckOptions(options);
  const double elementSize = ResolveElementSize(scene, options.elementSize);
  return MakeUniformMesh(scene, elementSize,
                         options.patchSize > 0 ? options.patchSize : 4 * elementSize);
}

/// Light to be shot from the four parts of a triangle about its places, W.
using PlacePower = std::array<Spectrum, kPlacesPerElement>;

double Power(const PlacePower& power) {
  return double((power[0] + power[1] + power[2] + power[3]).Mean());
}

/// What shoots: sides of patches with the light that they reflect, and sides of emitting elements
/// with the light that they emit - lamps cast the shadows that are seen.
struct Shooters {
  std::vector<ExchangeTriangle> triangles;
  std::vector<PlacePower> unshot;
  /// Area of the parts about the places that is not buried in another thing, m2.
  std::vector<std::array<float, kPlacesPerElement>> exposedArea;
  /// Per output face: the shooter that its reflected light joins, and the place there; the place is
  /// -1 where the face is too much of the patch for a single one.
  std::vector<int32_t> ofFace;
  std::vector<int8_t> placeOfFace;

  /// What a face gives to a place of its shooter of values at its corners: their mean, to its own
  /// place; a face that is a patch, or half of one, a quarter to each, linear between its corners.
  template <class T>
  T PlaceMean(size_t face, size_t place, const std::array<T, 3>& at) const {
    const T sum = at[0] + at[1] + at[2];
    if (placeOfFace[face] >= 0) return size_t(placeOfFace[face]) == place ? sum / 3.f : T();
    return (place < 3 ? at[place] * 0.5f + sum / 6.f : sum / 3.f) / float(kPlacesPerElement);
  }

  Spectrum TotalUnshot() const {
    Spectrum total;
    for (const PlacePower& power : unshot) total += power[0] + power[1] + power[2] + power[3];
    return total;
  }
};

/// The place of `triangle` that `position` is nearest to.
int8_t NearestPlace(const ExchangeTriangle& triangle, const Vec3f& position) {
  int8_t nearest = 0;
  for (int8_t place = 1; place < kPlacesPerElement; ++place) {
    if (LengthSquared(triangle.Place(place) - position) <
        LengthSquared(triangle.Place(nearest) - position)) {
      nearest = place;
    }
  }
  return nearest;
}

Shooters CollectShooters(const UniformMesh& mesh, const UniformSolution& uniform) {
  Shooters shooters;
  const RadiositySolution& solution = uniform.solution;
  std::vector<int32_t> patchOf(size_t(mesh.ElementCount()));
  for (size_t patch = 0; patch < mesh.patches.size(); ++patch) {
    std::fill(patchOf.begin() + mesh.patchBegin[patch],
              patchOf.begin() + mesh.patchBegin[patch + 1], int32_t(patch));
  }
  std::vector<int32_t> ofPatchSide(2 * mesh.patches.size(), -1);
  for (size_t face = 0; face < uniform.element.size(); ++face) {
    // The patch.
    const size_t patch = size_t(patchOf[size_t(uniform.element[face])]);
    int32_t& shooter = ofPatchSide[2 * patch + solution.side[face]];
    if (shooter < 0) {
      shooter = int32_t(shooters.triangles.size());
      const auto corner = [&](size_t c) { return mesh.positions[size_t(mesh.patches[patch][c])]; };
      const size_t second = solution.side[face] == kFront ? 1 : 2;
      shooters.triangles.emplace_back(corner(0), corner(second), corner(3 - second));
      shooters.unshot.emplace_back();
      shooters.exposedArea.push_back({});
    }
    const bool isCoarse = mesh.patchBegin[patch + 1] - mesh.patchBegin[patch] < kPlacesPerElement;
    shooters.ofFace.push_back(shooter);
    shooters.placeOfFace.push_back(isCoarse ? int8_t(-1)
                                            : NearestPlace(shooters.triangles[size_t(shooter)],
                                                           mesh.Centroid(uniform.element[face])));

    // The element's own light.
    if (solution.mesh.emittance[face].IsBlack()) continue;
    const TriangleMesh& output = solution.mesh;
    const int64_t f = int64_t(face);
    shooters.triangles.emplace_back(output.Corner(f, 0), output.Corner(f, 1), output.Corner(f, 2));
    PlacePower own;
    own.fill(output.emittance[face] * (shooters.triangles.back().area / kPlacesPerElement));
    shooters.unshot.push_back(own);
    shooters.exposedArea.emplace_back();
    shooters.exposedArea.back().fill(shooters.triangles.back().area / kPlacesPerElement);
  }
  return shooters;
}

/// Light at every output point, W/m2.
struct PointLight {
  std::vector<Spectrum> irradiance;  ///< for the point's normal
  std::vector<Spectrum> facet;       ///< for its facet: what is reflected on
  std::vector<Spectrum> fromFar;     ///< for its facet, of skies and directional lights alone

  explicit PointLight(size_t points) : irradiance(points), facet(points), fromFar(points) {}
};

}  // namespace

struct ProgressiveRadiosity::Implementation {
  Implementation(const Scene& scene_, const ProgressiveRadiosityOptions& options_);

  void FindExposedPoints();
  void ReceiveFromLights();
  void Reflect(const std::vector<Spectrum>& facetIrradiance);
  void Shoot(size_t shooter);
  void Finish();
  RadiositySolution Deliver(const Spectrum& ambient) const;
  double Unshot() const { return double(shooters.TotalUnshot().Mean()); }

  const Scene& scene;
  const ProgressiveRadiosityOptions options;
  const UniformMesh mesh;
  const RayScene rayScene;
  SolverStatistics statistics;
  const std::vector<uint8_t> litFaces;
  const UniformSolution uniform;
  Shooters shooters;
  PointLight light;
  const PointFormFactors formFactors;
  double firstLight = 0;  ///< W, mean of the bands
  int64_t shots = 0;
  std::vector<float> faceArea;           ///< m2
  std::vector<PointFormFactor> factors;  ///< of the last shot
  std::vector<Spectrum> received;        ///< irradiance on the facets, of the last shot
};

ProgressiveRadiosity::Implementation::Implementation(const Scene& scene_,
                                                     const ProgressiveRadiosityOptions& options_)
    : scene(scene_),
      options(options_),
      mesh(CutScene(scene_, options_)),
      rayScene(scene_.mesh),
      litFaces(
          FindLitFaces(scene_, mesh, rayScene, SourceLight(scene_, rayScene), &statistics.rays)),
      uniform(MakeUniformSolution(scene_, mesh, litFaces)),
      shooters(CollectShooters(mesh, uniform)),
      light(size_t(uniform.PointCount())),
      formFactors(uniform.receivers, shooters.triangles, scene_.mesh, rayScene) {
  const TriangleMesh& output = uniform.solution.mesh;
  for (int64_t face = 0; face < output.FaceCount(); ++face) faceArea.push_back(output.Area(face));
  received.resize(uniform.receivers.size());
  FindExposedPoints();
  ReceiveFromLights();
  firstLight = Unshot();
  statistics.patchElements = int64_t(uniform.element.size());
}

// Points that see nothing but the dark inside of things are buried there. What the patches have to
// shoot leaves by the area that is not.
void ProgressiveRadiosity::Implementation::FindExposedPoints() {
  const ExposedPlaces places(scene, rayScene, litFaces);
  std::vector<uint8_t> isExposed(uniform.receivers.size());
  std::vector<int64_t> cast(isExposed.size(), 0);
  ParallelForEach(uniform.PointCount(), 64, [&](int64_t point) {
    const ElementReceiver& at = uniform.receivers[size_t(point)];
    isExposed[size_t(point)] =
        places.IsExposed(at.position, at.geometric, uint64_t(point), &cast[size_t(point)]) ? 1 : 0;
  });
  for (const int64_t count : cast) statistics.rays += count;

  for (size_t face = 0; face < faceArea.size(); ++face) {
    const auto& [a, b, c] = uniform.solution.mesh.triangles[face];
    const std::array<float, 3> exposed{float(isExposed[size_t(a)]), float(isExposed[size_t(b)]),
                                       float(isExposed[size_t(c)])};
    auto& area = shooters.exposedArea[size_t(shooters.ofFace[face])];
    for (size_t place = 0; place < area.size(); ++place) {
      area[place] += faceArea[face] * shooters.PlaceMean(face, place, exposed);
    }
  }
}

// Lamps without geometry and skies shoot first, all at once.
void ProgressiveRadiosity::Implementation::ReceiveFromLights() {
  const LampsAndSky lights(scene, rayScene);
  if (lights.IsEmpty()) return;
  std::vector<int64_t> cast(uniform.receivers.size(), 0);
  ParallelForEach(uniform.PointCount(), 16, [&](int64_t point) {
    const size_t p = size_t(point);
    const ElementReceiver& receiver = uniform.receivers[p];
    const uint64_t seed = HashBits(uint64_t(point), 0x736b79ull);
    const LightReceiver facet{receiver.position, receiver.geometric, receiver.geometric};
    light.fromFar[p] = lights.FromFar(facet, options.skyRays, seed, &cast[p]);
    light.facet[p] = light.fromFar[p] + lights.FromLamps(facet, &cast[p]);
    light.irradiance[p] = light.facet[p];
    if (Dot(receiver.normal, receiver.geometric) > 1 - 1e-6f) return;
    const LightReceiver smooth{receiver.position, receiver.normal, receiver.geometric};
    light.irradiance[p] = lights.FromFar(smooth, options.skyRays, seed, &cast[p]) +
                          lights.FromLamps(smooth, &cast[p]);
  });
  for (const int64_t count : cast) statistics.rays += count;
  Reflect(light.facet);
}

// Newly received light is reflected: it joins what the patches have yet to shoot.
void ProgressiveRadiosity::Implementation::Reflect(const std::vector<Spectrum>& facetIrradiance) {
  const TriangleMesh& output = uniform.solution.mesh;
  for (size_t face = 0; face < output.triangles.size(); ++face) {
    const auto& [a, b, c] = output.triangles[face];
    const std::array<Spectrum, 3> at{facetIrradiance[size_t(a)], facetIrradiance[size_t(b)],
                                     facetIrradiance[size_t(c)]};
    if (at[0].IsBlack() && at[1].IsBlack() && at[2].IsBlack()) continue;
    const Spectrum reflected = output.reflectance[face] * faceArea[face];
    PlacePower& unshot = shooters.unshot[size_t(shooters.ofFace[face])];
    for (size_t place = 0; place < unshot.size(); ++place) {
      unshot[place] += reflected * shooters.PlaceMean(face, place, at);
    }
  }
}

void ProgressiveRadiosity::Implementation::Shoot(size_t shooter) {
  // Radiosity of what is exposed of the parts about the places.
  PlacePower radiosity = shooters.unshot[shooter];
  for (size_t place = 0; place < radiosity.size(); ++place) {
    const float area = shooters.exposedArea[shooter][place];
    radiosity[place] = area > 0 ? radiosity[place] / area : Spectrum();
  }
  shooters.unshot[shooter] = {};

  // To all that see it.
  formFactors.ToShooter(int32_t(shooter), &factors, &statistics.rays);
  ParallelForEach(uniform.PointCount(), 1024, [&](int64_t point) {
    const size_t p = size_t(point);
    received[p] = {};
    for (size_t place = 0; place < radiosity.size(); ++place) {
      received[p] += radiosity[place] * factors[p].facet[place];
      light.irradiance[p] += radiosity[place] * factors[p].normal[place];
    }
    light.facet[p] += received[p];
  });
  Reflect(received);
  ++shots;
}

RadiositySolution ProgressiveRadiosity::Implementation::Deliver(const Spectrum& ambient) const {
  std::vector<Spectrum> irradiance = light.irradiance;
  for (Spectrum& e : irradiance) e += ambient;
  return DeliverLight(scene, uniform, std::move(irradiance));
}

// Where the light went.
void ProgressiveRadiosity::Implementation::Finish() {
  const ElementSides sides = CollectElementSides(scene, mesh, litFaces);
  SideLight sideLight(sides);
  std::vector<Spectrum> byKey(size_t(2 * mesh.ElementCount())), farByKey(byKey);
  for (size_t face = 0; face < uniform.element.size(); ++face) {
    const size_t key = 2 * size_t(uniform.element[face]) + uniform.solution.side[face];
    for (const int32_t point : uniform.solution.mesh.triangles[face]) {
      byKey[key] += light.facet[size_t(point)] / 3;
      farByKey[key] += light.fromFar[size_t(point)] / 3;
    }
  }
  for (size_t i = 0; i < sides.key.size(); ++i) {
    sideLight.irradiance[i] = byKey[size_t(sides.key[i])];
    sideLight.fromFar[i] = farByKey[size_t(sides.key[i])];
    sideLight.radiosity[i] = sides.emittance[i] + sides.reflectance[i] * sideLight.irradiance[i];
  }
  MeasureElementBalance(scene, sides, sideLight, rayScene, &statistics);
}

ProgressiveRadiosity::ProgressiveRadiosity(const Scene& scene,
                                           const ProgressiveRadiosityOptions& options)
    : implementation_(new Implementation(scene, options)) {}

ProgressiveRadiosity::~ProgressiveRadiosity() = default;

void ProgressiveRadiosity::Run(const ProgressCallback& progress, const Observer& observer) {
  Implementation& self = *implementation_;
  SolverStatistics& statistics = self.statistics;
  const Timer timer;
  statistics.stoppedBy = "error";
  double heard = self.firstLight;
  for (;;) {
    // Who has the most?
    const double unshot = self.Unshot();
    const auto& powers = self.shooters.unshot;
    const auto brightest = std::max_element(
        powers.begin(), powers.end(),
        [](const PlacePower& a, const PlacePower& b) { return Power(a) < Power(b); });
    const bool isDone = !(unshot > self.options.unshot * self.firstLight);
    const bool isOut = self.options.shots > 0 && self.shots >= self.options.shots;

    // An iteration: half the light was shot.
    if (isDone || isOut || unshot <= kIterationFactor * heard) {
      heard = unshot;
      const double left = self.firstLight > 0 ? unshot / self.firstLight : 0;
      statistics.history.push_back({int(statistics.history.size()) + 1, timer.Seconds(), left,
                                    statistics.patchElements, self.shots, statistics.rays, left});
      if (observer && !observer(statistics.history.back())) statistics.stoppedBy = "interrupt";
    }
    if (isOut && !isDone) statistics.stoppedBy = "iterations";
    if (isDone || isOut || statistics.stoppedBy == "interrupt") break;
    const double toGo = std::log(unshot / self.firstLight) / std::log(self.options.unshot);
    if (!Report(progress, std::clamp(toGo, 0.0, 1.0), "shooting")) {
      statistics.stoppedBy = "interrupt";
      break;
    }
    self.Shoot(size_t(brightest - powers.begin()));
  }
  self.Finish();
}

RadiositySolution ProgressiveRadiosity::Solution() const {
  return implementation_->Deliver(Spectrum());
}

RadiositySolution ProgressiveRadiosity::SolutionWithAmbient() const {
  return implementation_->Deliver(AmbientIrradiance());
}

// All that is unshot, spread over all surfaces, and reflected by their mean reflectance for ever.
Spectrum ProgressiveRadiosity::AmbientIrradiance() const {
  const Implementation& self = *implementation_;
  const TriangleMesh& output = self.uniform.solution.mesh;
  double area = 0;
  std::array<double, 3> reflecting{};
  for (int64_t face = 0; face < output.FaceCount(); ++face) {
    const double faceArea = double(output.Area(face));
    area += faceArea;
    for (int band = 0; band < 3; ++band) {
      reflecting[size_t(band)] += faceArea * double(output.reflectance[size_t(face)][band]);
    }
  }
  Spectrum ambient;
  if (!(area > 0)) return ambient;
  const Spectrum unshot = self.shooters.TotalUnshot();
  for (int band = 0; band < 3; ++band) {
    ambient[band] = float(double(unshot[band]) / (area - reflecting[size_t(band)]));
  }
  return ambient;
}

const SolverStatistics& ProgressiveRadiosity::Statistics() const {
  return implementation_->statistics;
}

RadiositySolution SolveProgressiveRadiosity(const Scene& scene,
                                            const ProgressiveRadiosityOptions& options,
                                            SolverStatistics* statistics,
                                            const ProgressCallback& progress) {
  ProgressiveRadiosity solver(scene, options);
  solver.Run(progress);
  if (statistics) *statistics = solver.Statistics();
  if (solver.Statistics().stoppedBy == "interrupt") throw Cancelled();
  return solver.Solution();
}

}  // namespace lambert
