// The options of `copeel bench`, and the runs that its report is made of: every method on every scene, then a few methods over resolution, copies and
// layers, then culling, the table of 2011, and the peer.
#include "apps/bench/command.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/bench/report.h"
#include "apps/command/parse_values.h"
#include "apps/command/progress.h"
#include "core/error.h"
#include "core/methods/method.h"
#include "core/output_file.h"

namespace copeel::bench {
namespace {

// Methods of the sweeps, where they are among those asked for: one of each family.
constexpr std::array<std::string_view, 9> kSweepMethods = {"tile", "ll", "fab", "sb", "k-plus", "f2b", "f2b-2p", "f2b-ll", "dual-2p"};
constexpr std::array<std::size_t, 5> kCopies = {1, 2, 4, 8, 12};
constexpr std::array<unsigned, 4> kShells = {1, 2, 4, 8};
constexpr unsigned kShellColumns = 28, kShellRows = 18;
constexpr int kLargestSide = 16384;

struct CommandOptions {
  std::vector<std::string> scenes, methods, sizes;
  std::string reportFolder, table, backend = "auto";
  int copies = 4, frames = 3, threads = 0;
  std::uint32_t k = 8;
  bool quiet = false, noPeer = false;
};

void append(std::vector<MethodRun>& all, std::vector<MethodRun> some) { all.insert(all.end(), some.begin(), some.end()); }

std::vector<MethodRun> chosenMethods(const CommandOptions& options) {
  std::vector<MethodRun> chosen;
  for (const std::string& name : options.methods) {
    if (name == "auto" && options.backend == "cpu") failUsage("--methods auto is one of the gl back end, not of cpu");
    append(chosen, runsOf(name == "auto" ? "gl" : options.backend, name, options.k));
  }
  if (!options.methods.empty()) return chosen;
  for (const MethodInfo& method : methods()) {
    if (options.backend != "auto" && options.backend != method.backend) continue;
    if (&method == findMethod(method.name, options.backend)) append(chosen, runsOf(method.name == "auto" ? "gl" : options.backend, method.name, options.k));
  }
  return chosen;
}

std::vector<std::array<int, 2>> chosenSizes(const CommandOptions& options) {
  std::vector<std::array<int, 2>> sizes;
  for (const std::string& size : options.sizes) sizes.push_back(parseImageSize(size));
  if (sizes.empty()) sizes = {{320, 240}};
  return sizes;
}

void add(std::vector<Entry>& all, std::vector<Entry> some, double parameter) {
  for (Entry& entry : some) {
    entry.parameter = parameter;
    all.push_back(std::move(entry));
  }
}

// One run of the program: its options, and the report that grows.
class Run {
 public:
  explicit Run(const CommandOptions& options)
      : options_(options), sizes_(chosenSizes(options)), progress_(!options.quiet) {
    measure_.methods = chosenMethods(options);
    measure_.frames = options.frames;
    measure_.threads = options.threads;
  }

  void makeFolders() const;
  void scenes();
  void sweeps();
  void culling();
  void peer();
  void write();

 private:
  MeasureOptions sweepOptions() const;
  std::string folder(const char* name) const { return options_.reportFolder + "/" + name; }

