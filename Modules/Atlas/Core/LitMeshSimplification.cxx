#include "Atlas/Core/LitMeshSimplification.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "Atlas/Core/SurfaceSubset.h"
#include "Common/Core/Error.h"

namespace lambert {

namespace {

/// A surface moves by less than this, a fraction of the diagonal: the floor of elements.
constexpr double kFloor = 1e-6;
/// Height over longest edge of the slimmest triangle that is made, but for those that were as slim.
constexpr double kSlimmest = 0.05;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using Halfedges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<Halfedges>;

/// What lies in one face of the solved mesh of the triangles about a place that goes. Points are
/// those of the solution: two surfaces that meet there have their own.
struct Fan {
  int64_t key = 0;                           ///< of the face and its side
  int32_t from = -1, to = -1;                ///< point that goes, and that which takes over
  std::vector<int32_t> triangles;            ///< of the halfedges, that will have another corner
  std::vector<std::array<int32_t, 2>> rims;  ///< of each: its other corners, counter-clockwise
  std::vector<int32_t> ring;                 ///< all points about, but for `to`
  std::array<double, 2> deviation{};         ///< of both lights, largest so far, W/m2
  bool isJoined = true;                      ///< its triangles share their points
};

double LargestBand(const Spectrum& light) {
  return std::max({std::abs(light.r), std::abs(light.g), std::abs(light.b)});
}

Spectrum Mix(const Spectrum& a, const Spectrum& b, double t) {
  return a * float(1 - t) + b * float(t);
}

/// Height over longest edge.
double Slimness(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double longest =
      std::max({LengthSquared(b - a), LengthSquared(c - b), LengthSquared(a - c)});
  return longest > 0 ? Length(Cross(b - a, c - a)) / longest : 0;
}

/// The plane of a face without the axis that it faces most.
struct Plane {
  int u = 0, v = 1;

  explicit Plane(const Vec3d& normal) {
    const Vec3d n(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    if (n.x >= n.y && n.x >= n.z) {
      u = 1, v = 2;
    } else if (n.y >= n.z) {
      u = 0, v = 2;
    }
  }
  double Cross(const Vec3d& a, const Vec3d& b) const { return a[u] * b[v] - a[v] * b[u]; }
};

/// Over the area, W/m2, of the bands' mean: what the light of dark places counts against.
double MeanLight(const TriangleMesh& mesh, const std::vector<Spectrum>& light) {
  double power = 0, area = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    for (const int32_t corner : mesh.triangles[size_t(face)]) {
      power += double(mesh.Area(face)) * double(light[size_t(corner)].Mean()) / 3;
    }
    area += double(mesh.Area(face));
  }
  return area > 0 ? power / area : 0;
}

/// The light of a mesh as points are taken out of it, and how far it is from what it was.
class SimplifiedLight {
 public:
  SimplifiedLight(const RadiositySolution& solution, double tolerance);

  Halfedges halfedges;
  std::vector<int32_t> faceOf;                  ///< per face of the halfedges: that of the solution
  std::vector<std::array<int32_t, 3>> corners;  ///< of each: its points now
  std::vector<int32_t> apart;                   ///< faces of the solution that no manifold takes

  /// What becomes of the fans about `ci.v0` when `ci.v1` takes its place: with deviations as they
  /// will be. None where the surface would move or turn, or light change too much.
  std::optional<std::vector<Fan>> Replaced(const CollapseInfo& ci) const;
  /// Deviation over what is allowed, the largest; and short edges first.
  double Cost(const CollapseInfo& ci, const std::vector<Fan>& fans) const;
  void Accept(const std::vector<Fan>& fans) {
    for (const Fan& fan : fans) {
      for (const int32_t triangle : fan.triangles) {
        deviation_[size_t(triangle)] = fan.deviation;
        auto& points = corners[size_t(triangle)];
        std::replace(points.begin(), points.end(), fan.from, fan.to);
      }
    }
  }

 private:
  void Weld();
  void AddFaces();
  void LockSeams();
  int64_t Key(Halfedges::FaceHandle face) const {
    if (!face.is_valid()) return -1;
    const size_t f = size_t(faceOf[size_t(face.idx())]);
    return 2 * solution_.inputFaceId[f] + solution_.side[f];
  }
  Vec3d At(int32_t point) const { return Vec3d(solution_.mesh.positions[size_t(point)]); }
  Vec3d Where(Halfedges::VertexHandle place) const {
    const OpenMesh::Vec3d& p = halfedges.point(place);
    return {p[0], p[1], p[2]};
  }
  /// The point that a face has at a place.
  int32_t PointAt(Halfedges::FaceHandle face, Halfedges::VertexHandle place) const {
    for (const int32_t point : corners[size_t(face.idx())]) {
      if (placeOf_[size_t(point)] == place.idx()) return point;
    }
    return -1;
  }
  bool IsOnStraightBorder(const CollapseInfo& ci) const;
  std::vector<Fan> FansAbout(const CollapseInfo& ci) const;
  bool KeepsItsShape(const Fan& fan) const;
  double Change(const Fan& fan, const std::vector<Spectrum>& light) const;
  double Allowed(const Fan& fan, size_t kind) const;

