#include "apps/bench/gnuplot.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace copeel::bench {
namespace {

constexpr const char* kBlue = "#0072b2";
constexpr const char* kOrange = "#d55e00";
constexpr double kLeastShare = 1e-3;   // per cent of wrong pixels; what is below is drawn there, as "0"

// Colours that most colour-blind people can tell apart (Okabe, Ito), then the same ones dashed; the points differ as well.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222", "#8c564b"};
constexpr int kPoints[] = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12};

struct Point {
  std::string method;
  bool robust = false;
  double x = 0, y = 0;
};

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

// Numbers at the points, names beside them in the margin, from the fastest on: labels at the points themselves would lie over each other.
std::string numbered(std::vector<Point>& points) {
  constexpr double kCloseX = 0.11, kCloseY = 0.12, kStep = 0.9;   // decades; characters
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  std::string text;
  std::vector<std::pair<const Point*, int>> placed;   // and how high its number stands
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    // The lowest place that no number beside it has.
    const auto isTaken = [&](int level) {
      return std::any_of(placed.begin(), placed.end(), [&](const auto& other) {
        return other.second == level && std::log10(p.x / other.first->x) < kCloseX && std::abs(std::log10(p.y / other.first->y)) < kCloseY;
      });
    };
    int level = 0;
    while (isTaken(level)) ++level;
    placed.emplace_back(&p, level);
    text += fmt::format("set label \"{}\" at {},{} center offset 0,{} font ',9' tc rgb '{}' noenhanced\n", i + 1, p.x, p.y, 0.8 + kStep * level, p.robust ? kBlue : kOrange);
  }
  const double step = std::min(0.034, 0.98 / double(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format("set label \"{:>2}  {}\" at screen 0.75,{} left font ',10' tc rgb '{}' noenhanced\n", i + 1, points[i].method, 0.965 - step * double(i), points[i].robust ? kBlue : kOrange);
  }
  return text;
}

}  // namespace

// gnuplot reads _, ^ and {} in names as typesetting; ours are plain.
std::string plotHead(const std::string& title, const std::string& x, const std::string& y) {
  return fmt::format(
      "set terminal svg size 1000,560 dynamic font 'sans-serif,13' background '#ffffff' noenhanced\n"
      "set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\"\nset grid xtics ytics lt 1 lw 0.7 lc rgb '#d8d8d8'\nset border 3\nset tics nomirror\nset key outside right noenhanced\n",
      title, x, y);
}

std::string speedAgainstError(const SceneRun& scene) {
  std::vector<Point> robust, approximate, all;
  for (const Entry& e : scene.entries) {
    if (!e.measured() || e.frames == 0) continue;
    all.push_back({e.method, e.robust, e.minMs, std::max(100 * e.error.wrongShare(), kLeastShare)});
    (e.robust ? robust : approximate).push_back(all.back());
  }
  if (all.empty()) return "";
  std::string text = plotHead("Speed against error: " + scene.name + " (" + scene.title + ")", "ms a frame (least)", "wrong pixels, % of those covered") + numbered(all);
  text += fmt::format("set rmargin at screen 0.70\nset key at graph 0.02,0.62 left top Left reverse\nset logscale xy\nset yrange [{}:1000]\n"
                      "set ytics ('0' {}, '0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100)\n", kLeastShare * 0.6, kLeastShare);
  text += block("robust", robust) + block("approximate", approximate) + block("front", paretoFront(all));
  return text + fmt::format("plot $front using 1:2 with steps lw 2 lc rgb '#bbbbbb' title 'Pareto front', $robust using 1:2 with points pt 7 ps 0.8 lc rgb '{}' title 'robust', "
                            "$approximate using 1:2 with points pt 5 ps 0.7 lc rgb '{}' title 'approximate'\n", kBlue, kOrange);
}

