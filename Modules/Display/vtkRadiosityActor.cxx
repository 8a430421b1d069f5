#include "vtkRadiosityActor.h"

#include "Common/Core/Error.h"
#include "Display/Core/PointAppearance.h"
#include "RadiosityShader.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLTexture.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRadiosityArrays.h"
#include "vtkRadiosityToneMapping.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"
#include "vtkTriangleMeshAdapter.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkRadiosityActor);

namespace {
using Names = vtkRadiosityArrays;

lambert::PointLight LightOf(vtkPolyData* mesh, int pages) {
  vtkPointData* points = mesh->GetPointData();
  lambert::PointLight light;
  light.irradiance = lambert::TuplesFromArray<lambert::Spectrum>(
      points->GetArray(Names::Irradiance()), Names::Irradiance());
  light.radiosity = lambert::TuplesFromArray<lambert::Spectrum>(
      points->GetArray(Names::Radiosity()), Names::Radiosity());
  light.lightMapCoords = lambert::TuplesFromArray<lambert::Vec2f>(
      points->GetArray(Names::LightMapTCoords()), Names::LightMapTCoords());
  light.pages = pages;
  light.page = lambert::NumbersFromArray<int32_t>(mesh->GetCellData()->GetArray(Names::PageId()));
  return light;
}

/// Gives `property` a texture, or none, by the name of its sampler.
void Bind(const char* sampler, vtkTexture* texture, vtkProperty* property) {
  if (property->GetTexture(sampler) == texture) {
    return;
  }
  property->RemoveTexture(sampler);
  if (texture) {
    property->SetTexture(sampler, texture);
  }
}
}  // namespace

vtkRadiosityActor::vtkRadiosityActor()
    : ToneMapping(vtkRadiosityToneMapping::New()),
      Drawn(vtkSmartPointer<vtkPolyData>::New()),
      LightMapper(vtkSmartPointer<vtkPolyDataMapper>::New()),
      LightMapTexture(vtkSmartPointer<vtkTexture>::New()),
      LightMap(new lambert::LightImage) {
  // One state for all.
  this->LightMapper->ScalarVisibilityOff();
  this->LightMapper->SetInputData(this->Drawn);
  this->SetMapper(this->LightMapper);

  // A light map as it is.
  this->LightMapTexture->SetColorModeToDirectScalars();
  this->LightMapTexture->InterpolateOn();
  this->LightMapTexture->MipmapOn();
  this->LightMapTexture->SetMaximumAnisotropicFiltering(1);
  this->LightMapTexture->SetWrap(vtkTexture::ClampToEdge);
}

vtkRadiosityActor::~vtkRadiosityActor() { this->ToneMapping->Delete(); }

void vtkRadiosityActor::SetInputData(vtkPolyData* mesh) {
  this->Mesh = mesh;
  this->InputTime.Modified();
  this->Modified();
}

vtkPolyData* vtkRadiosityActor::GetInputData() { return this->Mesh; }

void vtkRadiosityActor::AddLightMapPage(vtkImageData* page) {
  this->Pages.emplace_back(page);
  this->InputTime.Modified();
  this->Modified();
}

void vtkRadiosityActor::RemoveLightMap() {
  this->Pages.clear();
  this->InputTime.Modified();
  this->Modified();
}

vtkTexture* vtkRadiosityActor::BaseTexture(const char** sampler) {
  vtkTexture* baseColor = this->GetProperty()->GetInterpolation() == VTK_PBR
                              ? this->GetProperty()->GetTexture("albedoTex")
                              : nullptr;
  *sampler = baseColor ? "albedoTex" : "actortexture";
  vtkTexture* texture = baseColor ? baseColor : this->GetTexture();
  return this->Mesh->GetPointData()->GetTCoords() ? texture : nullptr;
}

bool vtkRadiosityActor::Update() {
  if (!this->Mesh || this->Mesh->GetNumberOfPoints() == 0) {
    this->Drawn->Initialize();
    return false;
  }
  try {
    const char* sampler = nullptr;
    const bool isTextured = this->BaseTexture(&sampler) != nullptr;
    if (std::max(this->InputTime.GetMTime(), this->Mesh->GetMTime()) > this->AppearanceTime ||
        isTextured != this->IsTextured) {
      this->IsTextured = isTextured;
      this->UpdateLightMap();
      this->UpdateAppearance();
      this->AppearanceTime.Modified();
    }
    this->UpdateShader();
    return true;
  } catch (const std::exception& error) {
    this->Drawn->Initialize();
    vtkErrorMacro(<< error.what());
    return false;
  }
}

