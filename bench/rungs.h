// The ladder: the models every figure of docs/benchmarks.md is taken from, small to large, as .scad sources with parameters.
//
// A rung is evaluated once per run by `openscad -o x.csg`, so that what reads .csg and what reads .scad see the same model.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace copeel::bench {

struct Rung {
  std::string name;                        // on the command line
  std::string title;
  std::string source;                      // a file of bench/scenes
  std::vector<std::string> definitions;    // NAME=VALUE for -D
};

// Where the sources are. Rungs of scanned meshes are left out where `meshes`, a folder, does not have them.
struct RungFolders {
  std::filesystem::path sources;
  std::filesystem::path meshes;
};

// The folders of the source tree this was built from.
RungFolders defaultFolders();

std::vector<Rung> allRungs(const RungFolders& folders);

// Those whose name is in the list, or whose name begins with an item and a digit or an underscore ("c" means all plates); all for an empty
// list. Throws Error{Usage} for an item that is none.
std::vector<Rung> chosenRungs(const RungFolders& folders, const std::vector<std::string>& names);

// Copies the source to `folder`, writes NAME.csg beside it and returns its path. Throws Error{Machine} where openscad cannot do it.
std::filesystem::path evaluate(const Rung& rung, const RungFolders& folders, const std::filesystem::path& folder);
std::filesystem::path sourceIn(const Rung& rung, const std::filesystem::path& folder);   // the copy

// "-D", "NAME=VALUE", … as openscad and copeel take them.
std::vector<std::string> definitionArguments(const Rung& rung);

}  // namespace copeel::bench
