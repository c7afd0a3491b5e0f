// Counts what a method delivers: fragments, groups, and the largest group of the pixel (result: these three words).
//
// With FOLD_COUNT_UNCERTAIN also (a fourth word, eight words of state for four) how often keys leave the order of neighbours open: those of two plane classes that
// are equal, or next to each other. Of the front side alone.
uint countFragments, countGroups, countLargest, countOpen;

#ifdef FOLD_COUNT_UNCERTAIN
#define COUNT_STATE_WORDS 8u
#define COUNT_RESULT_WORDS 4u
struct CountPrimitive {
  uint planeClass, object;
};
layout(std430, binding = COPEEL_BUFFER_PRIMITIVES) readonly buffer CountPrimitives { CountPrimitive countPrimitives[]; };

// Of the last closed group its key, of the last fragment its class; whether the open group began with another class than the one before it ended with.
uint countUncertain, countKey, countClass, countTurned;
#else
#define COUNT_STATE_WORDS 4u
#define COUNT_RESULT_WORDS 3u
#endif

uint countAt(uint side) { return foldStateAt(side, COUNT_STATE_WORDS); }

void foldStore(uint side) {
  uint at = countAt(side);
  foldStates[at] = countFragments;
  foldStates[at + 1u] = countGroups;
  foldStates[at + 2u] = countLargest;
  foldStates[at + 3u] = countOpen;
#ifdef FOLD_COUNT_UNCERTAIN
  foldStates[at + 4u] = countUncertain;
  foldStates[at + 5u] = countKey;
  foldStates[at + 6u] = countClass;
  foldStates[at + 7u] = countTurned;
#endif
}

void foldLoad(uint side) {
  uint at = countAt(side);
  countFragments = foldStates[at];
  countGroups = foldStates[at + 1u];
  countLargest = foldStates[at + 2u];
  countOpen = foldStates[at + 3u];
#ifdef FOLD_COUNT_UNCERTAIN
  countUncertain = foldStates[at + 4u];
  countKey = foldStates[at + 5u];
  countClass = foldStates[at + 6u];
  countTurned = foldStates[at + 7u];
#endif
}

void foldReset(uint side) {
  countFragments = countGroups = countLargest = countOpen = 0u;
#ifdef FOLD_COUNT_UNCERTAIN
  countUncertain = countKey = countClass = countTurned = 0u;
#endif
}

void foldInitial(uint side) {
  foldReset(side);
  foldStore(side);
}

void foldFront(uint id) {
#ifdef FOLD_COUNT_UNCERTAIN
  uint planeClass = countPrimitives[id & COPEEL_ID_PRIMITIVE].planeClass;
  if (countOpen == 0u) countTurned = uint(planeClass != countClass);
  else countUncertain += uint(planeClass != countClass);
  countClass = planeClass;
#endif
  ++countFragments, ++countOpen;
}
void foldBehind(uint id) { foldFront(id); }

bool foldCloseGroup(uint key) {
#ifdef FOLD_COUNT_UNCERTAIN
  if (countGroups > 0u && key == countKey + 1u) countUncertain += countTurned;
  countKey = key;
#endif
  ++countGroups;
  countLargest = max(countLargest, countOpen);
  countOpen = 0u;
  return false;
}

void countWrite(uint fragments, uint groups, uint largest) {
  uint at = pixelIndex() * COUNT_RESULT_WORDS;
  foldResults[at] = fragments;
  foldResults[at + 1u] = groups;
  foldResults[at + 2u] = largest;
#ifdef FOLD_COUNT_UNCERTAIN
  foldResults[at + 3u] = countUncertain;
#endif
}

void foldNothing() {
#ifdef FOLD_COUNT_UNCERTAIN
  countUncertain = 0u;
#endif
  countWrite(0u, 0u, 0u);
}

void foldFinishFront() { countWrite(countFragments, countGroups, countLargest); }

void foldFinish() {
  foldLoad(COPEEL_BACK);
  uint fragments = countFragments, groups = countGroups, largest = countLargest;
  foldLoad(COPEEL_FRONT);
  countWrite(fragments + countFragments, groups + countGroups, max(largest, countLargest));
}
