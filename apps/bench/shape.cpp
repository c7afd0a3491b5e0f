#include "apps/bench/shape.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>

#include "core/cpu/render_tiles.h"

namespace copeel::bench {
namespace {

using Value = std::uint64_t (*)(const Groups&);

std::uint64_t depthsOf(const Groups& groups) { return groups.size(); }
std::uint64_t fragmentsOf(const Groups& groups) { return std::accumulate(groups.begin(), groups.end(), std::uint64_t{0}); }
std::uint64_t largestOf(const Groups& groups) { return groups.empty() ? 0 : *std::max_element(groups.begin(), groups.end()); }

// Σ ⌈C(Z) / 2⌉
std::uint64_t pairsOf(const Groups& groups) {
  std::uint64_t sum = 0;
  for (const std::uint32_t c : groups) sum += (c + 1) / 2;
  return sum;
}

// Σ (1 + ⌊C(Z) / 2⌋)
std::uint64_t hybridOf(const Groups& groups) {
  std::uint64_t sum = 0;
  for (const std::uint32_t c : groups) sum += 1 + c / 2;
  return sum;
}

constexpr std::array<Value, 4> kMeasures = {depthsOf, fragmentsOf, pairsOf, hybridOf};

void keep(std::vector<Groups>& fullest, const Groups& groups) {
  fullest.resize(kMeasures.size());
  for (std::size_t i = 0; i < kMeasures.size(); ++i) {
    if (kMeasures[i](groups) > kMeasures[i](fullest[i])) fullest[i] = groups;
  }
}

// A fold that keeps the sizes of a pixel's groups.
class ShapeFold {
 public:
  ShapeFold(Shape& shape, std::mutex& mutex) : shape_(shape), mutex_(mutex) {}

  bool beginTile(cpu::Tile&) const { return true; }
  double narrowTile(cpu::Tile&) const { return std::numeric_limits<double>::infinity(); }
  bool mayShow(std::span<const cpu::DepthRange>) const { return true; }
  cpu::DepthRange window(const PixelStack&) const { return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}; }
  bool needsWholeStack() const { return false; }
  double leastFragments() const { return std::numeric_limits<double>::infinity(); }
  void beginPixel(const PixelStack&) {
    groups_.clear();
    open_ = 0;
  }
  void fragment(std::uint32_t) { ++open_; }
  bool closeGroup() {
    groups_.push_back(open_);
    open_ = 0;
    return false;
  }
  void endPixels(const PixelRect& rect) {
    if (groups_.empty()) return;
    const auto pixels = static_cast<std::uint64_t>(rect.width) * rect.height;
    const std::scoped_lock lock(mutex_);
    shape_.coveredPixels += pixels;
    shape_.coplanarPixels += largestOf(groups_) > 1 ? pixels : 0;
    shape_.depths += pixels * groups_.size();
    shape_.fragments += pixels * fragmentsOf(groups_);
    keep(shape_.fullest, groups_);
  }

 private:
  Shape& shape_;
  std::mutex& mutex_;
  Groups groups_;
  std::uint32_t open_ = 0;
};

enum class Passes { One, Two, Four, D, TwoD, HalfD, TwoHalfD, TwoN, TwoPairs, ThreePairs, Pairs, Hybrid, DOverK };
enum class Rh { All, Depths, Groups, K, Nearest, Unknown };

struct Formulas {
  Passes passes;
  Rh rh;
  int pixelBytes, pixelBytesPerK;   // negative: not per pixel alone
};

// As the registry (core/methods/registry.cpp) states them.
const std::map<std::string_view, Formulas>& formulas() {
  static const std::map<std::string_view, Formulas> all = {
      {"tile", {Passes::One, Rh::All, -1, 0}},
      {"zbuffer", {Passes::One, Rh::Nearest, -1, 0}},
      {"auto", {Passes::One, Rh::All, -1, 0}},
      {"f2b", {Passes::D, Rh::Depths, 12, 0}},
      {"f2b2", {Passes::TwoD, Rh::Depths, 12, 0}},
      {"f2b-zf", {Passes::TwoN, Rh::All, 28, 0}},
      {"f2b-kb-zf", {Passes::TwoD, Rh::Groups, 8, 4}},
      {"f2b-2p", {Passes::TwoPairs, Rh::All, 28, 0}},
      {"f2b-3p", {Passes::ThreePairs, Rh::All, 36, 0}},
      {"f2b-ll", {Passes::TwoD, Rh::All, -1, 0}},
      {"f2b-fab", {Passes::TwoD, Rh::Groups, 12, 4}},
      {"f2b-kb", {Passes::TwoD, Rh::Groups, 8, 4}},
      {"hybrid", {Passes::Hybrid, Rh::All, 28, 0}},
      {"dual", {Passes::HalfD, Rh::Depths, 24, 0}},
      {"dual-2p", {Passes::Pairs, Rh::All, 56, 0}},
      {"dual-ll", {Passes::TwoHalfD, Rh::All, -1, 0}},
      {"dual-fab", {Passes::TwoHalfD, Rh::Groups, 24, 8}},
      {"dual-kb", {Passes::TwoHalfD, Rh::Groups, 16, 8}},
      {"fab", {Passes::One, Rh::All, -1, 0}},
      {"ll", {Passes::One, Rh::All, -1, 0}},
      {"sb", {Passes::Two, Rh::All, -1, 0}},
      {"kb", {Passes::One, Rh::K, 8, 8}},
      {"k-plus", {Passes::One, Rh::K, 8, 8}},
      {"bun-ll", {Passes::One, Rh::All, -1, 0}},
      {"srab", {Passes::One, Rh::K, 4, 8}},
      {"multi-kb", {Passes::DOverK, Rh::Depths, 4, 8}},
      {"bun", {Passes::Two, Rh::Depths, 0, 16}},
      {"bad", {Passes::Four, Rh::Depths, 40, 16}},
  };
  return all;
}

// Of methods that are not one of these: once over everything, nothing lost.
Formulas formulasOf(std::string_view method) {
  const auto found = formulas().find(method);
  return found == formulas().end() ? Formulas{Passes::One, Rh::Unknown, -1, 0} : found->second;
}

}  // namespace

