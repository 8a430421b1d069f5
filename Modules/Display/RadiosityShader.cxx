#include "RadiosityShader.h"

#include "vtkShaderProperty.h"
#include "vtkUniforms.h"

namespace lambert {
namespace {
const char* const kVertexDeclarations = R"(
in vec3 vertexRadiosityMC;
in vec3 vertexIrradianceMC;
in vec3 reflectanceMC;
in vec2 lightMapCoordsMC;
out vec3 vertexRadiosityVSOutput;
out vec3 vertexIrradianceVSOutput;
out vec3 reflectanceVSOutput;
out vec2 lightMapCoordsVSOutput;
)";

const char* const kVertexCode = R"(
  vertexRadiosityVSOutput = vertexRadiosityMC;
  vertexIrradianceVSOutput = vertexIrradianceMC;
  reflectanceVSOutput = reflectanceMC;
  lightMapCoordsVSOutput = lightMapCoordsMC;
)";

// Core/ToneCurve and Core/ToneMapping, once more.
const char* const kFragmentDeclarations = R"(
in vec3 vertexRadiosityVSOutput;
in vec3 vertexIrradianceVSOutput;
in vec3 reflectanceVSOutput;
in vec2 lightMapCoordsVSOutput;

vec3 LinearFromSrgb(vec3 code)
{
  vec3 power = pow((code + 0.055) / 1.055, vec3(2.4));
  return mix(power, code / 12.92, lessThanEqual(code, vec3(0.04045)));
}
vec3 SrgbFromLinear(vec3 light)
{
  vec3 power = 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055;
  return mix(power, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}
vec3 FilmicResponse(vec3 x)
{
  return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
}
vec3 Displayed(vec3 radiosity)
{
  vec3 keyed = exposureScale * max(radiosity, vec3(0.0));
  float luminance = dot(keyed, vec3(0.2126, 0.7152, 0.0722));
  vec3 display = keyed;
  if (toneCurve == 0)
  {
    display = keyed * (1.0 + luminance / (fullWhite * fullWhite)) / (1.0 + luminance);
  }
  if (toneCurve == 2)
  {
    display = FilmicResponse(2.0 * keyed) / FilmicResponse(vec3(2.0 * fullWhite));
  }
  return SrgbFromLinear(clamp(display, 0.0, 1.0));
}
)";

/// What VTK puts at the tag, then ours.
std::string Behind(const std::string& tag, const std::string& code) { return tag + "\n" + code; }

/// Radiosity at the fragment, displayed, and the specular light that VTK has worked out.
std::string FragmentCode(const RadiosityShaderParts& parts) {
  std::string base = "reflectanceVSOutput";
  if (!parts.baseTexture.empty()) {
    base = "texture(" + parts.baseTexture + ", tcoordVCVSOutput).rgb";
    base = parts.isBaseEncoded ? "LinearFromSrgb(" + base + ")" : base;
  }
  const std::string map =
      parts.lightMap ? "texture(lightMap, lightMapCoordsVSOutput).rgb" : "vec3(0.0)";
  return "  vec3 radiosity = vertexRadiosityVSOutput + " + base +
         " * (vertexIrradianceVSOutput + " + map +
         ");\n"
         "  gl_FragData[0] = vec4(linearLight == 1 ? radiosity : Displayed(radiosity) + "
         "specularLight, opacity);\n";
}
}  // namespace

void ReplaceDiffuseLight(const RadiosityShaderParts& parts, vtkShaderProperty* shader) {
  shader->ClearAllShaderReplacements();
  const auto addToFragments = [&](const char* tag, const std::string& code) {
    shader->AddFragmentShaderReplacement(tag, true, Behind(tag, code), false);
  };

  // What the points bring.
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true,
                                     Behind("//VTK::Normal::Dec", kVertexDeclarations), false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true,
                                     Behind("//VTK::Normal::Impl", kVertexCode), false);
  addToFragments("//VTK::Normal::Dec", kFragmentDeclarations);

  // Without ambient and diffuse light what VTK works out is specular (thesis 6.5.1). The base
  // colour of physically based shading stays, for it is the reflectance of metals.
  addToFragments("//VTK::Color::Impl", parts.isPhysicallyBased
                                           ? "  ambientColor = vec3(0.0);\n"
                                           : "  ambientColor = diffuseColor = vec3(0.0);\n");
  if (parts.isPhysicallyBased) {
    shader->AddFragmentShaderReplacement("DiffuseLambert(albedo)", false, "vec3(0.0)", true);
    shader->AddFragmentShaderReplacement("irradiance * albedo", false, "vec3(0.0)", true);
  }
  addToFragments("//VTK::Light::Impl", "  vec3 specularLight = gl_FragData[0].rgb;\n");

  // Behind VTK's own textures: they would tint the specular light.
  addToFragments("//VTK::TCoord::Impl", FragmentCode(parts));
}

void SetExposure(const ToneMapping& toneMapping, bool linear, vtkShaderProperty* shader) {
  vtkUniforms* uniforms = shader->GetFragmentCustomUniforms();
  uniforms->SetUniformf("exposureScale", static_cast<float>(toneMapping.Scale()));
  uniforms->SetUniformf("fullWhite", static_cast<float>(toneMapping.White()));
  uniforms->SetUniformi("toneCurve", static_cast<int>(toneMapping.Curve()));
  uniforms->SetUniformi("linearLight", linear ? 1 : 0);
}
}  // namespace lambert
