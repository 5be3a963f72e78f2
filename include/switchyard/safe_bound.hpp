// switchyard/safe_bound.hpp - a bound on the optimum from duals of any quality: what a solver left,
// made feasible, its rounding counted against it.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

// What follows knows the error of each of its own operations, in IEEE double precision alone.
#ifdef __FAST_MATH__
#error "switchyard/safe_bound.hpp proves a bound: compile it without -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "a double must be rounded to a double after each operation");

namespace switchyard {

struct SafeBound {
  double value;     // no feasible point has a smaller objective; -infinity: nothing is proven
  double estimate;  // value where it is finite, else what it would be were the open columns'
                    // residuals 0: for reports, never a bound
  std::int32_t open_column;  // the column of the largest open residual; -1 where none is open
  double open_residual;      // |rho_j| / (1 + |q_j| + its largest term), of that column
};

namespace safe_bound_detail {

/// What fl(a b) = p lost, exactly, where nothing underflows: by a fused multiply-add where the
/// target has one, else by Veltkamp's splitting and Dekker's product (Numerische Mathematik 18,
/// 1971).
inline double ProductError(double a, double b, double p) {
#if defined(__FP_FAST_FMA) || defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  return std::fma(a, b, -p);
#else
  constexpr double kLargest = 0x1p990;  // the splitting overflows above
  if (!(std::abs(a) < kLargest && std::abs(b) < kLargest)) return std::fma(a, b, -p);
  constexpr double kSplitter = 0x1p27 + 1;
  const double ca = kSplitter * a, cb = kSplitter * b;
  const double a1 = ca - (ca - a), b1 = cb - (cb - b);
  const double a2 = a - a1, b2 = b - b1;
  return ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
#endif
}

/// A sum that knows how wrong it may be. The true sum is within `lost` of high + low; both take
/// each addend by TwoSum, s = fl(a + b) and a + b - s exactly (Knuth, The Art of Computer
/// Programming 2, 4.2.2), so lost is 0 where low never rounded.
class ErrorFreeSum {
 public:
  void Add(double v) {
    largest_ = std::max(largest_, std::abs(v));
    AddLow(TwoSum(high_, v));
  }
  /// a b = p + e exactly, where neither underflows.
  void AddProduct(double a, double b) {
    const double p = Product(a, b);
    Add(p);
    AddLow(ProductError(a, b, p));
    if (std::abs(p) < kUnderflow && a != 0 && b != 0) lost_ += DBL_MIN;
  }

  /// Where the true sum is; a point where nothing was rounded.
  [[nodiscard]] Interval Enclosure() const {
    double sum = high_;
    const double tail = TwoSum(sum, low_);
    if (tail == 0 && lost_ == 0) return {sum, sum};
    // The factor covers the rounding of fewer than 2^32 additions to lost.
    const double radius = std::abs(tail) + lost_ * (1 + 1e-6);
    return {std::nextafter(sum - radius, -kInfinity), std::nextafter(sum + radius, kInfinity)};
  }
  [[nodiscard]] double largest_term() const { return largest_; }

 private:
  static constexpr double kUnderflow = DBL_MIN / (DBL_EPSILON * DBL_EPSILON);

  /// fl(a b), as a value that cannot become part of a later addition: where the target has a fused
  /// multiply-add, -ffp-contract=fast would merge a plain product into the sum that follows it, and
  /// TwoSum would see two different p. A fused product with +0 is no product to merge.
  static double Product(double a, double b) {
#if defined(__FP_FAST_FMA) || defined(__FMA__) || defined(__ARM_FEATURE_FMA)
    return std::fma(a, b, 0.0);
#else
    return a * b;
#endif
  }
  /// Adds v to sum and returns what that rounded away.
  static double TwoSum(double& sum, double v) {
    const double old = sum;
    sum = old + v;
    const double taken = sum - old;
    return (old - (sum - taken)) + (v - taken);
  }
  void AddLow(double v) { lost_ += std::abs(TwoSum(low_, v)); }

  double high_ = 0, low_ = 0, lost_ = 0, largest_ = 0;
};

/// Terms of the bound, and 4 N 2^-53 sum |terms| for their rounding: N - 1 additions and at most
/// three products in a term.
class Terms {
 public:
  void Add(double term) {
    if (term == 0) return;
    sum_ += term;
    size_ += std::abs(term);
    count_ += 1;
  }
  [[nodiscard]] double LowerEnd() const {
    if (size_ == 0) return 0;
    const double end = sum_ - 2 * count_ * DBL_EPSILON * size_;
    return std::isfinite(end) ? std::nextafter(end, -kInfinity) : -kInfinity;
  }

