/**
 * @class vtkRadiosityAtlas
 * @brief A texture atlas for light maps: every surface in charts, laid flat and packed on pages.
 *
 * Input port 0: vtkPolyData of triangles in world space, with the arrays of vtkRadiosityArrays that
 * it has. Input port 1 (optional): vtkTable, its cluster tree, as vtkFaceClustering leaves both;
 * without it the filter clusters. Input port 2 (optional): vtkPolyData, output port 0 of a
 * radiosity method that solved the same mesh: both sides of sheets that are lit on both get charts,
 * as faces of their own, and where there are such, all faces are wound towards the side that they
 * show, with cell arrays `InputFaceId` and `Side`. Output: the mesh in the order of the tree,
 * points split where charts meet, with point array `LightMapTCoords` (2 float, [0, 1], v upward)
 * and cell arrays `ChartId` and `PageId`. What is still valid is not made again: another page size,
 * padding or texel size packs the charts anew, and cuts them anew only where one would be cut or
 * taken otherwise. Charts are clusters that least squares conformal maps lay flat without overlaps
 * (thesis 5.2, levy2002).
 */
#ifndef vtkRadiosityAtlas_h
#define vtkRadiosityAtlas_h

#include "lambertAtlasModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <functional>  // for progress
#include <memory>      // for the options

namespace lambert {
struct RadiositySolution;
struct AtlasOptions;
}  // namespace lambert

class vtkTable;

class LAMBERTATLAS_EXPORT vtkRadiosityAtlas : public vtkPolyDataAlgorithm {
 public:
  static vtkRadiosityAtlas* New();
  vtkTypeMacro(vtkRadiosityAtlas, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ By which lengths in a chart grow or shrink at most, as a factor, [1, inf); default 2.
  void SetStretch(double stretch);
  double GetStretch();
  ///@}
  ///@{ Texels along a side of a page, [16, 16384]; default 1024.
  void SetPageSize(int texels);
  int GetPageSize();
  ///@}
  ///@{ Pages that charts may take, [1, inf), default 1; counts where TexelSize is 0.
  void SetPages(int pages);
  int GetPages();
  ///@}
  ///@{ Size of a texel, m, [0, inf), on up to 256 pages; default 0: what fills the pages.
  void SetTexelSize(double metres);
  double GetTexelSize();
  ///@}
  ///@{ Texels between a chart and the edge of what it takes, [0, 64]; default 2.
  void SetPadding(int texels);
  int GetPadding();
  ///@}
  ///@{ Levels of mip maps above the pages themselves that take in nothing of other charts, [0, 5];
  /// default 0: padding of 1.5 * 2^levels texels at least.
  void SetMipLevels(int levels);
  int GetMipLevels();
  ///@}
  enum Density { UNIFORM = 0, ILLUMINATION = 1 };
  ///@{ ILLUMINATION, with a solution: finer texels where the light map would be off by more, as
  /// many
  /// in all. Default UNIFORM.
  void SetTexelDensity(int density);
  int GetTexelDensity();
  ///@}
  /// The cluster tree of the input, as vtkFaceClustering's port 1 has it.
  void SetClusterConnection(vtkAlgorithmOutput* tree) { this->SetInputConnection(1, tree); }

  /// Output port 0 of the method.
  void SetSolutionConnection(vtkAlgorithmOutput* solution) {
    this->SetInputConnection(2, solution);
  }

  ///@{ What the last run made.
  vtkIdType GetNumberOfCharts() { return this->NumberOfCharts; }
  int GetNumberOfPages() { return this->NumberOfPages; }
  double GetDeliveredTexelSize() { return this->DeliveredTexelSize; }  ///< m
  /// Area of charts over that of pages.
  double GetUtilisation() { return this->Utilisation; }
  ///@}
  ///@{ How often faces were clustered or taken in, cut into charts, and charts packed.
  int GetNumberOfReadings() { return this->NumberOfReadings; }
  int GetNumberOfSegmentations() { return this->NumberOfSegmentations; }
  int GetNumberOfPackings() { return this->NumberOfPackings; }
  ///@}

 protected:
  vtkRadiosityAtlas();
  ~vtkRadiosityAtlas() override;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkRadiosityAtlas(const vtkRadiosityAtlas&) = delete;
  void operator=(const vtkRadiosityAtlas&) = delete;

  struct Kept;
  using Progress = std::function<bool(double fraction, const char* stage)>;
  void TakeIn(vtkPolyData* mesh, vtkTable* tree, const Progress& progress);
  /// The sides that the charts are of; where they are others than before, charts are cut anew.
  void FindSides(const lambert::RadiositySolution* solution, vtkMTimeType time);

  std::unique_ptr<lambert::AtlasOptions> Options;
  std::unique_ptr<Kept> Last;  ///< what the last run made
  vtkIdType NumberOfCharts = 0;
  int NumberOfPages = 0;
  double DeliveredTexelSize = 0, Utilisation = 0;
  int NumberOfReadings = 0, NumberOfSegmentations = 0, NumberOfPackings = 0;
};

#endif
