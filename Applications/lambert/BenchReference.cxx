#include "BenchReference.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"
#include "Common/Core/Random.h"
#include "Scene/Core/SceneKey.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {
namespace {

/// Paths that find out whether a receiver is lit, at it and at a point this far toward the middle
/// of its face. Receivers are nearer to their vertex than rays start from surfaces, so that within
/// a closed solid those at its edges see out.
constexpr int kDarknessPaths = 64;
constexpr float kInnerDraw = 0.1f;
/// Light of less than this part of the mean is rounding: of a lamp seen along its own plane.
constexpr double kLeastLight = 1e-6;
/// Of the file and of how receivers are chosen and traced: another one is traced anew.
constexpr uint64_t kVersion = 4;

/// All that light depends on, and what is asked of the reference.
uint64_t ContentKey(const Scene& scene, const BenchReferenceOptions& options) {
  const SceneKey content = KeyOf(scene);
  uint64_t key = HashBits(kVersion, options.seed);
  key = HashBits(key, uint64_t(options.receivers) << 32 | uint64_t(options.paths));
  for (const uint64_t part : {content.geometry, content.materials, content.lights}) {
    key = HashBits(key, part);
  }
  return key;
}

template <class T>
bool ReadVector(std::ifstream* file, uint64_t limit, std::vector<T>* values) {
  uint64_t count = 0;
  file->read(reinterpret_cast<char*>(&count), sizeof count);
  if (!*file || count > limit) return false;
  values->resize(size_t(count));
  file->read(reinterpret_cast<char*>(values->data()), std::streamsize(count * sizeof(T)));
  return bool(*file);
}

template <class T>
void WriteVector(const std::vector<T>& values, std::ofstream* file) {
  const uint64_t count = values.size();
  file->write(reinterpret_cast<const char*>(&count), sizeof count);
  file->write(reinterpret_cast<const char*>(values.data()), std::streamsize(count * sizeof(T)));
}

bool ReadReference(const std::string& name, int receivers, BenchReference* reference) {
  std::ifstream file(name, std::ios::binary);
  return file && ReadVector(&file, uint64_t(receivers), &reference->receivers) &&
         ReadVector(&file, uint64_t(receivers), &reference->light) &&
         reference->light.size() == reference->receivers.size();
}

void WriteReference(const std::string& name, const BenchReference& reference) {
  WriteOutput(name, [&](const std::string& place) {
    std::ofstream file(place, std::ios::binary);
    WriteVector(reference.receivers, &file);
    WriteVector(reference.light, &file);
    return bool(file.flush());
  });
}

std::vector<ReceiverPoint> Points(const std::vector<VertexReceiver>& receivers) {
  std::vector<ReceiverPoint> points;
  for (const VertexReceiver& receiver : receivers) points.push_back(receiver.receiver);
  return points;
}

/// The sides of vertices that receive and do not emit, two a vertex and adjacent, vertices in
/// random order.
std::vector<VertexReceiver> ShuffledReceivers(const TriangleMesh& mesh, uint64_t seed) {
  std::vector<VertexReceiver> receivers = VertexReceivers(mesh);
  const auto emits = [&](const VertexReceiver& r) {
    return (mesh.Emits(r.face, kFront) || mesh.Emits(r.face, kBack)) &&
           !mesh.emittance[size_t(r.face)].IsBlack();
  };
  receivers.erase(std::remove_if(receivers.begin(), receivers.end(), emits), receivers.end());
  Random random(HashBits(seed, 0x7265636569766572ull));
  for (size_t i = receivers.size() / 2; i > 1; --i) {
    const size_t other = size_t(random.UniformDouble() * double(i));
    std::swap_ranges(receivers.begin() + int64_t(2 * i - 2), receivers.begin() + int64_t(2 * i),
                     receivers.begin() + int64_t(2 * other));
  }
  return receivers;
}

/// The same sides of the same faces, farther from the vertex.
std::vector<ReceiverPoint> InnerPoints(const TriangleMesh& mesh,
                                       const std::vector<VertexReceiver>& receivers) {
  std::vector<ReceiverPoint> points = Points(receivers);
  for (size_t i = 0; i < points.size(); ++i) {
    const int32_t face = receivers[i].face;
    const Vec3f middle = (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3.f;
    points[i].position += (middle - points[i].position) * kInnerDraw;
  }
  return points;
}

/// The brighter sides of the first `count` vertices of `candidates` that a few paths find lit: what
/// the points of the input are given. The other side may lie in a shell thinner than rays can see.
std::vector<VertexReceiver> LitReceivers(const TriangleMesh& mesh,
                                         const std::vector<VertexReceiver>& candidates,
                                         const PathTracedIrradiance& tracer, size_t count,
                                         uint64_t seed) {
  PathTracedIrradianceOptions few;
  few.samples = kDarknessPaths;
  few.seed = HashBits(seed, 0x6461726bull);
  std::vector<VertexReceiver> lit;
  for (size_t begin = 0; begin < candidates.size() && lit.size() < count; begin += 2 * count) {
    const size_t end = std::min(candidates.size(), begin + 2 * count);
    const std::vector<VertexReceiver> batch(candidates.begin() + int64_t(begin),
                                            candidates.begin() + int64_t(end));
    const auto atVertex = tracer.Estimate(Points(batch), few);
    const auto inside = tracer.Estimate(InnerPoints(mesh, batch), few);
    double mean = 0;
    for (const IrradianceEstimate& e : inside) mean += e.irradiance.Mean() / double(batch.size());
    const auto isLit = [&](const IrradianceEstimate& e) {
      return e.irradiance.Mean() > kLeastLight * mean;
    };
    for (size_t i = 0; i + 1 < batch.size() && lit.size() < count; i += 2) {
      const size_t brighter =
          Luminance(atVertex[i].irradiance) >= Luminance(atVertex[i + 1].irradiance) ? i : i + 1;
      if (isLit(atVertex[brighter]) && isLit(inside[brighter])) lit.push_back(batch[brighter]);
    }
  }
  return lit;
}

}  // namespace

BenchReference TraceBenchReference(const BenchScene& bench, const BenchReferenceOptions& options) {
  // What an earlier bench left.
  std::string name;
  if (!options.folder.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) throw Error("The folder " + options.folder + " cannot be made.");
    char key[17];
    std::snprintf(key, sizeof key, "%016llx",
                  static_cast<unsigned long long>(ContentKey(bench.scene, options)));
    name =
        (std::filesystem::path(options.folder) / (bench.name + "-" + key + ".reference")).string();
  }
  BenchReference reference;
  if (!name.empty() && ReadReference(name, options.receivers, &reference)) return reference;

