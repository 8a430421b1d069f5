#include "Scene/Core/SceneReader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/camera.h>
#include <assimp/light.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "Common/Core/Error.h"
#include "Common/Core/MemoryCeiling.h"
#include "Scene/Core/SceneReaderFiles.h"
#include "Scene/Core/SceneReaderGltf.h"
#include "Scene/Core/SceneReaderMeshes.h"

namespace lambert {

namespace {

/// Gives the importer the prepared bytes for the scene's own file and the libraries of an OBJ, and
/// the disk for all others.
class PreparedFile : public Assimp::DefaultIOSystem {
 public:
  /// Adds the other files that are opened to `companions`.
  PreparedFile(std::string path, const std::string& bytes, std::vector<std::string>* companions)
      : path_(std::move(path)), bytes_(bytes), companions_(companions) {}

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (path != path_ && Exists(path)) companions_->push_back(path);
    if (path != path_ && FileExtension(path_) == "obj" && Exists(path)) {
      const std::string text = MtlText(path);
      auto* const bytes = new uint8_t[text.size()];
      std::copy(text.begin(), text.end(), bytes);
      return new Assimp::MemoryIOStream(bytes, text.size(), true);
    }
    if (path != path_) return DefaultIOSystem::Open(path, mode);
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(bytes_.data()),
                                      bytes_.size());
  }

 private:
  std::string path_;
  const std::string& bytes_;
  std::vector<std::string>* companions_;
};

Matrix4 ToMatrix(const aiMatrix4x4& m) {
  return {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,
          m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4};
}

Vec3d ToVec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// One file on its way into the assembly.
class FileReader {
 public:
  FileReader(const std::string& path, const ReadContext& context, ProgressCallback progress)
      : path_(path), context_(context), progress_(std::move(progress)) {}

  void Read() {
    Advance(0);
    Prepare();
    Advance(0.1);
    Import();
    Advance(0.6);
    DeclareUnit();
    DescribeMaterials();
    const size_t firstPart = context_.assembly.parts.size();
    WalkNodes();
    if (!gltf_) ReadLightsAndCamera();
    CountMaterials();
    if (context_.assembly.parts.size() == firstPart) ThrowNoTriangle();
  }

 private:
  void Advance(double fraction) const {
    if (!Report(progress_, fraction, "Reading scene")) throw Cancelled();
  }
  void Prepare();
  void Import();
  void DeclareUnit();
  void DescribeMaterials();
  void WalkNodes();
  void AddParts(const aiNode& node, const Matrix4& toWorld);
  int32_t MeshRow(unsigned index);
  void WarnOfUnknown(const std::string& material) const;
  size_t MaterialOf(const aiMesh& mesh) const;
  void CheckAnnounced(const aiMesh& mesh) const;
  void ReadLightsAndCamera();
  void ReadLight(const aiLight& source);
  void ReadCamera(const aiCamera& source);
  void CountMaterials();
  [[noreturn]] void ThrowNoTriangle() const;

  std::string path_, extension_, bytes_;
  const ReadContext& context_;
  ProgressCallback progress_;
  std::optional<GltfDocument> gltf_;
  ObjScan obj_;
  Assimp::Importer importer_;
  std::unique_ptr<aiScene> scene_;
  double metresPerUnit_ = 1;

  std::vector<SurfaceMaterial> materials_;
  std::vector<int32_t>
      materialRows_;  ///< per material of the file: row of the table, -1 while unused
  std::vector<MaterialUse> materialUse_;  ///< per material of the file
  std::map<unsigned, int32_t>
      meshRows_;  ///< row of the assembly's meshes, -1 for one without a triangle
  std::map<std::string, Matrix4>
      nodes_;  ///< node to world, by name: where lights and cameras stand
};

/// Finds what is wrong with the file before the importer sees it, and sets right what it would
/// misread.
void FileReader::Prepare() {
  bytes_ = LoadFile(path_);
  extension_ = FileExtension(path_);
  if (extension_ == "ply") CheckPly(path_, bytes_);
  if (extension_ == "stl") CheckStl(path_, bytes_);
  if (extension_ == "off") CheckOff(path_, bytes_);
  if (extension_ == "gltf" || extension_ == "glb") {
    gltf_.emplace(path_, bytes_);
    bytes_ = gltf_->IndexedBytes(context_);
  }
  if (extension_ == "obj") {
    obj_ = ScanObj(path_, std::move(bytes_));
    bytes_ = std::move(obj_.text);
    for (const std::string& library : obj_.missingMtl) {
      context_.Warn("The material library \"" + library + "\" of \"" + path_ +
                    "\" is missing; its materials reflect the default.");
    }
  }
}

