// Any bytes to the OBJ reader.
#include "reader_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return copeel::fuzzReader(copeel::readObj, data, size);
}
