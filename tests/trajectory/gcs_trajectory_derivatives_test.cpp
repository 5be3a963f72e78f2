// Bounds of higher derivatives, continuity in time, and what is linear of them: by closed forms.
#include <cmath>

#include "switchyard/functions/check_derivatives.hpp"
#include "switchyard/model/function_terms.hpp"
#include "tests/trajectory/gcs_problems.hpp"

namespace switchyard {
namespace {

using namespace switchyard::testing;
using Transcription = GraphOfConvexSets::Transcription;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// One cubic at rest at both ends, 0 to 100, |d2q/dt2| <= 1: its control points are 0, 0, 100, 100,
/// so 6 * 100 / h^2 <= 1.
struct RestToRest : Through {
  explicit RestToRest(double h_min = 1e-3, double h_max = 1000)
      : Through(One(0), Range(-1, 101), One(100), 3, h_min, h_max) {
    gcs.AddTimeCost();
    out.AddZeroDerivativeConstraints(1);
    in.AddZeroDerivativeConstraints(1);
    gcs.AddNonlinearDerivativeBounds(One(-1), One(1), 2);
  }
  const double best = std::sqrt(600.0);
};

TEST(GcsDerivatives, FromRestToRestInTheLeastTime) {
  const RestToRest problem;
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, problem.best, 1e-4);
  EXPECT_LT(found.violation.derivative_bounds, 1e-5);
  const auto& q = found.trajectory;
  for (double t = 0; t <= q.end_time(); t += 1) {
    EXPECT_LE(std::abs(q.EvalDerivative(t, 2)(0)), 1 + 1e-5);
  }
  EXPECT_NEAR(q.EvalDerivative(q.start_time(), 1)(0), 0, 1e-5);
  EXPECT_NEAR(q.EvalDerivative(q.end_time(), 1)(0), 0, 1e-5);
}

TEST(GcsDerivatives, TheBoundIsNoMoreThanTheBest) {
  for (const double h_max : {25.0, 100.0, 1000.0}) {
    const RestToRest problem(1e-3, h_max);
    const GcsTrajectory found = problem.Find();
    ASSERT_TRUE(found.result().is_success()) << found.result().message;
    // The chord: 600 <= (h_min + h_max) h - h_min h_max.
    EXPECT_NEAR(found.result().bound, 600 / h_max, 1e-2 * 600 / h_max);
    EXPECT_LE(found.result().bound, problem.best);
    EXPECT_LE(found.search.relaxation_cost, problem.best);
  }
}

TEST(GcsDerivatives, SurrogatesGuideAndBoundNothing) {
  RestToRest problem;
  problem.gcs.UseSurrogates();
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.search.relaxation_cost, 600, 1e-2);
  EXPECT_NEAR(found.result().objective, problem.best, 1e-4);
  EXPECT_TRUE(std::isnan(found.result().bound));
  EXPECT_TRUE(std::isnan(found.result().gap()));
  // Later terms have theirs too: with h0 = 50 the surrogate is 600 <= 50 h.
  Through later(One(0), Range(-1, 101), One(100), 3, 1e-3, 1000);
  later.gcs.UseSurrogates(50);
  later.gcs.AddTimeCost();
  later.out.AddZeroDerivativeConstraints(1);
  later.in.AddZeroDerivativeConstraints(1);
  later.rooms.AddNonlinearDerivativeBounds(One(-1), One(1), 2);
  EXPECT_NEAR(later.Find().search.relaxation_cost, 12, 1e-3);
}

TEST(GcsDerivatives, WithAFixedDurationAllIsLinear) {
  // |d2q/dt2| <= 1 over 2 s at rest at the start: a quadratic goes no farther than 2.
  Through problem(One(0), Range(0, 9), One(2), 2, 2, 2);
  problem.out.AddZeroDerivativeConstraints(1);
  problem.gcs.AddNonlinearDerivativeBounds(One(-1), One(1), 2);
  problem.gcs.AddPathLengthCost();
  GraphOfConvexSetsOptions options;
  options.convex_relaxation = false;  // no term is nonlinear
  const GcsTrajectory found = problem.Find(options);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 2, 1e-5);
  EXPECT_LT(found.result().gap(), 1e-3);
}

