/**
 * @class vtkLitMeshSimplification
 * @brief Fewer triangles for the same light: a refined mesh, decimated where light is even.
 *
 * Input: output port 0 of any vtkRadiosityAlgorithm (`InputFaceId`, `Side`; `Irradiance`,
 * `Radiosity`). Output: the same with fewer points, which keep all that the data model has at them;
 * no triangle leaves the face that it lies in. `LeafId` is gone, and arrays that the data model
 * does not know. Light changes nowhere by more than Tolerance.
 *
 * AbortExecute ends it; the output then is empty.
 */
#ifndef vtkLitMeshSimplification_h
#define vtkLitMeshSimplification_h

#include "lambertAtlasModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct LitMeshSimplificationOptions;
}

class LAMBERTATLAS_EXPORT vtkLitMeshSimplification : public vtkPolyDataAlgorithm {
 public:
  static vtkLitMeshSimplification* New();
  vtkTypeMacro(vtkLitMeshSimplification, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ By how much light may change anywhere, (0, 1]: a fraction of what is delivered there or of
  /// the mean light, whichever is more; default 0.02.
  void SetTolerance(double tolerance);
  double GetTolerance();
  ///@}

 protected:
  vtkLitMeshSimplification();
  ~vtkLitMeshSimplification() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkLitMeshSimplification(const vtkLitMeshSimplification&) = delete;
  void operator=(const vtkLitMeshSimplification&) = delete;

  std::unique_ptr<lambert::LitMeshSimplificationOptions> Options;
};

#endif
