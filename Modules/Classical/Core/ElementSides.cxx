#include "Classical/Core/ElementSides.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {
constexpr int kGroupSize = 8;
/// A face of as many elements begins a group of its own, so that groups are flat where they can be.
constexpr int64_t kOwnGroup = 4;

std::array<Vec3f, kPlacesPerElement> SamplesOn(const ExchangeTriangle& triangle, int32_t key) {
  const auto& [a, b, c] = triangle.corners;
  const Vec3f ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
  const std::array<std::array<Vec3f, 3>, kPlacesPerElement> parts{
      {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
  std::array<Vec3f, kPlacesPerElement> samples;
  Random random(HashBits(uint64_t(key), 0x73616d70ull));
  for (size_t part = 0; part < parts.size(); ++part) {
    const float u = random.Uniform(), v = random.Uniform();
    const auto& [p, q, r] = parts[part];
    samples[part] = PlaceOnTriangle(p, q, r, UniformTriangle(u, v));
  }
  return samples;
}

}  // namespace

ElementSides CollectElementSides(const Scene& scene, const UniformMesh& mesh,
                                 const std::vector<uint8_t>& litSides) {
  ElementSides sides;
  const int64_t elements = mesh.ElementCount();
  for (int64_t begin = 0, end = 0; begin < elements; begin = end) {
    // The elements of one face: all of its front, then all of its back.
    const size_t face = size_t(mesh.face[size_t(begin)]);
    while (end < elements && size_t(mesh.face[size_t(end)]) == face) ++end;
    for (const Side side : {kFront, kBack}) {
      if (!(litSides[face] & (1 << side))) continue;
      const bool emits = scene.mesh.Emits(int64_t(face), side);
      for (int64_t element = begin; element < end; ++element) {
        const int second = side == kFront ? 1 : 2;
        const ExchangeTriangle triangle(mesh.Corner(element, 0), mesh.Corner(element, second),
                                        mesh.Corner(element, 3 - second));
        if (!(triangle.area > 0)) continue;
        const int32_t index = int32_t(sides.Count());
        const bool isFull =
            !sides.groupBegin.empty() && index - sides.groupBegin.back() >= kGroupSize;
        const bool isOwn = element == begin && end - begin >= kOwnGroup;
        if (sides.groupBegin.empty() || isFull || isOwn) sides.groupBegin.push_back(index);
        sides.triangles.push_back(triangle);
        sides.exposure.push_back(1);
        sides.key.push_back(int32_t(2 * element + side));
        sides.samples.push_back(SamplesOn(triangle, sides.key.back()));
        sides.reflectance.push_back(scene.mesh.reflectance[face]);
        sides.emittance.push_back(emits ? scene.mesh.emittance[face] : Spectrum());
      }
    }
  }
  if (!sides.groupBegin.empty()) sides.groupBegin.push_back(int32_t(sides.Count()));
  return sides;
}

void ElementSides::MeasureExposure(const ExposedPlaces& places, int64_t* rays) {
  std::vector<int64_t> cast(triangles.size(), 0);
  ParallelForEach(Count(), 64, [&](int64_t side) {
    const size_t i = size_t(side);
    int exposed = 0;
    for (size_t k = 0; k < samples[i].size(); ++k) {
      const uint64_t seed = HashBits(uint64_t(key[i]), k);
      exposed += places.IsExposed(samples[i][k], triangles[i].normal, seed, &cast[i]) ? 1 : 0;
    }
    exposure[i] = float(exposed) / float(samples[i].size());
  });
  for (const int64_t count : cast) *rays += count;
}

std::vector<std::vector<Vec3f>> ElementSides::GroupPoints(const UniformMesh& mesh) const {
  std::vector<std::vector<Vec3f>> points(groupBegin.empty() ? 0 : groupBegin.size() - 1);
  for (size_t group = 0; group < points.size(); ++group) {
    std::vector<int32_t> vertices;
    for (int32_t i = groupBegin[group]; i < groupBegin[group + 1]; ++i) {
      const auto& triangle = mesh.triangles[size_t(key[size_t(i)] / 2)];
      vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const int32_t vertex : vertices) points[group].push_back(mesh.positions[size_t(vertex)]);
  }
  return points;
}

}  // namespace lambert
