// The shading language of vtkRadiosityActor: radiosity in place of the diffuse light of VTK's
// shaders, whose specular light stays. C++ only.
#ifndef RadiosityShader_h
#define RadiosityShader_h

#include "Display/Core/ToneMapping.h"

#include <array>
#include <string>

class vtkShaderProperty;

namespace lambert {
/// What the shader is made of.
struct RadiosityShaderParts {
  bool lightMap = false;      ///< the texture `lightMap` is there
  std::string baseTexture;    ///< name of the sampler of the base texture; empty: there is none
  bool isBaseEncoded = true;  ///< the base texture is sRGB and not yet decoded
  bool isPhysicallyBased = false;  ///< VTK's PBR shading, whose base colour also tints metals
  bool environment = false;  ///< the texture `environmentMap` is there, in longitude and latitude
  bool isEnvironmentEncoded = false;  ///< it is sRGB and not decoded
};

/// Puts the replacements into `shader`, in place of any that it had. The vertex attributes are
/// vertexRadiosityMC, vertexIrradianceMC, reflectanceMC (3 float) and lightMapCoordsMC (2 float).
void ReplaceDiffuseLight(const RadiosityShaderParts& parts, vtkShaderProperty* shader);

/// Where a texture of the surroundings is seen: rows are its right, its up and its front in view
/// coordinates; the eye is far away where the projection is parallel.
struct EnvironmentView {
  std::array<float, 9> fromView{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool isParallel = false;
  float specularPower = 1;
};
void SetEnvironmentView(const EnvironmentView& view, vtkShaderProperty* shader);

/// Sets the last level of the mip map of `lightMap` that is looked up.
void SetLightMapLevels(int last, vtkShaderProperty* shader);

/// Sets the uniforms that expose; with `linear` the fragments are radiosity in W/m2 alone.
void SetExposure(const ToneMapping& toneMapping, bool linear, vtkShaderProperty* shader);
}  // namespace lambert

#endif
