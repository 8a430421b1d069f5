#include "GltfFile.h"

#include "Base64.h"
#include "Common/Core/Error.h"
#include "PngImage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace lambert {
namespace {
using Json = nlohmann::ordered_json;

// Codes of the format.
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertices = 34962, kIndices = 34963;
constexpr int kLinear = 9729, kLinearMipMaps = 9987;
constexpr int kRepeat = 10497, kMirroredRepeat = 33648, kClampToEdge = 33071;
/// The nearest that is seen, parts of what lies between eye and focal point.
constexpr double kNear = 1e-3;

/// A document and its buffer.
class GltfDocument {
 public:
  explicit GltfDocument(const LitModel& model);
  std::string Glb() const;
  std::string Text() const;

 private:
  int AddView(const void* bytes, size_t size, int target = 0);
  int AddAccessor(int view, int component, const char* type, size_t count);
  void AddImage(const LitImage& image);
  int AddMaterial(const LitMesh& mesh);
  void AddMesh(const LitMesh& mesh);
  void AddCamera(const Camera& camera);
  void AddNode(Json node);

  Json Root;
  std::string Buffer;
};

GltfDocument::GltfDocument(const LitModel& model) {
  this->Root = {{"asset", {{"version", "2.0"}, {"generator", "Lambert"}}},
                {"extensionsUsed", Json::array({"KHR_materials_unlit"})},
                {"scene", 0},
                {"scenes", Json::array({{{"name", model.name}, {"nodes", Json::array()}}})}};
  for (const LitImage& image : model.images) {
    this->AddImage(image);
  }
  for (const LitMesh& mesh : model.meshes) {
    this->AddMesh(mesh);
  }
  if (model.meshes.empty()) {
    this->Root.erase("extensionsUsed");
  }
  this->AddCamera(model.camera);
  if (!this->Buffer.empty()) {
    this->Root["buffers"] = Json::array({{{"byteLength", this->Buffer.size()}}});
  }
}

/// Views begin at multiples of four bytes.
int GltfDocument::AddView(const void* bytes, size_t size, int target) {
  this->Buffer.resize((this->Buffer.size() + 3) / 4 * 4, '\0');
  Json view = {{"buffer", 0}, {"byteOffset", this->Buffer.size()}, {"byteLength", size}};
  if (target != 0) {
    view["target"] = target;
  }
  this->Buffer.append(static_cast<const char*>(bytes), size);
  this->Root["bufferViews"].push_back(std::move(view));
  return static_cast<int>(this->Root["bufferViews"].size()) - 1;
}

int GltfDocument::AddAccessor(int view, int component, const char* type, size_t count) {
  this->Root["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return static_cast<int>(this->Root["accessors"].size()) - 1;
}

int WrapCode(TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) {
    return kClampToEdge;
  }
  return wrap == TextureWrap::Mirror ? kMirroredRepeat : kRepeat;
}

/// An image, and how it is looked up.
void GltfDocument::AddImage(const LitImage& image) {
  const std::string bytes = image.file.empty() ? PngOf(image) : image.file;
  const int view = this->AddView(bytes.data(), bytes.size());
  this->Root["images"].push_back({{"name", image.name},
                                  {"mimeType", IsJpeg(bytes) ? "image/jpeg" : "image/png"},
                                  {"bufferView", view}});
  this->Root["samplers"].push_back({{"magFilter", kLinear},
                                    {"minFilter", kLinearMipMaps},
                                    {"wrapS", WrapCode(image.wrapU)},
                                    {"wrapT", WrapCode(image.wrapV)}});
  this->Root["textures"].push_back({{"sampler", this->Root["samplers"].size() - 1},
                                    {"source", this->Root["images"].size() - 1}});
}

/// Without shading; a viewer that does not know unlit materials sees rough ones that are no metal.
int GltfDocument::AddMaterial(const LitMesh& mesh) {
  Json surface = {{"metallicFactor", 0}, {"roughnessFactor", 0.9}};
  if (mesh.image >= 0) {
    surface["baseColorTexture"] = {{"index", mesh.image}};
  }
  Json material = {{"name", mesh.name},
                   {"pbrMetallicRoughness", surface},
                   {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
  if (mesh.alphaCutoff >= 0) {
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = mesh.alphaCutoff;
  }
  this->Root["materials"].push_back(std::move(material));
  return static_cast<int>(this->Root["materials"].size()) - 1;
}

void GltfDocument::AddMesh(const LitMesh& mesh) {
  // Where its points lie.
  const size_t points = mesh.positions.size();
  const int positions =
      this->AddAccessor(this->AddView(mesh.positions.data(), points * sizeof(Vec3f), kVertices),
                        kFloat, "VEC3", points);
  Box3f bounds;
  for (const Vec3f& position : mesh.positions) {
    bounds.Include(position);
  }
  Json& accessor = this->Root["accessors"].back();
  accessor["min"] = {bounds.low.x, bounds.low.y, bounds.low.z};
  accessor["max"] = {bounds.high.x, bounds.high.y, bounds.high.z};
  Json attributes = {{"POSITION", positions}};

  // Where they lie in the image: its coordinates run down.
  if (mesh.image >= 0) {
    std::vector<Vec2f> coords;
    for (const Vec2f& uv : mesh.textureCoords) {
      coords.emplace_back(uv.x, 1 - uv.y);
    }
    const int view = this->AddView(coords.data(), points * sizeof(Vec2f), kVertices);
    attributes["TEXCOORD_0"] = this->AddAccessor(view, kFloat, "VEC2", points);
  }

  // Their colours, of four bands so that each begins at a multiple of four bytes.
  if (!mesh.colors.empty()) {
    constexpr uint16_t kOne = std::numeric_limits<uint16_t>::max();
    std::vector<uint16_t> codes;
    for (const Spectrum& color : mesh.colors) {
      for (int band = 0; band < 3; ++band) {
        codes.push_back(
            static_cast<uint16_t>(std::lround(std::clamp(color[band], 0.f, 1.f) * kOne)));
      }
      codes.push_back(kOne);
    }
    const int view = this->AddView(codes.data(), codes.size() * sizeof(uint16_t), kVertices);
    attributes["COLOR_0"] = this->AddAccessor(view, kUnsignedShort, "VEC4", points);
    this->Root["accessors"].back()["normalized"] = true;
  }

  // Triangles.
  const size_t indices = 3 * mesh.triangles.size();
  const int view = this->AddView(mesh.triangles.data(), indices * sizeof(int32_t), kIndices);
  const int triangles = this->AddAccessor(view, kUnsignedInt, "SCALAR", indices);
  const Json primitive = {
      {"attributes", attributes}, {"indices", triangles}, {"material", this->AddMaterial(mesh)}};
  this->Root["meshes"].push_back({{"name", mesh.name}, {"primitives", Json::array({primitive})}});
  this->AddNode({{"name", mesh.name}, {"mesh", this->Root["meshes"].size() - 1}});
}

void GltfDocument::AddCamera(const Camera& camera) {
  const Vec3d back = Normalize(camera.position - camera.focalPoint);
  const Vec3d right = Normalize(Cross(camera.viewUp, back));
  const Vec3d up = Cross(back, right), &p = camera.position;
  const Json lens = {{"yfov", camera.verticalFieldOfView * kPi / 180},
                     {"znear", kNear * Length(camera.position - camera.focalPoint)}};
  this->Root["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", lens}}});
  this->AddNode({{"name", "camera"},
                 {"camera", 0},
                 {"matrix",
                  {right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, back.x, back.y, back.z, 0,
                   p.x, p.y, p.z, 1}}});
}

