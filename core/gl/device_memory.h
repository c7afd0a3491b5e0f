// What is asked of the driver, all contexts together, against limits: the user's (--memory), and what the device can address. A driver that runs out
// by itself may end the program, so that is not left to it. What drivers take for themselves is not counted.
#pragma once

#include <cstdint>

namespace copeel::gl {

// A share of the memory, given back when it goes.
class DeviceMemory {
 public:
  DeviceMemory() = default;
  explicit DeviceMemory(std::uint64_t bytes);   // throws Error{Machine}: past a limit
  ~DeviceMemory();
  DeviceMemory(DeviceMemory&& other) noexcept;
  DeviceMemory& operator=(DeviceMemory&& other) noexcept;

  static void limit(std::uint64_t bytes);       // all shares together; 0: no limit
  static std::uint64_t left();                  // until the limit, 2^64 - 1 where there is none
  static std::uint64_t largestBuffer();         // bytes; of the current context
  static std::uint64_t mostTexels();            // of a buffer that is read as texels

 private:
  std::uint64_t bytes_ = 0;
};

}  // namespace copeel::gl
