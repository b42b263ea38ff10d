// SPDX-License-Identifier: MIT
#include "slam/formats/mrpt_directory.hpp"

#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "slam/formats/array_run.hpp"
#include "slam/formats/bytes.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;

/// `full_cov_00012.txt` by 12.
std::map<std::uint64_t, fs::path> covarianceFiles(const fs::path& folder) {
  constexpr std::string_view kStart = "full_cov_", kEnd = ".txt";
  std::map<std::uint64_t, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(kStart) || !name.ends_with(kEnd)) continue;
    const char* const first = name.data() + kStart.size();
    const char* const last = name.data() + name.size() - kEnd.size();
    std::uint64_t step = 0;
    const auto [end, error] = std::from_chars(first, last, step);
    if (error == std::errc() && end == last) files.emplace(step, entry.path());
  }
  return files;
}

std::string textOf(const fs::path& file) {
  std::string text(fs::file_size(file), '\0');
  text.resize(FileBytes(file).read(text));
  return text;
}

struct Table {
  std::vector<double> numbers;
  std::size_t rows = 0;
};

/// Numbers between blanks, rows of the same length. Throws "file:line: …".
Table readTable(const fs::path& file) {
  const std::string text = textOf(file);
  Table table;
  std::size_t columns = 0, in_row = 0, line = 1;
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(file.filename().string() + ":" + std::to_string(line) + ": " + what);
  };
  const auto end_row = [&] {
    if (in_row == 0) return;
    if (table.rows++ == 0) columns = in_row;
    if (in_row != columns) {
      fail("expected " + std::to_string(columns) + " numbers as in the first row, found " +
           std::to_string(in_row));
    }
    in_row = 0;
  };
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == '\n') {
      end_row();
      ++line;
    }
    if (std::isspace(static_cast<unsigned char>(*at)) != 0) {
      ++at;
      continue;
    }
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    const bool whole = stop == end || std::isspace(static_cast<unsigned char>(*stop)) != 0;
    if (error == std::errc::result_out_of_range) number = std::strtod(at, nullptr);
    if (stop == at || !whole)
      fail("expected a number, found '" + std::string(at, end).substr(0, 12) + "'");
    table.numbers.push_back(number);
    ++in_row;
    at = stop;
  }
  end_row();
  return table;
}

class CovarianceFiles : public Slices {
 public:
  explicit CovarianceFiles(std::vector<fs::path> files) : files_(std::move(files)) {}

  [[nodiscard]] std::span<const double> next() override {
    const fs::path& file = files_[step_++];
    table_ = readTable(file);
    if (table_.rows * table_.rows != table_.numbers.size()) {
      throw std::runtime_error(
          file.filename().string() + ": expected as many rows as columns, found " +
          std::to_string(table_.rows) + " rows of " +
          std::to_string(table_.numbers.size() / std::max<std::size_t>(1, table_.rows)));
    }
    return table_.numbers;
  }

 private:
  std::vector<fs::path> files_;
  Table table_;
  std::size_t step_ = 0;
};

/// In 3D the pose is seven numbers, and P has three rows a feature.
void refuse3D(const std::string& path, const fs::path& first) {
  std::string name = first.filename();
  name.replace(0, std::string("full_cov").size(), "robot_pose");
  const fs::path pose = first.parent_path() / name;
  if (!fs::is_regular_file(pose) || readTable(pose).numbers.size() == 3) return;
  throw std::runtime_error(path + ": " + name +
                           ": expected a pose of 3 numbers (kf_implementation = "
                           "CRangeBearingKFSLAM2D), found " +
                           std::to_string(readTable(pose).numbers.size()));
}

}  // namespace

std::unique_ptr<RunSource> openMrptDirectory(const std::string& path) {
  const auto files = covarianceFiles(path);
  if (files.empty()) {
    throw std::runtime_error(path +
                             ": expected a file, or a directory of MRPT's kf-slam with "
                             "full_cov_*.txt in it, found a directory without");
  }
  refuse3D(path, files.begin()->second);
  RunArrays arrays;
  arrays.steps = files.size();
  std::vector<fs::path> in_order;
  for (const auto& [step, file] : files) {
    arrays.times.push_back(static_cast<double>(step));
    in_order.push_back(file);
  }
  arrays.P = std::make_unique<CovarianceFiles>(std::move(in_order));
  arrays.warnings.push_back(path +
                            ": covariances alone (level LC): MRPT logs no means of features; "
                            "times are numbers of steps");
  return std::make_unique<ArrayRun>(path, std::move(arrays));
}

}  // namespace slamscope::slam
