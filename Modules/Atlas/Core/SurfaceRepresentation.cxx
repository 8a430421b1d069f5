#include "Atlas/Core/SurfaceRepresentation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "Atlas/Core/SurfaceParts.h"
#include "Atlas/Core/TexelDensity.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Sums towards a relative RMS error by area.
struct ErrorSum {
  double squares = 0, light = 0;

  void Add(const Spectrum& found, const Spectrum& wanted, double area) {
    squares += area * SquaredNorm(found - wanted);
    light += area * SquaredNorm(wanted);
  }
  double Rms() const { return light > 0 ? std::sqrt(squares / light) : 0; }
};

void RequireFitting(const RepresentationOptions& options, size_t surfaces) {
  if (options.introducedTriangles < 0) throw Error("Refinement adds 0 triangles or more.");
  if (!options.wanted.empty() && options.wanted.size() != surfaces) {
    throw Error("Representations are wanted of " + std::to_string(options.wanted.size()) +
                " surfaces, and there are " + std::to_string(surfaces) + ".");
  }
}

Vec3f Middle(const TriangleMesh& mesh, int64_t face) {
  return (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3.f;
}

Spectrum MeanOverCorners(const std::vector<Spectrum>& light, const TriangleMesh& mesh,
                         size_t face) {
  const auto& t = mesh.triangles[face];
  return (light[size_t(t[0])] + light[size_t(t[1])] + light[size_t(t[2])]) / 3;
}

/// Surface of `mesh` that a triangle of the solution lies on.
size_t SurfaceOf(const TriangleMesh& mesh, const RadiositySolution& solution, size_t triangle) {
  return size_t(mesh.surfaceId[size_t(solution.inputFaceId[triangle])]);
}

/// What the lookups of the surfaces in the light map are off by.
std::vector<double> MapErrors(const RepresentedScene& scene) {
  const TriangleMesh& mesh = scene.mapped.mesh;
  const RadiositySolution& solution = scene.mapped.solution;
  const std::vector<int32_t> chartOfFace = ChartOfFace(scene.atlas.set);
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(mesh, solution);
  std::vector<ErrorSum> errors(scene.mapped.tree.surfaceRoots.size());
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    const size_t surface = SurfaceOf(mesh, solution, t);
    if (solution.side[t] != sides[surface]) continue;
    const int64_t face = solution.inputFaceId[t];
    const Vec2f place = PlaceOnPage(mesh, scene.atlas, face, Middle(solution.mesh, int64_t(t)));
    const int page = scene.atlas.pageOfChart[size_t(chartOfFace[size_t(face)])];
    errors[surface].Add(Lookup(scene.map, page, place),
                        MeanOverCorners(solution.irradiance, solution.mesh, t),
                        solution.mesh.Area(int64_t(t)));
  }
  std::vector<double> rms;
  for (const ErrorSum& error : errors) rms.push_back(error.Rms());
  return rms;
}

/// That the surfaces in the light map cover.
std::vector<double> TexelsOfSurfaces(const RepresentedScene& scene) {
  std::vector<double> texels(scene.mapped.tree.surfaceRoots.size(), 0);
  for (size_t face = 0; face < scene.atlas.textureCoords.size(); ++face) {
    const auto& corners = scene.atlas.textureCoords[face];
    const Vec2d u(corners[1] - corners[0]), v(corners[2] - corners[0]);
    texels[size_t(scene.mapped.mesh.surfaceId[face])] +=
        0.5 * std::abs(u.x * v.y - u.y * v.x) * scene.atlas.pageSize * scene.atlas.pageSize;
  }
  return texels;
}

/// The triangles of a solution that lie on the brighter sides of its surfaces.
std::vector<int64_t> TrianglesOnBrighterSides(const TriangleMesh& mesh,
                                              const RadiositySolution& solution) {
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(mesh, solution);
  std::vector<int64_t> triangles;
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    if (solution.side[t] == sides[SurfaceOf(mesh, solution, t)]) triangles.push_back(int64_t(t));
  }
  return triangles;
}

/// Those triangles as a solution, on faces of the mesh that the subset was taken of; and the
/// surface of each, as `rows` number them.
RadiositySolution OnBrighterSides(const SurfaceSubset& subset, const std::vector<size_t>& rows,
                                  std::vector<size_t>* rowOfTriangle) {
  const std::vector<int64_t> triangles = TrianglesOnBrighterSides(subset.mesh, subset.solution);
  for (const int64_t t : triangles) {
    rowOfTriangle->push_back(rows[SurfaceOf(subset.mesh, subset.solution, size_t(t))]);
  }
  RadiositySolution taken = TakeTriangles(subset.solution, triangles);
  for (int64_t& face : taken.inputFaceId) face = subset.inputFace[size_t(face)];
  return taken;
}

