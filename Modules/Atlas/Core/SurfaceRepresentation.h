// How each surface shows its light (thesis 5.1, 5.3): at its points where refinement stayed above
// the input triangles, in a light map where it went below.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/StoredAtlas.h"
#include "Atlas/Core/SurfaceSubset.h"

namespace lambert {

enum class Representation : uint8_t { Automatic, Points, LightMap };

struct RepresentationOptions {
  /// Triangles that refinement may add to all the surfaces that their points light, [0, inf).
  int64_t introducedTriangles = 0;
  std::vector<Representation> wanted;  ///< by surface; empty: all Automatic
  /// Automatic surfaces are cut into clusters, each of its own kind, with hardly a step between
  /// them where they are large and flat.
  bool splitSurfaces = false;
};

/// What a surface costs either way; of a sheet that is lit on both sides, a side of it; of a
/// surface that is cut, a part. Errors are relative RMS of irradiance against the solution, by
/// area.
struct SurfaceCost {
  Representation chosen = Representation::Points;
  int64_t inputTriangles = 0;    ///< drawn with a light map
  int64_t refinedTriangles = 0;  ///< drawn with light at the points: of the brighter side
  double area = 0;               ///< m2
  /// That its area takes in the light map, or would at the size of its texels; -1: it has none.
  int64_t texels = -1;
  double mapError = -1;        ///< of lookups in the light map; -1: it is not in it
  double inputPointError = 0;  ///< were the points of the input alone lit
  int32_t surface = 0;         ///< of the solved mesh
  uint8_t side = kFront;       ///< of its faces, which it shows

  int64_t Introduced() const {
    return refinedTriangles > inputTriangles ? refinedTriangles - inputTriangles : 0;
  }
};

/// Triangles, area and the error of the input's points, by surface, of the brighter sides. `mesh`
/// is the solved mesh. Throws Error where it has no surfaces.
std::vector<SurfaceCost> MeasureSurfaces(const TriangleMesh& mesh,
                                         const RadiositySolution& solution);

/// Takes the surfaces by the triangles that refinement introduced, the most first, into the light
/// map, until those of the others are within the options (thesis 5.3). Throws Error where the
/// options do not fit.
void ChooseRepresentations(const RepresentationOptions& options,
                           std::vector<SurfaceCost>* surfaces);

/// A solved scene, every surface in its representation.
struct RepresentedScene {
  /// Of the solved mesh, then the second sides of its sheets; in place of one that is cut, its
  /// parts.
  std::vector<SurfaceCost> surfaces;
  bool hasSheets = false;  ///< then faces are wound towards the side that they show
  /// In the light map; its inputFace are of the solved mesh, though a sheet has two.
  SurfaceSubset mapped;
  RadiosityAtlas atlas;  ///< of mapped.mesh
  LightMap map;
  RadiositySolution points;  ///< the sides that show of the others, on faces of the solved mesh
  std::vector<size_t> rowOfPoints;  ///< by triangle of `points`: in `surfaces`
};

/// Chooses, lays flat and draws the light of what the light map takes. `mesh` is in the order of
/// `tree`. What is wanted of a surface is wanted of both sides of a sheet. Where surfaces are
/// split, lookups along the border of the light map bring what points beyond it show. Throws Error,
/// Cancelled.
RepresentedScene RepresentSurfaces(const TriangleMesh& mesh, const ClusterTree& tree,
                                   const RadiositySolution& solution,
                                   const RepresentationOptions& options,
                                   const AtlasOptions& atlasOptions,
                                   const ProgressCallback& progress = {});

/// The same on an atlas that is there (IsAtlasOf): surfaces of the light map lie where they lie on
/// it, and those that it has no charts of are lit at their points, whatever is wanted.
RepresentedScene RepresentSurfaces(const TriangleMesh& mesh, const ClusterTree& tree,
                                   const RadiositySolution& solution,
                                   const RepresentationOptions& options, StoredAtlas stored,
                                   const ProgressCallback& progress = {});

/// The same for those who represent one solution again and again: what is still valid is not made
/// anew, and no result depends on what was there before. Mesh, tree and solution have to outlive
/// it.
class KeptRepresentation {
 public:
  /// Throws Error where the three do not belong together.
  KeptRepresentation(const TriangleMesh& mesh, const ClusterTree& tree,
                     const RadiositySolution& solution);
  /// On an atlas of the mesh, whatever the options of one say.
  KeptRepresentation(const TriangleMesh& mesh, const ClusterTree& tree,
                     const RadiositySolution& solution, StoredAtlas stored);
  ~KeptRepresentation();
  KeptRepresentation(const KeptRepresentation&) = delete;
  KeptRepresentation& operator=(const KeptRepresentation&) = delete;

