// Mixed-integer backends against enumeration, on random programs of every class: what they call
// optimal, their points and their bounds.
//
// SWITCHYARD_RANDOM_PROGRAMS: programs of each class (40), those of seeds from 1 on.
// SWITCHYARD_MIXED_INTEGER: who is tested, "backend" or "backend:option=value:...", with commas
// ("branch-and-bound,branch-and-bound:engine=conic,branch-and-bound:engine=outer,highs").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

#include "tests/mip/enumerate.hpp"
#include "tests/mip/random_program.hpp"
#include "tests/nonlinear/backends.hpp"
#include "tests/support/answer_errors.hpp"

namespace switchyard::testing {
namespace {

constexpr double kAgreement = 1e-6;  // of objectives, relative to 1 + |optimum|
constexpr double kFeasible = 1e-6;   // violation of a point, absolute

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string Setting(const char* name, const char* fallback) {
  const char* set = std::getenv(name);
  return set != nullptr ? set : fallback;
}

std::uint32_t NumPrograms() {
  return static_cast<std::uint32_t>(std::stoul(Setting("SWITCHYARD_RANDOM_PROGRAMS", "40")));
}

/// A backend with options.
struct Contender {
  std::string text;  // as it was asked for
  std::string backend;
  std::vector<std::string> options;
};

std::vector<Contender> Contenders() {
  std::vector<Contender> all;
  for (const std::string& text :
       Split(Setting("SWITCHYARD_MIXED_INTEGER",
                     "branch-and-bound,branch-and-bound:engine=conic,branch-and-bound:engine=outer,"
                     "highs"),
             ',')) {
    std::vector<std::string> parts = Split(text, ':');
    Contender one{text, parts.front(), {}};
    one.options.assign(parts.begin() + 1, parts.end());
    all.push_back(one);
  }
  return all;
}

struct Drawn {
  Problem problem;
  Enumerated known;
};

/// The program of a class and seed with its optimum: enumerated once, whoever is tested.
const Drawn& DrawnProgram(ProgramClass c, std::uint32_t seed) {
  static std::map<std::pair<ProgramClass, std::uint32_t>, Drawn> drawn;
  const auto [at, is_new] = drawn.try_emplace({c, seed});
  if (is_new) {
    const ProblemData d = RandomProgram(c, seed);
    at->second = {Problem(d), Enumerate(Built(), d)};
  }
  return at->second;
}

class AgainstEnumeration : public ::testing::TestWithParam<std::tuple<Contender, ProgramClass>> {
 protected:
  static const Contender& contender() { return std::get<0>(GetParam()); }
  static ProgramClass program_class() { return std::get<1>(GetParam()); }
  void SetUp() override {
    SKIP_WITHOUT(contender().backend);
    const auto ranked =
        Built().Rank(DrawnProgram(program_class(), 1).problem.view(), contender().backend);
    if (!ranked.at(0).suitable) GTEST_SKIP() << ranked[0].why;
  }

  struct Tally {
    int solvable = 0, infeasible = 0, undecided = 0;
    std::int64_t nodes = 0;
    double distance = 0;  // the largest between objectives, relative
  };

  static BackendAnswer Answer(const Drawn& drawn) {
    sy_control control = Unlimited(2);
    control.relative_gap = 1e-9;
    control.absolute_gap = 1e-9;
    return SolveThroughHost(Built(), contender().backend, drawn.problem.view(), control,
                            contender().options);
  }

  /// What holds of any point that is called feasible.
  static void ExpectPoint(const ProblemData& d, const BackendAnswer& answer) {
    EXPECT_LE(PrimalError(d, answer.x), kFeasible);
    for (std::size_t j = 0; j < answer.x.size(); ++j) {
      if (d.integer[j] != 0) {
        EXPECT_NEAR(answer.x[j], std::round(answer.x[j]), 1e-6);
      }
    }
    const double cost = Objective(Problem(d).view(), answer.x.data());
    EXPECT_NEAR(answer.result.objective, cost, 1e-9 * (1 + std::abs(cost)));
  }

