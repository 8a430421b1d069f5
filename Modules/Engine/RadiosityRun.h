// From scene files to a solved scene: the stages in order, their times, and when to stop. C++ only.
#ifndef RadiosityRun_h
#define RadiosityRun_h

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/LitMeshSimplification.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/StoredAtlas.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Atlas/Core/WantedRepresentations.h"
#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/Progress.h"
#include "LitModel.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Reference/Core/SolutionError.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/SceneCleaning.h"
#include "Scene/Core/SceneReader.h"
#include "SolveMethod.h"
#include "lambertEngineModule.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lambert {
struct RadiosityRunOptions {
  std::vector<std::string> files;  ///< read one after the other into one scene
  SceneReaderOptions reader;
  std::vector<std::string> settings;  ///< changes to materials, as ApplyMaterialSetting takes them
  CleaningOptions cleaning;
  FaceClusteringOptions clustering;
  SolveMethodOptions method;
  HierarchicalRadiosityOptions solver;  ///< of the method Hierarchical
  std::optional<AtlasOptions> atlas;    ///< of a light map, where one is wanted
  /// Atlas that the light map is drawn on, in place of one by `atlas`; none: empty.
  std::string atlasFile;
  /// Triangles that refinement may add to the surfaces that their points light; none: all surfaces
  /// are in the light map but those of `representations`.
  std::optional<int64_t> introducedTriangles;
  bool splitSurfaces = false;  ///< surfaces of both kinds, where `introducedTriangles` chooses
  WantedRepresentations representations;  ///< as asked for
  double timeLimit = 0;        ///< seconds since the process began, writing included; 0: none
  double outputSeconds = 0.2;  ///< kept free for what is not proportional to the mesh (a picture)
  double outputSecondsPerPart = 0;  ///< the same for each part (files of a collection)
};

/// Runs the stages one after the other and keeps what each made.
class LAMBERTENGINE_EXPORT RadiosityRun {
 public:
  explicit RadiosityRun(const RadiosityRunOptions& options);
  ~RadiosityRun();

  /// Reads the files, that of an atlas first, changes materials, cleans up. Throws Error,
  /// Cancelled.
  void Load(const ProgressCallback& progress = {});
  /// Adds lights to those of the files.
  void AddLights(const std::vector<Light>& lights);
  /// Throws Error, before any work, for a scene without light.
  void RequireLight() const;
  /// Builds the face-cluster tree, for the method Hierarchical and for light maps alone. Throws
  /// Error where a surface is to be represented that is none, and where the atlas of the options is
  /// of another scene, Cancelled.
  void Cluster(const ProgressCallback& progress = {});
  /// Solves until the request is met, until another iteration and the output would not fit into the
  /// time limit, or until `interrupted` says so; all end at the border of an iteration. `observer`
  /// hears of every iteration. Another method than Hierarchical is ended by `progress`. Throws
  /// Error, Cancelled.
  void Solve(const ProgressCallback& progress = {}, const std::function<bool()>& interrupted = {},
             const std::function<void(const IterationRecord&)>& observer = {});
  /// Lays the clustered scene flat, both sides of sheets where it is to be drawn. Throws Error
  /// where the options gave no atlas or charts do not fit, Cancelled.
  void LayFlat(const ProgressCallback& progress = {});
  /// Lays the scene flat, unless the options have its atlas, and draws the solution into its
  /// texels. Throws as LayFlat does.
  void DrawLightMap(const ProgressCallback& progress = {});
  /// Makes what viewers draw: each surface in its representation where those are chosen, else all
  /// by the light map where there is one, else by the points. The camera is `camera`, else that of
  /// the scene, else one that is chosen.
  void DrawModel(const LitModelOptions& options = {}, const std::optional<Camera>& camera = {});
  /// Measures how far the solution is from a path-traced reference at `points` points; with up to
  /// four times the paths where those leave open whether the request is met.
  void Verify(int points, const ProgressCallback& progress = {});

  /// Decimates the solution (SimplifyLitMesh); an error that was measured is kept as that of the
  /// refined mesh. A light map is drawn before. Throws Error, Cancelled.
  void Simplify(const LitMeshSimplificationOptions& options, const ProgressCallback& progress = {});

  const RadiosityRunOptions& Options() const { return this->options_; }
  const Scene& GetScene() const { return this->scene_; }
  const ReadReport& Reading() const { return this->reading_; }
  const CleaningReport& Cleaning() const { return this->cleaning_; }
  const FaceClusteringStatistics& Clustering() const { return this->clustering_; }
  const SolverStatistics& Statistics() const { return this->statistics_; }
  const RadiositySolution& Solution() const { return this->solution_; }
  const std::optional<SolutionError>& Error() const { return this->error_; }
  /// The points that it was measured at, those that hold most of it first.
  const std::vector<ComparedPoint>& ComparedPoints() const { return this->comparedPoints_; }
  /// What decimation left, where it was asked for; and the error before it, where it was measured.
  const std::optional<LitMeshSimplificationStatistics>& Simplification() const {
    return this->simplification_;
  }
  const std::optional<SolutionError>& RefinedError() const { return this->refinedError_; }
  const RadiosityAtlas& Atlas() const { return this->atlas_; }
  /// Where a light map shows both sides of sheets: they, and the scene with them as surfaces of
  /// their own, which the atlas is of; else there are none, and it is of the scene as it is.
  const std::optional<ShownSides>& Shown() const { return this->shown_; }
  const Scene& LaidScene() const { return this->shown_ ? this->shownScene_ : this->scene_; }
  /// Where surfaces are represented in both ways; Atlas() and DrawnLightMap() are then of those in
  /// the light map.
  const std::optional<RepresentedScene>& Represented() const { return this->represented_; }
  const std::optional<LightMap>& DrawnLightMap() const { return this->lightMap_; }
  const std::optional<LitModel>& DrawnModel() const { return this->model_; }
  /// What the user should know, one sentence each, of every stage.
  std::vector<std::string> Warnings() const;

  /// Seconds a stage took, by name, in order. A stage of the caller's own (writing) is added with
  /// AddStage.
  const std::vector<std::pair<std::string, double>>& Stages() const { return this->stages_; }
  void AddStage(const std::string& name, double seconds);

 private:
  /// What a light map shows of the scene.
  void Show(std::optional<ShownSides> sides);
  /// Takes the atlas of the options, and the sides that it shows.
  void TakeStoredAtlas();
  /// Chooses how each surface shows its light, and draws the light map of those that it takes.
  void Represent(const ProgressCallback& progress);
  /// On the faces that show its sides, made once.
  const RadiositySolution& SolutionAsShown();
  void SolveByMethod(const ProgressCallback& progress,
                     const std::function<void(const IterationRecord&)>& observer);

  RadiosityRunOptions options_;
  Scene scene_;
  ReadReport reading_;
  CleaningReport cleaning_;
  FaceClusteringStatistics clustering_;
  ClusterTree tree_;
  SolverStatistics statistics_;
  RadiositySolution solution_;
  std::optional<SolutionError> error_, refinedError_;
  std::vector<ComparedPoint> comparedPoints_;
  std::optional<LitMeshSimplificationStatistics> simplification_;
  std::optional<ShownSides> shown_;
  Scene shownScene_;
  std::optional<RadiositySolution> solutionAsShown_;
  std::optional<StoredAtlas> storedAtlas_;  ///< until it is taken
  RadiosityAtlas atlas_;
  std::optional<LightMap> lightMap_;
  std::optional<RepresentedScene> represented_;
  std::optional<LitModel> model_;
  std::vector<std::pair<std::string, double>> stages_;
};
}  // namespace lambert

#endif
