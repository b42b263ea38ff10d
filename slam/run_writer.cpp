// SPDX-License-Identifier: MIT
#include "slam/run_writer.hpp"

#include "slam/jsonl.hpp"

namespace slamscope::slam {

RunWriter::RunWriter(const std::string& path, const RunHeader& header)
    : output_(path, runFormat(path) == RunFormat::json_lines_zst) {
  output_.write(formatHeader(header) + '\n');
}

void RunWriter::write(const Snapshot& snapshot) {
  text_.clear();
  appendRecord(text_, snapshot);
  text_ += '\n';
  output_.write(text_);
  ++records_;
}

void RunWriter::finish() {
  output_.finish();
}

}  // namespace slamscope::slam
