// One line a method.
#include "core/methods/method.h"
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
      {"fab", "A-buffer in fixed-size arrays", "Liu 2010 (FreePipe), Crassin 2010", "gl", "1, 2 where it grows", "4 + 8 max(K, N) a pixel", "1", true, drawFab},
      {"ll", "A-buffer in per-pixel linked lists", "Yang 2010", "gl", "1, 2 where it grows", "4 a pixel + 12 max(4 pixels, N) + 68", "1", true, drawLl},
      {"sb", "S-buffer: count, prefix sum, fill", "Vasilakis, Fudos 2012", "gl", "2", "8 a pixel + 8 a fragment + 260", "1", true, drawSb},
      {"kb", "k-buffer", "Bavoil 2007", "gl", "1", "8 K + 8 a pixel", "min(K, N) / N at best", false, drawKb},
      {"k-plus", "k+-buffer: spin lock or interlock, the K nearest", "Vasilakis, Fudos 2014", "gl", "1", "8 K + 8 a pixel", "min(K, N) / N", false, drawKPlus},
      {"bun-ll", "bucket peeling with linked lists", "Vasilakis, Fudos 2013, 3.1.4", "gl", "1, 2 where it grows",
       "20 a pixel + 60 times the fullest bucket + 324", "1", true, drawBunLl},
      {"srab", "stencil-routed A-buffer: the first K drawn", "Myers, Bavoil 2007", "gl", "1", "8 K + 4 a pixel", "min(K, N) / N", false, drawSrab},
      {"multi-kb", "multi-layer depth peeling via fragment sort", "Liu 2006", "gl", "2 ceil(D / K) + 1", "8 K + 4 a pixel", "D / N", false, drawMultiKb},
      {"bun", "uniform bucket peeling", "Liu 2009", "gl", "2", "16 K a pixel", "<= D / N", false, drawBun},
      {"bad", "adaptive bucket peeling", "Liu 2009", "gl", "4", "16 K + 40 a pixel", "<= D / N", false, drawBad},
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

}  // namespace copeel
