/**
 * @class vtkRadiosityLightMap
 * @brief The light of a solution in the texels of an atlas, its seams closed (thesis 5.2.5, 5.2.6).
 *
 * Input port 0: vtkPolyData, the output of vtkRadiosityAtlas. Input port 1: vtkPolyData, output
 * port 0 of a radiosity method that solved the same mesh: both take theirs from vtkFaceClustering,
 * or the order of the faces is not the same, which is an error. Output: vtkMultiBlockDataSet, a
 * vtkImageData a page, its lowest row first, with point scalars `Irradiance` (3 float, W/m2), as
 * vtkRadiosityActor takes them. Of a surface that is lit on both sides the brighter is kept,
 * unless the atlas was given the solution, too.
 * Another solution draws light alone; the atlas before it stays.
 */
#ifndef vtkRadiosityLightMap_h
#define vtkRadiosityLightMap_h

#include "lambertAtlasModule.h"
#include "vtkMultiBlockDataSetAlgorithm.h"

class LAMBERTATLAS_EXPORT vtkRadiosityLightMap : public vtkMultiBlockDataSetAlgorithm {
 public:
  static vtkRadiosityLightMap* New();
  vtkTypeMacro(vtkRadiosityLightMap, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Output port 0 of the method.
  void SetSolutionConnection(vtkAlgorithmOutput* solution) {
    this->SetInputConnection(1, solution);
  }

  ///@{ What the last run made. Seams: by how much lookups on the two sides of cuts differ, parts of
  /// the light there or of the mean, whichever is more; root of the mean square and the largest.
  vtkIdType GetCoveredTexels() { return this->CoveredTexels; }
  vtkIdType GetSeamPoints() { return this->SeamPoints; }
  double GetSeamRmsBefore() { return this->SeamRmsBefore; }
  double GetSeamRmsAfter() { return this->SeamRmsAfter; }
  double GetLargestSeamBefore() { return this->LargestSeamBefore; }
  double GetLargestSeamAfter() { return this->LargestSeamAfter; }
  ///@}
  /// How often light was drawn.
  int GetNumberOfDrawings() { return this->NumberOfDrawings; }

 protected:
  vtkRadiosityLightMap();
  ~vtkRadiosityLightMap() override = default;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkRadiosityLightMap(const vtkRadiosityLightMap&) = delete;
  void operator=(const vtkRadiosityLightMap&) = delete;

  vtkIdType CoveredTexels = 0, SeamPoints = 0;
  double SeamRmsBefore = 0, SeamRmsAfter = 0, LargestSeamBefore = 0, LargestSeamAfter = 0;
  int NumberOfDrawings = 0;
};

#endif
