#include "solvers/mip/propagation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>

#include "switchyard/plugin.hpp"
#include "tests/mip/random_mixed_problem.hpp"

namespace switchyard::testing {
namespace {

using mip::Contradiction;
using mip::NodeBoxes;
using mip::Propagator;
using mip::VariableBox;
using mip::Workspace;

constexpr unsigned kProblems = 2000;

bool IsIn(const NodeBoxes& boxes, const Vector& x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (x[j] < boxes.lower()[j] || x[j] > boxes.upper()[j]) return false;
  }
  return true;
}

/// Boxes inside the problem's for some of the integers.
std::vector<VariableBox> Draw(Random& random, const RandomMixedProblem& p) {
  std::vector<VariableBox> drawn;
  for (std::int32_t j = 0; j < p.num_integers(); ++j) {
    if (!random.Chance(0.4)) continue;
    const auto at = static_cast<std::size_t>(j);
    const double lower = p.data().x_lower[at], upper = p.data().x_upper[at];
    const double v = lower + random.Below(static_cast<std::int32_t>(upper - lower) + 1);
    drawn.push_back({j, random.Chance(0.7) ? v : lower, random.Chance(0.7) ? v : upper});
  }
  return drawn;
}

void Impose(const std::vector<VariableBox>& drawn, NodeBoxes& boxes) {
  for (const VariableBox& box : drawn) boxes.Impose(box.variable, box.lower, box.upper);
}

/// Every point that is in what was imposed is in the boxes, so that some are left.
void ExpectHeld(const std::vector<Vector>& points, const std::vector<VariableBox>& imposed,
                bool left, const NodeBoxes& boxes) {
  for (const Vector& x : points) {
    const bool concerned = std::all_of(imposed.begin(), imposed.end(), [&](const VariableBox& box) {
      const double v = x[static_cast<std::size_t>(box.variable)];
      return box.lower <= v && v <= box.upper;
    });
    if (!concerned) continue;
    EXPECT_TRUE(left) << "a contradiction at " << boxes.contradiction().Name();
    EXPECT_TRUE(IsIn(boxes, x));
  }
}

TEST(Propagation, KeepsEveryFeasiblePointAtTheRootAndAtNodes) {
  int narrowed = 0, empty = 0, held = 0;
  for (unsigned seed = 0; seed < kProblems; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed);
    Random random(seed + 7);
    const auto points = p.Points(random);
    held += points.empty() ? 0 : 1;
    const Propagator propagator(p.view());
    Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    const bool left = propagator.Propagate(boxes, workspace, p.cutoff());
    ExpectHeld(points, {}, left, boxes);
    narrowed += boxes.Now().num_changes > 0 ? 1 : 0;
    for (int node = 0; left && node < 4; ++node) {
      const NodeBoxes::Mark mark = boxes.Now();
      const std::vector<VariableBox> imposed = Draw(random, p);
      Impose(imposed, boxes);
      const bool some = propagator.Propagate(boxes, workspace, p.cutoff());
      ExpectHeld(points, imposed, some, boxes);
      EXPECT_EQ(some, !boxes.contradiction());
      empty += some ? 0 : 1;
      boxes.UndoTo(mark);
    }
  }
  EXPECT_GT(narrowed, 1000);
  EXPECT_GT(empty, 500);
  EXPECT_GT(held, 1000);
}

