#include "Scene/Core/SceneReaderMeshes.h"

#include <assimp/mesh.h>

#include <algorithm>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Scene/Core/MeshRepair.h"

namespace lambert {

namespace {

Vec3f ToVec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Twice the vector area of a polygon.
Vec3d NewellNormal(const std::vector<Vec3f>& corners) {
  Vec3d normal;
  const Vec3d origin(corners[0]);
  for (size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += Cross(Vec3d(corners[i]) - origin, Vec3d(corners[i + 1]) - origin);
  }
  return normal;
}

/// Cuts ears off a polygon in the plane.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Vec2d> points) : points_(std::move(points)) {}

  std::vector<std::array<int32_t, 3>> Clip() {
    std::vector<int32_t> ring(points_.size());
    for (size_t i = 0; i < ring.size(); ++i) ring[i] = int32_t(i);
    std::vector<std::array<int32_t, 3>> triangles;
    while (ring.size() > 3) {
      const size_t ear = FindEar(ring);
      triangles.push_back(Corner(ring, ear));
      ring.erase(ring.begin() + std::ptrdiff_t(ear));
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
  }

 private:
  static std::array<int32_t, 3> Corner(const std::vector<int32_t>& ring, size_t i) {
    const size_t n = ring.size();
    return {ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]};
  }

  /// Twice the signed area.
  double Area(int32_t a, int32_t b, int32_t c) const {
    const Vec2d p = points_[size_t(b)] - points_[size_t(a)],
                q = points_[size_t(c)] - points_[size_t(a)];
    return p.x * q.y - p.y * q.x;
  }

  bool IsEmpty(const std::vector<int32_t>& ring, const std::array<int32_t, 3>& t) const {
    for (const int32_t p : ring) {
      if (p == t[0] || p == t[1] || p == t[2]) continue;
      const Vec2d& q = points_[size_t(p)];
      if (q == points_[size_t(t[0])] || q == points_[size_t(t[1])] || q == points_[size_t(t[2])])
        continue;
      if (Area(t[0], t[1], p) >= 0 && Area(t[1], t[2], p) >= 0 && Area(t[2], t[0], p) >= 0)
        return false;
    }
    return true;
  }

  /// The first convex corner that holds no other; without one (the polygon crosses itself), the
  /// largest.
  size_t FindEar(const std::vector<int32_t>& ring) const {
    size_t largest = 0;
    double largestArea = -std::numeric_limits<double>::max();
    for (size_t i = 0; i < ring.size(); ++i) {
      const auto t = Corner(ring, i);
      const double area = Area(t[0], t[1], t[2]);
      if (area > 0 && IsEmpty(ring, t)) return i;
      if (area > largestArea) {
        largestArea = area;
        largest = i;
      }
    }
    return largest;
  }

  std::vector<Vec2d> points_;
};

void ReadPoints(const aiMesh& source, bool keepNormals, const std::string& file,
                TriangleMesh* mesh) {
  mesh->positions.reserve(source.mNumVertices);
  for (unsigned point = 0; point < source.mNumVertices; ++point) {
    mesh->positions.push_back(ToVec3(source.mVertices[point]));
    if (!IsFinite(mesh->positions.back())) {
      throw Error("Point " + std::to_string(point) + " of the mesh \"" + source.mName.C_Str() +
                  "\" in \"" + file +
                  "\" has a coordinate that is not a finite number; repair the file.");
    }
  }
  if (keepNormals && source.HasNormals()) {
    mesh->normals.reserve(source.mNumVertices);
    for (unsigned point = 0; point < source.mNumVertices; ++point) {
      const Vec3f normal = ToVec3(source.mNormals[point]);
      mesh->normals.push_back(IsFinite(normal) ? Normalize(normal) : Vec3f());
    }
  }
  if (source.HasTextureCoords(0)) {
    mesh->uvs.reserve(source.mNumVertices);
    for (unsigned point = 0; point < source.mNumVertices; ++point) {
      const aiVector3D& uv = source.mTextureCoords[0][point];
      mesh->uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? Vec2f(uv.x, uv.y) : Vec2f());
    }
  }
}

