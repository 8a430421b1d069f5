#include "BenchScenes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "Common/Core/Error.h"
#include "Engine/RadiosityRun.h"
#include "Scene/Core/MeshRepair.h"

namespace lambert {
namespace {

/// The points of one edge, the same to the bit from both faces at it.
struct DividedEdge {
  Vec3f from, to, fromNormal, toNormal;
  int parts;

  DividedEdge(const TriangleMesh& mesh, int32_t a, int32_t b, float length) {
    const auto key = [&](int32_t point) {
      const Vec3f& p = mesh.positions[size_t(point)];
      return std::make_tuple(p.x, p.y, p.z);
    };
    reversed_ = key(b) < key(a);
    if (reversed_) std::swap(a, b);
    from = mesh.positions[size_t(a)], to = mesh.positions[size_t(b)];
    fromNormal = mesh.normals[size_t(a)], toNormal = mesh.normals[size_t(b)];
    parts = std::max(1, int(std::ceil(Length(to - from) / length)));
  }

  /// The point nearest to step `step` of `steps` on the way from a to b.
  void PointNear(int step, int steps, Vec3f* position, Vec3f* normal) const {
    int part = int(std::lround(double(step) * parts / steps));
    if (reversed_) part = parts - part;
    const float t = float(part) / float(parts);
    *position = part == parts ? to : from + (to - from) * t;
    *normal = Normalize(fromNormal * (1 - t) + toNormal * t);
  }

 private:
  bool reversed_;
};

/// Rows of points over one face, from the corner between its longer edges to its shortest edge.
class FaceGrid {
 public:
  FaceGrid(const TriangleMesh& mesh, int64_t face, float length)
      : mesh_(mesh),
        corners_(FromLongestEdges(mesh, face)),
        left_(mesh, corners_[0], corners_[1], length),
        last_(mesh, corners_[1], corners_[2], length),
        right_(mesh, corners_[0], corners_[2], length),
        rows_(std::max(left_.parts, right_.parts)) {}

  /// About as many points as AppendTo makes.
  double PointEstimate() const { return 0.5 * (rows_ + 1.0) * (last_.parts + 2.0); }

  /// Appends points and triangles; returns how many triangles.
  int AppendTo(TriangleMesh* mesh) const {
    int32_t above = int32_t(mesh->positions.size());
    AppendPoint(0, 0, mesh);
    int count = 0;
    for (int row = 1; row <= rows_; ++row) {
      const int32_t below = int32_t(mesh->positions.size());
      for (int column = 0; column <= Parts(row); ++column) AppendPoint(row, column, mesh);
      count += AppendStrip(above, Parts(row - 1), below, Parts(row), mesh);
      above = below;
    }
    return count;
  }

 private:
  static std::array<int32_t, 3> FromLongestEdges(const TriangleMesh& mesh, int64_t face) {
    std::array<int32_t, 3> corners = mesh.triangles[size_t(face)];
    int shortest = 0;
    const auto length = [&](int edge) {
      return Length(mesh.Corner(face, (edge + 1) % 3) - mesh.Corner(face, edge));
    };
    for (int edge = 1; edge < 3; ++edge) {
      if (length(edge) < length(shortest)) shortest = edge;
    }
    std::rotate(corners.begin(), corners.begin() + (shortest + 2) % 3, corners.end());
    return corners;
  }

  /// Parts of a row: as wide there as those of the last one.
  int Parts(int row) const { return int((int64_t(last_.parts) * row + rows_ - 1) / rows_); }

  void AppendPoint(int row, int column, TriangleMesh* mesh) const {
    Vec3f position, normal;
    if (column == 0) {
      left_.PointNear(row, rows_, &position, &normal);
    } else if (column == Parts(row)) {
      right_.PointNear(row, rows_, &position, &normal);
    } else if (row == rows_) {
      last_.PointNear(column, last_.parts, &position, &normal);
    } else {
      const float down = float(row) / float(rows_), across = float(column) / float(Parts(row));
      const auto blend = [&](const std::vector<Vec3f>& values) {
        return values[size_t(corners_[0])] * (1 - down) +
               values[size_t(corners_[1])] * (down * (1 - across)) +
               values[size_t(corners_[2])] * (down * across);
      };
      position = blend(mesh_.positions);
      normal = Normalize(blend(mesh_.normals));
    }
    mesh->positions.push_back(position);
    mesh->normals.push_back(normal);
  }

