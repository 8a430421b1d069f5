/**
 * @class vtkSolutionError
 * @brief How far a solution is from the truth: its relative RMS error against a path trace.
 *
 * Input port 0: the solution, output port 0 of any vtkRadiosityAlgorithm (`InputFaceId`, `Side`;
 * `Irradiance`, `Radiosity`). Input port 1 (SetSceneConnection, SetSceneData): the scene that it
 * solved, the very data that the method had on its input port 0: a mesh that vtkFaceClustering has
 * put in its order is another one. Output: vtkTable of one row. Fractions, where nothing else is
 * said:
 *
 * - `error`: the error that counts, to be held against a request: `rms`, or `bounded` where the
 *   interval is wider than 30 % of `rms`
 * - `rms`, `rms_low`, `rms_high`: relative RMS error of irradiance, and its 95 % interval
 * - `bounded`: the same with each point's error over its light or the mean light, which is more
 * - `bias`: signed, of the mean
 * - `percentile_95`: of the pointwise relative error
 * - `noise`: of the path trace; it is subtracted from `rms`
 * - `points`: receiving points, a count
 * - `dark_points`: left out as dark, a count
 * - `missed_points`: of the receiving ones, those on sides that the solution leaves out, a count
 *
 * A scene without light has no error, and a warning. AbortExecute ends the measurement; the table
 * then is empty.
 */
#ifndef vtkSolutionError_h
#define vtkSolutionError_h

#include "lambertReferenceModule.h"
#include "vtkTableAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct SolutionErrorOptions;
}

class LAMBERTREFERENCE_EXPORT vtkSolutionError : public vtkTableAlgorithm {
 public:
  static vtkSolutionError* New();
  vtkTypeMacro(vtkSolutionError, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ The scene of input port 1.
  void SetSceneConnection(vtkAlgorithmOutput* output);
  void SetSceneData(vtkDataObject* scene);
  ///@}

  ///@{ Receiver points, stratified by area over both sides of every face that does not emit, of
  /// every face where all emit, [1, inf); default 2000. In scenes of closed things about half turn out dark.
  void SetPoints(int points);
  int GetPoints();
  ///@}
  ///@{ Paths a point, [2, inf), rounded up to a multiple of 16; default 1024.
  void SetSamples(int samples);
  int GetSamples();
  ///@}
  ///@{ Another seed, another choice of points and paths; default 1.
  void SetSeed(vtkTypeUInt64 seed);
  vtkTypeUInt64 GetSeed();
  ///@}
  ///@{ Radiance (R, G, B) of a uniform sky in W/(m2 sr), [0, inf), as the method had it; default 0:
  /// none.
  vtkSetVector3Macro(Sky, double);
  vtkGetVector3Macro(Sky, double);
  ///@}
  ///@{ Threads of the process; default 0: all processors. The figures do not depend on it.
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

 protected:
  vtkSolutionError();
  ~vtkSolutionError() override;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkSolutionError(const vtkSolutionError&) = delete;
  void operator=(const vtkSolutionError&) = delete;

  std::unique_ptr<lambert::SolutionErrorOptions> Options;
  double Sky[3] = {0, 0, 0};
  int NumberOfThreads = 0;
};

#endif
