// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "slam/decimal_time.hpp"
#include "slam/jsonl.hpp"
#include "slam/jsonl_shapes.hpp"
#include "slam/jsonl_value.hpp"

namespace slamscope::slam {
namespace {

using json::fail;
using json::Numbers;
using json::Shapes;
using json::Value;

constexpr std::array<std::string_view, 6> kEvents{"initial",    "predict", "update",
                                                  "initialise", "remove",  "step"};
constexpr std::array<std::string_view, 2> kMeans{"known", "unknown"};
constexpr std::array<std::string_view, 3> kSensors{"unknown", "range-bearing", "relative-position"};

template <std::size_t Size>
std::size_t oneOf(const std::array<std::string_view, Size>& words, const std::string& word,
                  std::string_view field) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string expected = "one of";
  for (const auto known : words) expected.append(" ").append(known);
  fail(field, expected, '"' + word + '"');
}

std::chrono::nanoseconds seconds(Value& value) {
  const auto time = parseSeconds(json::token(value));
  if (!time) fail("time_s", "a finite number of seconds", json::token(value));
  return *time;
}

ObservationRecord observation(Value& value) {
  ObservationRecord result;
  bool has_id = false;
  json::forEachField(value, "observations", [&](std::string_view key, Value& field) {
    if (key == "id") {
      result.id = json::count(field, "observations.id");
      has_id = true;
    } else if (json::isNull(field)) {
      return;
    } else if (key == "z") {
      result.z = json::vector(field, "observations.z", 2);
    } else if (key == "innovation") {
      result.innovation = json::vector(field, "observations.innovation", 2);
    } else if (key == "S") {
      result.S = json::symmetric(field, "observations.S", 2);
    } else if (key == "R") {
      result.R = json::symmetric(field, "observations.R", 2);
    } else if (key == "H") {
      Numbers read;
      json::numbers(field, "observations.H", read);
      const auto cols = static_cast<Eigen::Index>(read.values.size() / 2);
      const bool two_rows = read.rows.size() == 2 && read.rows[0] == read.rows[1];
      if (read.values.size() % 2 != 0 || !(read.rows.empty() || two_rows)) {
        fail("observations.H", "2 rows of numbers", read.describe());
      }
      result.H = Eigen::Map<const Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>>(
          read.values.data(), 2, cols);
    }
  });
  if (!has_id) fail("observations.id", "the id of the feature", "none");
  return result;
}

Truth truth(Value& value, Numbers& features) {
  Truth result;
  json::forEachField(value, "truth", [&](std::string_view key, Value& field) {
    if (key == "pose") result.pose = json::vector(field, "truth.pose", 3);
    if (key == "ids") result.ids = json::ids(field, "truth.ids");
    if (key == "features") json::numbers(field, "truth.features", features);
  });
  result.features = json::points(features, result.ids.size(), "truth.features");
  json::checkDistinct(result.ids, "truth.ids");
  return result;
}

/// Fields that a record must not miss; false for another key.
bool readState(std::string_view key, Value& value, Snapshot& snapshot, Shapes& shapes) {
  if (key == "pose") {
    snapshot.pose = json::vector(value, key, 3);
    shapes.has_pose = true;
  } else if (key == "ids") {
    snapshot.ids = json::ids(value, key);
  } else if (key == "features") {
    if (!json::isNull(value)) json::numbers(value, key, shapes.features);
  } else if (key == "extra") {
    snapshot.extra = json::texts(value, key);
  } else if (key == "covariance") {
    if (json::isNull(value)) return true;
    json::numbers(value, key, shapes.covariance);
    shapes.has_covariance = true;
  } else if (key == "covariance_diagonal") {
    if (json::isNull(value)) return true;
    json::numbers(value, key, shapes.diagonal);
    shapes.has_diagonal = true;
  } else {
    return false;
  }
  return true;
}

/// Fields that a record may carry beside the state; others are ignored.
void readOptional(std::string_view key, Value& value, Snapshot& snapshot, Shapes& shapes) {
  if (json::isNull(value)) return;
  if (key == "event") {
    snapshot.event = static_cast<Event>(oneOf(kEvents, json::text(value, key), key));
  } else if (key == "sequence") {
    snapshot.sequence = json::count(value, key);
  } else if (key == "observed") {
    snapshot.observed = json::ids(value, key);
    snapshot.observed_given = true;
  } else if (key == "tentative") {
    snapshot.tentative = json::ids(value, key);
  } else if (key == "observations") {
    json::forEach(value, key,
                  [&](Value& item) { snapshot.observations.push_back(observation(item)); });
  } else if (key == "control") {
    Numbers read;
    json::numbers(value, key, read);
    snapshot.control = Eigen::Map<const Eigen::VectorXd>(
        read.values.data(), static_cast<Eigen::Index>(read.values.size()));
  } else if (key == "asymmetry") {
    snapshot.asymmetry = json::number(value, key);
  } else if (key == "Q") {
    snapshot.Q = json::symmetric(value, key, 3);
  } else if (key == "truth") {
    snapshot.truth = truth(value, shapes.truth_features);
  }
}

void readHeader(std::string_view key, Value& value, RunHeader& header) {
  if (key == "format") {
    const std::string format = json::text(value, key);
    if (format != "slamscope") fail(key, "\"slamscope\"", '"' + format + '"');
  } else if (json::isNull(value)) {
    return;
  } else if (key == "version") {
    const double version = json::number(value, key);
    if (version != 1.0) fail(key, "1, the only version this program reads", json::token(value));
  } else if (key == "sensor") {
    header.sensor = static_cast<Sensor>(oneOf(kSensors, json::text(value, key), key));
  } else if (key == "robot") {
    header.robot = json::text(value, key);
  } else if (key == "R") {
    header.R = json::symmetric(value, key, 2);
  } else if (key == "Q") {
    header.Q = json::symmetric(value, key, 3);
  } else if (key == "means") {
    header.means_known = oneOf(kMeans, json::text(value, key), key) == 0;
  }
}

void checkEnd(simdjson::ondemand::document& document) {
  const char* rest = nullptr;
  if (document.current_location().get(rest) != simdjson::SUCCESS) return;
  fail("line", "one object a line", "more text after it");
}

}  // namespace