TEST(Propagation, IsUndoneBitForBitAndGoesOnAsIfItHadNotBeen) {
  for (unsigned seed = 0; seed < kProblems; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed);
    const Propagator propagator(p.view());
    Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    Random random(seed);
    Impose(Draw(random, p), boxes);
    const NodeBoxes before = boxes;
    NodeBoxes never_undone = boxes;
    const NodeBoxes::Mark first = boxes.Now();
    (void)propagator.Propagate(boxes, workspace);
    const NodeBoxes::Mark second = boxes.Now();
    const NodeBoxes between = boxes;
    Impose(Draw(random, p), boxes);
    (void)propagator.Propagate(boxes, workspace, p.cutoff());
    boxes.UndoTo(second);
    EXPECT_EQ(boxes.lower(), between.lower());
    EXPECT_EQ(boxes.upper(), between.upper());
    boxes.UndoTo(first);
    EXPECT_EQ(boxes.lower(), before.lower());
    EXPECT_EQ(boxes.upper(), before.upper());
    EXPECT_EQ(bool(boxes.contradiction()), bool(before.contradiction()));
    Workspace other(propagator);
    EXPECT_EQ(propagator.Propagate(boxes, workspace, p.cutoff()),
              propagator.Propagate(never_undone, other, p.cutoff()));
    EXPECT_EQ(boxes.lower(), never_undone.lower());
    EXPECT_EQ(boxes.upper(), never_undone.upper());
  }
}

TEST(Propagation, ListsWhatItChanged) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed);
    const Propagator propagator(p.view());
    Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    const NodeBoxes::Mark mark = boxes.Now();
    NodeBoxes rebuilt = boxes, undone = boxes;
    if (!propagator.Propagate(boxes, workspace, p.cutoff())) continue;
    for (const VariableBox& box : boxes.NarrowedSince(mark)) {
      rebuilt.Impose(box.variable, box.lower, box.upper);
      EXPECT_TRUE(box.lower > undone.lower(box.variable) || box.upper < undone.upper(box.variable));
    }
    EXPECT_EQ(rebuilt.lower(), boxes.lower());
    EXPECT_EQ(rebuilt.upper(), boxes.upper());
    boxes.Commit();
    EXPECT_TRUE(boxes.ChangesSince({}).empty());
  }
}

/// By what share of its width at most, that of the reference, or absolutely where that is 0, is an
/// end of `boxes` outside of the reference?
double LargestExcess(const NodeBoxes& boxes, const Boxes& reference) {
  double largest = 0;
  for (std::size_t j = 0; j < reference.lower.size(); ++j) {
    const double excess =
        std::max(reference.lower[j] - boxes.lower()[j], boxes.upper()[j] - reference.upper[j]);
    if (!(excess > 0)) continue;
    largest = std::max(largest, excess / (1e-6 + reference.upper[j] - reference.lower[j]));
  }
  return largest;
}

TEST(Propagation, IsAsNarrowAsAllPassesOverEverything) {
  int wider = 0, compared = 0;
  for (unsigned seed = 0; seed < kProblems; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed);
    Random random(seed);
    const Propagator propagator(p.view());
    Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    if (!propagator.Propagate(boxes, workspace, p.cutoff())) continue;
    Impose(Draw(random, p), boxes);
    sy_problem node = p.view();
    const NodeBoxes imposed = boxes;
    node.x_lower = imposed.lower().data();
    node.x_upper = imposed.upper().data();
    const bool left = propagator.Propagate(boxes, workspace, p.cutoff());
    const Boxes reference = ProvenBoxes(node, p.cutoff());
    if (!left) continue;
    ++compared;
    EXPECT_FALSE(reference.infeasible);
    if (reference.infeasible) continue;
    const double excess = LargestExcess(boxes, reference);
    EXPECT_LE(excess, 0.01);
    wider += excess > boxes_detail::kRelevant ? 1 : 0;
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LE(wider, compared / 100);
}

