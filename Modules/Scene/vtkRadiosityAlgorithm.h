/**
 * @class vtkRadiosityAlgorithm
 * @brief The contract of every radiosity method.
 *
 * Input port 0: vtkPolyData of triangles in world space, with the arrays of vtkRadiosityArrays that
 * it has. Input port 1, optional: the cluster tree, a vtkTable as vtkFaceClustering makes it;
 * methods without clusters leave it alone. Output port 0: vtkPolyData, the refined mesh with
 * `Irradiance` and `Radiosity` (W/m2) at its points. Output port 1: vtkTable, the convergence
 * history, a row an iteration. Output port 2: vtkPolyData, the input with its own points and cells
 * plus `Irradiance` and `Radiosity`. AbortExecute ends a run; a method that keeps nothing then
 * delivers nothing.
 */
#ifndef vtkRadiosityAlgorithm_h
#define vtkRadiosityAlgorithm_h

#include "lambertSceneModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <functional>  // for the work of a method
#include <string>      // for StoppedBy

namespace lambert {
struct RadiositySolution;
struct Scene;
struct SolverStatistics;
}  // namespace lambert

class LAMBERTSCENE_EXPORT vtkRadiosityAlgorithm : public vtkPolyDataAlgorithm {
 public:
  vtkTypeMacro(vtkRadiosityAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Radiance (R, G, B) of a uniform sky in W/(m2 sr), [0, inf), added to the input's lights;
  /// default 0: none.
  vtkSetVector3Macro(Sky, double);
  vtkGetVector3Macro(Sky, double);
  ///@}
  ///@{ Threads of the process; default 0: all processors. The light does not depend on it.
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /// Why the last run ended: error, time, iterations, interrupt, memory, floor; empty before a run.
  const char* GetStoppedBy();

 protected:
  vtkRadiosityAlgorithm();
  ~vtkRadiosityAlgorithm() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;

  using Progress = std::function<bool(double fraction, const char* stage)>;
  using Method = std::function<lambert::RadiositySolution(
      const lambert::Scene& scene, lambert::SolverStatistics* statistics, const Progress&)>;

  /// The guard around the work of every method: its threads, progress and abort; what it throws
  /// becomes an error message and 0. Cancelled work has StoppedBy "interrupt" and is no error.
  int Guard(const std::function<void(const Progress&)>& work);
  /// The whole RequestData of a method that is one function of the scene.
  int RequestSolution(vtkInformationVector** inputs, vtkInformationVector* outputs,
                      const Method& method);
  /// Warns where `scene` has no light.
  void WarnOfDarkness(const lambert::Scene& scene);

  double Sky[3] = {0, 0, 0};
  int NumberOfThreads = 0;
  std::string StoppedBy;

 private:
  vtkRadiosityAlgorithm(const vtkRadiosityAlgorithm&) = delete;
  void operator=(const vtkRadiosityAlgorithm&) = delete;
};

#endif
