#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/io/flat.hpp"
#include "switchyard/io/read.hpp"

namespace switchyard::io {
namespace {

using ::testing::ElementsAre;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::unique_ptr<MathematicalProgram> ReadCbf(const std::string& blocks) {
  return ReadProgramText("VER\n3\nOBJSENSE\nMIN\n" + blocks, "a.cbf");
}

// Is x in the one cone of the program, to 1e-9?
bool InCone(const MathematicalProgram& program, std::initializer_list<double> x) {
  EXPECT_EQ(program.cone_constraints().size(), 1U);
  const std::vector<double> values(x);
  const Eigen::Map<const Eigen::VectorXd> point(values.data(),
                                                static_cast<Eigen::Index>(values.size()));
  const Binding<Constraint> cone = program.cone_constraints()[0];
  return program.CheckSatisfied(cone, point, 1e-9);
}

TEST(CbfReader, TakesLinearConesOfVariablesForBounds) {
  const auto program = ReadCbf("VAR\n5 4\nL+ 1\nF 2\nL- 1\nL= 1\n");
  const FlatProgram flat = Flattened(*program);
  EXPECT_EQ(program->bounding_box_constraints().size(), 1U);
  EXPECT_THAT(std::vector<double>(flat.lower.begin(), flat.lower.end()),
              ElementsAre(0, -kInfinity, -kInfinity, -kInfinity, 0));
  EXPECT_THAT(std::vector<double>(flat.upper.begin(), flat.upper.end()),
              ElementsAre(kInfinity, kInfinity, kInfinity, 0, 0));
}

TEST(CbfReader, MakesOneBindingOfLinearRowsAndOneOfEachOtherCone) {
  const auto program = ReadCbf(
      "VAR\n3 1\nF 3\nCON\n7 4\nL= 1\nQ 3\nL- 2\nF 1\n"
      "OBJACOORD\n1\n1 -2\nOBJBCOORD\n5\n"
      "ACOORD\n5\n4 0 1\n0 0 2\n5 1 3\n1 2 1\n2 0 1\nBCOORD\n3\n0 1\n4 -6\n3 0.5\n");
  const FlatProgram flat = Flattened(*program);
  EXPECT_EQ(program->affine_constraints().size(), 1U);
  EXPECT_EQ(program->lorentz_cone_constraints().size(), 1U);
  EXPECT_EQ(Eigen::MatrixXd(flat.A),
            (Eigen::MatrixXd(4, 3) << 2, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 0).finished());
  EXPECT_THAT(flat.row_lower, ElementsAre(-1, -kInfinity, -kInfinity, -kInfinity));
  EXPECT_THAT(flat.row_upper, ElementsAre(-1, 6, 0, kInfinity));
  EXPECT_EQ(flat.c, Eigen::Vector3d(0, -2, 0));
  EXPECT_EQ(flat.constant, 5);
  EXPECT_TRUE(InCone(*program, {2, 0, 3}));   // (3, 2, 0.5)
  EXPECT_FALSE(InCone(*program, {3, 0, 3}));  // (3, 3, 0.5)
}

TEST(CbfReader, ReadsIntegers) {
  const auto program = ReadCbf("VAR\n3 1\nL+ 3\nINT\n2\n0\n2\n");
  EXPECT_EQ(program->variable_type(0), VariableType::kInteger);
  EXPECT_EQ(program->variable_type(1), VariableType::kContinuous);
  EXPECT_EQ(program->variable_type(2), VariableType::kInteger);
  EXPECT_EQ(program->VariableName(2), "x(2)");
}

TEST(CbfReader, ReadsTheRotatedConeWithItsTwo) {
  const auto program = ReadCbf("VAR\n3 1\nQR 3\n");
  EXPECT_TRUE(InCone(*program, {1, 2, 2}));  // 2 * 1 * 2 >= 2^2
  EXPECT_FALSE(InCone(*program, {1, 2, 2.01}));
  EXPECT_FALSE(InCone(*program, {-1, -2, 1}));
}

TEST(CbfReader, ReadsTheExponentialConeInItsOrder) {
  const auto program = ReadCbf("VAR\n3 1\nEXP 3\n");
  EXPECT_TRUE(InCone(*program, {2 * std::exp(0.5), 2, 1}));
  EXPECT_FALSE(InCone(*program, {2 * std::exp(0.5) - 1e-3, 2, 1}));
}

// Each point s of the dual that the reader makes has <s, x> >= 0 for all x of the cone, and on the
// boundary <s, x> = 0 for one of them.
TEST(CbfReader, ReadsTheDualExponentialConeAsTheDualItIs) {
  const auto program = ReadCbf("VAR\n3 1\nEXP* 3\n");
  for (const double v : {-2.0, -0.3, 0.0, 1.0, 4.0}) {
    // x = (exp(v), 1, v) is on the boundary; s = (1, exp(v) (v - 1), -exp(v)) is orthogonal to it.
    const double e = std::exp(v);
    EXPECT_TRUE(InCone(*program, {1 + 1e-8, e * (v - 1), -e})) << v;
    EXPECT_FALSE(InCone(*program, {1 - 1e-3, e * (v - 1), -e})) << v;
  }
}

TEST(CbfReader, ReadsPowerConesByTheirWeights) {
  const std::string head = "POWCONES\n1 2\n2\n1\n3\nPOW*CONES\n1 2\n2\n1\n3\n";
  const auto primal = ReadCbf(head + "VAR\n3 1\n@0:POW 3\n");
  EXPECT_EQ(primal->cone_constraints()[0].evaluator()->cone().parameter, 0.25);
  EXPECT_TRUE(InCone(*primal, {16, 1, -2}));
  EXPECT_FALSE(InCone(*primal, {16, 1, 2.01}));
  const auto dual = ReadCbf(head + "VAR\n3 1\n@0:POW* 3\n");
  // s = (0.25 x_2 / x_0, 0.75 x_2 / x_1, -1) is orthogonal to (16, 1, 2).
  EXPECT_TRUE(InCone(*dual, {0.25 * 2 / 16, 0.75 * 2 / 1, -1}));
  EXPECT_FALSE(InCone(*dual, {0.25 * 2 / 16, 0.75 * 2 / 1, -1.001}));
}

TEST(CbfReader, PutsMatricesBehindScalarsAndCountsOffDiagonalsTwice) {
  const auto program = ReadCbf(
      "PSDVAR\n1\n3\nVAR\n2 1\nF 2\nCON\n1 1\nL= 1\n"
      "OBJFCOORD\n2\n0 0 0 3\n0 1 2 1.5\nFCOORD\n2\n0 0 2 1 1\n0 0 2 2 4\nACOORD\n1\n0 1 7\n");
  ASSERT_EQ(program->num_vars(), 2 + 6);
  ASSERT_EQ(program->cone_constraints().size(), 1U);
  const auto& matrix = program->cone_constraints()[0];
  const auto variable = [&](int i, int j) {
    return program->FindDecisionVariableIndex(matrix.variables()(i + 3 * j));
  };
  const FlatProgram flat = Flattened(*program);
  EXPECT_EQ(flat.c(variable(0, 0)), 3);
  EXPECT_EQ(flat.c(variable(1, 2)), 3);
  EXPECT_EQ(flat.A.coeff(0, variable(2, 1)), 2);
  EXPECT_EQ(flat.A.coeff(0, variable(2, 2)), 4);
  EXPECT_EQ(flat.A.coeff(0, 1), 7);
  EXPECT_EQ(flat.A.nonZeros(), 3);
}

TEST(CbfReader, ReadsAffineMatricesAsLinearMatrixInequalities) {
  const auto program =
      ReadCbf("VAR\n2 1\nF 2\nPSDCON\n1\n2\nHCOORD\n2\n0 0 0 0 1\n0 1 1 0 1\nDCOORD\n1\n0 1 1 4\n");
  // [x_0, x_1; x_1, 4]
  EXPECT_TRUE(InCone(*program, {1, 2}));
  EXPECT_FALSE(InCone(*program, {1, 2.1}));
}

TEST(CbfReader, ReadsConesOfOneEntry) {
  const auto program = ReadCbf("VAR\n1 1\nF 1\nCON\n1 1\nQ 1\nACOORD\n1\n0 0 1\nBCOORD\n1\n0 -2\n");
  EXPECT_TRUE(InCone(*program, {2}));
  EXPECT_FALSE(InCone(*program, {1.9}));
}

TEST(CbfReader, ReadsAProblemWithoutVariables) {
  EXPECT_EQ(ReadCbf("")->num_vars(), 0);
  const auto program = ReadCbf("CON\n2 1\nL+ 2\nBCOORD\n1\n1 -1\n");
  EXPECT_EQ(Flattened(*program).row_lower, (std::vector<double>{0, 1}));
}

TEST(CbfReader, KeepsTheSense) {
  EXPECT_EQ(ReadProgramText("VER\n1\nOBJSENSE\nMAX\n", "a.cbf")->objective_sense(),
            ObjectiveSense::kMaximize);
}

}  // namespace
}  // namespace switchyard::io
