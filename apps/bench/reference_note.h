// What figures of error are measured against, in words.
#pragma once

namespace copeel::bench {

inline constexpr const char* kReferenceNote =
    "The reference is the cpu back end's method tile with every order of depths decided exactly. The project's tests prove that one against exact "
    "references (exact fragments, exact Booleans), which this program does not link. Pixels whose centre lies within 1/256 pixel of a projected edge are left out; "
    "a pixel is wrong where a channel is off by more than half a level of 255. A frame is the whole way from a view to colours and depths in memory.";

}  // namespace copeel::bench
