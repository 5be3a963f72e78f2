// A set of every class around a point that is inside.
#pragma once

#include <Eigen/LU>
#include <functional>
#include <memory>
#include <vector>

#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/constraint_set.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/sets/spectrahedron.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/gcs/random_draw.hpp"

namespace switchyard::testing {

/// All are within 5 of the point, but the affine subspaces: whoever takes one bounds it.
class RandomVertexSets {
 public:
  explicit RandomVertexSets(Draw& draw) : draw_(draw) {}

  /// Of any class, or of those that are polyhedra.
  std::shared_ptr<const ConvexSet> Any(const Eigen::VectorXd& inside, bool polyhedral) {
    using Make = std::shared_ptr<const ConvexSet> (RandomVertexSets::*)(const Eigen::VectorXd&);
    static const std::vector<Make> flat = {
        &RandomVertexSets::OnePoint,      &RandomVertexSets::Box,
        &RandomVertexSets::FlatBox,       &RandomVertexSets::Polyhedron,
        &RandomVertexSets::Slab,          &RandomVertexSets::Vertices,
        &RandomVertexSets::ProductOfFlat, &RandomVertexSets::SumOfFlat,
        &RandomVertexSets::HullOfFlat,    &RandomVertexSets::MeetOfFlat,
        &RandomVertexSets::Subspace};
    static const std::vector<Make> round = {
        &RandomVertexSets::Ellipsoid, &RandomVertexSets::Ball,       &RandomVertexSets::Product,
        &RandomVertexSets::Sum,       &RandomVertexSets::Hull,       &RandomVertexSets::Meet,
        &RandomVertexSets::Matrices,  &RandomVertexSets::Constraints};
    if (inside.size() == 0) {
      if (draw_.Chance(0.5)) return std::make_shared<Hyperrectangle>();
      return std::make_shared<Point>();
    }
    const int count = static_cast<int>(flat.size() + (polyhedral ? 0 : round.size()));
    const auto k = static_cast<std::size_t>(draw_.Integer(0, count - 1));
    return (this->*(k < flat.size() ? flat[k] : round[k - flat.size()]))(inside);
  }

 private:
  using Set = std::shared_ptr<const ConvexSet>;

