// gcs/1: every class of sets there and back, and what is said of entries that are none.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "switchyard/error.hpp"
#include "switchyard/io/file_error.hpp"
#include "switchyard/io/graph.hpp"
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/sets/spectrahedron.hpp"
#include "switchyard/sets/vpolytope.hpp"

namespace switchyard::io {
namespace {

GraphProblem OneVertex(const ConvexSet& set) {
  GraphProblem problem;
  problem.graph = std::make_unique<GraphOfConvexSets>();
  problem.source = problem.graph->AddVertex(set, "all");
  problem.target = problem.source;
  return problem;
}

ConvexSets OneOfEach() {
  const Hyperrectangle box(Eigen::Vector2d(0, 0.1), Eigen::Vector2d(2, 1.0 / 3));
  const Point point(Eigen::Vector2d(1, 0.3));
  const VPolytope triangle((Eigen::MatrixXd(2, 3) << 0, 1, 0.7, 0, 0.1, 1).finished());
  const AffineBall flat(Eigen::Vector2d(0.3, 0.7), Eigen::Vector2d(1, 1));
  const Eigen::MatrixXd A = (Eigen::MatrixXd(4, 1) << 1, 0.2, 0.1, 0.3).finished();
  return MakeConvexSets(
      triangle, flat, AffineBall(Eigen::MatrixXd(2, 0), Eigen::Vector2d(1, 2)),
      AffineSubspace(Eigen::Vector2d(1, 0.3), Eigen::Vector2d(2, 0.7)),
      AffineSubspace(Eigen::MatrixXd(2, 0), Eigen::Vector2d(2, 0.7)), CartesianProduct(box, flat),
      CartesianProduct(MakeConvexSets(box, triangle), A, Eigen::Vector4d(0, 0.2, 0.4, 0.2)),
      MinkowskiSum(triangle, point), ConvexHull(MakeConvexSets(box, point, flat)),
      Intersection(MinkowskiSum(box, flat), Hyperellipsoid::MakeUnitBall(2)));
}

void ExpectSameMatrix(const Csc& a, const Csc& b) {
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.value, b.value);
}

void ExpectSameCone(const ScaledSet& a, const ScaledSet& b) {
  EXPECT_EQ(a.num_aux, b.num_aux);
  ExpectSameMatrix(a.A, b.A);
  ExpectSameMatrix(a.F, b.F);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  ASSERT_EQ(a.cones.size(), b.cones.size());
  for (std::size_t i = 0; i < a.cones.size(); ++i) {
    EXPECT_EQ(a.cones[i].kind, b.cones[i].kind);
    EXPECT_EQ(a.cones[i].dim, b.cones[i].dim);
  }
}

TEST(GcsSets, GoThereAndBackToTheSameBits) {
  for (const ConvexSetPointer& set : OneOfEach()) {
    const std::string text = GraphText(OneVertex(*set));
    const GraphProblem again = ReadGraphText(text, "written");
    EXPECT_EQ(GraphText(again), text);
    const ConvexSet& read = again.source->set();
    EXPECT_EQ(read.Kind(), set->Kind());
    ASSERT_EQ(read.ambient_dimension(), set->ambient_dimension());
    ExpectSameCone(read.scaled(), set->scaled());
  }
}

TEST(GcsSets, RefuseByNameWhatFilesDoNotHold) {
  MathematicalProgram program;
  program.NewContinuousVariables(1);
  const Spectrahedron set(program);
  const std::string why =
      "a spectrahedron, a class of sets that files do not hold (1 time, first: "
      "vertex all)";
  EXPECT_EQ(CannotHold(OneVertex(set)), std::vector<std::string>{why});
  EXPECT_EQ(CannotHold(OneVertex(CartesianProduct(set, Point(Eigen::VectorXd::Ones(1))))),
            std::vector<std::string>{why});
  EXPECT_THROW((void)GraphText(OneVertex(set)), InvalidArgument);
}

std::string SaidOf(const std::string& set) {
  try {
    (void)ReadGraphText("{\"format\": \"gcs/1\", \"source\": 0, \"target\": 0, \"sets\": {\"s\": " +
                            set + "}, \"vertices\": [{\"set\": \"s\"}], \"edges\": []}",
                        "a.json");
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(GcsSets, SayWhatIsWrongAndWhere) {
  EXPECT_EQ(SaidOf("{\"type\": \"vpolytope\", \"vertices\": [[0, 1], [2, 3]]}"), "read");
  EXPECT_NE(
      SaidOf("{\"type\": \"vpolytope\", \"vertices\": [[0, 1], [2]]}").find("/sets/s/vertices"),
      std::string::npos);
  EXPECT_EQ(
      SaidOf("{\"type\": \"affine_subspace\", \"translation\": [0, 0], "
             "\"basis\": [[1, 2], [2, 4]]}"),
      "a.json: /sets/s/basis: needs linearly independent columns, got a matrix of lower rank");
  EXPECT_NE(
      SaidOf("{\"type\": \"affine_ball\", \"center\": [0, 0], \"B\": [[1]]}").find("/sets/s/B"),
      std::string::npos);
  EXPECT_EQ(SaidOf("{\"type\": \"cartesian_product\", \"sets\": [], \"A\": []}"),
            "a.json: /sets/s: needs both \"A\" and \"b\", or neither, got one");
  EXPECT_NE(SaidOf("{\"type\": \"convex_hull\", \"sets\": []}").find("one set or more"),
            std::string::npos);
  EXPECT_NE(SaidOf("{\"type\": \"minkowski_sum\", \"sets\": [{\"type\": \"point\", \"x\": [1]}, "
                   "{\"type\": \"point\", \"x\": [1, 2]}]}")
                .find("/sets/s/sets/1"),
            std::string::npos);
  EXPECT_NE(SaidOf("{\"type\": \"vpolytope\", \"vertices\": []}"), "");
}

}  // namespace
}  // namespace switchyard::io
