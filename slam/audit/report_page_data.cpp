// SPDX-License-Identifier: MIT
#include "slam/audit/report_page_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "slam/audit/chi_square.hpp"
#include "slam/audit/law_words.hpp"

namespace slamscope::slam {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kEvents{"initial",     "prediction", "update",
                                                  "new feature", "removal",    "time step"};

/// Six digits are more than a plot shows; JSON has no word for what is not finite.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

/// log10 of the least and the greatest size that has one.
struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  [[nodiscard]] std::uint16_t code(float size) const {
    if (!std::isfinite(size)) return 1;
    if (!(size >= 0.0F)) return 2;
    if (size == 0.0F) return 3;
    const double share = hi > lo ? (std::log10(size) - lo) / (hi - lo) : 0.0;
    return static_cast<std::uint16_t>(4 + std::lround(share * 65531.0));
  }
};

Range rangeOf(const std::vector<SeriesRecord>& records) {
  Range range;
  for (const SeriesRecord& record : records) {
    for (const float size : record.sizes) {
      if (!std::isfinite(size) || !(size > 0.0F)) continue;
      range.lo = std::min(range.lo, static_cast<double>(std::log10(size)));
      range.hi = std::max(range.hi, static_cast<double>(std::log10(size)));
    }
  }
  if (!(range.lo <= range.hi)) range = {0.0, 0.0};
  return range;
}

std::string base64(const std::vector<float>& sizes, const Range& range) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned> bytes;
  bytes.reserve(2 * sizes.size());
  for (const float size : sizes) {
    const unsigned code = range.code(size);
    bytes.push_back(code & 0xffU);
    bytes.push_back(code >> 8U);
  }
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t rest = std::min<std::size_t>(3, bytes.size() - k);
    unsigned group = bytes[k] << 16U;
    if (rest > 1) group |= bytes[k + 1] << 8U;
    if (rest > 2) group |= bytes[k + 2];
    for (std::size_t d = 0; d < 4; ++d) {
      text += d <= rest ? kDigits[(group >> (18U - 6U * d)) & 63U] : '=';
    }
  }
  return text;
}

/// Where 99 % of χ² per degree of freedom lie.
Json band(int dof) {
  return {number(chiSquareQuantile(0.995, dof) / dof), number(chiSquareQuantile(0.005, dof) / dof)};
}

Json lawsJson(const AuditReport& report) {
  Json laws = Json::array();
  for (const LawReport& law : report.laws) {
    Json json{{"name", lawName(law.law)}, {"words", lawWords(law.law)}};
    if (law.status == LawStatus::violated) {
      json["class"] = faultClassName(*law.fault_class);
      json["first"] = law.first_record.value_or(0);
    }
    laws.push_back(std::move(json));
  }
  return laws;
}

/// Features that the report blames, with the record of the first law that does.
Json blamedJson(const AuditReport& report) {
  std::map<FeatureId, std::uint64_t> first;
  for (const LawReport& law : report.laws) {
    if (law.status != LawStatus::violated) continue;
    for (const Blame& b : law.blame) {
      const std::uint64_t record = law.first_record.value_or(0);
      const auto [entry, fresh] = first.try_emplace(b.feature, record);
      if (!fresh) entry->second = std::min(entry->second, record);
    }
  }
  Json blamed = Json::array();
  for (const auto& [feature, record] : first) {
    blamed.push_back({{"id", feature}, {"first", record}});
  }
  return blamed;
}

Json headingJson(const AuditReport& report, const std::vector<SeriesRecord>& records) {
  const LawReport& law = report.law(Law::heading_floor);
  Json json{{"floor", nullptr}, {"reason", law.reason}};
  const auto finite = std::find_if(records.begin(), records.end(), [](const SeriesRecord& r) {
    return std::isfinite(r.variance[2]);
  });
  if (law.checked > 0 && finite != records.end())
    json["floor"] = number(0.99 * finite->variance[2]);
  return json;
}

class RecordWriter {
 public:
  explicit RecordWriter(Range range) : range_(range) {}

  Json write(const SeriesRecord& r) {
    Json json{{"n", r.record},
              {"t", number(r.time_s)},
              {"e", kEvents.at(static_cast<std::size_t>(r.event))},
              {"f", r.feature_count},
              {"c", r.stretch.records}};
    for (const auto& [name, vector] : {std::pair{"p", r.pose}, std::pair{"v", r.variance}}) {
      json[name] = {number(vector[0]), number(vector[1]), number(vector[2])};
    }
    if (r.observed_given) json["o"] = r.observed;
    if (r.observed_count > r.observed.size()) json["on"] = r.observed_count;
    if (r.stretch.dof > 0) {
      const auto [entry, fresh] = bands_.try_emplace(r.stretch.dof);
      if (fresh) entry->second = band(r.stretch.dof);
      json["q"] = {number(r.stretch.nis), r.stretch.dof, entry->second[0], entry->second[1]};
    }
    for (std::size_t law = 0; law < r.stretch.broken.size(); ++law) {
      if (r.stretch.broken[law]) json["l"].push_back(law);
    }
    if (!r.stretch.blamed.empty()) json["b"] = r.stretch.blamed;
    // Only where they are not those of the record before.
    if (r.ids != ids_) json["i"] = ids_ = r.ids;
    if (r.cluster != cluster_) json["k"] = cluster_ = r.cluster;
    json["m"] = base64(r.sizes, range_);
    for (const ClusterSizes& c : r.clusters) {
      json["g"].push_back({c.a, c.b, number(c.least), number(c.mean), number(c.greatest)});
    }
    return json;
  }

 private:
  Range range_;
  std::map<int, Json> bands_;
  std::vector<FeatureId> ids_;
  std::vector<int> cluster_;
};

}  // namespace

std::string pageData(const AuditReport& report, const ReportSeries& series,
                     std::string_view run_name) {
  const std::vector<SeriesRecord> records = series.records();
  const Range range = rangeOf(records);
  Json json{{"run", run_name},
            {"records", report.records},
            {"verdict", verdictName(report.verdict)},
            {"means_known", !report.level.starts_with("LC")},
            {"diagonal_only", series.diagonalOnly()},
            {"most_features", ReportSeries::kMostFeatures},
            {"laws", lawsJson(report)},
            {"blamed", blamedJson(report)},
            {"heading", headingJson(report, records)},
            {"range", {range.lo, range.hi}},
            {"kept", Json::array()}};
  RecordWriter writer(range);
  for (const SeriesRecord& record : records) json["kept"].push_back(writer.write(record));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace slamscope::slam
