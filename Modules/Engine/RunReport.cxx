#include "RunReport.h"

#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"
#include "RadiosityRun.h"
#include "SceneSummary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

namespace lambert {
namespace {
using Json = nlohmann::ordered_json;

Json ToJson(const Spectrum& s) { return {s.r, s.g, s.b}; }
Json ToJson(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// File and material names may not be UTF-8: what is not is replaced.
std::string ToText(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace);
}

Json SceneJson(const RadiosityRun& run) {
  const SceneSummary s = SummarizeScene(run.GetScene());
  const ReadReport& reading = run.Reading();
  return {{"unit", reading.unit},
          {"metres_per_unit", reading.metresPerUnit},
          {"triangles", s.triangles},
          {"points", s.points},
          {"parts", s.parts},
          {"meshes", s.meshes},
          {"materials", s.materials},
          {"area_m2", s.area},
          {"bounds_low_m", ToJson(s.bounds.low)},
          {"bounds_high_m", ToJson(s.bounds.high)},
          {"diagonal_m", s.bounds.Diagonal()},
          {"emitting_faces", s.emittingFaces},
          {"lights",
           {{"point", s.pointLights},
            {"spot", s.spotLights},
            {"directional", s.directionalLights},
            {"sky", s.skies}}},
          {"emitted_by_faces_w", ToJson(s.emittedByFaces)},
          {"emitted_by_lights_w", ToJson(s.emittedByLights)}};
}

Json ReadingJson(const ReadReport& r) {
  return {{"faces", r.faces},
          {"polygons_triangulated", r.polygonsTriangulated},
          {"lines_and_points_ignored", r.linesAndPointsIgnored},
          {"materials_clamped", r.materialsClamped},
          {"transparent_materials", r.transparentMaterials},
          {"transparent_faces", r.transparentFaces},
          {"masked_materials", r.maskedMaterials},
          {"textures_missing", r.texturesMissing}};
}

Json CleaningJson(const CleaningReport& c) {
  return {{"points_welded", c.pointsWelded},
          {"zero_area_triangles", c.zeroAreaTriangles},
          {"repeated_triangles", c.repeatedTriangles},
          {"repeated_other_material", c.repeatedOtherMaterial},
          {"points_unused", c.pointsUnused},
          {"faces_rewound", c.facesRewound},
          {"non_orientable_pieces", c.nonOrientablePieces},
          {"inverted_emitters", c.invertedEmitters},
          {"non_manifold_edges", c.nonManifoldEdges},
          {"open_edges", c.openEdges},
          {"normals_made", c.normalsMade},
          {"normals_repaired", c.normalsRepaired},
          {"pieces", c.pieces}};
}

Json ClusteringJson(const FaceClusteringStatistics& c) {
  return {{"surfaces", c.surfaces},
          {"nodes", c.nodes},
          {"shared_trees", c.sharedTrees},
          {"non_manifold_edges", c.nonManifoldEdges},
          {"inconsistent_edges", c.inconsistentEdges},
          {"maximum_depth", c.maximumDepth},
          {"maximum_depth_over_log2", c.maximumDepthOverLog}};
}

Json LinksJson(const SolverStatistics& s) {
  return {{"total", s.Links()},          {"volume_volume", s.volumeVolume},
          {"volume_face", s.volumeFace}, {"volume_patch", s.volumePatch},
          {"face_face", s.faceFace},     {"face_patch", s.facePatch},
          {"patch_patch", s.patchPatch}, {"from_lights", s.fromLights},
          {"at_floor", s.linksAtFloor}};
}

Json HistoryJson(const SolverStatistics& s) {
  Json history = Json::array();
  for (const IterationRecord& record : s.history) {
    history.push_back({{"iteration", record.iteration},
                       {"seconds", record.seconds},
                       {"threshold", record.threshold},
                       {"elements", record.elements},
                       {"links", record.links},
                       {"rays", record.rays},
                       {"change", record.change},
                       {"error", record.error < 0 ? Json() : Json(record.error)}});
  }
  return history;
}

Json ErrorJson(const SolutionError& e) {
  return {{"rms", e.rms},         {"rms_low", e.rmsLow}, {"rms_high", e.rmsHigh},
          {"bounded", e.bounded}, {"bias", e.bias},      {"percentile_95", e.percentile95},
          {"points", e.points}};
}

Json MethodJson(const RadiosityRunOptions& options) {
  Json method = {{"name", TraitsOf(options.method.method).name}};
  if (options.method.method == SolveMethod::Hierarchical) {
    method["error"] = options.solver.error;
    method["time"] = options.timeLimit;
    method["max_memory"] = options.solver.memoryLimit;
    method["iterations"] = options.solver.iterations;
    method["final_gather"] = options.solver.finalGather;
    method["oracle"] = OracleName(options.solver.oracle);
    method["schedule"] = ScheduleName(options.solver.schedule);
    method["refinement"] = RefinementName(options.solver.leafMesh.refinement);
    if (!options.solver.resume.empty()) method["resume"] = options.solver.resume;
  }
  for (const auto& [name, value] : ValuesOf(options.method)) {
    method[name] = value == std::floor(value) ? Json(static_cast<int64_t>(value)) : Json(value);
  }
  return method;
}

Json SecondsJson(const RadiosityRun& run) {
  Json seconds;
  for (const auto& [name, value] : run.Stages()) {
    seconds[name] = value;
  }
  seconds["total"] = SecondsSinceProcessStart();
  return seconds;
}

void AddSceneAndCleanUp(const RadiosityRun& run, Json* report) {
  (*report)["files"] = run.Options().files;
  (*report)["scene"] = SceneJson(run);
  (*report)["reading"] = ReadingJson(run.Reading());
  (*report)["clean_up"] = CleaningJson(run.Cleaning());
  (*report)["warnings"] = run.Warnings();
}
/// How surfaces show their light, and what either way costs, those with the most introduced
/// triangles first.
Json RepresentationJson(const RadiosityRun& run) {
  const RepresentedScene& represented = *run.Represented();
  const TriangleMesh& mesh = run.GetScene().mesh;
  std::vector<size_t> order(represented.surfaces.size()), faceOf(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return represented.surfaces[a].Introduced() > represented.surfaces[b].Introduced();
  });
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    faceOf[static_cast<size_t>(mesh.surfaceId[face])] = face;
  }
  Json surfaces = Json::array();
  for (const size_t surface : order) {
    const SurfaceCost& cost = represented.surfaces[surface];
    const size_t face = faceOf[static_cast<size_t>(cost.surface)];
    const auto material = static_cast<size_t>(mesh.materialId[face]);
    const auto part = static_cast<size_t>(mesh.partId[face]);
    const bool isMapped = cost.chosen == Representation::LightMap;
    surfaces.push_back({{"surface", cost.surface},
                        {"side", cost.side == kFront ? "front" : "back"},
                        {"material", run.GetScene().materials[material].name},
                        {"part", run.GetScene().parts[part].name},
                        {"chosen", isMapped ? "lightmap" : "points"},
                        {"input_triangles", cost.inputTriangles},
                        {"refined_triangles", cost.refinedTriangles},
                        {"area_m2", cost.area},
                        {"error_of_input_points", cost.inputPointError},
                        {"texels", cost.texels < 0 ? Json() : Json(cost.texels)},
                        {"error_of_light_map", cost.mapError < 0 ? Json() : Json(cost.mapError)}});
  }
  return {{"triangles", represented.mapped.mesh.FaceCount() + represented.points.mesh.FaceCount()},
          {"light_mapped", represented.mapped.tree.surfaceRoots.size()},
          {"surfaces", surfaces}};
}
}  // namespace

