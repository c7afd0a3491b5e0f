// Sorts a short array where it lies: `count` words of `slots` from `first`, greatest first, by insertion.
void sortSlots(uint first, uint count) {
  for (uint i = 1u; i < count; ++i) {
    uint moved = slots[first + i], hole = i;
    for (; hole > 0u && slots[first + hole - 1u] < moved; --hole) slots[first + hole] = slots[first + hole - 1u];
    slots[first + hole] = moved;
  }
}