TEST(GcsDerivatives, SidesAwayFromZeroAreBoundedByTangents) {
  // d2q/dt2 = 2 * 2 / h^2 >= 1 from rest to 2: the longest time is 2.
  Through problem(One(0), Range(0, 9), One(2), 2, 0.1, 10);
  problem.out.AddZeroDerivativeConstraints(1);
  problem.gcs.AddNonlinearDerivativeBounds(One(1), One(kInf), 2);
  problem.gcs.AddTimeCost(-1);
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, -2, 1e-5);
  EXPECT_LE(found.result().bound, -2 + 1e-6);
  EXPECT_GE(found.result().bound, -2.2);
  // The mirror image, by an upper side below 0.
  Through mirror(One(0), Range(-9, 0), One(-2), 2, 0.1, 10);
  mirror.out.AddZeroDerivativeConstraints(1);
  mirror.gcs.AddNonlinearDerivativeBounds(One(-kInf), One(-1), 2);
  mirror.gcs.AddTimeCost(-1);
  const GcsTrajectory other = mirror.Find();
  EXPECT_NEAR(other.result().objective, -2, 1e-5);
  EXPECT_NEAR(other.result().bound, found.result().bound, 1e-4);
}

TEST(GcsDerivatives, TheMixedIntegerProgramNamesWhatItCannotTake) {
  const RestToRest problem;
  GraphOfConvexSetsOptions options;
  options.convex_relaxation = false;
  const std::string text = Thrown([&] { (void)problem.Find(options); });
  EXPECT_NE(text.find("at rooms: 0: bounds of derivative 2"), std::string::npos) << text;
}

TEST(GcsDerivatives, NonlinearRowsHaveExactSparseDerivatives) {
  GcsTrajectoryOptimization gcs(2);
  auto& a = gcs.AddRegions(Box(Vector2d(0, 0), Vector2d(1, 1)), 4, 0.1, 5);
  auto& b = gcs.AddRegions(Box(Vector2d(0, 0), Vector2d(1, 1)), 3, 0.1, 5);
  auto& edges = gcs.AddEdges(a, b);
  a.AddNonlinearDerivativeBounds(Vector2d(-1, -2), Vector2d(1, kInf), 3);
  edges.AddContinuityConstraints(2);
  int functions = 0;
  const auto check = [&](const Binding<Constraint>& binding) {
    const auto* constraint = dynamic_cast<const FunctionConstraint*>(binding.evaluator().get());
    if (constraint == nullptr) return;
    ++functions;
    const Function& f = *constraint->function();
    EXPECT_TRUE(f.is_thread_safe());
    EXPECT_TRUE(f.has_hessian());
    const VectorXd x = VectorXd::LinSpaced(f.num_vars(), 0.3, 1.7);
    const DerivativeReport report = CheckDerivatives(f, x);
    EXPECT_TRUE(report.agrees()) << to_string(report);
    EXPECT_LT(f.jacobian().size(), f.num_vars() * f.num_outputs());
  };
  for (const auto& binding : a.Vertices()[0]->GetConstraints()) check(binding);
  for (const auto& binding : edges.Edges()[0]->GetConstraints()) check(binding);
  EXPECT_EQ(functions, 2);
}

