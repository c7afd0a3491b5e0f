// Keeps the whole pixel stack, for tests and reports: result words are the fragments delivered by the front and by the back side, then
// FOLD_RECORD_CAPACITY entries of (id, number of the group on its side, and the top bit where it came from the group's rear end). Front entries come first, back ones run from the end downwards.
// With FOLD_RECORD_GROUPS a side has enough after so many groups.
#define FOLD_RECORD_BEHIND 0x80000000u

uint recordCount, recordGroups;
uint recordSide;

uint recordAt() { return pixelIndex() * (2u + 2u * uint(FOLD_RECORD_CAPACITY)); }

void foldStore(uint side) {
  uint at = foldStateAt(side, 2u);
  foldStates[at] = recordCount;
  foldStates[at + 1u] = recordGroups;
}

void foldLoad(uint side) {
  uint at = foldStateAt(side, 2u);
  recordCount = foldStates[at];
  recordGroups = foldStates[at + 1u];
  recordSide = side;
}

void foldReset(uint side) {
  recordCount = recordGroups = 0u;
  recordSide = side;
}

void foldInitial(uint side) {
  foldReset(side);
  foldStore(side);
}

void recordFragment(uint id, uint end) {
  if (recordCount < uint(FOLD_RECORD_CAPACITY)) {
    uint entry = recordSide == COPEEL_FRONT ? recordCount : uint(FOLD_RECORD_CAPACITY) - 1u - recordCount;
    uint at = recordAt() + 2u + 2u * entry;
    foldResults[at] = id;
    foldResults[at + 1u] = recordGroups | end;
  }
  ++recordCount;
}
void foldFront(uint id) { recordFragment(id, 0u); }
void foldBehind(uint id) { recordFragment(id, FOLD_RECORD_BEHIND); }

bool foldCloseGroup(uint key) {
  ++recordGroups;
#ifdef FOLD_RECORD_GROUPS
  return recordGroups >= uint(FOLD_RECORD_GROUPS);
#else
  return false;
#endif
}

void foldFinishFront() {
  foldResults[recordAt()] = recordCount;
  foldResults[recordAt() + 1u] = 0u;
}

void foldNothing() {
  foldResults[recordAt()] = 0u;
  foldResults[recordAt() + 1u] = 0u;
}

void foldFinish() {
  uint at = recordAt();
  foldLoad(COPEEL_BACK);
  foldResults[at + 1u] = recordCount;
  foldLoad(COPEEL_FRONT);
  foldResults[at] = recordCount;
}
