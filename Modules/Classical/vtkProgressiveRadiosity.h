/**
 * @class vtkProgressiveRadiosity
 * @brief Progressive radiosity: the patch with the most unshot light shoots to the vertices of
 * finer elements (thesis 3.1.2).
 *
 * Takes the scene as every vtkRadiosityAlgorithm does, and leaves the cluster tree alone. Output
 * port 0: the mesh on its lit sides, cut to the element size, with `Irradiance` and `Radiosity`
 * (W/m2) at its points. Port 1: the history, a row whenever the unshot light has halved; `links`
 * counts the shots, `threshold` and `change` are the part of the light that is unshot. Port 2: the
 * input with light at its points.
 *
 * While it runs: ProgressEvent; AbortExecute ends the run and keeps what was shot. After every row
 * of the history an observer of vtkCommand::UpdateDataEvent finds a displayable solution on output
 * port 0, with the ambient term where that is on; without an observer none is made.
 */
#ifndef vtkProgressiveRadiosity_h
#define vtkProgressiveRadiosity_h

#include "lambertClassicalModule.h"
#include "vtkRadiosityAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct ProgressiveRadiosityOptions;
}

class LAMBERTCLASSICAL_EXPORT vtkProgressiveRadiosity : public vtkRadiosityAlgorithm {
 public:
  static vtkProgressiveRadiosity* New();
  vtkTypeMacro(vtkProgressiveRadiosity, vtkRadiosityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Longest edge of an element, m, [0, inf); default 0: 1/50 of the scene's diagonal.
  void SetElementSize(double metres);
  double GetElementSize();
  ///@}
  ///@{ Longest edge of a patch, m, [0, inf); default 0: 4 times the element size.
  void SetPatchSize(double metres);
  double GetPatchSize();
  ///@}
  ///@{ Part of the first light that may stay unshot, (0, 1); default 0.005.
  void SetUnshot(double part);
  double GetUnshot();
  ///@}
  ///@{ Shots after which the run ends; default 0: as many as it takes.
  void SetShots(vtkTypeInt64 shots);
  vtkTypeInt64 GetShots();
  ///@}
  ///@{ Rays to the sky a vertex, at least 1; default 256.
  void SetSkyRays(int rays);
  int GetSkyRays();
  ///@}
  ///@{ True: solutions for observers are brightened by the ambient term, an estimate of the light
  /// that is unshot. The final output never is. Default true.
  vtkSetMacro(Ambient, bool);
  vtkGetMacro(Ambient, bool);
  vtkBooleanMacro(Ambient, bool);
  ///@}

 protected:
  vtkProgressiveRadiosity();
  ~vtkProgressiveRadiosity() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkProgressiveRadiosity(const vtkProgressiveRadiosity&) = delete;
  void operator=(const vtkProgressiveRadiosity&) = delete;

  std::unique_ptr<lambert::ProgressiveRadiosityOptions> Options;
  bool Ambient = true;
};

#endif
