/**
 * @class vtkHierarchicalRadiosity
 * @brief Hierarchical radiosity on face clusters (thesis 4.3 to 4.5).
 *
 * Input port 0: vtkPolyData of triangles with the arrays of vtkRadiosityArrays that it has;
 * defaults for the others. Input port 1, optional: the cluster tree of vtkFaceClustering, whose
 * port 0 is then the mesh it belongs to; without it the filter clusters by itself. Output port 0:
 * the refined mesh with `Irradiance` and `Radiosity` (W/m2) at its points; `InputFaceId` counts the
 * triangles of input port 0. The tables of the input (materials, parts, lights) come along.
 * Output port 1: the history, a row an iteration (iteration, seconds, threshold, elements, links,
 * rays, change, error). Output port 2: the input as it came, plus `Irradiance` and `Radiosity` at
 * its points (their brighter side, the mean where the faces about a point have several normals).
 *
 * While it runs: ProgressEvent; AbortExecute ends the run and keeps its last whole iteration. After
 * every iteration an observer of vtkCommand::UpdateDataEvent finds a displayable solution on output
 * port 0; without an observer none is made.
 */
#ifndef vtkHierarchicalRadiosity_h
#define vtkHierarchicalRadiosity_h

#include "lambertRadiosityModule.h"
#include "vtkRadiosityAlgorithm.h"

#include <memory>  // for the options

class vtkTable;

namespace lambert {
struct HierarchicalRadiosityOptions;
}

class LAMBERTRADIOSITY_EXPORT vtkHierarchicalRadiosity : public vtkRadiosityAlgorithm {
 public:
  static vtkHierarchicalRadiosity* New();
  vtkTypeMacro(vtkHierarchicalRadiosity, vtkRadiosityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Wanted relative RMS error of irradiance, (0, 1]; default 0.05.
  void SetError(double error);
  double GetError();
  ///@}
  ///@{ Seconds of solving after which the run ends at the next iteration border; default 0: no
  /// limit.
  void SetTimeLimit(double seconds);
  double GetTimeLimit();
  ///@}
  ///@{ MB (1e6 bytes) of the process, [0, inf): links are refined and light is gathered as long as
  /// that and the delivery stay below, the first iteration in any case; default 0: no limit.
  void SetMemoryLimit(double megabytes);
  double GetMemoryLimit();
  ///@}
  ///@{ Iterations after which the run ends; default 0: as many as the error asks for.
  void SetIterations(int iterations);
  int GetIterations();
  ///@}
  ///@{ Points at which a path trace verifies the delivered error after every final gather, which is
  /// repeated on a finer mesh until the error is met, and tells from its second round of cuts on
  /// whether more are needed; [0, inf), default 2000. The column `error` of the history has what
  /// was found. 0: nothing is verified, one gather is made that usually gives the error.
  void SetVerificationPoints(int points);
  int GetVerificationPoints();
  ///@}
  ///@{ Whether light is gathered anew at the points of the mesh in the end; default on. Off: what
  /// links brought is delivered, sooner and less exact; verified and refined on all the same.
  void SetFinalGather(bool gather);
  bool GetFinalGather();
  vtkBooleanMacro(FinalGather, bool);
  ///@}
  ///@{ How triangles are refined: in halves across the minimum-area rectangle (thesis 4.4.2), or
  /// regularly into four (3.4.2), for comparison; default RECTANGLE.
  enum Refinements { RECTANGLE, QUADTREE };
  void SetRefinement(int refinement);
  int GetRefinement();
  void SetRefinementToRectangle() { this->SetRefinement(RECTANGLE); }
  void SetRefinementToQuadtree() { this->SetRefinement(QUADTREE); }
  ///@}
  ///@{ A line across a rectangle moves to a vertex within this fraction of its longer side, [0,
  /// 0.5); default 0.15.
  void SetSnapTolerance(float tolerance);
  float GetSnapTolerance();
  ///@}
  ///@{ What judges links: geometry and doubt in visibility; geometry alone; the power that samples
  /// find (thesis 4.5.3); as the first, but sure where all of one end sees all or nothing of the
  /// other (9.2.2); or as the first, weighed by what a tone-mapped picture shows (9.2.2). Default
  /// DOUBT.
  enum Oracles { DOUBT, GEOMETRIC, BFA, VISIBILITY, PERCEPTUAL };
  void SetOracle(int oracle);
  int GetOracle();
  void SetOracleToDoubt() { this->SetOracle(DOUBT); }
  void SetOracleToGeometric() { this->SetOracle(GEOMETRIC); }
  void SetOracleToBfa() { this->SetOracle(BFA); }
  void SetOracleToVisibility() { this->SetOracle(VISIBILITY); }
  void SetOracleToPerceptual() { this->SetOracle(PERCEPTUAL); }
  ///@}
  ///@{ When light bounces (thesis 3.2.4): until it settles between one threshold and the next, or
  /// once after every refinement; default SCHEDULED.
  enum Schedules { SCHEDULED, INTERLEAVED };
  void SetSchedule(int schedule);
  int GetSchedule();
  void SetScheduleToScheduled() { this->SetSchedule(SCHEDULED); }
  void SetScheduleToInterleaved() { this->SetSchedule(INTERLEAVED); }
  ///@}
  ///@{ Whether elements, links and visibility stay in memory after a run; default on. Where the
  /// input then comes with other `Reflectance`, `Emittance` or emitting sides and nothing else has
  /// changed, the light they have there is shown at once, to observers of UpdateDataEvent too, and
  /// refined from there: nothing is clustered or traced again. The result is within the error of
  /// that of a new run, not the same bits.
  vtkSetMacro(KeepLinks, bool);
  vtkGetMacro(KeepLinks, bool);
  vtkBooleanMacro(KeepLinks, bool);
  ///@}
  ///@{ File that gets the state at the end of every iteration of links, whole or not at all;
  /// default empty: none.
  void SetStateFileName(const char* file);
  const char* GetStateFileName();
  ///@}
  ///@{ File of StateFileName that a run of the same input goes on from, to the same light as a run
  /// that was never stopped; default empty: from the beginning. A file of another input is an
  /// error.
  void SetResumeFileName(const char* file);
  const char* GetResumeFileName();
  ///@}

 protected:
  vtkHierarchicalRadiosity();
  ~vtkHierarchicalRadiosity() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkHierarchicalRadiosity(const vtkHierarchicalRadiosity&) = delete;
  void operator=(const vtkHierarchicalRadiosity&) = delete;

  struct Solver;
  template <class T>
  void SetOption(T* option, const T& value);
  bool PrepareSolver(vtkPolyData* input, vtkTable* clusters, const Progress& progress);

  std::unique_ptr<lambert::HierarchicalRadiosityOptions> Options;
  std::unique_ptr<Solver> Kept;  ///< of the last run
  bool KeepLinks = true;
};

#endif
