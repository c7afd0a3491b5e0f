#include "bench/results.h"

#include <algorithm>

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace copeel::bench {
namespace {

using Json = nlohmann::ordered_json;

// The limits, from the project's goals.
constexpr double kMostRatio = 2;                    // CSG frame to plain z-buffer
constexpr double kMostBytesPerTriangle = 150;
constexpr double kProgramBytes = 64e6;
constexpr double kImageBytes = 3.0 * kWidthPx * kHeightPx;
constexpr double kLeastSpeedup = 5;                 // over openscad's preview
constexpr double kMostPlateFrameMs = 25, kMostPlateProcessMs = 150, kMostBracketProcessMs = 40;

std::string sightName(Sight sight) { return sight == Sight::Open ? "all seen" : "in a closed box"; }

std::string wallOf(const ProcessMeasurement& process) {
  return process.note.empty() ? number(process.wall.minMs) : fmt::format("{} ({})", number(process.wall.minMs), process.note);
}

std::string ratioOf(double ratio) { return ratio > 0 ? fmt::format("{:.2f}", ratio) : ""; }
std::string timesOver(double speedup) { return speedup > 0 ? fmt::format("{:.1f} ×", speedup) : ""; }
std::string pairOf(const Times& times) { return number(times.minMs) + " / " + number(times.medianMs); }
std::string megabytes(std::uint64_t bytes) { return bytes ? fmt::format("{:.0f}", static_cast<double>(bytes) / 1e6) : ""; }

Table frameTable(const Results& results) {
  Table table;
  table.wordColumns = 2;
  table.head = {"rung", "model", "triangles", "fragments", "z-buffer", "CSG", "ratio", "prepare", "load"};
  for (const RungResult& r : results.rungs) {
    const FrameMeasurement& f = r.frames;
    table.rows.push_back({r.rung.name, r.rung.title, count(f.triangles), count(f.fragments), pairOf(f.zbuffer), pairOf(f.csg),
                          ratioOf(f.ratio()), number(f.prepare.minMs), number(f.load.minMs)});
  }
  return table;
}

Table processTable(const Results& results) {
  Table table;
  table.head = {"rung", "copeel .csg", "copeel .scad", "openscad preview .scad", "faster", "peak MB", "bytes/triangle"};
  for (const RungResult& r : results.rungs) {
    const WholeProcesses& p = r.processes;
    table.rows.push_back({r.rung.name, wallOf(p.fromCsg), wallOf(p.fromScad), wallOf(p.openscad), timesOver(p.scadSpeedup()),
                          megabytes(p.fromCsg.peakBytes), fmt::format("{:.0f}", bytesPerTriangle(p.fromCsg, r.frames))});
  }
  return table;
}

Table scalingTable(const Results& results) {
  Table table;
  table.wordColumns = 1;
  table.head = {"plate", "holes", "triangles", "fragments met", "z-buffer", "CSG", "ratio", "prepare", "load", "process", "peak MB", "bytes/triangle"};
  for (const ScalingResult& s : results.scaling) {
    const FrameMeasurement& f = s.frames;
    table.rows.push_back({sightName(s.sight), count(static_cast<std::uint64_t>(s.holes)), count(f.triangles), count(f.fragments),
                          number(f.zbuffer.minMs), number(f.csg.minMs), ratioOf(f.ratio()), number(f.prepare.minMs), number(f.load.minMs),
                          wallOf(s.process), megabytes(s.process.peakBytes), fmt::format("{:.0f}", bytesPerTriangle(s.process, f))});
  }
  return table;
}

std::string machineLine(const Results& results) {
  const Machine& m = results.machine;
  return fmt::format("{}, {} cores, {} threads used, {}, {:.0f} GB of memory, {}, {}×{} pixels, load before the run {:.1f}", m.processor, m.cores,
                     results.threads, m.simd, static_cast<double>(m.memoryBytes) / 1e9, m.compiler, kWidthPx, kHeightPx, m.load);
}

std::string lineOf(const Check& check) {
  return fmt::format("{}: {} {:.3g}, to be {} {:.3g}", check.subject, check.what, check.value, check.atLeast ? "at least" : "at most", check.limit);
}

// "42 of 45 limits hold." and the others, each as an item.
std::string checkLines(const Results& results) {
  const std::vector<Check> all = checks(results);
  const auto met = std::count_if(all.begin(), all.end(), [](const Check& check) { return check.met(); });
  std::string text = fmt::format("{} of {} limits hold.\n", met, all.size());
  for (const Check& check : all) {
    if (!check.met()) text += fmt::format("- {}\n", lineOf(check));
  }
  if (!results.leftOut.empty()) text += fmt::format("\nNot measured: {}.\n", fmt::join(results.leftOut, ", "));
  return text;
}

void checkProcess(std::vector<Check>& all, const std::string& subject, const ProcessMeasurement& process, const FrameMeasurement& frames) {
  if (process.measured()) all.push_back({subject, "bytes per triangle", bytesPerTriangle(process, frames), kMostBytesPerTriangle});
}

Json json(const Times& times) { return {{"min", times.minMs}, {"median", times.medianMs}}; }

Json json(const ProcessMeasurement& process) {
  Json json{{"wall_ms", bench::json(process.wall)}, {"peak_bytes", process.peakBytes}};
  if (!process.note.empty()) json["note"] = process.note;
  return json;
}

Json json(const RungResult& r) {
  Json json{{"name", r.rung.name}, {"title", r.rung.title}};
  json.update(Json::parse(toJson(r.frames)));
  json["ratio"] = r.frames.ratio();
  json["process"] = {{"copeel_csg", bench::json(r.processes.fromCsg)}, {"copeel_scad", bench::json(r.processes.fromScad)}};
  if (r.processes.openscad.measured()) json["process"]["openscad_preview"] = bench::json(r.processes.openscad);
  json["bytes_per_triangle"] = bytesPerTriangle(r.processes.fromCsg, r.frames);
  return json;
}

Json json(const ScalingResult& s) {
  Json json{{"holes", s.holes}, {"seen", s.sight == Sight::Open}};
  json.update(Json::parse(toJson(s.frames)));
  json["ratio"] = s.frames.ratio();
  json["process"] = {{"copeel_csg", bench::json(s.process)}};
  json["bytes_per_triangle"] = bytesPerTriangle(s.process, s.frames);
  return json;
}

}  // namespace

double bytesPerTriangle(const ProcessMeasurement& process, const FrameMeasurement& frames) {
  const double own = static_cast<double>(process.peakBytes) - kImageBytes - kProgramBytes;
  return frames.triangles ? std::max(own, 0.0) / static_cast<double>(frames.triangles) : 0;
}

std::vector<Check> checks(const Results& results) {
  std::vector<Check> all;
  for (const RungResult& r : results.rungs) {
    const WholeProcesses& p = r.processes;
    all.push_back({r.rung.name, "CSG frame to z-buffer frame", r.frames.ratio(), kMostRatio});
    checkProcess(all, r.rung.name, p.fromCsg, r.frames);
    // A preview that shows nothing is no yardstick.
    if (p.scadSpeedup() > 0) all.push_back({r.rung.name, "times as fast as openscad's preview", p.scadSpeedup(), kLeastSpeedup, true});
    if (r.rung.name == "c1000") all.push_back({r.rung.name, "ms of a CSG frame", r.frames.csg.minMs, kMostPlateFrameMs});
    if (r.rung.name == "c1000" && p.fromCsg.measured()) all.push_back({r.rung.name, "ms from .csg", p.fromCsg.wall.minMs, kMostPlateProcessMs});
    if (r.rung.name == "b" && p.fromCsg.measured()) all.push_back({r.rung.name, "ms from .csg", p.fromCsg.wall.minMs, kMostBracketProcessMs});
  }
  for (const ScalingResult& s : results.scaling) {
    checkProcess(all, fmt::format("{} holes, {}", count(static_cast<std::uint64_t>(s.holes)), sightName(s.sight)), s.process, s.frames);
  }
  return all;
}

std::string toText(const Results& results) {
  std::string text = machineLine(results) + "\n\nFrames, ms, minimum / median; prepare and load, minimum\n" + toText(frameTable(results));
  text += "\nWhole processes, ms, minimum\n" + toText(processTable(results));
  if (!results.scaling.empty()) text += "\nPlates with more and more holes, ms, minimum\n" + toText(scalingTable(results));
  return text + "\n" + checkLines(results);
}

std::string toJson(const Results& results) {
  const Machine& m = results.machine;
  Json text{{"machine",
             {{"processor", m.processor}, {"cores", m.cores}, {"simd", m.simd}, {"memory_bytes", m.memoryBytes}, {"compiler", m.compiler},
              {"load", m.load}}},
            {"threads", results.threads},
            {"width", kWidthPx},
            {"height", kHeightPx},
            {"rungs", Json::array()},
            {"left_out", results.leftOut},
            {"scaling", Json::array()},
            {"checks", Json::array()}};
  for (const RungResult& r : results.rungs) text["rungs"].push_back(json(r));
  for (const ScalingResult& s : results.scaling) text["scaling"].push_back(json(s));
  for (const Check& c : checks(results)) {
    text["checks"].push_back({{"subject", c.subject}, {"what", c.what}, {"value", c.value}, {"limit", c.limit}, {"met", c.met()}});
  }
  return text.dump(2) + "\n";
}

std::string toMarkdown(const Results& results) {
  std::string text = "# Benchmarks\n\nWritten by `build/release/bench/ladder --markdown docs/benchmarks.md`; not to be edited by hand.\n\n";
  text += "Measured on: " + machineLine(results) + ".\nAll times in milliseconds. What is compared ran in turns in one run.\n\n";
  text += "## Frames\n\n`z-buffer` is a plain z-buffer pass over the same leaves by the same rasterizer: what any renderer has to do before it thinks of\n"
          "Booleans. `CSG` is the right picture of the model. Each is minimum / median; `ratio` is of the minima. `prepare` is done once a model,\n"
          "`load` is reading the .csg. `fragments` counts what the CSG frame had to meet; what lies behind the visible surface it may pass over.\n\n";
  text += toMarkdown(frameTable(results));
  text += "\n## Whole processes\n\nFrom the command to the PNG on disk, minimum. openscad's preview has an X server waiting for it, started before. The\n"
          "last column is peak memory less the image and 64 MB, per triangle.\n\n";
  text += toMarkdown(processTable(results));
  if (!results.scaling.empty()) {
    text += "\n## Plates with more and more holes\n\nThe same plates twice: with every hole in sight, and inside a closed box, where nothing of them is seen.\n\n";
    text += toMarkdown(scalingTable(results));
  }
  return text + "\n## Limits\n\n" + checkLines(results);
}

}  // namespace copeel::bench