  /// Joins two rows, always from the end that lags behind.
  static int AppendStrip(int32_t above, int64_t aboveParts, int32_t below, int64_t belowParts,
                         TriangleMesh* mesh) {
    int count = 0;
    int32_t i = 0, j = 0;
    while (i < aboveParts || j < belowParts) {
      const int32_t a = above + i, b = below + j;
      const bool belowLags = (2 * j + 1) * aboveParts <= (2 * i + 1) * belowParts;
      if (j < belowParts && (i == aboveParts || belowLags)) {
        count += AppendTriangle({a, b, b + 1}, mesh);
        ++j;
      } else {
        count += AppendTriangle({a, b, a + 1}, mesh);
        ++i;
      }
    }
    return count;
  }

  /// Leaves out what has no area: steps beside an edge of fewer parts.
  static int AppendTriangle(const std::array<int32_t, 3>& t, TriangleMesh* mesh) {
    const auto at = [&](int32_t point) { return mesh->positions[size_t(point)]; };
    if (HasNoArea(at(t[0]), at(t[1]), at(t[2]))) return 0;
    mesh->triangles.push_back(t);
    return 1;
  }

  const TriangleMesh& mesh_;
  std::array<int32_t, 3> corners_;  ///< the edge between the last two is the shortest
  DividedEdge left_, last_, right_;
  int rows_;
};

Scene Tessellate(const Scene& scene, float length, std::vector<int32_t>* source) {
  Scene fine;
  fine.materials = scene.materials;
  fine.parts = scene.parts;
  fine.lights = scene.lights;
  fine.camera = scene.camera;
  // Each part is cut by itself: no longer an instance.
  for (size_t part = 0; part < fine.parts.size(); ++part) fine.parts[part].meshId = int32_t(part);
  const TriangleMesh& mesh = scene.mesh;
  source->clear();
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const int count = FaceGrid(mesh, face, length).AppendTo(&fine.mesh);
    source->insert(source->end(), size_t(count), int32_t(face));
  }
  for (const int32_t face : *source) {
    fine.mesh.reflectance.push_back(mesh.reflectance[size_t(face)]);
    fine.mesh.emittance.push_back(mesh.emittance[size_t(face)]);
    fine.mesh.faceFlags.push_back(mesh.faceFlags[size_t(face)]);
    fine.mesh.materialId.push_back(mesh.materialId[size_t(face)]);
    fine.mesh.partId.push_back(mesh.partId[size_t(face)]);
    fine.mesh.sourceCellId.push_back(mesh.sourceCellId[size_t(face)]);
  }
  WeldPoints(&fine.mesh);
  return fine;
}

/// The centre line of a trefoil knot and its derivatives, 6 units across.
Vec3d Trefoil(double t) {
  return {std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)};
}
Vec3d TrefoilTangent(double t) {
  return {std::cos(t) + 4 * std::cos(2 * t), -std::sin(t) + 4 * std::sin(2 * t),
          -3 * std::cos(3 * t)};
}
Vec3d TrefoilBend(double t) {
  return {-std::sin(t) - 8 * std::sin(2 * t), -std::cos(t) + 8 * std::cos(2 * t),
          9 * std::sin(3 * t)};
}

/// A point of the tube, m: along and around in radians. The knot stands upright, its lowest point
/// above the floor.
Vec3d KnotPoint(double along, double around) {
  constexpr double kScale = 0.25, kRadius = 0.5, kWave = 0.12, kHeight = 1.1;
  const Vec3d tangent = Normalize(TrefoilTangent(along));
  const Vec3d binormal = Normalize(Cross(tangent, TrefoilBend(along)));
  const Vec3d normal = Cross(binormal, tangent);
  const double radius = kRadius * (1 + kWave * std::cos(24 * along) * std::cos(3 * around));
  const Vec3d p = Trefoil(along) + normal * (radius * std::cos(around)) +
                  binormal * (radius * std::sin(around));
  return p * kScale + Vec3d(0, kHeight, 0);
}

Vec3d KnotNormal(double along, double around) {
  constexpr double kStep = 1e-4;
  return Normalize(Cross(KnotPoint(along, around + kStep) - KnotPoint(along, around - kStep),
                         KnotPoint(along + kStep, around) - KnotPoint(along - kStep, around)));
}

/// Adds a rectangle that faces along edge x other edge.
void AddRectangle(const Vec3f& corner, const Vec3f& edge, const Vec3f& other, int32_t material,
                  Scene* scene) {
  TriangleMesh& mesh = scene->mesh;
  const int32_t first = int32_t(mesh.positions.size());
  for (const Vec3f& p : {corner, corner + edge, corner + edge + other, corner + other}) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(Normalize(Cross(edge, other)));
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.materialId.insert(mesh.materialId.end(), 2, material);
}

