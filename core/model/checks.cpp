#include "core/model/checks.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard {

void CheckFinite(std::string_view name, std::string_view what, double number) {
  Require(std::isfinite(number), name, ": ", what, " needs to be finite, got ", number);
}

void CheckFinite(std::string_view name, std::string_view what, const VectorRef& v) {
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    Require(std::isfinite(v[i]), name, ": ", what, "[", i, "] needs to be finite, got ", v[i]);
  }
}

void CheckFinite(std::string_view name, std::string_view what, const SparseMatrix& M) {
  for (int j = 0; j < M.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(M, j); it; ++it) {
      Require(std::isfinite(it.value()), name, ": ", what, "(", it.row(), ",", j,
              ") needs to be finite, got ", it.value());
    }
  }
}

void CheckShape(std::string_view name, std::string_view what, const SparseMatrix& M,
                Eigen::Index rows, Eigen::Index cols) {
  Require(M.rows() == rows && M.cols() == cols, name, ": ", what, " needs to be ", rows, " x ",
          cols, ", got ", M.rows(), " x ", M.cols());
}

void CheckSize(std::string_view name, std::string_view what, const VectorRef& v,
               Eigen::Index size) {
  Require(v.size() == size, name, ": ", what, " needs ", size, " entries, got ", v.size());
}

// Compared first: inf - inf is not a number.
double BoxViolation(const Eigen::VectorXd& y, const Eigen::VectorXd& lower,
                    const Eigen::VectorXd& upper) {
  double worst = 0;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    if (y[i] < lower[i]) worst = std::max(worst, lower[i] - y[i]);
    if (y[i] > upper[i]) worst = std::max(worst, y[i] - upper[i]);
  }
  return worst;
}

}  // namespace switchyard
