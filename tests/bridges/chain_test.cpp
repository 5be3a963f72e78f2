// Plans and chains of bridges, and what becomes of hints.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/bridges/bridge.hpp"
#include "switchyard/hints.h"
#include "tests/support/known_answers.hpp"

namespace switchyard::testing {
namespace {

constexpr Features kAllCones = Features{0x7f} << 32;

std::string Names(const BridgePlan& plan) {
  std::string text;
  for (const BridgeKind* kind : plan) text += (text.empty() ? "" : "; ") + std::string(kind->name);
  return text;
}

TEST(PlanBridges, NeedsNoneWhereEverythingIsTaken) {
  const Planned planned = PlanBridges(SY_ACCEPTS_ROWS, SY_ACCEPTS_ROWS | SY_ACCEPTS_BOUNDS);
  EXPECT_TRUE(planned.found);
  EXPECT_TRUE(planned.plan.empty());
}

TEST(PlanBridges, FindsAChain) {
  const Planned planned =
      PlanBridges(SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE,
                  ConeFeature(SY_CONE_ZERO) | ConeFeature(SY_CONE_NONNEGATIVE) |
                      ConeFeature(SY_CONE_SECOND_ORDER));
  ASSERT_TRUE(planned.found);
  EXPECT_EQ(planned.plan.size(), 4u) << Names(planned.plan);
  std::set<std::string> names;
  for (const BridgeKind* kind : planned.plan) names.insert(kind->name);
  EXPECT_EQ(names, (std::set<std::string>{
                       "variable bounds to rows", "rows to zero and nonnegative cones",
                       "quadratic objective to a rotated cone", "rotated to second-order cones"}));
}

/// Every chain of at most `length` bridges, tried one by one.
bool Reaches(Features features, Features abilities, std::size_t length) {
  if ((features & ~abilities) == 0) return true;
  if (length == 0) return false;
  for (const BridgeKind& kind : BridgeKinds()) {
    if ((features & kind.removes) == 0) continue;
    if (Reaches((features & ~kind.removes) | kind.adds, abilities, length - 1)) return true;
  }
  return false;
}

TEST(PlanBridges, FindsTheShortestChainAndSaysWhereThereIsNone) {
  Random random(1);
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    Features features = 0;
    Features abilities = 0;
    for (Features bit = 1; bit != 0; bit <<= 1) {
      const bool known = (bit & (SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS |
                                 SY_ACCEPTS_QUADRATIC_OBJECTIVE | kAllCones)) != 0;
      if (known && random.Chance(0.3)) features |= bit;
      if (known && random.Chance(0.4)) abilities |= bit;
    }
    const Planned planned = PlanBridges(features, abilities);
    if (!planned.found) {
      EXPECT_FALSE(Reaches(features, abilities, 5));
      EXPECT_NE(planned.missing, Features{0});
      EXPECT_EQ(planned.missing & abilities, Features{0});
      continue;
    }
    ++found;
    const std::size_t length = planned.plan.size();
    EXPECT_TRUE(length == 0 || !Reaches(features, abilities, length - 1)) << Names(planned.plan);
    Features after = features;
    for (const BridgeKind* kind : planned.plan) after = (after & ~kind->removes) | kind->adds;
    EXPECT_EQ(after & ~abilities, Features{0}) << Names(planned.plan);
  }
  EXPECT_GT(found, 30);
}

TEST(PlanBridges, SaysWhatNoBridgeRemoves) {
  const Planned planned = PlanBridges(
      SY_ACCEPTS_BOUNDS | ConeFeature(SY_CONE_POWER) | SY_ACCEPTS_INTEGER, SY_ACCEPTS_ROWS);
  EXPECT_FALSE(planned.found);
  EXPECT_EQ(DescribeFeatures(planned.missing), "integer variables, power cones");
}

TEST(DescribeFeatures, NamesEverySectionAndCone) {
  EXPECT_EQ(DescribeFeatures(~Features{0}),
            "variable bounds, linear rows, a quadratic objective, a nonconvex objective, integer "
            "variables, nonlinear functions, zero cones, nonnegative cones, second-order cones, "
            "positive semidefinite cones, exponential cones, power cones, rotated second-order "
            "cones");
}

TEST(FeaturesOf, SeesSectionsThatArePresent) {
  Random random(2);
  const KnownAnswer known = KnownOptimum({.cones = {{SY_CONE_POWER, 3, 0.5}}}, random);
  EXPECT_EQ(FeaturesOf(Problem(known.problem).view()),
            SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | ConeFeature(SY_CONE_POWER));
  ProblemData d = KnownOptimum({.quadratic = true, .bounds = false}, random).problem;
  d.flags = 0;  // not known to be convex
  EXPECT_EQ(FeaturesOf(Problem(d).view()), Features{SY_ACCEPTS_ROWS} |
                                               SY_ACCEPTS_QUADRATIC_OBJECTIVE |
                                               SY_ACCEPTS_NONCONVEX_OBJECTIVE);
}

BridgePlan AllToCones() {
  return PlanBridges(SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE,
                     kAllCones & ~ConeFeature(SY_CONE_ROTATED))
      .plan;
}

TEST(BridgeChain, TakesOptimaThereAndBackThroughAllOfThem) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(seed);
    KnownAnswer known = KnownOptimum({.cones = AllCones(), .quadratic = true}, random);
    known.problem.cone_on.assign(known.problem.cones.size(), 1);
    known.problem.cones.push_back({SY_CONE_NONNEGATIVE, 1, 0});  // off: -1 >= 0 is not asked for
    known.problem.cone_on.push_back(0);
    known.problem.F = StackRows(known.problem.F, Csc(1, known.problem.num_vars));
    known.problem.g.push_back(-1);
    known.at.cone_dual.push_back(0);
    const Problem problem(known.problem);
    const BridgeChain chain(problem, AllToCones());
    Vectors v = known.at;
    chain.Forward(v);
    EXPECT_LT(OptimumError(chain.image().data(), v), 1e-9) << seed;
    EXPECT_EQ(FeaturesOf(chain.image().view()) &
                  (SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE),
              Features{0});
    chain.Back(v);
    for (std::size_t i = 0; i < v.row_dual.size(); ++i) {
      EXPECT_NEAR(v.row_dual[i], known.at.row_dual[i], 1e-9);
    }
    EXPECT_EQ(v.x, known.at.x);
    EXPECT_EQ(v.cone_dual.size(), known.at.cone_dual.size());
    EXPECT_EQ(v.cone_dual.back(), 0);
  }
}

