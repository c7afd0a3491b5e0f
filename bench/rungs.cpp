#include "bench/rungs.h"

#include <algorithm>
#include <cctype>

#include "bench/process.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> plate(int columns, int rows) {
  return {fmt::format("columns={}", columns), fmt::format("rows={}", rows)};
}

Rung coplanarPlate() {
  Rung rung{"c1000_coplanar", "the same, coplanar ends", "plate.scad", plate(40, 25)};
  rung.definitions.push_back("overshoot=0");
  return rung;
}

// "c" chooses c100 and c1000_coplanar, not a rung called "chain".
bool chooses(const std::string& item, const std::string& name) {
  if (!name.starts_with(item)) return false;
  return name.size() == item.size() || name[item.size()] == '_' || std::isdigit(static_cast<unsigned char>(name[item.size()]));
}

}  // namespace

RungFolders defaultFolders() { return {COPEEL_BENCH_SOURCES, COPEEL_BENCH_MESHES}; }

std::vector<Rung> allRungs(const RungFolders& folders) {
  std::vector<Rung> rungs{
      {"a", "coplanar difference", "coplanar.scad", {}},
      {"b", "bracket, 20 holes", "bracket.scad", {}},
      {"c100", "plate, 100 cylinders", "plate.scad", plate(10, 10)},
      {"c400", "plate, 400 cylinders", "plate.scad", plate(20, 20)},
      {"c1000", "plate, 1,000 cylinders", "plate.scad", plate(40, 25)},
      coplanarPlate(),
      {"d", "two spheres and a bite, $fn = 256", "spheres.scad", {}},
      {"e", "chain of 50 operations", "chain.scad", {}},
      {"f", "Menger sponge, level 3", "menger.scad", {}},
  };
  const fs::path mesh = folders.meshes / "rocker-arm.off";
  if (fs::exists(mesh)) {
    rungs.push_back({"g", "rocker arm minus 27 spheres", "mesh_spheres.scad", {fmt::format("mesh=\"{}\"", fs::canonical(mesh).string())}});
  }
  for (int n : {4, 8, 12, 16, 32, 64}) {
    rungs.push_back({fmt::format("h{}", n), fmt::format("products of unions, n = {}", n), "products.scad", {fmt::format("n={}", n)}});
  }
  return rungs;
}

std::vector<Rung> chosenRungs(const RungFolders& folders, const std::vector<std::string>& names) {
  const std::vector<Rung> all = allRungs(folders);
  if (names.empty()) return all;
  for (const std::string& item : names) {
    if (std::none_of(all.begin(), all.end(), [&](const Rung& rung) { return chooses(item, rung.name); })) {
      failUsage("--rungs {}: there is no such rung", item);
    }
  }
  std::vector<Rung> chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const Rung& rung) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& item) { return chooses(item, rung.name); });
  });
  return chosen;
}

std::vector<std::string> definitionArguments(const Rung& rung) {
  std::vector<std::string> arguments;
  for (const std::string& definition : rung.definitions) arguments.insert(arguments.end(), {"-D", definition});
  return arguments;
}

fs::path sourceIn(const Rung& rung, const fs::path& folder) { return folder / rung.source; }

fs::path evaluate(const Rung& rung, const RungFolders& folders, const fs::path& folder) {
  // An absolute path: openscad takes a relative output from the source's folder.
  const fs::path csg = fs::absolute(folder / (rung.name + ".csg"));
  std::vector<std::string> command{"openscad", "-o", csg.string()};
  for (const std::string& argument : definitionArguments(rung)) command.push_back(argument);
  // openscad writes import() paths relative to the source, and they are read relative to the .csg: both lie in one folder.
  const fs::path source = sourceIn(rung, csg.parent_path());
  fs::copy_file(folders.sources / rung.source, source, fs::copy_options::overwrite_existing);
  command.push_back(source.string());
  const ProcessRun run = runProcess(command, {});
  if (run.exitCode != 0 || !fs::exists(csg)) failMachine("openscad: {}: could not be turned into .csg", rung.source);
  return csg;
}

}  // namespace copeel::bench