std::uint64_t Shape::most(Value value) const {
  std::uint64_t most = 0;
  for (const Groups& groups : fullest) most = std::max(most, value(groups));
  return most;
}

Shape shapeOf(const std::vector<oit::Part>& parts, const View& view, int threads) {
  std::vector<Object> objects;
  for (const oit::Part& part : parts) objects.push_back({part.mesh, part.worldFromObject});
  Shape shape;
  shape.pixels = static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height);
  std::mutex mutex;
  Threads(threads).execute([&] {
    const Scene scene(std::move(objects));
    const PlaneClasses planes(scene, 0);
    const cpu::Frame frame(scene, planes, view);
    cpu::renderTiles(frame, {}, [&] { return ShapeFold(shape, mutex); });
  });
  return shape;
}

double expectedPasses(std::string_view method, const Shape& shape, std::uint32_t k) {
  const std::uint64_t d = shape.most(depthsOf), n = shape.most(fragmentsOf), pairs = shape.most(pairsOf);
  switch (formulasOf(method).passes) {
    case Passes::One: return 1;
    case Passes::Two: return 2;
    case Passes::Four: return 4;
    case Passes::D: return double(d + 1);
    case Passes::TwoD: return double(2 * d + 1);
    case Passes::HalfD: return double((d + 1) / 2 + 1);
    case Passes::TwoHalfD: return double(2 * ((d + 1) / 2) + 1);
    case Passes::TwoN: return double(2 * n + 1);
    case Passes::TwoPairs: return double(2 * pairs + 1);
    case Passes::ThreePairs: return double(3 * pairs + 1);
    case Passes::Pairs: return double(pairs + 1);
    case Passes::Hybrid: return double(shape.most(hybridOf) + 1);
    case Passes::DOverK: return double(2 * ((d + k - 1) / k) + 1);
  }
  return 1;
}

double expectedBytes(std::string_view method, const Shape& shape, std::uint32_t k) {
  const double pixels = double(shape.pixels), fragments = double(shape.fragments), n = double(shape.most(fragmentsOf));
  if (method == "fab") return pixels * (4 + 8 * std::max(double(k), n));
  if (method == "ll") return 4 * pixels + 12 * std::max(4 * pixels, fragments) + 68;
  if (method == "sb") return 8 * pixels + 8 * fragments + 260;
  const double layer = double(shape.most(largestOf)) * double(shape.coveredPixels);
  if (method == "f2b-ll") return 12 * pixels + 8 * std::max(pixels, layer);
  if (method == "dual-ll") return 24 * pixels + 8 * std::max(pixels, 2 * layer);
  const Formulas f = formulasOf(method);
  return f.pixelBytes < 0 ? -1 : pixels * (f.pixelBytes + double(f.pixelBytesPerK) * k);
}

double expectedRh(std::string_view method, const Shape& shape, std::uint32_t k) {
  if (shape.fullest.empty()) return 1;
  const Groups& groups = shape.fullest.front();
  const double n = double(fragmentsOf(groups));
  double kept = 0;
  for (const std::uint32_t c : groups) kept += std::min(c, k);
  switch (formulasOf(method).rh) {
    case Rh::All: return 1;
    case Rh::Depths: return double(groups.size()) / n;
    case Rh::Groups: return kept / n;
    case Rh::K: return std::min(double(k), n) / n;
    case Rh::Nearest: return 1 / n;
    case Rh::Unknown: break;
  }
  return -1;
}

}  // namespace copeel::bench
