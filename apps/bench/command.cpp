// The options of `copeel bench`. What its report is made of: run.h; the tables of the papers: table_2011.h, table_2013.h.
#include "apps/bench/command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "apps/bench/options.h"
#include "apps/bench/run.h"
#include "apps/bench/scenes.h"
#include "apps/bench/table_2011.h"
#include "apps/bench/table_2013.h"
#include "apps/bench/report.h"
#include "apps/command/parse_values.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

void print2011(const Options& options) {
  if (!findMethod("f2b-kb-zf")) failMachine("--table 2011 is of the gl back end, which is not in this build");
  if (options.scenes.size() > 1) failUsage("--table 2011 takes one --scene, not {}", options.scenes.size());
  if (options.markdown) failUsage("--markdown goes with --table 2013");
  const auto [width, height] = chosenSizes(options)[0];
  Options2011 wanted;
  wanted.width = width, wanted.height = height, wanted.frames = options.frames;
  wanted.mesh = options.scenes.empty() ? "" : options.scenes[0];
  wanted.camera = options.camera;
  const std::vector<Row2011> rows = table2011(wanted);
  fmt::print("{}", options.json ? toJson(rows) : toText(rows));
}

void print2013(const Options& options) {
  if (!options.scenes.empty()) failUsage("--table 2013 has a scene of its own, without --scene");
  const auto [width, height] = chosenSizes(options)[0];
  const Table2013 table = table2013(width, height, options.k, options.frames);
  fmt::print("{}", options.json ? toJson(table) : options.markdown ? toMarkdown(table) : toText(table));
}

void run(const Options& options) {
  if (options.table == "2011") return print2011(options);
  if (options.table == "2013") return print2013(options);
  if (!options.table.empty()) failUsage("--table {}: there are those of 2011 and 2013", options.table);
  if (options.json || options.markdown) failUsage("--json and --markdown go with --table; --report writes bench.json");
  if (options.reportFolder.empty()) failUsage("bench wants --report DIR, --table 2011 or --table 2013");
  runReport(options);
}

void addChoices(CLI::App& command, Options& options) {
  std::vector<std::string_view> parts;
  for (const Part& part : kParts) parts.push_back(part.name);
  command.add_option("--parts", options.parts, fmt::format("{}; several by commas (all that make sense with --scene and --methods)", fmt::join(parts, ", ")))->delimiter(',')->type_name("PART");
  command.add_option("--scene", options.scenes, fmt::format("{}, or a mesh file; several by commas (all of the generated ones)", fmt::join(sceneNames(), ", ")))
      ->delimiter(',')->type_name("NAME|FILE");
  command.add_option("--methods", options.methods, "by commas (all of this build)")->delimiter(',')->type_name("NAME[+cull][+occupancy]");
  command.add_option("--backend", options.backend, "whose methods (auto: both)")->check(CLI::IsMember({"cpu", "gl", "auto"}))->type_name("cpu|gl|auto");
  command.add_option("--depth-source", options.depthSource, "of the gl back end: of the face's plane, or the rasterizer's, as in the papers (planes; a few methods by both)")
      ->check(CLI::IsMember({"planes", "hardware"}))->type_name("planes|hardware");
  command.add_option("--data", options.dataFolder, "folder with models/*.ply for the figures of the 2013 paper and the limits of speed (generated stand-ins)")->type_name("DIR");
  command.add_option_function<std::string>("--camera", [&options](const std::string& text) {
    options.camera.camera = parseNumbers(text, "--camera");
    const std::size_t count = options.camera.camera.size();
    if (count != 6 && count != 7) failUsage("--camera takes 7 numbers (translate, rotate, distance) or 6 (eye, centre), not {}", count);
  }, "of the scenes named by --scene: as oit's")->type_name("NUMBERS");
}

void addSizes(CLI::App& command, Options& options) {
  command.add_option("--sizes", options.sizes, "pixels (256,192); several for time over resolution, pictures are of the first")->type_name("W,H");
  command.add_option("--copies", options.copies, "coincident copies of the scenes that have them (4)")->check(CLI::Range(1, 1000))->type_name("N");
  command.add_option("--k", options.k, "buffer length of the methods that have one (8)")->check(CLI::Range(1, 1024))->type_name("N");
  command.add_option("--frames", options.frames, "timed frames of each method (3); in the speed part of VTK alone, as ours have a time")->check(CLI::Range(1, 100000))->type_name("N");
  command.add_option("--threads", options.threads, "of the cpu back end (all cores)")->check(CLI::Range(1, 1024))->type_name("N");
  command.add_option("--seconds", options.seconds, "that the parts may take together, about (160): what would take longer is left out, and named")
      ->check(CLI::Range(1.0, 1e6))->type_name("N");
}

}  // namespace

void addCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench", "speed against error of all methods");
  const auto options = std::make_shared<Options>();
  addChoices(*command, *options);
  addSizes(*command, *options);
  command->add_option("--report", options->reportFolder, "folder for index.html, bench.json, plots and pictures")->type_name("DIR");
  command->add_option("--table", options->table, "prints that table of the papers beside ours; 2011 takes --scene FILE and --camera")->type_name("2011|2013");
  CLI::Option* const json = command->add_flag("--json", options->json, "the table as JSON");
  command->add_flag("--markdown", options->markdown, "the table of 2013 in Markdown")->excludes(json);
  command->add_flag("--no-peer", options->noPeer, "leaves VTK out");
  command->add_flag("--quiet", options->quiet, "no progress");
  command->callback([options] { run(*options); });
}

}  // namespace copeel::bench
