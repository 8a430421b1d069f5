#include "Radiosity/Core/LeafMeshEdges.h"

#include <cstring>

namespace lambert {

namespace {

// Bits of a coordinate; both zeros are one place.
uint32_t Bits(float coordinate) {
  const float value = coordinate + 0.f;
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

uint64_t Hash(const Vec3f& p) {
  uint64_t hash = Bits(p.x) * 0x9E3779B97F4A7C15ull;
  hash = (hash ^ (hash >> 29) ^ Bits(p.y)) * 0xBF58476D1CE4E5B9ull;
  hash = (hash ^ (hash >> 32) ^ Bits(p.z)) * 0x94D049BB133111EBull;
  return hash ^ (hash >> 31);
}

// For every point the first point at exactly its position, by open addressing.
std::vector<int32_t> MatchPositions(const std::vector<Vec3f>& positions) {
  size_t capacity = 16;
  while (capacity < positions.size() * 2) capacity *= 2;
  std::vector<int32_t> table(capacity, -1);
  std::vector<int32_t> place(positions.size());
  for (size_t point = 0; point < positions.size(); ++point) {
    size_t slot = Hash(positions[point]) & (capacity - 1);
    while (table[slot] >= 0 && positions[size_t(table[slot])] != positions[point]) {
      slot = (slot + 1) & (capacity - 1);
    }
    if (table[slot] < 0) table[slot] = int32_t(point);
    place[point] = table[slot];
  }
  return place;
}

}  // namespace

LeafMeshEdges::LeafMeshEdges(const TriangleMesh& mesh)
    : mesh_(mesh), place_(MatchPositions(mesh.positions)), isTouched_(mesh.positions.size(), 0) {}

// The edge's two points, the one at the lower place first.
std::array<int32_t, 2> LeafMeshEdges::Ends(int32_t face, int corner, bool* isForward) const {
  const auto& triangle = mesh_.triangles[size_t(face)];
  const int32_t from = triangle[size_t(corner)], to = triangle[size_t((corner + 1) % 3)];
  *isForward = place_[size_t(from)] <= place_[size_t(to)];
  return *isForward ? std::array<int32_t, 2>{from, to} : std::array<int32_t, 2>{to, from};
}

uint64_t LeafMeshEdges::Key(const std::array<int32_t, 2>& ends) const {
  return (uint64_t(uint32_t(place_[size_t(ends[0])])) << 32) | uint32_t(place_[size_t(ends[1])]);
}

LeafMeshEdges::FaceEdge LeafMeshEdges::Find(int32_t face, int corner) const {
  FaceEdge found;
  const auto ends = Ends(face, corner, &found.isForward);
  for (const int32_t end : ends) {
    if (!isTouched_[size_t(place_[size_t(end)])]) return found;
  }
  const auto edge = edgeOfKey_.find(Key(ends));
  if (edge == edgeOfKey_.end()) return found;
  found.edge = edge->second;
  const std::vector<Name>& names = edges_[size_t(found.edge)].names;
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i].ends == ends) found.name = int32_t(i);
  }
  return found;
}

LeafMeshEdges::FaceEdge LeafMeshEdges::FindOrAdd(int32_t face, int corner) {
  FaceEdge found = Find(face, corner);
  const auto ends = Ends(face, corner, &found.isForward);
  if (found.edge < 0) {
    found.edge = int32_t(edges_.size());
    edges_.emplace_back();
    edgeOfKey_.emplace(Key(ends), found.edge);
    for (const int32_t end : ends) isTouched_[size_t(place_[size_t(end)])] = 1;
  }
  if (found.name < 0) {
    Edge& edge = edges_[size_t(found.edge)];
    found.name = int32_t(edge.names.size());
    edge.names.push_back({ends, std::vector<int32_t>(edge.points.size(), -1)});
  }
  return found;
}

void LeafMeshEdges::InsertPoint(int32_t edge, int32_t index, double parameter) {
  Edge& e = edges_[size_t(edge)];
  e.points.insert(e.points.begin() + index, parameter);
  for (Name& name : e.names) name.numbers.insert(name.numbers.begin() + index, -1);
}

int32_t LeafMeshEdges::VertexNumber(int32_t edge, int32_t name, int32_t index) {
  const Edge& e = edges_[size_t(edge)];
  const std::array<int32_t, 2> ends = e.names[size_t(name)].ends;
  int32_t& number = edges_[size_t(edge)].names[size_t(name)].numbers[size_t(index)];
  if (number < 0) {
    // Always from the same end with the same parameter: the same bits under every name.
    const double t = e.points[size_t(index)];
    const Vec3d from(mesh_.positions[size_t(ends[0])]), to(mesh_.positions[size_t(ends[1])]);
    number = int32_t(mesh_.positions.size() + vertices_.size());
    vertices_.push_back(
        {Vec3f(from * (1 - t) + to * t), {ends[0], ends[1], ends[0]}, {float(1 - t), float(t), 0}});
  }
  return number;
}

int32_t LeafMeshEdges::AddInnerVertex(int32_t face, const Vec3d& weights) {
  Vec3d position;
  for (int i = 0; i < 3; ++i) position += Vec3d(mesh_.Corner(face, i)) * weights[i];
  vertices_.push_back({Vec3f(position), mesh_.triangles[size_t(face)], Vec3f(weights)});
  return int32_t(mesh_.positions.size() + vertices_.size() - 1);
}

}  // namespace lambert
