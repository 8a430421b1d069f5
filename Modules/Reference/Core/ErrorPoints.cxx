#include "Reference/Core/ErrorPoints.h"

#include <algorithm>

#include "Common/Core/Random.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "Scene/Core/DoubledFaces.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {

namespace {

using Place = ErrorPoints::Place;

/// Paths that find out whether a side that the solution leaves out is dark. A point that all of
/// them find black gets at most a few hundredths of its light by ways that they can miss.
constexpr int kDarknessSamples = 64;

/// Places stratified by area over both sides of every face that receives: all fronts, then all
/// backs. Faces that emit do not count, but where there are no others (a furnace); nor do sides
/// that lie under doubled faces.
std::vector<Place> StratifiedPlaces(const TriangleMesh& mesh, const SolutionErrorOptions& options) {
  const int64_t count = mesh.FaceCount();
  const std::vector<bool> receives = ReceivingFaces(mesh);
  const DoubledFaces doubled(mesh);
  std::vector<double> upTo(size_t(count), 0);
  double total = 0;
  for (int64_t face = 0; face < count; ++face) {
    if (receives[size_t(face)]) total += mesh.Area(face);
    upTo[size_t(face)] = total;
  }
  std::vector<Place> places;
  if (!(total > 0)) return places;
  for (int i = 0; i < options.points; ++i) {
    Random random(HashBits(options.seed, uint64_t(i)));
    const double target = 2 * total * (i + random.UniformDouble()) / options.points;
    const Side side = target < total ? kFront : kBack;
    const auto found =
        std::upper_bound(upTo.begin(), upTo.end(), side == kFront ? target : target - total);
    if (found == upTo.end()) continue;
    const int32_t face = int32_t(found - upTo.begin());
    if (doubled.IsHidden(face, side)) continue;
    const float u = random.Uniform(), v = random.Uniform();
    places.push_back({face, side, ReceiverAt(mesh, face, side, UniformTriangle(u, v))});
  }
  return places;
}

std::vector<ReceiverPoint> Receivers(const std::vector<Place>& places) {
  std::vector<ReceiverPoint> receivers;
  receivers.reserve(places.size());
  for (const Place& place : places) receivers.push_back(place.receiver);
  return receivers;
}

/// Leaves out, at little cost, the places that are dark in the solution and in a few paths.
std::vector<Place> WithoutDarkPlaces(const std::vector<Place>& places, const SolutionLookup& lookup,
                                     const PathTracedIrradiance& tracer,
                                     const SolutionErrorOptions& options) {
  std::vector<Place> kept, doubtful;
  for (const Place& place : places) {
    (lookup.Models(place.face, place.side) ? kept : doubtful).push_back(place);
  }
  PathTracedIrradianceOptions few;
  few.samples = std::min(kDarknessSamples, options.samples);
  few.seed = HashBits(options.seed, 0x6461726bull);
  const auto light = tracer.Estimate(Receivers(doubtful), few);
  for (size_t i = 0; i < doubtful.size(); ++i) {
    if (!light[i].irradiance.IsBlack()) kept.push_back(doubtful[i]);
  }
  return kept;
}

}  // namespace

// Places that may receive light, and the truth there; a side that the solution leaves out counts
// where light is sure.
void ErrorPoints::Draw(const SolutionLookup& lookup, const ProgressCallback& progress) {
  const PathTracedIrradiance tracer(scene_);
  const std::vector<Place> all = StratifiedPlaces(scene_.mesh, draw_);
  const std::vector<Place> places = WithoutDarkPlaces(all, lookup, tracer, draw_);
  PathTracedIrradianceOptions trace;
  trace.samples = draw_.samples;
  trace.seed = draw_.seed;
  const auto truth = tracer.Estimate(Receivers(places), trace, progress);
  drawn_ += int64_t(all.size());
  for (size_t i = 0; i < places.size(); ++i) {
    const double noise = SquaredNorm(truth[i].standardError);
    const bool isSure = SquaredNorm(truth[i].irradiance) > 4 * noise;
    if (!isSure && !lookup.Models(places[i].face, places[i].side)) continue;
    places_.push_back(places[i]);
    truth_.push_back(truth[i]);
  }
  ++batches_;
}

SolutionError ErrorPoints::Compare(const SolutionLookup& lookup) {
  delivered_.resize(places_.size());
  int64_t missed = 0;
  for (size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    missed += lookup.Models(place.face, place.side) ? 0 : 1;
    delivered_[i] = lookup.Irradiance(lookup.Find(place.face, place.side, place.receiver.position));
  }
  SolutionError error = SummarizeError(delivered_, truth_, options_.seed);
  error.darkPoints = drawn_ - error.points;
  error.missedPoints = missed;
  return error;
}

// More paths a point where their noise is more than the error, else as many points again where few
// of them decide; false where neither would help, or there are as many as there may be.
bool ErrorPoints::Grow(const SolutionError& error, int growth) {
  const int64_t mostPaths = int64_t(growth) * options_.points * options_.samples;
  draw_.seed = HashBits(options_.seed, batches_);
  if (error.noise > error.Counting() && 4 * draw_.samples * drawn_ <= mostPaths) {
    draw_.samples *= 4;
    draw_.points = int(drawn_);
    places_.clear(), truth_.clear();
    drawn_ = 0;
    return true;
  }
  draw_.points = int(drawn_);
  return !error.IsRmsSure() && 2 * draw_.samples * drawn_ <= mostPaths;
}

SolutionError ErrorPoints::Measure(const RadiositySolution& solution, int growth,
                                   const Judge& isEnough, const ProgressCallback& progress) {
  const SolutionLookup lookup(solution, scene_.mesh.FaceCount());
  double done = 0;
  const ProgressCallback half = [&](double fraction, const char* stage) {
    return Report(progress, done + (1 - done) / 2 * fraction, stage);
  };
  if (batches_ == 0) this->Draw(lookup, half);
  SolutionError error = this->Compare(lookup);
  while (!(isEnough && isEnough(error)) && this->Grow(error, growth)) {
    done += (1 - done) / 2;
    this->Draw(lookup, half);
    error = this->Compare(lookup);
  }
  return error;
}

}  // namespace lambert