template <class T>
void Append(const std::vector<T>& values, std::vector<T>* to) {
  to->insert(to->end(), values.begin(), values.end());
}

/// Faces and points of `other` behind those of `mesh`; what either lacks, both lack.
void AppendMesh(const TriangleMesh& other, TriangleMesh* mesh) {
  const int32_t first = int32_t(mesh->positions.size());
  const bool haveNormals = !mesh->normals.empty() && !other.normals.empty();
  const bool haveUvs = !mesh->uvs.empty() && !other.uvs.empty();
  Append(other.positions, &mesh->positions);
  Append(other.normals, &mesh->normals);
  Append(other.uvs, &mesh->uvs);
  if (first > 0 && !other.positions.empty()) {
    if (!haveNormals) mesh->normals.clear();
    if (!haveUvs) mesh->uvs.clear();
  }
  for (const auto& t : other.triangles) {
    mesh->triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  Append(other.reflectance, &mesh->reflectance);
  Append(other.emittance, &mesh->emittance);
  Append(other.faceFlags, &mesh->faceFlags);
  Append(other.materialId, &mesh->materialId);
  Append(other.partId, &mesh->partId);
  Append(other.sourceCellId, &mesh->sourceCellId);
  mesh->surfaceId.clear();  // Those of the two are not the same.
}

/// Light of what the light map shows. Where surfaces were cut, `uncut` has them whole: charts of
/// two parts have a seam, and the map brings at its border what the points beyond show.
LightMap DrawMapped(const RepresentedScene& scene, const RadiositySolution& solution,
                    const TriangleMesh* uncut, const ProgressCallback& progress) {
  const SurfaceSubset& mapped = scene.mapped;
  if (!uncut) return MakeLightMap(mapped.mesh, scene.atlas, mapped.solution, progress);
  TriangleMesh mesh = mapped.mesh;
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    mesh.surfaceId[face] = uncut->surfaceId[size_t(mapped.inputFace[face])];
  }
  return MakeLightMap(mesh, scene.atlas, mapped.solution, progress,
                      FindBorders(*uncut, solution, mapped, scene.atlas));
}

Representation WantedOf(const RepresentationOptions& options, size_t surface) {
  return options.wanted.empty() ? Representation::Automatic : options.wanted[surface];
}

/// What the surfaces take of the light map, and are off by in it.
void AddCostsOfMap(const RepresentedScene& scene, std::vector<SurfaceCost>* surfaces) {
  const std::vector<double> errors = MapErrors(scene), texels = TexelsOfSurfaces(scene);
  size_t next = 0;
  for (SurfaceCost& cost : *surfaces) {
    if (cost.chosen != Representation::LightMap) {
      const double size = scene.atlas.texelSize;
      if (size > 0) cost.texels = std::llround(std::ceil(cost.area / (size * size)));
      continue;
    }
    cost.texels = std::llround(std::ceil(texels[next]));
    cost.mapError = errors[next++];
  }
}

}  // namespace

std::vector<SurfaceCost> MeasureSurfaces(const TriangleMesh& mesh,
                                         const RadiositySolution& solution) {
  if (mesh.surfaceId.empty()) throw Error("The mesh has no surfaces; cluster its faces first.");
  const int32_t count = 1 + *std::max_element(mesh.surfaceId.begin(), mesh.surfaceId.end());
  std::vector<SurfaceCost> costs(static_cast<size_t>(count));
  std::vector<ErrorSum> errors(costs.size());
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    SurfaceCost& cost = costs[size_t(mesh.surfaceId[face])];
    ++cost.inputTriangles;
    cost.area += mesh.Area(int64_t(face));
  }
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(mesh, solution);
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    const size_t surface = SurfaceOf(mesh, solution, t);
    if (solution.side[t] != sides[surface]) continue;
    ++costs[surface].refinedTriangles;
    if (solution.inputIrradiance.empty()) continue;
    const int64_t face = solution.inputFaceId[t];
    const auto w = WeightsInFace(mesh, face, Middle(solution.mesh, int64_t(t)));
    Spectrum atPoints;
    for (size_t c = 0; c < 3; ++c) {
      atPoints += solution.inputIrradiance[size_t(mesh.triangles[size_t(face)][c])] * w[c];
    }
    errors[surface].Add(atPoints, MeanOverCorners(solution.irradiance, solution.mesh, t),
                        solution.mesh.Area(int64_t(t)));
  }
  for (size_t s = 0; s < costs.size(); ++s) {
    costs[s].side = sides[s];
    costs[s].inputPointError = errors[s].Rms();
  }
  return costs;
}

