/**
 * @class vtkMatrixRadiosity
 * @brief Matrix radiosity: all form factors between uniform elements, solved by Gauss-Seidel
 * iteration (thesis 3.1.1).
 *
 * Takes the scene as every vtkRadiosityAlgorithm does, and leaves the cluster tree alone. Output
 * port 0: the mesh on its lit sides, cut to the element size, with `Irradiance` and `Radiosity`
 * (W/m2) at its points. Port 1: the history, a row for each sweep over the matrix. Port 2: the
 * input with light at its points. AbortExecute ends a run and nothing is delivered.
 */
#ifndef vtkMatrixRadiosity_h
#define vtkMatrixRadiosity_h

#include "lambertClassicalModule.h"
#include "vtkRadiosityAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct MatrixRadiosityOptions;
}

class LAMBERTCLASSICAL_EXPORT vtkMatrixRadiosity : public vtkRadiosityAlgorithm {
 public:
  static vtkMatrixRadiosity* New();
  vtkTypeMacro(vtkMatrixRadiosity, vtkRadiosityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Longest edge of an element, m, [0, inf); default 0: 1/50 of the scene's diagonal.
  void SetElementSize(double metres);
  double GetElementSize();
  ///@}
  ///@{ Rays between two elements that something may stand between, [1, 16]; default 4.
  void SetVisibilityRays(int rays);
  int GetVisibilityRays();
  ///@}
  ///@{ Rays to the sky an element, at least 1; default 256.
  void SetSkyRays(int rays);
  int GetSkyRays();
  ///@}
  ///@{ Relative error that may be left in the solution of the equations, (0, 1); default 1e-4.
  void SetTolerance(double tolerance);
  double GetTolerance();
  ///@}
  ///@{ Bytes that the form factors may take; default 4 GiB. A scene that needs more is an error.
  void SetMemoryLimit(vtkTypeInt64 bytes);
  vtkTypeInt64 GetMemoryLimit();
  ///@}

 protected:
  vtkMatrixRadiosity();
  ~vtkMatrixRadiosity() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkMatrixRadiosity(const vtkMatrixRadiosity&) = delete;
  void operator=(const vtkMatrixRadiosity&) = delete;

  std::unique_ptr<lambert::MatrixRadiosityOptions> Options;
};

#endif