  /// Surfaces are measured anew only where others may be cut, cut into charts where others are in
  /// the light map or charts would be others (ChartSet::IsOf), packed and drawn where an option of
  /// the atlas changed, too. Throws as RepresentSurfaces; then nothing is in Scene() to be used.
  void Represent(const RepresentationOptions& options, const AtlasOptions& atlasOptions,
                 const ProgressCallback& progress = {});
  const RepresentedScene& Scene() const { return scene_; }
  /// Leaves nothing to be used again.
  RepresentedScene TakeScene() { return std::move(scene_); }

  /// How often surfaces were cut into charts, and charts packed and their light drawn.
  struct Counts {
    int segmentations = 0, packings = 0;
  };
  const Counts& HowOften() const { return counts_; }

 private:
  /// What is chosen among: the surfaces as they are, or their parts.
  struct Candidates {
    std::optional<std::vector<bool>> mayBeCut;  ///< by surface; none: all are as they are
    TriangleMesh mesh;                          ///< of parts, as all that follows
    ClusterTree tree;
    RadiositySolution light;
    std::vector<int32_t> surface;    ///< by part
    std::vector<SurfaceCost> costs;  ///< by surface or part, but for those of the light map
  };

  ///@{ What surfaces are of: the solved mesh, or the sides of it that show.
  const TriangleMesh& Mesh() const { return shown_ ? shown_->mesh : solvedMesh_; }
  const ClusterTree& Tree() const { return shown_ ? shown_->tree : solvedTree_; }
  const RadiositySolution& Light() const { return shown_ ? onSides_ : solvedLight_; }
  ///@}
  void TakeLightOntoSides();
  void Measure(const RepresentationOptions& options);
  bool IsLaid(size_t row) const;
  void LayFlat(const AtlasOptions& options, const ProgressCallback& progress);
  void Take(const std::vector<SurfaceCost>& surfaces);
  void Draw(const AtlasOptions& options, const ProgressCallback& progress);
  void TellOfSolvedMesh(SurfaceCost* cost) const;

  const TriangleMesh& solvedMesh_;
  const ClusterTree& solvedTree_;
  const RadiositySolution& solvedLight_;
  std::optional<StoredAtlas> stored_;
  std::optional<ShownSides> shown_;
  std::vector<int64_t> laidFaces_;  ///< of Mesh(), on `stored_` (FindLaidFaces)
  RadiositySolution onSides_;
  Candidates candidates_;
  std::vector<char> isMapped_;         ///< by row: as `scene_` has been taken; empty: it has not
  std::vector<int64_t> mappedFaces_;   ///< by face of `scene_.mapped`: of Mesh()
  ChartSet charts_;                    ///< of `scene_.mapped`
  std::optional<AtlasOptions> drawn_;  ///< that `scene_` was drawn by
  RepresentedScene scene_;
  Counts counts_;
};

/// By face of `scene.mapped.mesh`: the side of its face of the solved mesh that it shows.
std::vector<uint8_t> SidesOfMappedFaces(const RepresentedScene& scene);

/// All surfaces in one mesh, whatever shows their light: those of the light map first, split at
/// their charts, with the light that lookups bring to their points.
struct RepresentedMesh {
  TriangleMesh mesh;
  std::vector<Vec2f> lightMapCoords;  ///< by point; (-1, -1): lit by its points
  std::vector<Spectrum> irradiance;   ///< by point, W/m2
  std::vector<int64_t> sharedPoint;   ///< by point: those that charts made of one have its number
  std::vector<int32_t> chart;         ///< by face, of the light map; -1 where points light it
  std::vector<int32_t> page;          ///< by face, of the light map; 0 where points light it
  std::vector<int64_t> inputFace;     ///< by face: of the solved mesh, in which it lies
  std::vector<uint8_t> side;          ///< by face: the side that it shows; empty without sheets
};
RepresentedMesh JoinRepresentations(const RepresentedScene& scene);

}  // namespace lambert
