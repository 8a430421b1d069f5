/**
 * @class vtkRadiosityAlgorithm
 * @brief The contract of every radiosity method.
 *
 * Input port 0: vtkPolyData of triangles in world space, with the arrays of vtkRadiosityArrays that
 * it has. Input port 1, optional: the cluster tree, a vtkTable as vtkFaceClustering makes it.
 * Output port 0: vtkPolyData, the refined mesh with `Irradiance` and `Radiosity` (W/m2) at its
 * points. Output port 1: vtkTable, the convergence history, a row an iteration. Output port 2:
 * vtkPolyData, the input with its own points and cells plus `Irradiance` and `Radiosity`.
 */
#ifndef vtkRadiosityAlgorithm_h
#define vtkRadiosityAlgorithm_h

#include "lambertSceneModule.h"
#include "vtkPolyDataAlgorithm.h"

class LAMBERTSCENE_EXPORT vtkRadiosityAlgorithm : public vtkPolyDataAlgorithm {
 public:
  vtkTypeMacro(vtkRadiosityAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Radiance (R, G, B) of a uniform sky in W/(m2 sr), [0, inf), added to the input's lights;
  /// default 0: none.
  vtkSetVector3Macro(Sky, double);
  vtkGetVector3Macro(Sky, double);
  ///@}

 protected:
  vtkRadiosityAlgorithm();
  ~vtkRadiosityAlgorithm() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;

  double Sky[3] = {0, 0, 0};

 private:
  vtkRadiosityAlgorithm(const vtkRadiosityAlgorithm&) = delete;
  void operator=(const vtkRadiosityAlgorithm&) = delete;
};

#endif
