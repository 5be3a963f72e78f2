#include "dense_front.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solvers/linalg/dense_kernels.hpp"

namespace switchyard::ipopt {
namespace {

using linalg::Index;
using linalg::kLanes;
using linalg::LanesAt;

// Relative to its terms, a sum that is no larger is a rounding error: some tens of units in the
// last place.
constexpr double kRounding = 1e-14;
// What is left of a column whose entries were about 1, where it is no more than that.
constexpr double kNothing = 1e-15;

/// v -= factor u, `count` a multiple of kLanes.
SWITCHYARD_INLINE void SubtractMultiple(const double* u, double factor, std::size_t count,
                                        double* v) {
  for (std::size_t i = 0; i < count; i += kLanes) LanesAt(v + i) -= LanesAt(u + i) * factor;
}

/// Column j of `to`, `stride` behind the one before, -= factor[j] from; `count` rows of each.
SWITCHYARD_EACH_ISA void SubtractOuter(const double* from, const double* factor, Index columns,
                                       std::size_t count, std::size_t stride, double* to) {
  for (Index j = 0; j < columns; ++j, to += stride) {
    if (factor[j] != 0) SubtractMultiple(from, factor[j], count, to);
  }
}

/// y -= a x, for `columns` columns `stride` apart, all rows of them.
SWITCHYARD_EACH_ISA void SubtractProduct(const double* a, const double* x, Index columns,
                                         std::size_t stride, double* y) {
  for (Index j = 0; j < columns; ++j, a += stride) SubtractMultiple(a, x[j], stride, y);
}

/// x -= a' y.
SWITCHYARD_EACH_ISA void SubtractTransposed(const double* a, const double* y, Index columns,
                                            std::size_t stride, double* x) {
  for (Index j = 0; j < columns; ++j, a += stride) {
    linalg::Lanes sums = {};
    for (std::size_t i = 0; i < stride; i += kLanes) sums += LanesAt(a + i) * LanesAt(y + i);
    for (int i = 0; i < kLanes; ++i) x[j] -= sums[i];
  }
}

SWITCHYARD_EACH_ISA double LargestBelow(const double* v, std::size_t count) {
  linalg::Lanes largest = {};
  for (std::size_t i = 0; i < count; i += kLanes) {
    const linalg::Lanes at = LanesAt(v + i);
    largest = linalg::Max(linalg::Max(at, -at), largest);
  }
  double most = 0;
  for (int i = 0; i < kLanes; ++i) most = std::max(most, largest[i]);
  return most;
}

}  // namespace

void DenseFront::Reset(Index candidates, Index rows) {
  candidates_ = candidates;
  rows_ = rows;
  pivots_ = 0;
  top_stride_ = static_cast<std::size_t>(linalg::RoundUp(candidates));
  below_stride_ = static_cast<std::size_t>(linalg::RoundUp(rows));
  const auto columns = static_cast<std::size_t>(candidates);
  top_.assign(columns * top_stride_, 0.0);
  below_.assign(columns * below_stride_, 0.0);
  order_.resize(columns);
  std::iota(order_.begin(), order_.end(), 0);
  factor_.resize(2 * columns);
  size_.assign(columns + static_cast<std::size_t>(rows), 0.0);
  for (auto* v : {&inverse_, &inverse_off_, &pivot_, &pivot_off_}) v->assign(columns, 0.0);
}

DenseFront::Largest DenseFront::LargestOf(Index column, Index skip) const {
  Largest largest;
  const double* top = top_.data() + At(0, column);
  for (Index i = pivots_; i < candidates_; ++i) {
    if (i == column || i == skip) continue;
    const double size = std::abs(top[i]);
    if (size > largest.candidate) largest = {size, size, i};
  }
  const double below = LargestBelow(below_.data() + BelowAt(0, column), below_stride_);
  largest.all = std::max(largest.candidate, below);
  return largest;
}

// Rows below the candidates stay where they are.
void DenseFront::Swap(Index i, Index j) {
  if (i == j) return;
  std::swap_ranges(top_.begin() + static_cast<std::ptrdiff_t>(At(0, i)),
                   top_.begin() + static_cast<std::ptrdiff_t>(At(0, i) + top_stride_),
                   top_.begin() + static_cast<std::ptrdiff_t>(At(0, j)));
  for (Index k = 0; k < candidates_; ++k) std::swap(top_[At(i, k)], top_[At(j, k)]);
  std::swap_ranges(below_.begin() + static_cast<std::ptrdiff_t>(BelowAt(0, i)),
                   below_.begin() + static_cast<std::ptrdiff_t>(BelowAt(0, i) + below_stride_),
                   below_.begin() + static_cast<std::ptrdiff_t>(BelowAt(0, j)));
  std::swap(order_[i], order_[j]);
  std::swap(size_[i], size_[j]);
}

// Rows above the first column that is left are done with.
void DenseFront::Subtract(const Column& from, const double* factor, Index first) {
  const Index columns = candidates_ - first;
  if (columns == 0) return;
  const std::size_t done = static_cast<std::size_t>(first) / kLanes * kLanes;
  SubtractOuter(from.top + done, factor, columns, top_stride_ - done, top_stride_,
                top_.data() + At(0, first) + done);
  SubtractOuter(from.below, factor, columns, below_stride_, below_stride_,
                below_.data() + BelowAt(0, first));
}

// Column k of L is what column k is over the pivot d.
void DenseFront::EliminateSingle(double d) {
  const Index k = pivots_;
  const Index others = candidates_ - k - 1;
  const double inverse = 1 / d;
  double* top = top_.data() + At(0, k);
  double* below = below_.data() + BelowAt(0, k);
  for (Index j = 0; j < others; ++j) factor_[j] = top[k + 1 + j] * inverse;
  Subtract({top, below}, factor_.data(), k + 1);
  for (Index i = k + 1; i < candidates_; ++i) {
    size_[i] += std::abs(top[i] * factor_[i - k - 1]);
    top[i] *= inverse;
  }
  double* size = size_.data() + candidates_;
  for (Index i = 0; i < rows_; ++i) {
    size[i] += std::abs(below[i] * inverse * below[i]);
    below[i] *= inverse;
  }
  pivot_[k] = d;
  inverse_[k] = inverse;
  ++pivots_;
}

// Columns (k, k + 1) of L are those columns times D^-1.
void DenseFront::EliminatePair() {
  const Index k = pivots_;
  const Index others = candidates_ - k - 2;
  double* a = top_.data() + At(0, k);
  double* b = a + top_stride_;
  double* a_below = below_.data() + BelowAt(0, k);
  double* b_below = a_below + below_stride_;
  const double d_a = a[k], d_b = b[k + 1], d_off = a[k + 1];
  // Scaled by the entry off the diagonal, which is the largest in a block that is chosen.
  const double p = d_a / d_off, q = d_b / d_off;
  const double scale = 1 / (d_off * (p * q - 1));
  inverse_[k] = q * scale;
  inverse_[k + 1] = p * scale;
  inverse_off_[k] = -scale;
  pivot_[k] = d_a;
  pivot_[k + 1] = d_b;
  pivot_off_[k] = d_off;
  double* of_a = factor_.data();
  double* of_b = of_a + others;
  for (Index j = 0; j < others; ++j) {
    const double u = a[k + 2 + j], v = b[k + 2 + j];
    of_a[j] = inverse_[k] * u + inverse_off_[k] * v;
    of_b[j] = inverse_off_[k] * u + inverse_[k + 1] * v;
    size_[k + 2 + j] += size_[k] * of_a[j] * of_a[j] + size_[k + 1] * of_b[j] * of_b[j] +
                        2 * std::abs(d_off * of_a[j] * of_b[j]);
  }
  Subtract({a, a_below}, of_a, k + 2);
  Subtract({b, b_below}, of_b, k + 2);
  std::copy_n(of_a, others, a + k + 2);
  std::copy_n(of_b, others, b + k + 2);
  // The rows' terms are those of the block's eigenvectors: see SubtractFrom.
  const double of_block = size_[k] + size_[k + 1] + std::abs(d_off);
  double* size = size_.data() + candidates_;
  for (Index i = 0; i < rows_; ++i) {
    const double u = a_below[i], v = b_below[i];
    a_below[i] = inverse_[k] * u + inverse_off_[k] * v;
    b_below[i] = inverse_off_[k] * u + inverse_[k + 1] * v;
    size[i] += of_block * (a_below[i] * a_below[i] + b_below[i] * b_below[i]);
  }
  pivots_ += 2;
}

bool DenseFront::TakePair(Index j, Index r, double u, Inertia& inertia) {
  const double d_j = top_[At(j, j)], d_r = top_[At(r, r)], off = top_[At(r, j)];
  const double det = d_j * d_r - off * off;
  const double beside_j = LargestOf(j, r).all, beside_r = LargestOf(r, j).all;
  if (!(std::abs(det) > kRounding * (size_[j] * size_[r] + off * off))) return false;
  const double bound = std::abs(det) / u;
  const bool stable = std::abs(d_r) * beside_j + std::abs(off) * beside_r <= bound &&
                      std::abs(off) * beside_j + std::abs(d_j) * beside_r <= bound;
  if (!stable) return false;
  Swap(pivots_, j);
  Swap(pivots_ + 1, r == pivots_ ? j : r);
  EliminatePair();
  inertia.negative += det < 0 ? 1 : (d_j + d_r < 0 ? 2 : 0);
  return true;
}

bool DenseFront::TakeOne(double u, Inertia& inertia) {
  for (Index j = pivots_; j < candidates_; ++j) {
    const double d = top_[At(j, j)];
    const Largest of_j = LargestOf(j, -1);
    if (std::abs(d) > std::max(kNothing, kRounding * size_[j]) && std::abs(d) >= u * of_j.all) {
      Swap(pivots_, j);
      EliminateSingle(d);
      inertia.negative += d < 0 ? 1 : 0;
      return true;
    }
    if (of_j.candidate > kNothing && TakePair(j, of_j.row, u, inertia)) return true;
  }
  return false;
}

void DenseFront::Eliminate(double u, bool all, Inertia& inertia) {
  while (pivots_ < candidates_ && TakeOne(u, inertia)) {
  }
  while (all && pivots_ < candidates_) {
    ++inertia.zero;
    EliminateSingle(HUGE_VAL);
  }
}

// A block Q diag(a, b) Q' of D is two single pivots of the columns (l, m) Q.
void DenseFront::SubtractFrom(double* c, linalg::Vector& work) const {
  if (rows_ == 0 || pivots_ == 0) return;
  const auto columns = static_cast<std::size_t>(pivots_);
  const std::size_t size = columns * below_stride_;
  work.resize(size + columns * (1 + linalg::kWorkPerPivot) + 2 * kLanes);
  double* below = work.data();
  double* pivot = below + size;
  std::copy_n(below_.data(), size, below);
  for (std::size_t k = 0; k < columns; ++k) {
    pivot[k] = std::isinf(pivot_[k]) ? 0 : pivot_[k];
    if (pivot_off_[k] == 0) continue;
    const double middle = (pivot_[k] + pivot_[k + 1]) / 2, half = (pivot_[k] - pivot_[k + 1]) / 2;
    const double radius = std::hypot(half, pivot_off_[k]);
    const double angle = std::atan2(pivot_off_[k], half) / 2;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    double* a = below + k * below_stride_;
    double* b = a + below_stride_;
    for (std::size_t i = 0; i < below_stride_; ++i) {
      const double u = a[i], v = b[i];
      a[i] = cosine * u + sine * v;
      b[i] = cosine * v - sine * u;
    }
    pivot[k] = middle + radius;
    pivot[++k] = middle - radius;
  }
  linalg::Front front;
  front.pivots = pivots_;
  front.rows = rows_;
  front.below_stride = static_cast<Index>(below_stride_);
  front.below = below;
  linalg::SubtractSquare(front, pivot, c, pivot + columns);
}

void DenseFront::Forward(double* x) const {
  double* y = x + top_stride_;
  for (Index k = 0; k < pivots_; ++k) {
    const double* top = top_.data() + At(0, k);
    const double x_k = x[k];
    for (Index i = k + (pivot_off_[k] != 0 ? 2 : 1); i < candidates_; ++i) x[i] -= top[i] * x_k;
  }
  SubtractProduct(below_.data(), x, pivots_, below_stride_, y);
}

void DenseFront::Backward(double* x) const {
  const double* y = x + top_stride_;
  for (Index k = 0; k < pivots_; ++k) {
    const double x_k = x[k];
    x[k] *= inverse_[k];
    if (pivot_off_[k] == 0) continue;
    x[k] += inverse_off_[k] * x[k + 1];
    x[k + 1] = inverse_off_[k] * x_k + inverse_[k + 1] * x[k + 1];
    ++k;
  }
  SubtractTransposed(below_.data(), y, pivots_, below_stride_, x);
  for (Index k = pivots_ - 1; k >= 0; --k) {
    const double* top = top_.data() + At(0, k);
    double sum = x[k];
    for (Index i = k + (pivot_off_[k] != 0 ? 2 : 1); i < candidates_; ++i) sum -= top[i] * x[i];
    x[k] = sum;
  }
}

}  // namespace switchyard::ipopt
