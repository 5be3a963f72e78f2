#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <thread>

#include "programs.hpp"

namespace switchyard::test {
namespace {

class AnySolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(AnySolver);
INSTANTIATE_TEST_SUITE_P(Plugins, AnySolver, testing::ValuesIn(AllSolvers()), NameOf);

class PlainSolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(PlainSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, PlainSolver, testing::ValuesIn(SolversOf(kLinear)), NameOf);

TEST(PluginFolder, HasModules) {
  if (AllSolvers().empty()) GTEST_SKIP() << "no plugin was built";
}

TEST_P(AnySolver, DescribesItself) {
  const sy_solver& t = *GetParam().table;
  EXPECT_NE(std::string(t.id).find('.'), std::string::npos);
  EXPECT_FALSE(std::string(t.license).empty());
  EXPECT_NE(t.accepts, 0u);
  EXPECT_EQ(t.integer_accepts & ~t.accepts, 0u);
  EXPECT_EQ(t.updates != 0, t.update != nullptr);
  for (const sy_option* const* row = t.options; row != nullptr && *row != nullptr; ++row) {
    const sy_option& o = **row;
    EXPECT_GT(std::strlen(o.help), 0u) << o.name;
    if (o.fallback.type == SY_INTEGER) {
      EXPECT_LE(o.lower, static_cast<double>(o.fallback.as.integer)) << o.name;
      EXPECT_GE(o.upper, static_cast<double>(o.fallback.as.integer)) << o.name;
    }
    if (o.fallback.type == SY_REAL) {
      EXPECT_LE(o.lower, o.fallback.as.real) << o.name;
      EXPECT_GE(o.upper, o.fallback.as.real) << o.name;
    }
  }
}

TEST_P(AnySolver, TakesEveryOptionAtItsDefault) {
  BareSolver solver(GetParam());
  const sy_solver& t = solver.table();
  for (const sy_option* const* row = t.options; row != nullptr && *row != nullptr; ++row) {
    EXPECT_EQ(solver.SetOption((*row)->name, (*row)->fallback), SY_OK)
        << (*row)->name << ": " << solver.error().text;
  }
}

TEST_P(AnySolver, RefusesOptionsThatAreNotThere) {
  BareSolver solver(GetParam());
  sy_value value = {SY_INTEGER, 0, {}};
  value.as.integer = 1;
  EXPECT_EQ(solver.SetOption("no_such_option", value), SY_E_ARGUMENT);
  EXPECT_NE(std::string(solver.error().text).find("no_such_option"), std::string::npos);
}

TEST_P(AnySolver, RefusesValuesOutOfRangeAndOfAnotherType) {
  BareSolver solver(GetParam());
  const sy_solver& t = solver.table();
  for (const sy_option* const* row = t.options; row != nullptr && *row != nullptr; ++row) {
    const sy_option& o = **row;
    sy_value wrong = {SY_TEXT, 0, {}};
    wrong.as.text = "no such word";
    if (o.fallback.type != SY_TEXT || o.choices != nullptr) {
      EXPECT_EQ(solver.SetOption(o.name, wrong), SY_E_ARGUMENT) << o.name;
      EXPECT_NE(std::string(solver.error().text).find(o.name), std::string::npos);
    }
    if (o.fallback.type == SY_REAL && !std::isinf(o.lower)) {
      wrong = {SY_REAL, 0, {}};
      wrong.as.real = o.lower - 1 - std::abs(o.lower);
      EXPECT_EQ(solver.SetOption(o.name, wrong), SY_E_ARGUMENT) << o.name;
    }
  }
}

TEST_P(AnySolver, RefusesCallsOutOfOrder) {
  BareSolver solver(GetParam());
  sy_result result = {};
  result.size = sizeof result;
  const sy_control control = Freely();
  EXPECT_EQ(solver.table().solve(solver.instance(), &control, &result, &solver.error()),
            SY_E_STATE);
  sy_update update = {};
  update.size = sizeof update;
  if (solver.table().update != nullptr) {
    EXPECT_EQ(solver.table().update(solver.instance(), &update, &solver.error()), SY_E_STATE);
  }
}

TEST_P(PlainSolver, RunsTwoInstancesAtATime) {
  if ((GetParam().table->traits & SY_ONE_AT_A_TIME) != 0) GTEST_SKIP() << "one at a time";
  std::vector<double> alone(8);
  std::vector<double> beside(8);
  const auto solve = [&](std::size_t k) {
    const Problem problem(Random(60, 40, static_cast<unsigned>(k)));
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    return solver.Solve().result.objective;
  };
  for (std::size_t k = 0; k < alone.size(); ++k) alone[k] = solve(k);
  const auto every_other = [&](std::size_t from) {
    for (std::size_t k = from; k < beside.size(); k += 2) beside[k] = solve(k);
  };
  std::thread odd(every_other, 1);
  every_other(0);
  odd.join();
  EXPECT_EQ(alone, beside);
}

/// What a call wrote to standard output and standard error.
template <class Call>
std::string Written(Call&& call) {
  std::FILE* file = std::tmpfile();
  if (file == nullptr) return "no temporary file";
  std::fflush(nullptr);
  const int out = dup(1);
  const int error = dup(2);
  dup2(fileno(file), 1);
  dup2(fileno(file), 2);
  call();
  std::fflush(nullptr);
  dup2(out, 1);
  dup2(error, 2);
  close(out);
  close(error);
  std::rewind(file);
  std::string text;
  char part[4096];
  for (std::size_t got; (got = std::fread(part, 1, sizeof part, file)) > 0;) text.append(part, got);
  std::fclose(file);
  return text;
}

TEST_P(PlainSolver, WritesNothingAndLogsToTheHost) {
  ProblemData data = Random(30, 20, 4);
  const bool integer = (GetParam().table->integer_accepts & SY_ACCEPTS_INTEGER) != 0;
  if (integer) data.integer.assign(30, 1);
  const Problem problem(data);
  for (const int verbosity : {0, 2}) {
    std::string heard;
    BareSolver solver(GetParam());
    solver.host().context = &heard;
    solver.host().log = [](void* context, sy_level, const char* text) noexcept {
      static_cast<std::string*>(context)->append(text);
    };
    sy_control control = Freely();
    control.verbosity = verbosity;
    control.seconds = 5;
    EXPECT_EQ(Written([&] {
                solver.Load(problem.view());
                solver.Solve(control);
              }),
              "");
    if (verbosity == 0 || solver.Honors(SY_HONORS_VERBOSITY)) {
      EXPECT_EQ(heard.empty(), verbosity == 0);
    }
  }
}

}  // namespace
}  // namespace switchyard::test
