// SPDX-License-Identifier: MIT
#include "apps/lib/view/legend.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/scene/clip.hpp"
#include "engine/scene/label_placement.hpp"
#include "engine/scene/text_layout.hpp"

namespace slamscope::apps {
namespace {

/// Sizes in px of a picture that is 720 px high; others scale, down to what can still be read.
struct Layout {
  double text = 14.0;
  double margin = 10.0;
  double padding = 7.0;
  double row = 19.0;
  double swatch = 12.0;
  double bar = 12.0;

  explicit Layout(const engine::Pinhole& camera) {
    const double scale = std::clamp(camera.height / 720.0, 0.75, 3.0);
    for (double* size : {&text, &margin, &padding, &row, &swatch, &bar}) {
      *size = std::round(*size * scale);
    }
  }
};

constexpr engine::Rgba kPanel{0.04F, 0.05F, 0.07F, 0.66F};
constexpr engine::Rgba kText{0.96F, 0.96F, 0.96F, 1.0F};
constexpr engine::Rgba kAlarmText{1.0F, 0.55F, 0.96F, 1.0F};  // of magenta what reads on the panel

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

/// Which of the mode's pairs are shown, where not all are, and whether with lines.
void addChoice(const Legend& legend, std::vector<Row>& rows) {
  const auto add = [&rows](std::string text) {
    rows.emplace_back(engine::Rgba{.a = 0.0F}, std::move(text));
  };
  if (legend.most_pairs > 0) add(format("the %u largest of them only", legend.most_pairs));
  if (legend.least_area > 0.0) {
    add("only those of sqrt(det) ≥ (" + lengthText(std::sqrt(legend.least_area)) + ")²");
  }
  if (legend.lines_left_out)
    add("too many pairs for lines: each stands midway between its features");
}

std::vector<Row> rowsOf(const Legend& legend) {
  const bool only_flagged = legend.mode == slam::PairMode::alarms;
  std::vector<Row> rows{{colour::kRobot, "robot and its path"}};
  if (!only_flagged) rows.emplace_back(colour::kFeature, "features");
  if (legend.tentative) rows.emplace_back(colour::kTentative, "tentative: not seen often enough");
  if (legend.covariance_rings) {
    rows.push_back({colour::kFeature, format("ring: %gσ of the position", legend.axis.k)});
  }
  if (legend.own_error) {
    rows.push_back({colour::kOwnError,
                    format("white ring: %gσ of the registration's own error", legend.axis.k)});
  }
  if (!only_flagged) {
    const bool three = legend.mode == slam::PairMode::min_mean_max;
    rows.push_back({colour::kEllipsoid, std::string(three ? "least, mean, greatest" : "relative") +
                                            " covariance, " + axisText(legend.axis)});
    if (!three) addChoice(legend, rows);
  }
  if (legend.flagged) {
    rows.emplace_back(colour::kFlagged, "flagged by the audit; faint: its last good size");
    if (only_flagged) rows.emplace_back(engine::Rgba{.a = 0.0F}, axisText(legend.axis));
  }
  if (legend.clusters > 0) {
    rows.push_back({{},
                    format("%d clusters, cut at ", legend.clusters) +
                        lengthText(legend.cluster_cut) +
                        (legend.automatic_cut ? " (automatic)" : "")});
    rows.back().swatch.a = 0.0F;
  }
  return rows;
}

Eigen::Vector2d panelSize(const std::vector<AlarmLine>& lines, const Layout& px,
                          engine::FontAtlas& fonts) {
  double width = 0.0;
  for (const AlarmLine& line : lines) {
    width = std::max(width, engine::measureText(fonts, line.text, px.text).width_px);
  }
  const double height = px.row * static_cast<double>(lines.size());
  return {width + 2.0 * px.padding, height + 2.0 * px.padding - 2.0};
}

void addPanel(engine::Scene& scene, const std::vector<AlarmLine>& lines,
              const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Layout& px) {
  Eigen::Vector2d at = corner + Eigen::Vector2d::Constant(px.padding);
  for (const AlarmLine& line : lines) {
    scene.texts.push_back({.position_px = at,
                           .text = line.text,
                           .height_px = px.text,
                           .colour = line.alarm ? kAlarmText : kText});
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
  const Layout px(camera);
  addPanel(scene, plain, Eigen::Vector2d::Constant(px.margin), panelSize(plain, px, fonts), px);
}

void addAlarms(engine::Scene& scene, std::vector<AlarmLine> lines, const engine::Pinhole& camera,
               engine::FontAtlas& fonts) {
  if (lines.empty()) return;
  const Layout px(camera);
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
  addPanel(scene, lines, {far.x() - size.x(), bottom - size.y()}, size, px);
}

void addLegend(engine::Scene& scene, const Legend& legend, const engine::Pinhole& camera,
               engine::FontAtlas& fonts) {
  const Layout px(camera);
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

namespace {

/// Nearest first, no more than kMostLabels; whole up to twice the distance of the nearest, gone at
/// five times.
void fadeWithDistance(std::vector<engine::Label>& labels, const engine::View& view) {
  constexpr std::size_t kMostLabels = 150;
  const auto depth = [&view](const engine::Label& label) {
    return (view.T_eye_scene * label.anchor).z();
  };
  std::erase_if(labels, [&](const engine::Label& label) { return depth(label) <= 0.0; });
  if (labels.empty()) return;
  std::ranges::stable_sort(labels, {}, depth);
  const double nearest = depth(labels.front());
  if (labels.size() > kMostLabels) labels.resize(kMostLabels);
  for (engine::Label& label : labels) {
    const double share = (5.0 - depth(label) / nearest) / 3.0;
    label.colour.a *= static_cast<float>(std::clamp(share, 0.0, 1.0));
  }
  std::erase_if(labels, [](const engine::Label& label) { return label.colour.a <= 0.0F; });
}

}  // namespace

void spreadLabels(engine::Scene& scene, const engine::View& view, engine::FontAtlas& fonts) {
  std::vector<engine::PixelBox> obstacles;
  const auto pixel = [&view](const Eigen::Vector3d& p_scene) -> std::optional<Eigen::Vector2d> {
    const Eigen::Vector3d p_eye = view.T_eye_scene * p_scene;
    if (p_eye.z() < 0.05) return std::nullopt;
    return engine::project(view.camera, p_eye);
  };
  for (const engine::Cone& cone : scene.cones) {
    const auto tip = pixel(cone.tip);
    const auto rim = pixel(cone.tip + cone.height * Eigen::Vector3d::UnitZ());
    const auto side = pixel(cone.tip + Eigen::Vector3d(cone.radius, 0.0, cone.height));
    if (!tip || !rim || !side) continue;
    const Eigen::Vector2d radius = Eigen::Vector2d::Constant((*side - *rim).norm());
    obstacles.push_back(
        {.min_px = tip->cwiseMin(*rim - radius), .max_px = tip->cwiseMax(*rim + radius)});
  }
  for (const engine::ScreenRect& rect : scene.rects)
    obstacles.push_back({rect.min_px, rect.max_px});

  std::vector<engine::LabelRequest> requests;
  std::vector<engine::Label> in_view;
  const double text_px = Layout(view.camera).text;
  fadeWithDistance(scene.labels, view);
  for (engine::Label& label : scene.labels) {
    label.height_px = text_px;
    const auto anchor = pixel(label.anchor);
    if (!anchor) continue;
    const engine::TextExtent extent = engine::measureText(fonts, label.text, label.height_px);
    requests.push_back({.anchor_px = *anchor,
                        .size_px = {extent.width_px, extent.height_px},
                        .last_offset_px = {}});
    in_view.push_back(std::move(label));
  }
  const engine::PixelBox picture{.min_px = Eigen::Vector2d::Zero(),
                                 .max_px = Eigen::Vector2d(view.camera.width, view.camera.height)};
  const auto offsets = engine::placeLabels(requests, obstacles, {.picture = picture});
  scene.labels.clear();
  for (std::size_t k = 0; k < in_view.size(); ++k) {
    if (!offsets[k]) continue;
    in_view[k].offset_px = *offsets[k];
    scene.labels.push_back(std::move(in_view[k]));
  }
}

}  // namespace slamscope::apps
