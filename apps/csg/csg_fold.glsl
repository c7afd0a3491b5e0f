// CSG on the device: the rules of apps/csg/csg_fold.h on the fold interface of core/gl/fold.glsl. Windings per leaf, threshold gates above them, and
// the surfaces where a result turns from outside to inside. The back side starts behind everything, where all leaves are left, and walks towards the
// eye: what it finds last is nearest. Result: count of surfaces, then (primitive, part, leaf) of up to `surfaceLimit` of them, front to back.
//
// The model (written by gl_pass.cpp) is one array of words: the header below, then leaves, uses, gates and outputs.
layout(std430, binding = COPEEL_BUFFER_FOLD_TABLE) readonly buffer CsgModel {
  uint leafCount, gateCount, outputCount, surfaceLimit;
  uint insideRule;       // 0 non-zero, 1 positive, 2 odd
  uint firstSection;     // leaves from here on are sections
  uint usesAt, gatesAt, outputsAt;   // offsets into words
  uint words[];          // from 0: leaves {winding at the eye, index of the first use, opacities}, and one more for the end of the last one's uses
} csg;
struct CsgPrimitive {
  uint planeClass, object;
};
layout(std430, binding = COPEEL_BUFFER_PRIMITIVES) readonly buffer CsgPrimitives { CsgPrimitive csgPrimitives[]; };

layout(std430, binding = COPEEL_BUFFER_FOLD_TABLE + 2) buffer CsgCut { uint csgCut; };

#define CSG_NONE 0xFFFFFFFFu

// Opacity of a leaf, two bits each: as part of the solid, of what % marks, of what # marks. An output's third word says which, and in its
// bit 2 whether it is the opaque share.
#define CSG_UNSEEN 0u
#define CSG_TRANSLUCENT 1u
#define CSG_OPAQUE 2u

// State of a side, in words: header {surfaces, enough, head of the touched leaves, group number}; surfaces (primitive, part, leaf); per leaf {winding, change in the
// open group, next touched leaf, latest front face, latest back face of the group}; per gate {inputs lacking, the same before group `stamp`, stamp}.
#define CSG_HEADER 4u
#define CSG_SURFACE 3u
#define CSG_LEAF 5u
#define CSG_GATE 3u

uint csgBase, csgSide;
uint csgLeafAt(uint leaf) { return csgBase + CSG_HEADER + CSG_SURFACE * csg.surfaceLimit + CSG_LEAF * leaf; }
uint csgGateAt(uint gate) { return csgLeafAt(csg.leafCount) + CSG_GATE * gate; }
uint csgStateWords() { return CSG_HEADER + CSG_SURFACE * csg.surfaceLimit + CSG_LEAF * csg.leafCount + CSG_GATE * csg.gateCount; }

bool csgInside(int winding) {
  return csg.insideRule == 0u ? winding != 0 : csg.insideRule == 1u ? winding > 0 : (winding & 1) != 0;
}

// A driver may end shaders that loop for too long (llvmpipe silently, after 65,536 turns of all loops together), and a large model asks for many turns.
// Every further loop then ends after its first turn, as this one shows.
void csgNoteCut() {
  uint turns = 0u;
  while (turns < min(csg.surfaceLimit, 2u)) ++turns;
  if (turns < 2u) csgCut = 1u;
}

// The state lives in memory; loading finds its place.
void foldLoad(uint side) {
  csgSide = side;
  csgBase = foldStateAt(side, csgStateWords());
}
void foldStore(uint side) { csgNoteCut(); }

bool csgWasTrue(uint gate) {
  uint at = csgGateAt(gate);
  bool touched = foldStates[at + 2u] == foldStates[csgBase + 3u];
  return int(foldStates[touched ? at + 1u : at]) <= 0;
}
bool csgIsTrue(uint gate) { return int(foldStates[csgGateAt(gate)]) <= 0; }

// An input of a gate became `value`; the change travels up to the first gate that holds.
void csgClimb(uint gate, bool value) {
  while (gate != CSG_NONE) {
    uint at = csgGateAt(gate);
    if (foldStates[at + 2u] != foldStates[csgBase + 3u]) {
      foldStates[at + 1u] = foldStates[at];
      foldStates[at + 2u] = foldStates[csgBase + 3u];
    }
    int lacking = int(foldStates[at]);
    int now = lacking + (value ? -1 : 1);
    foldStates[at] = uint(now);
    if ((lacking <= 0) == (now <= 0)) return;
    uint record = csg.gatesAt + 3u * gate;
    value = (now <= 0) != (csg.words[record + 1u] != 0u);
    gate = csg.words[record];
  }
}

