// gcs/1: graphs of convex sets, there and back, and what is said of files that are none.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "switchyard/cones.hpp"
#include "switchyard/io/graph.hpp"
#include "switchyard/io/write.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard::io {
namespace {

using Edge = GraphOfConvexSets::Edge;

// Whatever the two hold of costs and sets, at some points.
void ExpectSameGraph(const GraphProblem& a, const GraphProblem& b) {
  const auto vertices = std::as_const(*a.graph).Vertices();
  const auto vertices_again = std::as_const(*b.graph).Vertices();
  ASSERT_EQ(vertices.size(), vertices_again.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    EXPECT_EQ(vertices[k]->name(), vertices_again[k]->name());
    ASSERT_EQ(vertices[k]->ambient_dimension(), vertices_again[k]->ambient_dimension());
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(vertices[k]->ambient_dimension(), -1, 2);
    EXPECT_EQ(vertices[k]->set().Violation(x), vertices_again[k]->set().Violation(x));
  }
  const auto edges = std::as_const(*a.graph).Edges();
  const auto edges_again = std::as_const(*b.graph).Edges();
  ASSERT_EQ(edges.size(), edges_again.size());
  const auto value = [](const EvaluatorBase& f) {
    Eigen::VectorXd y;
    f.Eval(Eigen::VectorXd::LinSpaced(f.num_vars(), -1, 2), &y);
    return y;
  };
  for (std::size_t k = 0; k < edges.size(); ++k) {
    EXPECT_EQ(edges[k]->name(), edges_again[k]->name());
    ASSERT_EQ(edges[k]->costs().size(), edges_again[k]->costs().size());
    for (std::size_t i = 0; i < edges[k]->costs().size(); ++i) {
      EXPECT_EQ(value(*edges[k]->costs()[i].binding.evaluator()),
                value(*edges_again[k]->costs()[i].binding.evaluator()));
    }
    ASSERT_EQ(edges[k]->constraints().size(), edges_again[k]->constraints().size());
    for (std::size_t i = 0; i < edges[k]->constraints().size(); ++i) {
      EXPECT_EQ(value(*edges[k]->constraints()[i].binding.evaluator()),
                value(*edges_again[k]->constraints()[i].binding.evaluator()));
    }
  }
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.notes, b.notes);
  EXPECT_EQ(a.reference, b.reference);
  EXPECT_EQ(a.source->id(), b.source->id());
  EXPECT_EQ(a.target->id(), b.target->id());
}

TEST(Gcs, KeepsTheInstances) {
  const std::filesystem::path folder = std::filesystem::path(SWITCHYARD_INSTANCES) / "gcs";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no instances beside the source tree";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().filename().string());
    std::vector<std::string> notes;
    const GraphProblem problem = ReadGraph(entry.path().string(), {.notes = &notes});
    EXPECT_EQ(notes, std::vector<std::string>());
    const std::string text = GraphText(problem);
    const GraphProblem again = ReadGraphText(text, "written.json");
    EXPECT_TRUE(GraphText(again) == text);
    ExpectSameGraph(problem, again);
  }
}

std::string Graph(const std::string& tables, const std::string& vertices, const std::string& edges,
                  const std::string& more = "") {
  return "{\"format\": \"gcs/1\", \"source\": 0, \"target\": 1, " + tables + ", \"vertices\": [" +
         vertices + "], \"edges\": [" + edges + "]" + more + "}";
}

const std::string kTables =
    "\"matrices\": {\"M\": {\"rows\": 1, \"cols\": 3, \"entries\": [[0, 0, 1], [0, 2, -2]]}}, "
    "\"functions\": {\"f\": {\"type\": \"squared_l2_norm\", \"A\": \"M\", \"b\": [3]}, "
    "\"g\": {\"type\": \"linear\", \"a\": [1], \"b\": 0}}, "
    "\"constraints\": {\"c\": {\"type\": \"linear\", \"A\": \"M\", \"lb\": [\"-inf\"], \"ub\": "
    "[1]}}, "
    "\"sets\": {\"p\": {\"type\": \"point\", \"x\": [5]}, \"r\": {\"type\": \"hyperrectangle\", "
    "\"lb\": [0, 0], \"ub\": [1, \"inf\"]}}";
const std::string kVertices =
    "{\"name\": \"a\", \"set\": \"p\", \"costs\": [\"g\"]}, "
    "{\"name\": \"b\", \"set\": \"r\", \"costs\": []}";
