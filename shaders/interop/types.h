// SPDX-License-Identifier: MIT
// The words that C++ and GLSL share. Scalar layout: every field is aligned to its scalar, as C++
// lays arrays of float out.
#ifndef SLAMSCOPE_INTEROP_TYPES_H
#define SLAMSCOPE_INTEROP_TYPES_H

#ifdef __cplusplus
#include <array>
#include <cstdint>
namespace slamscope::engine::interop {
using uint = std::uint32_t;
using vec2 = std::array<float, 2>;
using vec3 = std::array<float, 3>;
using vec4 = std::array<float, 4>;
using mat3 = std::array<float, 9>;  // column by column
}  // namespace slamscope::engine::interop
#define SLAMSCOPE_INTEROP_BEGIN namespace slamscope::engine::interop {
#define SLAMSCOPE_INTEROP_END }
#else
#define SLAMSCOPE_INTEROP_BEGIN
#define SLAMSCOPE_INTEROP_END
#endif

#endif
