// Sorts few fragments of a pixel and delivers them: beginShort(), putShort() for each, deliverShort(). The file that includes this defines SORT_SHORT, how many
// there are at most (5 or more), and SORT_DISTINCT where of each depth one fragment is to be delivered. Keys are less than COPEEL_KEY_NONE.
//
// The four nearest are kept in registers, in order from the beginning: most pixels hold no more, and an array that is indexed lies in memory (llvmpipe
// clears it, too). What they push out goes to arrays, sorted at the end by Shell's sort: short code, and an insertion sort where there are least.
// Keys and ids are apart, since Mesa 22.3 loses writes to an array of vectors whose element was copied out before.

// The fold's order of fragments {key, id}: nearer first, and of coplanar ones the later primitive first.
bool fragmentBefore(uvec2 a, uvec2 b) {
  return a.x < b.x || (a.x == b.x && (a.y & COPEEL_ID_PRIMITIVE) > (b.y & COPEEL_ID_PRIMITIVE));
}

#if defined(PASS_RESOLVE)

#define SORT_NEAR 4u

uvec4 nearKeys, nearIds;
uint farKeys[SORT_SHORT - SORT_NEAR], farIds[SORT_SHORT - SORT_NEAR];
uint shortCount;

void beginShort() {
  nearKeys = uvec4(COPEEL_KEY_NONE);
  nearIds = uvec4(0u);
  shortCount = 0u;
}

void putShort(uvec2 fragment) {
  bvec4 before = bvec4(fragmentBefore(fragment, uvec2(nearKeys.x, nearIds.x)), fragmentBefore(fragment, uvec2(nearKeys.y, nearIds.y)),
                       fragmentBefore(fragment, uvec2(nearKeys.z, nearIds.z)), fragmentBefore(fragment, uvec2(nearKeys.w, nearIds.w)));
  bvec4 behind = bvec4(false, before.xyz);
  if (shortCount >= SORT_NEAR) {
    farKeys[shortCount - SORT_NEAR] = before.w ? nearKeys.w : fragment.x;
    farIds[shortCount - SORT_NEAR] = before.w ? nearIds.w : fragment.y;
  }
  nearKeys = mix(mix(nearKeys, fragment.xxxx, before), nearKeys.xxyz, behind);
  nearIds = mix(mix(nearIds, fragment.yyyy, before), nearIds.xxyz, behind);
  ++shortCount;
}

void sortFar(uint count) {
  for (uint gap = count > 80u ? 40u : count > 26u ? 13u : count > 8u ? 4u : 1u; gap > 0u; gap /= 3u) {
    for (uint i = gap; i < count; ++i) {
      uint key = farKeys[i], id = farIds[i], at = i;
      while (at >= gap) {
        uint otherKey = farKeys[at - gap], otherId = farIds[at - gap];
        if (!fragmentBefore(uvec2(key, id), uvec2(otherKey, otherId))) break;
        farKeys[at] = otherKey, farIds[at] = otherId;
        at -= gap;
      }
      farKeys[at] = key, farIds[at] = id;
    }
  }
}

// True: the pixel has enough.
bool deliverShort() {
  if (shortCount > SORT_NEAR) sortFar(shortCount - SORT_NEAR);
  uint last = COPEEL_KEY_NONE;
  for (uint i = 0u; i < shortCount; ++i) {
    uint key = nearKeys.x, id = nearIds.x;
    if (i > 0u && key != last && foldCloseGroup(last)) return true;
#ifdef SORT_DISTINCT
    if (key != last)
#endif
    foldFront(id);
    last = key;
    nearKeys = nearKeys.yzww, nearIds = nearIds.yzww;
    if (i + SORT_NEAR < shortCount) nearKeys.w = farKeys[i], nearIds.w = farIds[i];
  }
  return shortCount > 0u && foldCloseGroup(last);
}

#endif
