// A pixel pass: what the file PIXEL_PASS does, for each pixel. Helper invocations do nothing: on a GPU they stand on pixels at the edge of those that are drawn,
// where no pass before has written anything, what they write is lost, and a loop that waits for it never ends. (llvmpipe masks them out.)
#define main pixelMain
#include PIXEL_PASS
#undef main

void main() {
  if (!gl_HelperInvocation) pixelMain();
}
