// Output of methods on a uniform mesh (declared in UniformMesh.h).
#include <algorithm>
#include <cmath>

#include "Classical/Core/UniformMesh.h"
#include "Common/Core/Parallel.h"
#include "Scene/Core/FirstEqual.h"

namespace lambert {

namespace {

/// How far a receiver is drawn from its point toward the middle of its elements, so that a corner
/// of a room does not look along its walls.
constexpr float kReceiverInset = 1e-3f;
/// It is drawn this part of the scene's diagonal at least, where its elements are that large: rays
/// skip a quarter of it.
constexpr float kClearance = 4e-5f;

/// Calls visit(point, corner angle in radians, output face) for every corner, faces in order.
template <class Visit>
void VisitCorners(const TriangleMesh& mesh, const Visit& visit) {
  constexpr float kLeastAngle = 1e-6f;  // so that a needle's tip has a say of last resort
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f& p = mesh.Corner(face, corner);
      const Vec3f u = mesh.Corner(face, (corner + 1) % 3) - p;
      const Vec3f v = mesh.Corner(face, (corner + 2) % 3) - p;
      const float angle = std::atan2(Length(Cross(u, v)), Dot(u, v));
      visit(size_t(mesh.triangles[size_t(face)][size_t(corner)]), std::max(kLeastAngle, angle),
            face);
    }
  }
}

/// Triangles of the lit sides with what their faces say; corners still name the mesh's vertices.
void AddSides(const Scene& scene, const UniformMesh& mesh, const std::vector<uint8_t>& litSides,
              UniformSolution* uniform) {
  const TriangleMesh& input = scene.mesh;
  RadiositySolution& solution = uniform->solution;
  TriangleMesh& output = solution.mesh;
  for (int64_t element = 0; element < mesh.ElementCount(); ++element) {
    const size_t face = size_t(mesh.face[size_t(element)]);
    const uint8_t sides = litSides[face] ? litSides[face] : uint8_t(1);
    for (const Side side : {kFront, kBack}) {
      if (!(sides & (1 << side))) continue;
      std::array<int32_t, 3> triangle = mesh.triangles[size_t(element)];
      if (side == kBack) std::swap(triangle[1], triangle[2]);
      const bool emits = input.Emits(int64_t(face), side);
      const int rewound = (input.faceFlags[face] & kRewound) ? 1 : 0;
      output.triangles.push_back(triangle);
      output.reflectance.push_back(input.reflectance[face]);
      output.emittance.push_back(emits ? input.emittance[face] : Spectrum());
      output.faceFlags.push_back(
          uint8_t((emits ? kEmitsFront : 0) | (rewound != int(side) ? kRewound : 0)));
      output.materialId.push_back(input.materialId[face]);
      output.partId.push_back(input.partId[face]);
      if (!input.surfaceId.empty()) output.surfaceId.push_back(input.surfaceId[face]);
      output.sourceCellId.push_back(input.sourceCellId[face]);
      solution.inputFaceId.push_back(int64_t(face));
      solution.side.push_back(side);
      uniform->element.push_back(int32_t(element));
    }
  }
}

/// One point for corners that agree in vertex, side and surface, in the order in which faces name
/// them.
void MakePoints(const UniformMesh& mesh, UniformSolution* uniform) {
  RadiositySolution& solution = uniform->solution;
  TriangleMesh& output = solution.mesh;
  const std::vector<int32_t>& surface =
      output.surfaceId.empty() ? output.materialId : output.surfaceId;
  const auto vertexOf = [&](int64_t corner) {
    return output.triangles[size_t(corner / 3)][size_t(corner % 3)];
  };
  const auto sheetOf = [&](int64_t corner) {
    const size_t face = size_t(corner / 3);
    return 2 * uint64_t(uint32_t(surface[face])) + solution.side[face];
  };
  const std::vector<int32_t> first = FirstEqual(
      3 * output.FaceCount(),
      [&](int64_t c) { return HashBits(sheetOf(c), uint64_t(uint32_t(vertexOf(c)))); },
      [&](int64_t c, int64_t d) { return vertexOf(c) == vertexOf(d) && sheetOf(c) == sheetOf(d); });

  std::vector<int32_t> pointOf(first.size());
  for (size_t corner = 0; corner < first.size(); ++corner) {
    int32_t& vertex = output.triangles[corner / 3][corner % 3];
    if (first[corner] == int32_t(corner)) {
      pointOf[corner] = int32_t(uniform->vertex.size());
      uniform->vertex.push_back(vertex);
      output.positions.push_back(mesh.positions[size_t(vertex)]);
      output.normals.push_back(mesh.normals[size_t(vertex)]);
      if (!mesh.uvs.empty()) output.uvs.push_back(mesh.uvs[size_t(vertex)]);
    }
    vertex = pointOf[size_t(first[corner])];
  }
}

/// Turns every point's normal to the side that it serves.
void TurnNormals(TriangleMesh* mesh) {
  std::vector<Vec3f> mean(mesh->positions.size());
  VisitCorners(*mesh, [&](size_t point, float angle, int64_t face) {
    mean[point] += mesh->FrontNormal(face) * angle;
  });
  for (size_t point = 0; point < mean.size(); ++point) {
    Vec3f& normal = mesh->normals[point];
    if (Dot(normal, mean[point]) < 0) normal = -normal;
    if (LengthSquared(normal) == 0) normal = Normalize(mean[point]);
  }
}

