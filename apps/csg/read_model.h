// Files to CSG models.
#pragma once

#include <string>
#include <vector>

#include "apps/csg/csg_model.h"

namespace copeel::csg {

struct ReadOptions {
  std::string openscad = "openscad";        // the program that turns .scad into .csg and evaluates what is not native
  std::vector<std::string> definitions;     // -D name=value, handed to openscad with a .scad
  std::string cacheFolder;                  // of evaluated meshes; empty: $XDG_CACHE_HOME/copeel or ~/.cache/copeel
};

// .scad through openscad to .csg, then as readCsg. Throws Error{Input} (file, line, cause) or Error{Machine} (no openscad).
Model readScad(const std::string& path, const ReadOptions& options);

// A .csg as openscad 2021.01 writes it, or as written by hand with all its digits.
Model readCsg(const std::string& path, const ReadOptions& options);

// The same from memory; `name` stands in messages and import() paths are relative to `folder`.
Model parseCsg(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions& options);

// Mesh files, united, or combined by an expression over A, B, C … in the order of the files: + or | union, - difference, & or * intersection,
// parentheses; & binds tighter than + and -, which associate to the left. Beyond Z: M27, M28 … (M and a number counted from 1 names any
// mesh). Leaves stand in the order of the expression, one for each time a mesh is named. Throws Error{Usage} for a bad expression.
// `fileOfLeaf`, where wanted, receives the index of each leaf's file: a file has a leaf for each time it is named.
Model readMeshes(const std::vector<std::string>& paths, const std::string& expression, std::vector<std::size_t>* fileOfLeaf = nullptr);

}  // namespace copeel::csg
