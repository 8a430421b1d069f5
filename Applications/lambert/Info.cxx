#include <cstdio>

#include "Commands.h"
#include "Engine/RunReport.h"
#include "Engine/SceneSummary.h"

namespace lambert {
namespace {

void PrintCount(const char* name, int64_t count) {
  if (count) std::printf("  %-28s %lld\n", name, static_cast<long long>(count));
}

void PrintScene(const SceneSummary& s, const ReadReport& reading) {
  const Vec3f low = s.bounds.low, high = s.bounds.high, size = s.bounds.Extent();
  std::printf("unit       1 %s = %g m\n", reading.unit.c_str(), reading.metresPerUnit);
  std::printf("triangles  %lld\npoints     %lld\nparts      %lld of %lld meshes\nmaterials  %lld\n",
              static_cast<long long>(s.triangles), static_cast<long long>(s.points),
              static_cast<long long>(s.parts), static_cast<long long>(s.meshes),
              static_cast<long long>(s.materials));
  std::printf("bounds     %g %g %g to %g %g %g m\nsize       %g x %g x %g m, area %g m2\n", low.x,
              low.y, low.z, high.x, high.y, high.z, size.x, size.y, size.z, s.area);
}

void PrintLight(const SceneSummary& s) {
  const Spectrum &f = s.emittedByFaces, &l = s.emittedByLights;
  std::printf("emitting   %lld triangles, %g %g %g W\n", static_cast<long long>(s.emittingFaces),
              f.r, f.g, f.b);
  std::printf(
      "lights     %lld point, %lld spot, %lld directional, %lld sky; point and spot %g %g %g W\n",
      static_cast<long long>(s.pointLights), static_cast<long long>(s.spotLights),
      static_cast<long long>(s.directionalLights), static_cast<long long>(s.skies), l.r, l.g, l.b);
}

void PrintMaterials(const std::vector<Material>& materials) {
  std::printf("material                       reflectance             exitance W/m2\n");
  for (const Material& m : materials) {
    const Spectrum &r = m.reflectance, &e = m.emittance;
    std::printf("  %-28s %.3f %.3f %.3f", m.name.c_str(), r.r, r.g, r.b);
    if (!e.IsBlack())
      std::printf("       %g %g %g%s", e.r, e.g, e.b, m.twoSidedEmitter ? ", both sides" : "");
    std::printf("\n");
  }
}

void PrintChanges(const ReadReport& r, const CleaningReport& c) {
  std::printf("read and changed\n");
  PrintCount("polygons triangulated", r.polygonsTriangulated);
  PrintCount("lines and points ignored", r.linesAndPointsIgnored);
  PrintCount("materials clamped to 0.98", r.materialsClamped);
  PrintCount("transparent materials", r.transparentMaterials);
  PrintCount("transparent faces left out", r.transparentFaces);
  PrintCount("masked materials", r.maskedMaterials);
  PrintCount("textures missing", r.texturesMissing);
  PrintCount("points welded", c.pointsWelded);
  PrintCount("zero-area triangles", c.zeroAreaTriangles);
  PrintCount("repeated triangles", c.repeatedTriangles);
  PrintCount("of these, other material", c.repeatedOtherMaterial);
  PrintCount("points of no face", c.pointsUnused);
  PrintCount("faces rewound", c.facesRewound);
  PrintCount("non-orientable pieces", c.nonOrientablePieces);
  PrintCount("inverted emitters", c.invertedEmitters);
  PrintCount("non-manifold edges", c.nonManifoldEdges);
  PrintCount("open edges", c.openEdges);
  PrintCount("normals made", c.normalsMade);
  PrintCount("normals repaired", c.normalsRepaired);
  PrintCount("connected pieces", c.pieces);
}

}  // namespace

int Info(const InfoArguments& arguments) {
  RadiosityRunOptions options;
  arguments.scene.Apply(&options);
  RadiosityRun run(options);
  run.Load();
  if (arguments.json) {
    std::printf("%s\n", SceneReportJson(run).c_str());
    return 0;
  }
  const SceneSummary summary = SummarizeScene(run.GetScene());
  PrintScene(summary, run.Reading());
  PrintLight(summary);
  PrintMaterials(run.GetScene().materials);
  PrintChanges(run.Reading(), run.Cleaning());
  for (const std::string& warning : run.Warnings()) std::printf("warning: %s\n", warning.c_str());
  return 0;
}

}  // namespace lambert