/// `count` chains x_0 = 2 x_1 = 4 x_2, each with a cone (x_0, y).
ProblemData Chains(std::int32_t count) {
  ProblemData d;
  d.num_vars = 4 * count;
  d.A = Csc(2 * count, d.num_vars);
  d.F = Csc(2 * count, d.num_vars);
  const auto add = [](Csc& to, std::int32_t row, double value) {
    to.row.push_back(row);
    to.value.push_back(value);
  };
  for (std::int32_t c = 0; c < count; ++c) {
    for (std::int32_t k = 0; k < 4; ++k) {
      if (k == 1 || k == 2) add(d.A, 2 * c + k - 1, -2);
      if (k == 0 || k == 1) add(d.A, 2 * c + k, 1);
      if (k == 0) add(d.F, 2 * c, 1);
      if (k == 3) add(d.F, 2 * c + 1, 1);
      const auto j = static_cast<std::size_t>(4 * c + k);
      d.A.start[j + 1] = static_cast<std::int32_t>(d.A.row.size());
      d.F.start[j + 1] = static_cast<std::int32_t>(d.F.row.size());
      d.x_lower.push_back(k == 3 ? -kInfinity : 0);
      d.x_upper.push_back(k == 3 ? kInfinity : 8);
      d.integer.push_back(k != 3);
    }
    d.cones.push_back({SY_CONE_SECOND_ORDER, 2, 0});
  }
  for (auto* side : {&d.row_lower, &d.row_upper}) {
    side->assign(static_cast<std::size_t>(2 * count), 0.0);
  }
  d.g.assign(static_cast<std::size_t>(2 * count), 0.0);
  d.q.assign(static_cast<std::size_t>(d.num_vars), 0.0);
  return d;
}

TEST(Propagation, LooksAtWhatAChangeConcernsAndNothingElse) {
  const Problem problem(Chains(1000));
  const Propagator propagator(problem.view());
  Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_GE(workspace.work(), propagator.num_entries());
  EXPECT_EQ(boxes.upper(4 * 500 + 2), 2);
  EXPECT_NEAR(boxes.upper(4 * 500 + 3), 8, 1e-12);
  std::int64_t before = workspace.work();
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_EQ(workspace.work(), before) << "nothing was imposed";
  boxes.Impose(4 * 500 + 2, 1, 1);
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_EQ(boxes.lower(4 * 500), 4);
  EXPECT_EQ(boxes.upper(4 * 500), 4);
  EXPECT_NEAR(boxes.lower(4 * 500 + 3), -4, 1e-12);
  EXPECT_LT(workspace.work() - before, 40) << "one chain has 6 entries";
}

TEST(Propagation, TakesEachRowOfANonnegativeConeByItself) {
  ProblemData d = Chains(1000);
  d.F = Csc(1000, d.num_vars);
  for (std::int32_t c = 0; c < 1000; ++c) {
    d.F.row.push_back(c);
    d.F.value.push_back(-1);
    for (std::int32_t k = 4 * c + 1; k <= 4 * (c + 1); ++k)
      d.F.start[static_cast<std::size_t>(k)] = c + 1;
  }
  d.g.assign(1000, 6.0);
  d.cones = {{SY_CONE_NONNEGATIVE, 1000, 0}};
  const Problem problem(d);
  const Propagator propagator(problem.view());
  Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_EQ(boxes.upper(4 * 321), 4) << "at most 6, and a multiple of 4";
  const std::int64_t before = workspace.work();
  boxes.Impose(4 * 321, 0, 3);
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_EQ(boxes.upper(4 * 321), 0);
  EXPECT_LT(workspace.work() - before, 40) << "one chain has 5 entries";
}

// The head 0.3 - 0.3 z is 0 for z = 1, and the other one has no end.
TEST(Propagation, LeavesOfASwitchedOffConeItsFaceExactly) {
  const auto upper_of_u = [](sy_cone_kind kind, std::vector<std::int32_t> rows) {
    ProblemData d;  // (z, t, u)
    d.num_vars = 3;
    d.q = {0, 1, 0};
    d.x_lower = {0, -kInfinity, -3};
    d.x_upper = {1, kInfinity, 3};
    d.integer = {1, 0, 0};
    d.A = Csc(0, 3);
    d.F = Csc(3, 3);
    d.F.start = {0, 1, 2, 3};
    d.F.row = rows;
    d.F.value = {-0.3, 1, 1};
    d.g = {0, 0, 0};
    d.g[static_cast<std::size_t>(rows[0])] = 0.3;
    d.cones = {{kind, 3, 0.4}};
    const Problem p(d);
    const Propagator propagator(p.view());
    Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    EXPECT_TRUE(propagator.Propagate(boxes, workspace));
    EXPECT_EQ(boxes.upper(2), 3);
    boxes.Impose(0, 1, 1);
    EXPECT_TRUE(propagator.Propagate(boxes, workspace));
    return boxes.upper(2);
  };
  EXPECT_EQ(upper_of_u(SY_CONE_EXPONENTIAL, {1, 2, 0}), 0);
  EXPECT_EQ(upper_of_u(SY_CONE_ROTATED, {1, 0, 2}), 0);
  EXPECT_EQ(upper_of_u(SY_CONE_POWER, {0, 1, 2}), 0);
}

