// SPDX-License-Identifier: MIT
#include "apps/lib/view/legend.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/lib/view/panel_layout.hpp"
#include "engine/scene/text_layout.hpp"

namespace slamscope::apps {
namespace {

constexpr engine::Rgba kPanel{0.04F, 0.05F, 0.07F, 0.66F};
constexpr engine::Rgba kText{0.96F, 0.96F, 0.96F, 1.0F};

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/// A length with a unit that suits it.
std::string lengthText(double metres) {
  if (metres >= 1.0) return format("%.3g m", metres);
  if (metres >= 0.01) return format("%.3g cm", 100.0 * metres);
  return format("%.3g mm", 1000.0 * metres);
}

struct Row {
  engine::Rgba swatch{0.0F, 0.0F, 0.0F, 0.0F};
  std::string text;
};

std::string axisText(const slam::AxisScale& axis) {
  switch (axis.axis) {
    case slam::Axis::eigenvalue:
      return format("semi-axis = λ × gain %g", axis.gain);
    case slam::Axis::log:
      return format("semi-axis = log10(1 + %gσ / 1 mm) × 10 cm", axis.k) +
             (axis.gain == 1.0 ? "" : format(" × gain %g", axis.gain));
    case slam::Axis::sigma:
      break;
  }
  return format("semi-axis = %gσ", axis.k) +
         (axis.gain == 1.0 ? " in true length" : format(" × gain %g", axis.gain));
}

std::string mostText(engine::MostBy by) {
  switch (by) {
    case engine::MostBy::growth:
      return "that grew most since they were first drawn";
    case engine::MostBy::last_growth:
      return "that grew most since the record before";
    case engine::MostBy::area:
      break;
  }
  return "largest";
}

/// Which of the mode's pairs are shown, where not all are, and whether with lines.
void addChoice(const Legend& legend, std::vector<Row>& rows) {
  const auto add = [&rows](std::string text) {
    rows.emplace_back(engine::Rgba{.a = 0.0F}, std::move(text));
  };
  const PairThinning& thinning = legend.thinning;
  if (thinning.in_view) add("only those of features in the picture");
  if (thinning.least_area > 0.0) {
    add("only those of sqrt(det) ≥ (" + lengthText(std::sqrt(thinning.least_area)) + ")²");
  }
  if (thinning.most > 0) add(format("of them the %u ", thinning.most) + mostText(thinning.by));
  if (legend.lines_left_out)
    add("too many pairs for lines: each stands midway between its features");
}

std::vector<Row> rowsOf(const Legend& legend) {
  const bool only_flagged = legend.mode == slam::PairMode::alarms;
  const Palette& colours = paletteOf(legend.palette);
  std::vector<Row> rows{{colours.robot, "robot and its path"}};
  if (!only_flagged) rows.emplace_back(colours.feature, "features");
  if (legend.tentative) rows.emplace_back(colours.tentative, "tentative: not seen often enough");
  if (legend.covariance_rings) {
    rows.push_back({colours.feature, format("ring: %gσ of the position", legend.axis.k)});
  }
  if (legend.own_error) {
    rows.push_back({colours.own_error,
                    format("white ring: %gσ of the registration's own error", legend.axis.k)});
  }
  if (!only_flagged) {
    const bool three = legend.mode == slam::PairMode::min_mean_max;
    rows.push_back({colours.ellipsoid, std::string(three ? "least, mean, greatest" : "relative") +
                                           " covariance, " + axisText(legend.axis)});
    if (!three) addChoice(legend, rows);
  }
  if (legend.flagged) {
    rows.emplace_back(colours.flagged, "flagged by the audit; faint: its last good size");
    if (only_flagged) rows.emplace_back(engine::Rgba{.a = 0.0F}, axisText(legend.axis));
  }
  if (legend.clusters > 0) {
    rows.push_back({{},
                    (legend.clusters == 1 ? "one cluster, cut at "
                                          : format("%d clusters, cut at ", legend.clusters)) +
                        lengthText(legend.cluster_cut) +
                        (legend.automatic_cut ? " (automatic)" : "")});
    rows.back().swatch.a = 0.0F;
  }
  return rows;
}

Eigen::Vector2d panelSize(const std::vector<AlarmLine>& lines, const PanelLayout& px,
                          engine::FontAtlas& fonts) {
  double width = 0.0;
  for (const AlarmLine& line : lines) {
    width = std::max(width, engine::measureText(fonts, line.text, px.text).width_px);
  }
  const double height = px.row * static_cast<double>(lines.size());
  return {width + 2.0 * px.padding, height + 2.0 * px.padding - 2.0};
}

/// Where a panel stands.
struct PanelPlace {
  Eigen::Vector2d corner, size;  // px
};

void addPanel(engine::Scene& scene, const std::vector<AlarmLine>& lines, const PanelPlace& place,
              const PanelLayout& px, const engine::Rgba& alarm_colour = kText) {
  const auto& [corner, size] = place;
  Eigen::Vector2d at = corner + Eigen::Vector2d::Constant(px.padding);
  for (const AlarmLine& line : lines) {
    scene.texts.push_back({.position_px = at,
                           .text = line.text,
                           .height_px = px.text,
                           .colour = line.alarm ? alarm_colour : kText});
    at.y() += px.row;
  }
  scene.rects.push_back({.min_px = corner, .max_px = corner + size, .colour = kPanel});
}

/// What the scale bar of `length` (m of the map) stands for.
std::string barText(const Legend& legend, double length) {
  std::string text = lengthText(length);
  const double sigma = std::sqrt(eigenvalueOfLength(legend.axis, length));
  if (legend.axis.axis != slam::Axis::sigma || legend.axis.gain != 1.0) {
    text += " on the map; as a semi-axis σ = " + lengthText(sigma);
  } else {
    text += format(" on the map = %gσ for σ = ", legend.axis.k) + lengthText(sigma);
  }
  if (legend.map_scale != 1.0) text += format("   (map drawn at 1:%.3g)", 1.0 / legend.map_scale);
  return text;
}

}  // namespace

double roundLength(double length) {
  const double decade = std::pow(10.0, std::floor(std::log10(length)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= length * (1.0 + 1e-12)) return step * decade;
  }
  return decade;
}

double eigenvalueOfLength(const slam::AxisScale& axis, double length) {
  const auto square = [](double value) { return value * value; };
  switch (axis.axis) {
    case slam::Axis::eigenvalue:
      return length / axis.gain;
    case slam::Axis::log:
      return square(1e-3 * (std::pow(10.0, length / (0.1 * axis.gain)) - 1.0) / axis.k);
    case slam::Axis::sigma:
      break;
  }
  return square(length / (axis.gain * axis.k));
}

void addStatus(engine::Scene& scene, const std::vector<std::string>& lines,
               const engine::Pinhole& camera, engine::FontAtlas& fonts) {
  const std::vector<AlarmLine> plain(lines.begin(), lines.end());
  const PanelLayout px(camera);
  addPanel(scene, plain,
           {.corner = Eigen::Vector2d::Constant(px.margin), .size = panelSize(plain, px, fonts)},
           px);
}

void addAlarms(engine::Scene& scene, std::vector<AlarmLine> lines, PaletteName palette,
               const engine::Pinhole& camera, engine::FontAtlas& fonts) {
  if (lines.empty()) return;
  const PanelLayout px(camera);
  const Eigen::Vector2d far = Eigen::Vector2d(camera.width, camera.height).array() - px.margin;
  Eigen::Vector2d size = panelSize(lines, px, fonts);
  double bottom = far.y();
  for (const engine::ScreenRect& other : scene.rects) {
    const bool in_the_way = (other.max_px.array() > (far - size).array()).all();
    if (in_the_way) bottom = std::min(bottom, other.min_px.y() - px.margin);
  }
  if (bottom < far.y()) {
    lines.resize(std::min(lines.size(), kFewAlarms), AlarmLine({}));
    size = panelSize(lines, px, fonts);
  }
  addPanel(scene, lines, {.corner = {far.x() - size.x(), bottom - size.y()}, .size = size}, px,
           paletteOf(palette).alarm_text);
}

void addLegend(engine::Scene& scene, const Legend& legend, const engine::Pinhole& camera,
               engine::FontAtlas& fonts) {
  const PanelLayout px(camera);
  const std::vector<Row> rows = rowsOf(legend);
  const bool bar = legend.px_per_m > 0.0;
  const double left = px.margin + px.padding;
  const double text_x = left + px.swatch + 8.0;
  const double height =
      px.row * static_cast<double>(rows.size()) + 2.0 * px.padding + (bar ? px.row + px.bar : 0.0);
  const double top = camera.height - px.margin - height;
  double y = top + px.padding;
  double right = text_x;
  const auto addText = [&](const std::string& text, double x) {
    scene.texts.push_back(
        {.position_px = {x, y}, .text = text, .height_px = px.text, .colour = kText});
    right = std::max(right, x + engine::measureText(fonts, text, px.text).width_px);
  };
  const std::size_t panel = scene.rects.size();
  scene.rects.push_back({});
  for (const Row& row : rows) {
    const Eigen::Vector2d corner(left, y + 2.0);
    scene.rects.push_back({.min_px = corner,
                           .max_px = corner + Eigen::Vector2d::Constant(px.swatch),
                           .colour = row.swatch});
    addText(row.text, text_x);
    y += px.row;
  }
  if (bar) {
    const double map_metre_px = legend.px_per_m * legend.map_scale;
    const double length = roundLength(15.0 * px.text / map_metre_px);
    const double bar_px = length * map_metre_px;
    const Eigen::Vector2d from(left, y + 0.4 * px.bar);
    scene.rects.push_back(
        {.min_px = from, .max_px = from + Eigen::Vector2d(bar_px, 0.3 * px.bar), .colour = kText});
    right = std::max(right, from.x() + bar_px);
    y += px.bar;
    addText(barText(legend, length), left);
  }
  scene.rects[panel] = {
      .min_px = {px.margin, top}, .max_px = {right + px.padding, top + height}, .colour = kPanel};
}

}  // namespace slamscope::apps
