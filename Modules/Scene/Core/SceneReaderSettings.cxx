// Changes to materials that are asked for by name.
#include <charconv>
#include <string_view>

#include "Common/Core/Error.h"
#include "Scene/Core/SceneReaderMaterials.h"

namespace lambert {

namespace {

Error Unclear(std::string_view change) {
  return Error(
      "The material setting \"" + std::string(change) +
      "\" is not clear; write NAME:reflectance=R,G,B or NAME:emission=R,G,B or NAME:two-sided.");
}

/// One number for all bands, or three; finite and not negative.
Spectrum ParseSpectrum(std::string_view text, std::string_view change) {
  std::vector<float> values;
  while (true) {
    const size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    float value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
        value < 0) {
      throw Unclear(change);
    }
    values.push_back(value);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (values.size() == 1) return Spectrum(values[0]);
  if (values.size() != 3) throw Unclear(change);
  return {values[0], values[1], values[2]};
}

/// Calls change(mesh, face) for every face of the material.
template <class Change>
void ForEachFace(SceneAssembly* assembly, size_t material, const Change& change) {
  for (TriangleMesh& mesh : assembly->meshes) {
    for (size_t face = 0; face < mesh.triangles.size(); ++face) {
      if (size_t(mesh.materialId[face]) == material) change(mesh, face);
    }
  }
}

void SetReflectance(const Spectrum& asked, size_t row, SceneAssembly* assembly) {
  bool over = false;
  const Spectrum value = ClampReflectance(asked, &over);
  assembly->report.materialsClamped += over;
  assembly->materials[row].reflectance = value;
  assembly->materials[row].baseTexture = nullptr;
  ForEachFace(assembly, row,
              [&](TriangleMesh& mesh, size_t face) { mesh.reflectance[face] = value; });
}

/// Flags the faces that emit, on one side or both.
void FlagEmitters(size_t row, SceneAssembly* assembly) {
  const uint8_t sides =
      assembly->materials[row].twoSidedEmitter ? kEmitsFront | kEmitsBack : kEmitsFront;
  ForEachFace(assembly, row, [&](TriangleMesh& mesh, size_t face) {
    const uint8_t others = mesh.faceFlags[face] & uint8_t(~(kEmitsFront | kEmitsBack));
    mesh.faceFlags[face] = uint8_t(others | (mesh.emittance[face].IsBlack() ? 0 : sides));
  });
}

/// A diffuse emitter of radiance L has the exitance M = pi L.
void SetEmission(const Spectrum& radiance, size_t row, SceneAssembly* assembly) {
  const Spectrum exitance = radiance * float(kPi);
  assembly->materials[row].emittance = exitance;
  ForEachFace(assembly, row,
              [&](TriangleMesh& mesh, size_t face) { mesh.emittance[face] = exitance; });
  FlagEmitters(row, assembly);
}

/// Applies "reflectance=...", "emission=..." or "two-sided".
void ApplyProperty(std::string_view property, size_t row, std::string_view change,
                   SceneAssembly* assembly) {
  const size_t equals = property.find('=');
  const std::string_view name = property.substr(0, equals);
  const std::string_view value =
      equals == std::string_view::npos ? std::string_view() : property.substr(equals + 1);
  if (name == "reflectance") {
    SetReflectance(ParseSpectrum(value, change), row, assembly);
  } else if (name == "emission") {
    SetEmission(ParseSpectrum(value, change), row, assembly);
  } else if (property == "two-sided") {
    assembly->materials[row].twoSidedEmitter = true;
    FlagEmitters(row, assembly);
  } else {
    throw Unclear(change);
  }
}

}  // namespace

void ApplyMaterialSetting(const std::string& setting, SceneAssembly* assembly) {
  std::string_view rest(setting), material;
  bool more = true;
  while (more) {
    // The next change; without a name it goes on with the material before it.
    const size_t bar = rest.find('|');
    const std::string_view change = rest.substr(0, bar);
    more = bar != std::string_view::npos;
    if (more) rest.remove_prefix(bar + 1);
    const size_t colon = change.rfind(':');
    if (colon != std::string_view::npos) material = change.substr(0, colon);
    if (material.empty()) throw Unclear(change);
    const std::string_view property =
        colon == std::string_view::npos ? change : change.substr(colon + 1);

    bool found = false;
    for (size_t row = 0; row < assembly->materials.size(); ++row) {
      if (assembly->materials[row].name != material) continue;
      ApplyProperty(property, row, change, assembly);
      found = true;
    }
    if (!found) {
      throw Error("No material is named \"" + std::string(material) +
                  "\"; lambert info lists the materials.");
    }
  }
}

}  // namespace lambert
