# Configures and builds the fuzzers, then runs each for SECONDS; the kept regressions are the seeds of the mesh readers, fuzz/csg_seeds those of
# the .csg parser. A finding is left in BINARY/findings.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endfunction()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G Ninja -D CMAKE_BUILD_TYPE=RelWithDebInfo -D CMAKE_CXX_COMPILER=${COMPILER}
    -D COPEEL_FUZZ=ON -D COPEEL_BENCH=OFF -D COPEEL_VALIDATION=OFF -D COPEEL_TESTS=OFF)
run(${CMAKE_COMMAND} --build ${BINARY})
file(GLOB targets ${BINARY}/bin/*_fuzz)
if(NOT targets)
  message(FATAL_ERROR "no fuzzer was built")
endif()
file(MAKE_DIRECTORY ${BINARY}/findings)
foreach(target IN LISTS targets)
  cmake_path(GET target STEM name)
  file(MAKE_DIRECTORY ${BINARY}/corpus/${name})
  set(seeds ${SOURCE}/tests/formats/regressions)
  if(name STREQUAL "csg_parser_fuzz")
    set(seeds ${SOURCE}/fuzz/csg_seeds)
  endif()
  run(${target} -max_total_time=${SECONDS} -timeout=20 -rss_limit_mb=2048 -artifact_prefix=${BINARY}/findings/${name}- -print_final_stats=1
      ${BINARY}/corpus/${name} ${seeds})
endforeach()