  Set OnePoint(const Eigen::VectorXd& p) { return std::make_shared<Point>(p); }
  Set Box(const Eigen::VectorXd& p) {
    return std::make_shared<Hyperrectangle>(p - draw_.Radii(N(p)), p + draw_.Radii(N(p)));
  }
  Set FlatBox(const Eigen::VectorXd& p) {
    Eigen::VectorXd lower = p - draw_.Radii(N(p));
    const int flat = draw_.Integer(0, N(p) - 1);
    lower[flat] = p[flat];
    return std::make_shared<Hyperrectangle>(lower, p);
  }
  Set Polyhedron(const Eigen::VectorXd& p) {
    const int n = N(p);
    Eigen::MatrixXd A(4 * n, n);
    A << draw_.Matrix(2 * n, n), Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
    return std::make_shared<HPolyhedron>(A, A * p + draw_.Radii(4 * n));
  }
  /// With an equality among its rows.
  Set Slab(const Eigen::VectorXd& p) {
    const int n = N(p);
    Eigen::MatrixXd A(2 * n + 2, n);
    const Eigen::RowVectorXd normal = draw_.Vector(n).transpose();
    A << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n), normal, -normal;
    Eigen::VectorXd b = A * p;
    b.head(2 * n) += draw_.Radii(2 * n);
    return std::make_shared<HPolyhedron>(A, b);
  }
  Set Vertices(const Eigen::VectorXd& p) {
    const int count = N(p) + 2;
    Eigen::MatrixXd vertices = draw_.Matrix(N(p), count);
    const Eigen::VectorXd weights = draw_.Radii(count);
    vertices.colwise() += p - vertices * weights / weights.sum();
    return std::make_shared<VPolytope>(vertices);
  }
  Set ProductOfFlat(const Eigen::VectorXd& p) {
    if (N(p) < 2) return Box(p);
    return std::make_shared<CartesianProduct>(
        MakeConvexSets(Vertices(p.head(1)), Polyhedron(p.tail(N(p) - 1))));
  }
  Set SumOfFlat(const Eigen::VectorXd& p) {
    const Eigen::VectorXd q = draw_.Vector(N(p));
    return std::make_shared<MinkowskiSum>(MakeConvexSets(Box(q), Vertices(p - q)));
  }
  Set HullOfFlat(const Eigen::VectorXd& p) {
    ConvexSets sets = MakeConvexSets(Box(p), Polyhedron(p + draw_.Vector(N(p))));
    if (draw_.Chance(0.3)) sets.emplace_back(Nothing(N(p)));
    return std::make_shared<ConvexHull>(sets);
  }
  Set MeetOfFlat(const Eigen::VectorXd& p) {
    return std::make_shared<Intersection>(MakeConvexSets(Box(p), Vertices(p)));
  }
  Set Subspace(const Eigen::VectorXd& p) {
    const Eigen::MatrixXd basis = draw_.Matrix(N(p), draw_.Integer(1, N(p)));
    return std::make_shared<AffineSubspace>(basis, p);
  }
  Set Ellipsoid(const Eigen::VectorXd& p) {
    const int n = N(p);
    const Eigen::MatrixXd A = draw_.Matrix(n, n, 0.4) + 2 * Eigen::MatrixXd::Identity(n, n);
    return std::make_shared<Hyperellipsoid>(A, p + draw_.Vector(n, 0.15));
  }
  Set Ball(const Eigen::VectorXd& p) {
    const int columns = draw_.Integer(1, N(p));
    const Eigen::MatrixXd B = draw_.Matrix(N(p), columns);
    return std::make_shared<AffineBall>(B, p + B * draw_.Vector(columns, 0.5));
  }
  /// {x : Ax + b in a ball times a box}.
  Set Product(const Eigen::VectorXd& p) {
    const int n = N(p);
    if (n < 2) return Ellipsoid(p);
    const Eigen::MatrixXd A = draw_.Matrix(n, n, 0.2) + Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd b = draw_.Vector(n), q = A * p + b;
    return std::make_shared<CartesianProduct>(
        MakeConvexSets(Ellipsoid(q.head(n - 1)), Box(q.tail(1))), A, b);
  }
  Set Sum(const Eigen::VectorXd& p) {
    const Eigen::VectorXd q = draw_.Vector(N(p));
    return std::make_shared<MinkowskiSum>(MakeConvexSets(Ball(q), Polyhedron(p - q)));
  }
  Set Hull(const Eigen::VectorXd& p) {
    ConvexSets sets = MakeConvexSets(Ball(p), Ellipsoid(p + draw_.Vector(N(p))));
    if (draw_.Chance(0.3)) sets.emplace_back(Nothing(N(p)));
    return std::make_shared<ConvexHull>(sets);
  }
  Set Meet(const Eigen::VectorXd& p) {
    return std::make_shared<Intersection>(MakeConvexSets(Ellipsoid(p), Polyhedron(p)));
  }
  /// |x_i - p_i| <= r_i and |a'(x - p)| <= 1 as 2 x 2 matrices.
  Set Matrices(const Eigen::VectorXd& p) {
    MathematicalProgram program;
    const VectorXDecisionVariable x = program.NewContinuousVariables(N(p));
    const auto add = [&](const Eigen::VectorXd& a, double r) {
      std::vector<Eigen::MatrixXd> F(static_cast<std::size_t>(N(p)) + 1);
      F[0] = (Eigen::Matrix2d() << r, -a.dot(p), -a.dot(p), r).finished();
      for (int i = 0; i < N(p); ++i) {
        F[static_cast<std::size_t>(i) + 1] = (Eigen::Matrix2d() << 0, a[i], a[i], 0).finished();
      }
      program.AddConstraint(std::make_shared<LinearMatrixInequalityConstraint>(F), x);
    };
    for (int i = 0; i < N(p); ++i) add(Eigen::VectorXd::Unit(N(p), i), draw_.Uniform(0.3, 1));
    add(draw_.Vector(N(p)), 1);
    return std::make_shared<Spectrahedron>(program);
  }
  Set Constraints(const Eigen::VectorXd& p) {
    const int n = N(p);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 1, n);
    A.bottomRows(n) = draw_.Matrix(n, n, 0.3) + Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd b = -A * p;
    b[0] = 1;
    const Eigen::RowVectorXd row = draw_.Vector(n).transpose();
    const Eigen::VectorXd middle = row * p, width = Eigen::VectorXd::Constant(1, 0.5);
    return std::make_shared<ConstraintSet>(
        n, ConstraintSet::Constraints{
               std::make_shared<LorentzConeConstraint>(A, b),
               std::make_shared<LinearConstraint>(row, middle - width, middle + width)});
  }
  static Set Nothing(int n) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2, n);
    A(0, 0) = 1;
    A(1, 0) = -1;
    return std::make_shared<HPolyhedron>(A, Eigen::Vector2d(-1, -1));  // 1 <= x_0 <= -1
  }
  static int N(const Eigen::VectorXd& p) { return static_cast<int>(p.size()); }

  Draw& draw_;
};

}  // namespace switchyard::testing
