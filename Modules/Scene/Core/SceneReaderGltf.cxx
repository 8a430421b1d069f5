#include "Scene/Core/SceneReaderGltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include "Scene/Core/SceneReaderFiles.h"

namespace lambert {

namespace {

using Json = nlohmann::json;

constexpr uint32_t kGlbMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr int kFloat = 5126, kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;
const char* const kIndexPrefix = "#";

/// Radiometric value of a photometric one, its colour kept.
Spectrum FromPhotometric(const Spectrum& s) { return s / float(kLumensPerWatt); }

uint32_t ReadUint32(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

void AppendUint32(uint32_t value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), 4);
}

/// The member, or an empty object.
const Json& Member(const Json& owner, const char* name) {
  static const Json none = Json::object();
  const auto found = owner.find(name);
  return found == owner.end() ? none : *found;
}

const Json& Extension(const Json& owner, const char* name) {
  return Member(Member(owner, "extensions"), name);
}

Spectrum ReadColour(const Json& owner, const char* name, const Spectrum& missing) {
  const Json& value = Member(owner, name);
  if (!value.is_array() || value.size() < 3) return missing;
  return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

/// Decodes "data:...;base64,...".
std::string DecodeDataUri(const std::string& uri) {
  std::string bytes;
  uint32_t bits = 0;
  int count = 0;
  for (size_t i = uri.find(',') + 1; i < uri.size() && uri[i] != '='; ++i) {
    static const std::string digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t digit = digits.find(uri[i]);
    if (digit == std::string::npos) continue;
    bits = bits << 6 | uint32_t(digit);
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += char(bits >> count & 0xff);
  }
  return bytes;
}

std::string DecodePercent(const std::string& uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size()) {
      text += char(std::strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// Bytes of one element of an accessor; 0 for a type that glTF does not know.
int64_t ElementSize(const Json& accessor) {
  static const std::map<std::string, int64_t> components{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  static const std::map<int, int64_t> bytes{{5120, 1}, {5121, 1}, {5122, 2},
                                            {5123, 2}, {5125, 4}, {kFloat, 4}};
  const auto count = components.find(accessor.value("type", ""));
  const auto width = bytes.find(accessor.value("componentType", 0));
  return count == components.end() || width == bytes.end() ? 0 : count->second * width->second;
}

TextureWrap ToWrap(int code) {
  if (code == 33071) return TextureWrap::Clamp;
  return code == 33648 ? TextureWrap::Mirror : TextureWrap::Repeat;
}

}  // namespace

Error GltfDocument::Broken(const std::string& what) const {
  return Error("The file \"" + path_ + "\" " + what + "; export it again.");
}

GltfDocument::GltfDocument(const std::string& path, const std::string& bytes)
    : path_(path), folder_(std::filesystem::path(path).parent_path().string()) {
  isBinary_ = bytes.size() >= 4 && ReadUint32(bytes, 0) == kGlbMagic;
  if (isBinary_) {
    ParseBinary(bytes);
  } else {
    json_ = Json::parse(bytes, nullptr, false);
  }
  if (!json_.is_object()) throw Broken("is cut off or no glTF: its JSON does not parse");
  const std::string version = Member(json_, "asset").value("version", "");
  if (version.substr(0, 2) != "2.") throw Broken("is glTF \"" + version + "\" where 2.0 is read");
  CheckExtensions();
  CheckAccessors();
  CheckNodes();
}

void GltfDocument::ParseBinary(const std::string& bytes) {
  if (bytes.size() >= 8 && ReadUint32(bytes, 4) != 2) throw Broken("is no glTF 2.0");
  if (bytes.size() < 20 || ReadUint32(bytes, 8) > bytes.size()) throw Broken("is cut off");
  for (size_t at = 12; at + 8 <= bytes.size();) {
    const size_t length = ReadUint32(bytes, at);
    const uint32_t type = ReadUint32(bytes, at + 4);
    if (length > bytes.size() - at - 8) throw Broken("is cut off");
    if (type == kJsonChunk) json_ = Json::parse(bytes.substr(at + 8, length), nullptr, false);
    if (type == kBinChunk) binary_ = bytes.substr(at + 8, length);
    at += 8 + length;
  }
}

void GltfDocument::CheckExtensions() const {
  for (const Json& required : Member(json_, "extensionsRequired")) {
    const auto name = required.get<std::string>();
    for (const char* packed :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"}) {
      if (name == packed) throw Broken("needs the extension " + name + ", which is not read");
    }
  }
}

void GltfDocument::CheckAccessors() const {
  // Points are floats, and every view lies within its buffer: the importer relies on both.
  for (const Json& mesh : Member(json_, "meshes")) {
    for (const Json& primitive : mesh.at("primitives")) {
      const Json& attributes = Member(primitive, "attributes");
      for (const char* attribute : {"POSITION", "NORMAL"}) {
        if (!attributes.contains(attribute)) continue;
        const Json& accessor = Row("accessors", attributes[attribute].get<int>());
        if (accessor.value("componentType", 0) != kFloat || accessor.value("type", "") != "VEC3") {
          throw Broken(std::string("stores ") + attribute + " in another form than three floats");
        }
      }
      if (primitive.contains("indices")) Row("accessors", primitive["indices"].get<int>());
    }
  }
  for (const Json& accessor : Member(json_, "accessors")) {
    if (!accessor.contains("bufferView")) continue;
    const Json& view = Row("bufferViews", accessor["bufferView"].get<int>());
    const int64_t size = ElementSize(accessor), count = accessor.at("count").get<int64_t>();
    const int64_t stride = view.value("byteStride", size),
                  begin = accessor.value("byteOffset", int64_t(0));
    const int64_t length = view.at("byteLength").get<int64_t>();
    const bool whole = size > 0 && count >= 0 && begin >= 0 && stride >= 0 && count <= length + 1;
    if (!whole || (count > 0 && begin + (count - 1) * stride + size > length)) {
      throw Broken("has an accessor that ends beyond its buffer view");
    }
  }
  for (const Json& view : Member(json_, "bufferViews")) {
    const Json& buffer = Row("buffers", view.at("buffer").get<int>());
    const int64_t begin = view.value("byteOffset", int64_t(0)),
                  length = view.at("byteLength").get<int64_t>();
    const int64_t available = buffer.at("byteLength").get<int64_t>();
    if (begin < 0 || length < 0 || begin > available || length > available - begin) {
      throw Broken("has a buffer view that ends beyond its buffer");
    }
  }
}

void GltfDocument::CheckNodes() const {
  // Each node has one parent at most and roots have none: a tree, so that a walk ends.
  std::vector<int> parents(Member(json_, "nodes").size(), 0);
  const auto count = [&](const Json& children) {
    for (const Json& child : children) {
      Row("nodes", child.get<int>());
      if (++parents[child.get<size_t>()] > 1) throw Broken("has nodes that are no tree");
    }
  };
  for (const Json& node : Member(json_, "nodes")) count(Member(node, "children"));
  if (Member(json_, "scenes").empty()) return;
  count(Member(Row("scenes", json_.value("scene", 0)), "nodes"));
}

std::string GltfDocument::IndexedBytes(const ReadContext& context) const {
  Json indexed = json_;
  for (const char* table : {"materials", "meshes", "nodes"}) {
    if (!indexed.contains(table)) continue;
    for (size_t i = 0; i < indexed[table].size(); ++i) {
      indexed[table][i]["name"] = kIndexPrefix + std::to_string(i);
    }
  }
  // Lights and cameras are read here; uvs that are not floats would be misread by the importer.
  indexed.erase("cameras");
  indexed.erase("extensions");
  for (Json& node : indexed["nodes"]) {
    node.erase("camera");
    node.erase("extensions");
  }
  for (Json& mesh : indexed["meshes"]) {
    for (Json& primitive : mesh["primitives"]) {
      for (const char* uvs : {"TEXCOORD_0", "TEXCOORD_1"}) {
        Json& attributes = primitive["attributes"];
        if (!attributes.contains(uvs)) continue;
        const Json& accessor = Row("accessors", attributes[uvs].get<int>());
        if (accessor.value("componentType", 0) == kFloat) continue;
        attributes.erase(uvs);
        context.Warn("Texture coordinates of \"" + path_ +
                     "\" are stored as integers, which are not read; textures count as the mean of "
                     "their image.");
      }
    }
  }
  std::string text = indexed.dump();
  if (!isBinary_) return text;

  // A .glb again: header, JSON chunk, BIN chunk, each in steps of four bytes.
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes;
  AppendUint32(kGlbMagic, &bytes);
  AppendUint32(2, &bytes);
  AppendUint32(uint32_t(12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size())), &bytes);
  AppendUint32(uint32_t(text.size()), &bytes);
  AppendUint32(kJsonChunk, &bytes);
  bytes += text;
  if (binary_.empty()) return bytes;
  AppendUint32(uint32_t(binary_.size()), &bytes);
  AppendUint32(kBinChunk, &bytes);
  return bytes + binary_;
}

int GltfDocument::IndexFromName(const std::string& name) {
  return name.rfind(kIndexPrefix, 0) == 0 ? std::atoi(name.c_str() + 1) : -1;
}

const Json& GltfDocument::Row(const char* table, int index) const {
  const Json& rows = Member(json_, table);
  if (index < 0 || size_t(index) >= rows.size()) {
    throw Broken(std::string("names row ") + std::to_string(index) + " of \"" + table +
                 "\", which is not there");
  }
  return rows[size_t(index)];
}

std::string GltfDocument::NodeName(int node) const {
  return Row("nodes", node).value("name", "node " + std::to_string(node));
}

int64_t GltfDocument::PrimitiveCount(int mesh) const {
  return int64_t(Row("meshes", mesh).at("primitives").size());
}

int64_t GltfDocument::AnnouncedTriangles(int mesh, int primitive) const {
  const Json& source = Row("meshes", mesh).at("primitives").at(size_t(primitive));
  const int mode = source.value("mode", kTriangles);
  const Json& attributes = Member(source, "attributes");
  if (mode < kTriangles || !attributes.contains("POSITION")) return -1;
  const int accessor = source.value("indices", attributes["POSITION"].get<int>());
  const int64_t count = Row("accessors", accessor).at("count").get<int64_t>();
  if (mode == kTriangleStrip || mode == kTriangleFan) return std::max<int64_t>(0, count - 2);
  return count / 3;
}

/// Bytes that a buffer or an image names by its uri, or those of the .glb itself.
std::string_view GltfDocument::Resource(const Json& owner, std::string* storage) const {
  const std::string uri = owner.value("uri", "");
  if (uri.empty()) return binary_;
  *storage = uri.rfind("data:", 0) == 0
                 ? DecodeDataUri(uri)
                 : LoadFile((std::filesystem::path(folder_) / DecodePercent(uri)).string());
  return *storage;
}

std::string_view GltfDocument::BufferView(int index, std::string* storage) const {
  const Json& view = Row("bufferViews", index);
  const std::string_view buffer = Resource(Row("buffers", view.at("buffer").get<int>()), storage);
  const auto begin = view.value("byteOffset", size_t(0)),
             length = view.at("byteLength").get<size_t>();
  if (begin > buffer.size() || length > buffer.size() - begin)
    throw Broken("has a buffer that is cut off");
  return buffer.substr(begin, length);
}

/// Values of an accessor of floats or normalized integers, `components` an element.
std::vector<double> GltfDocument::Accessor(int index, size_t components) const {
  const Json& accessor = Row("accessors", index);
  const Json& view = Row("bufferViews", accessor.at("bufferView").get<int>());
  std::string storage;
  const std::string_view bytes = BufferView(accessor.at("bufferView").get<int>(), &storage);
  const int type = accessor.at("componentType").get<int>();
  const size_t width = type == kFloat ? 4
                       : type == 5120 ? 1
                                      : 2;  // float, signed byte, signed short
  const size_t stride = view.value("byteStride", components * width);
  const size_t begin = accessor.value("byteOffset", size_t(0));
  const size_t count = accessor.at("count").get<size_t>();

  std::vector<double> values;
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < components; ++c) {
      const size_t at = begin + i * stride + c * width;
      if (at + width > bytes.size())
        throw Broken("has an accessor that ends beyond its buffer view");
      float real = 0;
      int16_t word = 0;
      if (width == 4) std::memcpy(&real, bytes.data() + at, 4);
      if (width == 2) std::memcpy(&word, bytes.data() + at, 2);
      if (width == 2) real = std::max(-1.f, float(word) / 32767);
      if (width == 1) real = std::max(-1.f, float(static_cast<signed char>(bytes[at])) / 127);
      values.push_back(double(real));
    }
  }
  return values;
}

TextureMap GltfDocument::Texture(const Json& info, const TextureDecoding& decoding,
                                 const ReadContext& context) const {
  TextureMap map;
  if (!info.contains("index")) return map;
  const Json& texture = Row("textures", info["index"].get<int>());
  if (!texture.contains("source")) {
    context.Warn("A texture of \"" + path_ +
                 "\" has its image in a form that is not read; its factor counts alone.");
    return map;
  }

  // The image: a file beside, or bytes in the document.
  const int row = texture["source"].get<int>();
  const Json& image = Row("images", row);
  const std::string uri = image.value("uri", "");
  if (!uri.empty() && uri.rfind("data:", 0) != 0) {
    map.image = context.textures.AddFile(
        (std::filesystem::path(folder_) / DecodePercent(uri)).string(), decoding);
  } else {
    std::string storage;
    const std::string_view bytes = uri.empty()
                                       ? BufferView(image.at("bufferView").get<int>(), &storage)
                                       : Resource(image, &storage);
    map.image = context.textures.AddMemory(path_ + " image " + std::to_string(row),
                                           reinterpret_cast<const unsigned char*>(bytes.data()),
                                           bytes.size(), decoding);
  }

  // How it lies on the surface. The importer turned v upwards; images and KHR_texture_transform run
  // down.
  const Json& transform = Extension(info, "KHR_texture_transform");
  map.uvSet = transform.value("texCoord", info.value("texCoord", 0));
  if (texture.contains("sampler")) {
    const Json& sampler = Row("samplers", texture["sampler"].get<int>());
    map.wrapU = ToWrap(sampler.value("wrapS", 10497));
    map.wrapV = ToWrap(sampler.value("wrapT", 10497));
  }
  const auto offset = transform.value("offset", std::vector<double>{0, 0});
  const auto scale = transform.value("scale", std::vector<double>{1, 1});
  const double angle = transform.value("rotation", 0.0), c = std::cos(angle), s = std::sin(angle);
  // u' = c sx u + s sy (1-v) + tx, v' = -s sx u + c sy (1-v) + ty
  map.fromUv = {c * scale.at(0),  -s * scale.at(1), s * scale.at(1) + offset.at(0),
                -s * scale.at(0), -c * scale.at(1), c * scale.at(1) + offset.at(1)};
  return map;
}

SurfaceMaterial GltfDocument::ReadMaterial(const Json& source, const ReadContext& context) const {
  SurfaceMaterial material;
  material.name = source.value("name", "");
  material.vertexColours = VertexColourUse::Multiplies;

  // Base colour: metallic-roughness, or the diffuse colour of the older specular-glossiness.
  const Json& metallic = Member(source, "pbrMetallicRoughness");
  const Json& specular = Extension(source, "KHR_materials_pbrSpecularGlossiness");
  const bool isSpecular = metallic.empty() && !specular.empty();
  const Json& base = isSpecular ? specular : metallic;
  const char* const factorName = isSpecular ? "diffuseFactor" : "baseColorFactor";
  const auto factor = base.value(factorName, std::vector<float>{1, 1, 1, 1});
  material.reflectance = ReadColour(base, factorName, Spectrum(1.f));
  material.metallic = isSpecular ? 0 : metallic.value("metallicFactor", 1.f);

  // Transparency: BLEND by the mean alpha, MASK by the share of the face that is cut.
  const std::string alphaMode = source.value("alphaMode", "OPAQUE");
  TextureDecoding colour;
  material.hasAlpha = alphaMode != "OPAQUE";
  material.masked = alphaMode == "MASK";
  const float alpha = factor.size() > 3 ? factor[3] : 1.f;
  if (material.hasAlpha) material.opacity = alpha;
  if (material.masked) {
    const float cutoff = source.value("alphaCutoff", 0.5f);
    colour.alphaCutoff = alpha > 0 ? cutoff / alpha : 2.f;
    material.opacity =
        base.contains(isSpecular ? "diffuseTexture" : "baseColorTexture") || alpha >= cutoff;
  }
  material.transmits =
      Extension(source, "KHR_materials_transmission").value("transmissionFactor", 0.f) > 0.5f;
  material.base =
      Texture(Member(base, isSpecular ? "diffuseTexture" : "baseColorTexture"), colour, context);
  if (context.options.blackMetals && !isSpecular) {
    TextureDecoding linear;
    linear.srgb = false;
    material.metallicMap = Texture(Member(metallic, "metallicRoughnessTexture"), linear, context);
  }

  // Emission: factor x strength in nit is a luminance; M = pi L.
  const float strength =
      Extension(source, "KHR_materials_emissive_strength").value("emissiveStrength", 1.f);
  material.emittance =
      FromPhotometric(ReadColour(source, "emissiveFactor", Spectrum(0.f)) * strength) * float(kPi);
  material.emissive = Texture(Member(source, "emissiveTexture"), {}, context);
  material.twoSidedEmitter = source.value("doubleSided", false) || context.options.twoSidedEmitters;
  return material;
}

std::vector<SurfaceMaterial> GltfDocument::Materials(const ReadContext& context) const {
  std::vector<SurfaceMaterial> materials;
  for (const Json& source : Member(json_, "materials")) {
    materials.push_back(ReadMaterial(source, context));
  }
  SurfaceMaterial none;
  none.name = "default";
  none.reflectance = context.options.defaultReflectance;
  none.vertexColours = VertexColourUse::Multiplies;
  materials.push_back(none);
  return materials;
}

std::vector<Matrix4> GltfDocument::Instances(int node) const {
  const Json& attributes =
      Member(Extension(Row("nodes", node), "EXT_mesh_gpu_instancing"), "attributes");
  if (attributes.empty()) return {kIdentity};
  const auto read = [&](const char* name, size_t components) {
    return attributes.contains(name) ? Accessor(attributes[name].get<int>(), components)
                                     : std::vector<double>();
  };
  const std::vector<double> t = read("TRANSLATION", 3), q = read("ROTATION", 4),
                            s = read("SCALE", 3);
  const size_t count = std::max({t.size() / 3, q.size() / 4, s.size() / 3});

  std::vector<Matrix4> instances;
  for (size_t i = 0; i < count; ++i) {
    const auto vector = [&](const std::vector<double>& values, const Vec3d& missing) {
      return 3 * i + 2 < values.size() ? Vec3d(values[3 * i], values[3 * i + 1], values[3 * i + 2])
                                       : missing;
    };
    std::array<double, 4> rotation{0, 0, 0, 1};
    if (4 * i + 3 < q.size()) std::copy_n(q.begin() + std::ptrdiff_t(4 * i), 4, rotation.begin());
    instances.push_back(TranslationRotationScale(vector(t, {}), rotation, vector(s, {1, 1, 1})));
  }
  return instances;
}

std::optional<Light> GltfDocument::NodeLight(int node, const Matrix4& toWorld) const {
  const Json& reference = Extension(Row("nodes", node), "KHR_lights_punctual");
  if (reference.empty()) return {};
  const Json& lights = Member(Extension(json_, "KHR_lights_punctual"), "lights");
  const Json& source = lights.at(reference.at("light").get<size_t>());

  // Candela for points and spots, lux for directional light.
  Light light;
  const std::string type = source.at("type").get<std::string>();
  if (type != "point" && type != "spot" && type != "directional") {
    throw Broken("has a light of the unknown type \"" + type + "\"");
  }
  light.type = type == "spot"          ? LightType::Spot
               : type == "directional" ? LightType::Directional
                                       : LightType::Point;
  light.name = source.value("name", NodeName(node));
  light.intensity =
      FromPhotometric(ReadColour(source, "color", Spectrum(1.f)) * source.value("intensity", 1.f));
  light.position = Vec3f(TransformPoint(toWorld, {}));
  light.direction = Vec3f(Normalize(TransformDirection(toWorld, {0, 0, -1})));
  const Json& spot = Member(source, "spot");
  light.innerConeAngle = spot.value("innerConeAngle", 0.f);
  light.outerConeAngle = spot.value("outerConeAngle", float(kPi) / 4);
  return light;
}

std::optional<Camera> GltfDocument::NodeCamera(int node, const Matrix4& toWorld) const {
  const Json& source = Row("nodes", node);
  if (!source.contains("camera")) return {};
  const Json& perspective = Member(Row("cameras", source["camera"].get<int>()), "perspective");
  if (!perspective.contains("yfov")) return {};
  Camera camera;
  camera.position = TransformPoint(toWorld, {});
  camera.focalPoint = camera.position + Normalize(TransformDirection(toWorld, {0, 0, -1}));
  camera.viewUp = Normalize(TransformDirection(toWorld, {0, 1, 0}));
  camera.verticalFieldOfView = perspective["yfov"].get<double>() * 180 / kPi;
  return camera;
}

}  // namespace lambert
