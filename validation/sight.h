// One triangle as one view sees it: everything a ray asks of it is a linear form a·u + b·v + c in the ray's pixel coordinates (u, v) of
// core/scene/view.h. Written once for Bounded and once more, by the same template, for mpq_class.
//
// Legend: eye-relative corners A, B, C; ray direction D = f + u·r + v·d (perspective) or origin shifted by o = u·r + v·d (orthographic);
// N = (B - A) × (C - A). Edge form of P→Q: det(D, P, Q). The three edge forms sum to N·D, and all have its sign where the line meets
// the triangle. The crossing lies at t = depthTop / depthBottom, with depthBottom = N·D.
#pragma once

#include <array>

#include "core/scene/view.h"
#include "validation/bounded.h"

namespace copeel::validation {

template <class T>
using Vec = std::array<T, 3>;

template <class T>
Vec<T> operator-(const Vec<T>& p, const Vec<T>& q) {
  return {T(p[0] - q[0]), T(p[1] - q[1]), T(p[2] - q[2])};
}

template <class T>
T dot(const Vec<T>& p, const Vec<T>& q) {
  return T(p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
}

template <class T>
Vec<T> cross(const Vec<T>& p, const Vec<T>& q) {
  return {T(p[1] * q[2] - p[2] * q[1]), T(p[2] * q[0] - p[0] * q[2]), T(p[0] * q[1] - p[1] * q[0])};
}

template <class T>
Vec<T> vecOf(const glm::dvec3& p) {
  return {T(p.x), T(p.y), T(p.z)};
}

template <class T>
struct Form {
  T a, b, c;
  T at(const T& u, const T& v) const { return T(a * u + b * v + c); }
};

template <class T>
struct Sight {
  std::array<Form<T>, 3> edge;
  Form<T> depthTop, depthBottom;
  T normalSquared;
};

// The form of det(D, P, Q): linear in D (perspective) or in the origin's shift o (orthographic, where D = f).
template <class T>
Form<T> edgeForm(const View& view, const Vec<T>& p, const Vec<T>& q) {
  const Vec<T> f = vecOf<T>(view.forward), r = vecOf<T>(view.right), d = vecOf<T>(view.down);
  const Vec<T> pq = cross(p, q);
  if (view.perspective) return {dot(r, pq), dot(d, pq), dot(f, pq)};
  // f·((P-o)×(Q-o)) = f·(P×Q) + o·(f×(Q-P)).
  const Vec<T> shift = cross(f, q - p);
  return {dot(r, shift), dot(d, shift), dot(f, pq)};
}

template <class T>
Sight<T> sightOf(const View& view, const std::array<Vec<T>, 3>& worldCorners) {
  const Vec<T> eye = vecOf<T>(view.eye);
  const std::array<Vec<T>, 3> p{worldCorners[0] - eye, worldCorners[1] - eye, worldCorners[2] - eye};
  const Vec<T> f = vecOf<T>(view.forward), r = vecOf<T>(view.right), d = vecOf<T>(view.down);
  const Vec<T> n = cross(Vec<T>(p[1] - p[0]), Vec<T>(p[2] - p[0]));

  Sight<T> s;
  for (int i = 0; i < 3; ++i) s.edge[i] = edgeForm(view, p[i], p[(i + 1) % 3]);
  s.normalSquared = dot(n, n);
  const T zero(0.0), nr = dot(n, r), nd = dot(n, d), nf = dot(n, f), na = dot(n, p[0]);
  if (view.perspective) {
    s.depthTop = {zero, zero, na};
    s.depthBottom = {nr, nd, nf};
  } else {
    s.depthTop = {T(-nr), T(-nd), na};
    s.depthBottom = {zero, zero, nf};
  }
  return s;
}

}  // namespace copeel::validation
