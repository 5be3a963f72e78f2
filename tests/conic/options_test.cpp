// What a user may set, what is refused, and with which words.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "switchyard/plugin.hpp"
#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

sy_value Integer(std::int64_t v) {
  sy_value value = {};
  value.type = SY_INTEGER;
  value.as.integer = v;
  return value;
}
sy_value Real(double v) {
  sy_value value = {};
  value.type = SY_REAL;
  value.as.real = v;
  return value;
}
sy_value Text(const char* v) {
  sy_value value = {};
  value.type = SY_TEXT;
  value.as.text = v;
  return value;
}

/// The words with which a value is refused; empty where it is taken.
std::string Refusal(const char* name, const sy_value& value) {
  Conic conic(QuietHost());
  try {
    conic.SetOption(name, value);
  } catch (const plugin::Failure& failure) {
    EXPECT_EQ(failure.code(), SY_E_ARGUMENT);
    return failure.what();
  }
  return "";
}

KnownAnswer SomeProgram(unsigned seed = 1) {
  Random random(seed);
  testing::Shape shape{20, 10, {SecondOrder(5), Rotated(3), Exponential()}};
  shape.quadratic = true;
  return testing::KnownOptimum(shape, random);
}

TEST(Options, TakeEachRowsFallbackAndItsEnds) {
  int count = 0;
  for (const sy_option* const* row = Conic::Describe().options; *row != nullptr; ++row, ++count) {
    ASSERT_EQ((*row)->fallback.type, SY_INTEGER);
    EXPECT_EQ(Refusal((*row)->name, (*row)->fallback), "");
    EXPECT_EQ(Refusal((*row)->name, Integer(static_cast<std::int64_t>((*row)->lower))), "");
    EXPECT_EQ(Refusal((*row)->name, Integer(static_cast<std::int64_t>((*row)->upper))), "");
    EXPECT_NE(std::string((*row)->help), "");
  }
  EXPECT_GE(count, 4);
}

TEST(Options, RefuseWhatIsOutsideTheRangeOrNoInteger) {
  for (const sy_option* const* row = Conic::Describe().options; *row != nullptr; ++row) {
    const std::string name = (*row)->name;
    SCOPED_TRACE(name);
    const auto says = [&](const sy_value& value, const std::string& came) {
      const std::string refusal = Refusal(name.c_str(), value);
      EXPECT_NE(refusal.find("option " + name + " takes an integer in ["), std::string::npos)
          << refusal;
      EXPECT_NE(refusal.find("; " + came + " came"), std::string::npos) << refusal;
    };
    says(Integer(-1), "-1");
    says(Integer(static_cast<std::int64_t>((*row)->upper) + 1),
         std::to_string(static_cast<std::int64_t>((*row)->upper) + 1));
    says(Integer(std::numeric_limits<std::int64_t>::max()), "9223372036854775807");
    says(Real(0.5), "0.5");
    says(Real(1), "1");
    says(Text("yes"), "\"yes\"");
    says(Text(nullptr), "\"\"");
  }
}

TEST(Options, RefuseANameThatIsNone) {
  for (const char* name : {"tolerance", "", "Presolve", "presolve "}) {
    EXPECT_EQ(Refusal(name, Integer(1)), "conic has no option \"" + std::string(name) + '"');
  }
}

TEST(Options, ThatWereRefusedChangeNothing) {
  const KnownAnswer known = SomeProgram();
  Conic conic(QuietHost());
  const Problem problem(known.problem);
  conic.Load(problem.view(), 0);
  const Found before = SolveWith(conic, known.problem, Freely());
  EXPECT_THROW(conic.SetOption("max_iterations", Integer(-3)), plugin::Failure);
  EXPECT_THROW(conic.SetOption("corrections", Text("2")), plugin::Failure);
  EXPECT_EQ(SolveWith(conic, known.problem, Freely()).at.x, before.at.x);
}

TEST(Options, OfCorrectionsLeadToTheSameOptimum) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = SomeProgram(seed);
    for (const int corrections : {0, 1, 10}) {
      SCOPED_TRACE(corrections);
      const Found found = Solver().Set("corrections", corrections).Load(known.problem).Solve();
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    }
  }
}

