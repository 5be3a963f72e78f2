// Polyhedra made of polyhedra.
#include <cmath>
#include <numeric>
#include <vector>

#include "core/linalg/dense_lp.hpp"
#include "core/sets/polytope_conversions.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/hpolyhedron.hpp"

namespace switchyard {
namespace {

/// Redundancy asks for max a'x over rows that hold it back by this much, so that it is bounded
/// where the row is needed.
constexpr double kRelaxed = 1;
constexpr double kPressed = 1e-9;  // rows that hold a single point may miss it by rounding

HPolyhedron RowsOf(const HPolyhedron& polyhedron, const std::vector<int>& kept) {
  return {Eigen::MatrixXd(polyhedron.A()(kept, Eigen::all)), polyhedron.b()(kept)};
}

DenseLp LpOver(const HPolyhedron& polyhedron) {
  const Eigen::MatrixXd A = polyhedron.A();
  DenseLp lp(polyhedron.ambient_dimension());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    double* const row = lp.AddRow(-kInfinity, polyhedron.b()[i]);
    for (Eigen::Index j = 0; j < A.cols(); ++j) row[j] = A(i, j);
  }
  return lp;
}

}  // namespace

bool HPolyhedron::ContainedIn(const HPolyhedron& other, double tol) const {
  Require(other.ambient_dimension() == ambient_dimension(), "a polyhedron in R^",
          ambient_dimension(), " may be in one in R^", ambient_dimension(), ", got one in R^",
          other.ambient_dimension());
  const Eigen::MatrixXd rows = other.A();
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (!(SupportFunction(rows.row(i).transpose()) <= other.b()[i] + tol)) return false;
  }
  // Without coordinates, rows are 0 <= b.
  return ambient_dimension() > 0 || IsEmpty() || other.b_.size() == 0 ||
         other.b_.minCoeff() >= -tol;
}

HPolyhedron HPolyhedron::Intersection(const HPolyhedron& other, bool check_for_redundancy,
                                      double tol) const {
  Require(other.ambient_dimension() == ambient_dimension(), "polyhedra in R^", ambient_dimension(),
          " and R^", other.ambient_dimension(), " have no intersection");
  Eigen::MatrixXd A(A_.rows() + other.A_.rows(), A_.cols());
  A << Eigen::MatrixXd(A_), Eigen::MatrixXd(other.A_);
  Eigen::VectorXd b(A.rows());
  b << b_, other.b_;
  const HPolyhedron both(A, b);
  return check_for_redundancy ? both.ReduceInequalities(tol) : both;
}

std::set<int> HPolyhedron::FindRedundant(double tol) const {
  std::set<int> redundant;
  if (ambient_dimension() == 0) return redundant;
  DenseLp lp = LpOver(*this);
  DenseSimplex simplex;
  for (Eigen::Index i = 0; i < b_.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t j = 0; j < lp.c.size(); ++j) lp.c[j] = -lp.row(at)[j];
    lp.row_upper[at] = b_[i] + kRelaxed;
    const DenseLpAnswer& answer = simplex.Solve(lp);
    const bool implied =
        answer.status == DenseLpStatus::kInfeasible ||
        (answer.status == DenseLpStatus::kOptimal && -answer.objective <= b_[i] + tol);
    lp.row_upper[at] = implied ? kInfinity : b_[i];
    if (implied) redundant.insert(static_cast<int>(i));
  }
  return redundant;
}

HPolyhedron HPolyhedron::ReduceInequalities(double tol) const {
  const std::set<int> redundant = FindRedundant(tol);
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(b_.size()); ++i) {
    if (!redundant.contains(i)) kept.push_back(i);
  }
  return RowsOf(*this, kept);
}

// A (c + (x - c) / r) <= b, r = scale^(1/n): Ax <= Ac + r (b - Ac).
HPolyhedron HPolyhedron::Scale(double scale, const std::optional<Eigen::VectorXd>& center) const {
  Require(scale >= 0 && std::isfinite(scale),
          "hpolyhedron: a scale must be a finite number of at least 0, got ", scale);
  const Eigen::VectorXd c = center ? *center : ChebyshevCenter();
  Require(PointInSet(c, 1e-8), "hpolyhedron: scaling needs a center in the set, got one that is ",
          Violation(c), " outside");
  const double r = std::pow(scale, 1.0 / std::max(1, ambient_dimension()));
  Eigen::VectorXd sides = A_ * c;
  for (Eigen::Index i = 0; i < sides.size(); ++i) {
    sides[i] = b_[i] == kInfinity ? kInfinity : sides[i] + r * (b_[i] - sides[i]);
  }
  return {A_, sides};
}

HPolyhedron HPolyhedron::CartesianProduct(const HPolyhedron& other) const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto put = [&entries](const SparseMatrix& part, Eigen::Index row, Eigen::Index column) {
    for (int j = 0; j < part.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator e(part, j); e; ++e) {
        entries.emplace_back(row + e.row(), column + j, e.value());
      }
    }
  };
  put(A_, 0, 0);
  put(other.A_, A_.rows(), A_.cols());
  SparseMatrix A(A_.rows() + other.A_.rows(), A_.cols() + other.A_.cols());
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd b(A.rows());
  b << b_, other.b_;
  return {A, b};
}

HPolyhedron HPolyhedron::CartesianPower(int n) const {
  Require(n >= 0, "a cartesian power needs a number of at least 0, got ", n);
  HPolyhedron power;
  for (int k = 0; k < n; ++k) power = power.CartesianProduct(*this);
  return power;
}

// a'(x + y) <= b for all y of the other: a'x <= b - max a'y.
HPolyhedron HPolyhedron::PontryaginDifference(const HPolyhedron& other) const {
  Require(other.ambient_dimension() == ambient_dimension(), "polyhedra in R^", ambient_dimension(),
          " and R^", other.ambient_dimension(), " have no difference");
  Require(!other.IsEmpty(), "a polyhedron has no difference with an empty one");
  const Eigen::MatrixXd rows = A_;
  Eigen::VectorXd sides = b_;
  for (Eigen::Index i = 0; i < sides.size(); ++i) {
    if (sides[i] == kInfinity) continue;
    const double reach = other.SupportFunction(rows.row(i).transpose());
    Require(reach < kInfinity, "a polyhedron with the row ", i,
            " has no difference with one that is not bounded along it");
    sides[i] -= reach;
  }
  return {A_, sides};
}

Eigen::VectorXd HPolyhedron::ChebyshevCenter() const {
  std::vector<int> finite;
  for (int i = 0; i < static_cast<int>(b_.size()); ++i) {
    if (b_[i] < kInfinity) finite.push_back(i);
  }
  const HPolyhedron rows = RowsOf(*this, finite);
  const std::optional<InnerBall> ball = LargestInnerBall(rows.A(), rows.b());
  Require(ball && ball->radius >= -kPressed,
          "a Chebyshev center needs a polyhedron with a point, got an empty one");
  Require(ball->radius < kInfinity || ambient_dimension() == 0,
          "a Chebyshev center needs a largest ball, got a polyhedron in R^", ambient_dimension(),
          " that holds balls of every size");
  return ball->center;
}

}  // namespace switchyard
