#include "Display/Core/DefaultCamera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "Common/Core/Random.h"
#include "Display/Core/RegularSplit.h"

namespace lambert {
namespace {

constexpr int kCells = 64;               ///< along the longest side of the bounds
constexpr double kRoomFieldOfView = 65;  ///< degrees; a room asks for a wide view

/// Surfaces and their brightness in a coarse grid: enough to tell a room from an object and to find
/// a place to stand.
class BrightnessGrid {
 public:
  BrightnessGrid(const TriangleMesh& mesh, const std::vector<Spectrum>& radiosity)
      : bounds_(mesh.Bounds()) {
    const Vec3f extent = bounds_.Extent();
    cell_ = std::max({extent.x, extent.y, extent.z}) / kCells;
    for (int axis = 0; axis < 3; ++axis) {
      cells_[size_t(axis)] = std::max(1, int(std::ceil(extent[axis] / cell_)));
    }
    const size_t count = size_t(cells_[0]) * size_t(cells_[1]) * size_t(cells_[2]);
    area_.assign(count, 0);
    light_.assign(count, 0);
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) Rasterize(mesh, radiosity, face);
    FindUsualBrightness();
  }

  const Box3f& Bounds() const { return bounds_; }
  float CellSize() const { return cell_; }
  bool Contains(const Vec3f& p) const { return Index(p) >= 0; }
  bool IsFree(const Vec3f& p) const { return Index(p) >= 0 && area_[size_t(Index(p))] == 0; }

  /// Median brightness of what is lit; 1 where nothing is.
  float UsualBrightness() const { return usual_; }

  /// What a ray meets first.
  struct View {
    bool escaped = true;
    float distance = 0;
    float brightness = 0;
  };
  View Look(const Vec3f& from, const Vec3f& direction) const {
    View view;
    const float step = cell_ * 0.5f;
    for (view.distance = step;; view.distance += step) {
      const int64_t index = Index(from + direction * view.distance);
      if (index < 0) return view;
      if (area_[size_t(index)] > 0) {
        view.escaped = false;
        view.brightness = light_[size_t(index)] / area_[size_t(index)];
        return view;
      }
    }
  }

 private:
  int64_t Index(const Vec3f& p) const {
    int64_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const float at = p[axis] - bounds_.low[axis];
      if (!(at >= 0) || at > cells_[size_t(axis)] * cell_) return -1;
      const int64_t cell = std::min<int64_t>(int64_t(at / cell_), cells_[size_t(axis)] - 1);
      index = index * cells_[size_t(axis)] + cell;
    }
    return index;
  }

  /// Drops the face's area and light at places spread over it, two to a cell's width.
  void Rasterize(const TriangleMesh& mesh, const std::vector<Spectrum>& radiosity, int64_t face) {
    const auto& t = mesh.triangles[size_t(face)];
    const Vec3f &a = mesh.Corner(face, 0), &b = mesh.Corner(face, 1), &c = mesh.Corner(face, 2);
    const float longest = std::max({Length(b - a), Length(c - b), Length(a - c)});
    const int n = std::max(1, int(std::ceil(2 * longest / cell_)));
    const float share = std::max(mesh.Area(face), cell_ * cell_ * 1e-6f) / float(n * n);
    const float light = (Luminance(radiosity[size_t(t[0])]) + Luminance(radiosity[size_t(t[1])]) +
                         Luminance(radiosity[size_t(t[2])])) /
                        3;
    ForEachMiddleOfSplit(n, [&](const Vec2f& place) {
      const int64_t index = Index(PlaceOnTriangle(a, b, c, place));
      if (index < 0) return;
      area_[size_t(index)] += share;
      light_[size_t(index)] += share * light;
    });
  }

  void FindUsualBrightness() {
    std::vector<float> lit;
    for (size_t i = 0; i < area_.size(); ++i) {
      if (light_[i] > 0) lit.push_back(light_[i] / area_[i]);
    }
    if (lit.empty()) return;
    std::nth_element(lit.begin(), lit.begin() + std::ptrdiff_t(lit.size() / 2), lit.end());
    usual_ = lit[lit.size() / 2];
  }

