// The report's plots, drawn by gnuplot as SVG. Each plot is a script with its numbers inside, kept beside the picture: to be changed and drawn again.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "apps/bench/report.h"
#include "apps/csg/process.h"
#include "core/error.h"
#include "core/output_file.h"

namespace copeel::bench {
namespace {

constexpr double kLeastShare = 1e-3;   // per cent of wrong pixels; what is below is drawn there, as "0"

struct Point {
  std::string method;
  bool robust = false;
  double x = 0, y = 0;
};

// gnuplot reads _, ^ and {} in names as typesetting; ours are plain.
std::string head(const std::string& title, const std::string& x, const std::string& y) {
  return fmt::format(
      "set terminal svg size 900,520 dynamic font 'sans-serif,13' background '#ffffff' noenhanced\n"
      "set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\"\nset grid lc rgb '#e0e0e0'\nset border 3\nset tics nomirror\nset key outside right noenhanced\n",
      title, x, y);
}

// Points that no other beats in both, from the fastest on.
std::vector<Point> paretoFront(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Point> front;
  for (const Point& p : points) {
    if (front.empty() || p.y < front.back().y) front.push_back(p);
  }
  return front;
}

std::string block(const std::string& name, const std::vector<Point>& points) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const Point& p : points) text += fmt::format("{} {} \"{}\"\n", p.x, p.y, p.method);
  return text + "EOD\n";
}

// A label of each point, slanting upwards; of points that lie side by side the next one's begins higher.
std::string labels(std::vector<Point> points) {
  constexpr double kCloseDecades = 0.035;
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  std::string text;
  std::map<double, std::pair<double, int>> last;   // by y: x of the last label, and how many are stacked there
  for (const Point& p : points) {
    auto [found, isNew] = last.try_emplace(p.y, -1e9, 0);
    auto& [x, stacked] = found->second;
    stacked = !isNew && std::log10(p.x) - x < kCloseDecades ? (stacked + 1) % 4 : 0;
    x = std::log10(p.x);
    text += fmt::format("set label \"{}\" at {},{} rotate by 55 offset 0.3,{} font ',10' noenhanced\n", p.method, p.x, p.y, 0.5 + 2.6 * stacked);
  }
  return text;
}

std::string speedAgainstError(const SceneRun& scene) {
  std::vector<Point> robust, approximate, all;
  for (const Entry& e : scene.entries) {
    if (!e.failure.empty() || e.frames == 0) continue;
    all.push_back({e.method, e.robust, e.minMs, std::max(100 * e.error.wrongShare(), kLeastShare)});
    (e.robust ? robust : approximate).push_back(all.back());
  }
  if (all.empty()) return "";
  std::string text = head("Speed against error: " + scene.name + " (" + scene.title + ")", "ms a frame (least)", "wrong pixels, % of those covered") + labels(all);
  text += fmt::format("set logscale xy\nset yrange [{}:1000]\nset ytics ('0' {}, '0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100)\n", kLeastShare * 0.6, kLeastShare);
  text += block("robust", robust) + block("approximate", approximate) + block("front", paretoFront(all));
  return text + "plot $front using 1:2 with steps lw 2 lc rgb '#bbbbbb' title 'Pareto front', $robust using 1:2 with points pt 7 ps 0.9 lc rgb '#0072b2' title 'robust', "
                "$approximate using 1:2 with points pt 5 ps 0.8 lc rgb '#d55e00' title 'approximate'\n";
}

using Value = std::function<double(const Entry&)>;