std::string SceneReportJson(const RadiosityRun& run) {
  Json report;
  AddSceneAndCleanUp(run, &report);
  return ToText(report);
}

std::string RunReportJson(const RadiosityRun& run, const std::string& version) {
  // What went in.
  Json report;
  report["lambert"] = version;
  AddSceneAndCleanUp(run, &report);
  const bool isHierarchical = run.Options().method.method == SolveMethod::Hierarchical;
  if (isHierarchical) {
    report["clustering"] = ClusteringJson(run.Clustering());
  }

  // What it cost.
  const SolverStatistics& s = run.Statistics();
  report["threads"] = ThreadCount();
  report["seconds"] = SecondsJson(run);
  for (const auto& [stage, seconds] : run.Statistics().stages.All()) {
    report["seconds_of_solve"][stage] = seconds;
  }
  report["peak_memory_bytes"] = PeakMemoryBytes();

  // How the light came about.
  report["method"] = MethodJson(run.Options());
  if (isHierarchical) {
    report["requested_error"] = run.Options().solver.error;
  }
  report["stopped_by"] = s.stoppedBy;
  report["iterations"] = s.history.size();
  report["elements"] = {{"total", s.Elements()},
                        {"volume", s.volumeElements},
                        {"face", s.faceElements},
                        {"patch", s.patchElements}};
  report["links"] = LinksJson(s);
  report["rays"] = s.rays;
  if (!s.emitted.IsBlack()) {
    report["energy_w"] = {{"emitted", ToJson(s.emitted)},
                          {"absorbed", ToJson(s.absorbed)},
                          {"escaped", ToJson(s.escaped)}};
    if (isHierarchical) report["energy_w"]["covered"] = ToJson(s.covered);
  }
  report["history"] = HistoryJson(s);

  // What came out.
  if (run.DrawnLightMap()) {
    const LightMap& map = *run.DrawnLightMap();
    const auto seams = [](const SeamDifference& d) {
      return Json{{"rms", d.rms}, {"largest", d.largest}};
    };
    report["light_map"] = {
        {"charts", run.Atlas().set.charts.size()}, {"pages", run.Atlas().pages},
        {"page_size_texels", map.pageSize},        {"texel_size_m", run.Atlas().texelSize},
        {"utilisation", run.Atlas().utilisation},  {"covered_texels", map.coveredTexels},
        {"seam_points", map.seamPoints},           {"seams_before", seams(map.before)},
        {"seams_after", seams(map.after)}};
  }
  if (run.Represented()) report["representation"] = RepresentationJson(run);
  if (run.DrawnModel()) {
    const LitModel& model = *run.DrawnModel();
    report["lit_model"] = {{"meshes", model.meshes.size()},
                           {"images", model.images.size()},
                           {"baked_texels", model.bakedTexels},
                           {"clipped_points", model.clippedPoints},
                           {"clipped_texels", model.clippedTexels}};
  }
  if (run.Simplification()) {
    const LitMeshSimplificationStatistics& simplification = *run.Simplification();
    report["simplification"] = {{"triangles_before", simplification.trianglesBefore},
                                {"triangles_after", simplification.trianglesAfter},
                                {"points_before", simplification.pointsBefore},
                                {"points_after", simplification.pointsAfter}};
    if (run.RefinedError() && run.RefinedError()->points > 0) {
      report["simplification"]["error_before"] = ErrorJson(*run.RefinedError());
    }
  }
  report["output"] = {{"triangles", run.Solution().mesh.FaceCount()},
                      {"points", run.Solution().mesh.PointCount()}};
  if (run.Error()) {
    report["error"] = run.Error()->points > 0 ? ErrorJson(*run.Error()) : Json();
  }
  return ToText(report);
}
}  // namespace lambert
