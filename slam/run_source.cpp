// SPDX-License-Identifier: MIT
#include "slam/run_source.hpp"

#include <filesystem>
#include <stdexcept>

#include "slam/formats/mat_run.hpp"
#include "slam/formats/mrpt_directory.hpp"
#include "slam/formats/numpy_run.hpp"
#include "slam/json_lines_run.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;

/// A missing file is said to be missing before its ending is looked at.
bool hasUnknownEnding(const std::string& path) {
  return fs::is_regular_file(path) && !path.ends_with(".jsonl") && !path.ends_with(".jsonl.zst");
}

}  // namespace

std::unique_ptr<RunSource> openRun(const std::string& path) {
  if (fs::is_directory(path)) return openMrptDirectory(path);
  if (path.ends_with(".npz") || path.ends_with(".npy")) return openNumpyRun(path);
  if (path.ends_with(".mat")) return openMatRun(path);
  if (hasUnknownEnding(path)) {
    const std::string ending = fs::path(path).extension();
    throw std::runtime_error(path + ": " + (ending.empty() ? "a name without ending" : ending) +
                             " is not supported; runs end in .jsonl, .jsonl.zst, .npz, .npy or "
                             ".mat, or are a directory of MRPT's kf-slam");
  }
  return std::make_unique<JsonLinesRun>(path);
}

}  // namespace slamscope::slam
