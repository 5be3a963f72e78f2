#include "core/linalg/dense_lp_certificate.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard {
namespace {

// Of a sum of as many terms as these programs have, what rounding can leave.
constexpr double kRounding = 1e-11;

/// A sum, and that of the sizes of its terms.
struct Sum {
  double value = 0;
  double size = 0;
  void Add(double term) {
    value += term;
    size += std::abs(term);
  }
};

Sum RowTimes(const DenseLp& lp, std::size_t i, const std::vector<double>& x) {
  Sum sum;
  const double* a = lp.row(i);
  for (std::size_t j = 0; j < x.size(); ++j) sum.Add(a[j] * x[j]);
  return sum;
}

bool Within(double lower, const Sum& value, double upper) {
  const double below = lower - value.value;
  const double above = value.value - upper;
  return !(below > kDenseLpTolerance * (value.size + std::abs(lower))) &&
         !(above > kDenseLpTolerance * (value.size + std::abs(upper))) &&
         std::isfinite(value.value);
}

/// Adds the side that a multiplier points to; false where that is infinite.
bool AddSide(Sum& sum, double multiplier, double lower, double upper) {
  if (multiplier == 0) return true;
  const double side = multiplier > 0 ? lower : upper;
  if (!std::isfinite(side) || !std::isfinite(multiplier)) return false;
  sum.Add(multiplier * side);
  return true;
}

bool AddSides(Sum& sum, const DenseLp& lp, const DenseLpAnswer& answer) {
  for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
    if (!AddSide(sum, answer.row_dual[i], lp.row_lower[i], lp.row_upper[i])) return false;
  }
  for (std::size_t j = 0; j < lp.c.size(); ++j) {
    if (!AddSide(sum, answer.x_dual[j], lp.x_lower[j], lp.x_upper[j])) return false;
  }
  return true;
}

/// Is A'y + z = share c, column by column?
bool ColumnsAddUp(const DenseLp& lp, const DenseLpAnswer& answer, double share, double tolerance) {
  for (std::size_t j = 0; j < lp.c.size(); ++j) {
    Sum column;
    column.Add(answer.x_dual[j]);
    column.Add(-share * lp.c[j]);
    for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
      if (answer.row_dual[i] != 0) column.Add(lp.row(i)[j] * answer.row_dual[i]);
    }
    if (!(std::abs(column.value) <= tolerance * column.size)) return false;
  }
  return true;
}

/// Does a direction stay inside a row's finite sides?
bool Recedes(double lower, const Sum& along, double upper) {
  const double slack = kDenseLpTolerance * along.size;
  return (!std::isfinite(lower) || along.value >= -slack) &&
         (!std::isfinite(upper) || along.value <= slack);
}

}  // namespace

bool IsFeasible(const DenseLp& lp, const std::vector<double>& x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (!Within(lp.x_lower[j], {x[j], std::abs(x[j])}, lp.x_upper[j])) return false;
  }
  for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
    if (!Within(lp.row_lower[i], RowTimes(lp, i, x), lp.row_upper[i])) return false;
  }
  return true;
}

bool CertifiesOptimum(const DenseLp& lp, const DenseLpAnswer& answer) {
  if (!IsFeasible(lp, answer.x)) return false;
  if (!ColumnsAddUp(lp, answer, 1, kDenseLpTolerance)) return false;
  Sum gap;
  for (std::size_t j = 0; j < lp.c.size(); ++j) gap.Add(-lp.c[j] * answer.x[j]);
  if (!AddSides(gap, lp, answer)) return false;
  return std::abs(gap.value) <= kDenseLpTolerance * gap.size;
}

bool CertifiesInfeasibility(const DenseLp& lp, const DenseLpAnswer& answer) {
  Sum sides;
  return ColumnsAddUp(lp, answer, 0, kRounding) && AddSides(sides, lp, answer) &&
         sides.value > kRounding * sides.size;
}

bool CertifiesUnboundedness(const DenseLp& lp, const DenseLpAnswer& answer) {
  const std::vector<double>& d = answer.ray;
  Sum cost;
  for (std::size_t j = 0; j < d.size(); ++j) {
    cost.Add(lp.c[j] * d[j]);
    if (!Recedes(lp.x_lower[j], {d[j], 0}, lp.x_upper[j])) return false;
  }
  for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
    if (!Recedes(lp.row_lower[i], RowTimes(lp, i, d), lp.row_upper[i])) return false;
  }
  return cost.value < -kDenseLpTolerance * cost.size && IsFeasible(lp, answer.x);
}

}  // namespace switchyard
