// The fold of a pixel on the device; the define FOLD names its file. A fold defines, for the pixel the invocation stands on:
//
//   void foldInitial(uint side)       its state at the beginning
//   void foldLoad(uint side)          the state from memory; COPEEL_FRONT meets groups front to back, COPEEL_BACK back to front
//   void foldFront(uint id)           the next fragment of the open group from its front end: ids without side bit descend (DESIGN.md: later lies in front)
//   void foldBehind(uint id)          the next one from the group's rear end: ids ascend
//   bool foldCloseGroup(uint key)     the group is complete; true: enough, nothing behind (COPEEL_BACK: before) it matters
//   void foldStore(uint side)
//   void foldFinish()                 joins both sides and writes the pixel's result
//
// and, where its state is not in memory alone, for methods that deliver a pixel in one invocation, by foldFront() alone (FOLD_WHOLE):
//
//   void foldReset(uint side)         the state at its beginning, and not to memory
//   void foldFinishFront()            writes the result of the side that was reset and delivered to
//   void foldNothing()                the result of a pixel without fragments: its counts, of which the application sees that the rest is not to be read
//
// A front side may be given all its groups in one invocation (A-buffers) or over many passes. A group is never split between the sides.
#ifndef FOLD_WORDS
#define FOLD_WORDS uint   // what states and results are arrays of: a fold that says uvec4 has them read and written four words at a time
#endif
layout(std430, binding = COPEEL_BUFFER_FOLD_STATE) buffer FoldStates { FOLD_WORDS foldStates[]; };
layout(std430, binding = COPEEL_BUFFER_FOLD_RESULT) writeonly buffer FoldResults { FOLD_WORDS foldResults[]; };

// Where the state of a side starts, its length given; both in FOLD_WORDS.
uint foldStateAt(uint side, uint length) { return (pixelIndex() * 2u + side) * length; }

#include FOLD

// Ends the invocation of a pixel without fragments. On llvmpipe `discard` is a jump where it holds for all lanes, and `return` is not.
void foldSkip() {
#ifdef FOLD_WHOLE
  foldNothing();
#endif
  discard;
}

// Around the delivery of a pixel, in one invocation, from memory or without.
void foldOpen() {
#ifdef FOLD_WHOLE
  foldReset(COPEEL_FRONT);
#else
  foldLoad(COPEEL_FRONT);
#endif
}
void foldShut() {
#ifdef FOLD_WHOLE
  foldFinishFront();
#else
  foldStore(COPEEL_FRONT);
#endif
}
