/**
 * @class vtkSurfaceRepresentation
 * @brief How each surface of a solved mesh shows its light: at its points or in a light map (thesis
 * 5.1, 5.3).
 *
 * Input port 0: vtkPolyData, the mesh that was solved, as vtkFaceClustering leaves it. Input port
 * 1: vtkTable, its cluster tree. Input port 2: vtkPolyData, output port 0 of the method. Output
 * port 0: vtkPolyData, all surfaces, those of the light map first: point arrays `Irradiance` (3
 * float, W/m2), `LightMapTCoords` (2 float; (-1, -1) where the points light) and `SharedPointId`,
 * cell arrays `ChartId` (-1 where the points light), `PageId`, `InputFaceId` and `SurfaceId` (of
 * the mesh that was solved). Output port 1: vtkMultiBlockDataSet, the pages, as
 * vtkRadiosityLightMap has them. Output port 2: vtkTable, a row a surface: `LightMapped` (0 or 1),
 * `InputTriangles`, `RefinedTriangles`, `Area` (m2), `Texels` (in the light map, or were it
 * there; -1 where there is none), `MapError` (relative RMS of irradiance; -1 outside the light
 * map), `Surface` and `Side`: a sheet that is lit on both sides has a row for each, a surface that
 * is cut one for each part. With sheets the faces of port 0 then have `Side`, too, and are wound
 * towards it. What is still valid is not made again: other options leave what the inputs say,
 * another page size, padding or texel size packs the same charts anew, and what leaves every
 * surface as it was shown leaves charts and light.
 */
#ifndef vtkSurfaceRepresentation_h
#define vtkSurfaceRepresentation_h

#include "lambertAtlasModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options
#include <string>  // for names

class vtkTable;

class LAMBERTATLAS_EXPORT vtkSurfaceRepresentation : public vtkPolyDataAlgorithm {
 public:
  static vtkSurfaceRepresentation* New();
  vtkTypeMacro(vtkSurfaceRepresentation, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ Triangles that refinement may add to all surfaces that their points light, [0, inf); default
  /// 0.
  void SetIntroducedTriangles(vtkIdType triangles);
  vtkIdType GetIntroducedTriangles();
  ///@}
  ///@{ Whether AUTOMATIC surfaces are cut into clusters, each of its own kind, with hardly a
  /// step between them where they are large and flat; default off.
  void SetSplitSurfaces(bool split);
  bool GetSplitSurfaces();
  vtkBooleanMacro(SplitSurfaces, bool);
  ///@}
  enum Kind { AUTOMATIC = 0, POINTS = 1, LIGHT_MAP = 2 };
  ///@{ What is wanted of the surfaces of a material or a part, by its name, and of one surface, by
  /// its number (`SurfaceId`, column `Surface` of port 2); default AUTOMATIC, as the triangles
  /// tell. The narrowest counts: surface before part before material.
  void SetRepresentation(const std::string& material, int kind);
  int GetRepresentation(const std::string& material);
  void SetPartRepresentation(const std::string& part, int kind);
  int GetPartRepresentation(const std::string& part);
  void SetSurfaceRepresentation(int surface, int kind);
  int GetSurfaceRepresentation(int surface);
  ///@}

  enum Density { UNIFORM = 0, ILLUMINATION = 1 };
  ///@{ Of the light map, as vtkRadiosityAtlas has them.
  void SetStretch(double stretch);
  double GetStretch();
  void SetPageSize(int texels);
  int GetPageSize();
  void SetPages(int pages);
  int GetPages();
  void SetTexelSize(double metres);
  double GetTexelSize();
  void SetPadding(int texels);
  int GetPadding();
  void SetMipLevels(int levels);
  int GetMipLevels();
  void SetTexelDensity(int density);
  int GetTexelDensity();
  ///@}

  ///@{ The other inputs.
  void SetClusterConnection(vtkAlgorithmOutput* tree) { this->SetInputConnection(1, tree); }
  void SetSolutionConnection(vtkAlgorithmOutput* solution) {
    this->SetInputConnection(2, solution);
  }
  ///@}

  ///@{ How often the inputs were taken in, surfaces of the light map cut into charts, and charts
  /// packed and their light drawn.
  int GetNumberOfReadings() { return this->NumberOfReadings; }
  int GetNumberOfSegmentations() { return this->NumberOfSegmentations; }
  int GetNumberOfPackings() { return this->NumberOfPackings; }
  ///@}

 protected:
  vtkSurfaceRepresentation();
  ~vtkSurfaceRepresentation() override;
  int FillInputPortInformation(int port, vtkInformation* information) override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkSurfaceRepresentation(const vtkSurfaceRepresentation&) = delete;
  void operator=(const vtkSurfaceRepresentation&) = delete;

  struct Settings;
  struct Kept;
  void TakeIn(vtkPolyData* mesh, vtkTable* tree, vtkPolyData* solution);

  std::unique_ptr<Settings> Options;
  std::unique_ptr<Kept> Last;  ///< what the last run made
  int NumberOfReadings = 0, NumberOfSegmentations = 0, NumberOfPackings = 0;
};

#endif