TEST(Options, OfPresolveIsTold) {
  const KnownAnswer known = SomeProgram(2);
  ProblemData d = known.problem;
  d.row_lower.push_back(-kInfinity);  // a row that says nothing
  d.row_upper.push_back(1);
  d.A = StackRows(d.A, Csc(1, d.num_vars));
  const Found with = Solver().Set("presolve", 1).Load(d).Solve();
  const auto sizes = [](const Found& found) {
    int vars = 0, rows = 0, fewer_vars = 0, fewer_rows = 0;
    EXPECT_EQ(
        std::sscanf(found.text.c_str(), "presolved from %d variables and %d rows to %d and %d",
                    &vars, &rows, &fewer_vars, &fewer_rows),
        4)
        << found.text;
    return std::vector<int>{vars, rows, fewer_vars, fewer_rows};
  };
  EXPECT_EQ(sizes(with)[0], d.num_vars);
  EXPECT_EQ(sizes(with)[1], d.num_rows() + d.num_cone_rows());
  EXPECT_LT(sizes(with)[3], sizes(with)[1]);
}

TEST(Options, SetAfterALoadHoldForTheNextSolve) {
  const KnownAnswer known = SomeProgram(3);
  Solver solver(known.problem);
  const Found before = solver.Solve();
  solver.Set("max_iterations", 2);
  EXPECT_EQ(solver.Solve().result.iterations, 2);
  solver.Set("max_iterations", 200).Set("presolve", 0).Set("blocks", 0);
  const Found plain = solver.Solve();
  ExpectOptimal(known.problem, plain);
  EXPECT_EQ(plain.at.x,
            Solver().Set("presolve", 0).Set("blocks", 0).Load(known.problem).Solve().at.x);
  solver.Set("presolve", 1).Set("blocks", 1);
  EXPECT_EQ(solver.Solve().at.x, before.at.x);
}

TEST(Options, AreKeptByANewLoad) {
  Solver solver(SomeProgram(4).problem);
  solver.Set("max_iterations", 1);
  EXPECT_EQ(solver.Load(SomeProgram(5).problem).Solve().result.iterations, 1);
}

TEST(Supports, NoQuadraticObjectiveThatIsNotKnownToBeConvex) {
  KnownAnswer known = SomeProgram(6);
  Conic::Supports(QuietHost(), Problem(known.problem).view());
  known.problem.flags = 0;
  const Problem problem(known.problem);
  const auto refused = [&](auto&& call) {
    try {
      call();
      ADD_FAILURE() << "taken";
    } catch (const plugin::Failure& failure) {
      EXPECT_EQ(failure.code(), SY_E_UNSUPPORTED);
      EXPECT_NE(std::string(failure.what()).find("SY_PROBLEM_CONVEX"), std::string::npos);
    }
  };
  refused([&] { Conic::Supports(QuietHost(), problem.view()); });
  Conic conic(QuietHost());
  refused([&] { conic.Load(problem.view(), 0); });
}

TEST(Supports, NoUpdateToAnObjectiveThatIsNotKnownToBeConvex) {
  const KnownAnswer known = SomeProgram(7);
  Solver solver(known.problem, SY_UPDATES_VALUES);
  const Found before = solver.Solve();
  ProblemData d = known.problem;
  d.flags = 0;
  const Problem other(d);
  EXPECT_THROW(solver.Update(Whole(SY_UPDATES_VALUES, other)), plugin::Failure);
  EXPECT_EQ(solver.Solve().at.x, before.at.x);
}

TEST(Supports, NoFlagIsNeededWithoutAQuadraticObjective) {
  Random random(8);
  KnownAnswer known = testing::KnownOptimum({10, 5, {SecondOrder(3)}}, random);
  known.problem.flags = 0;
  ExpectOptimal(known.problem, Solver(known.problem).Solve());
}

TEST(Description, SaysAllConesAndNoIntegers) {
  const sy_solver t = Conic::Describe();
  for (sy_cone_kind kind = SY_CONE_ZERO; kind <= SY_CONE_ROTATED; ++kind) {
    EXPECT_NE(t.cones & (std::uint64_t{1} << kind), 0u) << kind;
  }
  EXPECT_EQ(t.accepts & (SY_ACCEPTS_INTEGER | SY_ACCEPTS_NLP | SY_ACCEPTS_NONCONVEX_OBJECTIVE), 0u);
  EXPECT_EQ(t.integer_accepts, 0u);
  EXPECT_NE(t.traits & SY_GIVES_CERTIFICATES, 0u);
}

}  // namespace
}  // namespace switchyard::conic