void ChooseRepresentations(const RepresentationOptions& options,
                           std::vector<SurfaceCost>* surfaces) {
  RequireFitting(options, surfaces->size());

  // What is wanted stands.
  std::vector<SurfaceCost>& costs = *surfaces;
  int64_t introduced = 0;
  std::vector<size_t> open;
  for (size_t s = 0; s < costs.size(); ++s) {
    const Representation wanted = WantedOf(options, s);
    if (wanted == Representation::LightMap) costs[s].chosen = wanted;
    if (wanted == Representation::Automatic) open.push_back(s);
    if (costs[s].chosen == Representation::Points) introduced += costs[s].Introduced();
  }

  // Of the others those with the most introduced triangles go first.
  std::stable_sort(open.begin(), open.end(), [&](size_t a, size_t b) {
    return costs[a].Introduced() > costs[b].Introduced();
  });
  for (const size_t s : open) {
    if (introduced <= options.introducedTriangles || costs[s].Introduced() == 0) break;
    costs[s].chosen = Representation::LightMap;
    introduced -= costs[s].Introduced();
  }
}

RepresentedScene RepresentSurfaces(const TriangleMesh& mesh, const ClusterTree& tree,
                                   const RadiositySolution& solution,
                                   const RepresentationOptions& options,
                                   const AtlasOptions& atlasOptions,
                                   const ProgressCallback& progress) {
  KeptRepresentation kept(mesh, tree, solution);
  kept.Represent(options, atlasOptions, progress);
  return kept.TakeScene();
}

RepresentedScene RepresentSurfaces(const TriangleMesh& mesh, const ClusterTree& tree,
                                   const RadiositySolution& solution,
                                   const RepresentationOptions& options, StoredAtlas stored,
                                   const ProgressCallback& progress) {
  KeptRepresentation kept(mesh, tree, solution, std::move(stored));
  kept.Represent(options, {}, progress);
  return kept.TakeScene();
}

KeptRepresentation::KeptRepresentation(const TriangleMesh& mesh, const ClusterTree& tree,
                                       const RadiositySolution& solution)
    : solvedMesh_(mesh),
      solvedTree_(tree),
      solvedLight_(solution),
      shown_(ShowBothSides(mesh, tree, solution)) {
  this->TakeLightOntoSides();
}

KeptRepresentation::KeptRepresentation(const TriangleMesh& mesh, const ClusterTree& tree,
                                       const RadiositySolution& solution, StoredAtlas stored)
    : solvedMesh_(mesh), solvedTree_(tree), solvedLight_(solution), stored_(std::move(stored)) {
  RequireSameFaces(mesh, solution);
  shown_ = ShowSidesOfChosen(mesh, tree, solution, *stored_);
  laidFaces_ = FindLaidFaces(mesh, shown_ ? &*shown_ : nullptr, &*stored_);
  this->TakeLightOntoSides();
}

void KeptRepresentation::TakeLightOntoSides() {
  if (!shown_) return;
  onSides_ = OntoShownSides(solvedLight_, shown_->inputFace, shown_->side);
  for (const int64_t point : shown_->inputPoint) {
    if (solvedLight_.inputIrradiance.empty()) break;
    onSides_.inputIrradiance.push_back(solvedLight_.inputIrradiance[size_t(point)]);
  }
}

KeptRepresentation::~KeptRepresentation() = default;

void KeptRepresentation::Represent(const RepresentationOptions& options,
                                   const AtlasOptions& atlasOptions,
                                   const ProgressCallback& progress) {
  if (!Report(progress, 0, "choosing representations")) throw Cancelled();

  // The sides of sheets are surfaces.
  RepresentationOptions wanted = options;
  if (shown_ && options.wanted.size() == solvedTree_.surfaceRoots.size()) {
    wanted.wanted.clear();
    for (const int32_t s : shown_->inputSurface) wanted.wanted.push_back(options.wanted[size_t(s)]);
  }
  RequireFitting(wanted, this->Tree().surfaceRoots.size());

  // Which of them, or of their parts, the light map takes.
  this->Measure(wanted);
  if (candidates_.mayBeCut) {
    RepresentationOptions ofParts = wanted;
    ofParts.wanted.clear();
    for (const int32_t s : candidates_.surface)
      ofParts.wanted.push_back(WantedOf(wanted, size_t(s)));
    wanted = ofParts;
  }
  if (wanted.wanted.empty()) wanted.wanted.resize(candidates_.costs.size());
  for (size_t row = 0; row < candidates_.costs.size(); ++row) {
    if (!this->IsLaid(row)) wanted.wanted[row] = Representation::Points;
  }
  std::vector<SurfaceCost> surfaces = candidates_.costs;
  ChooseRepresentations(wanted, &surfaces);
  this->Take(surfaces);

  // Its light, and what it costs.
  this->Draw(atlasOptions, progress);
  AddCostsOfMap(scene_, &surfaces);
  for (SurfaceCost& cost : surfaces) this->TellOfSolvedMesh(&cost);
  scene_.surfaces = std::move(surfaces);
}

