// One line a method. A name that both back ends have is listed once for each, the cpu's first.
#include "core/methods/method.h"

#include <algorithm>

#include "core/error.h"
#if COPEEL_GL
#include "core/methods/methods_gl.h"
#endif

namespace copeel {

const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> all = {
      {"tile", "A-buffer in tiles, sorted by networks", "Copeel; after Batcher 1968, Fuchs 1989", "cpu",
       "1", "8 bytes a fragment of the tiles in flight", "", "1", true},
      {"zbuffer", "plain z-buffer, the nearest fragment only", "Catmull 1974", "cpu",
       "1", "8 bytes a pixel of the tiles in flight", "", "covered pixels / N", false, nullptr, "", Keeps::Nearest},
      {"kb", "k-buffer in tiles, the K nearest", "Bavoil 2007", "cpu",
       "1", "8 K a pixel of the tiles in flight", "2 K + 2", "min(K, N) / N", false, nullptr, "", Keeps::KNearest},
      {"k-plus", "k+-buffer in tiles, the K nearest", "Vasilakis, Fudos 2014", "cpu",
       "1", "8 K a pixel of the tiles in flight", "2 K + 2", "min(K, N) / N", false, nullptr, "", Keeps::KNearest},
#if COPEEL_GL
      {"auto", "the fastest robust method that fits the memory", "after Vasilakis and Fudos 2013, 4.4", "gl",
       "the method's, and a look", "the method's, at most --memory from 28 a pixel on", "", "1", true, drawAuto},
      {"f2b", "front-to-back depth peeling", "Everitt 2001", "gl", "D + 1", "12 a pixel", "3", "D / N", false, drawF2b, "+cull"},
      {"f2b2", "two-pass front-to-back depth peeling", "Vasilakis and Fudos 2013, 4", "gl", "2 D + 1", "12 a pixel", "3", "D / N", false, drawF2b2, "+cull"},
      {"f2b-zf", "front-to-back peeling of every fragment by its id", "Vasilakis and Fudos 2011, Algorithm 1", "gl",
       "2 N + 1", "28 a pixel", "", "1", true, drawF2bZf, "+cull"},
      {"f2b-kb-zf", "a sorted k-buffer per depth layer", "Vasilakis and Fudos 2011", "gl",
       "2 D + 1", "8 + 4 K a pixel", "", "Σ min(K, C(Z)) / N", false, drawF2bKbZf, "+cull"},
      {"f2b-2p", "two coplanar fragments an iteration, by least and greatest id", "Vasilakis and Fudos 2013, Algorithm 1", "gl",
       "2 Σ ⌈C(Z) / 2⌉ + 1", "28 a pixel", "10", "1", true, drawF2b2p, "+cull"},
      {"f2b-3p", "f2b-2p with a depth pass of its own", "Vasilakis and Fudos 2013, 3.1.1", "gl",
       "at most 3 Σ ⌈C(Z) / 2⌉ + 1", "36 a pixel", "10", "1", true, drawF2b3p, "+cull"},
      {"f2b-ll", "linked lists per depth layer", "Vasilakis and Fudos 2013, Algorithm 2", "gl",
       "2 D + 1, more where it grows", "12 a pixel + 8 a fragment of the largest layer", "2 C + 4", "1", true, drawF2bLl, "+cull"},
      {"f2b-fab", "fixed-size arrays per depth layer", "Vasilakis and Fudos 2013, Algorithm 3", "gl",
       "2 D + 1", "12 + 4 K a pixel", "K + 4", "Σ min(K, C(Z)) / N", false, drawF2bFab, "+cull"},
      {"f2b-kb", "a k-buffer per depth layer", "Vasilakis and Fudos 2013, Algorithm 3", "gl",
       "2 D + 1", "8 + 4 K a pixel", "K + 3", "Σ min(K, C(Z)) / N", false, drawF2bKb, "+cull"},
      {"hybrid", "peels by depth, and by id where fragments are coplanar", "Copeel; asked for by Vasilakis and Fudos 2013, 5", "gl",
       "Σ (1 + ⌊C(Z) / 2⌋) + 1", "28 a pixel", "", "1", true, drawHybrid, "+cull"},
      {"dual", "dual depth peeling", "Bavoil and Myers 2008", "gl", "⌈D / 2⌉ + 1", "24 a pixel", "6", "D / N", false, drawDual, "+cull"},
      {"dual-2p", "f2b-2p from both ends", "Vasilakis and Fudos 2013, 3.1.2", "gl",
       "about Σ ⌈C(Z) / 2⌉ + 1", "56 a pixel", "20", "1", true, drawDual2p, "+cull"},
      {"dual-ll", "linked lists at both ends", "Vasilakis and Fudos 2013, 3.1.3", "gl",
       "2 ⌈D / 2⌉ + 1, more where it grows", "24 a pixel + 8 a fragment of the largest two layers", "2 C + 6", "1", true, drawDualLl, "+cull"},
      {"dual-fab", "fixed-size arrays at both ends", "Vasilakis and Fudos 2013, 3.2.1", "gl",
       "2 ⌈D / 2⌉ + 1", "24 + 8 K a pixel", "K + 6", "Σ min(K, C(Z)) / N", false, drawDualFab, "+cull"},
      {"dual-kb", "k-buffers at both ends", "Vasilakis and Fudos 2013, 3.2.1", "gl",
       "2 ⌈D / 2⌉ + 1", "16 + 8 K a pixel", "K + 4", "Σ min(K, C(Z)) / N", false, drawDualKb, "+cull"},
      {"fab", "A-buffer in fixed-size arrays", "Liu 2010 (FreePipe), Crassin 2010", "gl",
       "1, 2 where it grows", "4 + 8 max(K, N) a pixel", "2 D + 2", "1", true, drawFab},
      {"ll", "A-buffer in per-pixel linked lists", "Yang 2010", "gl",
       "1, 2 where it grows", "4 a pixel + 12 max(4 pixels, N) + 68; above 2^17 pixels 96 times the fullest of 8 memories + 516", "3 N + 3", "1", true, drawLl, "+occupancy"},
      {"sb", "S-buffer: count, prefix sum, fill", "Vasilakis, Fudos 2012", "gl", "2", "8 a pixel + 8 a fragment + 260", "2 N + 3", "1", true, drawSb},
      {"kb", "k-buffer", "Bavoil 2007", "gl", "1", "8 K + 8 a pixel", "2 K + 2", "min(K, N) / N at best", false, drawKb, "+occupancy"},
      {"k-plus", "k+-buffer: spin lock or interlock, the K nearest", "Vasilakis, Fudos 2014", "gl",
       "1", "8 K + 8 a pixel", "2 K + 2", "min(K, N) / N", false, drawKPlus, "+occupancy"},
      {"bun-ll", "bucket peeling with linked lists", "Vasilakis, Fudos 2013, 3.1.4", "gl",
       "1, 2 where it grows", "20 a pixel + 60 times the fullest bucket + 324", "3 N + 8 to 15 N + 8", "1", true, drawBunLl},
      {"srab", "stencil-routed A-buffer: the first K drawn", "Myers, Bavoil 2007", "gl",
       "1", "8 K + 4 a pixel", "3 K + 2", "min(K, N) / N", false, drawSrab, "+occupancy"},
      {"multi-kb", "multi-layer depth peeling via fragment sort", "Liu 2006", "gl",
       "2 ceil(D / K) + 1", "8 K + 4 a pixel", "2 K + 2", "D / N", false, drawMultiKb},
      {"bun", "uniform bucket peeling", "Liu 2009", "gl", "2", "16 K a pixel", "4 K + 2", "<= D / N", false, drawBun},
      {"bad", "adaptive bucket peeling", "Liu 2009", "gl", "4", "16 K + 40 a pixel", "6 K + 3", "<= D / N", false, drawBad},
#endif
  };
  return all;
}

