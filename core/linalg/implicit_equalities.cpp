#include "core/linalg/implicit_equalities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace switchyard {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// The rows of the homogenized program are exact to a part in 1e9 of tau: a w of 1 stands out.
constexpr double kLargestTau = 1e6;

/// a'x <= b, a of largest entry 1.
struct Inequality {
  std::vector<double> a;
  double b;
  int row;
  double side;  // as given
};

struct Inequalities {
  std::vector<Inequality> strict;  // that may be
  std::vector<Inequality> equal;   // two sides that agree
  double size = 0;
};

Inequalities Collect(const DenseLp& lp) {
  Inequalities all;
  const std::size_t n = lp.c.size();
  const auto put = [&](std::vector<double> a, double sign, double side, int row, bool equal) {
    double largest = 0;
    for (const double entry : a) largest = std::max(largest, std::abs(entry));
    const double scale = largest > 0 ? sign / largest : sign;
    for (double& entry : a) entry *= scale;
    if (largest > 0) all.size = std::max(all.size, std::abs(scale * side));
    (equal ? all.equal : all.strict).push_back({std::move(a), scale * side, row, side});
  };
  const auto both = [&](const std::vector<double>& a, double lower, double upper, int row) {
    if (lower == upper) return put(a, 1, lower, row, true);
    if (std::isfinite(lower)) put(a, -1, lower, row, false);
    if (std::isfinite(upper)) put(a, 1, upper, row, false);
  };
  for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
    both({lp.row(i), lp.row(i) + n}, lp.row_lower[i], lp.row_upper[i], static_cast<int>(i));
  }
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> unit(n, 0);
    unit[j] = 1;
    both(unit, lp.x_lower[j], lp.x_upper[j], lp.num_rows() + static_cast<int>(j));
  }
  if (all.size == 0) all.size = 1;
  return all;
}

/// Over (x, tau, w), one w for all inequalities or one for each.
DenseLp Homogenized(const Inequalities& all, std::size_t n, bool one_w) {
  const std::size_t num_w = one_w ? 1 : all.strict.size();
  DenseLp lp(static_cast<int>(n + 1 + num_w));
  lp.x_lower[n] = 1;
  lp.x_upper[n] = kLargestTau;
  for (std::size_t k = n + 1; k < lp.c.size(); ++k) {
    lp.c[k] = -1;
    lp.x_lower[k] = 0;
    lp.x_upper[k] = 1;
  }
  const auto add = [&](const Inequality& row, double lower) {
    double* a = lp.AddRow(lower, 0);
    std::copy(row.a.begin(), row.a.end(), a);
    a[n] = -row.b;
    return a;
  };
  for (const Inequality& row : all.equal) add(row, 0);
  for (std::size_t i = 0; i < all.strict.size(); ++i) {
    add(all.strict[i], -kInfinite)[n + 1 + (one_w ? 0 : i)] = all.size;
  }
  return lp;
}

}  // namespace

ImplicitEqualities FindImplicitEqualities(const DenseLp& lp) {
  const std::size_t n = lp.c.size();
  const Inequalities all = Collect(lp);
  DenseSimplex simplex;
  ImplicitEqualities found;
  const auto is_strict = [](double w) { return w > 0.5; };
  // Most often one w for all is 1 already: then so is each of many.
  const DenseLpAnswer* answer = &simplex.Solve(Homogenized(all, n, true));
  const bool one = answer->status == DenseLpStatus::kOptimal && is_strict(answer->x[n + 1]);
  if (!one) answer = &simplex.Solve(Homogenized(all, n, false));
  found.status = answer->status;
  if (found.status != DenseLpStatus::kOptimal) return found;
  for (const Inequality& row : all.equal) found.equalities.push_back({row.row, row.side});
  for (std::size_t i = 0; i < all.strict.size() && !one; ++i) {
    if (is_strict(answer->x[n + 1 + i])) continue;
    found.equalities.push_back({all.strict[i].row, all.strict[i].side});
  }
  const auto by_row = [](const auto& a, const auto& b) { return a.row < b.row; };
  std::stable_sort(found.equalities.begin(), found.equalities.end(), by_row);
  for (std::size_t j = 0; j < n; ++j) found.x.push_back(answer->x[j] / answer->x[n]);
  return found;
}

}  // namespace switchyard
