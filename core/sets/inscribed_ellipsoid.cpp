// The ellipsoid {L y + c : |y| <= 1} of largest volume in a polyhedron. Every ellipsoid has an L
// that is lower triangular with a positive diagonal, whose product is the volume up to a constant:
//   max sum_k s_k : L_kk >= exp(s_k), |L'a_i| <= b_i - a_i'c for each row i
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/sets/polytope_conversions.hpp"
#include "core/sets/set_program.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr double kThinnest = 1e-9;  // radius of a largest ball inside, with rows of length 1

class LargestEllipsoid {
 public:
  LargestEllipsoid(Eigen::MatrixXd A, Eigen::VectorXd b)
      : A_(std::move(A)), b_(std::move(b)), n_(static_cast<int>(A_.cols())) {
    L_ = program_.NewContinuousVariables(n_ * (n_ + 1) / 2, "L");
    c_ = program_.NewContinuousVariables(n_, "c");
    s_ = program_.NewContinuousVariables(n_, "s");
    program_.AddLinearCost(-Eigen::VectorXd::Ones(n_), s_);
    for (int k = 0; k < n_; ++k) AddDiagonal(k);
    for (Eigen::Index i = 0; i < A_.rows(); ++i) AddRow(i);
  }

  /// Moved in to where rounding has left no row violated.
  Hyperellipsoid Solve() {
    const MathematicalProgramResult result = switchyard::Solve(program_);
    if (!result.is_success()) CouldNotTell("hpolyhedron", "the largest ellipsoid inside", result);
    const Eigen::VectorXd center = result.GetSolution(c_);
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n_, n_);
    for (int k = 0; k < n_; ++k) {
      for (int m = k; m < n_; ++m) L(m, k) = result.GetSolution(L_[Place(m, k)]);
    }
    const Eigen::ArrayXd reach = (A_ * L).rowwise().norm().array();
    const Eigen::ArrayXd room = (b_ - A_ * center).array();
    const double part = std::min(1.0, (room / reach).minCoeff());
    return {Eigen::MatrixXd((part * L).inverse()), center};
  }

 private:
  [[nodiscard]] static Eigen::Index Place(int m, int k) { return m * (m + 1) / 2 + k; }

  // (L_kk, 1, s_k) in the exponential cone.
  void AddDiagonal(int k) {
    const VectorXDecisionVariable diagonal = L_.segment(Place(k, k), 1);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 2);
    rows(0, 0) = rows(2, 1) = 1;
    program_.AddExponentialConeConstraint(rows, Eigen::Vector3d(0, 1, 0),
                                          VariableList({diagonal, s_.segment(k, 1)}));
  }

  // (b - a'c, L'a) in the second-order cone.
  void AddRow(Eigen::Index i) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(1 + n_, L_.size() + n_);
    for (int k = 0; k < n_; ++k) {
      for (int m = k; m < n_; ++m) rows(1 + k, Place(m, k)) = A_(i, m);
      rows(0, L_.size() + k) = -A_(i, k);
    }
    Eigen::VectorXd constant = Eigen::VectorXd::Zero(1 + n_);
    constant[0] = b_[i];
    program_.AddLorentzConeConstraint(rows, constant, VariableList({L_, c_}));
  }

  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;
  int n_;
  MathematicalProgram program_;
  VectorXDecisionVariable L_;
  VectorXDecisionVariable c_;
  VectorXDecisionVariable s_;
};

}  // namespace

// In coordinates z with x = center + radius z of a largest ball, so that sizes are near 1.
Hyperellipsoid HPolyhedron::MaximumVolumeInscribedEllipsoid() const {
  Require(ambient_dimension() > 0 && IsBounded(),
          "a largest ellipsoid needs a bounded polyhedron in R^1 or more, got one in R^",
          ambient_dimension(), IsBounded() ? "" : " that is not bounded");
  const Halfspaces rows = NormalizedRows(*this);
  const std::optional<InnerBall> ball = LargestInnerBall(rows.A, rows.b);
  Require(ball && ball->radius > kThinnest,
          "a largest ellipsoid needs a polyhedron that holds a ball of radius ", kThinnest,
          ", got one whose largest ball has the radius ", ball ? ball->radius : 0);
  const Eigen::VectorXd room = (rows.b - rows.A * ball->center) / ball->radius;
  const Hyperellipsoid local = LargestEllipsoid(rows.A, room).Solve();
  return {local.A() / ball->radius, ball->center + ball->radius * local.center()};
}

}  // namespace switchyard
