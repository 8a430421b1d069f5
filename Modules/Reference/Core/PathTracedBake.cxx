#include "Reference/Core/PathTracedBake.h"

#include <array>
#include <atomic>
#include <string>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Common/Core/Timer.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "Reference/Core/ReferenceRays.h"
#include "Reference/Core/VertexReceivers.h"
#include "Scene/Core/DoubledFaces.h"

namespace lambert {

namespace {

/// Paths that find out whether light arrives at one side of a vertex: so many divided by the faces
/// that meet there, as their other corners look for them too; but not fewer than the least.
constexpr int kFirstPaths = 16, kLeastFirstPaths = 4;

/// Light at both sides of every vertex, and which sides of which faces it arrives at.
class VertexLight {
 public:
  VertexLight(const Scene& scene, const PathTracedBakeOptions& options)
      : mesh_(scene.mesh),
        doubled_(scene.mesh),
        options_(options),
        tracer_(scene),
        receivers_(VertexReceivers(scene.mesh)),
        receiverOfPoint_(scene.mesh.positions.size(), -1),
        light_(receivers_.size()),
        paths_(receivers_.size(), 0) {
    for (size_t i = 0; i < receivers_.size(); i += 2) {
      receiverOfPoint_[size_t(receivers_[i].point)] = int32_t(i);
    }
  }

  /// Few paths everywhere, then all of them where light arrives, until it arrives nowhere new.
  void Trace(const ProgressCallback& progress) {
    std::vector<int32_t> round(receivers_.size());
    for (size_t i = 0; i < round.size(); ++i) round[i] = int32_t(i);
    TracePaths(round, FirstPaths(), {0, 0.2}, progress);
    const std::vector<int32_t> all(receivers_.size(), options_.samples);
    double done = 0.2;
    for (round = Unfinished(); !round.empty(); round = Unfinished()) {
      // Nearly all of the work is in the first of these rounds.
      const double end = done < 0.9 ? 0.9 : done + 0.5 * (1 - done);
      TracePaths(round, all, {done, end}, progress);
      done = end;
    }
    if (!Report(progress, 1, kStage)) throw Cancelled();
  }

  /// True where a side of a face emits or has light at one of its corners.
  bool IsLit(int32_t face, Side side) const {
    if (doubled_.IsHidden(face, side)) return false;
    if (mesh_.Emits(face, side) && !mesh_.emittance[size_t(face)].IsBlack()) return true;
    for (const int32_t point : mesh_.triangles[size_t(face)]) {
      const int32_t receiver = ReceiverAt(point, face, side);
      if (receiver >= 0 && HasLight(receiver)) return true;
    }
    return false;
  }
  /// The receiver that serves a side of a face at one of its points; -1 where there is none.
  int32_t ReceiverAt(int32_t point, int32_t face, Side side) const {
    const int32_t first = receiverOfPoint_[size_t(point)];
    return first < 0 || FacesNormal(point, face, side) ? first : first + 1;
  }
  /// True where a side of a face turns to the side that the point's normal faces.
  bool FacesNormal(int32_t point, int32_t face, Side side) const {
    const bool front = Dot(mesh_.FrontNormal(face), mesh_.normals[size_t(point)]) >= 0;
    return front == (side == kFront);
  }
  /// W/m2; black for -1.
  Spectrum Irradiance(int32_t receiver) const {
    if (receiver < 0 || paths_[size_t(receiver)] == 0) return {};
    const auto& sum = light_[size_t(receiver)];
    const double share = 1. / paths_[size_t(receiver)];
    return {float(sum[0] * share), float(sum[1] * share), float(sum[2] * share)};
  }
  int64_t Rays() const { return rays_; }
  int64_t FinishedReceivers() const {
    return std::count(paths_.begin(), paths_.end(), options_.samples);
  }

 private:
  static constexpr const char* kStage = "Tracing paths at vertices";

  bool HasLight(int32_t receiver) const {
    const auto& sum = light_[size_t(receiver)];
    return sum[0] > 0 || sum[1] > 0 || sum[2] > 0;
  }

  /// How many paths each receiver begins with.
  std::vector<int32_t> FirstPaths() const {
    std::vector<int32_t> facesOfPoint(mesh_.positions.size(), 0), paths;
    for (const auto& triangle : mesh_.triangles) {
      for (const int32_t point : triangle) ++facesOfPoint[size_t(point)];
    }
    for (const VertexReceiver& receiver : receivers_) {
      const int share = kFirstPaths / facesOfPoint[size_t(receiver.point)];
      paths.push_back(std::min(options_.samples, std::max(kLeastFirstPaths, share)));
    }
    return paths;
  }

