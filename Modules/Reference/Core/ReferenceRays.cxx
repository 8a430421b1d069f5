#include "Reference/Core/ReferenceRays.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cstring>
#include <limits>

#include "Common/Core/Error.h"
#include "Scene/Core/DoubledFaces.h"

namespace lambert {

struct ReferenceRays::Implementation {
  explicit Implementation(const TriangleMesh& mesh_) : mesh(mesh_), doubled(mesh_) {}
  ~Implementation() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Vec3f Origin(const ReferenceVertex& at) const { return at.position + at.geometric * lift; }

  const TriangleMesh& mesh;
  const DoubledFaces doubled;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float nearest = 0;  ///< a parallel face nearer than this does not block, m
  float lift = 0;     ///< rays start this far above their face, against rounding alone, m
};

namespace {

RTCRay MakeRay(const Vec3f& from, const Vec3f& direction, float tfar) {
  RTCRay ray{};
  ray.org_x = from.x, ray.org_y = from.y, ray.org_z = from.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tfar = tfar;
  ray.mask = ~0u;
  return ray;
}

/// The start of a ray, for the filter of its hits.
struct RayContext {
  RTCIntersectContext embree;
  Vec3f plane;  ///< unit normal of the surface that the ray leaves
  float nearest;

  RayContext(const Vec3f& plane_, float nearest_) : plane(plane_), nearest(nearest_) {
    rtcInitIntersectContext(&embree);
  }
};

/// Cosine of the angle (8 degrees) within which a face counts as parallel to the start's plane.
constexpr float kParallel = 0.99f;

/// Lets rays pass the faces that lie at no distance upon the surface that they leave. A wall that
/// rises from it blocks however near it is, or light would leak along the edges of rooms.
void PassCoincidentFaces(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<const RayContext*>(arguments->context);
  if (RTCRayN_tfar(arguments->ray, 1, 0) >= context.nearest) return;
  const Vec3f normal(RTCHitN_Ng_x(arguments->hit, 1, 0), RTCHitN_Ng_y(arguments->hit, 1, 0),
                     RTCHitN_Ng_z(arguments->hit, 1, 0));
  const float cosine = Dot(normal, context.plane);
  if (cosine * cosine > kParallel * kParallel * LengthSquared(normal)) arguments->valid[0] = 0;
}

RTCGeometry MakeGeometry(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* points = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Vec3f), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, 3 * sizeof(int32_t), mesh.triangles.size());
  std::memcpy(points, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
  rtcSetGeometryIntersectFilterFunction(geometry, PassCoincidentFaces);
  rtcSetGeometryOccludedFilterFunction(geometry, PassCoincidentFaces);
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace

ReferenceRays::ReferenceRays(const TriangleMesh& mesh) : implementation_(new Implementation(mesh)) {
  Implementation& self = *implementation_;
  const Box3f bounds = mesh.Bounds();
  if (!bounds.IsEmpty()) {
    const Vec3f far = Max(Max(bounds.high, -bounds.high), Max(bounds.low, -bounds.low));
    self.nearest = 1e-5f * bounds.Diagonal();
    self.lift = 4 * std::numeric_limits<float>::epsilon() * std::max(far.x, std::max(far.y, far.z));
  }
  self.device = rtcNewDevice(nullptr);
  if (!self.device) throw Error("The ray tracer (Embree) could not be started on this processor.");
  self.scene = rtcNewScene(self.device);
  rtcSetSceneFlags(self.scene, RTC_SCENE_FLAG_ROBUST);
  if (mesh.FaceCount() > 0) {
    RTCGeometry geometry = MakeGeometry(self.device, mesh);
    rtcAttachGeometry(self.scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(self.scene);
}

ReferenceRays::~ReferenceRays() = default;

float ReferenceRays::Nearest() const { return implementation_->nearest; }

bool ReferenceRays::Blocked(const ReferenceVertex& at, const Vec3f& direction,
                            float distance) const {
  const Implementation& self = *implementation_;
  const float end = distance - self.nearest;
  if (!(end > self.nearest)) return false;
  RTCRay ray = MakeRay(self.Origin(at), direction, end);
  RayContext context(at.geometric, self.nearest);
  rtcOccluded1(self.scene, &context.embree, &ray);
  return ray.tfar < 0;
}

bool ReferenceRays::Closest(const ReferenceVertex& at, const Vec3f& direction,
                            ReferenceHit* hit) const {
  const Implementation& self = *implementation_;
  RTCRayHit query;
  query.ray = MakeRay(self.Origin(at), direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RayContext context(at.geometric, self.nearest);
  rtcIntersect1(self.scene, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

  // The place by barycentrics, which lies on the face more exactly than a point along the ray.
  hit->face = int32_t(query.hit.primID);
  hit->distance = query.ray.tfar;
  Vec3f front = self.mesh.FrontNormal(hit->face);
  hit->side = Dot(front, direction) < 0 ? kFront : kBack;
  Vec2f b(query.hit.u, query.hit.v);
  if (self.doubled.IsHidden(hit->face, hit->side)) {
    // Of doubled faces the one that is seen from here.
    const DoubledFaces::Place twin = self.doubled.OnTwin({hit->face, b});
    hit->face = twin.face;
    b = twin.barycentric;
    front = self.mesh.FrontNormal(hit->face);
    hit->side = Dot(front, direction) < 0 ? kFront : kBack;
  }
  hit->vertex.position = self.mesh.Corner(hit->face, 0) * (1 - b.x - b.y) +
                         self.mesh.Corner(hit->face, 1) * b.x +
                         self.mesh.Corner(hit->face, 2) * b.y;
  hit->vertex.normal = hit->vertex.geometric = hit->side == kFront ? front : -front;
  return true;
}

FlushDenormals::FlushDenormals() : state_(_mm_getcsr()) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}
FlushDenormals::~FlushDenormals() { _mm_setcsr(state_); }

}  // namespace lambert
