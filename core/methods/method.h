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
  std::string_view paperWords;  // the same in the papers, 32-bit words a pixel (2013, Table 1); empty where they do not say
  std::string_view robustness;  // R_h, a formula
  bool robust;                  // delivers every fragment
  DrawMethod draw = nullptr;    // of the gl back end
  std::string_view modifiers = {};   // that it takes: "+cull", "+occupancy", both or none
};

const std::vector<MethodInfo>& methods();
const MethodInfo* findMethod(std::string_view name);   // null when there is none of that name

// The name less its modifiers (NAME+occupancy+cull), which are set in `options`. Throws Error{Usage}: no such method, or not one that takes the modifier.
std::string parseMethod(std::string_view text, MethodOptions& options);

// The method for --backend cpu|gl|auto and --method NAME|auto: by its name, else the back end's all-round one; "auto" is the cpu unless the method
// is the gl back end's. Throws Error{Usage} when the two do not go together, Error{Machine} when this build has no gl back end.
const MethodInfo& chooseMethod(std::string_view backend, std::string_view name);

}  // namespace copeel