  /// Receivers at the corners of lit sides that have not taken all their paths.
  std::vector<int32_t> Unfinished() const {
    std::vector<uint8_t> wanted(receivers_.size(), 0);
    for (int32_t face = 0; face < int32_t(mesh_.FaceCount()); ++face) {
      for (const Side side : {kFront, kBack}) {
        if (!IsLit(face, side)) continue;
        for (const int32_t point : mesh_.triangles[size_t(face)]) {
          const int32_t receiver = ReceiverAt(point, face, side);
          if (receiver >= 0) wanted[size_t(receiver)] = 1;
        }
      }
    }
    std::vector<int32_t> unfinished;
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i] && paths_[i] < options_.samples) unfinished.push_back(int32_t(i));
    }
    return unfinished;
  }

  /// Brings each receiver of the round up to its number of paths.
  void TracePaths(const std::vector<int32_t>& round, const std::vector<int32_t>& paths,
                  std::pair<double, double> part, const ProgressCallback& progress) {
    constexpr int64_t kPathsPerBlock = int64_t(1) << 19;  // A fraction of a second.
    const int64_t count = int64_t(round.size());
    const int64_t block = std::max<int64_t>(64, kPathsPerBlock / options_.samples);
    for (int64_t begin = 0; begin < count; begin += block) {
      const double fraction = double(begin) / double(count);
      if (!Report(progress, part.first + (part.second - part.first) * fraction, kStage)) {
        throw Cancelled();
      }
      std::atomic<int64_t> rays{0};
      ParallelFor(std::min(block, count - begin), 4, [&](int64_t from, int64_t to) {
        FlushDenormals flush;
        int64_t cast = 0;
        for (int64_t i = begin + from; i < begin + to; ++i) {
          const size_t receiver = size_t(round[size_t(i)]);
          const auto sum = tracer_.SumOfPaths(receivers_[receiver].receiver,
                                              HashBits(options_.seed, uint64_t(receiver)),
                                              {paths_[receiver], paths[receiver]}, &cast);
          for (size_t band = 0; band < 3; ++band) light_[receiver][band] += sum[band];
          paths_[receiver] = paths[receiver];
        }
        rays += cast;
      });
      rays_ += rays;
    }
  }

  const TriangleMesh& mesh_;
  const DoubledFaces doubled_;
  const PathTracedBakeOptions options_;
  const PathTracedIrradiance tracer_;
  const std::vector<VertexReceiver> receivers_;
  std::vector<int32_t> receiverOfPoint_;      ///< the first of its two; -1: none
  std::vector<std::array<double, 3>> light_;  ///< per receiver: sum over its paths, W/m2
  std::vector<int32_t> paths_;                ///< per receiver: how many it took
  int64_t rays_ = 0;
};

/// The mesh that is delivered, triangle by triangle.
class LitMesh {
 public:
  LitMesh(const TriangleMesh& mesh, const VertexLight& light)
      : mesh_(mesh), light_(light), firstCopy_(mesh.positions.size(), -1) {}

  void Add(int32_t face, Side side) {
    // What light needs to know of the face.
    const size_t f = size_t(face);
    TriangleMesh& out = solution_.mesh;
    const bool emits = mesh_.Emits(face, side);
    const Spectrum emittance = emits ? mesh_.emittance[f] : Spectrum();
    const bool wasRewound = (mesh_.faceFlags[f] & kRewound) != 0;
    const bool isRewound = wasRewound != (side == kBack);
    out.reflectance.push_back(mesh_.reflectance[f]);
    out.emittance.push_back(emittance);
    out.faceFlags.push_back(uint8_t((emits ? kEmitsFront : 0) | (isRewound ? kRewound : 0)));
    out.materialId.push_back(mesh_.materialId[f]);
    out.partId.push_back(mesh_.partId[f]);
    if (!mesh_.surfaceId.empty()) out.surfaceId.push_back(mesh_.surfaceId[f]);
    out.sourceCellId.push_back(mesh_.sourceCellId[f]);
    solution_.inputFaceId.push_back(face);
    solution_.side.push_back(side);

    // Its corners, the other way round on the back.
    std::array<int32_t, 3> triangle;
    for (size_t corner = 0; corner < 3; ++corner) {
      triangle[corner] = PointFor(mesh_.triangles[f][corner], face, side);
      reflectance_[size_t(triangle[corner])] += mesh_.reflectance[f];
      emittance_[size_t(triangle[corner])] += emittance;
      ++faces_[size_t(triangle[corner])];
    }
    if (side == kBack) std::swap(triangle[1], triangle[2]);
    out.triangles.push_back(triangle);
  }

