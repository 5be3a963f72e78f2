// trajectory/1: every class there and back, and what is said of files that are none.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/io/trajectory.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/bspline_trajectory.hpp"
#include "switchyard/trajectory/composite_trajectory.hpp"
#include "switchyard/trajectory/path_parameterized_trajectory.hpp"

namespace switchyard::io {
namespace {

using Pieces = PiecewisePolynomial<double>;
using Segments = std::vector<TrajectoryPointer<double>>;

constexpr double kThird = 1.0 / 3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Segments OneOfEach() {
  const BezierCurve<double> bezier(
      0.1, kThird, (Eigen::MatrixXd(2, 3) << kThird, -0.0, 1e-300, 7e22, 0.1, -5).finished());
  const BsplineTrajectory<double> bspline(
      BsplineBasis<double>(2, {kThird, kThird, 0.5, 0.7, 0.7}),
      {Eigen::Vector2d(1, kThird), Eigen::Vector2d(2, 0), Eigen::Vector2d(0.1, 0.2)});
  const Pieces pieces = Pieces::FromCoefficients(
      2, 1, {Eigen::MatrixXd::Constant(2, 3, kThird), Eigen::MatrixXd::Zero(2, 1)}, {0.7, 0.8, 2});
  const CompositeTrajectory<double> composite({bezier, bspline, pieces});
  const Pieces line = Pieces::FirstOrderHold(Eigen::Vector2d(2, 4), Eigen::RowVector2d(0.1, 2));
  const PathParameterizedTrajectory<double> along(composite, line);
  return {bezier,
          bspline,
          pieces,
          composite,
          along,
          CompositeTrajectory<double>({composite, along}),
          CompositeTrajectory<double>(Segments()),
          BezierCurve<double>(),
          BsplineTrajectory<double>(),
          BsplineTrajectory<double>(BsplineBasis<double>(1, 2),
                                    {Eigen::MatrixXd::Identity(2, 3), Eigen::MatrixXd::Zero(2, 3)}),
          Pieces(),
          Pieces(Eigen::Matrix2d::Identity())};
}

TEST(TrajectoryJson, GoesThereAndBackToTheSameBits) {
  for (const auto& trajectory : OneOfEach()) {
    const std::string text = TrajectoryText(*trajectory);
    const auto again = ReadTrajectoryText(text, "written");
    EXPECT_EQ(again->Kind(), trajectory->Kind());
    EXPECT_EQ(TrajectoryText(*again), text);
    const auto* pieces = dynamic_cast<const PiecewiseTrajectory<double>*>(again.get());
    if (pieces != nullptr && pieces->get_number_of_segments() == 0) continue;
    ASSERT_EQ(again->rows(), trajectory->rows());
    ASSERT_EQ(again->cols(), trajectory->cols());
    EXPECT_EQ(again->start_time(), trajectory->start_time());
    EXPECT_EQ(again->end_time(), trajectory->end_time());
    for (int i = 0; i <= 40; ++i) EXPECT_EQ(again->value(0.1 * i), trajectory->value(0.1 * i));
  }
}

TEST(TrajectoryJson, KeepsTheSignOfAZero) {
  const BezierCurve<double> curve(0, 1, Eigen::RowVector2d(-0.0, 1));
  const auto again = ReadTrajectoryText(TrajectoryText(curve), "written");
  EXPECT_TRUE(std::signbit(dynamic_cast<const BezierCurve<double>&>(*again).control_points()(0)));
}

TEST(TrajectoryJson, IsWhatItsDescriptionSays) {
  const auto read = ReadTrajectoryText(
      R"({"format": "trajectory/1", "type": "composite", "segments": [
        {"type": "bezier", "start": 0, "end": 1, "control_points": [[0, 0], [2, 1]]},
        {"type": "bspline", "rows": 2, "cols": 1, "order": 2, "knots": [1, 1, 2, 2],
         "control_points": [[2, 1], [4, 3]]},
        {"type": "piecewise_polynomial", "rows": 2, "cols": 1, "breaks": [2, 3],
         "segments": [[[4, 3], [1, 0], [0, 2]]]}]})",
      "a.json");
  EXPECT_EQ(read->value(0.5), Eigen::Vector2d(1, 0.5));
  EXPECT_EQ(read->value(1.5), Eigen::Vector2d(3, 2));
  EXPECT_EQ(read->value(2.5), Eigen::Vector2d(4.5, 3.5));
}

