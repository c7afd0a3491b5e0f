// A placed facet as it is measured for its plane class: the plane of its largest triangle, and its extent.
//
// Nothing is kept of a mesh: what is wanted again is measured again, which costs less than to write it down and read it back.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "core/scene/scene.h"

namespace copeel {

// The triangles of a facet: begin … end-1 of its mesh.
struct FacetRange {
  std::uint32_t begin, end;
};

FacetRange rangeOf(const Mesh& mesh, std::uint32_t facet);   // O(log triangles)
// The same where the facet's first triangle is known: a facet begins where the last one ends.
FacetRange rangeFrom(const Mesh& mesh, std::uint32_t begin, std::uint32_t facet);

struct FacetPlane {
  glm::dvec3 normal{0, 0, 1};   // unit, turned into one half of all directions, so that both sides of a plane have the same
  glm::dvec3 point{0};          // the first corner of its largest triangle
  double error = 0;             // bound of |normal - true normal|
  std::uint32_t triangle = 0;   // its largest one, within the object
  Box box;
};

FacetPlane planeOf(const Object& object, FacetRange range);

// How unsure the turning of a normal is: near zero it may be turned the other way by rounding.
double turnOf(const glm::dvec3& normal);

double doubledArea(const Object& object, std::uint32_t triangle);

struct FacetExtent {
  double flatness = 0;   // largest distance of a corner from the facet's own plane
  double radius = 0;     // largest distance of a corner from a point of that plane
  Box box;
};

FacetExtent extentOf(const Object& object, FacetRange range, const glm::dvec3& normal, const glm::dvec3& point);

}  // namespace copeel