std::string lines(const std::string& head, const std::vector<Entry>& entries, const Value& x, const Value& y) {
  std::vector<std::pair<std::string, std::vector<Point>>> series;
  for (const Entry& e : entries) {
    if (!e.measured()) continue;
    auto at = std::find_if(series.begin(), series.end(), [&](const auto& s) { return s.first == e.method; });
    if (at == series.end()) at = series.insert(at, {e.method, {}});
    if (y(e) > 0) at->second.push_back({e.method, e.robust, x(e), y(e)});
  }
  std::erase_if(series, [](const auto& s) { return s.second.empty(); });
  if (series.empty()) return "";
  std::string text = head + "set autoscale xfix\n", plot;
  for (std::size_t i = 0; i < series.size(); ++i) {
    std::sort(series[i].second.begin(), series[i].second.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    text += block(fmt::format("d{}", i), series[i].second);
    plot += fmt::format("{}$d{} using 1:2 with linespoints lw 1.8 ps 0.7 pt {} dt {} lc rgb '{}' title \"{}\"", i ? ", " : "plot ", i, kPoints[i % std::size(kPoints)],
                        1 + i / std::size(kColors) % 3, kColors[i % std::size(kColors)], series[i].first);
  }
  return text + plot + "\n";
}

std::string bars(const std::string& head, const std::vector<Entry>& entries) {
  std::vector<std::string> methods, scenes;
  const auto note = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const Entry& e : entries) {
    if (!e.measured()) continue;
    note(methods, e.method);
    note(scenes, fmt::format("{} [{:.2f} M fragments, {} deep]", e.scene, double(e.stats.fragments) / 1e6, e.stats.depthComplexityMax));
  }
  if (methods.empty()) return "";
  std::string data = "$bars << EOD\n", plot;
  for (const std::string& scene : scenes) {
    data += "\"" + scene + "\"";
    for (const std::string& method : methods) {
      const auto at = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.measured() && e.method == method && scene.starts_with(e.scene + " ["); });
      data += at == entries.end() ? " NaN" : fmt::format(" {}", at->minMs);
    }
    data += "\n";
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    plot += fmt::format("{}$bars using {}:xtic(1) lc rgb '{}' title \"{}\"", i ? ", " : "plot ", i + 2, kColors[i % std::size(kColors)], methods[i]);
  }
  return head + fmt::format("set xrange [-0.6:{}]\nset xtics font ',11'\n", double(scenes.size()) - 0.4) + "set style data histogram\nset style fill solid\nset boxwidth 0.9\nset logscale y\nunset logscale x\n" + data + "EOD\n" + plot + "\n";
}

std::string cullingPlot(const std::vector<Entry>& entries, const std::string& of) {
  std::vector<const Entry*> plain;
  for (const Entry& e : entries) {
    if (e.measured() && e.method.find('+') == std::string::npos) plain.push_back(&e);
  }
  std::string data, upper, lower;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    std::string objects = "plot ", times = "plot ";
    for (const Entry& e : entries) {
      const bool culled = e.method == plain[i]->method + "+cull";
      if (!e.measured() || !(culled || &e == plain[i])) continue;
      const std::string name = fmt::format("c{}{}", i, culled ? "c" : "p"), style = fmt::format("lw 2 lc rgb '{}' title \"{}\"", culled ? kOrange : kBlue, e.method);
      data += fmt::format("${} << EOD\n", name);
      for (std::size_t p = 0; p < std::min(e.stats.objectsDrawn.size(), e.stats.passMs.size()); ++p) data += fmt::format("{} {} {}\n", p + 1, e.stats.objectsDrawn[p], e.stats.passMs[p]);
      data += "EOD\n";
      objects += fmt::format("{}${} using 1:2 with steps {}", culled ? ", " : "", name, style);
      times += fmt::format("{}${} using 1:3 with linespoints pt 7 ps 0.4 {}", culled ? ", " : "", name, style);
    }
    upper += fmt::format("set ylabel '{}'\n{}\n", i ? "" : "objects drawn", objects);
    lower += fmt::format("set ylabel '{}'\n{}\n", i ? "" : "ms of the pass", times);
  }
  if (plain.empty()) return "";
  return plotHead("", "pass", "") + data + "unset title\nset key inside top right\n" +
         fmt::format("set multiplot layout 2,{} title \"With and without +cull: {}\"\nset yrange [0:4.6]\nset ytics 1\n{}set yrange [0:*]\nset offsets 0,0,graph 0.4,0\nset ytics autofreq\n{}unset multiplot\n", plain.size(), of, upper, lower);
}

}  // namespace copeel::bench
