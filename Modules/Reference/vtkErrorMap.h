/**
 * @class vtkErrorMap
 * @brief Where the error of a solution sits: every triangle against a path trace in its middle.
 *
 * Input port 0: the solution, output port 0 of any vtkRadiosityAlgorithm. Input port 1
 * (SetSceneConnection, SetSceneData): the scene that it solved, as vtkSolutionError takes it.
 * Output: the solution with three arrays more at its cells:
 *
 * - `RelativeError` (active scalars): float, signed, below 0 where the solution is too dark:
 *   (E - Eref) / max(Eref, mean Eref), of the means of the bands, in the middle of the cell; 0 on
 *   faces that emit, which do not count unless all do
 * - `ReferenceIrradiance`: 3 float, W/m2, path traced there
 * - `StandardError`: 3 float, W/m2, of that mean
 *
 * AbortExecute ends the path trace; the output then is empty.
 */
#ifndef vtkErrorMap_h
#define vtkErrorMap_h

#include "lambertReferenceModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct ErrorMapOptions;
}

class LAMBERTREFERENCE_EXPORT vtkErrorMap : public vtkPolyDataAlgorithm {
 public:
  static vtkErrorMap* New();
  vtkTypeMacro(vtkErrorMap, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ The scene of input port 1.
  void SetSceneConnection(vtkAlgorithmOutput* output);
  void SetSceneData(vtkDataObject* scene);
  ///@}

  ///@{ Paths a triangle, [2, inf), rounded up to a multiple of 16; default 1024.
  void SetSamples(int samples);
  int GetSamples();
  ///@}
  ///@{ Another seed, another choice of paths; default 1.
  void SetSeed(vtkTypeUInt64 seed);
  vtkTypeUInt64 GetSeed();
  ///@}
  ///@{ Radiance (R, G, B) of a uniform sky in W/(m2 sr), [0, inf), as the method had it; default 0:
  /// none.
  vtkSetVector3Macro(Sky, double);
  vtkGetVector3Macro(Sky, double);
  ///@}
  ///@{ Threads of the process; default 0: all processors. The map does not depend on it.
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

 protected:
  vtkErrorMap();
  ~vtkErrorMap() override;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkErrorMap(const vtkErrorMap&) = delete;
  void operator=(const vtkErrorMap&) = delete;

  std::unique_ptr<lambert::ErrorMapOptions> Options;
  double Sky[3] = {0, 0, 0};
  int NumberOfThreads = 0;
};

#endif
