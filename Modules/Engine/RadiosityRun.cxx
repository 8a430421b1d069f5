#include "RadiosityRun.h"

#include "Atlas/Core/TexelDensity.h"
#include "AtlasFile.h"
#include "Common/Core/Error.h"
#include "Common/Core/Timer.h"
#include "Scene/Core/SceneLimits.h"
#include "Scene/vtkSceneLoader.h"

#include <algorithm>

namespace lambert {
namespace {
/// Seconds to write an output triangle, an upper figure: some 250 bytes, compressed.
constexpr double kWriteSecondsPerTriangle = 2e-6;
/// Links, and with them the time of an iteration, grow by about this factor; at most by the other.
constexpr double kUsualGrowth = 3, kLargestGrowth = 4;
/// The reserve for the output over what is predicted: other work of the machine, uneven rays.
constexpr double kReserveFactor = 1.3;
/// Share of the time limit that a reconstruction may be predicted to take to be made for measuring.
constexpr double kMeasuringShare = 0.1;
/// Seconds of reconstruction for a link before enough links were there to measure it: an upper
/// figure of two threads.
constexpr double kUsualSecondsPerLink = 4e-6;
constexpr double kLinksToMeasure = 2e4;
/// Verification takes up to so many times its usual paths where those do not decide.
constexpr int kVerificationGrowth = 4;

/// Decides after every iteration whether another one and the output fit into the time limit.
/// Reconstruction takes a time for the mesh and a time for every link; both are measured.
class TimeBudget {
 public:
  /// `history` is of the run that this one goes on from, whose last iteration is heard of again.
  TimeBudget(double limit, double fixedSeconds, const std::vector<IterationRecord>& history)
      : Limit(limit), FixedSeconds(fixedSeconds) {
    if (history.size() > 1) {
      this->LastEnd = history[history.size() - 2].seconds;
      this->LastLinks = static_cast<double>(history[history.size() - 2].links);
    }
  }

  bool NextFits(const IterationRecord& record, const HierarchicalRadiosity& solver) {
    if (this->Limit <= 0) {
      return true;
    }
    const double iteration = record.seconds - this->LastEnd;
    const double links = static_cast<double>(record.links);
    const double growth = this->LastLinks > 0
                              ? std::clamp(links / this->LastLinks, 1., kLargestGrowth)
                              : kUsualGrowth;
    this->LastLinks = links;
    this->LastEnd = record.seconds + this->MeasureOutput(links, solver);
    return SecondsSinceProcessStart() + growth * iteration +
               kReserveFactor * this->OutputSeconds(growth * links) + this->FixedSeconds <
           this->Limit;
  }

 private:
  double OutputSeconds(double links) const {
    return this->SecondsForMesh + this->SecondsPerLink * links;
  }

  /// Reconstructs while that is cheap; returns the seconds that it took.
  double MeasureOutput(double links, const HierarchicalRadiosity& solver) {
    if (this->OutputSeconds(links) > kMeasuringShare * this->Limit) {
      return 0;
    }
    const Timer timer;
    const RadiositySolution solution = solver.Solution();
    const double seconds = timer.Seconds();
    const double output =
        seconds + kWriteSecondsPerTriangle * static_cast<double>(solution.mesh.FaceCount());
    if (this->SecondsForMesh <= 0) {
      this->SecondsForMesh = output;
    } else if (links >= kLinksToMeasure) {
      this->SecondsPerLink = std::max(0., output - this->SecondsForMesh) / links;
    }
    return seconds;
  }

