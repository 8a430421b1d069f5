#include "RandomScenes.h"

#include <cstdlib>

#include "Common/Core/Random.h"
#include "Common/Testing/TestScenes.h"

namespace lambert::testing {

namespace {

Vec3f RandomVector(Random* random) {
  const float x = random->Uniform(), y = random->Uniform();
  return {2 * x - 1, 2 * y - 1, 2 * random->Uniform() - 1};
}

struct Triangle {
  Vec3f a, b, c;
};

/// The next triangle, of one of nine kinds; most of them know the last.
Triangle NextTriangle(const Triangle& last, int kind, Random* random) {
  Triangle next = last;
  const Vec3f u = last.b - last.a, v = last.c - last.a;
  switch (kind) {
    case 0: {  // loose: crosses what is in its way
      next.a = RandomVector(random);
      next.b = next.a + RandomVector(random) * 0.6f;
      next.c = next.a + RandomVector(random) * 0.6f;
      break;
    }
    case 1:  // shares an edge
      next.c = last.a + RandomVector(random) * 0.5f;
      break;
    case 2:  // touches at a corner
      next.b = last.a + RandomVector(random) * 0.5f;
      next.c = last.a + RandomVector(random) * 0.5f;
      break;
    case 3: {  // in the same plane, overlapping
      const Vec3f shift = u * (0.5f * random->Uniform()) + v * (0.5f * random->Uniform());
      next = {last.a + shift, last.b + shift, last.c + shift};
      break;
    }
    case 4:  // the same once more
      break;
    case 5: {  // nearly parallel, a hair away
      const Vec3f gap = Normalize(Cross(u, v)) * (1e-4f + 0.02f * random->Uniform());
      next = {last.a + gap + RandomVector(random) * 1e-3f, last.b + gap, last.c + gap};
      break;
    }
    case 6: {  // a sliver
      next.a = RandomVector(random);
      next.b = next.a + RandomVector(random);
      next.c = next.a + (next.b - next.a) * random->Uniform() + RandomVector(random) * 1e-3f;
      break;
    }
    case 7:  // no area: a segment
      next.c = last.a + u * random->Uniform();
      break;
    default:  // no area: a point
      next.b = next.c = last.a;
  }
  if (random->Bits() % 2) std::swap(next.b, next.c);
  return next;
}

/// Beyond the walls of closed scenes.
bool IsOutside(const Triangle& t) {
  const Vec3f high = Max(Max(t.a, t.b), t.c), low = Min(Min(t.a, t.b), t.c);
  const Vec3f reach = Max(high, -low);
  return std::max(reach.x, std::max(reach.y, reach.z)) > 1.9f;
}

/// A bent strip of faces that share their points.
void AddStrip(TriangleMesh* mesh, int faces, float rho, int material, Random* random) {
  const Vec3f step = RandomVector(random) * 0.1f, across = RandomVector(random) * 0.3f;
  Vec3f p = RandomVector(random);
  int32_t left = AddPoint(mesh, p, {}), right = AddPoint(mesh, p + across, {});
  for (int face = 0; face < faces; ++face) {
    p += step + RandomVector(random) * 0.05f;
    const int32_t next = AddPoint(mesh, face % 2 ? p + across : p, {});
    if (face % 2) {
      AddFace(mesh, {left, next, right}, Spectrum(rho), Spectrum(0.f), material);
      right = next;
    } else {
      AddFace(mesh, {left, next, right}, Spectrum(rho), Spectrum(0.f), material);
      left = next;
    }
  }
}

/// Unit normals of the points that have none: of one of their faces.
void FillNormals(TriangleMesh* mesh) {
  for (int64_t face = 0; face < mesh->FaceCount(); ++face) {
    for (const int32_t p : mesh->triangles[size_t(face)]) {
      if (mesh->normals[size_t(p)] == Vec3f()) mesh->normals[size_t(p)] = mesh->FrontNormal(face);
    }
  }
  for (Vec3f& n : mesh->normals) {
    if (n == Vec3f()) n = {0, 0, 1};
  }
}

}  // namespace

RandomScene MakeRandomScene(uint64_t seed, Overlaps overlaps) {
  RandomScene made;
  TriangleMesh& mesh = made.scene.mesh;
  Random random(HashBits(seed, 0x6c617773u));
  const int count = 100 + int(random.Bits() % 150);
  Triangle last = NextTriangle({}, 0, &random);
  int strips = 0;
  for (int i = 0; i < count; ++i) {
    int kind = int(random.Bits() % 10);
    if (overlaps == Overlaps::None && (kind == 3 || kind == 4)) kind = 0;
    const Spectrum rho = Spectrum(random.Uniform(), random.Uniform(), 0.5f) * 0.9f;
    if (kind == 9 && strips < 3) {
      AddStrip(&mesh, 8, rho.g, ++strips, &random);
      continue;
    }
    last = NextTriangle(last, std::min(kind, 8), &random);
    while (IsOutside(last)) last = NextTriangle(last, 0, &random);
    const bool emits = i % 10 == 0;
    AddTriangle(&mesh, last.a, last.b, last.c, emits && i % 20 == 0 ? Spectrum(0.f) : rho,
                Spectrum(emits ? 5 * random.Uniform() : 0));
    if (emits) mesh.faceFlags.back() = uint8_t(1 + random.Bits() % 3);
  }
  made.isClosed = seed % 2 == 1;
  if (made.isClosed) AddBox(&mesh, {-2, -2, -2}, {2, 2, 2}, BoxMaterials(0.6f), true, 1, 4);
  made.hasSky = seed % 6 == 0;
  if (made.hasSky) {
    Light sky;
    sky.type = LightType::Sky;
    sky.intensity = Spectrum(0.3f, 0.5f, 0.8f);
    made.scene.lights = {sky};
  }
  FillNormals(&mesh);
  CompleteTables(&made.scene);
  mesh.Complete();
  return made;
}

void MakeFurnace(float rho, Scene* scene) {
  TriangleMesh& mesh = scene->mesh;
  std::fill(mesh.reflectance.begin(), mesh.reflectance.end(), Spectrum(rho));
  std::fill(mesh.emittance.begin(), mesh.emittance.end(), Spectrum(1.f));
  std::fill(mesh.faceFlags.begin(), mesh.faceFlags.end(), uint8_t(kEmitsFront | kEmitsBack));
  scene->lights.clear();
}

void MakeBlack(const std::vector<uint8_t>& lit, Scene* scene) {
  TriangleMesh& mesh = scene->mesh;
  std::fill(mesh.reflectance.begin(), mesh.reflectance.end(), Spectrum(0.f));
  for (size_t face = 0; face < lit.size(); ++face) {
    mesh.emittance[face] = Spectrum(lit[face] ? 1.f : 0.f);
    mesh.faceFlags[face] = lit[face] ? uint8_t(kEmitsFront | kEmitsBack) : uint8_t(0);
  }
  scene->lights.clear();
}

std::vector<uint64_t> LawSeeds() {
  const char* first = std::getenv("LAMBERT_LAWS_SEED");
  const char* count = std::getenv("LAMBERT_LAWS_COUNT");
  std::vector<uint64_t> seeds;
  const uint64_t begin = first ? std::strtoull(first, nullptr, 10) : 1;
  const uint64_t end = begin + (count ? std::strtoull(count, nullptr, 10) : 12);
  for (uint64_t seed = begin; seed < end; ++seed) seeds.push_back(seed);
  return seeds;
}

std::string HowToRepeat(uint64_t seed) {
  return "seed " + std::to_string(seed) +
         "; once more with LAMBERT_LAWS_SEED=" + std::to_string(seed) + " LAMBERT_LAWS_COUNT=1";
}

}  // namespace lambert::testing