  const RadiositySolution& solution_;
  const double tolerance_, diagonal_;
  const std::array<const std::vector<Spectrum>*, 2> lights_;  ///< irradiance and radiosity
  std::array<double, 2> meanLight_;                           ///< W/m2
  std::vector<int32_t> placeOf_;  ///< per point of the solution: vertex of the halfedges
  std::vector<std::array<double, 2>> deviation_;  ///< per face of the halfedges, W/m2
};

SimplifiedLight::SimplifiedLight(const RadiositySolution& solution, double tolerance)
    : solution_(solution),
      tolerance_(tolerance),
      diagonal_(double(solution.mesh.Bounds().Diagonal())),
      lights_{&solution.irradiance, &solution.radiosity},
      meanLight_{MeanLight(solution.mesh, solution.irradiance),
                 MeanLight(solution.mesh, solution.radiosity)} {
  Weld();
  AddFaces();
  LockSeams();
}

/// One vertex for all points of one side at a place: borders of surfaces are simplified together.
void SimplifiedLight::Weld() {
  const TriangleMesh& mesh = solution_.mesh;
  std::vector<uint8_t> side(mesh.positions.size(), kFront);
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    for (const int32_t point : mesh.triangles[face]) side[size_t(point)] = solution_.side[face];
  }
  std::map<std::tuple<uint8_t, float, float, float>, int32_t> places;
  for (size_t point = 0; point < mesh.positions.size(); ++point) {
    const Vec3f& p = mesh.positions[point];
    const auto [place, isNew] = places.try_emplace({side[point], p.x, p.y, p.z}, -1);
    if (isNew) place->second = halfedges.add_vertex({p.x, p.y, p.z}).idx();
    placeOf_.push_back(place->second);
  }
}

/// Half-edges of what is manifold; OpenMesh would print what is not.
void SimplifiedLight::AddFaces() {
  omerr().disable();
  for (int32_t face = 0; face < int32_t(solution_.mesh.FaceCount()); ++face) {
    const auto& t = solution_.mesh.triangles[size_t(face)];
    std::array<Halfedges::VertexHandle, 3> v;
    for (size_t c = 0; c < 3; ++c) v[c] = Halfedges::VertexHandle(placeOf_[size_t(t[c])]);
    const bool isFlat = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    if (!isFlat && halfedges.add_face(v[0], v[1], v[2]).is_valid()) {
      faceOf.push_back(face);
      corners.push_back(t);
    } else {
      apart.push_back(face);
    }
  }
  omerr().enable();
  deviation_.assign(faceOf.size(), {});
}

/// Places on a border that another border lies on stay, and all that other triangles hold.
void SimplifiedLight::LockSeams() {
  std::map<std::array<double, 3>, std::vector<Halfedges::VertexHandle>> borders;
  for (const auto place : halfedges.vertices()) {
    const OpenMesh::Vec3d& p = halfedges.point(place);
    if (halfedges.is_boundary(place)) borders[{p[0], p[1], p[2]}].push_back(place);
  }
  for (const auto& border : borders) {
    if (border.second.size() < 2) continue;
    for (const auto place : border.second) halfedges.status(place).set_locked(true);
  }
  for (const int32_t face : apart) {
    for (const int32_t point : solution_.mesh.triangles[size_t(face)]) {
      halfedges.status(Halfedges::VertexHandle(placeOf_[size_t(point)])).set_locked(true);
    }
  }
}

/// True where v0 lies inside one face, or on a straight line from v1 on between two or along a free
/// edge.
bool SimplifiedLight::IsOnStraightBorder(const CollapseInfo& ci) const {
  int borders = 0;
  bool isAlong = false;
  Vec3d before;
  for (const auto spoke : halfedges.voh_range(ci.v0)) {
    const auto opposite = halfedges.opposite_halfedge_handle(spoke);
    if (Key(halfedges.face_handle(spoke)) == Key(halfedges.face_handle(opposite))) continue;
    ++borders;
    const auto end = halfedges.to_vertex_handle(spoke);
    if (end == ci.v1) {
      isAlong = true;
    } else {
      before = Where(end);
    }
  }
  if (borders == 0) return true;
  if (borders != 2 || !isAlong) return false;
  const Vec3d p = Where(ci.v0), line = Where(ci.v1) - before;
  return Dot(p - before, line) > 0 && Dot(Where(ci.v1) - p, line) > 0 &&
         Length(Cross(p - before, line)) <= kFloor * diagonal_ * Length(line);
}

std::vector<Fan> SimplifiedLight::FansAbout(const CollapseInfo& ci) const {
  std::vector<Fan> fans;
  for (const auto spoke : halfedges.voh_range(ci.v0)) {
    const auto face = halfedges.face_handle(spoke);
    if (!face.is_valid()) continue;
    const int64_t key = Key(face);
    auto fan = std::find_if(fans.begin(), fans.end(), [&](const Fan& f) { return f.key == key; });
    if (fan == fans.end()) {
      fan = fans.insert(fans.end(), Fan());
      fan->key = key;
    }
    for (size_t kind = 0; kind < 2; ++kind) {
      fan->deviation[kind] = std::max(fan->deviation[kind], deviation_[size_t(face.idx())][kind]);
    }

    // Its points, which the triangles of the fan share.
    const auto first = halfedges.to_vertex_handle(spoke);
    const auto second = halfedges.to_vertex_handle(halfedges.next_halfedge_handle(spoke));
    const int32_t a = PointAt(face, first), b = PointAt(face, second);
    for (const int32_t point : {a, b, PointAt(face, ci.v0)}) {
      const int32_t place = placeOf_[size_t(point)];
      int32_t* known = place == ci.v0.idx()   ? &fan->from
                       : place == ci.v1.idx() ? &fan->to
                                              : nullptr;
      for (int32_t& other : fan->ring) {
        if (placeOf_[size_t(other)] == place) known = &other;
      }
      if (!known) fan->ring.push_back(point);
      if (known && *known < 0) *known = point;
      if (known && *known != point) fan->isJoined = false;
    }
    if (face == ci.fl || face == ci.fr) continue;
    fan->triangles.push_back(face.idx());
    fan->rims.push_back({a, b});
  }
  return fans;
}

/// No triangle of the fan turns over or becomes a sliver.
bool SimplifiedLight::KeepsItsShape(const Fan& fan) const {
  const Vec3d from = At(fan.from), to = At(fan.to);
  double slimmest = kSlimmest;
  for (const auto& [a, b] : fan.rims) slimmest = std::min(slimmest, Slimness(from, At(a), At(b)));
  for (const auto& [a, b] : fan.rims) {
    const Vec3d before = Cross(At(a) - from, At(b) - from), after = Cross(At(a) - to, At(b) - to);
    if (Dot(before, after) <= 0 || Slimness(to, At(a), At(b)) < slimmest) return false;
  }
  return !fan.rims.empty();
}

/// The most by which light changes in the fan, W/m2, when `to` takes the place of `from`: it is
/// linear between their edges, so that it is at the point that goes, or where an edge that it had
/// crosses one that comes.
double SimplifiedLight::Change(const Fan& fan, const std::vector<Spectrum>& light) const {
  const auto lightAt = [&](int32_t point) -> const Spectrum& { return light[size_t(point)]; };
  const int32_t from = fan.from, to = fan.to;
  const Vec3d p = At(from), q = At(to);
  const Plane plane(Cross(At(fan.rims[0][0]) - p, At(fan.rims[0][1]) - p));

  // At the point that goes: in the new triangle that it lies in.
  double deepest = -1, change = 0;
  for (const auto& [a, b] : fan.rims) {
    const Vec3d u = At(a) - q, v = At(b) - q;
    const double s = plane.Cross(p - q, v) / plane.Cross(u, v);
    const double t = plane.Cross(u, p - q) / plane.Cross(u, v);
    const double depth = std::min({s, t, 1 - s - t});
    if (depth <= deepest) continue;
    deepest = depth;
    change = LargestBand(lightAt(to) * float(1 - s - t) + lightAt(a) * float(s) +
                         lightAt(b) * float(t) - lightAt(from));
  }

  // Where edges cross.
  for (const int32_t i : fan.ring) {
    for (const int32_t j : fan.ring) {
      const Vec3d u = At(i) - p, v = At(j) - q;
      const double area = plane.Cross(u, v);
      if (i == j || area == 0) continue;
      const double s = plane.Cross(q - p, v) / area, t = plane.Cross(q - p, u) / area;
      if (s < 0 || s > 1 || t < 0 || t > 1) continue;
      change = std::max(
          change, LargestBand(Mix(lightAt(to), lightAt(j), t) - Mix(lightAt(from), lightAt(i), s)));
    }
  }
  return change;
}

/// W/m2: of the darkest corner that the fan will have.
double SimplifiedLight::Allowed(const Fan& fan, size_t kind) const {
  const std::vector<Spectrum>& light = *lights_[kind];
  double darkest = double(light[size_t(fan.to)].Mean());
  for (const int32_t point : fan.ring) {
    darkest = std::min(darkest, double(light[size_t(point)].Mean()));
  }
  return tolerance_ * std::max(darkest, meanLight_[kind]);
}

std::optional<std::vector<Fan>> SimplifiedLight::Replaced(const CollapseInfo& ci) const {
  if (!IsOnStraightBorder(ci)) return {};
  std::vector<Fan> fans = FansAbout(ci);
  for (Fan& fan : fans) {
    if (!fan.isJoined || fan.to < 0 || !KeepsItsShape(fan)) return {};
    for (size_t kind = 0; kind < 2; ++kind) {
      fan.deviation[kind] += Change(fan, *lights_[kind]);
      if (!(fan.deviation[kind] <= Allowed(fan, kind))) return {};
    }
  }
  return fans;
}

double SimplifiedLight::Cost(const CollapseInfo& ci, const std::vector<Fan>& fans) const {
  double cost = 0;
  for (const Fan& fan : fans) {
    for (size_t kind = 0; kind < 2; ++kind) {
      const double deviation = fan.deviation[kind];
      if (deviation > 0) cost = std::max(cost, deviation / Allowed(fan, kind));
    }
  }
  return cost + Length(Where(ci.v1) - Where(ci.v0)) / diagonal_;
}

/// Lets OpenMesh's decimater ask what a collapse does to the light.
template <class MeshT>
class ModLight : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(ModLight, MeshT, Light);