namespace {

// "+a+b" as "+a", "+b".
std::vector<std::string_view> modifiersOf(std::string_view text) {
  std::vector<std::string_view> all;
  while (!text.empty()) {
    all.push_back(text.substr(0, text.find('+', 1)));
    text.remove_prefix(all.back().size());
  }
  return all;
}

bool takes(const MethodInfo& method, std::string_view modifier) {
  const std::vector<std::string_view> taken = modifiersOf(method.modifiers);
  return std::find(taken.begin(), taken.end(), modifier) != taken.end();
}

}  // namespace

const MethodInfo* findMethod(std::string_view name, std::string_view backend) {
  for (const MethodInfo& method : methods()) {
    if (method.name == name && (backend == "auto" || backend == method.backend)) return &method;
  }
  return nullptr;
}

const MethodInfo& chooseMethod(std::string_view backend, std::string_view text, MethodOptions& options) {
#if !COPEEL_GL
  if (backend == "gl") failMachine("the gl back end is not in this build; use --backend cpu or auto");
#endif
  std::string_view name = text.substr(0, text.find('+'));
  const std::vector<std::string_view> modifiers = modifiersOf(text.substr(name.size()));
  if (name == "auto") name = backend == "gl" ? "auto" : "tile";
  const MethodInfo* chosen = nullptr;
  for (const MethodInfo& method : methods()) {
    if (method.name != name || (backend != "auto" && backend != method.backend)) continue;
    const bool takesAll = std::all_of(modifiers.begin(), modifiers.end(), [&](std::string_view m) { return takes(method, m); });
    if (!chosen || takesAll) chosen = &method;
    if (takesAll) break;
  }
  if (!chosen) {
    const MethodInfo* other = findMethod(name);
    if (!other) failUsage("no method '{}' (see copeel methods)", name);
    failUsage("--method {} is one of the {} back end, not of {}", name, other->backend, backend);
  }
  for (const std::string_view modifier : modifiers) {
    if (!takes(*chosen, modifier)) failUsage("--method {}: {} does not take {}", text, name, modifier);
    (modifier == "+cull" ? options.cull : options.occupancy) = true;
  }
  return *chosen;
}

}  // namespace copeel
