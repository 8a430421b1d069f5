// A lit scene: one triangle mesh in world space with its materials, parts and lights.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Scene/Core/Light.h"

namespace lambert {

struct BaseTexture;

struct Material {
  std::string name;
  Spectrum reflectance{0.5f};  ///< diffuse, [0, 0.98]; faces carry the value that counts (textures differ by face)
  Spectrum emittance;          ///< exitance of each emitting side, W/m2
  bool twoSidedEmitter = false;
  /// What the faces' reflectances are means of; null where no point can be looked up in it.
  std::shared_ptr<const BaseTexture> baseTexture;
};

/// A piece of the scene as it came in: one actor or one node of a file. Its faces and points lie together.
struct Part {
  std::string name;
  std::string source;  ///< file or actor
  int32_t meshId = 0;  ///< parts of one mesh are instances: same points and faces in object space
  std::array<double, 16> objectToWorld{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  ///< row-major
};

struct Camera {
  Vec3d position{0, 0, 1}, focalPoint, viewUp{0, 1, 0};
  double verticalFieldOfView = 40;  ///< degrees
};

struct Scene {
  TriangleMesh mesh;
  std::vector<Material> materials;
  std::vector<Part> parts;
  std::vector<Light> lights;
  std::optional<Camera> camera;  ///< the file's, where it has one

  /// True where anything gives light: an emitting face or a light that is not black.
  bool HasLight() const;
};

}  // namespace lambert
