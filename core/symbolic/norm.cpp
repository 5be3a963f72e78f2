#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/symbolic/quadratic.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = std::vector<Expression>;

AffineForm FormOf(const Rows& rows, double scale) {
  AffineForm form = DecomposeAffine(Eigen::Map<const Eigen::VectorX<Expression>>(
      rows.data(), static_cast<Eigen::Index>(rows.size())));
  form.A *= scale;
  form.b *= scale;
  return form;
}

// The rows whose squares add up to q, where q is written as such a sum.
std::optional<Rows> SumOfSquares(const Expression& q) {
  if (!(q.constant() >= 0) || !q.MergedLinear().empty()) return std::nullopt;
  Rows rows;
  for (const auto& [node, coefficient] : q.nonlinear()) {
    if (!(coefficient >= 0) || !IsSquareOfAffine(*node)) return std::nullopt;
    rows.push_back(node->operand(0));
    rows.back() *= std::sqrt(coefficient);
  }
  if (q.constant() > 0) rows.emplace_back(std::sqrt(q.constant()));
  return rows;
}

// R of full row rank with R'R = H up to pivots of at most `tolerance`: H = P'LDL'P has the rows
// sqrt(D_k) (L'P)_k. Empty where a pivot is below -tolerance.
std::optional<MatrixXd> Root(const MatrixXd& H, double tolerance) {
  const Eigen::LDLT<MatrixXd> factor(H);
  const VectorXd D = factor.vectorD();
  if (D.size() > 0 && D.minCoeff() < -tolerance) return std::nullopt;
  MatrixXd LtP = factor.transpositionsP() * MatrixXd::Identity(H.rows(), H.cols());
  LtP = (factor.matrixU() * LtP).eval();
  MatrixXd R((D.array() > tolerance).count(), H.cols());
  for (Eigen::Index k = 0, row = 0; k < D.size(); ++k) {
    if (D[k] > tolerance) R.row(row++) = std::sqrt(D[k]) * LtP.row(k);
  }
  return R;
}

// As many rows as R, and one more where a constant is left.
std::optional<AffineForm> Completed(const QuadraticForm& q, double psd_tol,
                                    double coefficient_tol) {
  const MatrixXd H = MatrixXd(q.Q) / 2;
  const auto R = Root(H, psd_tol);
  if (!R) return std::nullopt;
  VectorXd d = VectorXd::Zero(R->rows());
  if (d.size() > 0) d = R->transpose().colPivHouseholderQr().solve(q.b / 2);
  const double rest = q.c - d.squaredNorm();
  const double error = std::max((H - R->transpose() * *R).cwiseAbs().maxCoeff(),
                                (q.b - 2 * R->transpose() * d).cwiseAbs().maxCoeff());
  if (!(error <= coefficient_tol) || !(rest >= -coefficient_tol)) return std::nullopt;
  const bool left = rest > coefficient_tol;
  MatrixXd A = MatrixXd::Zero(R->rows() + (left ? 1 : 0), H.cols());
  VectorXd b = VectorXd::Zero(A.rows());
  A.topRows(R->rows()) = *R;
  b.head(R->rows()) = d;
  if (left) b[R->rows()] = std::sqrt(rest);
  return AffineForm{A.sparseView(1.0, 0.0), b, q.variables};
}

}  // namespace

std::optional<AffineForm> RecognizeL2Norm(const Expression& e, double psd_tol,
                                          double coefficient_tol) {
  if (e.constant() != 0 || e.nonlinear().size() != 1 || !e.MergedLinear().empty()) {
    return std::nullopt;
  }
  const auto& [node, scale] = e.nonlinear().front();
  if (!(scale > 0)) return std::nullopt;
  const Expression& inside = node->operand(0);
  if (node->op() == Op::kAbs && IsAffine(inside)) return FormOf({inside}, scale);
  if (node->op() != Op::kSqrt) return std::nullopt;
  if (const auto rows = SumOfSquares(inside)) return FormOf(*rows, scale);
  if (!IsQuadratic(inside)) return std::nullopt;
  const QuadraticForm q = DecomposeQuadratic(inside);
  if (q.variables.size() == 0) return std::nullopt;
  auto form = Completed(q, psd_tol, coefficient_tol);
  if (form) {
    form->A *= scale;
    form->b *= scale;
  }
  return form;
}

}  // namespace switchyard
