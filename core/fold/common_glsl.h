// What a fold's source needs to be C++ and GLSL at once: C++ includes this before it opens a namespace around the fold's .glsl.
// Vectors of floats go to double by constructors that both languages have; PRECISE keeps a shader compiler from fusing a product and a
// sum, as -ffp-contract=off does for C++: both give equal bits.
#ifndef COPEEL_FOLD_COMMON_GLSL_H
#define COPEEL_FOLD_COMMON_GLSL_H

#ifdef __cplusplus
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define INOUT(T) T&
#define PRECISE
#define FOLD_FUNCTION inline
#else
#define INOUT(T) inout T
#define PRECISE precise
#define FOLD_FUNCTION
#endif

#endif