  explicit ModLight(MeshT& mesh) : Base(mesh, false) {}
  void SetLight(SimplifiedLight* light) { light_ = light; }

  float collapse_priority(const CollapseInfo& ci) override {
    const auto fans = light_->Replaced(ci);
    return fans ? float(light_->Cost(ci, *fans)) : float(Base::ILLEGAL_COLLAPSE);
  }
  void preprocess_collapse(const CollapseInfo& ci) override {
    light_->Accept(light_->Replaced(ci).value());
  }

 private:
  SimplifiedLight* light_ = nullptr;
};

/// Tells how far the decimation is, and ends it.
class Watch : public OpenMesh::Decimater::Observer {
 public:
  Watch(const ProgressCallback& progress, size_t points)
      : Observer(1024), progress_(progress), points_(double(points)) {}
  void notify(size_t removed) override {
    isCancelled = !Report(progress_, double(removed) / points_, "simplifying");
  }
  bool abort() const override { return isCancelled; }

  bool isCancelled = false;

 private:
  const ProgressCallback& progress_;
  double points_;
};

/// `solution` with the corners that its triangles have now; those that are left.
RadiositySolution WhatIsLeft(const RadiositySolution& solution, const SimplifiedLight& light) {
  RadiositySolution turned = solution;
  std::vector<int64_t> faces(light.apart.begin(), light.apart.end());
  for (const auto face : light.halfedges.faces()) {
    const int32_t old = light.faceOf[size_t(face.idx())];
    if (light.halfedges.status(face).deleted()) continue;
    faces.push_back(old);
    turned.mesh.triangles[size_t(old)] = light.corners[size_t(face.idx())];
  }
  std::sort(faces.begin(), faces.end());
  turned.leafId.clear();  // A triangle spans several now.
  return TakeTriangles(turned, faces);
}

}  // namespace

