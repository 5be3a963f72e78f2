#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <thread>

#include "switchyard/model/program.hpp"
#include "tests/model/cpu_time.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

TEST(Variables, StandUnderTheIndexInWhichTheyWereMade) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  const auto B = program.NewBinaryVariables(2, 2);
  const auto z = program.NewIntegerVariables(1);
  EXPECT_EQ(program.num_vars(), 8);
  EXPECT_EQ(program.FindDecisionVariableIndices({x, z}), (std::vector<int>{0, 1, 2, 7}));
  EXPECT_EQ(program.FindDecisionVariableIndex(B(1, 0)), 4);
  EXPECT_EQ(program.FindDecisionVariableIndex(B(0, 1)), 5);
  for (int i = 0; i < program.num_vars(); ++i) {
    EXPECT_EQ(program.FindDecisionVariableIndex(program.decision_variable(i)), i);
    EXPECT_EQ(program.decision_variables()[i], program.decision_variable(i));
  }
}

TEST(Variables, HaveTheTypeAndTheNameThatTheyWereMadeWith) {
  MathematicalProgram program;
  program.NewContinuousVariables(2, "x");
  EXPECT_FALSE(program.has_integers());
  program.NewBinaryVariables(1, "b");
  program.NewIntegerVariables(2, "z");
  program.NewContinuousVariables<2>("p");
  program.NewContinuousVariables<2, 2>("P");
  program.NewVariables({"COL1", "COL2"}, {VariableType::kContinuous, VariableType::kInteger});
  EXPECT_TRUE(program.has_integers());
  EXPECT_EQ(program.variable_type(1), VariableType::kContinuous);
  EXPECT_EQ(program.variable_type(2), VariableType::kBinary);
  EXPECT_EQ(program.variable_type(4), VariableType::kInteger);
  EXPECT_EQ(program.variable_type(11), VariableType::kContinuous);
  EXPECT_EQ(program.variable_type(12), VariableType::kInteger);
  EXPECT_EQ(program.VariableName(1), "x(1)");
  EXPECT_EQ(program.VariableName(2), "b");
  EXPECT_EQ(program.VariableName(5), "p(0)");
  EXPECT_EQ(program.VariableName(8), "P(1,0)");
  EXPECT_EQ(program.VariableName(12), "COL2");
}

TEST(Variables, OfASymmetricMatrixAreSharedAcrossItsDiagonal) {
  MathematicalProgram program;
  const auto X = program.NewSymmetricContinuousVariables(4);
  EXPECT_EQ(program.num_vars(), 10);
  std::set<Variable> distinct;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(X(i, j), X(j, i));
      distinct.insert(X(i, j));
      const int row = std::max(i, j);
      const int col = std::min(i, j);
      EXPECT_EQ(program.VariableName(program.FindDecisionVariableIndex(X(i, j))),
                Text("X(", row, ",", col, ")"));
    }
  }
  EXPECT_EQ(distinct.size(), 10u);
}

TEST(Variables, AreDistinctAcrossProgramsThatThreadsBuildSideBySide) {
  std::vector<MathematicalProgram> programs(4);
  std::vector<std::thread> threads;
  for (auto& program : programs) {
    threads.emplace_back([&program] {
      for (int k = 0; k < 1000; ++k) program.NewContinuousVariables(3);
    });
  }
  for (auto& thread : threads) thread.join();
  std::set<Variable> distinct;
  for (const auto& program : programs) {
    for (int i = 0; i < program.num_vars(); ++i) {
      distinct.insert(program.decision_variable(i));
      EXPECT_EQ(program.FindDecisionVariableIndex(program.decision_variable(i)), i);
    }
  }
  EXPECT_EQ(distinct.size(), 12000u);
}

TEST(Variables, AreFoundAMillionTimesWithinFiftyMilliseconds) {
  MathematicalProgram program;
  MathematicalProgram other;  // its variables in between keep the blocks apart
  for (int k = 0; k < 1000; ++k) {
    program.NewContinuousVariables(1000);
    other.NewContinuousVariables(1);
  }
  VectorXDecisionVariable x = program.decision_variables();
  std::shuffle(x.begin(), x.end(), std::mt19937(7));
  const CpuClock clock;
  std::int64_t sum = 0;
  for (const Variable v : x) sum += program.FindDecisionVariableIndex(v);
  const double taken = clock.seconds();
  EXPECT_EQ(sum, 499999500000);
  RecordProperty("seconds", Text(taken));
  if (kTimed) {
    EXPECT_LT(taken, 0.05);
  }
}