  Box3f bounds_;
  float cell_ = 1, usual_ = 1;
  std::array<int, 3> cells_{1, 1, 1};
  std::vector<float> area_, light_;
};

/// Place `t` in [0,1]^3 of the bounds.
Vec3f PlaceIn(const Box3f& bounds, const Vec3f& t) {
  const Vec3f e = bounds.Extent();
  return bounds.low + Vec3f(e.x * t.x, e.y * t.y, e.z * t.z);
}

/// Fraction of rays within `minimumCosine` of `axis` that leave the scene, from a place in it.
double OpenFraction(const BrightnessGrid& grid, const Vec3f& from, const Vec3f& axis,
                    float minimumCosine) {
  constexpr int kRays = 2048;
  int rays = 0, open = 0;
  Random random(1);
  for (int i = 0; i < kRays; ++i) {
    const float z = 1 - 2 * random.Uniform(), angle = float(2 * kPi) * random.Uniform();
    const float r = std::sqrt(std::max(0.f, 1 - z * z));
    const Vec3f d{r * std::cos(angle), r * std::sin(angle), z};
    if (Dot(d, axis) < minimumCosine) continue;
    ++rays;
    open += grid.Look(from, d).escaped;
  }
  return rays ? double(open) / rays : 0;
}

/// How much there is to see: depth and light, each bounded so that neither a lamp nor a corridor
/// decides alone. What is near or dark speaks against a view.
double ViewScore(const BrightnessGrid& grid, const Vec3f& eye, const Vec3f& forward,
                 double aspect) {
  constexpr int kRows = 7, kColumns = 9;
  const float halfHeight = float(std::tan(kRoomFieldOfView * kPi / 360));
  const Vec3f right = Normalize(Cross(forward, Vec3f(0, 1, 0))), up = Cross(right, forward);
  const float usual = grid.UsualBrightness(), diagonal = grid.Bounds().Diagonal();
  double score = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const float u = (2 * (float(column) + 0.5f) / kColumns - 1) * halfHeight * float(aspect);
      const float v = (2 * (float(row) + 0.5f) / kRows - 1) * halfHeight;
      const auto view = grid.Look(eye, Normalize(forward + right * u + up * v));
      if (view.escaped) continue;
      const double light = view.brightness / (view.brightness + usual);
      const double depth = std::min(0.5, double(view.distance / diagonal));
      score += light < 0.1 || view.distance < 4 * grid.CellSize() ? -0.1 : light * depth;
    }
  }
  return score;
}

/// `height` is that of the eye, as a part of the scene's.
Camera ViewFromWithin(const BrightnessGrid& grid, double aspect, float height) {
  const Vec3f extent = grid.Bounds().Extent();
  constexpr int kPlaces = 12, kDirections = 16;
  Camera best;
  best.verticalFieldOfView = kRoomFieldOfView;
  best.position = Vec3d(grid.Bounds().Center());
  best.focalPoint =
      best.position + Vec3d(extent.x >= extent.z ? 1 : 0, 0, extent.x >= extent.z ? 0 : 1);
  double bestScore = 0;
  for (int place = 0; place < kPlaces * kPlaces; ++place) {
    const Vec3f eye = PlaceIn(grid.Bounds(), {(float(place % kPlaces) + 0.5f) / kPlaces, height,
                                              (float(place / kPlaces) + 0.5f) / kPlaces});
    const float step = 1.5f * grid.CellSize();
    if (!grid.IsFree(eye) || !grid.IsFree(eye + Vec3f(step, 0, 0)) ||
        !grid.IsFree(eye - Vec3f(step, 0, 0)) || !grid.IsFree(eye + Vec3f(0, 0, step)) ||
        !grid.IsFree(eye - Vec3f(0, 0, step))) {
      continue;
    }
    for (int k = 0; k < kDirections; ++k) {
      const float angle = float(2 * kPi) * float(k) / kDirections;
      const Vec3f forward = Normalize(Vec3f(std::sin(angle), -0.12f, -std::cos(angle)));
      const double score = ViewScore(grid, eye, forward, aspect);
      if (score > bestScore) {
        bestScore = score;
        best.position = Vec3d(eye);
        best.focalPoint = Vec3d(eye + forward * (0.25f * grid.Bounds().Diagonal()));
      }
    }
  }
  return best;
}

