// Irradiance straight from the light sources at a point: closed form over the emitting polygons,
// rays in proportion to what they give.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "Common/Core/Random.h"
#include "Common/Core/SphericalTriangle.h"
#include "Radiosity/Core/EmittingPolygons.h"
#include "Scene/Core/LightSource.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// A place where light is gathered: the normal that irradiance is for, and the geometric normal
/// whose hemisphere can see light.
struct GatherPoint {
  Vec3f position;
  Vec3f normal;
  Vec3f geometricNormal;
  float area = 0;  ///< m2 that it stands for: points of more get more rays; 0 where all are alike
};

/// What a number of rays found.
struct DirectSample {
  Spectrum irradiance;    ///< W/m2
  Spectrum fromEmitters;  ///< of it, from emitting faces, W/m2
  /// Mean square of what a ray to them brings, all being 1 where nothing is in the way and each
  /// brings as much.
  float squares = 1;
  float clear = 1;  ///< part of the rays that nothing was in the way of
  float unoccluded =
      0;  ///< mean of the bands with nothing in the way; of groups at most that, W/m2
  bool isScattered =
      false;  ///< much of it comes from groups of emitters, of which rays picked some
};

/// All emitting polygons and the samples of lights without geometry; over a tree of the polygons:
/// from a point, groups of them that look small are taken as one.
class DirectLight {
 public:
  /// Both by reference.
  DirectLight(const Scene& scene, const RayScene& rayScene);

  /// The lights without geometry.
  const LightSources& Lights() const { return lights_; }
  /// Irradiance at a point, W/m2, with `count` rays to all emitting polygons together, [1, inf),
  /// and at most as many to each light; where nothing is in the way of one its light is exact with
  /// any number. It depends on the point, the count and the seed alone. More rays that are cast
  /// only where these find something bring too little light to places that little of it reaches.
  /// Adds the rays cast to `rays`.
  DirectSample Sample(const GatherPoint& at, int count, uint64_t seed, int64_t* rays) const;

 private:
  struct Emitter {
    EmittingPolygon polygon;
    Vec3f center;
    float size = 0;   ///< largest, m
    float power = 0;  ///< W, mean of the bands
    /// Part of the area of the first triangles of its fan, with each.
    std::array<float, EmittingPolygon::kMostCorners - 2> upTo{};

    explicit Emitter(const EmittingPolygon& polygon);
    Vec3f Place(float u, float v) const;
  };
  /// The directions to a polygon near by.
  struct Fan {
    std::array<SphericalTriangle, EmittingPolygon::kMostCorners - 2> triangles;
    std::array<float, EmittingPolygon::kMostCorners> cornerCosine;  ///< to the corners, above 0
    /// Of the first triangles with each, solid angle times cosine.
    std::array<float, EmittingPolygon::kMostCorners - 2> upTo;
    float solidAngle = 0;  ///< sr

    Fan(const EmittingPolygon& polygon, const GatherPoint& at);
  };
  /// A polygon as seen from a point.
  struct PolygonView {
    const Emitter& emitter;
    const GatherPoint& at;
    bool areAlike = false;   ///< all places on it give alike
    std::optional<Fan> fan;  ///< places are chosen by direction; else by area

    PolygonView(const Emitter& emitter, const GatherPoint& at);
    bool PickPlace(const Vec2f& uv, int rays, Random* random, Vec3f* target, float* value) const;
    bool PickAnother(int tried, Random* random, Vec3f* target, float* value) const;
    Vec3f Place(const Vec2f& uv, float* given) const;
    Vec3f PlaceInDirection(const Vec2f& uv, float* density) const;
  };
  struct Node {
    Vec3f center;
    float radius = 0;
    Vec3f axis;                      ///< unit, mean of the normals below; zero where they have none
    float cosCone = 1, sinCone = 0;  ///< of the largest angle between a normal below and the axis
    float power = 0;
    int32_t begin = 0, end = 0;  ///< emitters below
    int32_t second = -1;         ///< second child; the first follows its parent; -1: a leaf
  };
  /// A part of the emitters as seen from a point: a polygon whose light is known exactly, or a
  /// group.
  struct Source {
    int32_t node;
    Spectrum exact;    ///< irradiance with nothing in the way; of a polygon
    float weight = 0;  ///< by which rays are dealt out
  };
  static constexpr int kMostSources = 24;

  int32_t Build(int32_t begin, int32_t end);
  int Sources(const GatherPoint& at, Source* sources) const;
  Source Weigh(int32_t node, const GatherPoint& at) const;
  Source PickPolygon(const Source& source, const GatherPoint& at, float* u, float* chance) const;
  Spectrum CastRays(const GatherPoint& at, const Source* sources, int count, float total, int rays,
                    uint64_t seed, int* clear, double* squares) const;
  DirectSample FromEmitters(const GatherPoint& at, int rays, uint64_t seed, int64_t* cast) const;
  Spectrum FromLights(const GatherPoint& at, int count, uint64_t seed, int64_t* rays) const;

  const RayScene& rayScene_;
  LightSources lights_;
  std::vector<Emitter> emitters_;
  std::vector<Node> nodes_;
};

}  // namespace lambert
