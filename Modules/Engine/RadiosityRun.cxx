#include "RadiosityRun.h"

#include "Common/Core/Error.h"
#include "Common/Core/Timer.h"
#include "Scene/vtkSceneLoader.h"

#include <algorithm>

namespace lambert {
namespace {
/// Seconds to write an output triangle, an upper figure: some 250 bytes, compressed.
constexpr double kWriteSecondsPerTriangle = 2e-6;
/// Iterations grow by about this factor where only one has been seen.
constexpr double kUsualGrowth = 3;
/// The reserve for reconstruction and writing over what was measured: the mesh grows until the end.
constexpr double kReserveFactor = 1.5;
/// Share of the time spent so far that may go into measuring what the output costs.
constexpr double kMeasuringShare = 0.1;

/// Decides after every iteration whether another one and the output fit into the time limit.
class TimeBudget {
 public:
  TimeBudget(double limit, double fixedSeconds) : Limit(limit), FixedSeconds(fixedSeconds) {}

  bool NextFits(const IterationRecord& record, const HierarchicalRadiosity& solver) {
    if (this->Limit <= 0) {
      return true;
    }
    this->MeasureOutput(record, solver);
    const double iteration = record.seconds - this->LastEnd;
    const double growth = this->LastIteration > 0
                              ? std::min(8., std::max(1., iteration / this->LastIteration))
                              : kUsualGrowth;
    this->LastEnd = record.seconds;
    this->LastIteration = iteration;
    return SecondsSinceProcessStart() + growth * iteration + this->FixedSeconds +
               kReserveFactor * this->OutputSeconds <
           this->Limit;
  }

 private:
  /// Reconstructs once and again while that is cheap beside the solving.
  void MeasureOutput(const IterationRecord& record, const HierarchicalRadiosity& solver) {
    if (this->OutputSeconds > kMeasuringShare * record.seconds) {
      return;
    }
    const Timer timer;
    const RadiositySolution solution = solver.Solution();
    this->OutputSeconds =
        timer.Seconds() + kWriteSecondsPerTriangle * static_cast<double>(solution.mesh.FaceCount());
  }

  double Limit, FixedSeconds;
  double LastEnd = 0, LastIteration = 0, OutputSeconds = 0;
};

bool IsTooLargeOrSmall(const Scene& scene) {
  const float diagonal = scene.mesh.Bounds().Diagonal();
  return !scene.lights.empty() && (diagonal > 1000 || diagonal < 0.01f);
}
}  // namespace

RadiosityRun::RadiosityRun(const RadiosityRunOptions& options) : options_(options) {}

RadiosityRun::~RadiosityRun() = default;

void RadiosityRun::AddStage(const std::string& name, double seconds) {
  this->stages_.emplace_back(name, seconds);
}

void RadiosityRun::Load(const ProgressCallback& progress) {
  // Files to one clean mesh.
  Timer timer;
  this->scene_ = LoadScene(this->options_.files, this->options_.reader, this->options_.cleaning,
                           this->options_.settings, &this->reading_, &this->cleaning_, progress);

  // The sky that was asked for.
  if (this->options_.sky) {
    Light sky;
    sky.type = LightType::Sky;
    sky.name = "sky";
    sky.intensity = *this->options_.sky;
    this->scene_.lights.push_back(sky);
  }
  this->AddStage("load", timer.Seconds());
}

void RadiosityRun::RequireLight() const {
  if (!this->scene_.HasLight()) {
    throw lambert::Error(
        "The scene has no light: no face emits and no lamp is given; add one with --sky R G B or "
        "--set MATERIAL:emission=R,G,B.");
  }
}

void RadiosityRun::Cluster(const ProgressCallback& progress) {
  Timer timer;
  this->tree_ = ClusterFaces(&this->scene_.mesh, this->scene_.parts, this->options_.clustering,
                             &this->clustering_, progress);
  this->AddStage("cluster", timer.Seconds());
}

void RadiosityRun::Solve(const ProgressCallback& progress, const std::function<bool()>& interrupted,
                         const std::function<void(const IterationRecord&)>& observer) {
  // Iterate. The clock and the user end a run at the border of an iteration only.
  Timer timer;
  TimeBudget budget(this->options_.timeLimit, this->options_.outputSeconds);
  std::string stoppedBy;
  HierarchicalRadiosity solver(this->scene_, this->tree_, this->options_.solver);
  solver.Run(
      [&](double fraction, const char* stage) {
        Report(progress, fraction, stage);
        return true;
      },
      [&](const IterationRecord& record) {
        if (observer) {
          observer(record);
        }
        if (interrupted && interrupted()) {
          stoppedBy = "interrupt";
        } else if (!budget.NextFits(record, solver)) {
          stoppedBy = "time";
        }
        return stoppedBy.empty();
      });
  this->AddStage("solve", timer.Seconds());

  // Reconstruct.
  timer.Restart();
  this->solution_ = solver.Solution();
  this->statistics_ = solver.Statistics();
  if (!stoppedBy.empty()) {
    this->statistics_.stoppedBy = stoppedBy;
  }
  this->AddStage("reconstruct", timer.Seconds());
}

void RadiosityRun::Verify(int points, const ProgressCallback& progress) {
  Timer timer;
  SolutionErrorOptions options;
  options.points = points;
  this->error_ = MeasureSolutionError(this->scene_, this->solution_, options, progress);
  this->AddStage("verify", timer.Seconds());
}

std::vector<std::string> RadiosityRun::Warnings() const {
  std::vector<std::string> warnings = this->reading_.warnings;
  warnings.insert(warnings.end(), this->cleaning_.warnings.begin(), this->cleaning_.warnings.end());
  if (IsTooLargeOrSmall(this->scene_)) {
    warnings.push_back("The scene measures " +
                       std::to_string(this->scene_.mesh.Bounds().Diagonal()) +
                       " m across and has lamps of given intensity; --unit may be wanted.");
  }
  if (this->error_ && this->error_->rmsHigh - this->error_->rmsLow > 0.3 * this->error_->rms) {
    warnings.push_back(
        "The interval of the measured error is wider than 30 % of it; the bounded error counts.");
  }
  return warnings;
}
}  // namespace lambert
