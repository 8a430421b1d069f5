/**
 * @class vtkRadiosityArrays
 * @brief Names of the arrays that flow between the stages; see Documentation/DataModel.md for units and owners.
 */
#ifndef vtkRadiosityArrays_h
#define vtkRadiosityArrays_h

#include "lambertCommonModule.h"
#include "vtkObject.h"

class LAMBERTCOMMON_EXPORT vtkRadiosityArrays : public vtkObject
{
public:
  static vtkRadiosityArrays* New();
  vtkTypeMacro(vtkRadiosityArrays, vtkObject);

  ///@{ Cell arrays.
  static const char* Reflectance() { return "Reflectance"; }   ///< 3 float, [0, 0.98]
  static const char* Emittance() { return "Emittance"; }       ///< 3 float, exitance W/m2
  static const char* FaceFlags() { return "FaceFlags"; }       ///< unsigned char, bits: 1 emits from the front, 2 from the back, 4 rewound
  static const char* SurfaceId() { return "SurfaceId"; }       ///< int
  static const char* MaterialId() { return "MaterialId"; }     ///< int
  static const char* PartId() { return "PartId"; }             ///< int
  static const char* SourceCellId() { return "SourceCellId"; } ///< vtkIdType
  static const char* InputFaceId() { return "InputFaceId"; }   ///< vtkIdType, refined mesh only
  static const char* Side() { return "Side"; }                 ///< unsigned char, 0 front, 1 back
  static const char* ClusterId() { return "ClusterId"; }       ///< int
  ///@}

  ///@{ Point arrays.
  static const char* Irradiance() { return "Irradiance"; }             ///< 3 float, W/m2
  static const char* Radiosity() { return "Radiosity"; }               ///< 3 float, W/m2
  static const char* IrradianceVector() { return "IrradianceVector"; } ///< 9 float, W/m2
  ///@}

protected:
  vtkRadiosityArrays() = default;
  ~vtkRadiosityArrays() override = default;

private:
  vtkRadiosityArrays(const vtkRadiosityArrays&) = delete;
  void operator=(const vtkRadiosityArrays&) = delete;
};

#endif
