// Sorts few fragments in registers and delivers them. Shell's sort: short code, and an insertion sort where there are least.
// Keys and ids are two arrays of words, since Mesa 22.3 loses writes to an array of vectors whose element was copied out before.
#define SORT_SHORT 128

// The fold's order of fragments {key, id}: nearer first, and of coplanar ones the later primitive first.
bool fragmentBefore(uvec2 a, uvec2 b) {
  return a.x < b.x || (a.x == b.x && (a.y & COPEEL_ID_PRIMITIVE) > (b.y & COPEEL_ID_PRIMITIVE));
}

#if defined(PASS_RESOLVE)

uint sortedKeys[SORT_SHORT], sortedIds[SORT_SHORT];

void sortShort(uint count) {
  for (uint gap = count > 80u ? 40u : count > 26u ? 13u : count > 8u ? 4u : 1u; gap > 0u; gap /= 3u) {
    for (uint i = gap; i < count; ++i) {
      uint key = sortedKeys[i], id = sortedIds[i], at = i;
      while (at >= gap) {
        uint otherKey = sortedKeys[at - gap], otherId = sortedIds[at - gap];
        if (!fragmentBefore(uvec2(key, id), uvec2(otherKey, otherId))) break;
        sortedKeys[at] = otherKey, sortedIds[at] = otherId;
        at -= gap;
      }
      sortedKeys[at] = key, sortedIds[at] = id;
    }
  }
}

// True: the pixel has enough.
bool deliverShort(uint count) {
  for (uint i = 0u; i < count;) {
    uint key = sortedKeys[i];
    for (; i < count && sortedKeys[i] == key; ++i) foldFront(sortedIds[i]);
    if (foldCloseGroup(key)) return true;
  }
  return false;
}

#endif
