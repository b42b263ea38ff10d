// SPDX-License-Identifier: MIT
#include "slam/json_lines_run.hpp"

#include <stdexcept>
#include <utility>

namespace slamscope::slam {
namespace {

constexpr std::size_t kReadAtOnce = std::size_t{256} << 10U;

}  // namespace

JsonLinesRun::JsonLinesRun(std::string path)
    : path_(std::move(path)), input_(path_), decoder_(path_) {
  ahead_ = readRecord();
  if (decoder_.begun()) return;
  throw std::runtime_error(path_ + (warnings_.empty() ? ": expected a header and records, found "
                                                        "an empty file"
                                                      : ": expected a header and records, found "
                                                        "nothing but a line that is cut off"));
}

SnapshotPtr JsonLinesRun::next() {
  return ahead_ ? std::exchange(ahead_, nullptr) : readRecord();
}

SnapshotPtr JsonLinesRun::readRecord() {
  while (!ended_) {
    while (const auto line = nextLine()) {
      if (auto snapshot = decoder_.decode(*line)) return snapshot;
    }
    const std::size_t size = input_.read(lines_.room(kReadAtOnce));
    lines_.commit(size);
    if (size != 0) continue;
    ended_ = true;
    auto snapshot = lastLine();
    finish();
    return snapshot;
  }
  return nullptr;
}

std::optional<std::string_view> JsonLinesRun::nextLine() {
  try {
    return lines_.next();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path_ + ":" + std::to_string(decoder_.lines() + 1) + ": " +
                             error.what());
  }
}

/// A last line without an end: whole (some languages end no line after the last), or cut off.
SnapshotPtr JsonLinesRun::lastLine() {
  const std::string_view line = lines_.rest();
  if (isCutOff(line) || (input_.cutOff() && !line.empty() && line.find('{') == line.npos)) {
    warnings_.push_back(path_ + ":" + std::to_string(decoder_.lines() + 1) +
                        ": the last line is cut off after " + std::to_string(line.size()) +
                        " bytes and was left out; " + std::to_string(decoder_.records()) +
                        " records before it are used");
    return nullptr;
  }
  return decoder_.decode(line);
}

void JsonLinesRun::finish() {
  if (input_.cutOff() && warnings_.empty()) {
    warnings_.push_back(path_ + ": the compressed file is cut off after " +
                        std::to_string(decoder_.records()) + " records; what follows is lost");
  }
  if (const auto count = decoder_.equalStamps(); count != 0) {
    warnings_.push_back(path_ + ": " + std::to_string(count) +
                        " records have the same time as the one before");
  }
}

}  // namespace slamscope::slam