 private:
  double sum_ = 0, size_ = 0, count_ = 0;
};

/// v by value, 0 for all that is not a number: any dual will do, so 0 does.
inline std::vector<double> FiniteOrZero(const double* v, std::int32_t count) {
  std::vector<double> copy(static_cast<std::size_t>(count), 0.0);
  if (v == nullptr) return copy;
  std::transform(v, v + count, copy.begin(), [](double e) { return std::isfinite(e) ? e : 0.0; });
  return copy;
}

/// The duals without what stands against an infinite side, and sum(l+ r_l - l- r_u) to the terms.
inline std::vector<double> UsableRowDual(const sy_problem& p, const double* given, Terms& terms) {
  std::vector<double> dual = FiniteOrZero(given, p.num_rows);
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    double& d = dual[static_cast<std::size_t>(i)];
    if (d == 0) continue;
    const double* sides = d > 0 ? p.row_lower : p.row_upper;
    if (sides == nullptr || std::isinf(sides[i])) {
      d = 0;
    } else {
      terms.Add(d * sides[i]);
    }
  }
  return dual;
}

/// The duals moved into their dual cones, and -z'g to the terms.
inline std::vector<double> UsableConeDual(const sy_problem& p, const double* given, Terms& terms) {
  std::vector<double> dual = FiniteOrZero(given, p.num_cone_rows);
  double* at = dual.data();
  for (std::int32_t c = 0; given != nullptr && c < p.num_cones; ++c) {
    const sy_cone& cone = p.cones[c];
    FactsOf(cone.kind).into_dual(at, cone.dim, cone.parameter);
    if (!std::all_of(at, at + cone.dim, [](double v) { return std::isfinite(v); })) {
      std::fill(at, at + cone.dim, 0.0);
    }
    at += cone.dim;
  }
  for (std::int32_t i = 0; p.g != nullptr && i < p.num_cone_rows; ++i) {
    terms.Add(-dual[static_cast<std::size_t>(i)] * p.g[i]);
  }
  return dual;
}

/// Offset - 1/2 x'Px to the terms. P x, or nothing where P is diagonal or absent: then each column
/// has its own.
inline std::vector<ErrorFreeSum> AddObjective(const sy_problem& p, const double* x, Terms& terms) {
  terms.Add(p.offset);
  bool diagonal = true;
  for (std::int32_t j = 0; p.P != nullptr && j < p.num_vars && diagonal; ++j) {
    const std::int32_t first = p.P->start[j];
    const std::int32_t count = p.P->start[j + 1] - first;
    diagonal = count == 0 || (count == 1 && p.P->row[first] == j);
  }
  std::vector<ErrorFreeSum> product(diagonal ? 0 : static_cast<std::size_t>(p.num_vars));
  for (std::int32_t j = 0; p.P != nullptr && j < p.num_vars; ++j) {
    for (std::int32_t k = p.P->start[j]; k < p.P->start[j + 1]; ++k) {
      const std::int32_t i = p.P->row[k];
      const double value = p.P->value[k];
      terms.Add((i == j ? -0.5 : -1.0) * value * x[i] * x[j]);
      if (diagonal) continue;
      if (x[j] != 0) product[static_cast<std::size_t>(i)].AddProduct(value, x[j]);
      if (i != j && x[i] != 0) product[static_cast<std::size_t>(j)].AddProduct(value, x[i]);
    }
  }
  return product;
}

/// sum += sign M_j'v, column j of M.
inline void AddColumn(const sy_csc* m, std::int32_t j, double sign, const double* v,
                      ErrorFreeSum& sum) {
  for (std::int32_t k = m->start[j]; k < m->start[j + 1]; ++k) {
    const double d = v[m->row[k]];
    if (d != 0) sum.AddProduct(sign * m->value[k], d);
  }
}

/// How far rho reaches to the sign that an infinite side does not bear; 0 where it does not.
inline double OpenSize(const Interval& rho, double lower, double upper) {
  double open = 0;
  if (!(rho.lower >= 0) && upper == kInfinity) open = std::max(open, -rho.lower);
  if (!(rho.upper <= 0) && lower == -kInfinity) open = std::max(open, rho.upper);
  return open;
}

/// min r x over r in rho and x in [lower, upper], where no infinite side is open.
inline double LeastProduct(const Interval& rho, double lower, double upper) {
  double least = kInfinity;
  for (const double side : {lower, upper}) {
    if (std::isfinite(side)) least = std::min({least, rho.lower * side, rho.upper * side});
  }
  return std::isfinite(least) ? least : (rho.lower == 0 && rho.upper == 0 ? 0 : -kInfinity);
}

/// The terms of the bound that are of no column, and for each column the interval of its rho and
/// the largest of the terms that it is a sum of: visit(j, rho, largest).
template <class Visit>
void EachColumn(const sy_problem& problem, const std::vector<double>& point, const double* row_dual,
                const double* cone_dual, Terms& terms, Visit&& visit) {
  const std::vector<ErrorFreeSum> curved = AddObjective(problem, point.data(), terms);
  const std::vector<double> y = UsableRowDual(problem, row_dual, terms);
  const std::vector<double> z = UsableConeDual(problem, cone_dual, terms);
  for (std::int32_t j = 0; j < problem.num_vars; ++j) {
    ErrorFreeSum sum = curved.empty() ? ErrorFreeSum() : curved[static_cast<std::size_t>(j)];
    if (problem.q != nullptr) sum.Add(problem.q[j]);
    if (problem.P != nullptr && curved.empty()) AddColumn(problem.P, j, 1, point.data(), sum);
    if (problem.A != nullptr) AddColumn(problem.A, j, -1, y.data(), sum);
    if (problem.F != nullptr) AddColumn(problem.F, j, -1, z.data(), sum);
    visit(j, sum.Enclosure(), sum.largest_term());
  }
}

}  // namespace safe_bound_detail