TEST(GcsDerivatives, ContinuityInTimeIsThatOfVelocities) {
  // Straight segments: 1 at up to 1 m/s, then 2 at up to 2 m/s. With one velocity it is 1 m/s.
  GcsTrajectoryOptimization gcs(1);
  auto& slow = gcs.AddRegions(Range(0, 1), 1, 0.1, 20, "slow");
  auto& fast = gcs.AddRegions(Range(1, 3), 1, 0.1, 20, "fast");
  auto& start = gcs.AddRegions(At(One(0)), 0, 0, 0, "start");
  auto& goal = gcs.AddRegions(At(One(3)), 0, 0, 0, "goal");
  gcs.AddEdges(start, slow);
  auto& joint = gcs.AddEdges(slow, fast);
  gcs.AddEdges(fast, goal);
  gcs.AddTimeCost();
  slow.AddVelocityBounds(One(-1), One(1));
  fast.AddVelocityBounds(One(-2), One(2));
  EXPECT_NEAR(gcs.FindPath(start, goal).result().objective, 2, 1e-5);
  joint.AddContinuityConstraints(1);
  const GcsTrajectory found = gcs.FindPath(start, goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 3, 1e-5);
  ASSERT_EQ(found.violation.continuity.size(), 2u);
  EXPECT_LT(found.violation.continuity[1], 1e-5);
  EXPECT_LE(found.result().bound, 2 + 1e-6);  // nothing of it is in the relaxation
}

TEST(GcsDerivatives, ContinuityInTimeOfFixedDurationsIsLinear) {
  GcsTrajectoryOptimization gcs(1);
  auto& a = gcs.AddRegions(Range(0, 1), 3, 1, 1, "a");
  auto& b = gcs.AddRegions(Range(1, 3), 3, 2, 2, "b");
  auto& start = gcs.AddRegions(At(One(0)), 0, 0, 0, "start");
  auto& goal = gcs.AddRegions(At(One(3)), 0, 0, 0, "goal");
  gcs.AddEdges(start, a);
  auto& joint = gcs.AddEdges(a, b);
  gcs.AddEdges(b, goal);
  joint.AddContinuityConstraints(1);
  joint.AddContinuityConstraints(2);
  gcs.AddPathEnergyCost();
  const GcsTrajectory found = gcs.FindPath(start, goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_LT(found.violation.max(), 1e-6);
  EXPECT_LT(found.result().gap(), 1e-3);
  const auto& q = found.trajectory;
  for (const int k : {1, 2}) {
    EXPECT_NEAR(q.segment(0).EvalDerivative(1, k)(0), q.segment(1).EvalDerivative(1, k)(0), 1e-6);
  }
}

TEST(GcsDerivatives, PathContinuityIsOfTheCurvesByTheirParameter) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 5);
  problem.gcs.AddPathContinuityConstraints(1);
  problem.gcs.AddPathContinuityConstraints(2);
  problem.gcs.AddPathLengthCost();
  problem.gcs.AddTimeCost();
  problem.gcs.AddVelocityBounds(Vector2d(-1, -1), Vector2d(1, 1));
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  ASSERT_EQ(found.violation.path_continuity.size(), 3u);
  EXPECT_LT(found.violation.path_continuity[1], 1e-5);
  EXPECT_LT(found.violation.path_continuity[2], 1e-4);
  const auto normal = GcsTrajectoryOptimization::NormalizeSegmentTimes(found.trajectory);
  for (int k = 0; k + 1 < normal.get_number_of_segments(); ++k) {
    const double t = normal.end_time(k);
    EXPECT_LT((normal.segment(k).EvalDerivative(t, 1) - normal.segment(k + 1).EvalDerivative(t, 1))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-5);
    EXPECT_NEAR(normal.duration(k), 1, 1e-12);
  }
}

TEST(GcsDerivatives, OfEdgesEachSideHasItsOwnDuration) {
  // v goes from rest at 0 as far as |d2q/dt2| <= 1 on its side lets it in 2 s: 2. By u's duration
  // of 1 s it would be 0.5.
  GcsTrajectoryOptimization gcs(1);
  auto& u = gcs.AddRegions(At(One(0)), 2, 1, 1, "u");
  auto& v = gcs.AddRegions(Range(0, 100), 2, 2, 2, "v");
  auto& edges = gcs.AddEdges(u, v);
  edges.AddZeroDerivativeConstraints(1);
  edges.AddNonlinearDerivativeBounds(One(-1), One(1), 2);
  v.AddVertexCost(-v.vertex_control_points()(0, 2));
  const GcsTrajectory found = gcs.FindPath(u, v);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, -2, 1e-5);
  EXPECT_LT(found.violation.derivative_bounds, 1e-5);
}

