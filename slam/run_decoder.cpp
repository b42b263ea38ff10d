// SPDX-License-Identifier: MIT
#include "slam/run_decoder.hpp"

#include <stdexcept>

namespace slamscope::slam {
namespace {

bool isBlank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == line.npos;
}

}  // namespace

RunDecoder::RunDecoder(std::string source, Runs allowed)
    : source_(std::move(source)), allowed_(allowed) {}

SnapshotPtr RunDecoder::decode(std::string_view line) {
  ++lines_;
  if (isBlank(line)) return nullptr;
  try {
    if (const auto header = parser_.header(line)) {
      if (begun_ && allowed_ == Runs::one) {
        throw std::runtime_error("format: expected a record, found a second header");
      }
      begin(*header);
      return nullptr;
    }
    auto next = std::make_shared<Snapshot>(parser_.record(line, run_records_));
    const bool again = allowed_ == Runs::many && next->event == Event::initial && !order_.empty();
    if (!begun_ || again) begin(header_);
    order_.take(next);
    ++records_;
    ++run_records_;
    return next;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(source_ + ":" + std::to_string(lines_) + ": " + error.what());
  }
}

void RunDecoder::begin(const RunHeader& header) {
  header_ = header;
  order_.restart();
  run_records_ = 0;
  begun_ = true;
  ++runs_;
}

}  // namespace slamscope::slam
