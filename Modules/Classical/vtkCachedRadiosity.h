/**
 * @class vtkCachedRadiosity
 * @brief A path-traced element cache, gathered at points: the modern baseline.
 *
 * Takes the scene as every vtkRadiosityAlgorithm does, and leaves the cluster tree alone. Output
 * port 0: the mesh on its lit sides, cut to the element size, with `Irradiance` and `Radiosity`
 * (W/m2) at its points. Port 1: the history, a row for each bounce of the cache. Port 2: the input
 * with light at its points. AbortExecute ends a run and nothing is delivered.
 */
#ifndef vtkCachedRadiosity_h
#define vtkCachedRadiosity_h

#include "lambertClassicalModule.h"
#include "vtkRadiosityAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct CachedRadiosityOptions;
}

class LAMBERTCLASSICAL_EXPORT vtkCachedRadiosity : public vtkRadiosityAlgorithm {
 public:
  static vtkCachedRadiosity* New();
  vtkTypeMacro(vtkCachedRadiosity, vtkRadiosityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Size of the cache's cells, m, [0, inf); default 0: 1/50 of the scene's diagonal.
  void SetElementSize(double metres);
  double GetElementSize();
  ///@}
  ///@{ Longest edge of the output, m, [0, inf); default 0: the element size. A very large one
  /// leaves the mesh as it is.
  void SetOutputSize(double metres);
  double GetOutputSize();
  ///@}
  ///@{ Paths of each lit side of a cell, at least 1; default 32.
  void SetPaths(int paths);
  int GetPaths();
  ///@}
  ///@{ Rays into the cache at each output point, at least 1; default 64.
  void SetGatherRays(int rays);
  int GetGatherRays();
  ///@}
  ///@{ Rays to emitting faces at each output point, at least 1; default 16.
  void SetEmitterRays(int rays);
  int GetEmitterRays();
  ///@}
  ///@{ Another seed, another choice of rays; default 1.
  void SetSeed(vtkTypeUInt64 seed);
  vtkTypeUInt64 GetSeed();
  ///@}

 protected:
  vtkCachedRadiosity();
  ~vtkCachedRadiosity() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkCachedRadiosity(const vtkCachedRadiosity&) = delete;
  void operator=(const vtkCachedRadiosity&) = delete;

  std::unique_ptr<lambert::CachedRadiosityOptions> Options;
};

#endif