RadiositySolution SimplifyLitMesh(const RadiositySolution& solution,
                                  const LitMeshSimplificationOptions& options,
                                  LitMeshSimplificationStatistics* statistics,
                                  const ProgressCallback& progress) {
  if (!(options.tolerance > 0 && options.tolerance <= 1)) {
    throw Error("The tolerance of simplified light is a fraction above 0 and up to 1.");
  }

  // Collapse edges, those that change light least first.
  SimplifiedLight light(solution, options.tolerance);
  OpenMesh::Decimater::DecimaterT<Halfedges> decimater(light.halfedges);
  ModLight<Halfedges>::Handle module;
  decimater.add(module);
  decimater.module(module).SetLight(&light);
  Watch watch(progress, solution.mesh.positions.size());
  decimater.set_observer(&watch);
  decimater.initialize();
  decimater.decimate();
  if (watch.isCancelled) throw Cancelled();

  // What is left.
  RadiositySolution simplified = WhatIsLeft(solution, light);
  if (statistics) {
    statistics->trianglesBefore = solution.mesh.FaceCount();
    statistics->trianglesAfter = simplified.mesh.FaceCount();
    statistics->pointsBefore = solution.mesh.PointCount();
    statistics->pointsAfter = simplified.mesh.PointCount();
  }
  return simplified;
}

}  // namespace lambert
