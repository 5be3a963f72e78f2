#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"
#include "tests/io/same_program.hpp"

namespace switchyard::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(MpsWriter, WritesWhatPeopleRead) {
  const std::string text =
      "NAME small\nOBJSENSE\n MAX\nROWS\n N objective\n L less\n G more\n E same\n G both\n"
      "COLUMNS\n x objective 1\n x less 2\n MARKER0 'MARKER' 'INTORG'\n i more 3\n i both 1\n"
      " b same 0.1\n MARKER1 'MARKER' 'INTEND'\n y objective 0\n"
      "RHS\n RHS objective -4\n RHS less 8\n RHS both 1\nRANGES\n RANGES both 2\n"
      "BOUNDS\n MI BOUNDS x\n UP BOUNDS x -1\n PL BOUNDS i\n BV BOUNDS b\n FR BOUNDS y\n"
      "QUADOBJ\n x x 2\n x y 1\nENDATA\n";
  EXPECT_EQ(ProgramText(*ReadProgramText(text, "a.mps"), FileFormat::kMps), text);
}

TEST(MpsWriter, ReplacesNamesThatCannotBeWrittenAndSaysSo) {
  MathematicalProgram program;
  program.set_name("my program");
  const auto x = program.NewVariables({"a", "a", "b c", "x1"},
                                      std::vector<VariableType>(4, VariableType::kContinuous));
  const auto rows = program.AddLinearConstraint(Eigen::MatrixXd::Ones(2, 4), Eigen::Vector2d(0, 0),
                                                Eigen::Vector2d(0, 0), x);
  rows.evaluator()->set_row_names({"objective", "r r"});
  std::vector<std::string> notes;
  const std::string text = ProgramText(program, FileFormat::kMps, &notes);
  EXPECT_THAT(
      notes,
      ElementsAre("the name of a variable is replaced: it is there before, or has blanks "
                  "(2 times, first: \"a\")",
                  "the name of a row is replaced: it is there before, or has blanks (\"r r\")",
                  "the name of the program is written as \"my_program\""));
  const auto again = ReadProgramText(text, "a.mps");
  EXPECT_EQ(again->VariableName(0), "a");
  EXPECT_EQ(again->VariableName(1), "x1_");
  EXPECT_EQ(again->VariableName(2), "x2");
  EXPECT_EQ(again->VariableName(3), "x1");
  EXPECT_EQ(switchyard::testing::Difference(program, *again), "");
}

TEST(MpsWriter, SaysBeforeItWritesWhatMpsCannotHold) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.AddLorentzConeConstraint(x);
  program.AddLorentzConeConstraint(x);
  program.AddL2NormCost(Eigen::MatrixXd::Identity(3, 3), Eigen::Vector3d(0, 0, 0), x);
  program.AddBoundingBoxConstraint(0, 1e25, x);
  EXPECT_THAT(CannotHold(program, FileFormat::kMps),
              ElementsAre("cones: 2 of kind Lorentz cone constraint",
                          HasSubstr("costs that are norms: 1 of kind "),
                          "bounds of 1e20 or more, which MPS takes for infinite: 1e+25"));
  EXPECT_THROW(WriteProgram(program, "no_such_folder/a.mps"), InvalidArgument);
  try {
    ProgramText(program, FileFormat::kMps);
    ADD_FAILURE();
  } catch (const InvalidArgument& error) {
    EXPECT_THAT(error.what(), HasSubstr("mps cannot hold this program; cones: 2 of kind Lorentz"));
  }
}

TEST(MpsWriter, WritesARowWithoutSidesAsAnNRow) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  const double infinity = std::numeric_limits<double>::infinity();
  program.AddLinearConstraint(Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Constant(1, -infinity),
                              Eigen::VectorXd::Constant(1, infinity), x);
  std::vector<std::string> notes;
  EXPECT_THAT(ProgramText(program, FileFormat::kMps, &notes), HasSubstr("\n N row0\n"));
  EXPECT_THAT(notes, ElementsAre("a row without sides is written as an N row, which readers leave "
                                 "out (\"row0\")"));
}

// The range is the difference of the sides, rounded; the writer picks one that gives both back.
TEST(MpsWriter, KeepsBothSidesOfARowToTheLastBit) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  const std::vector<std::pair<double, double>> sides = {
      {0.1, 0.3}, {-1e16, 1}, {1e-3, 1e9}, {-0.7, 0.1}, {1.0 / 3, 2.0 / 3}, {-1e-9, 1e17}};
  for (const auto& [lower, upper] : sides) {
    program.AddLinearConstraint(Eigen::RowVectorXd::Ones(1), lower, upper, x);
  }
  std::vector<std::string> notes;
  const auto again = ReadProgramText(ProgramText(program, FileFormat::kMps, &notes), "a.mps");
  EXPECT_THAT(notes, IsEmpty());
  EXPECT_EQ(switchyard::testing::Difference(program, *again), "");
}