  const CommandOptions& options_;
  std::vector<std::array<int, 2>> sizes_;
  Progress progress_;
  MeasureOptions measure_;
  Report report_;
};

void Run::makeFolders() const {
  for (const char* name : {"pictures", "plots"}) {
    std::error_code error;
    std::filesystem::create_directories(folder(name), error);
    if (error) failMachine("{}: {}", folder(name), error.message());
  }
}

// Pictures are those of the first size.
void Run::scenes() {
  const std::vector<std::string>& names = options_.scenes.empty() ? sceneNames() : options_.scenes;
  for (const std::string& name : names) {
    const BenchScene scene = sceneOf(name, static_cast<std::size_t>(options_.copies));
    progress_.phase(fmt::format("{}: {}", scene.name, scene.title));
    MeasureOptions withPictures = measure_;
    withPictures.pictureFolder = folder("pictures");
    report_.scenes.push_back({scene.name, scene.title, measureScene(scene, sizes_[0][0], sizes_[0][1], withPictures)});
    fmt::print("{}\n", toText(report_.scenes.back().entries));
    std::fflush(stdout);
  }
}

MeasureOptions Run::sweepOptions() const {
  MeasureOptions sweep = measure_;
  std::erase_if(sweep.methods, [](const MethodRun& run) {
    const auto* const found = std::find(kSweepMethods.begin(), kSweepMethods.end(), run.method->name);
    return found == kSweepMethods.end() || run.options.cull || run.options.occupancy;
  });
  if (sweep.methods.empty()) sweep.methods = measure_.methods;
  return sweep;
}

// Over resolution: the sizes asked for, or a half, one and two of the side.
void Run::sweeps() {
  const MeasureOptions sweep = sweepOptions();
  const auto [width, height] = sizes_[0];
  std::vector<std::array<int, 2>> sizes = sizes_;
  if (sizes.size() == 1) sizes = {{std::max(1, width / 2), std::max(1, height / 2)}, {width, height}, {std::min(2 * width, kLargestSide), std::min(2 * height, kLargestSide)}};
  for (const auto& size : sizes) {
    progress_.phase(fmt::format("over resolution: {} x {}", size[0], size[1]));
    add(report_.overResolution, measureScene(sceneOf("sphere", 1), size[0], size[1], sweep), 0);
  }
  for (const std::size_t count : kCopies) {
    progress_.phase(fmt::format("over coplanarity: {} copies", count));
    add(report_.overCopies, measureScene(copies(shells(2, kShellColumns, kShellRows), count, "copies"), width, height, sweep), double(count));
  }
  for (const unsigned count : kShells) {
    progress_.phase(fmt::format("over depth complexity: {} shells", count));
    add(report_.overShells, measureScene(copies(shells(count, kShellColumns, kShellRows), 1, "shells"), width, height, sweep), count);
  }
}

void Run::culling() {
  if (!findMethod("f2b", options_.backend)) return;
  progress_.phase("culling");
  MeasureOptions two = measure_;
  two.methods.clear();
  for (const char* name : {"f2b", "f2b+cull"}) append(two.methods, runsOf("gl", name, options_.k));
  report_.culling = measureScene(threeInARow(), sizes_[0][0], sizes_[0][1], two);
}

void Run::peer() {
  if (options_.noPeer) {
    report_.peerNote = "Not run: --no-peer.";
    return;
  }
  progress_.phase("VTK");
  report_.peers = runVtk(sizes_[0][0], sizes_[0][1], std::max(3, options_.frames), options_.threads, report_.peerNote);
  for (const PeerEntry& p : report_.peers) {
    fmt::print("{:<8} {} copies: {:.2f} ms, R_h {:.4f}; tile {:.2f} ms\n", p.name, p.copies, p.minMs, p.rh, p.tileMs);
  }
  if (report_.peers.empty()) fmt::print("VTK: {}\n", report_.peerNote);
}

void Run::write() {
  progress_.phase("the report");
  if (findMethod("f2b-kb-zf", options_.backend)) {
    try {
      report_.table = table2011(sizes_[0][0], sizes_[0][1], 1);
    } catch (const Error& error) {   // no GL: the scenes' tables say so
      if (error.code() != ExitCode::Machine) throw;
    }
  }
  drawPlots(report_, folder("plots"));
  writeFile(options_.reportFolder + "/bench.json", toJson(report_));
  writeFile(options_.reportFolder + "/index.html", toHtml(report_));
  if (!report_.plotNote.empty()) fmt::print("{}\n", report_.plotNote);
  fmt::print("{}/index.html\n", options_.reportFolder);
}

void run(const CommandOptions& options) {
  if (!options.table.empty()) {
    if (options.table != "2011") failUsage("--table {}: there is a table of 2011", options.table);
    if (!findMethod("f2b-kb-zf")) failMachine("--table 2011 is of the gl back end, which is not in this build");
    const auto [width, height] = chosenSizes(options)[0];
    fmt::print("{}", toText(table2011(width, height, options.frames)));
    return;
  }
  if (options.reportFolder.empty()) failUsage("bench wants --report DIR, or --table 2011");
  Run work(options);
  work.makeFolders();
  work.scenes();
  work.sweeps();
  work.culling();
  work.peer();
  work.write();
}

}  // namespace

void addCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench", "speed against error of all methods");
  const auto options = std::make_shared<CommandOptions>();
  std::string names;
  for (const std::string& name : sceneNames()) names += (names.empty() ? "" : ", ") + name;
  command->add_option("--scene", options->scenes, fmt::format("{}, or a mesh file; several by commas (all of the generated ones)", names))->delimiter(',')->type_name("NAME|FILE");
  command->add_option("--methods", options->methods, "by commas (all of this build)")->delimiter(',')->type_name("NAME[+cull][+occupancy]");
  command->add_option("--backend", options->backend, "whose methods (auto: both)")->check(CLI::IsMember({"cpu", "gl", "auto"}))->type_name("cpu|gl|auto");
  command->add_option("--sizes", options->sizes, "pixels (320,240); several for time over resolution, pictures are of the first")->type_name("W,H");
  command->add_option("--copies", options->copies, "coincident copies of the scenes that have them (4)")->check(CLI::Range(1, 1000))->type_name("N");
  command->add_option("--k", options->k, "buffer length of the methods that have one (8)")->check(CLI::Range(1, 1024))->type_name("N");
  command->add_option("--frames", options->frames, "timed frames of each method (3)")->check(CLI::Range(1, 100000))->type_name("N");
  command->add_option("--threads", options->threads, "of the cpu back end (all cores)")->check(CLI::Range(1, 1024))->type_name("N");
  command->add_option("--report", options->reportFolder, "folder for index.html, bench.json, plots and pictures")->type_name("DIR");
  command->add_option("--table", options->table, "prints that table of the papers beside ours")->type_name("2011");
  command->add_flag("--no-peer", options->noPeer, "leaves VTK out");
  command->add_flag("--quiet", options->quiet, "no progress");
  command->callback([options] { run(*options); });
}

}  // namespace copeel::bench
