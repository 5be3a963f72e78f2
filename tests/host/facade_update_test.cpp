// Updates through the host's table: what a backend holds afterwards is what a fresh load gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <utility>

#include "core/problem/difference.hpp"
#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {
using testing::ElementsAre;

constexpr std::uint64_t kAllUpdates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES |
                                      SY_UPDATES_SWITCH | SY_UPDATES_APPEND | SY_UPDATES_REMOVE;
constexpr std::uint64_t kLinear = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS;
constexpr std::uint64_t kSecondOrder = std::uint64_t{1} << SY_CONE_SECOND_ORDER;
constexpr std::uint64_t kRotated = std::uint64_t{1} << SY_CONE_ROTATED;
constexpr std::uint64_t kNonnegative = std::uint64_t{1} << SY_CONE_NONNEGATIVE;
constexpr std::uint64_t kZero = std::uint64_t{1} << SY_CONE_ZERO;

/// A backend of these abilities with a problem in it.
struct Loaded {
  Loaded(const ProblemData& data, std::uint64_t accepts, std::uint64_t cones, std::uint64_t updates,
         std::uint64_t announced = kAllUpdates) {
    script.table.accepts = accepts;
    script.table.cones = cones;
    script.table.updates = updates;
    if (updates == 0) script.table.update = nullptr;
    Add(host, script);
    session.emplace(host, script);
    session->Load(data, announced);
  }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  Script script;
  Host host{Nowhere()};
  std::optional<Session> session;
};

/// Without the cones that are off: two backends hold the same where these are equal.
ProblemData Effective(const Problem& problem) {
  ProblemData d = problem.data();
  if (d.cone_on.empty()) return d;
  const std::vector<std::uint8_t> on = d.cone_on;
  problem_detail::KeepCones(on, d);
  d.cone_on.clear();
  return d;
}

/// The backend holds what one of the same abilities gets by a single load.
void ExpectInStep(const Loaded& loaded) {
  const sy_solver& table = loaded.script.table;
  const Loaded fresh(Effective(Problem(loaded.session->data())), table.accepts, table.cones, 0);
  const ProblemData has = Effective(loaded.script.problem);
  const ProblemData should = Effective(fresh.script.problem);
  EXPECT_EQ(ProblemDifference(should, has), 0U);
}

sy_update Bound(const std::int32_t& j, const double& lower, const double& upper) {
  sy_update update = NoUpdate();
  update.num_x = 1;
  update.x = &j;
  update.x_lower = &lower;
  update.x_upper = &upper;
  return update;
}

TEST(FacadeUpdate, ABackendWithoutUpdatesIsLoadedAnew) {
  Loaded loaded(SmallLp(), kLinear, 0, 0);
  EXPECT_EQ(loaded.script.announced, 0U);
  loaded.session->Update(Bound(1, 1, 2));
  EXPECT_EQ(loaded.session->loads(), 2);
  EXPECT_EQ(loaded.session->updates(), 0);
  EXPECT_THAT(loaded.script.problem.data().x_lower, ElementsAre(0, 1));
  ExpectInStep(loaded);
}

TEST(FacadeUpdate, ABackendHearsWhichOfItsKindsMayFollow) {
  const Loaded loaded(SmallLp(), kLinear, 0, SY_UPDATES_BOUNDS | SY_UPDATES_VALUES,
                      SY_UPDATES_VECTORS | SY_UPDATES_BOUNDS);
  EXPECT_EQ(loaded.script.announced, std::uint64_t{SY_UPDATES_BOUNDS});
}

TEST(FacadeUpdate, OnlyWhatWasAnnouncedIsSent) {
  Loaded loaded(SmallLp(), kLinear, 0, kAllUpdates, SY_UPDATES_VECTORS);
  loaded.session->Update(Bound(0, 1, 2));
  EXPECT_EQ(loaded.session->loads(), 2);
  ExpectInStep(loaded);
}

TEST(FacadeUpdate, SingleBoundsGoThroughAsTheyAre) {
  Loaded loaded(SmallLp(), kLinear, 0, SY_UPDATES_BOUNDS);
  loaded.session->Update(Bound(1, 1, 2));
  EXPECT_EQ(loaded.session->loads(), 1);
  EXPECT_EQ(loaded.script.last_update.num_x, 1);
  EXPECT_EQ(loaded.script.last_update.whole, 0U);
  ExpectInStep(loaded);
}

TEST(FacadeUpdate, SingleBoundsGoThroughBridgesThatKeepBounds) {
  Loaded loaded(SmallCones(), kLinear, kRotated, SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS);
  loaded.session->Update(Bound(1, 1, 2));
  EXPECT_EQ(loaded.session->loads(), 1);
  EXPECT_EQ(loaded.script.last_update.num_x, 1);
  ExpectInStep(loaded);
}

