# What a full build costs. Most of it is parsing, so the headers that many sources include are parsed once. Sources still include what they
# use: ccache caches nothing that a precompiled header goes into, so with it there are none, nor where CMAKE_DISABLE_PRECOMPILE_HEADERS is ON
# (clang-tidy wants that, as it cannot read the headers of gcc).
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

set(COPEEL_HEADERS
  <algorithm> <array> <bit> <charconv> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map> <memory> <numeric>
  <optional> <set> <span> <string> <string_view> <unordered_map> <utility> <vector>
  <fmt/format.h> <glm/common.hpp> <glm/geometric.hpp> <glm/mat4x4.hpp> <glm/matrix.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>)

# copeel_precompile(target group header…): the targets of a group are compiled with the same options; the first makes the header for all.
function(copeel_precompile target group)
  get_property(owner GLOBAL PROPERTY COPEEL_HEADERS_OF_${group})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    target_precompile_headers(${target} PRIVATE ${COPEEL_HEADERS} ${ARGN})
    set_property(GLOBAL PROPERTY COPEEL_HEADERS_OF_${group} ${target})
  endif()
endfunction()

# Command lines and tests do their work in the libraries: for what they add, thorough optimisation costs more than it gains.
function(copeel_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
