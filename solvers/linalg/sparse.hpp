// solvers/linalg/sparse.hpp - a sparse matrix that is multiplied with often, from both sides.
#pragma once

#include <vector>

#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"
#include "solvers/linalg/workers.hpp"

namespace switchyard::linalg {

/// By rows and by columns.
struct SparseMatrix {
  Index rows = 0;
  Index cols = 0;
  std::vector<Index> row_start = {0}, column;  // by rows; columns ascend
  std::vector<Index> column_start = {0}, row;  // by columns; rows ascend
  std::vector<double> by_row, by_column;       // the values
  std::vector<Index> place;                    // in by_column of each entry of by_row

  [[nodiscard]] Index nonzeros() const { return row_start.back(); }
  /// Fills what is by columns from what is by rows.
  void IndexColumns();
  /// Only the values.
  void CopyToColumns();
};

/// y = A x; `workers`, if any, share the rows.
void Multiply(const SparseMatrix& a, const double* x, double* y, Workers* workers = nullptr);
/// y += alpha A'x; likewise the columns.
void AddTransposed(const SparseMatrix& a, double alpha, const double* x, double* y,
                   Workers* workers = nullptr);

/// Symmetric, the upper triangle by columns.
struct SymmetricMatrix {
  SymmetricPattern pattern;
  std::vector<double> value;
};

/// y += alpha P x.
void AddProduct(const SymmetricMatrix& p, double alpha, const double* x, double* y);

}  // namespace switchyard::linalg