// The image of the bridges was made before the bounds went past it.
TEST(FacadeUpdate, BoundsThatWentStraightAndComeBackAnotherWayAreSentBack) {
  Loaded loaded(SmallCones(), kLinear, kRotated, SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS);
  loaded.session->Update(Bound(0, 2, 2));
  Problem back(SmallCones());
  back.Change([](ProblemData& d) { d.q = {5, 6}; });
  sy_update update = NoUpdate();
  update.whole = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS;
  update.problem = &back.view();
  loaded.session->Update(update);
  EXPECT_THAT(loaded.script.problem.data().x_lower, ElementsAre(0, 0));
  EXPECT_THAT(loaded.script.problem.data().x_upper, ElementsAre(4, 4));
  ExpectInStep(loaded);
}

TEST(FacadeUpdate, BoundsOfVariablesBecomeRowsWhereTheBackendHasNone) {
  Loaded loaded(SmallLp(), SY_ACCEPTS_ROWS, 0, SY_UPDATES_BOUNDS);
  loaded.session->Update(Bound(1, 1, 2));
  EXPECT_EQ(loaded.session->loads(), 1);
  EXPECT_THAT(loaded.script.kinds, ElementsAre(SY_UPDATES_BOUNDS));
  EXPECT_THAT(loaded.script.problem.data().row_lower, ElementsAre(1, -1, 0, 1));
  ExpectInStep(loaded);
}

// A problem that had no bounds needs a bridge once it has one.
TEST(FacadeUpdate, TheFirstBoundDoesNotReachABackendThatTakesNone) {
  for (const bool cones : {false, true}) {
    ProblemData free = cones ? SmallCones() : SmallLp();
    free.x_lower.clear();
    free.x_upper.clear();
    Loaded loaded(free, SY_ACCEPTS_ROWS, kRotated, SY_UPDATES_BOUNDS);
    loaded.session->Update(Bound(1, 1, 2));
    EXPECT_TRUE(loaded.script.problem.data().x_lower.empty());
    EXPECT_EQ(loaded.script.problem.data().num_rows(), 3);
    ExpectInStep(loaded);
  }
}

TEST(FacadeUpdate, TheDifferenceAloneIsSent) {
  for (const std::uint64_t cones : {kSecondOrder, kRotated}) {
    Loaded loaded(SmallCones(), kLinear, cones, kAllUpdates);
    Problem next(SmallCones());
    next.Change([](ProblemData& d) { d.q = {3, 4}; });
    sy_update update = NoUpdate();
    update.whole = SY_UPDATES_VECTORS;
    update.problem = &next.view();
    loaded.session->Update(update);
    EXPECT_EQ(loaded.session->loads(), 1);
    EXPECT_THAT(loaded.script.kinds, ElementsAre(SY_UPDATES_VECTORS));
    ExpectInStep(loaded);
  }
}

TEST(FacadeUpdate, WhereNothingDiffersBehindABridgeNothingIsSent) {
  Loaded loaded(SmallCones(), kLinear, kRotated, kAllUpdates);
  const Problem same(SmallCones());
  sy_update update = NoUpdate();
  update.whole = SY_UPDATES_VECTORS | SY_UPDATES_VALUES;
  update.problem = &same.view();
  loaded.session->Update(update);
  EXPECT_EQ(loaded.session->loads(), 1);
  EXPECT_EQ(loaded.session->updates(), 0);
}

sy_update Switch(const std::int32_t& cone, const std::uint8_t& on) {
  sy_update update = NoUpdate();
  update.num_cones = 1;
  update.cone = &cone;
  update.cone_on = &on;
  return update;
}

TEST(FacadeUpdate, ConesAreSwitchedWhereTheBackendCanAndLeftOutWhereItCannot) {
  for (const bool can : {true, false}) {
    const std::uint64_t updates = kAllUpdates & ~(can ? 0 : std::uint64_t{SY_UPDATES_SWITCH});
    Loaded loaded(SmallCones(), kLinear, kSecondOrder, updates);
    loaded.session->Update(Switch(0, 0));
    EXPECT_EQ(loaded.session->loads(), can ? 1 : 2);
    EXPECT_EQ(loaded.script.problem.data().num_cones(), can ? 2 : 1);
    EXPECT_EQ(Effective(loaded.script.problem).num_cones(), 1);
    ExpectInStep(loaded);
    loaded.session->Update(Switch(0, 1));
    EXPECT_EQ(Effective(loaded.script.problem).num_cones(), 2);
    ExpectInStep(loaded);
  }
}