void vtkRadiosityActor::UpdateLightMap() {
  *this->LightMap = {};
  if (this->Pages.empty()) {
    return;
  }

  // The pages one above the other.
  const int* size = this->Pages[0]->GetDimensions();
  this->LightMap->width = size[0];
  this->LightMap->height = size[1] * static_cast<int>(this->Pages.size());
  for (const auto& page : this->Pages) {
    if (!std::equal(size, size + 3, page->GetDimensions()) || !page->GetPointData()->GetScalars()) {
      throw lambert::Error("The pages of a light map need light in them and one size for all.");
    }
    const auto light = lambert::TuplesFromArray<lambert::Spectrum>(
        page->GetPointData()->GetScalars(), "of a page");
    this->LightMap->pixels.insert(this->LightMap->pixels.end(), light.begin(), light.end());
  }

  // As a texture of floats.
  vtkNew<vtkImageData> image;
  image->SetDimensions(this->LightMap->width, this->LightMap->height, 1);
  image->GetPointData()->SetScalars(lambert::ArrayFromTuples("Irradiance", this->LightMap->pixels));
  this->LightMapTexture->SetInputData(image);
}

void vtkRadiosityActor::UpdateAppearance() {
  // What the points bring.
  const lambert::TriangleMesh mesh = lambert::TriangleMeshFromPolyData(this->Mesh);
  const lambert::PointAppearance appearance = lambert::MakePointAppearance(
      mesh, LightOf(this->Mesh, this->GetNumberOfLightMapPages()), this->IsTextured);
  this->Drawn->Initialize();
  this->Drawn->CopyStructure(this->Mesh);
  vtkPointData* points = this->Drawn->GetPointData();
  points->SetNormals(this->Mesh->GetPointData()->GetNormals());
  points->SetTCoords(this->Mesh->GetPointData()->GetTCoords());
  points->AddArray(lambert::ArrayFromTuples("Shown.VertexRadiosity", appearance.vertexRadiosity));
  points->AddArray(lambert::ArrayFromTuples("Shown.VertexIrradiance", appearance.vertexIrradiance));
  points->AddArray(lambert::ArrayFromTuples("Shown.Reflectance", appearance.reflectance));
  points->AddArray(lambert::ArrayFromTuples("Shown.LightMapTCoords", appearance.lightMapCoords));

  // What the eye adapts to.
  this->Samples = lambert::ShownSamples(mesh, appearance, *this->LightMap);
}

void vtkRadiosityActor::LoadLightMap(vtkRenderer* renderer) {
  if (!renderer || this->Pages.empty()) {
    return;
  }

  // Mip maps as far as charts lie apart.
  vtkDataArray* padding = this->Mesh->GetFieldData()->GetArray(Names::AtlasPadding());
  const bool isKnown = padding && padding->GetNumberOfTuples() == 1;
  const int last =
      isKnown ? lambert::SafeMipLevel(static_cast<int>(padding->GetComponent(0, 0))) : 0;
  this->LightMapTexture->Render(renderer);
  vtkOpenGLTexture* texture = vtkOpenGLTexture::SafeDownCast(this->LightMapTexture);
  if (texture && texture->GetTextureObject()) {
    texture->GetTextureObject()->SetMaxLevel(last);
  }
}

