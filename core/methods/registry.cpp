// One line a method.
#include "core/methods/method.h"

namespace copeel {

const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> all = {
      {"tile", "A-buffer in tiles, sorted by networks", "Copeel; after Batcher 1968, Fuchs 1989", "cpu", "1",
       "8 bytes a fragment of the tiles in flight", "1", true},
      {"zbuffer", "plain z-buffer, the nearest fragment only", "Catmull 1974", "cpu", "1", "8 bytes a pixel of the tiles in flight",
       "covered pixels / N", false},
  };
  return all;
}

const MethodInfo* findMethod(std::string_view name) {
  for (const MethodInfo& method : methods()) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

}  // namespace copeel