TEST(Propagation, IsSharedByThreads) {
  const Problem problem(Chains(200));
  const Propagator propagator(problem.view());
  const auto fix_one_after_another = [&propagator](NodeBoxes& boxes) {
    Workspace workspace(propagator);
    for (std::int32_t c = 0; c < 200; ++c) {
      boxes.Impose(4 * c + 2, c % 3, c % 3);
      (void)propagator.Propagate(boxes, workspace);
    }
  };
  std::vector<NodeBoxes> boxes(4, propagator.Bounds());
  std::vector<std::thread> threads;
  for (std::size_t k = 1; k < boxes.size(); ++k) {
    threads.emplace_back([&, k] { fix_one_after_another(boxes[k]); });
  }
  fix_one_after_another(boxes[0]);
  for (std::thread& thread : threads) thread.join();
  for (const NodeBoxes& of_thread : boxes) {
    EXPECT_EQ(of_thread.lower(), boxes[0].lower());
    EXPECT_EQ(of_thread.upper(), boxes[0].upper());
  }
  EXPECT_EQ(boxes[0].lower(4 * 5), 8);
}

TEST(Propagation, TakesACutoffThatFellAndForgetsItWhereThatIsUndone) {
  ProblemData d;
  d.num_vars = 1;
  d.q = {2};
  d.offset = 1;
  d.x_lower = {0};
  d.x_upper = {9};
  const Problem problem(d);
  const Propagator propagator(problem.view());
  Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  const NodeBoxes::Mark mark = boxes.Now();
  for (int again = 0; again < 2; ++again) {
    ASSERT_TRUE(propagator.Propagate(boxes, workspace, 7));
    EXPECT_NEAR(boxes.upper(0), 3, 1e-12);
    EXPECT_GE(boxes.upper(0), 3);
    ASSERT_TRUE(propagator.Propagate(boxes, workspace, 3));
    EXPECT_NEAR(boxes.upper(0), 1, 1e-12);
    EXPECT_FALSE(propagator.Propagate(boxes, workspace, 0.5));
    EXPECT_EQ(boxes.contradiction().Name(), "cutoff");
    boxes.UndoTo(mark);
    EXPECT_EQ(boxes.upper(0), 9);
  }
}

