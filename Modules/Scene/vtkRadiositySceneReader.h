/**
 * @class vtkRadiositySceneReader
 * @brief Reads a lit scene from files, cleans it up and delivers it as one vtkPolyData.
 *
 * OBJ+MTL, glTF/GLB, PLY, STL and what else Assimp knows, VTP, and VTPC, whose pieces make one
 * scene. The output is triangles in world space, in metres, with the cell and point arrays of
 * vtkRadiosityArrays; materials, parts, lights and the camera lie in its field data. What was read
 * and what was changed is told by GetReportJson(). An unreadable file and a scene without a
 * triangle that has area end in one error message.
 */
#ifndef vtkRadiositySceneReader_h
#define vtkRadiositySceneReader_h

#include "lambertSceneModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options
#include <string>  // for names

class LAMBERTSCENE_EXPORT vtkRadiositySceneReader : public vtkPolyDataAlgorithm {
 public:
  static vtkRadiositySceneReader* New();
  vtkTypeMacro(vtkRadiositySceneReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ The files, read one after the other into one scene. Setting one replaces all.
  void SetFileName(const std::string& name);
  std::string GetFileName();
  void AddFileName(const std::string& name);
  void ClearFileNames();
  int GetNumberOfFileNames();
  std::string GetFileName(int index);
  ///@}

  ///@{ Length unit, above 0; default 0: the file's own, else 1.
  void SetMetresPerUnit(double metres);
  double GetMetresPerUnit();
  ///@}
  ///@{ Diffuse reflectance (R, G, B) in [0, 0.98] of faces whose file gives none; default 0.5.
  vtkSetVector3Macro(DefaultReflectance, double);
  vtkGetVector3Macro(DefaultReflectance, double);
  ///@}
  ///@{ Every emitter emits from both sides, each with its full exitance; default off.
  void SetTwoSidedEmitters(bool on);
  bool GetTwoSidedEmitters();
  vtkBooleanMacro(TwoSidedEmitters, bool);
  ///@}
  ///@{ Transparent materials block and reflect; default off: they are left out, so that windows let
  /// light in.
  void SetOpaqueGlass(bool on);
  bool GetOpaqueGlass();
  vtkBooleanMacro(OpaqueGlass, bool);
  ///@}
  ///@{ Metals reflect base colour x (1 - metallic) instead of their base colour; default off.
  void SetBlackMetals(bool on);
  bool GetBlackMetals();
  vtkBooleanMacro(BlackMetals, bool);
  ///@}

  ///@{ Join points of a part where position, normal and uv agree; default on.
  void SetWeld(bool on);
  bool GetWeld();
  vtkBooleanMacro(Weld, bool);
  ///@}
  ///@{ Drop triangles without area; default on.
  void SetRemoveZeroArea(bool on);
  bool GetRemoveZeroArea();
  vtkBooleanMacro(RemoveZeroArea, bool);
  ///@}
  ///@{ Drop triangles that repeat another of their part, in either winding; default on.
  void SetRemoveRepeated(bool on);
  bool GetRemoveRepeated();
  vtkBooleanMacro(RemoveRepeated, bool);
  ///@}
  ///@{ Wind connected pieces consistently; emission keeps its side; default on.
  void SetOrient(bool on);
  bool GetOrient();
  vtkBooleanMacro(Orient, bool);
  ///@}
  ///@{ Turn closed emitting pieces that are wound inward with nothing inside; default on.
  void SetFixEmitters(bool on);
  bool GetFixEmitters();
  vtkBooleanMacro(FixEmitters, bool);
  ///@}
  ///@{ Angle in degrees, [0, 180], up to which normals are smooth where the file has none;
  /// default 30.
  void SetFeatureAngle(double degrees);
  double GetFeatureAngle();
  ///@}

  ///@{ Radiance (R, G, B) of a uniform sky in W/(m2 sr), added to the file's lights; default 0:
  /// none.
  vtkSetVector3Macro(Sky, double);
  vtkGetVector3Macro(Sky, double);
  ///@}
  ///@{ Changes by name: "MATERIAL:reflectance=R,G,B", "MATERIAL:emission=R,G,B" (radiance, W/(m2
  /// sr)) or "MATERIAL:two-sided"; several joined by '|'.
  void AddMaterialSetting(const std::string& setting);
  void ClearMaterialSettings();
  int GetNumberOfMaterialSettings();
  ///@}

  /// What was read and what was changed, as JSON: objects "read" and "cleaning" with every count,
  /// and "warnings". Empty before the first successful update.
  std::string GetReportJson();

 protected:
  vtkRadiositySceneReader();
  ~vtkRadiositySceneReader() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkRadiositySceneReader(const vtkRadiositySceneReader&) = delete;
  void operator=(const vtkRadiositySceneReader&) = delete;

  struct Settings;
  std::unique_ptr<Settings> Options;
  double DefaultReflectance[3];
  double Sky[3] = {0, 0, 0};
};

#endif
