#include "Radiosity/Core/LightExchange.h"

#include <cmath>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Largest share of what arrives at a leaf that a row sum over 1 may let leave it again: in gaps
/// between bright surfaces more would make light of nothing, bounce by bounce.
constexpr float kLargestGain = 0.95f;

/// Sum of |transfer x radiosity| and of the vectors: volumes keep both, to tell light from one side
/// from light from all.
VectorIrradiance Gather(const Element& receiver, const std::vector<Link>& links,
                        const ElementLight& light) {
  VectorIrradiance sum;
  for (const Link& link : links) {
    const Spectrum& radiosity = light.radiosity[size_t(link.source)];
    sum.Add(link.transfer, radiosity);  // (4.20)
    if (receiver.TurnsToAllSides()) sum.isotropic += radiosity * Length(link.transfer);
  }
  return sum;
}

/// Pulled up from the leaves: power and the power of squares, to have mean and variation.
void Pull(const ElementHierarchy& hierarchy, int32_t index, ElementLight* light) {
  const Element& parent = hierarchy[index];
  Spectrum sum;
  double squares = 0;
  for (int32_t child = parent.child; child < parent.child + parent.childCount; ++child) {
    const float area = hierarchy[child].area;
    sum += light->radiosity[size_t(child)] * area;
    const double mean = light->radiosity[size_t(child)].MaxBand();
    const double deviation = light->variation[size_t(child)];
    squares += area * (mean * mean + deviation * deviation);
  }
  if (!(parent.area > 0)) return;
  const Spectrum radiosity = sum / parent.area;  // (4.17)
  const double mean = radiosity.MaxBand();
  light->radiosity[size_t(index)] = radiosity;
  light->variation[size_t(index)] =
      float(std::sqrt(std::max(0.0, squares / double(parent.area) - mean * mean)));
}

struct Change {
  double difference = 0, total = 0;
  Change& operator+=(const Change& c) {
    difference += c.difference;
    total += c.total;
    return *this;
  }
};

}  // namespace

Spectrum ElementIrradiance(const Element& element, const VectorIrradiance& irradiance) {
  const VectorIrradiance light =
      element.TurnsToAllSides() ? irradiance.FromAllAround() : irradiance;
  Spectrum e = light.isotropic;
  for (int band = 0; band < 3; ++band) {
    const Vec3f& vector = light.vector[size_t(band)];
    const float length = Length(vector);
    if (length > 0) e[band] += FacingFraction(element, vector / length) * length;
  }
  return e;
}

double ReceivedPower(const ElementHierarchy& hierarchy, const ElementLight& light) {
  return OrderedSum<double>(hierarchy.Size(), [&](int64_t i) {
    const Element& element = hierarchy[int32_t(i)];
    if (!element.IsLeaf() || element.kind == ElementKind::Light) return 0.0;
    return double(ElementIrradiance(element, light.irradiance[size_t(i)]).MaxBand()) *
           double(light.rowScale[size_t(i)]) * double(element.area);
  });
}

VectorIrradiance PushIrradiance(const Element& parent, const VectorIrradiance& irradiance,
                                const Element& child) {
  if (child.TurnsToAllSides()) return irradiance;
  VectorIrradiance pushed = parent.TurnsToAllSides() ? irradiance.FromAllAround() : irradiance;
  for (Vec3f& vector : pushed.vector) {
    if (Dot(vector, child.vectorArea) <= 0) vector = Vec3f();  // (4.14)
  }
  return pushed;
}

void BoundRowSums(const ElementHierarchy& hierarchy, const LinkNetwork& network, float bound,
                  ElementLight* light) {
  // The light of a world in which every surface has radiosity 1: the irradiance of a leaf is its
  // row sum.
  const size_t size = size_t(hierarchy.Size());
  std::vector<VectorIrradiance> unit(size);
  for (const std::vector<int32_t>& level : hierarchy.Levels()) {
    ParallelForEach(int64_t(level.size()), 256, [&](int64_t i) {
      const int32_t index = level[size_t(i)];
      const Element& element = hierarchy[index];
      if (element.kind == ElementKind::Light) return;
      VectorIrradiance& sum = unit[size_t(index)];
      for (const Link& link : network.incoming[size_t(index)]) {
        if (hierarchy[link.source].kind == ElementKind::Light) continue;
        sum.vector[0] += link.transfer;
        if (element.TurnsToAllSides()) sum.isotropic.r += Length(link.transfer);
      }
      if (element.parent >= 0) {
        sum += PushIrradiance(hierarchy[element.parent], unit[size_t(element.parent)], element);
      }
      const float row = ElementIrradiance(element, sum).r;
      const float reflectance = std::max(element.reflectance.MaxBand(), 1e-6f);
      const float own = std::min(bound, std::max(1.f, kLargestGain / reflectance));
      light->rowScale[size_t(index)] = row > own ? own / row : 1;
    });
  }
}

double ExchangeLight(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                     ElementLight* light) {
  // Gather and push, level by level from the root.
  const auto& levels = hierarchy.Levels();
  for (const std::vector<int32_t>& level : levels) {
    ParallelForEach(int64_t(level.size()), 256, [&](int64_t i) {
      const int32_t index = level[size_t(i)];
      const Element& element = hierarchy[index];
      if (element.kind == ElementKind::Light) return;
      VectorIrradiance irradiance = Gather(element, network.incoming[size_t(index)], *light);
      if (element.parent >= 0) {
        irradiance += PushIrradiance(hierarchy[element.parent],
                                     light->irradiance[size_t(element.parent)], element);
      }
      light->irradiance[size_t(index)] = irradiance;
    });
  }

  // Reflect at the leaves and pull, level by level to the root.
  Change change;
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    change += OrderedSum<Change>(int64_t(level->size()), [&](int64_t i) {
      const int32_t index = (*level)[size_t(i)];
      const Element& element = hierarchy[index];
      Change here;
      if (element.kind == ElementKind::Light) return here;
      if (!element.IsLeaf()) {
        Pull(hierarchy, index, light);
        return here;
      }
      const Spectrum radiosity =
          element.emittance + element.reflectance *
                                  ElementIrradiance(element, light->irradiance[size_t(index)]) *
                                  light->rowScale[size_t(index)];  // (4.21)
      const Spectrum& old = light->radiosity[size_t(index)];
      for (int band = 0; band < 3; ++band) {
        here.difference += std::fabs(double(radiosity[band]) - double(old[band])) * element.area;
        here.total += double(radiosity[band]) * element.area;
      }
      light->radiosity[size_t(index)] = radiosity;
      light->variation[size_t(index)] = 0;
      return here;
    });
  }
  return change.total > 0 ? change.difference / change.total : 0;
}

}  // namespace lambert