void csgToggle(uint leaf, bool inside) {
  for (uint use = csg.words[3u * leaf + 1u]; use < csg.words[3u * leaf + 4u]; ++use) {
    csgClimb(csg.words[csg.usesAt + 2u * use], inside != (csg.words[csg.usesAt + 2u * use + 1u] != 0u));
  }
}

void csgWind(uint leaf, int change) {
  uint at = csgLeafAt(leaf);
  int winding = int(foldStates[at]);
  foldStates[at] = uint(winding + change);
  if (csgInside(winding) != csgInside(winding + change)) csgToggle(leaf, csgInside(winding + change));
}

// `fromStack` leaves add what gl_pass.cpp's crossing pass found (csg_crossings.glsl).
void foldInitial(uint side) {
  foldLoad(side);
  for (uint word = 0u; word < csgStateWords(); ++word) foldStates[csgBase + word] = 0u;
  foldStates[csgBase + 3u] = 1u;
  for (uint gate = 0u; gate < csg.gateCount; ++gate) foldStates[csgGateAt(gate)] = csg.words[csg.gatesAt + 3u * gate + 2u];
  for (uint leaf = 0u; leaf < csg.leafCount && side == COPEEL_FRONT; ++leaf) {
    if (csg.words[3u * leaf] != 0u) csgWind(leaf, int(csg.words[3u * leaf]));
  }
  ++foldStates[csgBase + 3u];
  csgNoteCut();
}

// Within a group order does not matter: the latest face of each leaf is kept.
void foldFront(uint id) {
  uint primitive = id & COPEEL_ID_PRIMITIVE;
  uint leaf = csgPrimitives[primitive].object;
  uint at = csgLeafAt(leaf);
  if (foldStates[at + 3u] == 0u && foldStates[at + 4u] == 0u) {
    foldStates[at + 2u] = foldStates[csgBase + 2u];
    foldStates[csgBase + 2u] = leaf + 1u;
  }
  bool entered = id == primitive;
  foldStates[at + 1u] = uint(int(foldStates[at + 1u]) + (entered ? 1 : -1));
  uint face = at + (entered ? 3u : 4u);
  foldStates[face] = max(foldStates[face], primitive + 1u);
}
void foldBehind(uint id) { foldFront(id); }

// True when the leaf's change in the group travels up to the output's gate: every gate on the way changes with its input.
bool csgBringsChange(uint leaf, uint top) {
  uint at = csgLeafAt(leaf);
  int now = int(foldStates[at]), change = int(foldStates[at + 1u]);
  int before = csgSide == COPEEL_FRONT ? now - change : now + change;
  if (csgInside(now) == csgInside(before)) return false;
  for (uint use = csg.words[3u * leaf + 1u]; use < csg.words[3u * leaf + 4u]; ++use) {
    bool value = csgInside(now) != (csg.words[csg.usesAt + 2u * use + 1u] != 0u);
    for (uint gate = csg.words[csg.usesAt + 2u * use]; gate != CSG_NONE; gate = csg.words[csg.gatesAt + 3u * gate]) {
      bool is = csgIsTrue(gate);
      if (csgWasTrue(gate) == is || is != value) break;
      if (gate == top) return true;
      value = is != (csg.words[csg.gatesAt + 3u * gate + 1u] != 0u);
    }
  }
  return false;
}

// The primitive that shows: of the last leaf that brings the change about, its latest face turned the way the leaf changes.
uint csgShowingFace(uint top) {
  uint best = CSG_NONE, fallback = 0u;
  for (uint link = foldStates[csgBase + 2u]; link != 0u; link = foldStates[csgLeafAt(link - 1u) + 2u]) {
    uint at = csgLeafAt(link - 1u);
    fallback = max(fallback, max(foldStates[at + 3u], foldStates[at + 4u]));
    if ((best == CSG_NONE || link - 1u > best) && csgBringsChange(link - 1u, top)) best = link - 1u;
  }
  if (best == CSG_NONE) return fallback - 1u;
  uint at = csgLeafAt(best);
  uint facing = int(foldStates[at + 1u]) > 0 ? foldStates[at + 3u] : foldStates[at + 4u];
  return (facing != 0u ? facing : max(foldStates[at + 3u], foldStates[at + 4u])) - 1u;
}

// Behind the open group, which the front side has just entered and the back side just left.
bool csgBehindTrue(uint gate) { return csgSide == COPEEL_FRONT ? csgIsTrue(gate) : csgWasTrue(gate); }
bool csgBehindInside(uint leaf) {
  uint at = csgLeafAt(leaf);
  return csgInside(int(foldStates[at]) + (csgSide == COPEEL_FRONT ? 0 : int(foldStates[at + 1u])));
}