  double Limit, FixedSeconds;
  double LastEnd = 0, LastLinks = 0;
  double SecondsForMesh = 0, SecondsPerLink = kUsualSecondsPerLink;
};

/// Throws Error where a light map is wanted of a surface that the atlas does not hold.
void RequireCharts(const StoredAtlas& stored, const std::string& fileName, const Scene& scene,
                   const ClusterTree& tree, const WantedRepresentations& wanted) {
  const std::vector<bool> isLaid = FindLaidSurfaces(stored, scene.mesh);
  const std::vector<Representation> wishes =
      RepresentationsOfSurfaces(scene, tree, wanted, Representation::Automatic);
  for (size_t s = 0; s < wishes.size(); ++s) {
    if (wishes[s] != Representation::LightMap || isLaid[s]) {
      continue;
    }
    const size_t face =
        static_cast<size_t>(tree.nodes[static_cast<size_t>(tree.surfaceRoots[s])].firstFace);
    throw lambert::Error(
        "The atlas in '" + fileName + "' has no charts of all of surface " + std::to_string(s) +
        ", of material " + scene.materials[static_cast<size_t>(scene.mesh.materialId[face])].name +
        ", whose light is to be shown in the light map; leave it to its points, or lay it flat "
        "without this atlas.");
  }
}

/// Faces stray where a scene is so many times as large as the place of nearly all of them.
constexpr double kStraying = 1000;
}  // namespace

RadiosityRun::RadiosityRun(const RadiosityRunOptions& options) : options_(options) {}

RadiosityRun::~RadiosityRun() = default;

void RadiosityRun::AddStage(const std::string& name, double seconds) {
  this->stages_.emplace_back(name, seconds);
}

void RadiosityRun::Load(const ProgressCallback& progress) {
  // An atlas that it is to be drawn on.
  Timer timer;
  std::vector<std::string> piecesOfAtlas;
  if (!this->options_.atlasFile.empty()) {
    this->storedAtlas_ = ReadAtlas(this->options_.atlasFile, &piecesOfAtlas);
  }

  // Files to one clean mesh.
  this->scene_ = LoadScene(this->options_.files, this->options_.reader, this->options_.cleaning,
                           this->options_.settings, &this->reading_, &this->cleaning_, progress);
  this->reading_.companions.insert(this->reading_.companions.end(), piecesOfAtlas.begin(),
                                   piecesOfAtlas.end());
  RequireMaterialsAndParts(this->scene_, this->options_.representations);
  this->AddStage("load", timer.Seconds());
}

void RadiosityRun::AddLights(const std::vector<Light>& lights) {
  RequireSolvableLights(lights);
  this->scene_.lights.insert(this->scene_.lights.end(), lights.begin(), lights.end());
}

void RadiosityRun::RequireLight() const {
  if (!this->scene_.HasLight()) {
    throw lambert::Error(
        "The scene has no light: no face emits and no lamp is given; add one with --sky, "
        "--sky-gradient, --environment, --sun or --set MATERIAL:emission=R,G,B.");
  }
}

void RadiosityRun::Cluster(const ProgressCallback& progress) {
  if (this->options_.method.method != SolveMethod::Hierarchical && !this->options_.atlas) {
    return;
  }
  Timer timer;
  this->tree_ = ClusterFaces(&this->scene_.mesh, this->scene_.parts, this->options_.clustering,
                             &this->clustering_, progress);
  RequireSurfaces(static_cast<int64_t>(this->tree_.surfaceRoots.size()),
                  this->options_.representations);
  if (this->storedAtlas_ && !IsAtlasOf(*this->storedAtlas_, this->scene_.mesh, this->tree_)) {
    throw lambert::Error("The atlas in '" + this->options_.atlasFile +
                         "' is of another scene, or of this one read by other options; lay this "
                         "one flat by lambert atlas with the same options of reading.");
  }
  if (this->storedAtlas_) {
    RequireCharts(*this->storedAtlas_, this->options_.atlasFile, this->scene_, this->tree_,
                  this->options_.representations);
  }
  this->AddStage("cluster", timer.Seconds());
}

void RadiosityRun::Solve(const ProgressCallback& progress, const std::function<bool()>& interrupted,
                         const std::function<void(const IterationRecord&)>& observer) {
  if (this->options_.method.method != SolveMethod::Hierarchical) {
    this->SolveByMethod(progress, observer);
    return;
  }

  // Iterate. The clock and the user end a run at the border of an iteration only.
  Timer timer;
  std::string stoppedBy;
  HierarchicalRadiosityOptions options = this->options_.solver;
  const double outputSeconds =
      this->options_.outputSeconds +
      this->options_.outputSecondsPerPart * static_cast<double>(this->scene_.parts.size());
  if (this->options_.timeLimit > 0) {
    options.timeLimit =
        std::max(1e-3, this->options_.timeLimit - SecondsSinceProcessStart() - outputSeconds);
  }
  HierarchicalRadiosity solver(this->scene_, this->tree_, options);
  TimeBudget budget(this->options_.timeLimit, outputSeconds, solver.Statistics().history);
  bool hasLight = false;
  solver.Run(
      [&](double fraction, const char* stage) {
        Report(progress, fraction, stage);
        return !(hasLight && interrupted && interrupted());
      },
      [&](const IterationRecord& record) {
        hasLight = true;
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
  this->solution_ = solver.TakeSolution();
  this->statistics_ = solver.Statistics();
  // A request met, or a floor reached, in the last iteration that fitted counts before the clock.
  if (!stoppedBy.empty() && this->statistics_.stoppedBy == "interrupt") {
    this->statistics_.stoppedBy = stoppedBy;
  }
  this->AddStage("reconstruct", timer.Seconds());
}

void RadiosityRun::SolveByMethod(const ProgressCallback& progress,
                                 const std::function<void(const IterationRecord&)>& observer) {
  Timer timer;
  this->solution_ = lambert::SolveByMethod(this->scene_, this->options_.method, &this->statistics_,
                                           progress, observer);
  this->AddStage("solve", timer.Seconds());
}

void RadiosityRun::LayFlat(const ProgressCallback& progress) {
  if (!this->options_.atlas) {
    throw lambert::Error("A scene is laid flat by the options of an atlas, and there are none.");
  }
  Timer timer;
  this->atlas_ =
      MakeRadiosityAtlas(this->LaidScene().mesh, this->shown_ ? this->shown_->tree : this->tree_,
                         *this->options_.atlas, progress);
  this->AddStage("atlas", timer.Seconds());
}

void RadiosityRun::Represent(const ProgressCallback& progress) {
  // What is wanted of surfaces.
  RepresentationOptions options;
  options.introducedTriangles = this->options_.introducedTriangles.value_or(0);
  options.splitSurfaces = this->options_.splitSurfaces;
  options.wanted = RepresentationsOfSurfaces(
      this->scene_, this->tree_, this->options_.representations,
      this->options_.introducedTriangles ? Representation::Automatic : Representation::LightMap);

  // Both kinds.
  Timer timer;
  if (this->storedAtlas_) {
    this->represented_ = RepresentSurfaces(this->scene_.mesh, this->tree_, this->solution_, options,
                                           std::move(*this->storedAtlas_), progress);
    this->storedAtlas_.reset();
  } else {
    this->represented_ = RepresentSurfaces(this->scene_.mesh, this->tree_, this->solution_, options,
                                           *this->options_.atlas, progress);
  }
  this->atlas_ = this->represented_->atlas;
  this->lightMap_ = this->represented_->map;
  this->AddStage("light map", timer.Seconds());
}

const RadiositySolution& RadiosityRun::SolutionAsShown() {
  if (!this->shown_) return this->solution_;
  if (!this->solutionAsShown_) {
    this->solutionAsShown_ =
        OntoShownSides(this->solution_, this->shown_->inputFace, this->shown_->side);
  }
  return *this->solutionAsShown_;
}

void RadiosityRun::Show(std::optional<ShownSides> sides) {
  this->shown_ = std::move(sides);
  this->solutionAsShown_.reset();
  if (this->shown_) {
    this->shownScene_ = this->scene_;
    this->shownScene_.mesh = this->shown_->mesh;
  }
}

void RadiosityRun::TakeStoredAtlas() {
  this->Show(
      ShowStoredSides(this->scene_.mesh, this->tree_, this->solution_, &*this->storedAtlas_));
  this->atlas_ = std::move(this->storedAtlas_->atlas);
  this->storedAtlas_.reset();
}

void RadiosityRun::DrawLightMap(const ProgressCallback& progress) {
  const bool isChosen =
      this->options_.introducedTriangles || !this->options_.representations.IsEmpty();
  if (this->options_.atlas &&
      (isChosen || (this->storedAtlas_ && this->storedAtlas_->isOfChosen))) {
    this->Represent(progress);
    return;
  }

  // Where its surfaces lie.
  const bool isLaid = this->storedAtlas_.has_value();
  if (isLaid) {
    this->TakeStoredAtlas();
  } else {
    this->Show(ShowBothSides(this->scene_.mesh, this->tree_, this->solution_));
    this->LayFlat([&](double fraction, const char* stage) {
      return Report(progress, 0.7 * fraction, stage);
    });
  }

  // Their light.
  Timer timer;
  const RadiositySolution& solution = this->SolutionAsShown();
  if (!isLaid) {
    this->atlas_ = WithTexelDensity(
        this->LaidScene().mesh, std::move(this->atlas_), solution, *this->options_.atlas,
        [&](double, const char* stage) { return Report(progress, 0.7, stage); });
  }
  this->lightMap_ = MakeLightMap(this->LaidScene().mesh, this->atlas_, solution,
                                 [&](double fraction, const char* stage) {
                                   return Report(progress, 0.7 + 0.3 * fraction, stage);
                                 });
  this->AddStage("light map", timer.Seconds());
}

void RadiosityRun::DrawModel(const LitModelOptions& options, const std::optional<Camera>& camera) {
  if (this->represented_) {
    this->model_ = MakeLitModel(this->scene_, this->solution_, *this->represented_, options);
  } else if (this->lightMap_) {
    this->model_ = MakeLitModel(this->LaidScene(), this->SolutionAsShown(), this->atlas_,
                                *this->lightMap_, options);
  } else {
    this->model_ = MakeLitModel(this->scene_, this->solution_, options);
  }
  if (camera) {
    this->model_->camera = *camera;
  }
}

void RadiosityRun::Verify(int points, const ProgressCallback& progress) {
  Timer timer;
  SolutionErrorOptions options;
  options.points = points;
  options.growth = kVerificationGrowth;
  const bool isRequested = this->options_.method.method == SolveMethod::Hierarchical;
  options.enough = isRequested ? this->options_.solver.error : 0;
  this->error_ = MeasureSolutionError(this->scene_, this->solution_, options, progress,
                                      &this->comparedPoints_);
  this->AddStage("verify", timer.Seconds());
}

void RadiosityRun::Simplify(const LitMeshSimplificationOptions& options,
                            const ProgressCallback& progress) {
  Timer timer;
  LitMeshSimplificationStatistics statistics;
  this->solution_ = SimplifyLitMesh(this->solution_, options, &statistics, progress);
  this->solutionAsShown_.reset();
  this->simplification_ = statistics;
  this->refinedError_ = std::exchange(this->error_, std::nullopt);
  this->AddStage("simplify", timer.Seconds());
}

std::vector<std::string> RadiosityRun::Warnings() const {
  std::vector<std::string> warnings = this->reading_.warnings;
  warnings.insert(warnings.end(), this->cleaning_.warnings.begin(), this->cleaning_.warnings.end());
  const double across = this->scene_.mesh.Bounds().Diagonal();
  if (const double most = DiagonalOfMost(this->scene_.mesh);
      most > 0 && across > kStraying * most) {
    warnings.push_back("The scene measures " + std::to_string(across) +
                       " m across, nearly all of its faces " + std::to_string(most) +
                       " m: light passes gaps and walls thinner than a hundred-thousandth of the "
                       "former; remove what strays.");
  }
  if (!this->statistics_.stateFailure.empty()) warnings.push_back(this->statistics_.stateFailure);
  if (this->error_ && this->error_->points == 0) {
    warnings.push_back("No error was measured: no place was found that receives light.");
  } else if (this->error_ && !this->error_->IsRmsSure()) {
    warnings.push_back(
        "The interval of the measured error is wider than 30 % of it; the bounded error counts.");
  }
  return warnings;
}
}  // namespace lambert
