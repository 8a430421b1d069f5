#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdio>

#include "Commands.h"
#include "Common/Core/Error.h"
#include "Common/Core/FileEnding.h"
#include "Common/Core/OutputFile.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"
#include "Display/vtkRadiosityImageWriter.h"
#include "Display/vtkRadiosityToneMapping.h"
#include "Engine/ComparedPointsFile.h"
#include "Engine/HtmlFile.h"
#include "Engine/LightMapFile.h"
#include "Engine/LitModelFile.h"
#include "Engine/ProbeFile.h"
#include "Engine/RunReport.h"
#include "Engine/SolutionFile.h"
#include "FilesOfRun.h"
#include "Interrupt.h"
#include "ProgressDisplay.h"
#include "Radiosity/Core/SolverState.h"
#include "Scene/vtkSceneAdapter.h"

namespace lambert {
namespace {

/// Everything that can be refused is refused before the solver's first second.
void CheckOutputs(const SolveArguments& arguments) {
  RequireWritable(arguments.Outputs());
  if (FileEnding(arguments.output) == ".html") RequireHtmlPage();
  if (!arguments.image.empty() && !vtkRadiosityImageWriter::IsDisplayAvailable()) {
    throw Error("Drawing a picture needs an X display and none answers: run under xvfb-run.");
  }
}

void WriteImage(const SolveArguments& arguments, const RadiosityRun& run) {
  vtkNew<vtkPolyData> data;
  PolyDataFromSolution(run.Solution(), run.GetScene(), data);
  vtkNew<vtkRadiosityImageWriter> writer;
  const auto size = arguments.ImageSize();
  writer->SetInputData(data);
  writer->SetSize(size[0], size[1]);
  writer->GetToneMapping()->SetOptions(arguments.tone);
  writer->SetDodgingAndBurning(arguments.dodgingAndBurning);
  if (!arguments.falseColors.empty()) {
    writer->SetFalseColors(arguments.falseColors == "lux"
                               ? vtkRadiosityImageWriter::LUX
                               : vtkRadiosityImageWriter::WATTS_PER_SQUARE_METRE);
    writer->SetFalseColorSteps(arguments.falseColorSteps);
    writer->SetIsolines(arguments.isolines);
  }
  if (!arguments.falseColorRange.empty()) {
    writer->SetFalseColorRange(arguments.falseColorRange[0], arguments.falseColorRange[1]);
  }
  writer->SetFileName(arguments.image.c_str());

  // The eye: as asked for, the file's, or one that the writer chooses.
  const UpAxis axis = arguments.UpOf(run.GetScene().mesh);
  const std::optional<Camera> asked = arguments.ImageCamera(axis);
  const std::optional<Camera> camera = asked ? asked : run.GetScene().camera;
  writer->SetUpAxis(static_cast<int>(axis));
  if (camera) {
    const Vec3d &p = camera->position, &f = camera->focalPoint, &up = camera->viewUp;
    writer->SetCamera(p.x, p.y, p.z, f.x, f.y, f.z);
    writer->SetViewUp(up.x, up.y, up.z);
    writer->SetViewAngle(camera->verticalFieldOfView);
  }
  writer->Write();
  if (writer->GetErrorCode() != 0) {
    throw Error("The picture " + arguments.image + " could not be written.");
  }
}

void ReadProbes(const SolveArguments& arguments, const RadiosityRun& run,
                const std::vector<ProbePoint>& points) {
  IrradianceProbeOptions options;
  options.forceGather = arguments.probeGather;
  const RayScene rays(run.GetScene().mesh);
  WriteProbeFile(arguments.probeOutput, points,
                 ReadIrradianceProbes(run.GetScene(), rays, run.Solution(), points, options));
}

/// The solution with its numbers, or the model that viewers draw.
void WriteLight(const SolveArguments& arguments, RadiosityRun* run) {
  if (!IsLitModelFileName(arguments.output)) {
    WriteSolution(run->Solution(), run->GetScene(), arguments.output, arguments.tone,
                  arguments.bothSides);
    return;
  }
  const UpAxis up = arguments.UpOf(run->GetScene().mesh);
  LitModelOptions options = arguments.model;
  options.tone = arguments.tone;
  options.texturesAtPoints = FileEnding(arguments.output) != ".obj";
  run->DrawModel(options, arguments.ImageCamera(up));
  WriteLitModel(*run->DrawnModel(), arguments.output);
}

/// An interrupt leaves it out.
void DrawLightMap(const SolveArguments& arguments, const ProgressCallback& progress,
                  ProgressDisplay* display, RadiosityRun* run) {
  display->Begin("light map");
  try {
    run->DrawLightMap(progress);
    if (run->Represented()) {
      WriteRepresentedScene(*run->Represented(), run->GetScene(), arguments.lightMap);
    } else {
      WriteLightMap(run->Atlas(), run->LaidScene(), run->Shown() ? &*run->Shown() : nullptr,
                    arguments.lightMap);
    }
    WritePages(*run->DrawnLightMap(), run->Solution(), arguments.tone, arguments.lightMap,
               arguments.pageFormats);
  } catch (const Cancelled&) {
    display->Say("Interrupted: no light map is written.");
  }
}

void WriteReport(const std::string& fileName, const RadiosityRun& run) {
  WriteOutput(fileName, RunReportJson(run, LAMBERT_VERSION) + '\n');
}

/// An interrupt leaves the error unmeasured; the report is written all the same.
void Verify(const SolveArguments& arguments, const ProgressCallback& progress,
            ProgressDisplay* display, RadiosityRun* run) {
  display->Begin("verifying");
  try {
    run->Verify(arguments.verifyPoints, progress);
  } catch (const Cancelled&) {
    display->Say("Interrupted: the error stays unmeasured.");
  }
}

/// Both meshes are measured where one is; an interrupt leaves the refined one.
void Simplify(const SolveArguments& arguments, const ProgressCallback& progress,
              ProgressDisplay* display, RadiosityRun* run) {
  if (arguments.verifyPoints > 0) Verify(arguments, progress, display, run);
  display->Begin("simplifying");
  try {
    run->Simplify(*arguments.simplification, progress);
  } catch (const Cancelled&) {
    display->Say("Interrupted: the mesh stays as it was refined.");
  }
}

void PrintSummary(const SolveArguments& arguments, const RadiosityRun& run) {
  const SolverStatistics& s = run.Statistics();
  const TriangleMesh& mesh = run.Solution().mesh;
  std::printf("%s: %lld triangles, %lld points\n", arguments.output.c_str(),
              static_cast<long long>(mesh.FaceCount()), static_cast<long long>(mesh.PointCount()));
  std::printf("stopped by %s after %zu iterations: %lld elements, %lld links, %lld rays\n",
              s.stoppedBy.c_str(), s.history.size(), static_cast<long long>(s.Elements()),
              static_cast<long long>(s.Links()), static_cast<long long>(s.rays));
  if (run.DrawnLightMap()) {
    const LightMap& map = *run.DrawnLightMap();
    std::printf(
        "%s: %zu charts on %d page(s) of %d texels, %g m each; seams %.2g %% rms, %.2g %% "
        "at most, from %.2g and %.2g\n",
        arguments.lightMap.c_str(), run.Atlas().set.charts.size(), run.Atlas().pages, map.pageSize,
        run.Atlas().texelSize, 100 * map.after.rms, 100 * map.after.largest, 100 * map.before.rms,
        100 * map.before.largest);
  }
  if (run.DrawnModel() && run.DrawnModel()->clippedPoints + run.DrawnModel()->clippedTexels > 0) {
    std::printf("brighter than the display: %lld points, %lld texels\n",
                static_cast<long long>(run.DrawnModel()->clippedPoints),
                static_cast<long long>(run.DrawnModel()->clippedTexels));
  }
  if (run.Simplification()) {
    std::printf("simplified from %lld triangles, %lld points\n",
                static_cast<long long>(run.Simplification()->trianglesBefore),
                static_cast<long long>(run.Simplification()->pointsBefore));
  }
  if (run.Error() && run.Error()->points > 0) {
    const SolutionError& e = *run.Error();
    std::printf("measured error: rms %.4f [%.4f, %.4f], bounded %.4f, bias %+.4f at %lld points\n",
                e.rms, e.rmsLow, e.rmsHigh, e.bounded, e.bias, static_cast<long long>(e.points));
  }
  std::printf("%.2f s, %.0f MB at most\n", SecondsSinceProcessStart(),
              double(PeakMemoryBytes()) / 1e6);
}

/// Runs `work` as a stage of the run, with its time.
template <class Work>
void Stage(const char* name, ProgressDisplay* display, RadiosityRun* run, const Work& work) {
  display->Begin(name);
  Timer timer;
  work();
  run->AddStage(name, timer.Seconds());
}

}  // namespace

int Solve(const SolveArguments& arguments) {
  // What can be refused at once.
  CheckOutputs(arguments);
  if (!arguments.solver.resume.empty()) RequireSolverState(arguments.solver.resume);
  const std::vector<ProbePoint> probes =
      arguments.probe.empty() ? std::vector<ProbePoint>() : ReadProbeFile(arguments.probe);
  SetThreadCount(arguments.threads);
  CatchInterrupt();
  ProgressDisplay display(arguments.progress);
  const ProgressCallback progress = [&](double fraction, const char* stage) {
    display.Update(fraction, stage);
    return !IsInterrupted();
  };

  // Scene, clusters, light.
  RadiosityRun run(arguments.RunOptions());
  display.Begin("reading");
  run.Load(progress);
  RequireUnread(arguments.Outputs(), run.Reading().companions);
  const UpAxis up = arguments.UpOf(run.GetScene().mesh);
  run.AddLights(arguments.lights.Lights(Vec3f(FromYUp({0, 1, 0}, up))));
  for (const std::string& warning : run.Warnings()) display.Say("warning: " + warning);
  run.RequireLight();
  if (arguments.method.method == SolveMethod::Hierarchical || !arguments.lightMap.empty()) {
    display.Begin("clustering");
  }
  run.Cluster(progress);
  display.Begin("solving");
  run.Solve(progress, IsInterrupted, [&](const IterationRecord& r) { display.EndIteration(r); });
  if (IsInterrupted()) display.Say("Interrupted: writing what has been solved.");

  // Outputs.
  if (!arguments.lightMap.empty() && !IsInterrupted()) {
    DrawLightMap(arguments, progress, &display, &run);
  }
  if (arguments.simplification && !IsInterrupted()) {
    Simplify(arguments, progress, &display, &run);
  }
  Stage("write", &display, &run, [&] { WriteLight(arguments, &run); });
  if (!arguments.probe.empty()) {
    Stage("probe", &display, &run, [&] { ReadProbes(arguments, run, probes); });
  }
  if (!arguments.image.empty()) {
    Stage("image", &display, &run, [&] { WriteImage(arguments, run); });
  }
  if (arguments.verifyPoints > 0 && !IsInterrupted()) Verify(arguments, progress, &display, &run);
  if (!arguments.verifyOutput.empty() && run.Error()) {
    WriteComparedPoints(arguments.verifyOutput, run.ComparedPoints());
  }
  if (!arguments.report.empty()) WriteReport(arguments.report, run);
  display.EndStage();
  display.Finish();
  PrintSummary(arguments, run);
  if (!run.Statistics().stateFailure.empty()) throw Error(run.Statistics().stateFailure);
  return 0;
}

}  // namespace lambert
