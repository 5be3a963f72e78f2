// Trajectories as tables of comma-separated values.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "switchyard/io/trajectory.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"
#include "tests/model/said.hpp"

namespace switchyard::io {
namespace {

using Pieces = PiecewisePolynomial<double>;

const BezierCurve<double>& Parabola() {
  static const BezierCurve<double> curve(1, 2,
                                         (Eigen::MatrixXd(2, 3) << 0, 1, 4, 0, 0.5, 1).finished());
  return curve;
}

TEST(TrajectoryTable, HasRowsAtARateAndOneAtTheEnd) {
  EXPECT_EQ(TrajectoryTable(Parabola(), {.rate = 2}), "t,q0,q1\n1,0,0\n1.5,1.5,0.5\n2,4,1\n");
  EXPECT_EQ(TrajectoryTable(Parabola(), {.rate = 1.6}),
            "t,q0,q1\n1,0,0\n1.625,2.03125,0.625\n2,4,1\n");
  EXPECT_EQ(TrajectoryTable(Parabola(), {.rate = 0.1}), "t,q0,q1\n1,0,0\n2,4,1\n");
  // No row a rounding before the last one.
  const BezierCurve<double> third(0, 0.3, Eigen::RowVector2d(0, 1));
  EXPECT_EQ(
      ReadTrajectoryTableText(TrajectoryTable(third, {.rate = 10}), "t").get_number_of_segments(),
      3);
}

TEST(TrajectoryTable, HasRowsAtGivenTimesAndColumnsOfDerivatives) {
  EXPECT_EQ(TrajectoryTable(Parabola(), {.times = {1.5}, .derivatives = 2}),
            "t,q0,q1,qd0,qd1,qdd0,qdd1\n"
            "1,0,0,2,1,4,0\n"
            "1.5,1.5,0.5,4,1,4,0\n"
            "2,4,1,6,1,4,0\n");
  EXPECT_EQ(TrajectoryTable(Parabola(), {.times = {1, 2}}), "t,q0,q1\n1,0,0\n2,4,1\n");
}

TEST(TrajectoryTable, IsReadBackToTheSameNumbers) {
  const std::vector<double> times = {1.0 / 3, 0.4, 0.7, 2.0 / 3 + 0.1};
  std::vector<Eigen::MatrixXd> samples;
  for (const double t : times) samples.push_back(Eigen::Vector3d(t / 7, -1e300 * t, 1e-300 / t));
  const Pieces hold = Pieces::FirstOrderHold(times, samples);
  std::vector<std::string> notes;
  const Pieces again = ReadTrajectoryTableText(
      TrajectoryTable(hold, {.times = times, .derivatives = 1}), "a.csv", {.notes = &notes});
  EXPECT_EQ(again.get_segment_times(), times);
  for (int i = 0; i + 1 < static_cast<int>(times.size()); ++i) {
    EXPECT_EQ(again.coefficients(i).col(0), samples[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(notes, std::vector<std::string>{"columns of derivatives are left out: a line joins the "
                                            "values of two rows"});
}

TEST(TrajectoryTable, GoesToAFileAndBack) {
  for (const char* name : {"sy_trajectory.csv", "sy_trajectory.csv.gz"}) {
    const auto path = std::filesystem::temp_directory_path() / name;
    WriteTrajectoryTable(Parabola(), path.string(), {.rate = 50});
    const Pieces read = ReadTrajectoryTable(path.string());
    std::filesystem::remove(path);
    EXPECT_EQ(read.get_number_of_segments(), 50);
    for (int i = 0; i < 50; ++i) {
      const double t = read.start_time(i);
      EXPECT_EQ(read.value(t), Parabola().value(t));
    }
  }
}

TEST(TrajectoryTable, IsRefusedWhereThereIsNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Said([] { (void)TrajectoryTable(Parabola(), {.rate = 0}); }),
            "rate: a positive number of rows a second is needed, got 0");
  EXPECT_EQ(Said([] { (void)TrajectoryTable(Parabola(), {.rate = 1e9}); }),
            "a table of at most 4194304 rows is written, got 1 s at 1000000000 rows a second");
  EXPECT_EQ(Said([] {
              (void)TrajectoryTable(Parabola(), {.times = {1.5, 1.5}});
            }),
            "times: times[1] = 1.5 needs to be above times[0] = 1.5");
  EXPECT_EQ(Said([] {
              (void)TrajectoryTable(Parabola(), {.times = {0, 1.5}});
            }),
            "times: from 1 to 2, the trajectory's, are needed, got 0 to 1.5");
  EXPECT_EQ(Said([] { (void)TrajectoryTable(Pieces(Eigen::VectorXd::Ones(1))); }),
            "a table needs finite times, this piecewise polynomial is from -inf to inf");
  EXPECT_EQ(Said([] { (void)TrajectoryTable(Pieces(Eigen::Matrix2d::Identity())); }),
            "a table needs values of one column, this piecewise polynomial has values of 2 x 2");
  EXPECT_EQ(
      Said([&] {
        (void)TrajectoryTable(BezierCurve<double>(0, 1, Eigen::VectorXd::Constant(1, infinity)));
      }),
      "a table needs finite values, derivative 0 at t = 0 is not");
}

TEST(TrajectoryTable, SaysWhatIsWrongAndWhere) {
  const auto said = [](const std::string& text) {
    try {
      (void)ReadTrajectoryTableText(text, "a.csv");
      return std::string("read");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(said("t,q0\n0,1\r\n\n1,2"), "read");
  EXPECT_EQ(said(""), "a.csv:1:1: expected the header t,q0,q1,..., got the end of the file");
  EXPECT_EQ(said("0,1\n1,2\n"), "a.csv:1:1: expected t, got \"0\"");
  EXPECT_EQ(said("t,q0,q2\n"), "a.csv:1:6: expected q1, got \"q2\"");
  EXPECT_EQ(said("t,q0,q1,qd0\n0,1,2,3\n"), "a.csv:1:1: expected qd1, got a header without it");
  EXPECT_EQ(said("t,q0,\n"), "a.csv:1:6: expected q1, got an empty field");
  EXPECT_EQ(said("t,q0\n0,1\n"), "a.csv:3:1: expected two rows or more, got the end of the file");
  EXPECT_EQ(said("t,q0\n0,1\n1\n"), "a.csv:3:1: expected 2 fields, as the header has, got 1");
  EXPECT_EQ(said("t,q0\n0,1,2\n"), "a.csv:2:5: expected 2 fields, as the header has, got one more");
  EXPECT_EQ(said("t,q0\n0,1\n1,x\n"), "a.csv:3:3: expected a number, got \"x\"");
  EXPECT_EQ(said("t,q0\n0,1\n1,\n"), "a.csv:3:3: expected a number, got an empty field");
  EXPECT_EQ(said("t,q0\n0,1\n1,nan\n"), "a.csv:3:3: expected a number, got \"nan\"");
  EXPECT_EQ(said("t,q0\n0,-1e308\n1,1e308\n"),
            "a.csv:3:1: expected values that a line from the row before can reach in double "
            "numbers, got too large a change");
  EXPECT_EQ(said("t,q0\n1,1\n1,2\n"),
            "a.csv:3:1: expected a time after 1, that of the row before, got \"1\"");
}

}  // namespace
}  // namespace switchyard::io
