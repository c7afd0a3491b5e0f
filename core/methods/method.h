// The registry of peeling methods: what each is called, what it promises, where it runs.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/methods/draw.h"

namespace copeel {

// What a method of the cpu back end keeps of a pixel: those of a kind share their code.
enum class Keeps : std::uint8_t { All, Nearest, KNearest };

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
  Keeps keeps = Keeps::All;     // of the cpu back end
};

const std::vector<MethodInfo>& methods();

// Of the back end (cpu, gl; auto: the cpu's where both have one of that name); null when there is none.
const MethodInfo* findMethod(std::string_view name, std::string_view backend = "auto");

// The method for --backend cpu|gl|auto and --method NAME|auto, the name with its modifiers (NAME+occupancy+cull), which are set in `options`. `auto` is the
// back end's all-round one; of two back ends that have the name, auto takes the cpu's unless only the other's takes the modifiers. Throws Error{Usage} when
// there is no such method or it does not take a modifier, Error{Machine} when this build has no gl back end.
const MethodInfo& chooseMethod(std::string_view backend, std::string_view text, MethodOptions& options);

}  // namespace copeel
