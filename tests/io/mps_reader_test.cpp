#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/io/flat.hpp"
#include "switchyard/io/read.hpp"

namespace switchyard::io {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Read {
  std::unique_ptr<MathematicalProgram> program;
  FlatProgram flat;
  std::vector<std::string> notes;
};

Read ReadMps(const std::string& text) {
  Read read;
  read.program = ReadProgramText(text, "a.mps", {.notes = &read.notes});
  read.flat = Flattened(*read.program);
  return read;
}

// A file of columns x and y, x an integer within markers, with the given sections behind COLUMNS.
Read ReadTwoColumns(const std::string& behind) {
  return ReadMps(
      "NAME two\nROWS\n N cost\n L less\n G more\n E same\nCOLUMNS\n"
      " m 'MARKER' 'INTORG'\n x cost 1 less 2\n x more 3\n m 'MARKER' 'INTEND'\n"
      " y cost 4 same 5\n" +
      behind + "ENDATA\n");
}

std::vector<double> Vector(const Eigen::VectorXd& v) { return {v.begin(), v.end()}; }

TEST(MpsReader, MakesOneBindingOfEachKind) {
  const Read read = ReadTwoColumns("RHS\n r less 8 more 1\n r same 2\nQUADOBJ\n x x 2\n x y 1\n");
  EXPECT_EQ(read.program->name(), "two");
  EXPECT_EQ(read.program->linear_costs().size(), 1U);
  EXPECT_EQ(read.program->quadratic_costs().size(), 1U);
  EXPECT_EQ(read.program->affine_constraints().size(), 1U);
  EXPECT_EQ(read.program->bounding_box_constraints().size(), 1U);
  EXPECT_EQ(read.program->affine_constraints()[0].evaluator()->row_names(),
            (std::vector<std::string>{"less", "more", "same"}));
  EXPECT_EQ(read.program->VariableName(1), "y");
  EXPECT_EQ(Eigen::MatrixXd(read.flat.A), (Eigen::MatrixXd(3, 2) << 2, 0, 3, 0, 0, 5).finished());
  EXPECT_EQ(Eigen::MatrixXd(read.flat.Q), (Eigen::MatrixXd(2, 2) << 2, 1, 1, 0).finished());
  EXPECT_THAT(read.flat.row_lower, ElementsAre(-kInfinity, 1, 2));
  EXPECT_THAT(read.flat.row_upper, ElementsAre(8, kInfinity, 2));
}

TEST(MpsReader, TakesTheConstantOfTheObjectiveWithItsSignTurned) {
  EXPECT_EQ(ReadTwoColumns("RHS\n r cost -7\n").flat.constant, 7);
  EXPECT_EQ(ReadTwoColumns("RHS\n cost 7\n").flat.constant, -7);
}

TEST(MpsReader, PutsARangeOnTheSideThatTypeAndSignTell) {
  const std::string rhs = "RHS\n r less 8 more 1\n r same 2\n";
  Read read = ReadTwoColumns(rhs + "RANGES\n r less -3 more -4\n r same 5\n");
  EXPECT_THAT(read.flat.row_lower, ElementsAre(5, 1, 2));
  EXPECT_THAT(read.flat.row_upper, ElementsAre(8, 5, 7));
  read = ReadTwoColumns(rhs + "RANGES\n r same -5\n");
  EXPECT_THAT(read.flat.row_lower, ElementsAre(-kInfinity, 1, -3));
  EXPECT_THAT(read.flat.row_upper, ElementsAre(8, kInfinity, 2));
  read = ReadTwoColumns(rhs + "RANGES\n r same 0\n");
  EXPECT_EQ(read.flat.row_lower[2], read.flat.row_upper[2]);
}

TEST(MpsReader, TakesAnIntegerColumnWithoutBoundsForBinaryAndSaysSo) {
  const Read read = ReadTwoColumns("");
  EXPECT_EQ(read.program->variable_type(0), VariableType::kBinary);
  EXPECT_EQ(read.program->variable_type(1), VariableType::kContinuous);
  EXPECT_THAT(Vector(read.flat.lower), ElementsAre(0, 0));
  EXPECT_THAT(Vector(read.flat.upper), ElementsAre(1, kInfinity));
  EXPECT_THAT(read.notes, ElementsAre("an integer column without bounds is binary (\"x\")"));
}

TEST(MpsReader, LeavesAnIntegerColumnWithOneBoundOpenAtTheOtherSide) {
  for (const char* bound : {" LO b x 2\n", " LI b x 2\n"}) {
    const Read read = ReadTwoColumns(std::string("BOUNDS\n") + bound);
    EXPECT_EQ(read.program->variable_type(0), VariableType::kInteger);
    EXPECT_EQ(read.flat.lower(0), 2);
    EXPECT_EQ(read.flat.upper(0), kInfinity);
  }
  const Read read = ReadTwoColumns("BOUNDS\n PL b x\n");
  EXPECT_EQ(read.flat.upper(0), kInfinity);
  EXPECT_THAT(read.notes, IsEmpty());
}

TEST(MpsReader, KnowsEachTypeOfBound) {
  struct Case {
    const char* lines;
    double lower;
    double upper;
    bool integer;
  };
  for (const Case& c : std::vector<Case>{
           {" UP b y 3\n", 0, 3, false},
           {" LO b y 3\n", 3, kInfinity, false},
           {" FX b y 3\n", 3, 3, false},
           {" FR b y\n", -kInfinity, kInfinity, false},
           {" MI b y\n", -kInfinity, kInfinity, false},
           {" MI b y\n UP b y -2\n", -kInfinity, -2, false},
           {" PL b y\n", 0, kInfinity, false},
           {" BV b y\n", 0, 1, true},
           {" LI b y -2\n", -2, kInfinity, true},
           {" UI b y 9\n", 0, 9, true},
           {" UP y 3\n", 0, 3, false},
           {" FR y\n", -kInfinity, kInfinity, false},
           {" FR b y 0\n", -kInfinity, kInfinity, false},
           {" MI y 0\n", -kInfinity, kInfinity, false},
           {" UP b y 1e30\n LO b y -1e20\n", -kInfinity, kInfinity, false},
           {" UP b y inf\n LO b y -Infinity\n", -kInfinity, kInfinity, false},
       }) {
    const Read read = ReadTwoColumns(std::string("BOUNDS\n UP b x 1\n") + c.lines);
    EXPECT_EQ(read.flat.lower(1), c.lower) << c.lines;
    EXPECT_EQ(read.flat.upper(1), c.upper) << c.lines;
    EXPECT_EQ(read.program->variable_type(1) != VariableType::kContinuous, c.integer) << c.lines;
    EXPECT_THAT(read.notes, IsEmpty()) << c.lines;
  }
}

TEST(MpsReader, FreesAColumnBelowWhereItsUpperBoundIsNegativeAndTheLowerOneNotGiven) {
  Read read = ReadTwoColumns("BOUNDS\n UP b x 1\n UP b y -3\n");
  EXPECT_EQ(read.flat.lower(1), -kInfinity);
  EXPECT_EQ(read.flat.upper(1), -3);
  EXPECT_THAT(read.notes,
              ElementsAre("a column with a negative upper bound and no lower bound is free below "
                          "(\"y\")"));
  read = ReadTwoColumns("BOUNDS\n UP b x 1\n LO b y -5\n UP b y -3\n");
  EXPECT_EQ(read.flat.lower(1), -5);
  EXPECT_THAT(read.notes, IsEmpty());
}

TEST(MpsReader, KeepsBoundsThatCrossSoThatTheProgramIsInfeasible) {
  const Read read = ReadTwoColumns("BOUNDS\n UP b x 1\n LO b y 3\n UP b y 2\n");
  ASSERT_EQ(read.program->bounding_box_constraints().size(), 2U);
  EXPECT_EQ(read.flat.lower(1), 3);
  EXPECT_EQ(read.flat.upper(1), 2);
  EXPECT_THAT(read.notes, ElementsAre("the lower bound is above the upper one (\"y\")"));
}

// x = 0 or 2 <= x <= 5 holds for exactly those (x, b) that the two rows leave.
TEST(MpsReader, WritesASemicontinuousColumnWithABinaryAndTwoRows) {
  const Read read = ReadTwoColumns("BOUNDS\n UP b x 1\n LO b y 2\n SC b y 5\n");
  ASSERT_EQ(read.program->num_vars(), 3);
  EXPECT_EQ(read.program->VariableName(2), "y_on");
  EXPECT_EQ(read.program->variable_type(2), VariableType::kBinary);
  EXPECT_EQ(read.flat.row_names,
            (std::vector<std::string>{"less", "more", "same", "y_below", "y_above"}));
  const auto holds = [&](double y, double on) {
    const Eigen::Vector3d x(0, y, on);
    const Eigen::VectorXd rows = read.flat.A * x;
    bool all = (x.array() >= read.flat.lower.array()).all() &&
               (x.array() <= read.flat.upper.array()).all();
    for (const std::size_t i : {std::size_t{3}, std::size_t{4}}) {
      all = all && rows(static_cast<Eigen::Index>(i)) >= read.flat.row_lower[i] &&
            rows(static_cast<Eigen::Index>(i)) <= read.flat.row_upper[i];
    }
    return all;
  };
  for (const double y : {-1.0, 0.0, 1.0, 2.0, 3.0, 5.0, 6.0}) {
    EXPECT_EQ(holds(y, 0) || holds(y, 1), y == 0 || (y >= 2 && y <= 5)) << y;
  }
}

TEST(MpsReader, TakesASemicontinuousColumnThatMayBeSmallForAContinuousOne) {
  const Read read = ReadTwoColumns("BOUNDS\n UP b x 1\n SI b y 5\n");
  EXPECT_EQ(read.program->num_vars(), 2);
  EXPECT_EQ(read.flat.upper(1), 5);
  EXPECT_EQ(read.program->variable_type(1), VariableType::kInteger);
  EXPECT_THAT(read.notes, ElementsAre("a semicontinuous column whose bounds hold 0 is a continuous "
                                      "one (\"y\")"));
}

TEST(MpsReader, ReadsTheSenseBehindItsHeaderAndBelow) {
  const std::string rest = "ROWS\n N c\nCOLUMNS\n x c 1\nENDATA\n";
  for (const char* head : {"OBJSENSE MAX\n", "OBJSENSE\n MAX\n", "OBJSENSE\n    MAXIMIZE\n"}) {
    EXPECT_EQ(ReadMps(head + rest).program->objective_sense(), ObjectiveSense::kMaximize) << head;
  }
  EXPECT_EQ(ReadMps("OBJSENSE MIN\n" + rest).program->objective_sense(), ObjectiveSense::kMinimize);
  EXPECT_EQ(ReadMps(rest).program->objective_sense(), ObjectiveSense::kMinimize);
}

TEST(MpsReader, TakesTheFirstNRowOrTheOneThatIsNamed) {
  const std::string rest = "ROWS\n N a\n N b\n E e\nCOLUMNS\n x a 1 b 2\n x e 3\nENDATA\n";
  Read read = ReadMps(rest);
  EXPECT_EQ(read.flat.c(0), 1);
  EXPECT_THAT(read.notes, ElementsAre("a further N row is left out (\"b\")"));
  read = ReadMps("OBJNAME\n b\n" + rest);
  EXPECT_EQ(read.flat.c(0), 2);
  EXPECT_EQ(read.flat.row_names, std::vector<std::string>{"e"});
}

TEST(MpsReader, ReadsBothTrianglesOfQmatrixAsOneMatrix) {
  const Read read = ReadTwoColumns("QMATRIX\n x x 2\n x y 1\n y x 1\n y y 4\n");
  EXPECT_EQ(Eigen::MatrixXd(read.flat.Q), (Eigen::MatrixXd(2, 2) << 2, 1, 1, 4).finished());
}

TEST(MpsReader, ReadsFixedMpsWhereNamesHaveBlanks) {
  const Read read = ReadMps(
      "NAME          BLANKS\n"
      "ROWS\n"
      " N  MY COST\n"
      " G  ROW  1\n"
      "COLUMNS\n"
      "    X 1       MY COST            1.0   ROW  1             2.0\n"
      "RHS\n"
      "    RHS       ROW  1             4.0\n"
      "BOUNDS\n"
      " UP BND       X 1                9.0\n"
      "ENDATA\n");
  EXPECT_EQ(read.program->VariableName(0), "X 1");
  EXPECT_THAT(read.flat.row_names, ElementsAre("ROW  1"));
  EXPECT_THAT(read.flat.row_lower, ElementsAre(4));
  EXPECT_EQ(read.flat.upper(0), 9);
  EXPECT_THAT(read.notes,
              ElementsAre("fixed MPS, with blanks in names: at line 3 it is no free MPS"));
}

TEST(MpsReader, SaysWhatItLeavesOut) {
  const Read read = ReadMps(
      "NAME a b c\nROWS\n N o\n E e\nCOLUMNS\n x o 1 e 1\nRHS\n one e 1\n two e 2\n"
      "BOUNDS\n UP b x 4\n UP b x 5\nENDATA\nMORE\n");
  EXPECT_THAT(read.notes,
              ElementsAre("NAME: what stands behind the first word is left out (\"b c\")",
                          "RHS: only the first set is read, another is left out (\"two\")",
                          "an upper bound is given again: the last one counts (\"UP b x 5\")",
                          "what stands behind ENDATA is left out (\"MORE\")"));
  EXPECT_THAT(read.flat.row_lower, ElementsAre(1));
  EXPECT_EQ(read.flat.upper(0), 5);
}

TEST(MpsReader, TakesRowsInAnyOrderWithinAColumn) {
  const Read read =
      ReadMps("ROWS\n N o\n E a\n E b\n E c\nCOLUMNS\n x c 3 a 1\n x b 2\n y b 0\nENDATA\n");
  EXPECT_EQ(Eigen::MatrixXd(read.flat.A), (Eigen::MatrixXd(3, 2) << 1, 0, 2, 0, 3, 0).finished());
  EXPECT_EQ(read.flat.A.nonZeros(), 3);
}

TEST(MpsReader, ReadsAProblemWithoutRowsOrColumns) {
  EXPECT_EQ(ReadMps("ROWS\nCOLUMNS\nENDATA\n").program->num_vars(), 0);
  EXPECT_EQ(ReadMps("ROWS\n N o\nCOLUMNS\nRHS\n o 3\nENDATA\n").flat.constant, -3);
  EXPECT_EQ(ReadMps("ROWS\n E e\nCOLUMNS\nENDATA\n").flat.A.rows(), 1);
}

}  // namespace
}  // namespace switchyard::io