  void Expect(const Drawn& drawn, const BackendAnswer& answer) {
    const sy_result& r = answer.result;
    const double optimum = drawn.known.optimum, slack = kAgreement * (1 + std::abs(optimum));
    if (answer.status == SY_E_UNSUPPORTED && !contender().options.empty()) {
      GTEST_SKIP() << answer.error;  // an option that the class does not bear
    }
    ASSERT_EQ(answer.status, SY_OK) << answer.error;
    tally_.nodes += std::max<std::int64_t>(r.nodes, 0);
    if (optimum == kInfinity) {
      ++tally_.infeasible;
      EXPECT_EQ(r.termination, SY_INFEASIBLE) << answer.text;
      EXPECT_EQ(r.primal, SY_NO_POINT);
      return;
    }
    ++tally_.solvable;
    EXPECT_LE(r.bound, optimum + slack);
    if (r.termination != SY_OPTIMAL || r.primal != SY_FEASIBLE) {
      ADD_FAILURE() << "unproven: termination " << r.termination << ", objective " << r.objective
                    << ", bound " << r.bound << ": " << answer.text;
      return;
    }
    ExpectPoint(drawn.problem.data(), answer);
    EXPECT_NEAR(r.objective, optimum, slack);
    EXPECT_GE(r.bound, optimum - slack);
    const double distance = std::abs(r.objective - optimum) / (1 + std::abs(optimum));
    tally_.distance = std::max(tally_.distance, distance);
  }