TEST(TrajectoryJson, RefusesByNameWhatFilesDoNotHold) {
  const BezierCurve<double> line(0, 1, Eigen::RowVector2d(0, 1));
  const PathParameterizedTrajectory<double> along(line, line);
  const CompositeTrajectory<double> composite(
      {*along.MakeDerivative(), BezierCurve<double>(1, 2, Eigen::RowVector2d(0, kInfinity))});
  EXPECT_EQ(CannotHold(composite),
            (std::vector<std::string>{
                "/segments/0: a derivative of a path-parameterized trajectory, a class of "
                "trajectories that files do not hold",
                "/segments/1: numbers that are not finite"}));
  TrajectoryPointer<double> deep = line;
  for (int i = 0; i < 19; ++i) deep = CompositeTrajectory<double>({deep});
  EXPECT_EQ(TrajectoryText(*ReadTrajectoryText(TrajectoryText(*deep), "deep")),
            TrajectoryText(*deep));
  try {
    (void)TrajectoryText(CompositeTrajectory<double>({deep}));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("more than 20 trajectories within one another"),
              std::string::npos);
  }
}

std::string SaidOf(const std::string& members) {
  try {
    (void)ReadTrajectoryText("{\"format\": \"trajectory/1\", " + members + "}", "a.json");
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string OfSegments(const std::string& list) {
  return SaidOf("\"type\": \"composite\", \"segments\": [" + list + "]");
}

std::string Line(const std::string& start, const std::string& end, const std::string& points) {
  return "{\"type\": \"bezier\", \"start\": " + start + ", \"end\": " + end +
         ", \"control_points\": " + points + "}";
}

TEST(TrajectoryJson, SaysWhatIsWrongWithAFile) {
  const auto said = [](const std::string& text) {
    try {
      (void)ReadTrajectoryText(text, "a.json");
      return std::string("read");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(said("{}"), "a.json: needs \"format\": \"trajectory/1\", got an object without it");
  EXPECT_EQ(said("[]"), "a.json: needs an object, got a list of 0");
  EXPECT_EQ(said("{\"format\": \"gcs/1\"}"),
            "a.json: /format: needs \"trajectory/1\", got \"gcs/1\"");
  EXPECT_EQ(said("{\"format\": \"trajectory/1\"}"),
            "a.json: needs \"type\", got an object without it");
  EXPECT_EQ(said("{\"format\" 1}").find("a.json:1:"), 0U);
  EXPECT_EQ(SaidOf("\"type\": \"bezie\""),
            "a.json: /type: needs a type of trajectory (bezier, bspline, piecewise_polynomial, "
            "composite, path_parameterized), got \"bezie\" (the nearest is \"bezier\")");
  EXPECT_EQ(SaidOf("\"type\": \"composite\", \"segment\": []").find("a.json: /segment: needs"), 0U);
}

TEST(TrajectoryJson, SaysWhatIsWrongWithABezierCurve) {
  EXPECT_EQ(OfSegments(Line("0", "1", "[[0, 1]]") + ", " + Line("1", "1", "[[0, 1]]")),
            "a.json: /segments/1/end: needs a time after 1, the start, got 1");
  EXPECT_EQ(OfSegments(Line("0", "1", "[]")),
            "a.json: /segments/0/control_points: needs a list of one point or more, got a list of "
            "0");
  EXPECT_EQ(OfSegments(Line("0", "1", "[[1, 2], [3]]")),
            "a.json: /segments/0/control_points/1: needs a list of 2, one for each entry of a "
            "value, got a list of 1");
  EXPECT_EQ(OfSegments(Line("0", "1", "[[1, 2], [3, null]]")),
            "a.json: /segments/0/control_points/1/1: needs a number, got null");
  EXPECT_EQ(OfSegments(Line("\"-inf\"", "1", "[[1]]")),
            "a.json: /segments/0/start: needs a number, got \"-inf\"");
}

TEST(TrajectoryJson, SaysWhatIsWrongWithABspline) {
  const auto said = [](const std::string& order, const std::string& knots,
                       const std::string& points) {
    return SaidOf("\"type\": \"bspline\", \"rows\": 1, \"cols\": 1, \"order\": " + order +
                  ", \"knots\": " + knots + ", \"control_points\": " + points);
  };
  EXPECT_EQ(said("2", "[0, 0, 1, 1]", "[[1], [2]]"), "read");
  EXPECT_EQ(said("2", "[0, 0, 1]", "[[1]]"),
            "a.json: /knots: needs a list of 4 or more, twice the order, got a list of 3");
  EXPECT_EQ(said("2147483646", "[0, 0, 1]", "[[1]]"),
            "a.json: /knots: needs a list of 4294967292 or more, twice the order, got a list of 3");
  EXPECT_EQ(said("2", "[0, 2, 1, 1]", "[[1], [2]]"),
            "a.json: /knots/2: needs a knot of 2, the one before, or more, got 1");
  EXPECT_EQ(said("2", "[0, 1, 1, 2]", "[[1], [2]]"),
            "a.json: /knots: needs knot 2 above knot 1, got 1 for both");
  EXPECT_EQ(said("1", "[0, 1, 2]", "[[1]]"),
            "a.json: /control_points: needs a list of 2, one for each basis function, got a list "
            "of 1");
}

TEST(TrajectoryJson, SaysWhatIsWrongWithPolynomials) {
  const auto said = [](const std::string& rows, const std::string& breaks,
                       const std::string& segments) {
    return SaidOf("\"type\": \"piecewise_polynomial\", \"rows\": " + rows +
                  ", \"cols\": 1, \"breaks\": " + breaks + ", \"segments\": " + segments);
  };
  EXPECT_EQ(said("1", "[0, 1]", "[[[1], [2]]]"), "read");
  EXPECT_EQ(said("1", "[0, 1, 1]", "[[[1]], [[2]]]"),
            "a.json: /breaks/2: needs a break above 1, the one before, got 1");
  EXPECT_EQ(said("1", "[0]", "[]"),
            "a.json: /breaks: needs no breaks, or two or more, got a list of 1");
  EXPECT_EQ(said("1", "[0, 1]", "[]"),
            "a.json: /segments: needs a list of 1, one for each segment between breaks, got a list "
            "of 0");
  EXPECT_EQ(said("1", "[0, 1]", "[[]]"),
            "a.json: /segments/0: needs a list of one coefficient or more, got a list of 0");
  EXPECT_EQ(said("1", "[\"-inf\", 1]", "[[[1], [2]]]"),
            "a.json: /segments/0: needs a list of one coefficient where a segment starts at -inf, "
            "got a list of 2");
  EXPECT_EQ(said("2000000000", "[0, 1]", "[[[1]]]"),
            "a.json: /segments/0/0: needs a list of 2000000000, one for each entry of a value, got "
            "a list of 1");
}

TEST(TrajectoryJson, SaysWhatIsWrongWithTrajectoriesMadeOfOthers) {
  const std::string one = Line("0", "1", "[[0]]");
  EXPECT_EQ(OfSegments(one + ", " + Line("2", "3", "[[0]]")),
            "a.json: /segments/1: needs a segment that starts at 1, where the one before ends, got "
            "one that starts at 2");
  EXPECT_EQ(OfSegments(one + ", " + Line("1", "3", "[[0, 1]]")),
            "a.json: /segments/1: needs values of 1 x 1, as the segment before, got 2 x 1");
  EXPECT_EQ(OfSegments(Line("0", "1e-300", "[[0]]")).find("a.json: /segments/0: needs a segment"),
            0U);
  const std::string for_ever =
      "{\"type\": \"piecewise_polynomial\", \"rows\": 1, \"cols\": 1, \"breaks\": [\"-inf\", "
      "\"inf\"], \"segments\": [[[1]]]}";
  EXPECT_EQ(OfSegments(for_ever), "read");
  EXPECT_EQ(OfSegments(for_ever + ", " + one),
            "a.json: /segments/1: needs a segment that starts at inf, where the one before ends, "
            "got one that starts at 0");
  EXPECT_EQ(OfSegments("{\"type\": \"composite\", \"segments\": []}"),
            "a.json: /segments/0: needs a trajectory with segments, got one without");
  EXPECT_EQ(SaidOf("\"type\": \"path_parameterized\", \"path\": " + one +
                   ", \"time_scaling\": " + Line("0", "1", "[[0, 1]]")),
            "a.json: /time_scaling: needs values of 1 x 1, got 2 x 1");
  std::string deep = one;
  for (int i = 0; i < 20; ++i) deep = "{\"type\": \"composite\", \"segments\": [" + deep + "]}";
  EXPECT_NE(OfSegments(deep).find("needs at most 20 trajectories within one another"),
            std::string::npos);
}

}  // namespace
}  // namespace switchyard::io