/// x_0, x_1 in [0, 1] with one row, one cone (0.5, x_0 + x_1) of order 2, and a group.
TEST(Propagation, SaysWhereNoPointIsLeft) {
  ProblemData d;
  d.num_vars = 3;
  d.q = {0, 0, 0};
  d.x_lower = {0, 0, 0};
  d.x_upper = {1, 1, 1};
  d.integer = {1, 1, 0};
  d.A = Csc(1, 3);
  d.A.row = {0};
  d.A.value = {1};
  d.A.start = {0, 0, 0, 1};
  d.row_lower = {-kInfinity};
  d.row_upper = {0.25};
  d.F = Csc(3, 3);
  d.F.row = {2};
  d.F.value = {1};
  d.F.start = {0, 1, 1, 1};
  d.g = {1, 0.5, 0};
  d.cones = {{SY_CONE_NONNEGATIVE, 1, 0}, {SY_CONE_SECOND_ORDER, 2, 0}};
  const std::vector<std::int32_t> start = {0, 2}, group = {1, 2};
  const sy_sos1 groups = {sizeof groups, 1, start.data(), group.data()};
  const std::vector<sy_hint> hints = {{"sy.sos1/1", &groups}, {nullptr, nullptr}};
  d.hints = hints.data();
  const Problem problem(d);
  const Propagator propagator(problem.view());
  Workspace workspace(propagator);
  const auto where = [&](const std::vector<VariableBox>& imposed) {
    NodeBoxes boxes = propagator.Bounds();
    for (const VariableBox& box : imposed) boxes.Impose(box.variable, box.lower, box.upper);
    const bool left = propagator.Propagate(boxes, workspace);
    EXPECT_EQ(left, !boxes.contradiction());
    EXPECT_EQ(propagator.Propagate(boxes, workspace), left) << "until it is undone";
    return boxes.contradiction().Name();
  };
  EXPECT_EQ(where({}), "");
  EXPECT_EQ(where({{2, 0.5, 1}}), "row[0]");
  EXPECT_EQ(where({{0, 1, 1}}), "cone[1]");
  EXPECT_EQ(where({{1, 1, 1}, {2, 0.1, 1}}), "group[0]");
  EXPECT_EQ(where({{0, 0.2, 0.7}}), "x[0]");
  EXPECT_EQ(where({{1, 2, 3}}), "x[1]");
}

TEST(Propagation, LeavesOneOfAGroup) {
  ProblemData d;
  d.num_vars = 3;
  d.q = {0, 0, 0};
  d.x_lower = {-2, -2, -2};
  d.x_upper = {2, 2, 2};
  const std::vector<std::int32_t> start = {0, 3}, group = {0, 1, 2};
  sy_sos1 groups = {sizeof groups, 1, start.data(), group.data()};
  const std::vector<sy_hint> hints = {{"sy.sos1/1", &groups}, {nullptr, nullptr}};
  d.hints = hints.data();
  const Problem problem(d);
  const Propagator propagator(problem.view());
  Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_EQ(boxes.lower(), d.x_lower);
  boxes.Impose(1, -2, -0.5);
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_EQ(boxes.lower(), (Vector{0, -2, 0}));
  EXPECT_EQ(boxes.upper(), (Vector{0, -0.5, 0}));
  const std::vector<std::int32_t> wrong = {0, 1, 3};
  groups.x = wrong.data();
  EXPECT_THROW(Propagator{problem.view()}, plugin::Failure);
}

TEST(Propagation, RoundsWhatIsKnownToBeAnInteger) {
  ProblemData d;
  d.num_vars = 2;
  d.q = {0, 0};
  d.x_lower = {0.5, 0.5};
  d.x_upper = {2.5, 2.5};
  const std::vector<std::int32_t> also = {1};
  const Problem problem(d);
  const Propagator propagator(problem.view(), also);
  const NodeBoxes boxes = propagator.Bounds();
  EXPECT_EQ(boxes.lower(), (Vector{0.5, 1}));
  EXPECT_EQ(boxes.upper(), (Vector{2.5, 2}));
}

TEST(Propagation, EndsWhereStepsAreManyAndSmall) {  // x <= 0.999 y, y <= 0.999 x: the limit is 0
  ProblemData d;
  d.num_vars = 2;
  d.q = {0, 0};
  d.x_lower = {0, 0};
  d.x_upper = {1e9, 1e9};
  d.integer = {1, 1};
  d.A = Csc(2, 2);
  d.A.row = {0, 1, 0, 1};
  d.A.value = {1, -0.9999, -0.9999, 1};
  d.A.start = {0, 2, 4};
  d.row_lower = {-kInfinity, -kInfinity};
  d.row_upper = {0, 0};
  const Problem problem(d);
  const Propagator propagator(problem.view());
  Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  ASSERT_TRUE(propagator.Propagate(boxes, workspace));
  EXPECT_LE(workspace.work(), (Propagator::kPasses + 1) * propagator.num_entries());
  EXPECT_EQ(boxes.lower(), (Vector{0, 0}));
}

}  // namespace
}  // namespace switchyard::testing