TEST(FacadeUpdate, AConeThatIsOffHasTheDualZero) {
  Loaded loaded(SmallCones(), kLinear, kSecondOrder, 0);
  loaded.script.solve = [&](const sy_control&, sy_result& result) {
    result.termination = SY_OPTIMAL;
    result.primal = result.dual = SY_FEASIBLE;
    std::fill_n(result.x, 2, 1.0);
    std::fill_n(result.x_dual, 2, 0.0);
    std::fill_n(result.row_dual, 2, 0.0);
    std::fill_n(result.cone_dual, loaded.script.problem.data().num_cone_rows(), 5.0);
  };
  loaded.session->Update(Switch(0, 0));
  EXPECT_THAT(loaded.session->Solve().cone_dual, ElementsAre(0, 0, 0, 5, 5, 5));
}

TEST(FacadeUpdate, RowsAreRemovedAndAppended) {
  for (const std::uint64_t updates : {kAllUpdates, std::uint64_t{0}}) {
    for (const std::uint64_t accepts : {kLinear, std::uint64_t{SY_ACCEPTS_ROWS}}) {
      Loaded loaded(SmallLp(), accepts, 0, updates);
      const std::int32_t gone[] = {0};
      const std::int32_t start[] = {0, 2};
      const std::int32_t row[] = {0, 1};
      const double value[] = {2, 3};
      const sy_csc at = {2, 1, start, row, value};
      const double lower[] = {-5};
      const double upper[] = {6};
      sy_more more{};
      more.size = sizeof more;
      more.num_rows = 1;
      more.At = &at;
      more.row_lower = lower;
      more.row_upper = upper;
      sy_update update = NoUpdate();
      update.num_gone_rows = 1;
      update.gone_row = gone;
      update.more = &more;
      loaded.session->Update(update);
      EXPECT_EQ(loaded.session->data().num_rows(), 2);
      ExpectInStep(loaded);
      EXPECT_EQ(loaded.session->Solve().status, SY_OK);
    }
  }
}

TEST(FacadeUpdate, WhatTheBackendDoesNotTakeIsNotAppendedToIt) {
  Loaded loaded(SmallLp(), kLinear, 0, kAllUpdates);
  const std::uint8_t integer[] = {1};
  const double one[] = {1};
  const double zero[] = {0};
  sy_more more{};
  more.size = sizeof more;
  more.num_vars = 1;
  more.integer = integer;
  more.q = one;
  more.x_lower = zero;
  more.x_upper = one;
  sy_update update = NoUpdate();
  update.more = &more;
  EXPECT_THAT(Failed([&] { loaded.session->Update(update); }, SY_E_UNSUPPORTED),
              testing::HasSubstr("does not take integer variables"));
}

TEST(FacadeUpdate, AMistakenUpdateChangesNothing) {
  for (const std::uint64_t cones : {kSecondOrder, kRotated}) {
    Loaded loaded(SmallCones(), kLinear, cones, kAllUpdates);
    EXPECT_NE(Failed([&] { loaded.session->instance().Update(Bound(0, 3, 1)); }, SY_E_ARGUMENT),
              "");
    EXPECT_NE(Failed([&] { loaded.session->instance().Update(Bound(9, 0, 1)); }, SY_E_ARGUMENT),
              "");
    loaded.session->Update(Bound(1, 1, 2));
    ExpectInStep(loaded);
    EXPECT_EQ(loaded.session->Solve().status, SY_OK);
  }
}

TEST(FacadeUpdate, AfterOneThatTheBackendFailedALoadIsNeeded) {
  Loaded loaded(SmallLp(), kLinear, 0, kAllUpdates);
  loaded.script.update = [] { throw plugin::Failure(SY_E_INTERNAL, "lost count"); };
  EXPECT_THAT(Failed([&] { loaded.session->instance().Update(Bound(0, 1, 1)); }, SY_E_INTERNAL),
              testing::HasSubstr("lost count"));
  loaded.script.update = nullptr;
  const Answer answer = loaded.session->Solve();
  EXPECT_EQ(answer.status, SY_E_STATE);
  EXPECT_THAT(answer.error, testing::HasSubstr("load it again"));
  loaded.session->Load(SmallLp());
  EXPECT_EQ(loaded.session->Solve().status, SY_OK);
}

// ---- Any sequence ------------------------------------------------------------------------------

struct Random {
  std::mt19937 engine;
  int Below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }
  double Value() { return Below(9) - 4; }
};

