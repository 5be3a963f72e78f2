// What vertices, edges and paths are read from a result: points that are written here, so that
// every value is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

/// A result by the values of placeholders.
class Written {
 public:
  void Set(Variable::Id first, const Eigen::VectorXd& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) values_[first + i] = values[i];
  }
  void Set(const Vertex& v, const Eigen::VectorXd& x) { Set(v.x()[0].get_id(), x); }
  /// The ends' points, not scaled.
  void Set(const Edge& e, double phi, const Eigen::VectorXd& xu, const Eigen::VectorXd& xv) {
    const Variable::Id first = e.phi().get_id();
    values_[first] = phi;
    Set(first + 1, phi * xu);
    Set(first + 1 + xu.size(), phi * xv);
  }
  [[nodiscard]] MathematicalProgramResult Result() const {
    std::vector<Variable> variables;
    Eigen::VectorXd x(static_cast<Eigen::Index>(values_.size()));
    for (const auto& [id, value] : values_) {
      x[static_cast<Eigen::Index>(variables.size())] = value;
      variables.emplace_back(id);
    }
    MathematicalProgramResult result;
    result.SetPoint(variables, x);
    return result;
  }

 private:
  std::map<Variable::Id, double> values_;
};

/// s -> a -> t and s -> t, of one dimension.
struct Triangle {
  GraphOfConvexSets graph;
  Vertex* s = graph.AddVertex(Box(), "s");
  Vertex* a = graph.AddVertex(Box(), "a");
  Vertex* t = graph.AddVertex(Box(), "t");
  Edge* sa = graph.AddEdge(s, a);
  Edge* at = graph.AddEdge(a, t);
  Edge* st = graph.AddEdge(s, t);

  static Hyperrectangle Box() {
    return Hyperrectangle(Eigen::VectorXd::Constant(1, -9), Eigen::VectorXd::Constant(1, 9));
  }
};

Eigen::VectorXd One(double x) { return Eigen::VectorXd::Constant(1, x); }

// 1/4 of the flow by a: x_s = 1 there and 2 on the straight edge; x_t = 5 and 3.
MathematicalProgramResult Fractional(const Triangle& g) {
  Written point;
  point.Set(*g.sa, 0.25, One(1), One(4));
  point.Set(*g.at, 0.25, One(4), One(5));
  point.Set(*g.st, 0.75, One(2), One(3));
  point.Set(*g.s, One(1.75));
  point.Set(*g.a, One(4));
  point.Set(*g.t, One(3.5));
  return point.Result();
}

TEST(Solution, OfARelaxationWeighsCostsByFlow) {
  Triangle g;
  const auto source = g.s->AddCost(g.s->x()[0] * g.s->x()[0]);
  const auto middle = g.a->AddCost(exp(g.a->x()[0]));
  const auto target = g.t->AddCost(g.t->x()[0] * g.t->x()[0]);
  const auto edge = g.sa->AddCost(g.sa->xu()[0] * g.sa->xv()[0]);
  const MathematicalProgramResult r = Fractional(g);
  EXPECT_NEAR(*g.s->GetSolutionCost(r, source), 0.25 * 1 + 0.75 * 4, 1e-12);
  EXPECT_NEAR(*g.a->GetSolutionCost(r, middle), 0.25 * std::exp(4.0), 1e-12);
  EXPECT_NEAR(*g.t->GetSolutionCost(r, target), 0.25 * 25 + 0.75 * 9, 1e-12);
  EXPECT_NEAR(*g.sa->GetSolutionCost(r, edge), 0.25 * 4, 1e-12);
  EXPECT_NEAR(*g.s->GetSolutionCost(r), 3.25, 1e-12);
  EXPECT_EQ(*g.st->GetSolutionCost(r), 0);
  EXPECT_EQ((*g.st->GetSolutionPhiXu(r))[0], 1.5);
  EXPECT_EQ((*g.st->GetSolutionPhiXv(r))[0], 2.25);
}

TEST(Solution, OfAPathHasTheCostsThemselves) {
  Triangle g;
  const auto at_s = g.s->AddCost(g.s->x()[0] + 1);
  const auto at_t = g.t->AddCost(2 * g.t->x()[0]);
  g.a->AddCost(100);
  const auto st = g.st->AddCost(g.st->xu()[0] - g.st->xv()[0]);
  const auto sa = g.sa->AddCost(100);
  Written point;
  point.Set(*g.sa, 0, One(0), One(0));
  point.Set(*g.at, 0, One(0), One(0));
  point.Set(*g.st, 1, One(2), One(3));
  point.Set(*g.s, One(2));
  point.Set(*g.a, One(std::nan("")));
  point.Set(*g.t, One(3));
  const MathematicalProgramResult r = point.Result();
  EXPECT_EQ(*g.s->GetSolutionCost(r, at_s), 3);
  EXPECT_EQ(*g.t->GetSolutionCost(r, at_t), 6);
  EXPECT_EQ(*g.st->GetSolutionCost(r, st), -1);
  EXPECT_EQ(*g.sa->GetSolutionCost(r, sa), 0);
  EXPECT_EQ(g.a->GetSolutionCost(r), std::nullopt);
  EXPECT_EQ(g.a->GetSolution(r), std::nullopt);
  EXPECT_EQ(*g.t->GetSolution(r), One(3));
}

