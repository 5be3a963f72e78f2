#include "switchyard/symbolic/variable_names.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "switchyard/model/new_ids.hpp"
#include "switchyard/model/program.hpp"
#include "tests/model/cpu_time.hpp"

namespace switchyard {
namespace {

TEST(NameOf, IsTheNameInTheProgramThatMadeTheVariable) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3, "x");
  const auto B = program.NewBinaryVariables(2, 2, "B");
  const auto S = program.NewSymmetricContinuousVariables(3, "S");
  const auto listed = program.NewVariables({"COL 1", "COL 2"}, {{}, {}});
  for (int i = 0; i < program.num_vars(); ++i) {
    EXPECT_EQ(NameOf(program.decision_variable(i)), program.VariableName(i));
  }
  EXPECT_EQ(NameOf(x[2]), "x(2)");
  EXPECT_EQ(NameOf(B(1, 0)), "B(1,0)");
  EXPECT_EQ(NameOf(S(0, 2)), "S(2,0)");
  EXPECT_EQ(NameOf(listed[1]), "COL 2");
}

TEST(NameOf, IsTheIdWhereNoProgramMadeTheVariable) {
  const Variable::Id first = NewVariableIds(2);
  EXPECT_EQ(NameOf(Variable(first)), "v" + std::to_string(first));
  EXPECT_EQ(NameOf(Variable()), "v0");
  MathematicalProgram program;
  program.AddDecisionVariables(Variable(first));
  EXPECT_EQ(NameOf(Variable(first)), "v" + std::to_string(first));
}

TEST(NameOf, LastsAsLongAsTheProgramOrAClone) {
  auto program = std::make_unique<MathematicalProgram>();
  const Variable x = program->NewContinuousVariables(1, "x")[0];
  auto clone = program->Clone();
  program.reset();
  EXPECT_EQ(NameOf(x), "x");
  clone.reset();
  EXPECT_EQ(NameOf(x), "v" + std::to_string(x.get_id()));
}

TEST(NameOf, OfAnotherProgramStaysThatOfItsMaker) {
  MathematicalProgram maker, other;
  const Variable x = maker.NewContinuousVariables(1, "x")[0];
  other.AddDecisionVariables(x);
  EXPECT_EQ(NameOf(x), "x");
}

TEST(NameOf, CostsOneEntryForABlock) {
  MathematicalProgram program;
  const CpuClock clock;
  const VectorXDecisionVariable x = program.NewContinuousVariables(1000000, "x");
  EXPECT_TRUE(!kTimed || clock.seconds() < 0.5) << clock.seconds();
  EXPECT_EQ(NameOf(x[999999]), "x(999999)");
}

TEST(NameOf, IsForAnyThread) {
  const auto make_and_ask = [] {
    for (int i = 0; i < 2000; ++i) {
      MathematicalProgram program;
      const Variable x = program.NewContinuousVariables(2, "x")[1];
      if (NameOf(x) != "x(1)") ADD_FAILURE();
    }
  };
  std::thread first(make_and_ask), second(make_and_ask);
  first.join();
  second.join();
}

}  // namespace
}  // namespace switchyard
