#include "Radiosity/Core/PatchTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace lambert {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<bool, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, DataStructure,
                                                            CGAL::No_constraint_intersection_tag>;
using Triangles = std::vector<std::array<int32_t, 3>>;

double Area2(Vec2d a, Vec2d b, Vec2d c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether the quadrilateral's diagonal from vertex 0 to 2 is Delaunay: the angles at 1 and 3 sum to
// at most pi.
bool IsFirstDiagonalDelaunay(const std::vector<PatchBorderVertex>& quad) {
  double sine[2], cosine[2];
  for (size_t i = 0; i < 2; ++i) {
    const Vec2d tip = quad[1 + 2 * i].position;
    const Vec2d a = quad[(2 + 2 * i) % 4].position - tip, b = quad[2 * i].position - tip;
    sine[i] = a.x * b.y - a.y * b.x;
    cosine[i] = a.x * b.x + a.y * b.y;
  }
  return sine[0] * cosine[1] + cosine[0] * sine[1] >= 0;
}

Triangles TriangulateQuadrilateral(const std::vector<PatchBorderVertex>& quad) {
  // A diagonal that leaves a t-vertex aside would leave a triangle without area.
  const bool firstCut = quad[1].isCorner && quad[3].isCorner;
  const bool secondCut = quad[0].isCorner && quad[2].isCorner;
  const bool takeFirst = firstCut && (!secondCut || IsFirstDiagonalDelaunay(quad));
  if (takeFirst) return {{0, 1, 2}, {0, 2, 3}};
  return {{0, 1, 3}, {1, 2, 3}};
}

// Constrained Delaunay triangles inside the border; fewer than wanted where rounding has folded the
// border.
Triangles TriangulateDelaunay(const std::vector<PatchBorderVertex>& border) {
  const size_t count = border.size();
  Delaunay delaunay;
  std::vector<Delaunay::Vertex_handle> handles(count);
  Delaunay::Face_handle hint;
  for (size_t i = 0; i < count; ++i) {
    handles[i] = delaunay.insert({border[i].position.x, border[i].position.y}, hint);
    handles[i]->info() = int32_t(i);
    hint = handles[i]->face();
  }
  if (delaunay.number_of_vertices() != count || delaunay.dimension() != 2) return {};
  try {
    for (size_t i = 0; i < count; ++i) {
      delaunay.insert_constraint(handles[i], handles[(i + 1) % count]);
    }
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return {};
  }

  // A side that bends inward by a rounding leaves slivers outside: drop what reaches infinity.
  for (const auto face : delaunay.all_face_handles()) face->info() = false;
  std::vector<Delaunay::Face_handle> outside = {delaunay.infinite_face()};
  outside.front()->info() = true;
  while (!outside.empty()) {
    const Delaunay::Face_handle face = outside.back();
    outside.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle neighbour = face->neighbor(i);
      if (face->is_constrained(i) || neighbour->info()) continue;
      neighbour->info() = true;
      outside.push_back(neighbour);
    }
  }
  Triangles triangles;
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    if (face->info()) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

// Shape of a triangle: area over squared longest edge.
double Quality(Vec2d a, Vec2d b, Vec2d c) {
  double longest = 0;
  for (const Vec2d edge : {b - a, c - b, a - c}) {
    longest = std::max(longest, edge.x * edge.x + edge.y * edge.y);
  }
  return longest > 0 ? Area2(a, b, c) / longest : 0;
}

// Cuts the best-shaped ear until a triangle is left: always border.size() - 2 triangles along the
// border. Ears are cut at corners, and only where another corner remains, so that no triangle lies
// in a side.
Triangles ClipEars(std::vector<PatchBorderVertex> loop) {
  std::vector<int32_t> index(loop.size());
  std::iota(index.begin(), index.end(), 0);
  Triangles triangles;
  while (loop.size() > 2) {
    const size_t count = loop.size();
    const auto corners = std::count_if(loop.begin(), loop.end(),
                                       [](const PatchBorderVertex& v) { return v.isCorner; });
    size_t best = 0;
    double bestQuality = std::numeric_limits<double>::lowest();
    for (size_t i = 0; i < count; ++i) {
      const PatchBorderVertex& before = loop[(i + count - 1) % count];
      const PatchBorderVertex& after = loop[(i + 1) % count];
      const bool leavesCorner = corners > 1 + before.isCorner + after.isCorner || count == 3;
      if (!loop[i].isCorner || !leavesCorner) continue;
      const double quality = Quality(before.position, loop[i].position, after.position);
      if (quality > bestQuality) {
        bestQuality = quality;
        best = i;
      }
    }
    const size_t before = (best + count - 1) % count, after = (best + 1) % count;
    triangles.push_back({index[before], index[best], index[after]});
    loop[before].isCorner = loop[after].isCorner = true;
    loop.erase(loop.begin() + int64_t(best));
    index.erase(index.begin() + int64_t(best));
  }
  return triangles;
}

}  // namespace

std::vector<std::array<int32_t, 3>> TriangulatePatch(const std::vector<PatchBorderVertex>& border) {
  if (border.size() == 3) return {{0, 1, 2}};
  if (border.size() == 4) return TriangulateQuadrilateral(border);
  Triangles triangles = TriangulateDelaunay(border);
  return triangles.size() == border.size() - 2 ? triangles : ClipEars(border);
}

}  // namespace lambert
