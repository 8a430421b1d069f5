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

// Trilinear as far as charts are kept apart; places outside of the map are black (thesis 6.5.1).
const char* const kLightMapLookup = R"(
vec3 LightOfMap()
{
  vec2 size = vec2(textureSize(lightMap, 0));
  vec2 across = dFdx(lightMapCoordsVSOutput) * size, along = dFdy(lightMapCoordsVSOutput) * size;
  float level = 0.5 * log2(max(1e-12, max(dot(across, across), dot(along, along))));
  level = clamp(level, 0.0, float(lightMapLevels));
  return step(0.0, lightMapCoordsVSOutput.x) * textureLod(lightMap, lightMapCoordsVSOutput, level).rgb;
}
)";

// What a glossy surface mirrors, blurred by its highlight: a lobe of cos^power is about
// sqrt(2 / (power + 2)) wide. Longitude and latitude as in VTK's physically based shading.
const char* const kEnvironmentLookup = R"(
vec3 Mirrored(vec3 normal, vec3 place)
{
  vec3 view = environmentParallel == 1 ? vec3(0.0, 0.0, -1.0) : normalize(place);
  vec3 direction = environmentFromView * reflect(view, normal);
  vec2 at = vec2(atan(direction.z, direction.x) / 6.2831853 + 0.5,
                 asin(clamp(direction.y, -1.0, 1.0)) / 3.1415927 + 0.5);
  float texel = 6.2831853 / float(textureSize(environmentMap, 0).x);
  float level = max(0.0, log2(sqrt(2.0 / (environmentPower + 2.0)) / texel));
  return textureLod(environmentMap, at, level).rgb;
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
  const std::string map = parts.lightMap ? "LightOfMap()" : "vec3(0.0)";
  return "  vec3 radiosity = vertexRadiosityVSOutput + " + base +
         " * (vertexIrradianceVSOutput + " + map +
         ");\n"
         "  gl_FragData[0] = vec4(linearLight == 1 ? radiosity : Displayed(radiosity) + "
         "specularLight, opacity);\n";
}

/// Behind the light of lamps: what the surface mirrors, as its specular colour tells.
std::string SpecularCode(const RadiosityShaderParts& parts) {
  std::string code = "  vec3 specularLight = gl_FragData[0].rgb;\n";
  if (parts.environment) {
    const std::string mirrored = "Mirrored(normalVCVSOutput, vertexVC.xyz)";
    code += "  specularLight += specularColor * " +
            (parts.isEnvironmentEncoded ? mirrored
                                        : "SrgbFromLinear(clamp(" + mirrored + ", 0.0, 1.0))") +
            ";\n";
  }
  return code;
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
  addToFragments("//VTK::TMap::Dec", std::string(parts.lightMap ? kLightMapLookup : "") +
                                         (parts.environment ? kEnvironmentLookup : ""));

  // Without ambient and diffuse light what VTK works out is specular (thesis 6.5.1). The base
  // colour of physically based shading stays, for it is the reflectance of metals.
  addToFragments("//VTK::Color::Impl", parts.isPhysicallyBased
                                           ? "  ambientColor = vec3(0.0);\n"
                                           : "  ambientColor = diffuseColor = vec3(0.0);\n");
  if (parts.isPhysicallyBased) {
    shader->AddFragmentShaderReplacement("DiffuseLambert(albedo)", false, "vec3(0.0)", true);
    shader->AddFragmentShaderReplacement("irradiance * albedo", false, "vec3(0.0)", true);
  }
  addToFragments("//VTK::Light::Impl", SpecularCode(parts));

  // Behind VTK's own textures: they would tint the specular light.
  addToFragments("//VTK::TCoord::Impl", FragmentCode(parts));
}

void SetLightMapLevels(int last, vtkShaderProperty* shader) {
  shader->GetFragmentCustomUniforms()->SetUniformi("lightMapLevels", last);
}

void SetEnvironmentView(const EnvironmentView& view, vtkShaderProperty* shader) {
  vtkUniforms* uniforms = shader->GetFragmentCustomUniforms();
  std::array<float, 9> byColumn{};
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      byColumn[3 * column + row] = view.fromView[3 * row + column];
    }
  }
  uniforms->SetUniformMatrix3x3("environmentFromView", byColumn.data());
  uniforms->SetUniformi("environmentParallel", view.isParallel ? 1 : 0);
  uniforms->SetUniformf("environmentPower", view.specularPower);
}

void SetExposure(const ToneMapping& toneMapping, bool linear, vtkShaderProperty* shader) {
  vtkUniforms* uniforms = shader->GetFragmentCustomUniforms();
  uniforms->SetUniformf("exposureScale", static_cast<float>(toneMapping.Scale()));
  uniforms->SetUniformf("fullWhite", static_cast<float>(toneMapping.White()));
  uniforms->SetUniformi("toneCurve", static_cast<int>(toneMapping.Curve()));
  uniforms->SetUniformi("linearLight", linear ? 1 : 0);
}
}  // namespace lambert
