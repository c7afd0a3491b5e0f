// The catalogue of hard CSG cases: small scenes that break other programs, as .csg texts with all their digits, each with the views it is hard
// from and, where an exact kernel can say it in other words, the solid that is meant.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "validation/views.h"

namespace copeel::validation {

struct HardCase {
  std::string text;                       // what the renderer gets
  std::string intended;                   // what is meant, for an exact Boolean, before `motion`; empty: only the exact crossings judge
  glm::dmat4 motion{1.0};                 // from the intended scene to the rendered one
  std::vector<Look> looks;                // in the rendered scene
};

// From above and the side, from below, along the axis (orthographic), and along the axis in perspective; of a part of this size about the origin.
std::vector<Look> usualLooks(double size = 40, const glm::dmat4& motion = glm::dmat4(1.0));

// The rows of the table of hard CSG cases.
HardCase coplanarDifference(double scale = 1);
HardCase coplanarTurnedWhole();
HardCase coplanarTurnedLeafByLeaf();
HardCase cutterTooLong();          // by 1e-6
HardCase filmThatStays();          // of 1e-6
HardCase movedFar();               // by 1e6
HardCase selfIntersecting();       // a prism over a bow tie, cut out of a plate
HardCase insideOut();
HardCase starPrism();              // winding number 2 in the core
HardCase faceMissing();
HardCase torus();                  // convexity left at 1
HardCase eyeInsideCutter();

// A film of this thickness over a hole, the whole tilted by degrees about x and y.
HardCase film(double thickness, double tilt);

// A polyhedron's text; faces counter-clockwise seen from outside, as the formats other than OpenSCAD's have them.
std::string polyhedron(const std::vector<glm::dvec3>& points, const std::vector<std::vector<int>>& faces);
// A prism over a polygon (counter-clockwise) from z = low to high; the polygon may cross itself when its caps are given as polygons of their own.
std::string prism(const std::vector<glm::dvec2>& outline, const std::vector<std::vector<int>>& caps, double low, double high);
// The same with one cap that is the outline itself.
std::string prism(const std::vector<glm::dvec2>& outline, double low, double high);
std::string box(const glm::dvec3& low, const glm::dvec3& high);
std::string moved(const std::string& text, const glm::dmat4& motion);
std::string join(const std::string& operation, const std::vector<std::string>& operands);

}  // namespace copeel::validation
