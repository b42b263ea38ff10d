// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "slam/run_source.hpp"

namespace slamscope::slam {

/// A run that Python saved:
///
///   np.savez("run.npz", x=xs, P=Ps)            xs: steps × N, Ps: steps × N × N, padded with NaN
///   np.savez("run.npz", **{f"x_{k}": …, f"P_{k}": …})     one array a step, of whatever size
///   np.save("P.npy", Ps)                       beside "x.npy"; alone it is level LC
///
/// with t (s), ids, event, observed and true (pose) beside them, where there are (array_names.hpp).
/// P may also be steps × N: its diagonal. A stack in C's order is read as it is used: memory does
/// not grow with the length of the run. Throws std::runtime_error "path: P: …".
[[nodiscard]] std::unique_ptr<RunSource> openNumpyRun(const std::string& path);

}  // namespace slamscope::slam
