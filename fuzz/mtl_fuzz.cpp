// Any bytes to the reader of OBJ's material libraries.
#include "core/formats/read_mtl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    copeel::Materials materials;
    copeel::readMtl(copeel::Source({reinterpret_cast<const char*>(data), size}, "fuzz"), materials);
    for (const auto& [name, color] : materials) COPEEL_CHECK(color.a >= 0 && color.a <= 1 && color.r <= 255, "{}", name);
  } catch (const copeel::Error& error) {
    COPEEL_CHECK(error.code() == copeel::ExitCode::Input, "{}", error.what());
  }
  return 0;
}
