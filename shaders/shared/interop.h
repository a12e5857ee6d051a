// Lets GLSL and C++ include the files of this folder. In C++ they are inside namespace
// lamplighter::shared with GLM's types, which have the std430 layout as long as structs contain
// only vec4, mat4, and vec3 with a scalar after it.
#ifndef LAMPLIGHTER_SHARED_INTEROP_H
#define LAMPLIGHTER_SHARED_INTEROP_H

#ifdef __cplusplus
#include <glm/glm.hpp>
#define SHARED_BEGIN              \
  namespace lamplighter::shared { \
  using glm::abs;                 \
  using glm::acos;                \
  using glm::atan;                \
  using glm::clamp;               \
  using glm::cross;               \
  using glm::dot;                 \
  using glm::floor;               \
  using glm::greaterThan;         \
  using glm::isnan;               \
  using glm::log2;                \
  using glm::mat3;                \
  using glm::mat4;                \
  using glm::max;                 \
  using glm::min;                 \
  using glm::mix;                 \
  using glm::pow;                 \
  using glm::sqrt;                \
  using glm::uvec4;               \
  using glm::vec2;                \
  using glm::vec3;                \
  using glm::vec4;
#define SHARED_END }
#define SHARED_FUNCTION inline
#define SHARED_CONST inline constexpr
#define SHARED_ZERO \
  { 0.0f }
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FUNCTION
#define SHARED_CONST const
#define SHARED_ZERO
#endif

#endif
