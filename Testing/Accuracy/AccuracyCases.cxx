#include "AccuracyCases.h"

#include "AccuracyScenes.h"

namespace lambert::testing {

namespace {

using Kind = Quantity::Kind;
using Table = std::vector<AccuracyCase>;

Quantity Asked(const std::string& label, Kind kind, double truth, int material = -1) {
  Quantity q;
  q.label = label, q.kind = kind, q.truth = truth, q.material = material;
  return q;
}

AccuracyCase& Add(Table* table, const std::string& name, const std::function<Scene()>& scene,
                  const std::vector<Quantity>& quantities) {
  table->emplace_back();
  table->back().name = name, table->back().scene = scene, table->back().quantities = quantities;
  return table->back();
}

AccuracyCase& AddFormFactor(Table* table, const std::string& name, double truth,
                            const Polygon& source, const Polygon& receiver,
                            const Polygon& blocker = {}) {
  const auto scene = [=] { return SourceAndReceiver(source, receiver, blocker); };
  AccuracyCase& added = Add(table, name, scene, {Asked("F", Kind::FormFactor, truth)});
  added.needs = kVariesOverFaces;
  return added;
}

/// Of a name.
std::string Digits(double value, size_t count) { return std::to_string(value).substr(0, count); }

/// The mean over a facet of side s differs from the value at its middle by s^2 / 24 times the
/// Laplacian of the irradiance within its plane: for sources at least half their size away that is
/// below 24 times the irradiance itself.
constexpr double kFacetError = double(kFacetSide) * double(kFacetSide);

Quantity AtFacet(const Vec3f& position, const Vec3f& normal, double truth) {
  Quantity q = Asked("E", Kind::AtFacet, truth, kReceiver);
  q.position = position, q.normal = normal;
  return q;
}

AccuracyCase& AddPoint(Table* table, const std::string& name, double truth, const Polygon& source,
                       const Vec3f& position, const Vec3f& normal) {
  const auto scene = [=] { return SourceAndReceiver(source, Facet(position, normal)); };
  AccuracyCase& added = Add(table, name, scene, {AtFacet(position, normal, truth)});
  added.modelError = kFacetError;
  return added;
}

// 1 to 4: rectangles (Howell, A Catalog of Radiation Heat Transfer Configuration Factors).
void AddRectangles(Table* table) {
  AddFormFactor(table, "1 parallel squares at 1", 0.1998248957, Floor(0), Ceiling(1));
  AddFormFactor(table, "1 parallel 2 x 1 at 1", 0.2858753849, Floor(0, 2), Ceiling(1, 2));
  AddFormFactor(table, "1 parallel squares at 0.1", 0.8269945224, Floor(0), Ceiling(0.1f));
  AddFormFactor(table, "1 parallel squares at 10", 0.0031620568, Floor(0), Ceiling(10));

  AddFormFactor(table, "2 perpendicular W 1 H 1", 0.2000437761, Floor(0), Wall());
  AddFormFactor(table, "2 perpendicular W 2 H 1", 0.1164263014, Floor(0, 2), Wall());
  AddFormFactor(table, "2 perpendicular W 1 H 2", 0.2328526028, Floor(0), Wall(1, 2));

  AddFormFactor(table, "3 shifted by 1 0", 0.0860504892, Floor(0), Ceiling(1, 1, 1, 1, 0));
  AddFormFactor(table, "3 shifted by 1 1", 0.0433274096, Floor(0), Ceiling(1, 1, 1, 1, 1));
  AddFormFactor(table, "3 shifted by 2 0", 0.0152754501, Floor(0), Ceiling(1, 1, 1, 2, 0));

  AddFormFactor(table, "4 wall and floor apart", 0.0328088267, Wall(), Floor(0, 1, 1, 1, 0));
  AddFormFactor(table, "4 wall and floor at a corner", 0.0405922301, Wall(), Floor(0, 1, 1, 0, 1));
  AddFormFactor(table, "4 wall and floor beside", 0.0043144144, Wall(), Floor(0, 1, 1, 0, 2));
}

/// A polygon of n sides with the area of the disc swings about its radius by (pi/n)^2 / 3. Swings
/// of either sign cancel but for their squares: 1e-5 at 32 sides.
constexpr double kDiscError = 1e-5;

// 5 to 8: discs, points and spheres.
void AddDiscsAndPoints(Table* table) {
  const Polygon wide = Disc(1, 1, false), narrow = Disc(0.5f, 1, false);
  AddFormFactor(table, "5 discs 1 1 at 1", 0.3819660113, Disc(1, 0, true), wide).modelError =
      kDiscError;
  AddFormFactor(table, "5 discs 0.5 1 at 1", 0.4688711259, Disc(0.5f, 0, true), wide).modelError =
      kDiscError;

  const Vec3f up(0, 0, 1), east(1, 0, 0);
  AddPoint(table, "6 under the corner", 0.1385316060, Ceiling(1), {0, 0, 0}, up);
  AddPoint(table, "6 under the centre", 0.2394564705, Ceiling(1), {0.5f, 0.5f, 0}, up);
  AddPoint(table, "7 across 1 1 1", 0.0557341970, Ceiling(1), {0, 0, 0}, east);
  AddPoint(table, "7 across 2 1 0.5", 0.1587748045, Ceiling(0.5f, 2), {0, 0, 0}, east);
  AddPoint(table, "8 disc r h", 0.5, wide, {0, 0, 0}, up).modelError += kDiscError;
  AddPoint(table, "8 disc r h/2", 0.2, narrow, {0, 0, 0}, up).modelError += kDiscError;

  // Facets of a sphere with the right mean shadow: what a single shadow differs by is less than
  // the depth of a facet, 1 - cos(pi / 2n) of the radius, so twice that of the shadow.
  const int stacks = 24;
  const auto addSphere = [&](const std::string& name, double truth, const Vec3f& normal) {
    const auto scene = [=] { return SphereOverFacet(1, 2, normal, stacks); };
    Add(table, name, scene, {AtFacet({0, 0, 0}, normal, truth)}).modelError =
        2 * (1 - std::cos(kPi / (2 * stacks))) + kFacetError;
  };
  addSphere("8 sphere r h/2", 0.25, up);
  addSphere("8 sphere tilted by 30", 0.2165063509, {0.5f, 0, std::sqrt(0.75f)});
}

// 9 and 10: polygons in general position; the irradiance vector, by facets that see all of it.
void AddPolygons(Table* table) {
  const Polygon t1{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, above{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
  const Polygon t3{{.2f, .1f, 1}, {.5f, 1.3f, 1.4f}, {1.5f, .3f, .8f}};
  const Polygon pentagon{{0, 0, 0}, {2, 0, 0}, {2.5f, 1, 0}, {1, 2, 0}, {-.5f, 1, 0}};
  AddFormFactor(table, "9 triangles parallel", 0.1150492281496, t1, above);
  AddFormFactor(table, "9 triangles aslant", 0.12127981201, t1, t3);
  AddFormFactor(table, "9 pentagon and triangle", 0.0891642743, pentagon, t3);

  AddPoint(table, "10 square x", 0.0557341970, Ceiling(1), {0, 0, 0}, {1, 0, 0});
  AddPoint(table, "10 square y", 0.0557341970, Ceiling(1), {0, 0, 0}, {0, 1, 0});
  AddPoint(table, "10 square z", 0.1385316060, Ceiling(1), {0, 0, 0}, {0, 0, 1});
  const double x = 0.0479419798, y = 0.0203313635, z = 0.1285844918;
  AddPoint(table, "10 triangle z", z, t3, {.3f, .3f, 0}, {0, 0, 1});
  AddPoint(table, "10 triangle x z", 0.6 * x + 0.8 * z, t3, {.3f, .3f, 0}, {.6f, 0, .8f});
  AddPoint(table, "10 triangle y z", 0.6 * y + 0.8 * z, t3, {.3f, .3f, 0}, {0, .6f, .8f});
}

// 11: occlusion.
void AddBlockers(Table* table) {
  const auto add = [&](const std::string& name, double truth, float corner) {
    AddFormFactor(table, name, truth, Floor(0), Ceiling(1), Floor(0.5f, 0.5f, 0.5f, corner, corner))
        .needs |= kVisibility;
  };
  add("11 blocker in the corner", 0.1498686718, 0);
  add("11 blocker in the middle", 0.0995062946, 0.25f);
  AddFormFactor(table, "11 square to the blocker", 0.1038133209, Floor(0),
                Ceiling(0.5f, 0.5f, 0.5f));
}

/// Solvers refine all of an even scene alike, at great length.
constexpr double kEvenRequest = 0.1;

/// Delivered light is for the smooth normal of a point, the truth for the facet's: tilted by the
/// angle t it loses (1 - cos t) / 2 of an even hemisphere. t is at most half a facet's diagonal.
double BowlSmoothError(double angle) {
  const double along = angle / kBowlRings, around = 2 * kPi / kBowlSectors;
  return (1 - std::cos(std::hypot(along, around) / 2)) / 2;
}

void AddBowl(Table* table, const std::string& name, double truth, double self, double rho,
             double exitance) {
  const auto scene = [=] { return Bowl(self, float(rho), float(exitance)); };
  AccuracyCase& added = Add(table, name, scene, {Asked("B", Kind::MeanRadiosity, truth)});
  added.smoothError = BowlSmoothError(std::acos(1 - 2 * self));
  added.request = kEvenRequest;
}

// 12 to 14: scenes in which light is the same everywhere.
void AddEvenScenes(Table* table) {
  for (const double rho : {0.5, 0.8, 0.95}) {
    const auto scene = [=] { return FurnaceCube(float(rho)); };
    Add(table, "12 furnace " + Digits(rho, 4), scene,
        {Asked("B", Kind::MeanRadiosity, 1 / (1 - rho))})
        .request = kEvenRequest;
    if (rho > 0.9) table->back().needs = kLongBounces;
  }
  AccuracyCase& withBox =
      Add(table, "12 furnace with a box 0.80", [] { return FurnaceWithBox(0.8f); },
          {Asked("B", Kind::MeanRadiosity, 5)});
  withBox.needs = kVisibility | kLongBounces, withBox.request = kEvenRequest;

  for (const auto& [rho, port, truth] :
       {std::tuple(.98, .05, 14.2028985507), std::tuple(.9, .02, 7.6271186441)}) {
    AddBowl(table, "13 integrating sphere " + Digits(rho, 4), truth, 1 - port, rho, rho);
    table->back().needs = kLongBounces;
  }
  for (const auto& [degrees, truth] :
       {std::pair(40, 1.0621223569), std::pair(60, 1.1428571429), std::pair(80, 1.2603791523)}) {
    const double self = (1 - std::cos(degrees * kPi / 180)) / 2;
    AddBowl(table, "14 bowl of " + std::to_string(degrees) + " degrees", truth, self, 0.5, 1);
  }
}

/// A cube of which one face emits 1 and all reflect `rho`.
Scene CubeOfOneLamp(float rho) {
  Scene scene;
  BoxMaterials materials(rho);
  materials.emittance[kFloor] = Spectrum(1.f);
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, materials, true);
  CompleteTables(&scene);
  return scene;
}

// 15: a system of six values.
void AddCubes(Table* table) {
  for (const auto& [rho, lamp, opposite, side] :
       {std::tuple(.5f, 1.0909090981, .1817458261, .1818362689),
        std::tuple(.8f, 1.5517241536, .6895510707, .6896811939)}) {
    const auto scene = [rho = rho] { return CubeOfOneLamp(rho); };
    Add(table, "15 cube of six values " + Digits(double(rho), 3), scene,
        {Asked("lamp", Kind::MeanRadiosity, lamp, kFloor),
         Asked("opposite", Kind::MeanRadiosity, opposite, kCeiling),
         Asked("side", Kind::MeanRadiosity, side, kMinusX)})
        .needs = kOneValueASurface;
  }
}

// 16 and 17: rooms.
void AddRooms(Table* table) {
  std::vector<Quantity> asked;
  const auto at = [&](const std::string& label, const Vec3f& position, const Vec3f& normal,
                      double truth, double lastDigit) {
    asked.push_back(Asked(label, Kind::At, truth));
    asked.back().position = position, asked.back().normal = normal;
    asked.back().lastDigit = lastDigit;
  };
  const Vec3f up(0, 0, 1), east(1, 0, 0);
  at("floor centre", {.5f, .5f, 0}, up, 0.35828, 5e-6);
  at("floor (.25, .25)", {.25f, .25f, 0}, up, 0.32181, 5e-6);
  at("floor (.05, .05)", {.05f, .05f, 0}, up, 0.2463, 5e-5);
  at("wall centre", {0, .5f, .5f}, east, 0.32242, 5e-6);
  at("wall z = .75", {0, .5f, .75f}, east, 0.4387, 5e-5);
  asked.push_back(Asked("mean B floor", Kind::MeanRadiosity, 0.15517, kFloor));
  asked.back().lastDigit = 5e-6;
  asked.push_back(Asked("mean B wall", Kind::MeanRadiosity, 0.16400, kMinusX));
  asked.back().lastDigit = 5e-6;
  Add(
      table, "16 room under a black ceiling", [] { return BoxRoom(1, 0.5f, 1); }, asked)
      .needs = kVaryingLight | kVariesOverFaces;

  // CIE 171:2006, case 5.8: validated against, no more. Direct light is 10,000 lm / 96 m2.
  for (const auto& [rho, truth] :
       {std::pair(.1f, 11.5741), std::pair(.3f, 44.6429), std::pair(.5f, 104.1667),
        std::pair(.8f, 416.6667), std::pair(.95f, 1979.1667)}) {
    Quantity q = Asked("indirect lx", Kind::MeanIrradiance, truth);
    q.scale = kLumensPerWatt, q.offset = -10000.0 / 96, q.lastDigit = 5e-5;
    const auto scene = [rho = rho] { return LampInCube(rho); };
    Add(table, "17 CIE 171 5.8 " + Digits(double(rho), 4), scene, {q}).needs =
        kVaryingLight | kVariesOverFaces | kPointLight;
  }
}

}  // namespace

const std::vector<AccuracyCase>& AccuracyCases() {
  static const Table table = [] {
    Table t;
    AddRectangles(&t);
    AddDiscsAndPoints(&t);
    AddPolygons(&t);
    AddBlockers(&t);
    AddEvenScenes(&t);
    AddCubes(&t);
    AddRooms(&t);
    return t;
  }();
  return table;
}

}  // namespace lambert::testing