TEST(CbfWriter, WritesWhatPeopleRead) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.AddBoundingBoxConstraint(0, std::numeric_limits<double>::infinity(), x.head(2));
  program.AddRotatedLorentzConeConstraint(x);
  program.AddLinearCost(Eigen::Vector3d(1, 0, -2), 0.5, x);
  program.AddLinearConstraint(Eigen::RowVector3d(1, 1, 0), 1, 1, x);
  EXPECT_EQ(ProgramText(program, FileFormat::kCbf),
            "VER\n1\n\nOBJSENSE\nMIN\n\nVAR\n3 2\nL+ 2\nF 1\n\nCON\n4 2\nL= 1\nQR 3\n\n"
            "OBJACOORD\n2\n0 1\n2 -2\n\nOBJBCOORD\n0.5\n\n"
            "ACOORD\n5\n0 0 1\n1 0 0.5\n0 1 1\n2 1 1\n3 2 1\n\nBCOORD\n1\n0 -1\n\n");
}

TEST(CbfWriter, DeclaresTheVersionThatHasItsCones) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(3, 3);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(3);
  EXPECT_THAT(ProgramText(program, FileFormat::kCbf), ::testing::StartsWith("VER\n1\n"));
  program.AddExponentialConeConstraint(I, zero, x);
  EXPECT_THAT(ProgramText(program, FileFormat::kCbf), ::testing::StartsWith("VER\n2\n"));
  program.AddPowerConeConstraint(I, zero, 0.3, x);
  EXPECT_THAT(ProgramText(program, FileFormat::kCbf), ::testing::StartsWith("VER\n3\n"));
}

TEST(CbfWriter, WritesMatricesOfVariablesAsSuchWhereNothingElseNeedsThemAsScalars) {
  MathematicalProgram program;
  const auto X = program.NewSymmetricContinuousVariables(2);
  const auto t = program.NewContinuousVariables(1);
  program.AddPositiveSemidefiniteConstraint(X);
  program.AddLinearCost(Eigen::Vector2d(1, 3), {t, X.col(0).tail(1)});
  std::vector<std::string> notes;
  const std::string text = ProgramText(program, FileFormat::kCbf, &notes);
  EXPECT_THAT(text, HasSubstr("PSDVAR\n1\n2\n\nVAR\n1 1\nF 1\n"));
  EXPECT_THAT(text, HasSubstr("OBJFCOORD\n1\n0 1 0 1.5\n\nOBJACOORD\n1\n0 1\n"));
  EXPECT_THAT(notes,
              ElementsAre("CBF keeps no names: variables and rows are known by their numbers",
                          "variables of semidefinite matrices are written as such, so others "
                          "move up"));
  // In two matrices, the second needs them as scalars.
  MatrixXDecisionVariable Y(2, 2);
  Y << X(0, 0), t(0), t(0), X(1, 1);
  program.AddPositiveSemidefiniteConstraint(Y);
  EXPECT_THAT(ProgramText(program, FileFormat::kCbf), HasSubstr("PSDCON\n2\n2\n2\n"));
}

TEST(CbfWriter, SaysBeforeItWritesWhatCbfCannotHold) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddQuadraticCost(Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(0, 0), x);
  EXPECT_THAT(CannotHold(program, FileFormat::kCbf), ElementsAre("costs that are quadratic: 1"));
  EXPECT_THROW(ProgramText(program, FileFormat::kCbf), InvalidArgument);
}

TEST(CbfWriter, WritesBoundsOtherThanZeroAsRowsAndSaysSo) {
  MathematicalProgram program;
  const auto x = program.NewBinaryVariables(2);
  std::vector<std::string> notes;
  EXPECT_THAT(ProgramText(program, FileFormat::kCbf, &notes),
              HasSubstr("INT\n2\n0\n1\n\nCON\n4 4\nL+ 1\nL- 1\nL+ 1\nL- 1\n"));
  EXPECT_THAT(notes[0],
              "a bound of a variable other than 0 is written as a row (4 times, first: "
              "\"b(0)\")");
}

}  // namespace
}  // namespace switchyard::io
