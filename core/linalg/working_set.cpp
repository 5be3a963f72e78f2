#include "core/linalg/working_set.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

/// The power of two that brings `size` into [1, 2); 1 for 0.
double Unit(double size) {
  return size > 0 && std::isfinite(size) ? std::ldexp(1.0, -std::ilogb(size)) : 1.0;
}

double FiniteSize(double side) { return std::isfinite(side) ? std::abs(side) : 0; }

void RequireSides(double lower, double upper, const char* what, std::size_t i) {
  Require(lower <= upper, "linear program: the lower side of ", what, " ", i, " is ", lower,
          ", the upper one ", upper);
}

}  // namespace

void WorkingSet::Load(const DenseLp& lp) {
  n = lp.c.size();
  m = lp.row_lower.size();
  row_scale.assign(m, 1);
  col_scale.assign(n, 0);
  A.resize(m * n);
  lower.resize(m + n);
  upper.resize(m + n);
  side_size.resize(m + n);
  const auto row_unit = [&](Index i, const auto& scale_of) {
    double largest = 0;
    for (Index j = 0; j < n; ++j) largest = std::max(largest, std::abs(lp.row(i)[j]) * scale_of(j));
    return Unit(largest);
  };
  for (Index i = 0; i < m; ++i) {
    row_scale[i] = row_unit(i, [](Index) { return 1.0; });
    for (Index j = 0; j < n; ++j) {
      col_scale[j] = std::max(col_scale[j], std::abs(lp.row(i)[j]) * row_scale[i]);
    }
  }
  for (double& scale : col_scale) scale = Unit(scale);
  for (Index i = 0; i < m; ++i) {
    row_scale[i] = row_unit(i, [&](Index j) { return col_scale[j]; });
    for (Index j = 0; j < n; ++j) A[j * m + i] = lp.row(i)[j] * row_scale[i] * col_scale[j];
    RequireSides(lp.row_lower[i], lp.row_upper[i], "row", i);
    lower[i] = lp.row_lower[i] * row_scale[i];
    upper[i] = lp.row_upper[i] * row_scale[i];
  }
  for (Index j = 0; j < n; ++j) {
    RequireSides(lp.x_lower[j], lp.x_upper[j], "variable", j);
    lower[m + j] = lp.x_lower[j] / col_scale[j];
    upper[m + j] = lp.x_upper[j] / col_scale[j];
  }
  for (Index i = 0; i < m + n; ++i) {
    side_size[i] = std::max(FiniteSize(lower[i]), FiniteSize(upper[i]));
  }
}

void WorkingSet::HoldBounds(const std::vector<double>& cost) {
  working.resize(n);
  side.resize(n);
  value.resize(n);
  x.resize(n);
  activity.resize(m + n);
  along.resize(m + n);
  is_working.assign(m + n, 0);
  inverse.assign(n * n, 0);
  for (Index j = 0; j < n; ++j) {
    working[j] = m + j;
    is_working[m + j] = 1;
    inverse[j * n + j] = 1;
    const double l = lower[m + j];
    const double u = upper[m + j];
    x[j] = 0;
    if (l == u) {
      Hold(j, Side::kFixed);
    } else if (std::isinf(l) && std::isinf(u)) {
      Hold(j, Side::kFree);
    } else if (std::isinf(l) || std::isinf(u)) {
      Hold(j, std::isinf(l) ? Side::kUpper : Side::kLower);
    } else {
      const bool at_upper = cost[j] < 0 || (cost[j] == 0 && std::abs(u) < std::abs(l));
      Hold(j, at_upper ? Side::kUpper : Side::kLower);
    }
  }
  exchanges = 0;
  Place();
}

void WorkingSet::Hold(Index k, Side at) {
  const Index row = working[k];
  side[k] = at;
  value[k] = at == Side::kFree    ? (row >= m ? x[row - m] : activity[row])
             : at == Side::kUpper ? upper[row]
                                  : lower[row];
}

void WorkingSet::Combine(Index row, std::vector<double>& alpha) const {
  alpha.assign(n, 0);
  for (Index k = 0; k < n; ++k) {
    const double* d = column(k);
    if (row >= m) {
      alpha[k] = d[row - m];
    } else {
      for (Index j = 0; j < n; ++j) alpha[k] += A[j * m + row] * d[j];
    }
  }
}

