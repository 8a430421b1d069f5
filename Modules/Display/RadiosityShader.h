// The shading language of vtkRadiosityActor: radiosity in place of the diffuse light of VTK's
// shaders, whose specular light stays. C++ only.
#ifndef RadiosityShader_h
#define RadiosityShader_h

#include "Display/Core/ToneMapping.h"

#include <array>
#include <string>
#include <vector>

class vtkShaderProperty;

namespace lambert {
/// What the shader is made of; what is not there costs nothing.
struct RadiosityShaderParts {
  ToneCurve curve = ToneCurve::Photographic;
  bool isLinear = false;      ///< radiosity in W/m2 as it is, without specular light
  bool isSpecular = false;    ///< the renderer's lights are mirrored
  bool lightMap = false;      ///< the texture `lightMap` is there
  std::string baseTexture;    ///< name of the sampler of the base texture; empty: there is none
  bool isBaseEncoded = true;  ///< the base texture is sRGB and not yet decoded
  bool isPhysicallyBased = false;  ///< VTK's PBR shading, whose base colour also tints metals
  bool environment = false;  ///< the texture `environmentMap` is there, in longitude and latitude
  bool isEnvironmentEncoded = false;  ///< it is sRGB and not decoded
};

bool operator==(const RadiosityShaderParts& a, const RadiosityShaderParts& b);

/// A vertex attribute of the shader, floats.
struct RadiosityAttribute {
  const char* name;   ///< of the attribute
  const char* type;   ///< in the shader
  const char* array;  ///< of the points, from which it is read
};
/// Those that a shader of `parts` reads.
std::vector<RadiosityAttribute> AttributesOf(const RadiosityShaderParts& parts);

/// Puts the replacements into `shader`, in place of any that it had.
void ReplaceDiffuseLight(const RadiosityShaderParts& parts, vtkShaderProperty* shader);

/// Where a texture of the surroundings is seen: rows are its right, its up and its front in view
/// coordinates; the eye is far away where the projection is parallel.
struct EnvironmentView {
  std::array<float, 9> fromView{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool isParallel = false;
  float specularPower = 1;
};
void SetEnvironmentView(const EnvironmentView& view, vtkShaderProperty* shader);

/// Sets the uniforms that expose.
void SetExposure(const ToneMapping& toneMapping, vtkShaderProperty* shader);
}  // namespace lambert

#endif