void vtkRadiosityActor::UpdateEnvironment(vtkRenderer* renderer) {
  vtkTexture* texture = renderer && renderer->GetUseImageBasedLighting() &&
                                this->GetProperty()->GetInterpolation() != VTK_PBR &&
                                this->GetProperty()->GetLighting()
                            ? renderer->GetEnvironmentTexture()
                            : nullptr;
  this->Environment = texture;
  Bind("environmentMap", texture, this->GetProperty());
  if (!texture) {
    return;
  }

  // Its axes as the camera sees them.
  double right[3], up[3], front[3];
  std::copy_n(renderer->GetEnvironmentRight(), 3, right);
  std::copy_n(renderer->GetEnvironmentUp(), 3, up);
  vtkMath::Cross(right, up, front);
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkMatrix4x4* toView = camera->GetViewTransformMatrix();
  lambert::EnvironmentView view;
  size_t entry = 0;
  for (const double* axis : {right, up, front}) {
    for (int column = 0; column < 3; ++column) {
      double along = 0;
      for (int k = 0; k < 3; ++k) {
        along += toView->GetElement(column, k) * axis[k];
      }
      view.fromView[entry++] = static_cast<float>(along);
    }
  }
  view.isParallel = camera->GetParallelProjection() != 0;
  view.specularPower = static_cast<float>(this->GetProperty()->GetSpecularPower());
  lambert::SetEnvironmentView(view, this->GetShaderProperty());
}

void vtkRadiosityActor::UpdateShader() {
  // The property of the moment: the sides that are there, and the light map.
  this->GetProperty()->SetBackfaceCulling(this->Mesh->GetCellData()->HasArray(Names::Side()));
  Bind("lightMap", this->Pages.empty() ? nullptr : this->LightMapTexture.Get(),
       this->GetProperty());

  // What it is made of.
  const char* sampler = nullptr;
  vtkTexture* base = this->BaseTexture(&sampler);
  lambert::RadiosityShaderParts parts;
  parts.isLinear = this->LinearLight;
  parts.isSpecular = !this->LinearLight && this->GetProperty()->GetLighting() &&
                     (this->GetProperty()->GetInterpolation() == VTK_PBR ||
                      this->GetProperty()->GetSpecular() > 0);
  parts.lightMap = !this->Pages.empty();
  parts.baseTexture = base ? sampler : "";
  parts.isBaseEncoded = base && !base->GetUseSRGBColorSpace();
  parts.isPhysicallyBased = this->GetProperty()->GetInterpolation() == VTK_PBR;
  parts.environment = this->Environment != nullptr;
  parts.isEnvironmentEncoded = parts.environment && !this->Environment->GetUseSRGBColorSpace() &&
                               this->Environment->GetColorMode() != VTK_COLOR_MODE_DIRECT_SCALARS;

  // Exposure.
  if (std::max(this->AppearanceTime.GetMTime(), this->ToneMapping->GetMTime()) >
      this->ExposureTime) {
    this->Exposure.reset(new lambert::ToneMapping(this->ToneMapping->Adapt(this->Samples)));
    this->ExposureTime.Modified();
  }
  parts.curve = this->Exposure->Curve();
  lambert::SetExposure(*this->Exposure, this->GetShaderProperty());

  // VTK builds it anew where its parts have changed or are gone, and not every frame.
  if (this->ShaderParts && *this->ShaderParts == parts &&
      this->GetShaderProperty()->GetNumberOfShaderReplacements() > 0) {
    return;
  }
  this->ShaderParts.reset(new lambert::RadiosityShaderParts(parts));
  lambert::ReplaceDiffuseLight(parts, this->GetShaderProperty());
  this->LightMapper->RemoveAllVertexAttributeMappings();
  for (const lambert::RadiosityAttribute& attribute : lambert::AttributesOf(parts)) {
    this->LightMapper->MapDataArrayToVertexAttribute((std::string(attribute.name) + "MC").c_str(),
                                                     attribute.array,
                                                     vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
}

int vtkRadiosityActor::RenderOpaqueGeometry(vtkViewport* viewport) {
  if (!this->Mesh) {
    return 0;
  }
  vtkRenderer* renderer = vtkRenderer::SafeDownCast(viewport);
  this->UpdateEnvironment(renderer);
  if (!this->Update()) {
    return 0;
  }
  this->LoadLightMap(renderer);
  return this->Superclass::RenderOpaqueGeometry(viewport);
}

double* vtkRadiosityActor::GetBounds() {
  this->Update();
  return this->Superclass::GetBounds();
}

void vtkRadiosityActor::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LightMapPages: " << this->Pages.size() << "\n"
     << indent << "LinearLight: " << this->LinearLight << "\n";
}
