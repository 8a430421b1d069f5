/**
 * @class vtkRadiosityArrays
 * @brief Names of the arrays that flow between the stages; see Documentation/DataModel.md for units
 * and owners.
 */
#ifndef vtkRadiosityArrays_h
#define vtkRadiosityArrays_h

#include "lambertCommonModule.h"
#include "vtkObject.h"

class LAMBERTCOMMON_EXPORT vtkRadiosityArrays : public vtkObject {
 public:
  static vtkRadiosityArrays* New();
  vtkTypeMacro(vtkRadiosityArrays, vtkObject);

  ///@{ Cell arrays.
  static const char* Reflectance() { return "Reflectance"; }  ///< 3 float, [0, 0.98]
  static const char* Emittance() { return "Emittance"; }      ///< 3 float, exitance W/m2
  /// Bits 1 emits in front, 2 behind, 4 rewound
  static const char* FaceFlags() { return "FaceFlags"; }
  static const char* SurfaceId() { return "SurfaceId"; }        ///< int
  static const char* MaterialId() { return "MaterialId"; }      ///< int
  static const char* PartId() { return "PartId"; }              ///< int
  static const char* SourceCellId() { return "SourceCellId"; }  ///< vtkIdType
  static const char* InputFaceId() { return "InputFaceId"; }    ///< vtkIdType, refined mesh
  static const char* Side() { return "Side"; }                  ///< unsigned char, 0 front, 1 back
  static const char* ClusterId() { return "ClusterId"; }        ///< int
  static const char* ChartId() { return "ChartId"; }            ///< int, of an atlas
  static const char* PageId() { return "PageId"; }              ///< int, of an atlas
  static const char* RelativeError() { return "RelativeError"; }  ///< float, signed
  /// 3 float, W/m2, path traced in the middle of the cell
  static const char* ReferenceIrradiance() { return "ReferenceIrradiance"; }
  static const char* LeafId() { return "LeafId"; }  ///< vtkIdType, leaf element, refined mesh
  ///@}

  ///@{ Point arrays.
  static const char* Irradiance() { return "Irradiance"; }              ///< 3 float, W/m2
  static const char* Radiosity() { return "Radiosity"; }                ///< 3 float, W/m2
  static const char* IrradianceVector() { return "IrradianceVector"; }  ///< 9 float, W/m2
  /// 3 float, W/m2; of an error map at cells
  static const char* StandardError() { return "StandardError"; }
  static const char* LightMapTCoords() { return "LightMapTCoords"; }  ///< 2 float, [0, 1]
  /// vtkIdType: points that charts made of one have its number
  static const char* SharedPointId() { return "SharedPointId"; }
  /// 3 float, unit, of the surface that a point lies on
  static const char* GeometricNormals() { return "GeometricNormals"; }
  ///@}

  ///@{ Tables in the field data, a tuple a row: materials, parts, lights; atlas and camera.
  static const char* MaterialName() { return "Material.Name"; }                ///< string
  static const char* MaterialReflectance() { return "Material.Reflectance"; }  ///< 3 float
  static const char* MaterialEmittance() { return "Material.Emittance"; }      ///< 3 float, W/m2
  static const char* MaterialTwoSidedEmitter() { return "Material.TwoSidedEmitter"; }  ///< 0 or 1
  /// Int, of a piece of a scene: which rows of the scene's table its own are
  static const char* MaterialRow() { return "Material.Row"; }
  static const char* PartName() { return "Part.Name"; }      ///< string
  static const char* PartSource() { return "Part.Source"; }  ///< string, file or actor
  static const char* PartMeshId() { return "Part.MeshId"; }  ///< int, the same for instances
  static const char* PartObjectToWorld() { return "Part.ObjectToWorld"; }  ///< 16 double, row-major
  static const char* PartRow() { return "Part.Row"; }                      ///< int, as Material.Row
  static const char* LightName() { return "Light.Name"; }                  ///< string
  static const char* LightType() { return "Light.Type"; }  ///< int; the names stand in DataModel.md
  static const char* LightPosition() { return "Light.Position"; }    ///< 3 float, m
  static const char* LightDirection() { return "Light.Direction"; }  ///< 3 float, unit
  static const char* LightIntensity() { return "Light.Intensity"; }  ///< W/sr, W/m2, W/(m2 sr)
  static const char* LightHorizon() { return "Light.Horizon"; }      ///< 3 float, W/(m2 sr)
  static const char* LightGround() { return "Light.Ground"; }        ///< 3 float, W/(m2 sr)
  static const char* LightImage() { return "Light.Image"; }          ///< string, a file
  static const char* LightRotation() { return "Light.Rotation"; }    ///< float, radians
  static const char* LightSize() { return "Light.Size"; }  ///< radius, m; diameter, radians
  static const char* LightConeAngles() { return "Light.ConeAngles"; }    ///< 2 float, radians
  static const char* AtlasPageSize() { return "Atlas.PageSize"; }        ///< int, texels
  static const char* AtlasPadding() { return "Atlas.Padding"; }          ///< int, texels
  static const char* AtlasTexelSize() { return "Atlas.TexelSize"; }      ///< double, m
  static const char* CameraPosition() { return "Camera.Position"; }      ///< 3 double, m
  static const char* CameraFocalPoint() { return "Camera.FocalPoint"; }  ///< 3 double, m
  static const char* CameraViewUp() { return "Camera.ViewUp"; }          ///< 3 double
  /// Double, vertical, degrees
  static const char* CameraViewAngle() { return "Camera.ViewAngle"; }
  ///@}

 protected:
  vtkRadiosityArrays() = default;
  ~vtkRadiosityArrays() override = default;

 private:
  vtkRadiosityArrays(const vtkRadiosityArrays&) = delete;
  void operator=(const vtkRadiosityArrays&) = delete;
};

#endif
