#include "solvers/linalg/simplicial_ldl.hpp"

#include <cmath>

namespace switchyard::linalg {

SimplicialLdl::SimplicialLdl(const Elimination& elimination, const std::vector<std::int8_t>& sign)
    : a_(elimination.permuted), parent_(elimination.parent), start_(parent_.size() + 1, 0) {
  const auto n = parent_.size();
  for (std::size_t j = 0; j < n; ++j) start_[j + 1] = start_[j] + elimination.column_size[j];
  sign_.reserve(n);
  for (const Index j : elimination.order) sign_.push_back(sign[j]);
  row_.resize(start_.back());
  value_.resize(start_.back());
  inverse_d_.resize(n);
  end_.resize(n);
  y_.assign(n, 0.0);
  seen_.resize(n);
  reach_.resize(n);
}

int SimplicialLdl::Factor(const double* values, const PivotRule& rule) {
  const Index n = a_.pattern.n;
  int raised = 0;
  for (Index k = 0; k < n; ++k) {
    end_[k] = start_[k];
    seen_[k] = k;
    double d = 0, size = 0;
    Index top = n;  // of the reach, in topological order from here
    for (Index e = a_.pattern.start[k]; e < a_.pattern.start[k + 1]; ++e) {
      const Index row = a_.pattern.row[e];
      const double value = values[a_.entry[e]];
      if (row == k) {
        d = value;
        size += std::abs(value);
        continue;
      }
      y_[row] += value;
      Index length = 0;
      for (Index i = row; seen_[i] != k; i = parent_[i]) {
        reach_[length++] = i;
        seen_[i] = k;
      }
      while (length > 0) reach_[--top] = reach_[--length];
    }
    for (; top < n; ++top) {
      const Index i = reach_[top];
      const double y = y_[i];
      y_[i] = 0;
      const double l = y * inverse_d_[i];
      for (std::int64_t p = start_[i]; p < end_[i]; ++p) y_[row_[p]] -= value_[p] * y;
      d -= l * y;
      size += std::abs(l * y);
      row_[end_[i]] = k;
      value_[end_[i]++] = l;
    }
    inverse_d_[k] = 1 / rule.Accept(d, sign_[k], size, raised);
  }
  return raised;
}

void SimplicialLdl::Solve(double* b) const {
  const Index n = a_.pattern.n;
  for (Index j = 0; j < n; ++j) {
    const double x = b[j];
    for (std::int64_t p = start_[j]; p < start_[j + 1]; ++p) b[row_[p]] -= value_[p] * x;
  }
  for (Index j = n - 1; j >= 0; --j) {
    double sum0 = b[j] * inverse_d_[j], sum1 = 0, sum2 = 0;  // as one would wait for itself
    std::int64_t p = start_[j];
    for (; p + 3 <= start_[j + 1]; p += 3) {
      sum0 -= value_[p] * b[row_[p]];
      sum1 -= value_[p + 1] * b[row_[p + 1]];
      sum2 -= value_[p + 2] * b[row_[p + 2]];
    }
    for (; p < start_[j + 1]; ++p) sum1 -= value_[p] * b[row_[p]];
    b[j] = sum0 + (sum1 + sum2);
  }
}

}  // namespace switchyard::linalg