  RadiositySolution Finish() {
    for (size_t point = 0; point < faces_.size(); ++point) {
      const float share = 1 / float(faces_[point]);
      solution_.radiosity.push_back(reflectance_[point] * share * solution_.irradiance[point] +
                                    emittance_[point] * share);
    }
    // The input's own points take the brighter of their sides.
    solution_.inputIrradiance.assign(mesh_.positions.size(), {});
    for (size_t point = 0; point < copies_.size(); ++point) {
      Spectrum& brightest = solution_.inputIrradiance[size_t(copies_[point].point)];
      const Spectrum& here = solution_.irradiance[point];
      if (Luminance(here) > Luminance(brightest)) brightest = here;
    }
    return std::move(solution_);
  }

 private:
  /// One point of the output.
  struct Copy {
    int32_t point, surface, receiver;
    Side side;
    int32_t next;  ///< the next copy of the same point; -1: none
  };

  int32_t PointFor(int32_t point, int32_t face, Side side) {
    // One that is there already.
    const size_t f = size_t(face);
    const int32_t surface = mesh_.surfaceId.empty() ? mesh_.materialId[f] : mesh_.surfaceId[f];
    const int32_t receiver = light_.ReceiverAt(point, face, side);
    int32_t* last = &firstCopy_[size_t(point)];
    while (*last >= 0) {
      Copy& copy = copies_[size_t(*last)];
      if (copy.surface == surface && copy.receiver == receiver && copy.side == side) return *last;
      last = &copy.next;
    }

    // A new one, with the light of its receiver.
    const int32_t number = *last = int32_t(copies_.size());
    copies_.push_back({point, surface, receiver, side, -1});
    const Vec3f& normal = mesh_.normals[size_t(point)];
    solution_.mesh.positions.push_back(Vec3f(mesh_.positions[size_t(point)]));
    solution_.mesh.normals.push_back(light_.FacesNormal(point, face, side) ? normal : -normal);
    if (!mesh_.uvs.empty()) solution_.mesh.uvs.push_back(Vec2f(mesh_.uvs[size_t(point)]));
    solution_.irradiance.push_back(light_.Irradiance(receiver));
    reflectance_.emplace_back();
    emittance_.emplace_back();
    faces_.push_back(0);
    return number;
  }

  const TriangleMesh& mesh_;
  const VertexLight& light_;
  RadiositySolution solution_;
  std::vector<int32_t> firstCopy_;                 ///< per point of the input; -1: none
  std::vector<Copy> copies_;                       ///< per point of the output
  std::vector<Spectrum> reflectance_, emittance_;  ///< per point of the output: sums over its faces
  std::vector<int32_t> faces_;                     ///< how many these are
};

}  // namespace

RadiositySolution BakePathTraced(const Scene& scene, const PathTracedBakeOptions& options,
                                 SolverStatistics* statistics, const ProgressCallback& progress) {
  const TriangleMesh& mesh = scene.mesh;
  if (options.samples < 1) {
    throw Error("A bake needs at least 1 sample; " + std::to_string(options.samples) +
                " were asked for.");
  }
  if (mesh.normals.size() != mesh.positions.size()) {
    throw Error("The mesh has no normals at its points, which its light is asked for.");
  }

  // Light at the vertices.
  const Timer timer;
  VertexLight light(scene, options);
  light.Trace(progress);

  // The lit sides; a face without any is there all the same.
  LitMesh lit(mesh, light);
  for (int32_t face = 0; face < int32_t(mesh.FaceCount()); ++face) {
    const bool front = light.IsLit(face, kFront), back = light.IsLit(face, kBack);
    if (front || !back) lit.Add(face, kFront);
    if (back) lit.Add(face, kBack);
  }
  if (statistics) {
    *statistics = {};
    statistics->patchElements = light.FinishedReceivers();
    statistics->rays = light.Rays();
    statistics->stoppedBy = "error";
    IterationRecord record;
    record.iteration = 1;
    record.seconds = timer.Seconds();
    record.elements = statistics->patchElements;
    record.rays = statistics->rays;
    statistics->history.push_back(record);
  }
  return lit.Finish();
}

}  // namespace lambert
