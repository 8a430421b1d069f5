/**
 * @class vtkRadiosityActor
 * @brief Draws a solved scene in any vtkRenderer: radiosity, with the renderer's specular light.
 *
 * Its data is a vtkPolyData of triangles as a radiosity method leaves it, lit by its points
 * (`Irradiance`, `Radiosity`), or as vtkRadiosityAtlas does, lit by the pages of a light map
 * (`LightMapTCoords`, `PageId`; `Atlas.Padding` tells how far mip maps may go), or both kinds in
 * one mesh: points whose LightMapTCoords lie outside of [0, 1] are lit by themselves. All is drawn
 * in one state, with neutral elements for what a point has not got (thesis 6.5.1).
 *
 * Shown is radiosity = emittance + reflectance x irradiance, linear, then tone mapped, plus the
 * specular part of the actor's vtkProperty under the renderer's lights: its ambient and diffuse
 * parts are left out, of physically based shading too. Where the renderer has an environment
 * texture and image based lighting is on (vtkRenderer::SetEnvironmentTexture,
 * UseImageBasedLightingOn), surfaces mirror it as their specular part tells, whatever their shading
 * (thesis 6.5). A texture of the actor (SetTexture, or the base colour texture of physically based
 * shading) takes the place of the reflectance at the TCoords. Where cells have `Side`, back faces
 * are culled: a lit back side has faces of its own.
 */
#ifndef vtkRadiosityActor_h
#define vtkRadiosityActor_h

#include "lambertDisplayModule.h"
#include "vtkOpenGLActor.h"
#include "vtkSmartPointer.h"  // for what it is made of

#include <memory>  // for the pages
#include <vector>  // for the pages

namespace lambert {
struct LightImage;
struct LuminanceSample;
struct RadiosityShaderParts;
class ToneMapping;
}  // namespace lambert

class vtkImageData;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRadiosityToneMapping;
class vtkRenderer;
class vtkTexture;

class LAMBERTDISPLAY_EXPORT vtkRadiosityActor : public vtkOpenGLActor {
 public:
  static vtkRadiosityActor* New();
  vtkTypeMacro(vtkRadiosityActor, vtkOpenGLActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ The solved mesh; changes of it are seen when the actor is drawn.
  void SetInputData(vtkPolyData* mesh);
  vtkPolyData* GetInputData();
  ///@}

  ///@{ The pages of the light map, in their order, one size for all: irradiance in W/m2, three
  /// components, the row of v = 0 first.
  void AddLightMapPage(vtkImageData* page);
  void RemoveLightMap();
  int GetNumberOfLightMapPages() { return static_cast<int>(this->Pages.size()); }
  ///@}

  /// Where curve, key, exposure, white and steadiness are set. It adapts to the whole mesh.
  vtkGetObjectMacro(ToneMapping, vtkRadiosityToneMapping);

  ///@{ Leaves radiosity in W/m2 as it is, without specular light: for frame buffers of floats.
  /// Default off.
  vtkSetMacro(LinearLight, bool);
  vtkGetMacro(LinearLight, bool);
  vtkBooleanMacro(LinearLight, bool);
  ///@}

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  using Superclass::GetBounds;
  double* GetBounds() override;

 protected:
  vtkRadiosityActor();
  ~vtkRadiosityActor() override;

 private:
  vtkRadiosityActor(const vtkRadiosityActor&) = delete;
  void operator=(const vtkRadiosityActor&) = delete;

  /// True where there is something to draw.
  bool Update();
  void UpdateAppearance();
  void UpdateLightMap();
  void UpdateShader();
  /// What surfaces mirror: the renderer's environment texture, where shading is not physically
  /// based, which mirrors it by itself.
  void UpdateEnvironment(vtkRenderer* renderer);
  /// The light map on the renderer's device, with the mip maps that are safe.
  void LoadLightMap(vtkRenderer* renderer);
  /// The base texture, if any, and the name of its sampler.
  vtkTexture* BaseTexture(const char** sampler);

  vtkSmartPointer<vtkPolyData> Mesh;
  std::vector<vtkSmartPointer<vtkImageData>> Pages;
  vtkRadiosityToneMapping* ToneMapping;
  bool LinearLight = false;

  vtkSmartPointer<vtkPolyData> Drawn;  ///< the mesh with what its points bring
  vtkSmartPointer<vtkPolyDataMapper> LightMapper;
  vtkSmartPointer<vtkTexture> LightMapTexture;
  vtkSmartPointer<vtkTexture> Environment;        ///< of the renderer, as it was last drawn in
  std::unique_ptr<lambert::LightImage> LightMap;  ///< the pages, one above the other
  std::vector<lambert::LuminanceSample> Samples;  ///< of what is shown
  std::unique_ptr<lambert::ToneMapping> Exposure;
  std::unique_ptr<lambert::RadiosityShaderParts> ShaderParts;  ///< of the shader that is there
  bool IsTextured = false;
  vtkTimeStamp InputTime, AppearanceTime, ExposureTime;
};

#endif