// True when the inside of the leaf is there inside the output, and all on the way between them.
bool csgFills(uint leaf, uint top) {
  if (!csgBehindInside(leaf)) return false;
  for (uint use = csg.words[3u * leaf + 1u]; use < csg.words[3u * leaf + 4u]; ++use) {
    bool value = csg.words[csg.usesAt + 2u * use + 1u] == 0u;
    for (uint gate = csg.words[csg.usesAt + 2u * use]; gate != CSG_NONE && value && csgBehindTrue(gate); gate = csg.words[csg.gatesAt + 3u * gate]) {
      if (gate == top) return true;
      value = csg.words[csg.gatesAt + 3u * gate + 1u] == 0u;
    }
  }
  return false;
}

// A section's cap is of the last part that it cuts.
uint csgPartBehindCap(uint section, uint top) {
  for (uint leaf = csg.firstSection; leaf-- > 0u;) {
    if (csgFills(leaf, top)) return leaf;
  }
  return section;
}

// Adds a surface; true when nothing behind it matters (which on the back side forgets what lies behind).
bool csgShow(uint output_) {
  uint record = csg.outputsAt + 3u * output_;
  uint top = csg.words[record], kind = csg.words[record + 2u];
  uint primitive = csgShowingFace(top);
  uint leaf = csgPrimitives[primitive].object;
  if (leaf >= csg.firstSection) leaf = csgPartBehindCap(leaf, top);
  uint opacity = (csg.words[3u * leaf + 2u] >> (2u * (kind & 3u))) & 3u;
  if (opacity == CSG_UNSEEN || (opacity == CSG_TRANSLUCENT && (kind & 4u) != 0u)) return false;
  if (csgSide == COPEEL_BACK && opacity == CSG_OPAQUE) foldStates[csgBase] = 0u;
  uint count = foldStates[csgBase]++;
  if (count < csg.surfaceLimit) {
    uint at = csgBase + CSG_HEADER + CSG_SURFACE * count;
    foldStates[at] = primitive;
    foldStates[at + 1u] = csg.words[record + 1u];
    foldStates[at + 2u] = leaf;
  }
  return opacity == CSG_OPAQUE;
}

bool foldCloseGroup(uint key) {
  for (uint link = foldStates[csgBase + 2u]; link != 0u; link = foldStates[csgLeafAt(link - 1u) + 2u]) {
    int change = int(foldStates[csgLeafAt(link - 1u) + 1u]);
    csgWind(link - 1u, csgSide == COPEEL_FRONT ? change : -change);
  }
  bool enough = false;
  for (uint i = 0u; i < csg.outputCount && !enough; ++i) {
    uint output_ = csgSide == COPEEL_FRONT ? i : csg.outputCount - 1u - i;
    uint top = csg.words[csg.outputsAt + 3u * output_];
    if (top == CSG_NONE) continue;
    bool was = csgWasTrue(top), is = csgIsTrue(top);
    // Seen from the eye a result begins where it is false before and true behind.
    if (was != is && is == (csgSide == COPEEL_FRONT)) enough = csgShow(output_) && csgSide == COPEEL_FRONT;
  }
  for (uint link = foldStates[csgBase + 2u]; link != 0u;) {
    uint at = csgLeafAt(link - 1u);
    link = foldStates[at + 2u];
    foldStates[at + 1u] = foldStates[at + 2u] = foldStates[at + 3u] = foldStates[at + 4u] = 0u;
  }
  foldStates[csgBase + 2u] = 0u;
  ++foldStates[csgBase + 3u];
  if (enough) foldStates[csgBase + 1u] = 1u;
  return enough;
}

void csgResult(uint at, uint place, uint from) {
  for (uint i = 0u; i < CSG_SURFACE; ++i) foldResults[at + 1u + CSG_SURFACE * place + i] = foldStates[csgBase + CSG_HEADER + CSG_SURFACE * from + i];
}

// The front side's surfaces, then, unless it ended at an opaque one, the back side's, last found first.
void foldFinish() {
  uint at = pixelIndex() * (1u + CSG_SURFACE * csg.surfaceLimit);
  foldLoad(COPEEL_FRONT);
  uint count = foldStates[csgBase];
  bool ended = foldStates[csgBase + 1u] != 0u;
  for (uint i = 0u; i < min(count, csg.surfaceLimit); ++i) csgResult(at, i, i);
  foldLoad(COPEEL_BACK);
  uint behind = ended ? 0u : foldStates[csgBase];
  for (uint i = 0u; i < behind && count + i < csg.surfaceLimit && behind <= csg.surfaceLimit; ++i) csgResult(at, count + i, behind - 1u - i);
  foldResults[at] = count + behind;
  csgNoteCut();
}
