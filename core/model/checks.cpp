#include "core/model/checks.hpp"

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

}  // namespace switchyard