/// A ball of `radius` about the middle of the bounds fills the view, seen from outside along
/// `direction`. before its middle.
Camera FramingView(const Box3f& bounds, const Vec3f& direction, double radius, double aspect) {
  Camera camera;
  const double half = camera.verticalFieldOfView * kPi / 360;
  const double narrow = std::min(half, std::atan(std::tan(half) * aspect));
  camera.focalPoint = Vec3d(bounds.Center());
  camera.position = camera.focalPoint + Vec3d(direction) * (radius / std::sin(narrow));
  if (std::abs(direction.y) > 0.99f) camera.viewUp = {0, 0, -1};
  return camera;
}

/// The view of a mesh whose +y is up.
Camera ViewWithYUp(const TriangleMesh& mesh, const std::vector<Spectrum>& radiosity,
                   double aspectRatio) {
  const Box3f bounds = mesh.Bounds();
  if (mesh.triangles.empty() || !(bounds.Diagonal() > 0)) return {};
  const BrightnessGrid grid(mesh, radiosity);

  // Which of the six sides are open, seen from the middle.
  constexpr float kConeCosine =
      0.87f;  // A side of a cube is seen within some 35 to 45 degrees; 30 leaves a frame.
  const std::array<Vec3f, 6> axes{Vec3f(0, 0, 1),  Vec3f(0, 0, -1), Vec3f(1, 0, 0),
                                  Vec3f(-1, 0, 0), Vec3f(0, 1, 0),  Vec3f(0, -1, 0)};
  std::vector<Vec3f> openSides;
  for (const Vec3f& axis : axes) {
    if (OpenFraction(grid, bounds.Center(), axis, kConeCosine) > 0.8) openSides.push_back(axis);
  }

  // Within a room or in one under an upper storey without a roof, through an open side, or at an
  // object.
  constexpr float kEyeHeight = 0.55f, kLowerEyeHeight = 0.25f;
  const Vec3f up{0, 1, 0}, lower = PlaceIn(bounds, {0.5f, kLowerEyeHeight, 0.5f});
  if (openSides.empty() && OpenFraction(grid, bounds.Center(), up, -1) < 0.3) {
    return ViewFromWithin(grid, aspectRatio, kEyeHeight);
  }
  if (openSides.size() == 1 && openSides[0].y > 0 &&
      OpenFraction(grid, lower, up, kConeCosine) < 0.5) {
    return ViewFromWithin(grid, aspectRatio, kLowerEyeHeight);
  }
  if (openSides.size() == 1 && openSides[0].y == 0) {
    const Vec3f side = openSides[0], extent = bounds.Extent();
    const float width = side.x != 0 ? extent.z : extent.x,
                depth = side.x != 0 ? extent.x : extent.z;
    const double radius = 0.5 * std::max(double(extent.y), width / aspectRatio) * 1.05;
    Camera camera = FramingView(bounds, side, radius, aspectRatio);
    camera.position += Vec3d(side) * double(depth / 2);
    return camera;
  }
  return FramingView(bounds, Normalize(Vec3f(0.35f, 0.5f, 1)), bounds.Diagonal() / 2, aspectRatio);
}

}  // namespace

Camera DefaultCamera(const TriangleMesh& mesh, const std::vector<Spectrum>& radiosity,
                     double aspectRatio, UpAxis up) {
  if (up == UpAxis::Y) return ViewWithYUp(mesh, radiosity, aspectRatio);

  // Turn the mesh, find the view, turn that back.
  TriangleMesh turned;
  turned.triangles = mesh.triangles;
  for (const Vec3f& p : mesh.positions) turned.positions.emplace_back(ToYUp(Vec3d(p), up));
  Camera camera = ViewWithYUp(turned, radiosity, aspectRatio);
  camera.position = FromYUp(camera.position, up);
  camera.focalPoint = FromYUp(camera.focalPoint, up);
  camera.viewUp = FromYUp(camera.viewUp, up);
  return camera;
}

}  // namespace lambert