// A walk s, a, t, a, ... has two edges out of a, and one point there.
TEST(Solution, CountsAVertexThatIsVisitedTwiceOnce) {
  Triangle g;
  Edge* ta = g.graph.AddEdge(g.t, g.a);
  g.a->AddCost(g.a->x()[0]);
  Written point;
  point.Set(*g.sa, 1, One(1), One(4));
  point.Set(*g.at, 1, One(4), One(5));
  point.Set(*ta, 1, One(5), One(4));
  point.Set(*g.st, 0, One(0), One(0));
  point.Set(*g.a, One(4));
  EXPECT_EQ(*g.a->GetSolutionCost(point.Result()), 4);
}

TEST(Solution, SumsTheTermsOfItsTranscription) {
  Triangle g;
  const auto guide = g.s->AddCost(g.s->x()[0], {Transcription::kRelaxation});
  const auto real = g.s->AddCost(10, {Transcription::kRestriction});
  const auto edge = g.st->AddCost(10, {Transcription::kRestriction});
  const MathematicalProgramResult r = Fractional(g);
  EXPECT_NEAR(*g.s->GetSolutionCost(r), 1.75, 1e-12);
  EXPECT_NEAR(*g.s->GetSolutionCost(r, guide), 1.75, 1e-12);
  EXPECT_NEAR(*g.s->GetSolutionCost(r, real), 10, 1e-12);
  EXPECT_EQ(*g.st->GetSolutionCost(r), 0);
  EXPECT_NEAR(*g.st->GetSolutionCost(r, edge), 7.5, 1e-12);
  Written path;
  path.Set(*g.st, 1, One(2), One(3));
  path.Set(*g.s, One(2));
  EXPECT_EQ(*g.s->GetSolutionCost(path.Result()), 10);
  EXPECT_EQ(*g.st->GetSolutionCost(path.Result()), 10);
  EXPECT_EQ(*g.s->GetSolutionCost(path.Result(), guide), 2);
}

TEST(Solution, ReadsSlacksOverTheirFlow) {
  Triangle g;
  const VectorXDecisionVariable s = g.st->NewSlackVariables(2);
  const auto cost = g.st->AddCost(s[0] * s[0] + s[1]);
  Written point;
  point.Set(*g.st, 0.5, One(2), One(3));
  point.Set(s[0].get_id(), 0.5 * Eigen::Vector2d(3, 4));
  EXPECT_NEAR(*g.st->GetSolutionCost(point.Result(), cost), 0.5 * (9 + 4), 1e-12);
}

TEST(Solution, OfNoDimensionIsEmptyWhereFlowPasses) {
  GraphOfConvexSets graph;
  Vertex* s = graph.AddVertex(Point(Eigen::VectorXd(0)), "s");
  Vertex* t = graph.AddVertex(Point(Eigen::VectorXd(0)), "t");
  Vertex* off = graph.AddVertex(Point(Eigen::VectorXd(0)), "off");
  const Edge* st = graph.AddEdge(s, t);
  const Edge* so = graph.AddEdge(s, off);
  s->AddCost(3);
  Written half, path;
  half.Set(st->phi().get_id(), One(0.5));
  half.Set(so->phi().get_id(), One(0));
  path.Set(st->phi().get_id(), One(1));
  path.Set(so->phi().get_id(), One(0));
  EXPECT_EQ(s->GetSolution(half.Result())->size(), 0);
  EXPECT_EQ(t->GetSolution(half.Result())->size(), 0);
  EXPECT_EQ(off->GetSolution(half.Result()), std::nullopt);
  EXPECT_EQ(*s->GetSolutionCost(half.Result()), 1.5);
  EXPECT_EQ(*s->GetSolutionCost(path.Result()), 3);
  EXPECT_EQ(st->GetSolutionPhiXu(path.Result())->size(), 0);
}

TEST(Solution, IsNoneWhereThereIsNone) {
  Triangle g;
  const auto cost = g.s->AddCost(1);
  const MathematicalProgramResult none;
  EXPECT_EQ(g.s->GetSolution(none), std::nullopt);
  EXPECT_EQ(g.s->GetSolutionCost(none), std::nullopt);
  EXPECT_EQ(g.s->GetSolutionCost(none, cost), std::nullopt);
  EXPECT_EQ(g.st->GetSolutionCost(none), std::nullopt);
  EXPECT_EQ(g.st->GetSolutionPhiXu(none), std::nullopt);
  EXPECT_EQ(g.st->GetSolutionPhiXv(none), std::nullopt);
}