/// Applies one random update to a session; what it points to lives here.
class AnyUpdate {
 public:
  AnyUpdate(Random& random, const ProblemData& now) : next_(now) {
    update_.size = sizeof update_;
    const int choice = random.Below(6);
    if (choice == 0) SingleBound(random, now);
    if (choice == 1) Whole(random);
    if (choice == 2) Row(random, now);
    if (choice == 3) Cone(random, now);
    if (choice == 4) Gone(random, now);
    if (choice == 5) More(random, now);
  }
  AnyUpdate(const AnyUpdate&) = delete;
  AnyUpdate& operator=(const AnyUpdate&) = delete;
  [[nodiscard]] const sy_update& get() const { return update_; }

 private:
  void SingleBound(Random& random, const ProblemData& now) {
    index_ = random.Below(now.num_vars);
    lower_ = random.Value();
    upper_ = lower_ + random.Below(3);
    update_ = Bound(index_, lower_, upper_);
  }
  void Whole(Random& random) {
    update_.whole = static_cast<std::uint32_t>(1 + random.Below(7));  // bounds, vectors, values
    next_.Change([&](ProblemData& d) {
      for (double& q : d.q) q = random.Value();
      for (double& g : d.g) g = random.Value();
      for (double& a : d.A.value) a = random.Value() + 5;
      for (double& f : d.F.value) f = random.Value() + 5;
      for (std::size_t j = 0; j < d.x_lower.size(); ++j) {
        d.x_upper[j] = d.x_lower[j] + random.Below(4);
      }
      d.cone_on.clear();
    });
    update_.problem = &next_.view();
  }
  void Row(Random& random, const ProblemData& now) {
    if (now.num_rows() == 0) return;
    index_ = random.Below(now.num_rows());
    lower_ = random.Value();
    upper_ = lower_ + random.Below(3);
    update_.num_rows = 1;
    update_.row = &index_;
    update_.row_lower = &lower_;
    update_.row_upper = &upper_;
  }
  void Cone(Random& random, const ProblemData& now) {
    if (now.num_cones() == 0) return;
    index_ = random.Below(now.num_cones());
    on_ = static_cast<std::uint8_t>(random.Below(2));
    update_ = Switch(index_, on_);
  }
  void Gone(Random& random, const ProblemData& now) {
    if (now.num_rows() == 0) return;
    index_ = random.Below(now.num_rows());
    update_.num_gone_rows = 1;
    update_.gone_row = &index_;
  }
  void More(Random& random, const ProblemData& now) {
    entry_ = random.Below(now.num_vars);
    at_ = {now.num_vars, 1, kOneEntry, &entry_, &one_};
    lower_ = random.Value();
    upper_ = lower_ + 1;
    more_.size = sizeof more_;
    more_.num_rows = 1;
    more_.At = &at_;
    more_.row_lower = &lower_;
    more_.row_upper = &upper_;
    update_.more = &more_;
  }

  static constexpr std::int32_t kOneEntry[] = {0, 1};
  Problem next_;
  sy_update update_{};
  sy_more more_{};
  sy_csc at_{};
  std::int32_t index_ = 0;
  std::int32_t entry_ = 0;
  double lower_ = 0, upper_ = 0, one_ = 1;
  std::uint8_t on_ = 1;
};

TEST(FacadeUpdate, AfterAnySequenceABackendHoldsWhatAFreshLoadGives) {
  const std::pair<std::uint64_t, std::uint64_t> abilities[] = {
      {kLinear, kSecondOrder},
      {kLinear, kRotated},
      {SY_ACCEPTS_ROWS, kSecondOrder},
      {SY_ACCEPTS_ROWS, kRotated},
      {0, kSecondOrder | kNonnegative | kZero},
      {SY_ACCEPTS_BOUNDS, kRotated | kNonnegative | kZero}};
  Random random{std::mt19937(7)};
  for (int trial = 0; trial < 60; ++trial) {
    const auto& [accepts, cones] = abilities[trial % std::size(abilities)];
    const auto updates = static_cast<std::uint64_t>(random.Below(64));
    const auto announced =
        trial % 3 == 0 ? static_cast<std::uint64_t>(random.Below(64)) : kAllUpdates;
    Loaded loaded(SmallCones(), accepts, cones, updates, announced);
    for (int step = 0; step < 25 && !testing::Test::HasFailure(); ++step) {
      const AnyUpdate any(random, loaded.session->data());
      loaded.session->Update(any.get());
      SCOPED_TRACE(Text("trial ", trial, ", step ", step, ", updates ", updates, " of ", announced,
                        ", accepts ", accepts, ", cones ", cones));
      ExpectInStep(loaded);
    }
  }
}

}  // namespace
}  // namespace switchyard::test