void ReadTriangles(const aiMesh& source, const std::string& file, ReadReport* report,
                   TriangleMesh* mesh) {
  mesh->triangles.reserve(source.mNumFaces);
  mesh->sourceCellId.reserve(source.mNumFaces);
  std::vector<Vec3f> corners;
  for (unsigned face = 0; face < source.mNumFaces; ++face) {
    const aiFace& polygon = source.mFaces[face];
    for (unsigned i = 0; i < polygon.mNumIndices; ++i) {
      if (polygon.mIndices[i] >= source.mNumVertices) {
        throw Error("Face " + std::to_string(face) + " of the mesh \"" + source.mName.C_Str() +
                    "\" in \"" + file + "\" names a point that is not there; repair the file.");
      }
    }
    if (polygon.mNumIndices < 3) {
      ++report->linesAndPointsIgnored;
      continue;
    }
    ++report->faces;
    report->polygonsTriangulated += polygon.mNumIndices > 3;
    const auto point = [&](int32_t i) { return int32_t(polygon.mIndices[i]); };
    if (polygon.mNumIndices == 3) {
      mesh->triangles.push_back({point(0), point(1), point(2)});
      mesh->sourceCellId.push_back(face);
      continue;
    }
    corners.clear();
    for (unsigned i = 0; i < polygon.mNumIndices; ++i)
      corners.push_back(mesh->positions[polygon.mIndices[i]]);
    for (const auto& triangle : TriangulatePolygon(corners)) {
      mesh->triangles.push_back({point(triangle[0]), point(triangle[1]), point(triangle[2])});
      mesh->sourceCellId.push_back(face);
    }
  }
}

/// Normals that are missing or no direction: that of a face that uses the point.
void MendNormals(const aiMesh& source, const std::string& file, const ReadContext& context,
                 TriangleMesh* mesh) {
  bool mended = false;
  for (int64_t face = 0; face < mesh->FaceCount() && !mesh->normals.empty(); ++face) {
    for (const int32_t point : mesh->triangles[size_t(face)]) {
      Vec3f& normal = mesh->normals[size_t(point)];
      if (!(normal == Vec3f())) continue;
      normal = mesh->FrontNormal(face);
      mended = true;
    }
  }
  if (mended) {
    context.Warn("The mesh \"" + std::string(source.mName.C_Str()) + "\" in \"" + file +
                 "\" has normals without a direction; those of its faces were taken.");
  }
}

std::array<Vec2f, 3> CornerUvs(const aiMesh& source, const std::array<int32_t, 3>& triangle,
                               int set) {
  std::array<Vec2f, 3> uvs;
  for (size_t i = 0; i < 3; ++i) {
    const aiVector3D& uv = source.mTextureCoords[set][triangle[i]];
    uvs[i] = {uv.x, uv.y};
  }
  return uvs;
}

/// What one triangle is made of: textures and vertex colours counted as their means.
struct FaceMaterial {
  Spectrum reflectance, emittance;
  bool transparent = false;
};

class FaceMaterials {
 public:
  FaceMaterials(const aiMesh& source, const SurfaceMaterial& material, const ReadContext& context)
      : source_(source), material_(material), context_(context) {
    if (!source.HasVertexColors(0) || !material.TakesVertexColours()) return;
    const bool linear = material.vertexColours == VertexColourUse::Multiplies;
    colours_.resize(source.mNumVertices);
    ParallelForEach(int64_t(colours_.size()), 4096, [&](int64_t point) {
      const aiColor4D& c = source.mColors[0][point];
      colours_[size_t(point)] =
          linear ? Spectrum(c.r, c.g, c.b)
                 : Spectrum(LinearFromSrgb(c.r), LinearFromSrgb(c.g), LinearFromSrgb(c.b));
    });
  }

  FaceMaterial Evaluate(const std::array<int32_t, 3>& triangle) const {
    FaceMaterial face{material_.reflectance, material_.emittance, false};
    const TextureValue base = Mean(material_.base, triangle);
    face.reflectance = face.reflectance * base.colour;
    if (!colours_.empty()) ApplyVertexColours(triangle, &face.reflectance);
    if (context_.options.blackMetals) {
      const float metallic = material_.metallic * Mean(material_.metallicMap, triangle).colour.b;
      face.reflectance *= std::max(0.f, 1 - metallic);
    }
    face.emittance = face.emittance * Mean(material_.emissive, triangle).colour;

    float opacity = material_.opacity * Cut(triangle);
    if (material_.hasAlpha) opacity *= base.alpha;
    face.transparent = opacity < 0.5f || material_.transmits;
    return face;
  }

 private:
  /// Mean over the triangle; over the image where the mesh has no uvs for it.
  TextureValue Mean(const TextureMap& map, const std::array<int32_t, 3>& triangle) const {
    if (!map) return {};
    const bool hasUvs = map.uvSet >= 0 && map.uvSet < AI_MAX_NUMBER_OF_TEXTURECOORDS &&
                        source_.HasTextureCoords(unsigned(map.uvSet));
    if (!hasUvs) return context_.textures.ImageMean(map);
    return context_.textures.TriangleMean(map, CornerUvs(source_, triangle, map.uvSet));
  }

