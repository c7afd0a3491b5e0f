// Counts what a method delivers: fragments, groups, and the largest group of the pixel (result: these three words).
uint countFragments, countGroups, countLargest, countOpen;

uint countAt(uint side) { return foldStateAt(side, 4u); }

void foldStore(uint side) {
  uint at = countAt(side);
  foldStates[at] = countFragments;
  foldStates[at + 1u] = countGroups;
  foldStates[at + 2u] = countLargest;
  foldStates[at + 3u] = countOpen;
}

void foldLoad(uint side) {
  uint at = countAt(side);
  countFragments = foldStates[at];
  countGroups = foldStates[at + 1u];
  countLargest = foldStates[at + 2u];
  countOpen = foldStates[at + 3u];
}

void foldInitial(uint side) {
  countFragments = countGroups = countLargest = countOpen = 0u;
  foldStore(side);
}

void foldFront(uint id) { ++countFragments, ++countOpen; }
void foldBehind(uint id) { foldFront(id); }

bool foldCloseGroup(uint key) {
  ++countGroups;
  countLargest = max(countLargest, countOpen);
  countOpen = 0u;
  return false;
}

void foldFinish() {
  foldLoad(COPEEL_BACK);
  uint fragments = countFragments, groups = countGroups, largest = countLargest;
  foldLoad(COPEEL_FRONT);
  uint at = pixelIndex() * 3u;
  foldResults[at] = fragments + countFragments;
  foldResults[at + 1u] = groups + countGroups;
  foldResults[at + 2u] = max(largest, countLargest);
}
