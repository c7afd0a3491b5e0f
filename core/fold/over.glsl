// The fold of transparency: fragments blended by "over", in the common subset of C++ and GLSL (C++: core/fold/over.h).
//
// Based on: Porter, Duff. Compositing Digital Images. SIGGRAPH 1984. Changed: the state is double, so that a stack cut in two and joined (dual
// peeling) differs from one walked front to back by 1e-13 of a level, which no 8-bit pixel shows.
// Fragments come front to back (overFragment), or back to front (overBehind). Of coplanar ones, the later primitive lies in front. Lost: what
// lies behind a transmittance of 0. Cost: about 10 operations a fragment, 32 bytes a state.

struct OverState {
  dvec3 color;            // 0 … 255, premultiplied
  double transmittance;   // share of the light from behind that passes
};

// A face's own colour (0 … 255, and alpha) under the light on its plane. A light brighter than white stops at each channel's own limit, as
// openscad's does.
FOLD_FUNCTION vec4 overShade(vec4 base, float shade) {
  PRECISE vec3 lit = min(vec3(base) * shade, vec3(255.0));
  return vec4(lit, base.a);
}

FOLD_FUNCTION void overBegin(INOUT(OverState) state) {
  state.color = dvec3(0.0);
  state.transmittance = 1.0;
}

// A fragment behind all that the state holds; its colour is straight, not premultiplied.
FOLD_FUNCTION void overFragment(INOUT(OverState) state, vec4 fragment) {
  PRECISE double alpha = double(fragment.a);
  PRECISE double weight = state.transmittance * alpha;
  PRECISE dvec3 color = state.color + dvec3(fragment) * weight;
  PRECISE double transmittance = state.transmittance * (1.0 - alpha);
  state.color = color;
  state.transmittance = transmittance;
}

// A fragment in front of all that the state holds: for the back half of a stack, walked from behind.
FOLD_FUNCTION void overBehind(INOUT(OverState) state, vec4 fragment) {
  PRECISE double alpha = double(fragment.a);
  PRECISE double passes = 1.0 - alpha;
  PRECISE dvec3 color = dvec3(fragment) * alpha + state.color * passes;
  PRECISE double transmittance = state.transmittance * passes;
  state.color = color;
  state.transmittance = transmittance;
}

// The whole stack from its two halves.
FOLD_FUNCTION OverState overJoin(OverState front, OverState back) {
  OverState whole;
  PRECISE dvec3 color = front.color + back.color * front.transmittance;
  PRECISE double transmittance = front.transmittance * back.transmittance;
  whole.color = color;
  whole.transmittance = transmittance;
  return whole;
}

// Nothing behind can be seen.
FOLD_FUNCTION bool overEnough(OverState state) { return state.transmittance == 0.0; }

// 0 … 255 over the background.
FOLD_FUNCTION dvec3 overResult(OverState state, vec3 background) {
  PRECISE dvec3 color = state.color + dvec3(background) * state.transmittance;
  return color;
}

// The nearest levels of 8 bits. Halves go up, and so does what the rounding of a long stack may have left just below one: alphas such as 0.5
// make halves often, and a stack joined from two parts must not show there.
FOLD_FUNCTION uvec3 overLevels(dvec3 color) {
  const double kHalfUp = 0.5 + 1.0 / 8589934592.0;   // 2^-33 of a level
  PRECISE dvec3 up = clamp(color, dvec3(0.0), dvec3(255.0)) + dvec3(kHalfUp);
  return uvec3(up);
}