void FileReader::Import() {
  // No step of the importer joins, drops or reorders; polygons stay polygons.
  importer_.SetIOHandler(new PreparedFile(path_, bytes_, &context_.assembly.report.companions));
  importer_.ReadFile(path_, 0);
  const std::string cause = importer_.GetErrorString();
  scene_.reset(importer_.GetOrphanedScene());
  if (!scene_ || !scene_->mRootNode) {
    throw Error("The file \"" + path_ + "\" cannot be read" +
                (cause.empty() ? "" : " (" + cause + ")") +
                "; check that it is whole and of a known format.");
  }
  std::string().swap(bytes_);
}

void FileReader::DeclareUnit() {
  // FBX counts in centimetres times a factor of its own.
  double factor = 1;
  float single = 1;
  if (extension_ == "fbx" && scene_->mMetaData) {
    if (!scene_->mMetaData->Get("UnitScaleFactor", factor) &&
        scene_->mMetaData->Get("UnitScaleFactor", single)) {
      factor = single;
    }
    metresPerUnit_ = 0.01 * factor;
  }
  if (context_.options.metresPerUnit > 0) metresPerUnit_ = context_.options.metresPerUnit;

  static const std::vector<std::pair<double, const char*>> names{
      {1, "m"}, {0.01, "cm"}, {0.001, "mm"}, {0.0254, "in"}, {0.3048, "ft"}};
  std::string unit = std::to_string(metresPerUnit_) + " m";
  for (const auto& [metres, name] : names) {
    if (std::abs(metres - metresPerUnit_) < 1e-9)
      unit = name;  // Names are decimal, doubles are not.
  }
  ReadReport& report = context_.assembly.report;
  if (!report.files.empty() && report.unit != unit) {
    context_.Warn("The files are in different units; \"" + path_ + "\" is in " + unit + ".");
  } else {
    report.unit = unit;
    report.metresPerUnit = metresPerUnit_;
  }
  report.files.push_back(path_);
}

void FileReader::DescribeMaterials() {
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  materials_ = gltf_ ? gltf_->Materials(context_) : ReadMaterials(*scene_, folder, context_);
  const bool isObj = extension_ == "obj", hasNone = extension_ == "ply" || extension_ == "stl";
  for (SurfaceMaterial& material : materials_) {
    if (gltf_) break;
    static const MtlScan none;
    const auto found = obj_.materials.find(material.name);
    const MtlScan& mtl = found != obj_.materials.end() ? found->second : none;
    if (mtl.dissolve) material.opacity = *mtl.dissolve;

    // Nothing is wholly transparent: exporters to other formats confuse opacity and transparency.
    if (!isObj && material.opacity <= 0) {
      material.opacity = 1;
      context_.Warn("The material \"" + material.name + "\" of \"" + path_ +
                    "\" has the opacity 0; it was taken as opaque.");
    }

    // The importer makes up reflectances where a file gives none.
    const bool madeUp = isObj ? !mtl.hasKd : hasNone || material.name == AI_DEFAULT_MATERIAL_NAME;
    if (!madeUp) continue;
    material.hasReflectance = bool(material.base);
    material.reflectance = material.base ? Spectrum(1.f) : context_.options.defaultReflectance;
  }
  materialRows_.assign(materials_.size(), -1);
  materialUse_.resize(materials_.size());
}

void FileReader::WalkNodes() {
  std::vector<std::pair<const aiNode*, Matrix4>> stack{
      {scene_->mRootNode, Scaling(metresPerUnit_)}};
  while (!stack.empty()) {
    const auto [node, parentToWorld] = stack.back();
    stack.pop_back();
    const Matrix4 toWorld = parentToWorld * ToMatrix(node->mTransformation);
    if (!std::all_of(toWorld.begin(), toWorld.end(), [](double x) { return std::isfinite(x); })) {
      throw Error("The node \"" + std::string(node->mName.C_Str()) + "\" in \"" + path_ +
                  "\" is placed by a number that is not finite; repair the file.");
    }
    nodes_.emplace(node->mName.C_Str(), toWorld);
    AddParts(*node, toWorld);
    Advance(0.6 + 0.4 * double(meshRows_.size()) / std::max(1.0, double(scene_->mNumMeshes)));
    for (unsigned i = node->mNumChildren; i > 0; --i) {
      const aiNode* child = node->mChildren[i - 1];
      if (child) stack.push_back({child, toWorld});  // The importer of RAW leaves gaps.
    }
  }
}