const std::string kEdge =
    "{\"tail\": 0, \"head\": 1, \"costs\": [\"f\"], \"constraints\": [\"c\"]}";

TEST(Gcs, ReadsTermsOnTheStackOfBothEnds) {
  const GraphProblem problem = ReadGraphText(Graph(kTables, kVertices, kEdge), "a.json");
  const auto edges = std::as_const(*problem.graph).Edges();
  ASSERT_EQ(edges.size(), 1u);
  const auto& cost = edges[0]->costs().at(0).binding;
  Eigen::VectorXd y;
  cost.evaluator()->Eval(Eigen::Vector3d(5, 7, 0.5), &y);
  EXPECT_DOUBLE_EQ(y(0), 49);  // (5 - 2 * 0.5 + 3)^2
  EXPECT_EQ(cost.variables()(0), problem.source->x()(0));
  EXPECT_EQ(cost.variables()(2), problem.target->x()(1));
}

TEST(Gcs, AnUndirectedEdgeIsTwoWithTheSameTermsOfTheSamePoints) {
  const GraphProblem problem =
      ReadGraphText(Graph(kTables, kVertices, kEdge, ", \"directed\": false"), "a.json");
  const auto edges = std::as_const(*problem.graph).Edges();
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(&edges[1]->u(), problem.target);
  EXPECT_EQ(edges[1]->costs().at(0).binding, edges[0]->costs().at(0).binding);
  const std::string text = GraphText(problem);
  EXPECT_EQ(GraphText(ReadGraphText(text, "b.json")), text);
}

TEST(Gcs, SharesWhatATableHoldsOnce) {
  const GraphProblem problem = ReadGraphText(Graph(kTables, kVertices, kEdge + ", " + kEdge), "a");
  const auto edges = std::as_const(*problem.graph).Edges();
  EXPECT_EQ(edges[0]->costs().at(0).binding.evaluator(),
            edges[1]->costs().at(0).binding.evaluator());
}

TEST(Gcs, HoldsIntersectionsOfSetsAndTermsOnSomeVariables) {
  GraphProblem problem;
  problem.graph = std::make_unique<GraphOfConvexSets>();
  const Hyperrectangle one(Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 2));
  const Hyperrectangle two(Eigen::Vector2d(1, -1), Eigen::Vector2d(3, 1));
  problem.source = problem.graph->AddVertex(Intersection(one, two), "start");
  problem.target = problem.graph->AddVertex(Point(Eigen::Vector2d(4, 4)), "end");
  Edge* const edge = problem.graph->AddEdge(problem.source, problem.target, "way");
  edge->AddCost(
      {std::make_shared<LinearCost>(Eigen::Vector2d(1, -1), 2),
       VectorXDecisionVariable(Eigen::Matrix<Variable, 2, 1>(edge->xv()(1), edge->xu()(0)))});
  const std::string text = GraphText(problem);
  const GraphProblem again = ReadGraphText(text, "written");
  EXPECT_EQ(GraphText(again), text);
  ExpectSameGraph(problem, again);
  const auto terms = std::as_const(*again.graph).Edges().at(0)->costs();
  EXPECT_EQ(terms.at(0).binding.variables()(0), again.target->x()(1));
}

TEST(Gcs, SaysWhatItCannotHold) {
  GraphProblem problem;
  problem.graph = std::make_unique<GraphOfConvexSets>();
  problem.source = problem.graph->AddVertex(Point(Eigen::Vector2d(4, 4)), "start");
  Edge* const edge = problem.graph->AddEdge(problem.source, problem.source, "way");
  edge->NewSlackVariables(1);
  edge->AddPhiConstraint(true);
  EXPECT_EQ(CannotHold(problem),
            (std::vector<std::string>{"a fixed flow (1 time, first: edge way)",
                                      "an end that is no vertex of it (1 time, first: target)",
                                      "slack variables (1 time, first: edge way)"}));
}

