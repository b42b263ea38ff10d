// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "slam/run_source.hpp"

namespace slamscope::slam {

/// A run that MATLAB or Octave saved (-v6 or -v7):
///
///   x{k} = x; P{k} = P;                         cell arrays, one step each
///   x(:,k) = x; P(:,:,k) = P;                   stacked and padded with NaN (or steps first)
///   data.state(k).x = x; data.state(k).P = P;   a struct array, as Tim Bailey's simulator keeps it
///
/// with t (s), ids, event, observed and true (pose) beside them, where there are (array_names.hpp),
/// or as fields. P may be the diagonal alone (level L0), x may be missing (level LC). The file is
/// read whole. Throws std::runtime_error "path: P: …".
[[nodiscard]] std::unique_ptr<RunSource> openMatRun(const std::string& path);

}  // namespace slamscope::slam
