#include "Visibility/Core/RayScene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "Common/Core/Error.h"
#include "Scene/Core/DoubledFaces.h"

namespace lambert {

struct RayScene::Implementation {
  explicit Implementation(const TriangleMesh& mesh) : doubled(mesh) {}

  const DoubledFaces doubled;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float diagonal = 0;
  float epsilon = 0;
  float lift = 0;  ///< rays start this far above a surface that they leave, against rounding, m

  bool Blocks(const Vec3f& from, const Vec3f& direction, float nearest, float farthest) const;
  RTCRayHit Cast(const Vec3f& from, const Vec3f& direction, float nearest, float farthest) const;
  bool LiesUpon(const RTCRayHit& hit, const RayStart& start) const;
  RayHit HitOf(const RTCRayHit& found, const Vec3f& direction) const;
  Vec3f Above(const RayStart& start) const { return start.position + start.normal * lift; }

  ~Implementation() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

/// Cosine of the angle (8 degrees) within which a face counts as parallel to a surface.
constexpr float kParallel = 0.99f;
constexpr float kFar = std::numeric_limits<float>::infinity();

RTCRay MakeRay(const Vec3f& from, const Vec3f& direction, float tnear, float tfar) {
  RTCRay ray;
  ray.org_x = from.x, ray.org_y = from.y, ray.org_z = from.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = tnear, ray.tfar = tfar;
  ray.time = 0, ray.mask = ~0u, ray.id = 0, ray.flags = 0;
  return ray;
}

}  // namespace

RayScene::RayScene(const TriangleMesh& mesh) : implementation_(new Implementation(mesh)) {
  Implementation& self = *implementation_;
  self.diagonal = mesh.Bounds().IsEmpty() ? 0 : mesh.Bounds().Diagonal();
  self.epsilon = 1e-5f * self.diagonal;
  if (self.diagonal > 0) {
    const Box3f bounds = mesh.Bounds();
    const Vec3f far = Max(Max(bounds.high, -bounds.high), Max(bounds.low, -bounds.low));
    self.lift = 4 * std::numeric_limits<float>::epsilon() * std::max(far.x, std::max(far.y, far.z));
  }
  self.device = rtcNewDevice(nullptr);
  if (!self.device) throw Error("The ray tracer (Embree) could not be started on this processor.");
  self.scene = rtcNewScene(self.device);
  rtcSetSceneFlags(self.scene, RTC_SCENE_FLAG_ROBUST);

  // One geometry with all faces.
  RTCGeometry geometry = rtcNewGeometry(self.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (mesh.FaceCount() > 0) {
    void* points = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3f), mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, 3 * sizeof(int32_t),
                               mesh.triangles.size());
    std::memcpy(points, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(self.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(self.scene);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

float RayScene::Epsilon() const { return implementation_->epsilon; }
float RayScene::Diagonal() const { return implementation_->diagonal; }

bool RayScene::Occluded(const Vec3f& from, const Vec3f& to) const {
  const Vec3f offset = to - from;
  const float distance = Length(offset);
  return Occluded(from, offset / distance, distance);
}

bool RayScene::Implementation::Blocks(const Vec3f& from, const Vec3f& direction, float nearest,
                                      float farthest) const {
  RTCRay ray = MakeRay(from, direction, nearest, farthest);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0;
}

bool RayScene::Occluded(const Vec3f& from, const Vec3f& unitDirection, float distance) const {
  const float epsilon = implementation_->epsilon;
  if (!(distance > 2 * epsilon)) return false;
  return implementation_->Blocks(from, unitDirection, epsilon, distance - epsilon);
}

bool RayScene::Occluded(const RayStart& from, const Vec3f& to) const {
  const Vec3f offset = to - from.position;
  const float distance = Length(offset);
  return Occluded(from, offset / distance, distance);
}

bool RayScene::Occluded(const RayStart& from, const Vec3f& unitDirection, float distance) const {
  const Implementation& self = *implementation_;
  const float end = distance - self.epsilon;
  if (!(end > self.epsilon)) return false;
  const Vec3f above = self.Above(from);
  if (!self.Blocks(above, unitDirection, 0, end)) return false;

  // What blocks may lie upon the surface.
  const RTCRayHit near = self.Cast(above, unitDirection, 0, self.epsilon);
  return !self.LiesUpon(near, from) || self.Blocks(above, unitDirection, self.epsilon, end);
}

void RayScene::Occluded(const Segment* segments, int count, uint8_t* occluded) const {
  for (int i = 0; i < count; ++i) occluded[i] = Occluded(segments[i].from, segments[i].to) ? 1 : 0;
}

bool RayScene::OccludedDirection(const Vec3f& from, const Vec3f& direction) const {
  return Occluded(from, Normalize(direction), std::numeric_limits<float>::infinity());
}

RTCRayHit RayScene::Implementation::Cast(const Vec3f& from, const Vec3f& direction, float nearest,
                                         float farthest) const {
  RTCRayHit query;
  query.ray = MakeRay(from, direction, nearest, farthest);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
  return query;
}

bool RayScene::Implementation::LiesUpon(const RTCRayHit& hit, const RayStart& start) const {
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID || !(hit.ray.tfar < epsilon)) return false;
  const Vec3f normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
  const float cosine = Dot(normal, start.normal);
  return cosine * cosine > kParallel * kParallel * LengthSquared(normal);
}

RayHit RayScene::Closest(const Vec3f& from, const Vec3f& unitDirection) const {
  const Implementation& self = *implementation_;
  return self.HitOf(self.Cast(from, unitDirection, self.epsilon, kFar), unitDirection);
}

RayHit RayScene::Closest(const RayStart& from, const Vec3f& unitDirection) const {
  const Implementation& self = *implementation_;
  const Vec3f above = self.Above(from);
  RTCRayHit found = self.Cast(above, unitDirection, 0, kFar);
  if (self.LiesUpon(found, from)) found = self.Cast(above, unitDirection, self.epsilon, kFar);
  return self.HitOf(found, unitDirection);
}

bool RayScene::OccludedNear(const RayStart& from, const Vec3f& unitDirection) const {
  const Implementation& self = *implementation_;
  return self.Blocks(self.Above(from), unitDirection, 0, self.epsilon);
}

RayHit RayScene::Implementation::HitOf(const RTCRayHit& found, const Vec3f& direction) const {
  RayHit hit;
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.face = int32_t(found.hit.primID);
  hit.distance = found.ray.tfar;
  hit.barycentric = {found.hit.u, found.hit.v};
  hit.front = Normalize(Vec3f(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z));

  // Of doubled faces the one that is seen from here.
  const Side side = Dot(hit.front, direction) < 0 ? kFront : kBack;
  if (doubled.IsHidden(hit.face, side)) {
    const DoubledFaces::Place twin = doubled.OnTwin({hit.face, hit.barycentric});
    const bool isReversed = doubled.IsReversed(hit.face);
    hit.face = twin.face;
    hit.barycentric = twin.barycentric;
    if (isReversed) hit.front = -hit.front;
  }
  return hit;
}

std::vector<int32_t> RayScene::FacesNear(const Vec3f& point, float radius) const {
  std::vector<int32_t> faces;
  RTCPointQuery query;
  query.x = point.x, query.y = point.y, query.z = point.z;
  query.time = 0, query.radius = radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto collect = [](RTCPointQueryFunctionArguments* found) {
    static_cast<std::vector<int32_t>*>(found->userPtr)->push_back(int32_t(found->primID));
    return false;  // the radius stays as it is
  };
  rtcPointQuery(implementation_->scene, &query, &context, collect, &faces);
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace lambert