void AddKnot(int64_t triangles, int32_t material, Scene* scene) {
  // A grid around and along the tube whose cells are about as long as wide: it is 12 times as long.
  constexpr double kLengthOverGirth = 12;
  const int32_t around =
      std::max(3, int32_t(std::lround(std::sqrt(double(triangles) / 2 / kLengthOverGirth))));
  const int32_t along = std::max(3, int32_t(std::lround(double(triangles) / 2 / around)));
  TriangleMesh& mesh = scene->mesh;
  const int32_t first = int32_t(mesh.positions.size());
  for (int32_t i = 0; i < along; ++i) {
    for (int32_t j = 0; j < around; ++j) {
      const double u = 2 * kPi * i / along, v = 2 * kPi * j / around;
      mesh.positions.push_back(Vec3f(KnotPoint(u, v)));
      mesh.normals.push_back(Vec3f(KnotNormal(u, v)));
    }
  }
  for (int32_t i = 0; i < along; ++i) {
    for (int32_t j = 0; j < around; ++j) {
      const int32_t nextI = (i + 1) % along, nextJ = (j + 1) % around;
      const int32_t a = first + i * around + j, b = first + i * around + nextJ,
                    c = first + nextI * around + nextJ, d = first + nextI * around + j;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
      mesh.materialId.insert(mesh.materialId.end(), 2, material);
    }
  }
}

}  // namespace

BenchScene LoadBenchScene(const std::string& file, const SceneArguments& reading,
                          int64_t vertices) {
  SceneArguments one = reading;
  one.files = {file};
  RadiosityRunOptions options;
  one.Apply(&options);
  RadiosityRun run(options);
  run.Load();
  run.RequireLight();
  BenchScene bench;
  bench.name = std::filesystem::path(file).stem().string();
  bench.scene = run.GetScene();
  if (vertices > 0 && bench.scene.mesh.PointCount() < kCoarseVertices) {
    bench.coarse = std::move(bench.scene);
    bench.scene = TessellateRegularly(*bench.coarse, vertices, &bench.coarseFace);
  }
  return bench;
}

Scene TessellateRegularly(const Scene& scene, int64_t vertices, std::vector<int32_t>* source) {
  // The longest parts that give no fewer points than wanted.
  constexpr int kHalvings = 20;           // A part in a hundred thousand of the length.
  constexpr double kCertainlyEnough = 8;  // So many times the points before equal ones are joined.
  const auto isEnough = [&](float length) {
    double estimate = 0;
    for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
      estimate += FaceGrid(scene.mesh, face, length).PointEstimate();
    }
    return estimate > kCertainlyEnough * double(vertices) ||
           Tessellate(scene, length, source).mesh.PointCount() >= vertices;
  };
  const float diagonal = scene.mesh.Bounds().Diagonal();
  double shortest = std::log(1e-4 * diagonal), longest = std::log(diagonal);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (shortest + longest) / 2;
    (isEnough(float(std::exp(middle))) ? shortest : longest) = middle;
  }
  return Tessellate(scene, float(std::exp(shortest)), source);
}

Scene MakeKnotRoom(int64_t triangles) {
  enum Materials : int32_t { kWall, kKnot, kLamp };
  Scene scene;
  scene.materials.resize(3);
  scene.materials[kWall].name = "wall";
  scene.materials[kWall].reflectance = {0.7f, 0.68f, 0.62f};
  scene.materials[kKnot].name = "knot";
  scene.materials[kKnot].reflectance = {0.6f, 0.35f, 0.25f};
  scene.materials[kLamp].name = "lamp";
  scene.materials[kLamp].reflectance = Spectrum(0.5f);
  scene.materials[kLamp].emittance = {40, 37, 30};
  scene.parts.resize(1);
  scene.parts[0].name = "room with a knot";

  // Walls face inward, the lamp downward, the knot outward.
  AddRectangle({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, kWall, &scene);
  AddRectangle({-2, 3, -2}, {4, 0, 0}, {0, 0, 4}, kWall, &scene);
  AddRectangle({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, kWall, &scene);
  AddRectangle({-2, 0, 2}, {0, 3, 0}, {4, 0, 0}, kWall, &scene);
  AddRectangle({-2, 0, -2}, {0, 3, 0}, {0, 0, 4}, kWall, &scene);
  AddRectangle({2, 0, -2}, {0, 0, 4}, {0, 3, 0}, kWall, &scene);
  AddRectangle({-0.5f, 2.98f, -0.5f}, {1, 0, 0}, {0, 0, 1}, kLamp, &scene);
  AddKnot(triangles - scene.mesh.FaceCount(), kKnot, &scene);

  TriangleMesh& mesh = scene.mesh;
  for (const int32_t id : mesh.materialId) {
    mesh.reflectance.push_back(scene.materials[size_t(id)].reflectance);
    mesh.emittance.push_back(scene.materials[size_t(id)].emittance);
    mesh.faceFlags.push_back(id == kLamp ? uint8_t(kEmitsFront) : uint8_t(0));
  }
  mesh.Complete();
  return scene;
}

}  // namespace lambert
