// Sets with a point known to be inside, and points around it.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "switchyard/sets/constraint_set.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard::testing {

// What a set cannot tell in closed form is asked of backends; set before the process's own host is
// made.
[[maybe_unused]] inline const int plugins_set =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

class RandomSets {
 public:
  explicit RandomSets(unsigned seed) : engine_(seed) {}

  double Uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  Eigen::VectorXd Vector(int n, double size = 1) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return Uniform(-size, size); });
  }
  Eigen::MatrixXd Matrix(int rows, int cols) {
    return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return Uniform(-1, 1); });
  }
  Hyperrectangle Box(const Eigen::VectorXd& inside) {
    const auto n = static_cast<int>(inside.size());
    return {inside - Vector(n).cwiseAbs(), inside + Vector(n).cwiseAbs()};
  }
  HPolyhedron Polyhedron(const Eigen::VectorXd& inside) {
    const auto n = static_cast<int>(inside.size());
    Eigen::MatrixXd A(6 * n, n);
    A << Matrix(4 * n, n), Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd b = A * inside + Vector(6 * n).cwiseAbs();
    return {A, b};
  }
  Hyperellipsoid Ellipsoid(const Eigen::VectorXd& inside) {
    const auto n = static_cast<int>(inside.size());
    const Eigen::MatrixXd A = Matrix(n, n) + 2 * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd u = Vector(n);
    u /= 1 + u.norm();
    return {A, inside - A.colPivHouseholderQr().solve(u)};
  }
  ConstraintSet Constraints(const Eigen::VectorXd& inside) {
    const auto n = static_cast<int>(inside.size());
    const Eigen::MatrixXd A = Matrix(3, n);
    const Eigen::VectorXd middle = A * inside;
    Eigen::MatrixXd cone = Matrix(n + 1, n);
    cone.row(0).setZero();
    Eigen::VectorXd b = -cone * inside;
    b[0] = 1;
    return {n,
            {std::make_shared<LinearConstraint>(A, middle - Vector(3).cwiseAbs(),
                                                middle + Vector(3).cwiseAbs()),
             std::make_shared<LorentzConeConstraint>(cone, b),
             std::make_shared<BoundingBoxConstraint>(inside - Eigen::VectorXd::Ones(n),
                                                     inside + Eigen::VectorXd::Ones(n))}};
  }
  /// One of each kind around the same point.
  ConvexSets OneOfEach(const Eigen::VectorXd& inside) {
    ConvexSets all = MakeConvexSets(Point(inside), Box(inside), Polyhedron(inside),
                                    Ellipsoid(inside), Constraints(inside));
    all.emplace_back(Intersection({Box(inside), Ellipsoid(inside), Polyhedron(inside)}));
    return all;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace switchyard::testing
