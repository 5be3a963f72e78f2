#include "solvers/linalg/sparse.hpp"

#include <numeric>

namespace switchyard::linalg {

void SparseMatrix::IndexColumns() {
  column_start.assign(cols + 1, 0);
  for (const Index j : column) ++column_start[j + 1];
  std::partial_sum(column_start.begin(), column_start.end(), column_start.begin());
  row.resize(column.size());
  place.resize(column.size());
  std::vector<Index> next(column_start.begin(), column_start.end() - 1);
  for (Index i = 0; i < rows; ++i) {
    for (Index k = row_start[i]; k < row_start[i + 1]; ++k) {
      place[k] = next[column[k]]++;
      row[place[k]] = i;
    }
  }
  CopyToColumns();
}

void SparseMatrix::CopyToColumns() {
  by_column.resize(by_row.size());
  for (std::size_t k = 0; k < by_row.size(); ++k) by_column[place[k]] = by_row[k];
}

namespace {

/// sum of value[k] x[index[k]]: four sums, as one would wait for itself.
SWITCHYARD_INLINE double Gathered(const double* value, const Index* index, Index count,
                                  const double* x) {
  double sum0 = 0, sum1 = 0, sum2 = 0, sum3 = 0;
  Index k = 0;
  for (; k + 4 <= count; k += 4) {
    sum0 += value[k] * x[index[k]];
    sum1 += value[k + 1] * x[index[k + 1]];
    sum2 += value[k + 2] * x[index[k + 2]];
    sum3 += value[k + 3] * x[index[k + 3]];
  }
  for (; k < count; ++k) sum0 += value[k] * x[index[k]];
  return (sum0 + sum1) + (sum2 + sum3);
}

}  // namespace

SWITCHYARD_EACH_ISA void Multiply(const SparseMatrix& a, const double* x, double* y) {
  const Index* start = a.row_start.data();
  for (Index i = 0; i < a.rows; ++i) {
    y[i] = Gathered(a.by_row.data() + start[i], a.column.data() + start[i], start[i + 1] - start[i],
                    x);
  }
}

SWITCHYARD_EACH_ISA void AddTransposed(const SparseMatrix& a, double alpha, const double* x,
                                       double* y) {
  const Index* start = a.column_start.data();
  for (Index j = 0; j < a.cols; ++j) {
    y[j] += alpha * Gathered(a.by_column.data() + start[j], a.row.data() + start[j],
                             start[j + 1] - start[j], x);
  }
}

void AddProduct(const SymmetricMatrix& p, double alpha, const double* x, double* y) {
  for (Index j = 0; j < p.pattern.n; ++j) {
    const double xj = alpha * x[j];
    double sum = 0;
    for (Index k = p.pattern.start[j]; k < p.pattern.start[j + 1]; ++k) {
      const Index i = p.pattern.row[k];
      if (i == j) {
        sum += p.value[k] * x[j];
      } else {
        y[i] += p.value[k] * xj;
        sum += p.value[k] * x[i];
      }
    }
    y[j] += alpha * sum;
  }
}

}  // namespace switchyard::linalg
