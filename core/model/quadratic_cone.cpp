#include "core/model/quadratic_cone.hpp"

#include <cmath>

#include "core/linalg/semidefinite_factor.hpp"
#include "core/model/eigenvalues.hpp"

namespace switchyard {
namespace {

Csc UpperTriangle(const SparseMatrix& Q) {
  Csc upper(static_cast<std::int32_t>(Q.rows()), static_cast<std::int32_t>(Q.cols()));
  for (int j = 0; j < Q.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(Q, j); entry && entry.row() <= j; ++entry) {
      upper.row.push_back(static_cast<std::int32_t>(entry.row()));
      upper.value.push_back(entry.value());
    }
    upper.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(upper.row.size());
  }
  return upper;
}

}  // namespace

RotatedCone RotatedConeOf(const SparseMatrix& Q, const Eigen::VectorXd& b, double upper) {
  const SemidefiniteFactor factor = FactorSemidefinite(UpperTriangle(Q));
  if (factor.not_semidefinite.has_value()) {
    Refuse("quadratic constraint: Q needs to be positive semidefinite to be a cone, got one whose ",
           DescribeNegativeEigenvalues(Eigen::MatrixXd(Q)));
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < b.size(); ++j) {
    if (b[j] != 0) entries.emplace_back(1, j, -b[j]);
  }
  const double half = std::sqrt(0.5);
  for (int j = 0; j < factor.S.cols; ++j) {
    const auto column = static_cast<std::size_t>(j);
    for (auto k = factor.S.start[column]; k < factor.S.start[column + 1]; ++k) {
      const auto at = static_cast<std::size_t>(k);
      entries.emplace_back(2 + factor.S.row[at], j, half * factor.S.value[at]);
    }
  }
  RotatedCone cone{SparseMatrix(2 + factor.S.rows, b.size()),
                   Eigen::VectorXd::Zero(2 + factor.S.rows)};
  cone.A.setFromTriplets(entries.begin(), entries.end());
  cone.b[0] = 1;
  cone.b[1] = upper;
  return cone;
}

}  // namespace switchyard
