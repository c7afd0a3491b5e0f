// How the program takes memory from the system.
#pragma once

namespace copeel {

// Call first in main. A picture is made in a tenth of a second, and a fifth of it went into pages of 4 KiB that the kernel cleared one by one: blocks
// were mapped, given back and mapped again. Now one heap is kept until the end, its first part in large pages where the system has them.
void keepHeap();

}  // namespace copeel
