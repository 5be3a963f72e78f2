// What is said of a problem that the ABI does not allow.
#include "core/host/problem_check.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {

/// What is said of SmallCones after an edit of its data.
std::string Said(const std::function<void(ProblemData&)>& edit) {
  Problem problem(SmallCones());
  problem.Change(edit);
  try {
    CheckProblem(problem.view());
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

/// The same after an edit of the record itself.
std::string SaidOf(const std::function<void(sy_problem&)>& edit) {
  const Problem problem(SmallCones());
  sy_problem view = problem.view();
  edit(view);
  try {
    CheckProblem(view);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(CheckProblem, SaysNothingOfAGoodOne) {
  EXPECT_EQ(Said([](ProblemData&) {}), "");
  EXPECT_EQ(Said([](ProblemData& d) { d.x_lower[0] = -kInfinity; }), "");
}

TEST(CheckProblem, Bounds) {
  EXPECT_EQ(Said([](ProblemData& d) { d.x_lower[1] = 5; }),
            "x[1] has lower bound 5 above its upper bound 4");
  EXPECT_EQ(Said([](ProblemData& d) { d.row_upper[0] = 0.5; }),
            "row[0] has lower bound 1 above its upper bound 0.5");
  EXPECT_EQ(Said([](ProblemData& d) { d.x_upper[0] = d.x_lower[0] = kInfinity; }),
            "x[0] has the bounds inf and inf, which no number satisfies");
  EXPECT_EQ(Said([](ProblemData& d) { d.row_upper[1] = d.row_lower[1] = -kInfinity; }),
            "row[1] has the bounds -inf and -inf, which no number satisfies");
  EXPECT_EQ(Said([](ProblemData& d) { d.x_lower[0] = kNaN; }),
            "x[0] has the bounds nan and 4, which must be numbers");
}

TEST(CheckProblem, Numbers) {
  EXPECT_EQ(Said([](ProblemData& d) { d.q[1] = kNaN; }), "q[1] must be a finite number, got nan");
  EXPECT_EQ(Said([](ProblemData& d) { d.g[4] = kInfinity; }),
            "g[4] must be a finite number, got inf");
  EXPECT_EQ(Said([](ProblemData& d) { d.offset = kNaN; }),
            "the offset must be a finite number, got nan");
  EXPECT_EQ(Said([](ProblemData& d) { d.A.value[1] = kInfinity; }),
            "A: the coefficient of x[0] in row 1 is inf");
  EXPECT_EQ(Said([](ProblemData& d) { d.F.value[3] = kNaN; }),
            "F: the coefficient of x[1] in row 5 is nan");
}

TEST(CheckProblem, Matrices) {
  EXPECT_EQ(Said([](ProblemData& d) { d.A.rows = 3; }), "A needs 2 x 2, got 3 x 2");
  EXPECT_EQ(Said([](ProblemData& d) { d.A.row[1] = 2; }),
            "A: an entry of column 0 is in row 2 of 2");
  EXPECT_EQ(Said([](ProblemData& d) { d.A.row[0] = -1; }),
            "A: an entry of column 0 is in row -1 of 2");
  EXPECT_EQ(Said([](ProblemData& d) { d.A.row[1] = 0; }), "A: the rows of column 0 do not ascend");
  EXPECT_EQ(Said([](ProblemData& d) {
              d.A.start = {0, 5, 4};
            }),
            "A: the starts of column 1 do not ascend");
  EXPECT_EQ(Said([](ProblemData& d) { d.A.start[0] = 1; }), "A: column starts must begin at 0");
  EXPECT_EQ(Said([](ProblemData& d) { d.A.value.clear(); }),
            "A needs rows and values of its entries");
  EXPECT_EQ(Said([](ProblemData& d) {
              d.P.start = {0, 2, 2};
              d.P.row = {0, 1};
              d.P.value = {1, 1};
            }),
            "P is given by its upper triangle, but has an entry in row 1 of column 0");
}

TEST(CheckProblem, Cones) {
  EXPECT_EQ(Said([](ProblemData& d) { d.cones.pop_back(); }),
            "the cones take 3 rows, the problem has 6");
  EXPECT_NE(Said([](ProblemData& d) { d.cones[1].kind = 77; }), "");
  EXPECT_NE(Said([](ProblemData& d) { d.cones[1] = {SY_CONE_POWER, 3, 1.5}; }), "");
  EXPECT_NE(Said([](ProblemData& d) { d.cones[1] = {SY_CONE_EXPONENTIAL, 4, 0}; }), "");
  EXPECT_NE(Said([](ProblemData& d) { d.cones[1] = {SY_CONE_PSD, 5, 0}; }), "");
  EXPECT_NE(Said([](ProblemData& d) { d.cones[0].dim = -3; }), "");
}

TEST(CheckProblem, Sections) {
  EXPECT_EQ(SaidOf([](sy_problem& p) { p.num_rows = -1; }),
            "a problem's counts cannot be negative");
  EXPECT_EQ(SaidOf([](sy_problem& p) { p.A = nullptr; }), "the problem has rows, but no matrix A");
  EXPECT_EQ(SaidOf([](sy_problem& p) { p.F = nullptr; }),
            "the problem has cone rows, but no matrix F");
  EXPECT_EQ(SaidOf([](sy_problem& p) { p.cones = nullptr; }),
            "the problem has 2 cones, but no list of them");
}

}  // namespace
}  // namespace switchyard::test