/// A bound on the optimum of a convex problem without nlp, at any x and any duals, in time linear
/// in the nonzeros. With l the row duals without their part against infinite sides, z the cone
/// duals moved into the dual cone, and rho = P x + q - A'l - F'z,
///
///   offset - 1/2 x'Px + sum(l+ r_l - l- r_u) - z'g + sum_j min(rho_j lower_j, rho_j upper_j)
///
/// less the rounding of N terms, 4 N 2^-53 sum |terms|. For 1/2 y'Py >= x'Py - 1/2 x'Px at every y
/// as P >= 0, which is the caller's to know. rho_j is an interval that holds the true one, a point
/// where nothing rounded, so columns that cancel exactly (epigraph variables) may be free. Where
/// rho_j has the wrong sign against an infinite side, nothing is proven: see SafeBound. Unless
/// `curvature` has a d_j > 0, P - diag(d) >= 0 (see Curvature): then 1/2 d_j (y_j - x_j)^2 is left
/// of 1/2 y'Py, so that the column's term is at least rho_j x_j - rho_j^2 / (2 d_j).
///
/// A pointer may be NULL: zeros for x and duals, the problem's bounds for the boxes. Boxes must
/// hold every feasible point, or an optimal one; where they come from a cutoff, min(cutoff, value)
/// is the bound.
inline SafeBound SafeDualBound(const sy_problem& problem, const double* x, const double* row_dual,
                               const double* cone_dual, const double* box_lower,
                               const double* box_upper, const double* curvature = nullptr) {
  using namespace safe_bound_detail;
  if (problem.nlp != nullptr) return {-kInfinity, -kInfinity, -1, 0};
  Terms terms;
  const std::vector<double> point = FiniteOrZero(x, problem.num_vars);
  const double* lower = box_lower != nullptr ? box_lower : problem.x_lower;
  const double* upper = box_upper != nullptr ? box_upper : problem.x_upper;
  SafeBound bound{0, 0, -1, 0};
  const auto add = [&](std::int32_t j, const Interval& rho, double largest_term) {
    const double l = lower != nullptr ? lower[j] : -kInfinity;
    const double u = upper != nullptr ? upper[j] : kInfinity;
    const double open = OpenSize(rho, l, u);
    if (open == 0) return terms.Add(LeastProduct(rho, l, u));
    if (curvature != nullptr && curvature[j] > 0 && std::isfinite(open)) {
      const double at = point[static_cast<std::size_t>(j)];
      const double largest = std::max(std::abs(rho.lower), std::abs(rho.upper));
      terms.Add(std::min(rho.lower * at, rho.upper * at));
      return terms.Add(-largest * largest / (2 * curvature[j]));
    }
    const double size = 1 + (problem.q != nullptr ? std::abs(problem.q[j]) : 0);
    const double residual = open / (size + largest_term);
    if (bound.open_column < 0 || !(residual <= bound.open_residual)) {
      bound.open_column = j;
      bound.open_residual = residual;
    }
  };
  EachColumn(problem, point, row_dual, cone_dual, terms, add);
  bound.estimate = terms.LowerEnd();
  bound.value = bound.open_column < 0 ? bound.estimate : -kInfinity;
  return bound;
}

}  // namespace switchyard
