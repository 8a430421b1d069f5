#include "RadiosityShader.h"

#include "vtkShaderProperty.h"
#include "vtkUniforms.h"

#include <tuple>

namespace lambert {
namespace {
// Core/ToneCurve and Core/ToneMapping, once more.
const char* const kTransferCurves = R"(
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
)";

const char* ToneCurveCode(ToneCurve curve) {
  switch (curve) {
    case ToneCurve::Photographic:
      return R"(
vec3 ToneCurve(vec3 keyed)
{
  float luminance = dot(keyed, vec3(0.2126, 0.7152, 0.0722));
  return keyed * (1.0 + luminance / (fullWhite * fullWhite)) / (1.0 + luminance);
}
)";
    case ToneCurve::Linear:
      return R"(
vec3 ToneCurve(vec3 keyed) { return keyed; }
)";
    case ToneCurve::Filmic:
      return R"(
vec3 FilmicResponse(vec3 x)
{
  return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
}
vec3 ToneCurve(vec3 keyed)
{
  return FilmicResponse(2.0 * keyed) / FilmicResponse(vec3(2.0 * fullWhite));
}
)";
  }
  return "";
}

const char* const kDisplayed = R"(
vec3 Displayed(vec3 radiosity)
{
  vec3 keyed = exposureScale * max(radiosity, vec3(0.0));
  return SrgbFromLinear(clamp(ToneCurve(keyed), 0.0, 1.0));
}
)";

// Places outside of the map are black (thesis 6.5.1).
const char* const kLightMapLookup = R"(
vec3 LightOfMap()
{
  return step(0.0, lightMapCoordsVSOutput.x) * texture(lightMap, lightMapCoordsVSOutput).rgb;
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

/// Radiosity at the fragment, displayed, and the specular light that VTK has worked out. Under a
/// base texture the light of points passes it, as that of the map does.
std::string FragmentCode(const RadiosityShaderParts& parts) {
  const std::string map = parts.lightMap ? "LightOfMap()" : "vec3(0.0)";
  std::string reflected = parts.lightMap ? "reflectanceVSOutput * " + map : map;
  if (!parts.baseTexture.empty()) {
    const std::string texel = "texture(" + parts.baseTexture + ", tcoordVCVSOutput).rgb";
    const std::string base = parts.isBaseEncoded ? "LinearFromSrgb(" + texel + ")" : texel;
    reflected = base + " * (vertexIrradianceVSOutput + " + map + ")";
  }
  const std::string shown = parts.isLinear ? "radiosity" : "Displayed(radiosity) + specularLight";
  return "  vec3 radiosity = vertexRadiosityVSOutput + " + reflected +
         ";\n"
         "  gl_FragData[0] = vec4(" +
         shown + ", opacity);\n";
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

bool operator==(const RadiosityShaderParts& a, const RadiosityShaderParts& b) {
  return std::tie(a.curve, a.isLinear, a.isSpecular, a.lightMap, a.baseTexture, a.isBaseEncoded,
                  a.isPhysicallyBased, a.environment, a.isEnvironmentEncoded) ==
         std::tie(b.curve, b.isLinear, b.isSpecular, b.lightMap, b.baseTexture, b.isBaseEncoded,
                  b.isPhysicallyBased, b.environment, b.isEnvironmentEncoded);
}

std::vector<RadiosityAttribute> AttributesOf(const RadiosityShaderParts& parts) {
  std::vector<RadiosityAttribute> read = {{"vertexRadiosity", "vec3", "Shown.VertexRadiosity"}};
  if (!parts.baseTexture.empty()) {
    read.push_back({"vertexIrradiance", "vec3", "Shown.VertexIrradiance"});
  } else if (parts.lightMap) {
    read.push_back({"reflectance", "vec3", "Shown.Reflectance"});
  }
  if (parts.lightMap) read.push_back({"lightMapCoords", "vec2", "Shown.LightMapTCoords"});
  return read;
}

void ReplaceDiffuseLight(const RadiosityShaderParts& parts, vtkShaderProperty* shader) {
  shader->ClearAllShaderReplacements();
  const auto addToFragments = [&](const char* tag, const std::string& code) {
    shader->AddFragmentShaderReplacement(tag, true, Behind(tag, code), false);
  };

  // What the points bring.
  std::string into, through, out;
  for (const auto& [name, type, array] : AttributesOf(parts)) {
    const std::string declared = std::string(type) + " " + name;
    into += "in " + declared + "MC;\nout " + declared + "VSOutput;\n";
    through += std::string("  ") + name + "VSOutput = " + name + "MC;\n";
    out += "in " + declared + "VSOutput;\n";
  }
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, Behind("//VTK::Normal::Dec", into),
                                     false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true,
                                     Behind("//VTK::Normal::Impl", through), false);
  addToFragments("//VTK::Normal::Dec",
                 out + kTransferCurves + ToneCurveCode(parts.curve) + kDisplayed);
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
  if (parts.isSpecular) {
    addToFragments("//VTK::Light::Impl", SpecularCode(parts));
  } else {
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                         "  const vec3 specularLight = vec3(0.0);\n", false);
  }

  // Behind VTK's own textures: they would tint the specular light.
  addToFragments("//VTK::TCoord::Impl", FragmentCode(parts));
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

void SetExposure(const ToneMapping& toneMapping, vtkShaderProperty* shader) {
  vtkUniforms* uniforms = shader->GetFragmentCustomUniforms();
  uniforms->SetUniformf("exposureScale", static_cast<float>(toneMapping.Scale()));
  uniforms->SetUniformf("fullWhite", static_cast<float>(toneMapping.White()));
}
}  // namespace lambert
