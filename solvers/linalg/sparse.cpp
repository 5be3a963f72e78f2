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

SWITCHYARD_EACH_ISA void MultiplyRows(const SparseMatrix& a, Index begin, Index end,
                                      const double* x, double* y) {
  const Index* start = a.row_start.data();
  for (Index i = begin; i < end; ++i) {
    y[i] = Gathered(a.by_row.data() + start[i], a.column.data() + start[i], start[i + 1] - start[i],
                    x);
  }
}

SWITCHYARD_EACH_ISA void AddColumns(const SparseMatrix& a, Index begin, Index end, double alpha,
                                    const double* x, double* y) {
  const Index* start = a.column_start.data();
  for (Index j = begin; j < end; ++j) {
    y[j] += alpha * Gathered(a.by_column.data() + start[j], a.row.data() + start[j],
                             start[j + 1] - start[j], x);
  }
}

constexpr std::size_t kGrain = 2048;  // rows, or columns

}  // namespace

void Multiply(const SparseMatrix& a, const double* x, double* y, Workers* workers) {
  EachPart(workers, static_cast<std::size_t>(a.rows), kGrain,
           [&](std::size_t begin, std::size_t end) {
             MultiplyRows(a, static_cast<Index>(begin), static_cast<Index>(end), x, y);
           });
}

void AddTransposed(const SparseMatrix& a, double alpha, const double* x, double* y,
                   Workers* workers) {
  EachPart(workers, static_cast<std::size_t>(a.cols), kGrain,
           [&](std::size_t begin, std::size_t end) {
             AddColumns(a, static_cast<Index>(begin), static_cast<Index>(end), alpha, x, y);
           });
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
