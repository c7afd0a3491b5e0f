#include "apps/bench/table_2011.h"

#include <array>
#include <iterator>

#include <fmt/format.h>

#include "apps/bench/deadline.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

constexpr std::array<std::size_t, 4> kCopies = {1, 4, 8, 12};
constexpr std::uint32_t kBufferLength = 8;
constexpr unsigned kShells = 4, kColumns = 16, kRows = 10;   // of 8 layers, 1,264 triangles: 193 passes over 12 copies take long on a software device

struct Paper {
  const char* method;
  std::array<std::uint64_t, 4> peeled;
  std::array<double, 4> accuracy;
  std::array<std::uint64_t, 4> passes;
};

constexpr Paper kPaper[] = {
    {"f2b", {8, 8, 8, 8}, {100, 25, 12.5, 8.3}, {8, 8, 8, 8}},
    {"f2b-zf", {8, 32, 64, 96}, {100, 100, 100, 100}, {17, 65, 129, 193}},
    {"f2b-kb-zf", {8, 32, 64, 64}, {100, 100, 100, 66.6}, {16, 16, 16, 16}},
};

BenchScene sceneOf(const Options2011& options, std::size_t copyCount) {
  if (options.mesh.empty()) return copies(shells(kShells, kColumns, kRows), copyCount, "shells");
  BenchScene scene = bench::sceneOf(options.mesh, copyCount);
  scene.camera = options.camera;
  return scene;
}

}  // namespace

std::vector<Row2011> table2011(const Options2011& options) {
  const Deadline deadline(options.budgetMs);
  MeasureOptions measure;
  measure.frames = options.frames;
  for (const Paper& paper : kPaper) append(measure.methods, runsOf("gl", paper.method, kBufferLength));
  std::vector<Row2011> rows(kCopies.size() * std::size(kPaper));
  for (std::size_t c = 0; c < kCopies.size(); ++c) {
    measure.budgetMs = deadline.leftMs();
    const std::vector<Entry> entries = measureScene(sceneOf(options, kCopies[c]), options.width, options.height, measure);
    for (std::size_t m = 0; m < entries.size(); ++m) {
      const Entry& entry = entries[m];
      if (!entry.failure.empty()) throw Error(ExitCode::Machine, entry.failure);
      rows[m * kCopies.size() + c] = {entry.method, kCopies[c], entry.stats.capturedMax, kPaper[m].peeled[c], 100 * entry.stats.rh(), kPaper[m].accuracy[c],
                                      entry.stats.passes, kPaper[m].passes[c], entry.minMs, entry.leftOut};
    }
  }
  return rows;
}

std::string toText(const std::vector<Row2011>& rows) {
  std::string text = fmt::format("{:<10} {:>6}  {:>6} {:>6}  {:>10} {:>6}  {:>6} {:>6}  {:>8}\n", "method", "copies", "peeled", "paper", "accuracy %", "paper",
                                 "passes", "paper", "ms");
  for (const Row2011& row : rows) {
    text += fmt::format("{:<10} {:>6}  ", row.method, row.copies);
    if (!row.leftOut.empty()) text += row.leftOut + "\n";
    else text += fmt::format("{:>6} {:>6}  {:>10.1f} {:>6.1f}  {:>6} {:>6}  {:>8.1f}\n", row.peeled, row.paperPeeled, row.accuracy, row.paperAccuracy, row.passes, row.paperPasses, row.ms);
  }
  return text + kLegend2011 + "\n";
}

}  // namespace copeel::bench
