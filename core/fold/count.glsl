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

void foldReset(uint side) { countFragments = countGroups = countLargest = countOpen = 0u; }

void foldInitial(uint side) {
  foldReset(side);
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

void countWrite(uint fragments, uint groups, uint largest) {
  uint at = pixelIndex() * 3u;
  foldResults[at] = fragments;
  foldResults[at + 1u] = groups;
  foldResults[at + 2u] = largest;
}

void foldFinishFront() { countWrite(countFragments, countGroups, countLargest); }

void foldFinish() {
  foldLoad(COPEEL_BACK);
  uint fragments = countFragments, groups = countGroups, largest = countLargest;
  foldLoad(COPEEL_FRONT);
  countWrite(fragments + countFragments, groups + countGroups, max(largest, countLargest));
}