void WorkingSet::Correct(Index row, std::vector<double>& alpha) {
  const auto entry = [&](Index i, Index j) {
    return i < m ? A[j * m + i] : (i - m == j ? 1.0 : 0.0);
  };
  rest_.resize(n);
  for (Index j = 0; j < n; ++j) {
    rest_[j] = entry(row, j);
    for (Index k = 0; k < n; ++k) rest_[j] -= alpha[k] * entry(working[k], j);
  }
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < n; ++j) alpha[k] += rest_[j] * column(k)[j];
  }
}

void WorkingSet::Along(const double* d) {
  std::fill_n(along.begin(), m, 0.0);
  for (Index j = 0; j < n; ++j) {
    if (d[j] == 0) continue;
    const double* a = A.data() + j * m;
    for (Index i = 0; i < m; ++i) along[i] += a[i] * d[j];
  }
  std::copy_n(d, n, along.data() + m);
}

void WorkingSet::Move(const double* d, double length) {
  for (Index j = 0; j < n; ++j) x[j] += length * d[j];
  for (Index i = 0; i < m + n; ++i) activity[i] += length * along[i];
}

void WorkingSet::Exchange(Index k, Index row, Side at, const std::vector<double>& alpha) {
  double* leaving = inverse.data() + k * n;
  for (Index j = 0; j < n; ++j) leaving[j] /= alpha[k];
  for (Index l = 0; l < n; ++l) {
    if (l == k || alpha[l] == 0) continue;
    double* other = inverse.data() + l * n;
    for (Index j = 0; j < n; ++j) other[j] -= alpha[l] * leaving[j];
  }
  is_working[working[k]] = 0;
  is_working[row] = 1;
  working[k] = row;
  Hold(k, at);
  activity[row] = value[k];
  if (row >= m) x[row - m] = value[k];
  ++exchanges;
}

bool WorkingSet::Factor() {
  for (Index k = 0; k < n; ++k) {
    if (side[k] == Side::kFree) value[k] = activity[working[k]];
  }
  if (!Invert()) return false;
  exchanges = 0;
  Place();
  return true;
}

// Gauss and Jordan's elimination with row pivots on [B | I], columns of the right half being
// those of the inverse at the end.
bool WorkingSet::Invert() {
  basis_.assign(n * n, 0);
  for (Index k = 0; k < n; ++k) {
    const Index row = working[k];
    for (Index j = 0; j < n; ++j) {
      basis_[j * n + k] = row < m ? A[j * m + row] : (row - m == j ? 1.0 : 0.0);
    }
  }
  inverse.assign(n * n, 0);
  for (Index j = 0; j < n; ++j) inverse[j * n + j] = 1;
  for (Index p = 0; p < n; ++p) {
    Index pivot = p;
    for (Index k = p + 1; k < n; ++k) {
      if (std::abs(basis_[p * n + k]) > std::abs(basis_[p * n + pivot])) pivot = k;
    }
    const double by = basis_[p * n + pivot];
    if (!(std::abs(by) > 1e-13)) return false;
    std::vector<double>& factor = rest_;
    factor.assign(basis_.data() + p * n, basis_.data() + (p + 1) * n);
    std::swap(factor[p], factor[pivot]);
    const auto eliminate = [&](double* column) {
      std::swap(column[p], column[pivot]);
      if (column[p] == 0) return;
      const double scaled = column[p] / by;
      for (Index k = 0; k < n; ++k) column[k] -= factor[k] * scaled;
      column[p] = scaled;
    };
    for (Index j = p + 1; j < n; ++j) eliminate(basis_.data() + j * n);
    for (Index j = 0; j < n; ++j) eliminate(inverse.data() + j * n);
  }
  return true;
}

// x = B^-1 value, and once more for what B x misses.
void WorkingSet::Place() {
  std::fill(x.begin(), x.end(), 0.0);
  rest_ = value;
  for (int turn = 0; turn < 2; ++turn) {
    for (Index k = 0; k < n; ++k) {
      if (rest_[k] == 0) continue;
      const double* d = column(k);
      for (Index j = 0; j < n; ++j) x[j] += rest_[k] * d[j];
    }
    Along(x.data());
    for (Index k = 0; k < n; ++k) rest_[k] = value[k] - along[working[k]];
  }
  activity = along;
}

double WorkingSet::Violation(Index i) const {
  return std::max(lower[i] - activity[i], activity[i] - upper[i]);
}

double WorkingSet::SizeOfX() const {
  double size = 0;
  for (const double v : x) size = std::max(size, std::abs(v));
  return size;
}

}  // namespace switchyard
