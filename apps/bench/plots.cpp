// The report's plots, drawn by gnuplot as SVG, each script kept beside its picture.
#include <filesystem>

#include <fmt/format.h>

#include "apps/bench/gnuplot.h"
#include "apps/bench/report.h"
#include "apps/csg/process.h"
#include "core/error.h"
#include "core/output_file.h"

namespace copeel::bench {
namespace {

double copiesOf(const Entry& e) { return e.parameter; }
double msOf(const Entry& e) { return e.minMs; }
double pixelsOf(const Entry& e) { return 1e-6 * e.width * e.height; }
double depthOf(const Entry& e) { return double(e.stats.depthComplexityMax); }
double fragmentsOf(const Entry& e) { return double(e.stats.fragments) / 1e6; }
double mebibytesOf(const Entry& e) { return double(e.stats.methodBytes) / (1 << 20); }
double rhOf(const Entry& e) { return e.stats.rh(); }

struct Script {
  std::string name, text, caption;
};

// The figures of the 2013 paper by number.
std::vector<Script> scriptsOf(const Report& report) {
  std::vector<Script> all;
  for (const SceneRun& scene : report.scenes) {
    all.push_back({"speed-error-" + fileNameOf(scene.name), speedAgainstError(scene),
                   fmt::format("{}: down and left is better; no method beats those on the Pareto front in both.", scene.title)});
  }
  const char* const ms = "ms a frame (least)";
  const std::string log = "set logscale y\n";
  all.push_back({"resolution", lines(plotHead("Time over resolution", "pixels, millions", ms) + "set logscale xy\n", report.overResolution.entries, pixelsOf, msOf),
                 "As figure 7 of the 2013 paper: " + report.overResolution.of + "."});
  all.push_back({"coplanarity", lines(plotHead("Time over coplanarity", "coincident copies", ms) + log, report.overCopies.entries, copiesOf, msOf),
                 "As figure 8: " + report.overCopies.of + "."});
  const std::string depth = plotHead("Time over depth complexity", report.depthByScene ? "" : "fragments of the fullest pixel", ms);
  all.push_back({"depth", report.depthByScene ? bars(depth, report.overDepth.entries) : lines(depth + log, report.overDepth.entries, depthOf, msOf), "As figure 9: " + report.overDepth.of + "."});
  all.push_back({"culling", cullingPlot(report.culling, report.cullingOf), "As figure 10: " + report.cullingOf + "; objects that are wholly peeled are passed over."});
  const double limit = double(report.memoryLimit) / (1 << 20);
  all.push_back({"memory", lines(plotHead("Memory over fragments", "fragments, millions", "MiB of the method's buffers") + "set logscale xy\n" +
                                     fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} nohead dt 2 lc rgb '#888888'\nset label 'limit of the next plot' at graph 0.02, first {0} offset 0,0.6 tc rgb '#666666'\n", limit),
                                 report.memory.entries, fragmentsOf, mebibytesOf),
                 "As figure 11: " + report.memory.of + "."});
  all.push_back({"memory-limited", lines(plotHead(fmt::format("Share of the fragments delivered within {:.3g} MiB", limit), "fragments, millions", "R_h") + "set logscale x\nset yrange [0:1.05]\n",
                                         report.limitedMemory.entries, fragmentsOf, rhOf),
                 fmt::format("As figure 11: the same scenes, each method held to {:.3g} MiB. What a buffer cannot take is lost, and counted.", limit)});
  std::erase_if(all, [](const Script& script) { return script.text.empty(); });
  return all;
}

}  // namespace

void drawPlots(Report& report, const std::string& folder) {
  const std::vector<Script> scripts = scriptsOf(report);
  // gnuplot writes beside where it runs: the folder's whole name, with its quotes doubled.
  std::string place = std::filesystem::absolute(folder).string();
  for (std::size_t at = 0; (at = place.find('\'', at)) != std::string::npos; at += 2) place.insert(at, 1, '\'');
  const std::string log = folder + "/gnuplot.log";
  std::vector<csg::Command> commands;
  for (const Script& script : scripts) {
    writeFile(folder + "/" + script.name + ".gp", fmt::format("set output '{}.svg'\n", script.name) + script.text);
    commands.push_back({{"gnuplot", "-e", fmt::format("cd '{}'", place), script.name + ".gp"}, log});
  }
  // The first that cannot be started says that there is no gnuplot.
  try {
    csg::runAll(commands, 1);
  } catch (const Error& error) {
    report.plotNote = "There are no plots: gnuplot could not be run (Debian: gnuplot-nox).";
    return;
  }
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string file = scripts[i].name + ".svg";
    if (commands[i].exitCode == 0 && std::filesystem::exists(folder + "/" + file)) report.plots.push_back({file, scripts[i].caption});
    else report.plotNote = "Some plots are missing: gnuplot failed or is not there (Debian: gnuplot-nox).";
  }
  std::error_code ignored;
  if (report.plotNote.empty()) std::filesystem::remove(log, ignored);
}

}  // namespace copeel::bench