// A line a method.
std::string lines(const std::string& settings, const std::vector<Entry>& entries, const Value& x, const Value& y) {
  std::vector<std::pair<std::string, std::vector<Point>>> series;
  for (const Entry& e : entries) {
    if (!e.failure.empty()) continue;
    auto at = std::find_if(series.begin(), series.end(), [&](const auto& s) { return s.first == e.method; });
    if (at == series.end()) at = series.insert(at, {e.method, {}});
    if (y(e) > 0) at->second.push_back({e.method, e.robust, x(e), y(e)});
  }
  std::erase_if(series, [](const auto& s) { return s.second.empty(); });
  if (series.empty()) return "";
  std::string text = settings, plot;
  for (std::size_t i = 0; i < series.size(); ++i) {
    std::sort(series[i].second.begin(), series[i].second.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    text += block(fmt::format("d{}", i), series[i].second);
    plot += fmt::format("{}$d{} using 1:2 with linespoints lw 2 ps 0.6 title \"{}\"", i ? ", " : "plot ", i, series[i].first);
  }
  return text + plot + "\n";
}

// Two panels: objects and time of each pass.
std::string cullingPlot(const std::vector<Entry>& entries) {
  std::string text = head("Three bodies in a row: f2b with and without +cull", "pass", "objects drawn");
  std::string objects, times;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& e = entries[i];
    if (!e.failure.empty()) return "";
    text += fmt::format("$c{} << EOD\n", i);
    for (std::size_t p = 0; p < std::min(e.stats.objectsDrawn.size(), e.stats.passMs.size()); ++p) text += fmt::format("{} {} {}\n", p + 1, e.stats.objectsDrawn[p], e.stats.passMs[p]);
    text += "EOD\n";
    objects += fmt::format("{}$c{} using 1:2 with steps lw 2 title \"{}\"", i ? ", " : "plot ", i, e.method);
    times += fmt::format("{}$c{} using 1:3 with linespoints lw 2 ps 0.5 title \"{}\"", i ? ", " : "plot ", i, e.method);
  }
  if (entries.empty()) return "";
  return text + "set multiplot layout 2,1\nset yrange [0:*]\nset offsets 0,0,0.3,0\n" + objects + "\nunset title\nset offsets 0,0,0,0\nset ylabel 'ms of the pass'\n" + times + "\nunset multiplot\n";
}

double copiesOf(const Entry& e) { return e.parameter; }
double msOf(const Entry& e) { return e.minMs; }
double fragmentsOf(const Entry& e) { return double(e.stats.fragments) / 1e6; }
double mebibytesOf(const Entry& e) { return double(e.stats.methodBytes) / (1 << 20); }

}  // namespace

void drawPlots(Report& report, const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> scripts;
  const auto add = [&](const std::string& name, const std::string& text) {
    if (!text.empty()) scripts.emplace_back(name, fmt::format("set output '{}.svg'\n", name) + text);
  };
  for (const SceneRun& scene : report.scenes) add("speed-error-" + fileNameOf(scene.name), speedAgainstError(scene));
  add("resolution", lines(head("Time over resolution: a bumpy sphere, nothing coplanar", "pixels, millions", "ms a frame (least)") + "set logscale xy\n", report.overResolution,
                          [](const Entry& e) { return 1e-6 * e.width * e.height; }, msOf));
  add("coplanarity", lines(head("Time over coplanarity", "coincident copies", "ms a frame (least)") + "set logscale y\n", report.overCopies, copiesOf, msOf));
  add("depth", lines(head("Time over depth complexity: shells in one another", "fragments of the fullest pixel", "ms a frame (least)") + "set logscale y\n", report.overShells,
                     [](const Entry& e) { return double(e.stats.depthComplexityMax); }, msOf));
  add("culling", cullingPlot(report.culling));
  std::vector<Entry> memory = report.overCopies;
  add("memory", lines(head("Memory over fragments: coincident copies", "fragments, millions", "MiB of the method's buffers") + "set logscale y\n", memory, fragmentsOf, mebibytesOf));

  // All of them at once; the first failure to start says that there is no gnuplot.
  const std::string log = folder + "/gnuplot.log";
  std::vector<csg::Command> commands;
  for (const auto& [name, text] : scripts) {
    writeFile(folder + "/" + name + ".gp", text);
    // gnuplot writes beside where it runs: the script says where.
    commands.push_back({{"gnuplot", "-e", fmt::format("cd '{}'", folder), folder + "/" + name + ".gp"}, log});
  }
  try {
    csg::runAll(commands, 1);
  } catch (const Error& error) {
    report.plotNote = "There are no plots: gnuplot could not be run (Debian: gnuplot-nox).";
    return;
  }
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (commands[i].exitCode == 0 && std::filesystem::exists(folder + "/" + scripts[i].first + ".svg")) report.plots.push_back(scripts[i].first + ".svg");
    else report.plotNote = "Some plots are missing: gnuplot failed or is not there (Debian: gnuplot-nox).";
  }
  std::error_code ignored;
  if (report.plotNote.empty()) std::filesystem::remove(log, ignored);
}

}  // namespace copeel::bench