TEST(Solution, HasNoCostOfOthers) {
  Triangle g;
  const auto cost = g.s->AddCost(1);
  const MathematicalProgramResult r = Fractional(g);
  try {
    (void)g.a->GetSolutionCost(r, cost);
    ADD_FAILURE();
  } catch (const InvalidArgument& e) {
    EXPECT_STREQ(e.what(), "linear cost is not a cost of vertex a");
  }
  try {
    (void)g.sa->GetSolutionCost(r, cost);
    ADD_FAILURE();
  } catch (const InvalidArgument& e) {
    EXPECT_STREQ(e.what(), "linear cost is not a cost of edge (s, a)");
  }
}

TEST(SolutionPath, FollowsTheLargestFlows) {
  Triangle g;
  Written point;
  point.Set(*g.sa, 0.9, One(1), One(4));
  point.Set(*g.at, 0.9, One(4), One(5));
  point.Set(*g.st, 0.1, One(2), One(3));
  const MathematicalProgramResult r = point.Result();
  EXPECT_EQ(g.graph.GetSolutionPath(*g.s, *g.t, r, 0.2), (std::vector<const Edge*>{g.sa, g.at}));
  EXPECT_EQ(g.graph.GetSolutionPath(*g.s, *g.t, r, 0.95), (std::vector<const Edge*>{g.sa, g.at}));
  EXPECT_TRUE(g.graph.GetSolutionPath(*g.a, *g.a, r).empty());
}

TEST(SolutionPath, SaysWhereTheFlowsEnd) {
  Triangle g;
  const MathematicalProgramResult r = Fractional(g);
  const auto said = [&](const MathematicalProgramResult& result, double tolerance) {
    try {
      (void)g.graph.GetSolutionPath(*g.s, *g.t, result, tolerance);
      return std::string();
    } catch (const InvalidArgument& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(said(r, 0.1),
            "GetSolutionPath: the flows form no path from s to t: none of at least 0.9 leaves s");
  EXPECT_EQ(said(r, 1), "GetSolutionPath needs a tolerance in [0, 1), got 1");
  MathematicalProgramResult infeasible;
  infeasible.termination = Termination::kInfeasible;
  EXPECT_EQ(said(infeasible, 0.1),
            "GetSolutionPath: the result has no flows: the solve ended with infeasible");
}

// A circulation beside the path is not followed for ever.
TEST(SolutionPath, EndsOnACycle) {
  Triangle g;
  Edge* as = g.graph.AddEdge(g.a, g.s);
  Written point;
  point.Set(*g.sa, 1, One(1), One(4));
  point.Set(*as, 1, One(1), One(4));
  EXPECT_THROW((void)g.graph.GetSolutionPath(*g.s, *g.t, point.Result()), InvalidArgument);
}

TEST(SampledPaths, AreDistinctAndAsLikelyAsTheirFlows) {
  Triangle g;
  GraphOfConvexSetsOptions options;
  const std::unordered_map<const Edge*, double> flows = {{g.sa, 0.25}, {g.at, 0.25}, {g.st, 0.75}};
  const auto both = g.graph.SamplePaths(*g.s, *g.t, flows, options);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NE(both[0], both[1]);
  options.max_rounded_paths = 1;
  int straight = 0;
  constexpr int kDraws = 2000;
  for (options.rounding_seed = 0; options.rounding_seed < kDraws; ++options.rounding_seed) {
    straight += g.graph.SamplePaths(*g.s, *g.t, Fractional(g), options)[0].size() == 1 ? 1 : 0;
  }
  EXPECT_NEAR(straight, 0.75 * kDraws, 5 * std::sqrt(0.75 * 0.25 * kDraws));
}

TEST(SampledPaths, HoldTheLimitsOfTheOptions) {
  Triangle g;
  GraphOfConvexSetsOptions options;
  options.flow_tolerance = 0.5;
  EXPECT_EQ(g.graph.SamplePaths(*g.s, *g.t, Fractional(g), options),
            (std::vector<std::vector<const Edge*>>{{g.st}}));
  options.flow_tolerance = 0.8;
  EXPECT_TRUE(g.graph.SamplePaths(*g.s, *g.t, Fractional(g), options).empty());
  options = {};
  options.max_rounded_paths = 0;
  EXPECT_TRUE(g.graph.SamplePaths(*g.s, *g.t, Fractional(g), options).empty());
  options.max_rounded_paths = -1;
  EXPECT_THROW((void)g.graph.SamplePaths(*g.s, *g.t, Fractional(g), options), InvalidArgument);
  EXPECT_THROW((void)g.graph.SamplePaths(*g.s, *g.t, MathematicalProgramResult(), {}),
               InvalidArgument);
}

// Ids of removed vertices and edges leave gaps that a path does not fall into.
TEST(SampledPaths, KnowNothingOfWhatWasRemoved) {
  Triangle g;
  const MathematicalProgramResult r = Fractional(g);
  g.graph.RemoveVertex(g.a);
  EXPECT_EQ(g.graph.SamplePaths(*g.s, *g.t, r, {}),
            (std::vector<std::vector<const Edge*>>{{g.st}}));
}

}  // namespace
}  // namespace switchyard::testing
