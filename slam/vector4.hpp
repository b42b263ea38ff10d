// SPDX-License-Identifier: MIT
#pragma once

/// Before a function: compiled twice, with AVX2's fused multiply-add and without, the machine's own
/// taken at run time; Debian's compilers build for any x86-64. Not under sanitizers, which run
/// before the resolvers of multi-versioned functions may.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SLAMSCOPE_FMA_CLONES [[gnu::target_clones("fma", "default")]]
#else
#define SLAMSCOPE_FMA_CLONES
#endif

namespace slamscope::slam {

/// Four doubles, wherever they lie.
using Vector4 [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

[[gnu::always_inline]] inline Vector4& vector4At(double* place) {
  return *reinterpret_cast<Vector4*>(place);
}

[[gnu::always_inline]] inline const Vector4& vector4At(const double* place) {
  return *reinterpret_cast<const Vector4*>(place);
}

}  // namespace slamscope::slam
