// Sine and cosine of degrees, exact where the angle is a multiple of 30 or 45 degrees: openscad 2021.01's way, so that our vertices are
// its vertices to the bit. Quadrants are folded in degrees, before anything is rounded.
#pragma once

namespace copeel::csg {

double sinDegrees(double degrees);   // NaN beyond 2^52 turns, as openscad
double cosDegrees(double degrees);

}  // namespace copeel::csg