  Tally tally_;
};

TEST_P(AgainstEnumeration, TheOptimumIsThatOfTheBestAssignment) {
  const std::uint32_t count = NumPrograms();
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    const Drawn& drawn = DrawnProgram(program_class(), seed);
    if (drawn.known.undecided > 0) {
      ++tally_.undecided;
      continue;
    }
    SCOPED_TRACE(::testing::Message() << NameOf(program_class()) << " of seed " << seed);
    Expect(drawn, Answer(drawn));
    if (HasFatalFailure()) break;
  }
  std::cout << contender().text << ", " << NameOf(program_class()) << ": " << tally_.solvable
            << " with an optimum, " << tally_.infeasible << " without a point, " << tally_.undecided
            << " undecided; " << tally_.nodes << " nodes, largest distance " << tally_.distance
            << "\n";
}

std::string NameOfTest(const ::testing::TestParamInfo<AgainstEnumeration::ParamType>& of) {
  std::string name = std::get<0>(of.param).text + "_" + NameOf(std::get<1>(of.param));
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

void PrintTo(const Contender& c, std::ostream* out) { *out << c.text; }
INSTANTIATE_TEST_SUITE_P(Random, AgainstEnumeration,
                         ::testing::Combine(::testing::ValuesIn(Contenders()),
                                            ::testing::ValuesIn(kProgramClasses)),
                         NameOfTest);

/// min 3 z + cost'(t, u) over a binary z, t free, u in [lower, upper], and a cone over F (z, t, u).
ProblemData SwitchedBlock(sy_cone_kind kind, const std::vector<std::int32_t>& order, double t_cost,
                          double lower, double upper) {
  ProblemData d;
  d.num_vars = 3;
  d.flags = SY_PROBLEM_CONVEX;
  d.q = {3, t_cost, 0};
  d.x_lower = {0, -kInfinity, lower};
  d.x_upper = {1, kInfinity, upper};
  d.integer = {1, 0, 0};
  d.P = Csc(3, 3);
  d.A = Csc(0, 3);
  d.F = Csc(3, 3);
  for (std::int32_t j = 0; j < 3; ++j) {
    const auto at = std::find(order.begin(), order.end(), j) - order.begin();
    d.F.row.push_back(static_cast<std::int32_t>(at));
    d.F.value.push_back(1);
    d.F.start[static_cast<std::size_t>(j) + 1] = j + 1;
  }
  d.g = {0, 0, 0};
  d.cones = {{kind, 3, 0}};
  return d;
}

// Where z = 0 is feasible, the cone is a face of linear rows there, without an interior.
TEST(Enumeration, KnowsWhatASwitchedOffConeLeaves) {
  SKIP_WITHOUT("conic");
  // 2 t z >= u^2: u = 0 without z; with u >= 1, z = 1 and t = 1/2.
  const auto square = [](double lower) {
    return Enumerate(Built(), SwitchedBlock(SY_CONE_ROTATED, {1, 0, 2}, 1, lower, 2)).optimum;
  };
  EXPECT_NEAR(square(-1), 0, 1e-7);
  EXPECT_NEAR(square(1), 3.5, 1e-6);
  // z exp(u / z) <= t: u <= 0 <= t without z; with u >= 1, t = e.
  const auto exponential = [](double lower, double upper) {
    return Enumerate(Built(), SwitchedBlock(SY_CONE_EXPONENTIAL, {2, 0, 1}, 1, lower, upper))
        .optimum;
  };
  EXPECT_NEAR(exponential(-1, 1), 0, 1e-7);
  EXPECT_NEAR(exponential(1, 2), 3 + std::exp(1), 1e-6);
  // z >= |(t, u)|, min 3 z + 4 t: nothing without z; with it 3 - 4, and with u >= 3/5, 3 - 16/5.
  const auto norm = [](double lower) {
    return Enumerate(Built(), SwitchedBlock(SY_CONE_SECOND_ORDER, {0, 1, 2}, 4, lower, 2));
  };
  EXPECT_NEAR(norm(-1).optimum, -1, 1e-6);
  EXPECT_NEAR(norm(0.6).optimum, 3 - 3.2, 1e-6);
  EXPECT_EQ(norm(1.5).optimum, kInfinity);
  EXPECT_EQ(norm(1.5).undecided, 0);
}

void ExpectProven(ProgramClass c, std::uint32_t seed) {
  SCOPED_TRACE(::testing::Message() << NameOf(c) << " of seed " << seed);
  const Drawn& drawn = DrawnProgram(c, seed);
  ASSERT_EQ(drawn.known.undecided, 0);
  const double optimum = drawn.known.optimum;
  const BackendAnswer answer =
      SolveThroughHost(Built(), "branch-and-bound", drawn.problem.view(), Unlimited());
  EXPECT_EQ(answer.result.termination, optimum < kInfinity ? SY_OPTIMAL : SY_INFEASIBLE)
      << answer.text;
  if (optimum < kInfinity) {
    EXPECT_NEAR(answer.result.objective, optimum, 1e-4 * (1 + std::abs(optimum)));
  }
}

// Rests without an interior, whose certificates have no duals or none that rounding leaves: an
// exponential cone that is switched off, a free diagonal of a semidefinite one, an optimum next to
// where a cone's boundary is flat.
TEST(BranchAndBound, ProvesWhatHasNoInterior) {
  SKIP_WITHOUT("branch-and-bound");
  SKIP_WITHOUT("conic");
  for (const std::uint32_t seed : {61, 272, 416}) ExpectProven(ProgramClass::kOnOff, seed);
  for (const std::uint32_t seed : {205, 992}) ExpectProven(ProgramClass::kSemidefinite, seed);
  ExpectProven(ProgramClass::kMixed, 1120);
  ExpectProven(ProgramClass::kExponential, 94);
  ExpectProven(ProgramClass::kPotentials, 150);
}

// A point is found while a node is looked at, and below it all integers of the node are fixed.
TEST(BranchAndBound, GoesOnWhereAPointLeavesNothingToSplit) {
  SKIP_WITHOUT("branch-and-bound");
  SKIP_WITHOUT("conic");
  ExpectProven(ProgramClass::kExponential, 990);
}

// No class is tested on one side alone, nor little of it.
TEST(RandomPrograms, OfEachClassAreFeasibleOrNotAndEnumerationSaysWhich) {
  SKIP_WITHOUT("conic");
  const int count = std::max(40, static_cast<int>(NumPrograms()));
  for (const ProgramClass c : kProgramClasses) {
    int feasible = 0, infeasible = 0;
    for (int seed = 1; seed <= count; ++seed) {
      const Enumerated& known = DrawnProgram(c, static_cast<std::uint32_t>(seed)).known;
      if (known.undecided == 0) ++(known.optimum < kInfinity ? feasible : infeasible);
    }
    std::cout << NameOf(c) << ": " << feasible << " with an optimum, " << infeasible
              << " without a point, of " << count << "\n";
    EXPECT_GE(feasible, count / 2) << NameOf(c);
    EXPECT_GE(infeasible, 1) << NameOf(c);
    EXPECT_LE(count - feasible - infeasible, 1 + count / 50) << NameOf(c);
  }
}

}  // namespace
}  // namespace switchyard::testing