void KeptRepresentation::Measure(const RepresentationOptions& options) {
  std::optional<std::vector<bool>> mayBeCut;
  if (options.splitSurfaces || (stored_ && stored_->isOfChosen)) {
    mayBeCut.emplace();
    for (size_t s = 0; s < this->Tree().surfaceRoots.size(); ++s) {
      const bool isOpen = WantedOf(options, s) == Representation::Automatic;
      mayBeCut->push_back(options.splitSurfaces && isOpen);
    }
  }
  if (!candidates_.costs.empty() && candidates_.mayBeCut == mayBeCut) return;
  candidates_ = Candidates();
  isMapped_.clear();

  if (mayBeCut) {
    // Parts of a surface show the same side.
    const TriangleMesh& mesh = this->Mesh();
    candidates_.light = TakeTriangles(this->Light(), TrianglesOnBrighterSides(mesh, this->Light()));
    SurfaceParts parts = CutWhereRefined(mesh, this->Tree(), candidates_.light, *mayBeCut);
    if (stored_) parts = CutWhereLaid(parts, laidFaces_);
    candidates_.mesh = mesh;
    candidates_.mesh.surfaceId = std::move(parts.partOfFace);
    candidates_.tree = std::move(parts.tree);
    candidates_.surface = std::move(parts.surfaceOfPart);
    candidates_.mayBeCut = std::move(mayBeCut);
    candidates_.costs = MeasureSurfaces(candidates_.mesh, candidates_.light);
  } else {
    candidates_.costs = MeasureSurfaces(this->Mesh(), this->Light());
  }
  for (size_t row = 0; row < candidates_.costs.size(); ++row) {
    candidates_.costs[row].surface = int32_t(row);
  }
}

bool KeptRepresentation::IsLaid(size_t row) const {
  if (!stored_) return true;
  const ClusterTree& tree = candidates_.mayBeCut ? candidates_.tree : this->Tree();
  return laidFaces_[size_t(tree.nodes[size_t(tree.surfaceRoots[row])].firstFace)] >= 0;
}

void KeptRepresentation::Take(const std::vector<SurfaceCost>& surfaces) {
  std::vector<char> isMapped, isLitByPoints;
  std::vector<size_t> litByPoints;
  for (size_t row = 0; row < surfaces.size(); ++row) {
    isMapped.push_back(surfaces[row].chosen == Representation::LightMap);
    isLitByPoints.push_back(!isMapped.back());
    if (!isMapped.back()) litByPoints.push_back(row);
  }
  if (isMapped == isMapped_) return;
  isMapped_.clear();
  charts_ = ChartSet();
  drawn_.reset();

  // Those that their points light.
  const bool areParts = candidates_.mayBeCut.has_value();
  const TriangleMesh& mesh = areParts ? candidates_.mesh : this->Mesh();
  const ClusterTree& tree = areParts ? candidates_.tree : this->Tree();
  const RadiositySolution& light = areParts ? candidates_.light : this->Light();
  scene_ = RepresentedScene();
  scene_.hasSheets = shown_.has_value();
  scene_.points = OnBrighterSides(TakeSurfaces(mesh, tree, light, isLitByPoints), litByPoints,
                                  &scene_.rowOfPoints);
  if (shown_) {
    for (int64_t& face : scene_.points.inputFaceId) face = shown_->inputFace[size_t(face)];
  }

  // Those of the light map.
  scene_.mapped = TakeSurfaces(mesh, tree, light, isMapped);
  mappedFaces_ = scene_.mapped.inputFace;
  isMapped_ = std::move(isMapped);
}

