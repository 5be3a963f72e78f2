#include <cmath>
#include <limits>

#include "core/model/parse_rows.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

using Eigen::Index;

template <class C>
Binding<C> ConeOf(const Eigen::VectorX<Expression>& z) {
  AffineForm form = DecomposeAffine(z);
  return {std::make_shared<C>(std::move(form.A), form.b), form.variables};
}

// Affine expressions whose squares add up to a quadratic one. The tolerance is raised to what the
// rounding of a factorization may leave of a pivot that is 0.
Eigen::VectorX<Expression> SquaresOf(const Expression& quadratic, double tolerance) {
  if (quadratic.is_constant() && quadratic.Evaluate() >= 0) {
    return OneRow(std::sqrt(quadratic.Evaluate()));
  }
  double largest = 0;
  if (IsQuadratic(quadratic)) {
    const QuadraticForm form = DecomposeQuadratic(quadratic);
    for (Index k = 0; k < form.Q.nonZeros(); ++k) {
      largest = std::max(largest, std::abs(form.Q.valuePtr()[k]));
    }
  }
  const double least = std::max(tolerance, 1e-12 * largest);
  const auto norm = RecognizeL2Norm(sqrt(quadratic), least, std::max(least, 1e-10 * largest));
  if (!norm) {
    Refuse(quadratic.to_string(60), " is no sum of squares of affine expressions");
  }
  return norm->A * norm->variables + norm->b;
}

}  // namespace

Binding<LorentzConeConstraint> ParseLorentzConeConstraint(const ExpressionList& z) {
  return ConeOf<LorentzConeConstraint>(z.vector());
}

Binding<LorentzConeConstraint> ParseLorentzConeConstraint(const Expression& linear,
                                                          const Expression& quadratic,
                                                          double tolerance) {
  const Eigen::VectorX<Expression> squares = SquaresOf(quadratic, tolerance);
  Eigen::VectorX<Expression> z(squares.size() + 1);
  z << linear, squares;
  return ConeOf<LorentzConeConstraint>(z);
}

Binding<RotatedLorentzConeConstraint> ParseRotatedLorentzConeConstraint(const ExpressionList& z) {
  return ConeOf<RotatedLorentzConeConstraint>(z.vector());
}

Binding<RotatedLorentzConeConstraint> ParseRotatedLorentzConeConstraint(const Expression& linear1,
                                                                        const Expression& linear2,
                                                                        const Expression& quadratic,
                                                                        double tolerance) {
  const Eigen::VectorX<Expression> squares = SquaresOf(quadratic, tolerance);
  Eigen::VectorX<Expression> z(squares.size() + 2);
  z << linear1, linear2, squares;
  return ConeOf<RotatedLorentzConeConstraint>(z);
}

Binding<LinearConstraint> ParsePositiveDiagonallyDominantDualCone(const ExpressionList& list) {
  const Eigen::MatrixX<Expression>& X = list.matrix();
  const Index n = X.rows();
  Require(X.cols() == n, "a diagonally dominant dual cone needs a square matrix, got ", n, " x ",
          X.cols());
  std::vector<Expression> rows;
  for (Index j = 0; j < n; ++j) {
    rows.push_back(X(j, j));
    for (Index i = 0; i < j; ++i) {
      const Expression diagonal = X(i, i) + X(j, j);
      rows.push_back(diagonal + X(i, j) + X(j, i));
      rows.push_back(diagonal - X(i, j) - X(j, i));
    }
  }
  const auto count = static_cast<Index>(rows.size());
  return ParseLinearConstraint(
      Eigen::Map<const Eigen::VectorX<Expression>>(rows.data(), count),
      Eigen::VectorXd::Zero(count),
      Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity()));
}

}  // namespace switchyard
