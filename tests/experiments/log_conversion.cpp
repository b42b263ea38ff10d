// SPDX-License-Identifier: MIT
#include "tests/experiments/log_conversion.hpp"

#include <cstdio>
#include <cstdlib>

namespace slamscope::slam::experiments {
namespace {

double sixDigits(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const int places = 5 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  // Ten to the 22nd is the last power that a double holds exactly: up to there the quotient is the
  // double that the decimal number is read as.
  if (places >= 0 && places <= 22) {
    const double scale = std::pow(10.0, places);
    return std::round(value * scale) / scale;
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return std::strtod(text.data(), nullptr);
}

PackedCovariance scaled(const PackedCovariance& P, const Eigen::VectorXd& units) {
  PackedCovariance result(P.size());
  for (int row = 0; row < P.size(); ++row) {
    for (int col = 0; col <= row; ++col) result(row, col) = P(row, col) * units[row] * units[col];
  }
  return result;
}

void scaleObservation(ObservationRecord& o, Sensor sensor, const Eigen::VectorXd& units,
                      double scale) {
  const Eigen::Vector2d z_units(scale, sensor == Sensor::range_bearing ? 1.0 : scale);
  const Eigen::DiagonalMatrix<double, 2> unit(z_units);
  o.z = unit * o.z;
  o.innovation = unit * o.innovation;
  o.S = (unit * o.S * unit).eval();
  o.R = (unit * o.R * unit).eval();
  if (o.H.size() > 0) o.H = (unit * o.H * units.cwiseInverse().asDiagonal()).eval();
}

void roundAll(Snapshot& log, Precision precision) {
  const auto round = [precision](double value) { return rounded(value, precision); };
  log.pose = log.pose.unaryExpr(round).eval();
  for (Eigen::Vector2d& feature : log.features) feature = feature.unaryExpr(round).eval();
  const auto packed = log.covariance.packed();
  std::vector<double> values(packed.begin(), packed.end());
  for (double& value : values) value = round(value);
  log.covariance = PackedCovariance(log.covariance.size(), std::move(values));
  for (ObservationRecord& o : log.observations) {
    o.z = o.z.unaryExpr(round).eval();
    o.innovation = o.innovation.unaryExpr(round).eval();
    o.S = o.S.unaryExpr(round).eval();
    o.R = o.R.unaryExpr(round).eval();
    o.H = o.H.unaryExpr(round).eval();
  }
  if (log.Q) log.Q = log.Q->unaryExpr(round).eval();
}

}  // namespace

std::string_view precisionName(Precision precision) {
  constexpr std::array<std::string_view, 3> kNames{"double", "float32", "6 digits"};
  return kNames.at(static_cast<std::size_t>(precision));
}

std::string_view levelName(Level level) {
  constexpr std::array<std::string_view, 3> kNames{"L1", "L2", "L3"};
  return kNames.at(static_cast<std::size_t>(level));
}

double rounded(double value, Precision precision) {
  switch (precision) {
    case Precision::float32: {
      // volatile: g++ 12 leaves both conversions out where it vectorises two of them.
      volatile const float single = static_cast<float>(value);
      return static_cast<double>(single);
    }
    case Precision::text6:
      return sixDigits(value);
    default:
      return value;
  }
}

std::string kindName(const LogKind& kind) {
  std::string name(levelName(kind.level));
  name += ' ';
  name += precisionName(kind.precision);
  if (kind.declared) name += " declared";
  if (kind.truth) name += " truth";
  return name;
}

SnapshotPtr logged(const SnapshotPtr& snapshot, const LogKind& kind) {
  const bool step = snapshot->event == Event::step;
  if (step != (kind.level == Level::l1) && snapshot->event != Event::initial) return nullptr;
  auto log = std::make_shared<Snapshot>(*snapshot);
  if (kind.level != Level::l3) {
    log->observations.clear();
    log->control.reset();
  }
  if (!kind.declared) log->Q.reset();
  if (!kind.truth) log->truth.reset();
  if (kind.precision != Precision::exact) roundAll(*log, kind.precision);
  return log;
}

SnapshotPtr inUnits(const SnapshotPtr& snapshot, Sensor sensor, double scale) {
  auto log = std::make_shared<Snapshot>(*snapshot);
  Eigen::VectorXd units = Eigen::VectorXd::Constant(log->covariance.size(), scale);
  units[2] = 1.0;
  log->pose.head<2>() *= scale;
  for (Eigen::Vector2d& feature : log->features) feature *= scale;
  log->covariance = scaled(log->covariance, units);
  if (log->asymmetry) *log->asymmetry *= scale * scale;
  for (ObservationRecord& o : log->observations) scaleObservation(o, sensor, units, scale);
  if (log->Q) {
    const Eigen::DiagonalMatrix<double, 3> unit(units.head<3>());
    log->Q = (unit * *log->Q * unit).eval();
  }
  if (log->truth) {
    log->truth->pose.head<2>() *= scale;
    for (Eigen::Vector2d& feature : log->truth->features) feature *= scale;
  }
  log->control.reset();
  return log;
}

RunHeader inUnits(RunHeader header, double scale) {
  if (!header.R) return header;
  const double second = header.sensor == Sensor::range_bearing ? 1.0 : scale;
  const Eigen::DiagonalMatrix<double, 2> unit(scale, second);
  header.R = (unit * *header.R * unit).eval();
  return header;
}

SnapshotPtr Unwrapper::operator()(const SnapshotPtr& snapshot) {
  auto log = std::make_shared<Snapshot>(*snapshot);
  heading_ += wrapAngle(log->pose[2] - heading_);
  log->pose[2] = heading_;
  return log;
}

}  // namespace slamscope::slam::experiments
