#include "core/sets/cone_constraint_of.hpp"

#include <cmath>
#include <vector>

#include "switchyard/cones.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// z[i] = scale * s[row]: the inverse of ConeConstraint::frame().
struct Place {
  int row;
  double scale;
};

struct Rows {
  SparseMatrix A;
  Eigen::VectorXd b;
};

Rows Take(const SparseMatrix& A, const VectorRef& b, const std::vector<Place>& places) {
  SparseMatrix pick(static_cast<Eigen::Index>(places.size()), A.rows());
  for (std::size_t i = 0; i < places.size(); ++i) {
    pick.insert(static_cast<Eigen::Index>(i), places[i].row) = places[i].scale;
  }
  return {pick * A, pick * b};
}

/// svec, upper triangle column by column, off-diagonals times sqrt2, as matrices F_0, F_1, ...
std::shared_ptr<Constraint> Matrices(const sy_cone& cone, const SparseMatrix& A,
                                     const VectorRef& b) {
  const int order = static_cast<int>((std::sqrt(8.0 * cone.dim + 1) - 1) / 2 + 0.5);
  std::vector<Eigen::MatrixXd> F(static_cast<std::size_t>(A.cols()) + 1,
                                 Eigen::MatrixXd::Zero(order, order));
  const Eigen::MatrixXd dense = A;
  for (int j = 0, row = 0; j < order; ++j) {
    for (int i = 0; i <= j; ++i, ++row) {
      const double scale = i == j ? 1 : std::sqrt(0.5);
      F[0](i, j) = F[0](j, i) = scale * b[row];
      for (Eigen::Index k = 0; k < A.cols(); ++k) {
        auto& matrix = F[static_cast<std::size_t>(k) + 1];
        matrix(i, j) = matrix(j, i) = scale * dense(row, k);
      }
    }
  }
  return std::make_shared<LinearMatrixInequalityConstraint>(F);
}

}  // namespace

std::shared_ptr<Constraint> ConeConstraintOf(const sy_cone& cone, const SparseMatrix& A,
                                             const VectorRef& b) {
  switch (cone.kind) {
    case SY_CONE_ZERO:
      return std::make_shared<LinearConstraint>(A, -b, -b);
    case SY_CONE_NONNEGATIVE:
      return std::make_shared<LinearConstraint>(A, -b, Eigen::VectorXd::Constant(b.size(), kInf));
    case SY_CONE_SECOND_ORDER:
      return std::make_shared<LorentzConeConstraint>(A, b);
    case SY_CONE_ROTATED: {  // 2 s_0 s_1 >= |s_w|^2 is z_0 z_1 >= |z_w|^2 at z_w = s_w / sqrt2
      std::vector<Place> places;
      for (int i = 0; i < cone.dim; ++i) places.push_back({i, i < 2 ? 1 : std::sqrt(0.5)});
      const Rows z = Take(A, b, places);
      return std::make_shared<RotatedLorentzConeConstraint>(z.A, z.b);
    }
    case SY_CONE_EXPONENTIAL: {  // s_2 >= s_1 exp(s_0 / s_1)
      const Rows z = Take(A, b, {{2, 1}, {1, 1}, {0, 1}});
      return std::make_shared<ExponentialConeConstraint>(z.A, z.b);
    }
    case SY_CONE_POWER:
      return std::make_shared<PowerConeConstraint>(A, b, cone.parameter);
    case SY_CONE_PSD:
      return Matrices(cone, A, b);
    default:
      Refuse("a set has a cone of kind ", static_cast<int>(cone.kind), ", which no constraint has");
  }
}

}  // namespace switchyard