  // Lit vertices, many paths each.
  const PathTracedIrradiance tracer(bench.scene);
  reference.receivers =
      LitReceivers(bench.scene.mesh, ShuffledReceivers(bench.scene.mesh, options.seed), tracer,
                   size_t(options.receivers), options.seed);
  if (reference.receivers.empty()) throw Error("No vertex of " + bench.name + " receives light.");
  PathTracedIrradianceOptions trace;
  trace.samples = options.paths;
  trace.seed = options.seed;
  reference.light = tracer.Estimate(Points(reference.receivers), trace);
  if (!name.empty()) WriteReference(name, reference);
  return reference;
}

SolutionError MeasureAtReceivers(const BenchScene& bench, const BenchReference& reference,
                                 const RadiositySolution& solution, bool ofCoarsest) {
  const bool coarse = ofCoarsest && bench.coarse;
  const Scene& solved = coarse ? *bench.coarse : bench.scene;
  const SolutionLookup lookup(solution, solved.mesh.FaceCount());
  std::vector<Spectrum> delivered;
  int64_t missed = 0;
  for (const VertexReceiver& r : reference.receivers) {
    // A rewound side keeps its meaning: tessellation keeps the winding.
    const int32_t face = coarse ? bench.coarseFace[size_t(r.face)] : r.face;
    missed += !lookup.Models(face, r.side);
    delivered.push_back(lookup.Irradiance(lookup.Find(face, r.side, r.receiver.position)));
  }
  SolutionError error = SummarizeError(delivered, reference.light);
  error.missedPoints = missed;
  return error;
}

}  // namespace lambert
