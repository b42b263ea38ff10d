// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>

#include "slam/jsonl.hpp"

namespace slamscope::slam {
namespace {

constexpr std::size_t kLongestNumber = 32;

/// Grows a string by bytes written in place; keeps the end by itself, because
/// string::append of a few bytes at a time is what writing would wait for.
class Text {
 public:
  explicit Text(std::string& text) : text_(text), size_(text.size()) {}
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  ~Text() { text_.resize(size_); }

  void put(std::string_view words) {
    room(words.size());
    words.copy(text_.data() + size_, words.size());
    size_ += words.size();
  }
  void put(char c) {
    room(1);
    text_[size_++] = c;
  }
  void number(double value) {
    if (std::isnan(value)) return put("NaN");
    if (std::isinf(value)) return put(value < 0.0 ? "-Infinity" : "Infinity");
    digits(value);
  }
  template <class Integer>
  void digits(Integer value) {
    room(kLongestNumber);
    const auto end =
        std::to_chars(text_.data() + size_, text_.data() + size_ + kLongestNumber, value).ptr;
    size_ = static_cast<std::size_t>(end - text_.data());
  }
  void quoted(std::string_view words) {
    put('"');
    for (const char c : words) escaped(c);
    put('"');
  }
  /// `[a, b]` of the elements; `write(element)` writes one.
  template <class List, class Write>
  void list(const List& elements, Write write) {
    put('[');
    bool first = true;
    for (const auto& element : elements) {
      if (!first) put(", ");
      first = false;
      write(element);
    }
    put(']');
  }
  template <class List>
  void numbers(const List& elements) {
    list(elements, [&](double value) { number(value); });
  }
  void ids(const std::vector<FeatureId>& elements) {
    list(elements, [&](FeatureId id) { digits(id); });
  }
  void points(const std::vector<Eigen::Vector2d>& elements) {
    list(elements, [&](const Eigen::Vector2d& point) { numbers(point); });
  }
  template <class Matrix>
  void rows(const Matrix& matrix) {
    put('[');
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      if (row != 0) put(", ");
      numbers(matrix.row(row));
    }
    put(']');
  }

 private:
  void room(std::size_t more) {
    if (size_ + more > text_.size()) text_.resize(2 * (size_ + more));
  }
  void escaped(char c) {
    constexpr std::string_view kHex = "0123456789abcdef";
    if (c == '"' || c == '\\') {
      put('\\');
      put(c);
    } else if (static_cast<unsigned char>(c) < 0x20) {
      put("\\u00");
      put(kHex[static_cast<unsigned char>(c) >> 4U]);
      put(kHex[static_cast<unsigned char>(c) & 0xfU]);
    } else {
      put(c);
    }
  }

  std::string& text_;
  std::size_t size_;
};

void putObservation(Text& text, const ObservationRecord& observation) {
  text.put("{\"id\": ");
  text.digits(observation.id);
  text.put(", \"z\": ");
  text.numbers(observation.z);
  text.put(", \"innovation\": ");
  text.numbers(observation.innovation);
  text.put(", \"S\": ");
  text.rows(observation.S);
  text.put(", \"R\": ");
  text.rows(observation.R);
  if (observation.H.size() != 0) {
    text.put(", \"H\": ");
    text.rows(observation.H);
  }
  text.put('}');
}

void putCovariance(Text& text, const Snapshot& snapshot) {
  if (!snapshot.diagonal_only) {
    text.put(", \"covariance\": ");
    text.numbers(snapshot.covariance.packed());
    if (!snapshot.asymmetry) return;
    text.put(", \"asymmetry\": ");  // a triangle can't tell
    text.number(*snapshot.asymmetry);
    return;
  }
  std::vector<double> diagonal;
  for (int k = 0; k < snapshot.covariance.size(); ++k) {
    diagonal.push_back(snapshot.covariance(k, k));
  }
  text.put(", \"covariance_diagonal\": ");
  text.numbers(diagonal);
}

void putOptional(Text& text, const Snapshot& snapshot) {
  if (snapshot.observed_given) {
    text.put(", \"observed\": ");
    text.ids(snapshot.observed);
  }
  if (!snapshot.tentative.empty()) {
    text.put(", \"tentative\": ");
    text.ids(snapshot.tentative);
  }
  if (!snapshot.observations.empty()) {
    text.put(", \"observations\": ");
    text.list(snapshot.observations,
              [&](const ObservationRecord& record) { putObservation(text, record); });
  }
  if (snapshot.control) {
    text.put(", \"control\": ");
    text.numbers(*snapshot.control);
  }
  if (snapshot.Q) {
    text.put(", \"Q\": ");
    text.rows(*snapshot.Q);
  }
  if (snapshot.truth) {
    text.put(", \"truth\": {\"pose\": ");
    text.numbers(snapshot.truth->pose);
    text.put(", \"ids\": ");
    text.ids(snapshot.truth->ids);
    text.put(", \"features\": ");
    text.points(snapshot.truth->features);
    text.put('}');
  }
}

}  // namespace

std::string formatHeader(const RunHeader& header) {
  std::string line;
  Text text(line);
  text.put(R"({"format": "slamscope", "version": )");
  text.digits(header.version);
  text.put(", \"sensor\": ");
  text.quoted(sensorName(header.sensor));
  if (!header.robot.empty()) {
    text.put(", \"robot\": ");
    text.quoted(header.robot);
  }
  if (header.R) {
    text.put(", \"R\": ");
    text.rows(*header.R);
  }
  if (header.Q) {
    text.put(", \"Q\": ");
    text.rows(*header.Q);
  }
  if (!header.means_known) text.put(R"(, "means": "unknown")");
  text.put('}');
  return line;
}

void appendRecord(std::string& line, const Snapshot& snapshot) {
  Text text(line);
  text.put("{\"time_s\": ");
  text.number(std::chrono::duration<double>(snapshot.time).count());
  text.put(", \"stamp_ns\": ");
  text.digits(snapshot.time.count());
  text.put(", \"sequence\": ");
  text.digits(snapshot.sequence);
  text.put(", \"event\": ");
  text.quoted(eventName(snapshot.event));
  text.put(", \"pose\": ");
  text.numbers(snapshot.pose);
  text.put(", \"ids\": ");
  text.ids(snapshot.ids);
  text.put(", \"features\": ");
  text.points(snapshot.features);
  if (!snapshot.extra.empty()) {
    text.put(", \"extra\": ");
    text.list(snapshot.extra, [&](const std::string& name) { text.quoted(name); });
  }
  putCovariance(text, snapshot);
  putOptional(text, snapshot);
  text.put('}');
}

std::string formatRecord(const Snapshot& snapshot) {
  std::string line;
  appendRecord(line, snapshot);
  return line;
}

}  // namespace slamscope::slam
