// The registry of peeling methods: what each is called, what it promises, where it runs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/methods/draw.h"

namespace copeel {

struct MethodInfo {
  std::string_view name;        // on the command line
  std::string_view title;
  std::string_view source;      // paper and section
  std::string_view backend;     // cpu, gl
  std::string_view passes;      // over the geometry, a formula
  std::string_view memory;      // bytes, a formula
  std::string_view robustness;  // R_h, a formula
  bool robust;                  // delivers every fragment
  DrawMethod draw = nullptr;    // of the gl back end
};

const std::vector<MethodInfo>& methods();
const MethodInfo* findMethod(std::string_view name);   // null when there is none of that name

}  // namespace copeel