void GltfDocument::AddNode(Json node) {
  this->Root["nodes"].push_back(std::move(node));
  this->Root["scenes"][0]["nodes"].push_back(this->Root["nodes"].size() - 1);
}

/// Names may not be UTF-8: what is not is replaced.
std::string ToText(const Json& root) {
  return root.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string GltfDocument::Glb() const {
  // Chunks end at multiples of four bytes.
  std::string text = ToText(this->Root), buffer = this->Buffer;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  const size_t length = 12 + 8 + text.size() + 8 + buffer.size();
  if (length > std::numeric_limits<uint32_t>::max()) {
    throw Error(
        "The lit model takes more than the 4 GB that a GLB file can hold; "
        "a light map or a larger --error makes it smaller.");
  }

  std::string glb;
  const auto put = [&](uint32_t value) {
    glb.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  glb += "glTF";
  put(2);
  put(static_cast<uint32_t>(length));
  put(static_cast<uint32_t>(text.size()));
  glb += "JSON" + text;
  put(static_cast<uint32_t>(buffer.size()));
  return glb + std::string("BIN\0", 4) + buffer;
}

std::string GltfDocument::Text() const {
  Json root = this->Root;
  if (!this->Buffer.empty()) {
    root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + Base64(this->Buffer);
  }
  return ToText(root);
}
}  // namespace

std::string GlbOf(const LitModel& model) { return GltfDocument(model).Glb(); }

std::string GltfOf(const LitModel& model) { return GltfDocument(model).Text(); }
}  // namespace lambert
