// One line a method.
#include "core/methods/method.h"

#include <algorithm>

#include "core/error.h"
#if COPEEL_GL
#include "core/methods/methods_gl.h"
#endif

namespace copeel {

const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> all = {
      {"tile", "A-buffer in tiles, sorted by networks", "Copeel; after Batcher 1968, Fuchs 1989", "cpu", "1",
       "8 bytes a fragment of the tiles in flight", "1", true},
      {"zbuffer", "plain z-buffer, the nearest fragment only", "Catmull 1974", "cpu", "1", "8 bytes a pixel of the tiles in flight",
       "covered pixels / N", false},
#if COPEEL_GL
      {"f2b", "front-to-back depth peeling", "Everitt 2001", "gl", "D + 1", "12 a pixel", "D / N", false, drawF2b},
      {"ll", "A-buffer in per-pixel linked lists", "Yang 2010", "gl", "1, 2 where it grows", "4 a pixel + 12 a fragment", "1", true, drawLl},
#endif
  };
  return all;
}

const MethodInfo* findMethod(std::string_view name) {
  for (const MethodInfo& method : methods()) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

std::string parseMethod(std::string_view text, MethodOptions& options) {
  std::string_view rest = text.substr(std::min(text.find('+'), text.size()));
  const std::string name(text.substr(0, text.size() - rest.size()));
  const MethodInfo* method = findMethod(name);
  if (!method && name != "auto") failUsage("no method '{}' (see copeel methods)", name);
  while (!rest.empty()) {
    const std::string_view modifier = rest.substr(0, rest.find('+', 1));
    rest.remove_prefix(modifier.size());
    if (!method || method->modifiers.find(modifier) == std::string_view::npos || modifier.size() < 2) {
      failUsage("--method {}: {} does not take {}", text, name, modifier);
    }
    (modifier == "+cull" ? options.cull : options.occupancy) = true;
  }
  return name;
}

const MethodInfo& chooseMethod(std::string_view backend, std::string_view name) {
#if !COPEEL_GL
  if (backend == "gl") failMachine("the gl back end is not in this build; use --backend cpu or auto");
#endif
  if (name == "auto") name = backend == "gl" ? "ll" : "tile";
  const MethodInfo* method = findMethod(name);
  if (!method) failUsage("no method '{}' (see copeel methods)", name);
  if (backend != "auto" && method->backend != backend) failUsage("--method {} is one of the {} back end, not of {}", name, method->backend, backend);
  return *method;
}

}  // namespace copeel