struct LineParser::Buffers {
  simdjson::ondemand::parser parser;
  std::string padded;
  Shapes shapes;

  simdjson::ondemand::document open(std::string_view line) {
    if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    padded.reserve(line.size() + simdjson::SIMDJSON_PADDING);
    padded.assign(line);
    simdjson::ondemand::document document;
    json::check(parser.iterate(padded.data(), padded.size(), padded.capacity()).get(document),
                "line");
    return document;
  }
};

LineParser::LineParser() : buffers_(std::make_unique<Buffers>()) {}
LineParser::~LineParser() = default;
LineParser::LineParser(LineParser&&) noexcept = default;
LineParser& LineParser::operator=(LineParser&&) noexcept = default;

std::optional<RunHeader> LineParser::header(std::string_view line) {
  if (line.find("\"format\"") == line.npos) return std::nullopt;
  auto document = buffers_->open(line);
  bool is_header = false;
  json::forEachField(document, "line",
                     [&](std::string_view key, Value&) { is_header |= key == "format"; });
  if (!is_header) return std::nullopt;
  checkEnd(document);
  document.rewind();
  RunHeader header;
  json::forEachField(document, "line",
                     [&](std::string_view key, Value& value) { readHeader(key, value, header); });
  return header;
}

Snapshot LineParser::record(std::string_view line, std::uint64_t default_sequence) {
  auto document = buffers_->open(line);
  Shapes& shapes = buffers_->shapes;
  shapes.reset();
  Snapshot snapshot;
  snapshot.sequence = default_sequence;
  bool has_stamp = false;
  json::forEachField(document, "line", [&](std::string_view key, Value& value) {
    if (key == "time_s") {
      if (!has_stamp) snapshot.time = seconds(value);
      shapes.has_time = true;
    } else if (key == "stamp_ns") {
      snapshot.time = std::chrono::nanoseconds(json::integer(value, key));
      has_stamp = shapes.has_time = true;
    } else if (!readState(key, value, snapshot, shapes)) {
      readOptional(key, value, snapshot, shapes);
    }
  });
  checkEnd(document);
  if (!shapes.has_time) fail("time_s", "time_s or stamp_ns", "neither");
  if (!shapes.has_pose) fail("pose", "3 numbers", "nothing");
  snapshot.features = json::points(shapes.features, snapshot.ids.size(), "features");
  json::checkDistinct(snapshot.ids, "ids");
  json::setCovariance(snapshot, shapes);
  return snapshot;
}

bool isCutOff(std::string_view line) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quoted) {
      if (c == '\\') ++k;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return quoted || depth > 0;
}

std::string_view eventName(Event event) {
  return kEvents.at(static_cast<std::size_t>(event));
}
std::string_view sensorName(Sensor sensor) {
  return kSensors.at(static_cast<std::size_t>(sensor));
}

}  // namespace slamscope::slam