TEST(BridgeChain, IsEmptyWhereNothingStandsBetween) {
  Random random(3);
  const Problem problem(KnownOptimum({}, random).problem);
  EXPECT_TRUE(BridgeChain(problem, {}).empty());
}

struct Hints {
  std::vector<std::int32_t> zeros = std::vector<std::int32_t>(16, 0);
  sy_sos1 sos1 = {sizeof(sy_sos1), 0, zeros.data(), zeros.data()};
  sy_branching branching = {sizeof(sy_branching), 0, zeros.data()};
  sy_blocks blocks = {sizeof(sy_blocks), 1, zeros.data(), zeros.data(), zeros.data(), nullptr};
  std::vector<sy_hint> list = {{"sy.sos1/1", &sos1},
                               {"sy.branching/1", &branching},
                               {"sy.blocks/1", &blocks},
                               {nullptr, nullptr}};
};

std::set<std::string> Kept(const BridgeChain& chain) {
  std::set<std::string> ids;
  const sy_hint* hint = chain.image().view().hints;
  for (; hint != nullptr && hint->id != nullptr; ++hint) ids.insert(hint->id);
  return ids;
}

TEST(BridgeChain, KeepsHintsOfVariablesAndSaysWhichItDropped) {
  Random random(4);
  const Hints hints;
  ProblemData d = KnownOptimum({.quadratic = true}, random).problem;
  d.hints = hints.list.data();
  const Problem problem(d);
  const BridgeChain rows(problem, PlanBridges(SY_ACCEPTS_ROWS, kAllCones).plan);
  EXPECT_EQ(Kept(rows), (std::set<std::string>{"sy.sos1/1", "sy.branching/1"}));
  EXPECT_EQ(rows.dropped_hints(),
            std::vector<std::string>{
                "the hint sy.blocks/1 was dropped: a bridge moved what it speaks of"});

  const BridgeChain appended(problem, PlanBridges(SY_ACCEPTS_QUADRATIC_OBJECTIVE, kAllCones).plan);
  EXPECT_EQ(Kept(appended), std::set<std::string>{"sy.sos1/1"});
  EXPECT_EQ(appended.dropped_hints().size(), 2u);
}

}  // namespace
}  // namespace switchyard::testing
