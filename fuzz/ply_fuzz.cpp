// Any bytes to the PLY reader.
#include "reader_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return copeel::fuzzReader(copeel::readPly, data, size);
}