TEST(Gcs, HoldsNoFunctions) {
  GraphProblem problem;
  problem.graph = std::make_unique<GraphOfConvexSets>();
  problem.source = problem.graph->AddVertex(Point(Eigen::Vector2d(4, 4)), "start");
  problem.target = problem.graph->AddVertex(Point(Eigen::Vector2d(5, 4)), "end");
  Edge* const edge = problem.graph->AddEdge(problem.source, problem.target, "way");
  const auto saddle = std::make_shared<QuadraticConstraint>(
      Eigen::Vector2d(1, -1).asDiagonal().toDenseMatrix(), Eigen::Vector2d::Zero(), 0, 1);
  Tape tape(2);
  tape.AddOutput(tape.Apply(Op::kExp, 0));
  edge->AddCost({std::make_shared<FunctionCost>(CompileTape(tape), true), edge->xu()});
  edge->AddConstraint({saddle, edge->xv()});
  EXPECT_EQ(CannotHold(problem),
            (std::vector<std::string>{
                "a function cost that has no perspective (1 time, first: edge way)",
                "a quadratic constraint that has no perspective (1 time, first: edge way)"}));
  try {
    (void)problem.graph->SolveShortestPath(*problem.source, *problem.target, {});
    ADD_FAILURE();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(),
                 "at way: function cost has no perspective: a relaxation and a mixed-integer "
                 "program take linear, convex quadratic and norm costs; a term for the restriction "
                 "alone may be any");
  }
}

// The largest violation of the cone at (t, x).
double ViolationOfScaled(const ScaledSet& set, double t, const Eigen::Vector2d& x) {
  const Eigen::Vector3d at(t, x[0], x[1]);
  std::vector<double> rows(set.lower.size(), 0.0);
  std::vector<double> s(static_cast<std::size_t>(set.F.rows), 0.0);
  MultiplyAdd(set.A.View(), 1, at.data(), rows.data());
  MultiplyAdd(set.F.View(), 1, at.data(), s.data());
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    worst = std::max({worst, set.lower[i] - rows[i], rows[i] - set.upper[i]});
  }
  for (const sy_cone& cone : set.cones) {
    worst = std::max(worst, FactsOf(cone.kind).violation(s.data(), cone.dim, cone.parameter));
  }
  return worst;
}

// x in t {1/2 x'Qx + b'x <= 3} where t (3 t - b'x) >= 1/2 x'Qx: of any rank, and as -3 <= -(...).
TEST(Gcs, AQuadraticConstraintIsTheSetWhereItHoldsScaledToo) {
  using Entries = std::vector<std::pair<const char*, double>>;
  for (const Entries& Q : {Entries{{"0, 0, ", 2}, {"0, 1, ", 1}, {"1, 0, ", 1}, {"1, 1, ", 3}},
                           Entries{{"1, 1, ", 4}}, Entries{}}) {
    for (const double sign : {1.0, -1.0}) {
      std::string entries;
      for (const auto& [place, value] : Q) {
        entries += Text(entries.empty() ? "[" : ", [", place, sign * value, "]");
      }
      const std::string one = Text(
          "\"constraints\": {\"c\": {\"type\": \"quadratic\", \"Q\": {\"rows\": 2, \"cols\": 2, "
          "\"entries\": [",
          entries, "]}, \"b\": [", sign, ", ", -2 * sign, "], ",
          sign > 0 ? "\"lb\": [\"-inf\"], \"ub\": [3]" : "\"lb\": [-3], \"ub\": [\"inf\"]",
          "}}, \"sets\": {\"s\": {\"type\": \"intersection_of_constraints\", \"dimension\": 2, "
          "\"constraints\": [\"c\"]}}");
      const std::string two =
          "{\"name\": \"a\", \"set\": \"s\"}, {\"name\": \"b\", \"set\": \"s\"}";
      const GraphProblem problem = ReadGraphText(Graph(one, two, ""), "a.json");
      EXPECT_EQ(GraphText(ReadGraphText(GraphText(problem), "b.json")), GraphText(problem));
      const ScaledSet& scaled = problem.source->set().scaled();
      const auto form = [&](double x, double y) {
        double sum = x - 2 * y;
        for (const auto& [place, value] : Q) {
          sum += 0.5 * value * (place[0] == '0' ? x : y) * (place[3] == '0' ? x : y);
        }
        return sum;
      };
      for (double x = -3; x <= 3; x += 0.37) {
        for (double y = -3; y <= 3; y += 0.41) {
          EXPECT_EQ(problem.source->set().PointInSet(Eigen::Vector2d(x, y), 1e-9), form(x, y) <= 3);
          const bool inside = form(x / 0.6, y / 0.6) <= 3;
          EXPECT_EQ(ViolationOfScaled(scaled, 0.6, Eigen::Vector2d(x, y)) <= 1e-9, inside);
        }
      }
    }
  }
}