TEST(GcsDerivatives, OfEdgesEachSideHasItsOwnDurationThatVaries) {
  GcsTrajectoryOptimization gcs(1);
  auto& u = gcs.AddRegions(At(One(0)), 2, 0.5, 1, "u");
  auto& v = gcs.AddRegions(Range(0, 100), 2, 1.5, 2, "v");
  auto& edges = gcs.AddEdges(u, v);
  edges.AddZeroDerivativeConstraints(1);
  edges.AddNonlinearDerivativeBounds(One(-1), One(1), 2);
  v.AddVertexCost(-v.vertex_control_points()(0, 2));
  const GcsTrajectory found = gcs.FindPath(u, v);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, -2, 1e-5);
  EXPECT_NEAR(found.result().bound, -2, 1e-3);  // the chord is exact at h_max
}

TEST(GcsDerivatives, ASideWhoseOrderIsTooLowIsLeftOut) {
  Through problem(One(0), Range(-1, 9), One(4), 2, 0.1, 20);
  problem.out.AddVelocityBounds(One(-1), One(1));  // of the rooms' side alone
  problem.out.AddNonlinearDerivativeBounds(One(-5), One(5), 2);
  problem.out.AddZeroDerivativeConstraints(2);
  problem.gcs.AddTimeCost();
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  // Of second derivative 0 and so straight, at 1 m/s.
  EXPECT_NEAR(found.result().objective, 4, 1e-4);
}

TEST(GcsDerivatives, WhatIsAskedOfAllReachesLaterSubgraphs) {
  GcsTrajectoryOptimization gcs(1);
  auto& before = gcs.AddRegions(Range(0, 1), 2, 0.1, 20, "before");
  auto& start = gcs.AddRegions(At(One(0)), 0, 0, 0, "start");
  gcs.AddTimeCost();
  gcs.AddPathLengthCost(0.5);
  gcs.AddPathEnergyCost(0);
  gcs.AddVelocityBounds(One(-1), One(1));
  gcs.AddNonlinearDerivativeBounds(One(-9), One(9), 2);
  gcs.AddPathContinuityConstraints(1);
  gcs.AddContinuityConstraints(1);
  auto& after = gcs.AddRegions(Range(1, 2), 2, 0.1, 20, "after");
  auto& straight = gcs.AddRegions(Range(1, 2), 1, 0.1, 20, "straight");
  auto& goal = gcs.AddRegions(At(One(2)), 0, 0, 0, "goal");
  const auto terms = [](Subgraph& subgraph) {
    return std::pair(subgraph.Vertices()[0]->GetCosts().size(),
                     subgraph.Vertices()[0]->GetConstraints().size());
  };
  EXPECT_EQ(terms(after), terms(before));
  EXPECT_EQ(terms(before), std::pair(std::size_t{3}, std::size_t{3}));
  EXPECT_EQ(terms(straight), std::pair(std::size_t{2}, std::size_t{1}));  // no second derivative
  EXPECT_EQ(terms(start), std::pair(std::size_t{1}, std::size_t{0}));
  gcs.AddEdges(start, before);
  auto& joint = gcs.AddEdges(before, after);
  gcs.AddEdges(after, goal);
  EXPECT_EQ(joint.Edges()[0]->GetConstraints().size(), 3u);  // joined, and twice continuous
  const GcsTrajectory found = gcs.FindPath(start, goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 3, 1e-4);
  EXPECT_LT(found.violation.continuity[1], 1e-5);
}

}  // namespace
}  // namespace switchyard