  /// Mean of the opacity texture: its alpha where it has one, else its luminance.
  float Cut(const std::array<int32_t, 3>& triangle) const {
    const TextureMap& map = material_.opacityMap;
    if (!map) return 1;
    const TextureValue mean = Mean(map, triangle);
    return context_.textures.ImageMean(map).alpha < 1 ? mean.alpha : Luminance(mean.colour);
  }

  void ApplyVertexColours(const std::array<int32_t, 3>& triangle, Spectrum* reflectance) const {
    const bool linear = material_.vertexColours == VertexColourUse::Multiplies;
    Spectrum sum;
    for (const int32_t point : triangle) sum += colours_[size_t(point)];
    *reflectance = linear ? *reflectance * (sum / 3) : sum / 3;
  }

  const aiMesh& source_;
  const SurfaceMaterial& material_;
  const ReadContext& context_;
  std::vector<Spectrum> colours_;  ///< of the points, linear; empty where they do not count
};

/// Frees an array that the importer made.
template <class T>
void Free(T** array) {
  delete[] * array;
  *array = nullptr;
}

}  // namespace

std::vector<std::array<int32_t, 3>> TriangulatePolygon(const std::vector<Vec3f>& corners) {
  const size_t n = corners.size();
  const Vec3d normal = Normalize(NewellNormal(corners));

  // Convex, and so a fan: every corner turns left, and so does every triangle of the fan.
  std::vector<std::array<int32_t, 3>> fan;
  bool convex = true;
  for (size_t i = 0; i < n && convex; ++i) {
    const Vec3d a(corners[i]), b(corners[(i + 1) % n]), c(corners[(i + 2) % n]);
    convex = Dot(Cross(b - a, c - b), normal) >= 0;
  }
  for (size_t i = 1; i + 1 < n; ++i) {
    const Vec3d a(corners[0]), b(corners[i]), c(corners[i + 1]);
    convex = convex && Dot(Cross(b - a, c - a), normal) >= 0;
    fan.push_back({0, int32_t(i), int32_t(i + 1)});
  }
  if (convex) return fan;

  Vec3d u, v;
  CoordinateSystem(normal, &u, &v);
  std::vector<Vec2d> flat;
  for (const Vec3f& corner : corners) {
    const Vec3d p = Vec3d(corner) - Vec3d(corners[0]);
    flat.push_back({Dot(p, u), Dot(p, v)});
  }
  return EarClipper(std::move(flat)).Clip();
}

TriangleMesh ReadMesh(aiMesh* source, const SurfaceMaterial& material, int32_t materialId,
                      bool keepNormals, const std::string& file, const ReadContext& context,
                      MaterialUse* use) {
  // Geometry; what is read is freed in the source.
  TriangleMesh mesh;
  ReadReport& report = context.assembly.report;
  ReadPoints(*source, keepNormals, file, &mesh);
  Free(&source->mVertices);
  Free(&source->mNormals);
  ReadTriangles(*source, file, &report, &mesh);
  Free(&source->mFaces);
  MendNormals(*source, file, context, &mesh);

  // A texture that vertex colours stand for or tint, or that lies on no coordinates, cannot be
  // looked up alone.
  if ((source->HasVertexColors(0) && material.TakesVertexColours()) ||
      !source->HasTextureCoords(0)) {
    context.assembly.materials[size_t(materialId)].baseTexture = nullptr;
  }

  // Materials of the faces. Transparent ones neither block nor reflect: only the others are kept.
  const FaceMaterials evaluator(*source, material, context);
  const uint8_t emits = material.twoSidedEmitter ? kEmitsFront | kEmitsBack : kEmitsFront;
  const size_t count = mesh.triangles.size();
  mesh.reflectance.resize(count);
  mesh.emittance.resize(count);
  mesh.faceFlags.resize(count);
  std::vector<uint8_t> keep(count), clamped(count);
  ParallelForEach(mesh.FaceCount(), 1024, [&](int64_t i) {
    const size_t face = size_t(i);
    const FaceMaterial evaluated = evaluator.Evaluate(mesh.triangles[face]);
    bool over = false;
    mesh.reflectance[face] = ClampReflectance(evaluated.reflectance, &over);
    mesh.emittance[face] = evaluated.emittance;
    mesh.faceFlags[face] = evaluated.emittance.IsBlack() ? 0 : emits;
    keep[face] = !evaluated.transparent || context.options.opaqueGlass;
    clamped[face] = over && keep[face];
  });
  use->clamped |= std::find(clamped.begin(), clamped.end(), 1) != clamped.end();
  const int64_t transparent = std::count(keep.begin(), keep.end(), 0);
  if (transparent > 0) {
    use->transparent = true;
    report.transparentFaces += transparent;
    KeepFaces(keep, &mesh);
  }
  mesh.materialId.assign(mesh.triangles.size(), materialId);
  mesh.Complete();
  return mesh;
}

}  // namespace lambert
