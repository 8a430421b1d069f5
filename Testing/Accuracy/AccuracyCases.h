// The table of known answers: scenes, what is asked of them, and the truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "Scene/Core/Scene.h"

namespace lambert::testing {

/// What is asked of a solved scene.
struct Quantity {
  enum class Kind {
    FormFactor,      ///< from kSource to kReceiver: mean irradiance x receiver area / source area
    MeanIrradiance,  ///< W/m2 over the front of the faces of `material`
    MeanRadiosity,   ///< W/m2 over the same
    At,              ///< irradiance at `position` on a surface, W/m2
    AtFacet,         ///< the same on the facet kReceiver
  };
  std::string label;
  Kind kind;
  int material = -1;  ///< -1: all
  Vec3f position, normal;
  double truth = 0;
  double lastDigit = 0;          ///< half a unit of the last digit that the truth is good to
  double scale = 1, offset = 0;  ///< what is compared is scale x what was asked + offset
};

/// What a method must be able to do for a case.
enum Need : unsigned {
  kVisibility = 1,    ///< things stand between surfaces
  kVaryingLight = 2,  ///< reflected light varies over a surface
  kPointLight = 4,
  kOneValueASurface = 8,  ///< the truth is that of a system of one value a surface
  kLongBounces = 32,      ///< light bounces so often that shooting it takes minutes
  kVariesOverFaces = 16,  ///< light varies over faces: what their corners receive is not enough
};

struct AccuracyCase {
  std::string name;
  std::function<Scene()> scene;
  std::vector<Quantity> quantities;
  unsigned needs = 0;
  double modelError = 0;  ///< relative: by which the facets miss the shape that the truth is of
  /// Relative, of light that is delivered for smooth normals: the truth is of facets.
  double smoothError = 0;
  double request = 0.05;  ///< error that solvers are asked for
};

/// All cases, in the order of Documentation/Accuracy.md.
const std::vector<AccuracyCase>& AccuracyCases();

}  // namespace lambert::testing