void KeptRepresentation::LayFlat(const AtlasOptions& options, const ProgressCallback& progress) {
  // Where they lie already.
  if (stored_) {
    std::vector<int64_t> faces;
    for (const int64_t face : mappedFaces_) faces.push_back(laidFaces_[size_t(face)]);
    scene_.atlas = TakeFacesOfAtlas(stored_->atlas, faces);
    return;
  }

  // Their charts, and the places of these.
  const SurfaceSubset& mapped = scene_.mapped;
  const auto layFlat = [&](double fraction, const char* stage) {
    return Report(progress, 0.7 * fraction, stage);
  };
  const ChartOptions chartOptions = ChartOptionsOf(mapped.tree, options);
  if (!charts_.IsOf(chartOptions)) {
    charts_ = CutIntoCharts(
        mapped.mesh, mapped.tree, chartOptions,
        [&](double fraction, const char* stage) { return layFlat(0.6 * fraction, stage); });
    ++counts_.segmentations;
  }
  scene_.atlas =
      WithTexelDensity(mapped.mesh, PackAtlas(charts_, options, layFlat), mapped.solution, options,
                       [&](double, const char* stage) { return Report(progress, 0.7, stage); });
  ++counts_.packings;
}

void KeptRepresentation::Draw(const AtlasOptions& options, const ProgressCallback& progress) {
  if (drawn_ && *drawn_ == options) return;
  drawn_.reset();
  this->LayFlat(options, progress);

  // Light on the faces of the mesh that was taken from, then told of that which was solved.
  scene_.mapped.inputFace = mappedFaces_;
  scene_.map = DrawMapped(scene_, candidates_.mayBeCut ? candidates_.light : this->Light(),
                          candidates_.mayBeCut ? &this->Mesh() : nullptr,
                          [&](double fraction, const char* stage) {
                            return Report(progress, 0.7 + 0.3 * fraction, stage);
                          });
  if (shown_) {
    for (int64_t& face : scene_.mapped.inputFace) face = shown_->inputFace[size_t(face)];
  }
  drawn_ = options;
}

void KeptRepresentation::TellOfSolvedMesh(SurfaceCost* cost) const {
  if (candidates_.mayBeCut) cost->surface = candidates_.surface[size_t(cost->surface)];
  if (!shown_) return;
  const size_t s = size_t(cost->surface);
  const ClusterNode& root = shown_->tree.nodes[size_t(shown_->tree.surfaceRoots[s])];
  cost->surface = shown_->inputSurface[s];
  cost->side = shown_->side[size_t(root.firstFace)];
}

std::vector<uint8_t> SidesOfMappedFaces(const RepresentedScene& scene) {
  std::vector<uint8_t> ofSurfaces, ofFaces;
  for (const SurfaceCost& cost : scene.surfaces) {
    if (cost.chosen == Representation::LightMap) ofSurfaces.push_back(cost.side);
  }
  for (const int32_t surface : scene.mapped.mesh.surfaceId) {
    ofFaces.push_back(ofSurfaces[size_t(surface)]);
  }
  return ofFaces;
}

RepresentedMesh JoinRepresentations(const RepresentedScene& scene) {
  // What the light map takes.
  RepresentedMesh joined;
  joined.mesh = scene.mapped.mesh;
  const int64_t mappedPoints = joined.mesh.PointCount();
  joined.lightMapCoords = SplitAtCharts(scene.atlas, &joined.mesh, &joined.sharedPoint);
  joined.chart = ChartOfFace(scene.atlas.set);
  joined.inputFace = scene.mapped.inputFace;
  joined.irradiance.resize(joined.lightMapCoords.size());
  for (const int32_t chart : joined.chart) {
    const int32_t page = scene.atlas.pageOfChart[size_t(chart)];
    for (const int32_t point : joined.mesh.triangles[joined.page.size()]) {
      const size_t p = size_t(point);
      joined.irradiance[p] = Lookup(scene.map, page, joined.lightMapCoords[p]);
    }
    joined.page.push_back(page);
  }

  // What its points light.
  AppendMesh(scene.points.mesh, &joined.mesh);
  joined.lightMapCoords.resize(joined.mesh.positions.size(), Vec2f(-1, -1));
  for (int64_t p = 0; p < scene.points.mesh.PointCount(); ++p) {
    joined.sharedPoint.push_back(mappedPoints + p);
  }
  joined.chart.resize(joined.mesh.triangles.size(), -1);
  joined.page.resize(joined.mesh.triangles.size(), 0);
  Append(scene.points.inputFaceId, &joined.inputFace);
  Append(scene.points.irradiance, &joined.irradiance);
  if (!scene.hasSheets) return joined;

  // The sides that they show.
  joined.side = SidesOfMappedFaces(scene);
  for (const size_t row : scene.rowOfPoints) joined.side.push_back(scene.surfaces[row].side);
  return joined;
}

}  // namespace lambert