TEST(Variables, OfAnotherProgramKeepTheirIds) {
  MathematicalProgram theirs;
  const auto y = theirs.NewContinuousVariables(5, "y");
  MathematicalProgram ours;
  const auto x = ours.NewContinuousVariables(2, "x");
  ours.AddDecisionVariables({y[3], y[1], y[2], y[3], x[0]});
  EXPECT_EQ(ours.num_vars(), 5);
  EXPECT_EQ(ours.FindDecisionVariableIndices({y[3], y[1], y[2]}), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(ours.FindDecisionVariableIndex(x[0]), 0);
  EXPECT_FALSE(ours.Contains(y[0]));
  EXPECT_EQ(ours.VariableName(3), Text("v", y[1].get_id()));
  const auto more = ours.NewContinuousVariables(1, "more");
  EXPECT_EQ(ours.FindDecisionVariableIndex(more[0]), 5);
  EXPECT_EQ(ours.decision_variable(4), y[2]);
}

TEST(Variables, OfNoProgramAreNamedInTheError) {
  MathematicalProgram theirs;
  MathematicalProgram ours;
  const Variable y = theirs.NewContinuousVariables(1)[0];
  EXPECT_EQ(Said([&] { (void)ours.FindDecisionVariableIndex(y); }),
            Text("the variable with id ", y.get_id(), " is not of this program"));
  EXPECT_EQ(Said([&] { (void)ours.FindDecisionVariableIndex(Variable()); }),
            "a dummy variable belongs to no program");
  EXPECT_EQ(Said([&] {
              ours.AddDecisionVariables({y, Variable()});
            }),
            "AddDecisionVariables: variable 1 of 2 is a dummy, it belongs to no program");
  EXPECT_EQ(ours.num_vars(), 0);
}

TEST(Variables, OfAnImpossibleNumberAreRefused) {
  MathematicalProgram program;
  EXPECT_EQ(Said([&] { program.NewContinuousVariables(-1); }),
            "new variables: rows needs to be 0 or more, got -1");
  EXPECT_EQ(Said([&] { program.NewContinuousVariables(2, -3); }),
            "new variables: cols needs to be 0 or more, got -3");
  EXPECT_EQ(Said([&] { program.NewContinuousVariables(100000, 100000); }),
            "new variables: a program holds at most 2147483647, this one has 0 and got "
            "10000000000");
  EXPECT_EQ(Said([&] { program.NewVariables({"a"}, {}); }),
            "new variables: one type for each name, got 1 names and 0 types");
  EXPECT_EQ(Said([&] { (void)program.decision_variable(0); }), "decision variable 0: there are 0");
}

TEST(Variables, OfAnEmptyBlockLeaveNoTrace) {
  MathematicalProgram program;
  EXPECT_EQ(program.NewContinuousVariables(0).size(), 0);
  EXPECT_EQ(program.NewContinuousVariables(3, 0).rows(), 3);
  EXPECT_EQ(program.NewSymmetricContinuousVariables(0).size(), 0);
  program.NewContinuousVariables(1, "t");
  EXPECT_EQ(program.VariableName(0), "t");
}

TEST(InitialGuess, IsNaNWhereUnset) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.SetInitialGuess(x[1], 4);
  EXPECT_TRUE(std::isnan(program.GetInitialGuess(x[0])));
  EXPECT_EQ(program.GetInitialGuess(x[1]), 4);
  program.SetInitialGuess({x[2], x[0]}, Eigen::Vector2d(6, 5));
  EXPECT_EQ(program.initial_guess(), Eigen::Vector3d(5, 4, 6));
  program.SetInitialGuess(x[1], std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(program.GetInitialGuess(x)[1]));
  program.SetInitialGuessForAllVariables(Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(program.GetInitialGuess(x), Eigen::Vector3d(1, 2, 3));
}

TEST(InitialGuess, OfTheWrongSizeOrInfiniteSetsNothing) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  EXPECT_EQ(Said([&] { program.SetInitialGuess(x, Eigen::Vector3d::Zero()); }),
            "initial guess: 2 variables need as many values, got 3");
  EXPECT_EQ(Said([&] { program.SetInitialGuess(x, Eigen::Vector2d(1, INFINITY)); }),
            "initial guess: value 1 needs to be finite, or NaN for none, got inf");
  EXPECT_TRUE(std::isnan(program.GetInitialGuess(x[0])));
}

}  // namespace
}  // namespace switchyard
