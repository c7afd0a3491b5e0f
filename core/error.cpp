// The end of a run that met a bug: the broken invariant and its values, then abort, so that a debugger or a core file sees the place.
#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace copeel {

void checkFailed(const char* file, int line, const char* condition, const std::string& values) {
  const char* separator = values.empty() ? "" : ": ";
  std::fprintf(stderr, "%s:%d: this is a bug in Copeel: %s does not hold%s%s\n", file, line, condition, separator,
               values.c_str());
  std::fflush(stderr);
  std::abort();
}

}  // namespace copeel