/// Where each point gathers from: drawn toward the mean of the centroids about it, in the plane of
/// the element that it is then nearest to; of equally near ones, the first that has an area.
void PlaceReceivers(UniformSolution* uniform) {
  const TriangleMesh& mesh = uniform->solution.mesh;
  const size_t points = mesh.positions.size();
  std::vector<Vec3d> middle(points);
  std::vector<int32_t> corners(points, 0);
  VisitCorners(mesh, [&](size_t point, float, int64_t face) {
    middle[point] +=
        Vec3d(mesh.Corner(face, 0)) + Vec3d(mesh.Corner(face, 1)) + Vec3d(mesh.Corner(face, 2));
    ++corners[point];
  });
  uniform->receivers.resize(points);
  const float clearance = kClearance * mesh.Bounds().Diagonal();
  for (size_t point = 0; point < points; ++point) {
    ElementReceiver& receiver = uniform->receivers[point];
    const Vec3f centre(middle[point] / double(3 * corners[point]));
    receiver.normal = mesh.normals[point];
    const Vec3f way = centre - mesh.positions[point];
    const float inset = std::max(kReceiverInset, clearance / std::max(clearance, Length(way)));
    receiver.position = mesh.positions[point] + way * std::min(0.5f, inset);
  }

  std::vector<float> height(points);
  VisitCorners(mesh, [&](size_t point, float, int64_t face) {
    ElementReceiver& receiver = uniform->receivers[point];
    const Vec3f normal = mesh.FrontNormal(face);
    const float above = Dot(normal, receiver.position - mesh.positions[point]);
    const bool isFirst = receiver.element < 0 || LengthSquared(receiver.geometric) == 0;
    if (!isFirst && !(std::abs(above) < std::abs(height[point]))) return;
    if (receiver.element >= 0 && LengthSquared(normal) == 0) return;
    height[point] = above;
    receiver.geometric = normal;
    receiver.element = uniform->element[size_t(face)];
    receiver.side = Side(uniform->solution.side[size_t(face)]);
  });
  for (size_t point = 0; point < points; ++point) {
    ElementReceiver& receiver = uniform->receivers[point];
    receiver.position -= receiver.geometric * height[point];
  }
}

}  // namespace

UniformSolution MakeUniformSolution(const Scene& scene, const UniformMesh& mesh,
                                    const std::vector<uint8_t>& litSides) {
  UniformSolution uniform;
  AddSides(scene, mesh, litSides, &uniform);
  MakePoints(mesh, &uniform);
  TurnNormals(&uniform.solution.mesh);
  PlaceReceivers(&uniform);
  return uniform;
}

std::vector<Spectrum> MeanAboutPoints(const UniformSolution& uniform,
                                      const std::vector<Spectrum>& elementIrradiance) {
  const size_t points = size_t(uniform.PointCount());
  std::vector<Spectrum> irradiance(points);
  std::vector<float> weight(points, 0);
  VisitCorners(uniform.solution.mesh, [&](size_t point, float angle, int64_t face) {
    const size_t element = size_t(uniform.element[size_t(face)]);
    irradiance[point] +=
        elementIrradiance[2 * element + uniform.solution.side[size_t(face)]] * angle;
    weight[point] += angle;
  });
  for (size_t point = 0; point < points; ++point) irradiance[point] *= 1 / weight[point];
  return irradiance;
}

RadiositySolution DeliverLight(const Scene& scene, UniformSolution uniform,
                               std::vector<Spectrum> irradiance) {
  RadiositySolution solution = std::move(uniform.solution);
  solution.irradiance = std::move(irradiance);

  // Radiosity, by the mean material about a point.
  const size_t points = solution.irradiance.size();
  std::vector<Spectrum> reflectance(points), emittance(points);
  std::vector<float> weight(points, 0);
  VisitCorners(solution.mesh, [&](size_t point, float angle, int64_t face) {
    reflectance[point] += solution.mesh.reflectance[size_t(face)] * angle;
    emittance[point] += solution.mesh.emittance[size_t(face)] * angle;
    weight[point] += angle;
  });
  solution.radiosity.resize(points);
  for (size_t point = 0; point < points; ++point) {
    solution.radiosity[point] =
        (reflectance[point] * solution.irradiance[point] + emittance[point]) / weight[point];
  }

  // The scene's own points take the brighter of their sides.
  solution.inputIrradiance.assign(scene.mesh.positions.size(), {});
  for (size_t point = 0; point < points; ++point) {
    const size_t vertex = size_t(uniform.vertex[point]);
    if (vertex >= solution.inputIrradiance.size()) continue;
    Spectrum& brightest = solution.inputIrradiance[vertex];
    const Spectrum& here = solution.irradiance[point];
    if (Luminance(here) > Luminance(brightest)) brightest = here;
  }
  return solution;
}

}  // namespace lambert