std::string SaidOf(const std::string& text) {
  try {
    ReadGraphText(text, "a.json");
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string Replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(Gcs, SaysWhatIsWrongAndWhere) {
  const std::string right = Graph(kTables, kVertices, kEdge);
  const auto said = [&](const std::string& what, const std::string& with) {
    return SaidOf(Replaced(right, what, with));
  };
  EXPECT_EQ(SaidOf(right), "read");
  EXPECT_EQ(said("gcs/1", "gcs/2"), "a.json: /format: needs \"gcs/1\", got \"gcs/2\"");
  EXPECT_EQ(said("\"source\": 0, ", ""), "a.json: needs \"source\", got an object without it");
  EXPECT_EQ(said("\"target\": 1", "\"target\": 2"),
            "a.json: /target: needs the number of a vertex from 0 to 1, got 2");
  EXPECT_EQ(said("[\"f\"]", "[\"h\"]"),
            "a.json: /edges/0/costs/0: needs the name of a function, got \"h\" (the nearest is "
            "\"f\")");
  EXPECT_EQ(said("[\"f\"]", "[\"g\"]"),
            "a.json: /edges/0/costs/0: needs a term on 3 variables, those of both ends of the "
            "edge, got one on 1");
  EXPECT_EQ(said("[\"g\"]", "[\"f\"]"),
            "a.json: /vertices/0/costs/0: needs a term on 1 variables, those of the vertex, got "
            "one on 3");
  EXPECT_EQ(said("\"head\": 1", "\"head\": -1"),
            "a.json: /edges/0/head: needs the number of a vertex from 0 to 1, got -1");
  EXPECT_EQ(said("[1, \"inf\"]", "[1, -1]"),
            "a.json: /sets/r/ub/1: needs an upper side of 0, the lower one, or more, got -1");
  EXPECT_EQ(said("\"point\"", "\"pointt\""),
            "a.json: /sets/p/type: needs a type of set (point, hyperrectangle, hpolyhedron, "
            "hyperellipsoid, intersection_of_constraints, intersection, vpolytope, affine_ball, "
            "affine_subspace, cartesian_product, minkowski_sum, convex_hull), got \"pointt\" (the "
            "nearest is \"point\")");
  EXPECT_EQ(said("\"set\": \"r\"", "\"set\": \"q\""),
            "a.json: /vertices/1/set: needs the name of a set, got \"q\" (the nearest is \"p\")");
  EXPECT_EQ(said("[5]", "[NaN]").substr(0, 9), "a.json:1:");
  EXPECT_EQ(said("{\"type\": \"linear\", \"a\": [1], \"b\": 0}",
                 "{\"type\": \"quadratic\", \"Q\": {\"rows\": 1, \"cols\": 1, \"entries\": [[0, 0, "
                 "-1]]}, \"b\": [0], \"c\": 0}"),
            "a.json: /functions/g: needs a convex function, got a quadratic one that is not");
  EXPECT_EQ(
      said("{\"type\": \"linear\", \"a\": [1], \"b\": 0}",
           "{\"type\": \"function\", \"arguments\": 1, \"convex\": true, "
           "\"expressions\": [\"exp(x[0])\"]}"),
      "a.json: /functions/g: needs a linear, convex quadratic or norm function, got one given "
      "by its operations");
  const std::string linear_rows =
      "{\"type\": \"linear\", \"A\": \"M\", \"lb\": [\"-inf\"], \"ub\": [1]}";
  EXPECT_EQ(said(linear_rows,
                 "{\"type\": \"function\", \"arguments\": 1, \"expressions\": [\"exp(x[0])\"], "
                 "\"lb\": [0], \"ub\": [1]}"),
            "a.json: /constraints/c: needs a linear, conic or convex quadratic constraint, got one "
            "given by its operations");
  EXPECT_EQ(said(linear_rows,
                 "{\"type\": \"quadratic\", \"hessian\": \"positive_semidefinite\", \"Q\": "
                 "{\"rows\": 1, \"cols\": 1, \"entries\": [[0, 0, -1]]}, \"b\": [0], \"lb\": "
                 "[\"-inf\"], \"ub\": [1]}"),
            "a.json: /constraints/c: needs a linear, conic or convex quadratic constraint, got a "
            "quadratic one that is not convex");
  EXPECT_EQ(said("{\"type\": \"point\", \"x\": [5]}",
                 "{\"type\": \"intersection_of_constraints\", \"dimension\": 2, \"constraints\": "
                 "[\"c\"]}"),
            "a.json: /sets/p/constraints/0: needs a constraint on 2 variables, the dimension of "
            "the set, got \"c\" on 3");
}

}  // namespace
}  // namespace switchyard::io
