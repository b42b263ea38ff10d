// SPDX-License-Identifier: MIT
//
// Logs an EKF-SLAM filter for slamscope: one header, C++17, no dependency, three calls (level L2).
//
//   slamscope::Log record("run.jsonl", "range-bearing");
//   while (driving) {
//     predict(x, P, u);
//     record.predicted(x, P, t);              // after every prediction; t in seconds
//     for (const auto& [z, id] : sightings) {
//       if (known.count(id)) {
//         update(x, P, z, id);
//         record.updated(x, P, {id});         // after every update: the ids observed in it
//       } else {
//         initialise(x, P, z);
//         record.initialised(x, P, {id});     // after every new feature: its id
//       }
//     }
//   }
//
// Then: slamscope audit run.jsonl
//
// x is the state [x, y, heading, l1x, l1y, l2x, l2y, …] in m and rad, P its full covariance. x:
// anything with size() and x(i) or x[i]; P: P(i, j), P[i][j], or a flat list, row by row: Eigen,
// std::vector and the like. Without t, predictions are counted; without ids, features are called
// 1, 2, … by their place in the state. Where features leave it: record.removed(x, P, {ids}).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <locale>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace slamscope {

class Log {
 public:
  using Ids = std::vector<std::uint64_t>;

  /// `sensor`: range-bearing, relative-position or unknown. `header`: more fields of the first
  /// line, as JSON: R"("R": [[0.01, 0], [0, 0.0004]])". Throws where the file can't be written.
  explicit Log(const std::string& file, const std::string& sensor = "unknown",
               const std::string& header = {})
      : file_(file) {
    if (!file_) throw std::runtime_error("slamscope_log: " + file + ": can't be written");
    file_.imbue(std::locale::classic());
    file_.precision(std::numeric_limits<double>::max_digits10);
    file_ << R"({"format": "slamscope", "version": 1, "sensor": ")" << sensor << '"'
          << (header.empty() ? "" : ", ") << header << "}" << std::endl;
  }

  template <class X, class M>
  void predicted(const X& x, const M& P) {
    predicted(x, P, time_ + 1.0);
  }
  template <class X, class M>
  void predicted(const X& x, const M& P, double t) {
    time_ = t;
    write("predict", x, P, nullptr);
  }
  template <class X, class M>
  void updated(const X& x, const M& P) {
    write("update", x, P, nullptr);
  }
  template <class X, class M>
  void updated(const X& x, const M& P, const Ids& observed) {
    write("update", x, P, &observed);
  }
  template <class X, class M>
  void initialised(const X& x, const M& P, const Ids& new_ids = {}) {
    named_ = named_ || !new_ids.empty();
    ids_.insert(ids_.end(), new_ids.begin(), new_ids.end());
    write("initialise", x, P, nullptr);
  }
  template <class X, class M>
  void removed(const X& x, const M& P, const Ids& old_ids) {
    named_ = true;
    for (const std::uint64_t id : old_ids) {
      ids_.erase(std::remove(ids_.begin(), ids_.end(), id), ids_.end());
    }
    write("remove", x, P, nullptr);
  }

 private:
  template <class X>
  static double at(const X& x, std::size_t i) {
    if constexpr (std::is_invocable_v<const X&, int>) {
      return static_cast<double>(x(static_cast<int>(i)));
    } else {
      return static_cast<double>(x[i]);
    }
  }

  template <class M, class = void>
  struct IsNested : std::false_type {};
  template <class M>
  struct IsNested<M, std::void_t<decltype(std::declval<const M&>()[0][0])>> : std::true_type{};

  template <class M>
  static double at(const M& P, std::size_t i, std::size_t j, std::size_t size) {
    if constexpr (std::is_invocable_v<const M&, int, int>) {
      return static_cast<double>(P(static_cast<int>(i), static_cast<int>(j)));
    } else if constexpr (IsNested<M>::value) {
      return static_cast<double>(P[i][j]);
    } else {
      return static_cast<double>(P[i * size + j]);
    }
  }

  void number(double value) {
    if (std::isnan(value)) {
      file_ << "NaN";
    } else if (std::isinf(value)) {
      file_ << (value < 0 ? "-Infinity" : "Infinity");
    } else {
      file_ << value;
    }
  }

  /// [f(0), f(1), …]
  template <class Function>
  void list(std::size_t count, Function f) {
    file_ << '[';
    for (std::size_t k = 0; k < count; ++k) {
      if (k != 0) file_ << ", ";
      f(k);
    }
    file_ << ']';
  }

  template <class X, class M>
  void write(const char* event, const X& x, const M& P, const Ids* observed) {
    const auto size = static_cast<std::size_t>(x.size());
    const std::size_t features = size < 3 ? 0 : (size - 3) / 2;
    while (!named_ && ids_.size() < features) ids_.push_back(ids_.size() + 1);
    if (size != 3 + 2 * ids_.size()) {
      throw std::invalid_argument("slamscope_log: x has " + std::to_string(size) +
                                  " numbers, expected " + std::to_string(3 + 2 * ids_.size()) +
                                  ": 3, and 2 for each feature whose id is known");
    }
    file_ << "{\"time_s\": " << time_ << ", \"event\": \"" << event << "\", \"pose\": ";
    list(3, [&](std::size_t k) { number(at(x, k)); });
    file_ << ", \"ids\": ";
    list(features, [&](std::size_t k) { file_ << ids_[k]; });
    file_ << ", \"features\": ";
    list(2 * features, [&](std::size_t k) { number(at(x, 3 + k)); });
    file_ << ", \"covariance\": ";
    list(size * size, [&](std::size_t k) { number(at(P, k / size, k % size, size)); });
    if (observed != nullptr) {
      file_ << ", \"observed\": ";
      list(observed->size(), [&](std::size_t k) { file_ << (*observed)[k]; });
    }
    file_ << "}" << std::endl;
  }

  std::ofstream file_;
  double time_ = 0.0;
  Ids ids_;
  bool named_ = false;
};

}  // namespace slamscope