void FileReader::AddParts(const aiNode& node, const Matrix4& toWorld) {
  SceneAssembly& assembly = context_.assembly;
  const int row = gltf_ ? GltfDocument::IndexFromName(node.mName.C_Str()) : -1;
  const std::string name = row >= 0 ? gltf_->NodeName(row) : node.mName.C_Str();
  const std::vector<Matrix4> instances =
      row >= 0 ? gltf_->Instances(row) : std::vector<Matrix4>{kIdentity};
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const int32_t mesh = MeshRow(node.mMeshes[i]);
    if (mesh < 0) continue;
    for (const Matrix4& instance : instances)
      assembly.parts.push_back({name, path_, mesh, toWorld * instance});
  }
  if (row < 0) return;
  if (const auto light = gltf_->NodeLight(row, toWorld)) assembly.lights.push_back(*light);
  const auto camera = gltf_->NodeCamera(row, toWorld);
  if (camera && !assembly.camera) assembly.camera = camera;
}

/// Reads the mesh where it is met first, and frees the importer's; nodes that share it share the
/// row.
int32_t FileReader::MeshRow(unsigned index) {
  const auto known = meshRows_.find(index);
  if (known != meshRows_.end()) return known->second;
  std::unique_ptr<aiMesh> source(std::exchange(scene_->mMeshes[index], nullptr));
  CheckAnnounced(*source);
  const size_t material = MaterialOf(*source);
  int32_t& row = materialRows_[material];
  if (row < 0) {
    WarnOfUnknown(materials_[material].name);
    row = AppendMaterial(materials_[material], path_, context_);
  }

  // STL stores the normals of facets, which say nothing of a point.
  const bool keepNormals = extension_ != "stl";
  TriangleMesh mesh = ReadMesh(source.get(), materials_[material], row, keepNormals, path_,
                               context_, &materialUse_[material]);
  if (mesh.triangles.empty()) return meshRows_[index] = -1;
  context_.assembly.meshes.push_back(std::move(mesh));
  return meshRows_[index] = int32_t(context_.assembly.meshes.size()) - 1;
}

/// An OBJ may name a material that no library of it describes.
void FileReader::WarnOfUnknown(const std::string& material) const {
  const bool hasLibrary = !obj_.materials.empty() && obj_.missingMtl.empty();
  if (!hasLibrary || material == AI_DEFAULT_MATERIAL_NAME || obj_.materials.count(material)) return;
  context_.Warn("The material \"" + material + "\" of \"" + path_ +
                "\" is in no material library; it reflects the default.");
}

/// Row of the file's materials. The importer orders those of a glTF by their first use: their names
/// tell.
size_t FileReader::MaterialOf(const aiMesh& mesh) const {
  const size_t last = materials_.size() - 1;
  if (!gltf_) return std::min<size_t>(mesh.mMaterialIndex, last);
  const int row =
      GltfDocument::IndexFromName(scene_->mMaterials[mesh.mMaterialIndex]->GetName().C_Str());
  return row < 0 ? last : std::min(size_t(row), last);
}

/// The importer leaves out glTF faces whose indices are out of range without a word.
void FileReader::CheckAnnounced(const aiMesh& mesh) const {
  if (!gltf_) return;
  const std::string name = mesh.mName.C_Str();
  const int row = GltfDocument::IndexFromName(name);
  const size_t dash = name.find('-');
  const int primitive = dash == std::string::npos ? 0 : std::atoi(name.c_str() + dash + 1);
  if (row < 0 || primitive >= gltf_->PrimitiveCount(row)) return;
  if (int64_t(mesh.mNumFaces) < gltf_->AnnouncedTriangles(row, primitive)) {
    throw Error("A face of mesh " + std::to_string(row) + " in \"" + path_ +
                "\" names a point that is not there; export it again.");
  }
}

void FileReader::ReadLightsAndCamera() {
  for (unsigned i = 0; i < scene_->mNumLights; ++i) ReadLight(*scene_->mLights[i]);
  if (scene_->mNumCameras > 0 && !context_.assembly.camera) ReadCamera(*scene_->mCameras[0]);
}

