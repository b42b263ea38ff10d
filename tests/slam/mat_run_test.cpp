// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <filesystem>
#include <fstream>
#include <limits>

#include "slam/run_summary.hpp"
#include "tests/slam/mat_writer.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;
using Matrices = std::vector<Eigen::MatrixXd>;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Three steps of a map that grows by a feature each; P is not quite symmetric.
struct Growing {
  Growing() {
    for (int step = 0; step < 3; ++step) {
      const int n = 3 + 2 * step;
      x.emplace_back(Eigen::VectorXd::LinSpaced(n, step, step + n - 1));
      P.emplace_back(0.01 * Eigen::MatrixXd::Identity(n, n));
      P.back()(2, 0) = 0.001;  // below the diagonal
      P.back()(0, 2) = 0.002;
      d.emplace_back(P.back().diagonal());
    }
  }
  [[nodiscard]] Matrices padded(const Matrices& steps) const {
    Matrices result;
    for (const Eigen::MatrixXd& step : steps) {
      result.emplace_back(Eigen::MatrixXd::Constant(7, step.cols() == 1 ? 1 : 7, kNotANumber));
      result.back().topLeftCorner(step.rows(), step.cols()) = step;
    }
    return result;
  }
  Matrices x, P, d;
};

class MatRun : public ::testing::Test {
 protected:
  MatRun() { fs::create_directories(folder_); }
  ~MatRun() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path() const { return folder_ / "run.mat"; }
  /// The message without the folder, or "" where the whole run can be read.
  [[nodiscard]] std::string errorOf(const std::vector<matvar_t*>& variables) const {
    saveMat(path(), variables);
    return errorOfFile();
  }
  [[nodiscard]] std::string errorOfFile() const {
    try {
      static_cast<void>(read());
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "";
  }
  [[nodiscard]] std::vector<SnapshotPtr> read() const {
    RunReader reader(path());
    std::vector<SnapshotPtr> records;
    while (auto snapshot = reader.next()) records.push_back(*snapshot);
    return records;
  }
  [[nodiscard]] std::string level() const {
    RunReader reader(path());
    return summarize(reader).levelName();
  }
  void expectGrowing(bool diagonal = false) const {
    const auto records = read();
    ASSERT_EQ(records.size(), 3U);
    for (int step = 0; step < 3; ++step) {
      const Snapshot& s = *records[static_cast<std::size_t>(step)];
      const Eigen::MatrixXd& P = growing_.P[static_cast<std::size_t>(step)];
      ASSERT_EQ(s.featureCount(), step);
      EXPECT_EQ(s.pose.x(), step);
      EXPECT_EQ(s.diagonal_only, diagonal);
      EXPECT_EQ(s.covariance(0, 0), P(0, 0));
      if (step > 0) {
        EXPECT_EQ(s.ids.back(), static_cast<FeatureId>(step));
        EXPECT_EQ(s.features.back().y(), step + 2 + 2 * step);
      }
      if (diagonal) continue;
      EXPECT_EQ(s.covariance(2, 0), 0.001) << "the lower triangle";
      EXPECT_EQ(s.asymmetry, 0.001);
    }
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("slamscope_mat" + std::to_string(::getpid()));
  const Growing growing_;
};

TEST_F(MatRun, OfCellsOfStacksAndOfStructsIsTheSameRun) {
  const auto& [x, P, d] = growing_;
  saveMat(path(), {matCells(x, "x"), matCells(P, "P")});
  expectGrowing();
  saveMat(path(), {matCells(x, "x"), matCells(P, "P")}, MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  expectGrowing();
  saveMat(path(), {matStack(growing_.padded(x), "x"), matStack(growing_.padded(P), "P")});
  expectGrowing();
  saveMat(path(), {matStructs({"x", "P"},
                              {matMatrix(x[0]), matMatrix(P[0]), matMatrix(x[1]), matMatrix(P[1]),
                               matMatrix(x[2]), matMatrix(P[2])},
                              "history")});
  expectGrowing();
}

matvar_t* bailey(const Matrices& x, const Matrices& P, bool keeps_x = true) {
  std::vector<matvar_t*> values;
  for (std::size_t k = 0; k < x.size(); ++k) {
    values.push_back(matMatrix(keeps_x || k == 0 ? x[k] : Eigen::MatrixXd(0, 0)));
    values.push_back(matMatrix(P[k]));
  }
  // Paths are made in advance, in chunks.
  Eigen::MatrixXd path = Eigen::MatrixXd::Zero(3, 50);
  path.leftCols<3>() << 1, 2, 3, 4, 5, 6, 0.7, 0.8, 0.9;
  return matStructs({"i", "path", "true", "state"},
                    {matMatrix(Eigen::MatrixXd::Constant(1, 1, 3.0)), matMatrix(path),
                     matMatrix(path), matStructs({"x", "P"}, values)},
                    "data");
}

TEST_F(MatRun, OfTheSimulatorOfBaileyHasItsTruth) {
  saveMat(path(), {bailey(growing_.x, growing_.P)});
  expectGrowing();
  const auto records = read();
  ASSERT_TRUE(records[1]->truth);
  EXPECT_EQ(records[1]->truth->pose, Eigen::Vector3d(2, 5, 0.8));
  EXPECT_EQ(level(), "L1, with truth (L4)");
}

TEST_F(MatRun, OfDiagonalsIsLevelL0) {
  saveMat(path(), {bailey(growing_.x, growing_.d)});
  expectGrowing(true);
  EXPECT_EQ(level(), "L0, with truth (L4)");
  saveMat(path(),
          {matStack(growing_.padded(growing_.x), "x"), matStack(growing_.padded(growing_.d), "P")});
  expectGrowing(true);
}

TEST_F(MatRun, WithoutMeansIsLevelLC) {
  saveMat(path(), {bailey(growing_.x, growing_.P, false)});
  EXPECT_EQ(level(), "LC, with truth (L4)");
  RunReader reader(path());
  EXPECT_FALSE(reader.header().means_known);
  EXPECT_EQ(reader.warnings().front(),
            path() + ": x was kept in 1 of 3 steps only: means are unknown");
  EXPECT_TRUE(std::isnan((*reader.next())->pose.x()));
  EXPECT_EQ(errorOf({bailey(growing_.x, growing_.d, false)}),
            "run.mat: expected x beside the diagonal of P, found neither means nor correlations: "
            "keep x and P in each step");
}

TEST_F(MatRun, TakesTimesIdsEventsAndWhatWasObserved) {
  const auto number = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const Matrices ids{Eigen::MatrixXd(0, 0), number(42), Eigen::Vector2d(42, 7)};
  const Matrices observed{Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0), number(42)};
  saveMat(path(),
          {matCells(growing_.x, "x"), matCells(growing_.P, "P"), matCells(ids, "ids"),
           matCells(observed, "observed"), matMatrix(Eigen::RowVector3d(0.1, 0.2, 0.2), "t"),
           matCells({matText("predict"), matText("initialise"), matText("initialise")}, "event")});
  const auto records = read();
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[2]->ids, (std::vector<FeatureId>{42, 7}));
  EXPECT_EQ(records[2]->observed, std::vector<FeatureId>{42});
  EXPECT_TRUE(records[0]->observed.empty());
  EXPECT_TRUE(records[0]->observed_given);
  EXPECT_EQ(records[0]->event, Event::predict);
  EXPECT_EQ(records[2]->time, std::chrono::milliseconds(200));
  RunReader reader(path());
  EXPECT_TRUE(reader.warnings().empty());
}

TEST_F(MatRun, SaysWhatItAssumed) {
  saveMat(path(), {matCells(growing_.x, "x"), matCells(growing_.P, "P")});
  RunReader reader(path());
  ASSERT_EQ(reader.warnings().size(), 1U);
  EXPECT_EQ(reader.warnings()[0],
            path() +
                ": no times (t): the number of the step stands for seconds; no ids: features "
                "are called 1, 2, … by their place in the state");
}

TEST_F(MatRun, CellsMadeInAdvanceAreLeftOut) {
  auto [x, P, d] = growing_;
  x.resize(6, Eigen::MatrixXd(0, 0));
  P.resize(6, Eigen::MatrixXd(0, 0));
  saveMat(path(), {matCells(x, "x"), matCells(P, "P")});
  expectGrowing();
}

TEST_F(MatRun, ANanInTheMapIsReadAndNoPadding) {
  auto [x, P, d] = growing_;
  P[2](4, 3) = kNotANumber;
  saveMat(path(), {matStack(growing_.padded(x), "x"), matStack(growing_.padded(P), "P")});
  const auto records = read();
  EXPECT_EQ(records[2]->featureCount(), 2);
  EXPECT_FALSE(records[2]->finite());
}

TEST_F(MatRun, SizesThatDoNotFitAreNamed) {
  const auto& [x, P, d] = growing_;
  EXPECT_EQ(errorOf({matCells(x, "x"), matCells({P[0], P[2], P[2]}, "P")}),
            "run.mat: record 1: P: expected 5×5 as x has 5 numbers, found 49 numbers");
  EXPECT_EQ(errorOf({matCells({x[0]}, "x"), matCells({P[0], P[1]}, "P")}),
            "run.mat: x: expected 2, as many as P, found 1");
  EXPECT_EQ(errorOf({matCells({Eigen::MatrixXd(Eigen::Vector4d::Zero())}, "x"),
                     matCells({Eigen::MatrixXd::Identity(4, 4)}, "P")}),
            "run.mat: record 0: x: expected 3 + 2 numbers a feature (x, y, heading, then x, y of "
            "each), found 4");
  EXPECT_EQ(errorOf({matCells(x, "x"), matCells({P[0], Eigen::MatrixXd(0, 0), P[2]}, "P")}),
            "run.mat: P: expected a matrix in each step, found none");
  EXPECT_EQ(errorOf({matCells(x, "x"), matCells(P, "P"), matMatrix(Eigen::RowVector2d(1, 2), "t")}),
            "run.mat: t: expected 3, one a step, found 2×1");
}

TEST_F(MatRun, FeaturesThatVanishWithoutIdsAreUnreadable) {
  const auto& [x, P, d] = growing_;
  const std::string gone =
      ": ids: the feature in place 2 is there no more, and without ids nobody can tell which one "
      "left: save ids too, a row a step, padded with NaN";
  EXPECT_EQ(errorOf({matCells({x[2], x[1]}, "x"), matCells({P[2], P[1]}, "P")}),
            "run.mat: record 1" + gone);
  EXPECT_EQ(errorOf({matStack(growing_.padded({x[2], x[1]}), "x"),
                     matStack(growing_.padded({P[2], P[1]}), "P")}),
            "run.mat: record 1" + gone);
  const Matrices ids{Eigen::Vector2d(5, 9), Eigen::MatrixXd::Constant(1, 1, 9)};
  EXPECT_EQ(
      errorOf({matCells({x[2], x[1]}, "x"), matCells({P[2], P[1]}, "P"), matCells(ids, "ids")}),
      "");
}

TEST_F(MatRun, FeaturesThatChangePlaceAreUnreadable) {
  const auto& [x, P, d] = growing_;
  const Matrices ids{Eigen::Vector2d(5, 9), Eigen::Vector2d(9, 5)};
  EXPECT_EQ(
      errorOf({matCells({x[2], x[2]}, "x"), matCells({P[2], P[2]}, "P"), matCells(ids, "ids")}),
      "run.mat: record 1: ids: expected the order of the record before, found feature 5 in "
      "another place");
}

TEST_F(MatRun, TimeThatGoesBackIsUnreadable) {
  EXPECT_EQ(errorOf({matCells(growing_.x, "x"), matCells(growing_.P, "P"),
                     matMatrix(Eigen::RowVector3d(1, 2, 1.5), "t")}),
            "run.mat: record 2: time: expected at least 2 s as in the record before, found 1.5 s");
}

TEST_F(MatRun, OfOtherThingsSaysWhatItFound) {
  EXPECT_EQ(errorOf({matMatrix(Eigen::RowVector2d(1, 2), "z"), matText("x", "note")}),
            "run.mat: expected x and P (cell arrays, or stacked), or a struct array with fields x "
            "and P, found z, note");
  EXPECT_EQ(errorOf({matCells({matText("a")}, "x"), matCells({growing_.P[0]}, "P")}),
            "run.mat: record 0: x: expected numbers, found something else");
  std::ofstream(path()) << "x = 3\n";
  EXPECT_EQ(errorOfFile(), "run.mat: expected a file of MATLAB or Octave; save with -v7");
}

TEST_F(MatRun, CutOffAnywhereIsUnreadable) {
  saveMat(path(), {matCells(growing_.x, "x"), matCells(growing_.P, "P")});
  const auto size = fs::file_size(path());
  int refused = 0;
  for (std::uintmax_t left = size - 1; left > 128; left -= 37) {
    fs::resize_file(path(), left);
    refused += errorOfFile().starts_with("run.mat: ") ? 1 : 0;
    if (left < 166) break;
  }
  EXPECT_EQ(refused, static_cast<int>((size - 1 - 129) / 37) + 1);
}

TEST_F(MatRun, OfVersion73IsReadOrSaysHowToSave) {
  mat_t* file = Mat_CreateVer(path().c_str(), nullptr, MAT_FT_MAT73);
  if (file == nullptr) GTEST_SKIP() << "this libmatio has no HDF5";
  Mat_Close(file);
  saveMat(path(),
          {matStack(growing_.padded(growing_.x), "x"), matStack(growing_.padded(growing_.P), "P")},
          MAT_FT_MAT73, MAT_COMPRESSION_NONE);
  expectGrowing();
  saveMat(path(), {matCells(growing_.x, "x"), matCells(growing_.P, "P")}, MAT_FT_MAT73,
          MAT_COMPRESSION_NONE);
  expectGrowing();
}

}  // namespace
}  // namespace slamscope::slam
