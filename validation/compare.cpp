#include "validation/compare.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace copeel::validation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kSampleCount = 8;
constexpr double kFloatRounding = 0x1p-22;      // of a depth, relative: two roundings of a float32
constexpr double kToleranceShare = 1e-9;        // of the diagonal, along the normal: ten times the declared tolerance

// Whether what `other` saw on `ray` is not the plane that `centre` is on.
bool differs(const Oracle& oracle, const Ray& ray, const std::optional<Seen>& centre, const std::optional<Seen>& other) {
  if (centre.has_value() != other.has_value()) return true;
  if (!centre) return false;
  const double expected = oracle.caster().planeDepth(ray, centre->triangle);
  return !(std::abs(expected - other->depth) <= allowedError(oracle, ray, *other));
}

bool isEdgePixel(const Oracle& oracle, const RayCaster& leaves, int x, int y, const std::optional<Seen>& centre) {
  if (leaves.nearEdge(leaves.rayOf(x, y), kSubPixelStep)) return true;
  if (oracle.caster().nearEdge(oracle.caster().rayOf(x, y), kSubPixelStep)) return true;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Ray ray = oracle.caster().rayOf(x, y, dx * kSubPixelStep, dy * kSubPixelStep);
      const std::optional<Seen> seen = oracle.see(ray);
      if (differs(oracle, ray, centre, seen) || (seen && seen->leaf != centre->leaf)) return true;
    }
  }
  return false;
}

// What the oracle sees at every pixel.
std::vector<std::optional<Seen>> seeAll(const Oracle& oracle) {
  const View& view = oracle.caster().view();
  std::vector<std::optional<Seen>> seen;
  seen.reserve(static_cast<std::size_t>(view.width) * view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) seen.push_back(oracle.see(oracle.caster().rayOf(x, y)));
  return seen;
}

std::uint64_t countTouched(const Oracle& oracle, const std::vector<std::optional<Seen>>& seen) {
  const View& view = oracle.caster().view();
  std::uint64_t count = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::size_t here = static_cast<std::size_t>(y) * view.width + x;
      const bool right = x + 1 < view.width && differs(oracle, oracle.caster().rayOf(x + 1, y), seen[here], seen[here + 1]);
      const bool below = y + 1 < view.height && differs(oracle, oracle.caster().rayOf(x, y + 1), seen[here], seen[here + view.width]);
      count += right || below;
    }
  }
  return count;
}

}  // namespace

double allowedError(const Oracle& oracle, const Ray& ray, const Seen& expected) {
  const double cosine = std::max(oracle.caster().cosine(ray, expected.triangle), 1e-12);
  return kFloatRounding * std::abs(expected.depth) + kToleranceShare * oracle.diagonal() / cosine;
}

void Comparison::add(const Comparison& other) {
  pixels += other.pixels;
  covered += other.covered;
  touched += other.touched;
  wrongOffEdge += other.wrongOffEdge;
  wrongEdge += other.wrongEdge;
  wrongLeafOffEdge += other.wrongLeafOffEdge;
  greatestError = std::max(greatestError, other.greatestError);
  for (const WrongPixel& w : other.samples)
    if (samples.size() < kSampleCount) samples.push_back(w);
}

std::string Comparison::summary() const {
  std::string text = fmt::format("{} pixels, {} covered, {} touched; wrong: {} off edges, {} on edges, {} leaves; greatest error of the right ones {:.2g}",
                                 pixels, covered, touched, wrongOffEdge, wrongEdge, wrongLeafOffEdge, greatestError);
  for (const WrongPixel& w : samples)
    text += fmt::format("\n  ({}, {}){} depth {:.9g} leaf {}, expected {:.9g} leaf {}", w.x, w.y, w.edge ? " on an edge" : "", w.depth, w.leaf,
                        w.expected, w.expectedLeaf);
  return text;
}

Comparison compareDepth(const Image<float>& depth, const Oracle& oracle, const RayCaster& leaves, const Image<std::uint16_t>* ids) {
  const View& view = oracle.caster().view();
  const std::vector<std::optional<Seen>> truth = seeAll(oracle);
  Comparison result;
  result.pixels = truth.size();
  result.touched = countTouched(oracle, truth);
  // An image of another size is wrong everywhere.
  if (depth.width != view.width || depth.height != view.height) {
    result.wrongOffEdge = result.pixels;
    return result;
  }

  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::optional<Seen>& expected = truth[static_cast<std::size_t>(y) * view.width + x];
      const double d = depth.at(x, y), e = expected ? expected->depth : kInfinity;
      result.covered += expected.has_value();
      const Ray ray = oracle.caster().rayOf(x, y);
      const bool depthRight = expected ? std::abs(d - e) <= allowedError(oracle, ray, *expected) : d == kInfinity;
      const int leaf = ids ? int(ids->at(x, y)) - 1 : -1, expectedLeaf = ids && expected ? int(expected->leaf) : -1;
      if (depthRight && expected) result.greatestError = std::max(result.greatestError, std::abs(d - e));
      if (depthRight && leaf == expectedLeaf) continue;

      // Only now, for the few, is it asked whether the pixel lies on an edge.
      const bool edge = isEdgePixel(oracle, leaves, x, y, expected);
      if (edge) ++result.wrongEdge;
      else if (depthRight) ++result.wrongLeafOffEdge;
      else ++result.wrongOffEdge;
      if (result.samples.size() < kSampleCount && !edge) result.samples.push_back({x, y, d, e, leaf, expectedLeaf, edge});
    }
  }
  return result;
}

Image<float> depthImage(const Oracle& oracle) {
  const View& view = oracle.caster().view();
  Image<float> image(view.width, view.height, float(kInfinity));
  const std::vector<std::optional<Seen>> seen = seeAll(oracle);
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i]) image.pixels[i] = float(seen[i]->depth);
  return image;
}

Comparison compareOracles(const Oracle& tested, const Oracle& truth, const RayCaster& leaves) {
  return compareDepth(depthImage(tested), truth, leaves);
}

}  // namespace copeel::validation
