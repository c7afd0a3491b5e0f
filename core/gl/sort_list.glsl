// Sorts a linked list of fragments where it lies, and delivers it: for the methods that gather into lists. The file that includes this defines LIST_NODES,
// an array of records {next, key, id}; links are index + 1, 0 ends a list. Where the whole list has one key, LIST_KEY(node) says which.
//
// Bottom-up merge sort: n log n, no memory but the links. Order: key, then the later primitive first (as the fold wants groups).
#ifndef LIST_KEY
#define LIST_KEY(node) LIST_NODES[(node) - 1u].key
#endif

bool listBefore(uint a, uint b) {
  uint keyA = LIST_KEY(a), keyB = LIST_KEY(b);
  if (keyA != keyB) return keyA < keyB;
  return (LIST_NODES[a - 1u].id & COPEEL_ID_PRIMITIVE) > (LIST_NODES[b - 1u].id & COPEEL_ID_PRIMITIVE);
}

// Merges runs of `run` nodes by pairs; `merges` counts the pairs.
uint mergeRuns(uint head, uint run, out uint merges) {
  uint rest = head, last = 0u;
  head = 0u;
  merges = 0u;
  while (rest != 0u) {
    // Runs a and b of at most `run` nodes each follow one another in the list.
    ++merges;
    uint a = rest, b = rest, left = 0u, right = run;
    for (; left < run && b != 0u; ++left) b = LIST_NODES[b - 1u].next;
    while (left > 0u || (right > 0u && b != 0u)) {
      bool takeB = left == 0u || (right > 0u && b != 0u && listBefore(b, a));
      uint node = takeB ? b : a;
      if (takeB) b = LIST_NODES[b - 1u].next, --right;
      else a = LIST_NODES[a - 1u].next, --left;
      if (last == 0u) head = node;
      else LIST_NODES[last - 1u].next = node;
      last = node;
    }
    rest = b;
  }
  if (last != 0u) LIST_NODES[last - 1u].next = 0u;
  return head;
}

uint sortList(uint head) {
  for (uint run = 1u;; run *= 2u) {
    uint merges;
    head = mergeRuns(head, run, merges);
    if (merges <= 1u) return head;
  }
}

// True: the pixel has enough.
bool deliverList(uint head) {
  for (uint node = head; node != 0u;) {
    uint key = LIST_KEY(node);
    for (; node != 0u && LIST_KEY(node) == key; node = LIST_NODES[node - 1u].next) foldFront(LIST_NODES[node - 1u].id);
    if (foldCloseGroup(key)) return true;
  }
  return false;
}