void FileReader::ReadLight(const aiLight& source) {
  Light light;
  light.name = source.mName.C_Str();
  switch (source.mType) {
    case aiLightSource_POINT:
      light.type = LightType::Point;
      break;
    case aiLightSource_SPOT:
      light.type = LightType::Spot;
      break;
    case aiLightSource_DIRECTIONAL:
      light.type = LightType::Directional;
      break;
    default:
      context_.Warn("The light \"" + light.name + "\" of \"" + path_ +
                    "\" is ambient or an area; it gives no light.");
      return;
  }
  const auto node = nodes_.find(light.name);
  const Matrix4 toWorld = node != nodes_.end() ? node->second : Scaling(metresPerUnit_);
  light.position = Vec3f(TransformPoint(toWorld, ToVec3(source.mPosition)));
  light.direction = Vec3f(Normalize(TransformDirection(toWorld, ToVec3(source.mDirection))));
  light.intensity = {source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b};
  light.innerConeAngle = source.mAngleInnerCone / 2;
  light.outerConeAngle = source.mAngleOuterCone / 2;
  if (!light.intensity.IsFinite() || !IsFinite(light.position) || !IsFinite(light.direction)) {
    throw Error("The light \"" + light.name + "\" of \"" + path_ +
                "\" has a value that is not finite; repair the file.");
  }
  context_.assembly.lights.push_back(light);
}

void FileReader::ReadCamera(const aiCamera& source) {
  const auto node = nodes_.find(source.mName.C_Str());
  const Matrix4 toWorld = node != nodes_.end() ? node->second : Scaling(metresPerUnit_);
  Camera camera;
  camera.position = TransformPoint(toWorld, ToVec3(source.mPosition));
  camera.focalPoint =
      camera.position + Normalize(TransformDirection(toWorld, ToVec3(source.mLookAt)));
  camera.viewUp = Normalize(TransformDirection(toWorld, ToVec3(source.mUp)));
  const double aspect = source.mAspect > 0 ? double(source.mAspect) : 4.0 / 3;
  const double halfHorizontal = double(source.mHorizontalFOV) / 2;
  camera.verticalFieldOfView = 2 * std::atan(std::tan(halfHorizontal) / aspect) * 180 / kPi;
  const bool usable = IsFinite(camera.position) && IsFinite(camera.focalPoint) &&
                      camera.verticalFieldOfView > 0 && camera.verticalFieldOfView < 180;
  if (usable) context_.assembly.camera = camera;
}

void FileReader::CountMaterials() {
  for (const MaterialUse& use : materialUse_) {
    context_.assembly.report.materialsClamped += use.clamped;
    context_.assembly.report.transparentMaterials += use.transparent;
  }
}

void FileReader::ThrowNoTriangle() const {
  const bool transparent = context_.assembly.report.transparentFaces > 0;
  throw Error("The file \"" + path_ + "\" holds no triangle" +
              (transparent ? " that is not transparent; read it with opaque glass."
                           : "; name a file with surfaces."));
}

}  // namespace

SceneAssembly ReadScene(const std::vector<std::string>& files, const SceneReaderOptions& options,
                        const ProgressCallback& progress) {
  if (files.empty()) throw Error("No file is named; name one to read.");
  SceneAssembly assembly;
  TextureLibrary textures;
  const ReadContext context{options, assembly, textures};
  for (size_t i = 0; i < files.size(); ++i) {
    const auto fileProgress = [&](double fraction, const char* stage) {
      return Report(progress, (double(i) + fraction) / double(files.size()), stage);
    };
    try {
      FileReader(files[i], context, fileProgress).Read();
    } catch (const nlohmann::json::exception& cause) {
      throw Error("The file \"" + files[i] + "\" breaks the glTF format (" + cause.what() +
                  "); export it again.");
    }
  }

  // Textures that are not there leave their factor alone.
  std::vector<std::string>& companions = assembly.report.companions;
  companions.insert(companions.end(), textures.Files().begin(), textures.Files().end());
  for (const std::string& name : textures.Missing()) {
    context.Warn("The texture \"" + name +
                 "\" is missing or cannot be decoded; its factor counts alone.");
  }
  assembly.report.texturesMissing = int64_t(textures.Missing().size());
  ReturnFreedMemory();  // Importers free small pieces by the million.
  Report(progress, 1, "Reading scene");
  return assembly;
}

}  // namespace lambert
