#include "core/sets/section_lp.hpp"

#include <algorithm>

namespace switchyard {
namespace {

constexpr int kMostColumns = 300;
constexpr std::int64_t kMostEntries = 1'000'000;

/// A's columns over (x, w), with those behind them zero: each row's entries in place.
void AddRows(const ScaledSet& set, DenseLp& lp) {
  const auto num_rows = static_cast<std::size_t>(set.A.rows);
  for (std::size_t i = 0; i < num_rows; ++i) lp.AddRow(set.lower[i], set.upper[i]);
  const std::size_t width = lp.c.size();
  for (std::int32_t j = 1; j < set.num_columns(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    for (auto k = static_cast<std::size_t>(set.A.start[at]);
         k < static_cast<std::size_t>(set.A.start[at + 1]); ++k) {
      lp.A[static_cast<std::size_t>(set.A.row[k]) * width + at - 1] = set.A.value[k];
    }
  }
}

/// Sides less the row's value at (t, x, 0).
void Shift(const ScaledSet& set, double t, const Eigen::VectorXd& x, DenseLp& lp) {
  for (std::int32_t j = 0; j <= set.dim; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const double value = j == 0 ? t : x[j - 1];
    for (auto k = static_cast<std::size_t>(set.A.start[at]);
         k < static_cast<std::size_t>(set.A.start[at + 1]); ++k) {
      const auto row = static_cast<std::size_t>(set.A.row[k]);
      lp.row_lower[row] -= value * set.A.value[k];
      lp.row_upper[row] -= value * set.A.value[k];
    }
  }
}

std::optional<double> Maximize(DenseLp& lp, const Eigen::VectorXd& direction) {
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    lp.c[static_cast<std::size_t>(i)] = -direction[i];
  }
  DenseSimplex simplex;
  const DenseLpAnswer& answer = simplex.Solve(lp);
  switch (answer.status) {
    case DenseLpStatus::kOptimal:
      return -answer.objective;
    case DenseLpStatus::kInfeasible:
      return -kInfinity;
    case DenseLpStatus::kUnbounded:
      return kInfinity;
    case DenseLpStatus::kUndecided:
      break;
  }
  return std::nullopt;
}

}  // namespace

bool IsSmallPolyhedron(const ScaledSet& set) {
  return set.cones.empty() && set.num_columns() <= kMostColumns &&
         static_cast<std::int64_t>(set.A.rows) * set.num_columns() <= kMostEntries;
}

DenseLp SectionLp(const ScaledSet& set, const Eigen::VectorXd& origin) {
  DenseLp lp(set.num_columns() - 1);
  AddRows(set, lp);
  Shift(set, 1, origin, lp);
  return lp;
}

std::optional<double> SupportByLp(const ScaledSet& set, const Eigen::VectorXd& direction) {
  DenseLp lp = SectionLp(set, Eigen::VectorXd::Zero(set.dim));
  return Maximize(lp, direction);
}

std::optional<double> RecessionByLp(const ScaledSet& cone, const Eigen::VectorXd& direction) {
  DenseLp lp(cone.num_columns() - 1);
  AddRows(cone, lp);
  std::fill_n(lp.x_lower.begin(), cone.dim, -1.0);
  std::fill_n(lp.x_upper.begin(), cone.dim, 1.0);
  return Maximize(lp, direction);
}

std::optional<double> DistanceByLp(const ScaledSet& set, const Eigen::VectorXd& x) {
  DenseLp lp(set.num_columns());  // y - x, w, and the distance
  AddRows(set, lp);
  Shift(set, 1, x, lp);
  const std::size_t distance = lp.c.size() - 1;
  lp.x_lower[distance] = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(set.dim); ++i) {
    for (const double sign : {1.0, -1.0}) {
      double* const row = lp.AddRow(-kInfinity, 0);
      row[i] = sign;
      row[distance] = -1;
    }
  }
  lp.c[distance] = 1;
  DenseSimplex simplex;
  const DenseLpAnswer& answer = simplex.Solve(lp);
  if (answer.status == DenseLpStatus::kInfeasible) return kInfinity;
  if (answer.status != DenseLpStatus::kOptimal) return std::nullopt;
  return answer.x[distance];
}

PointByLp FeasiblePointByLp(const ScaledSet& set) {
  DenseSimplex simplex;
  const DenseLpAnswer& answer = simplex.Solve(SectionLp(set, Eigen::VectorXd::Zero(set.dim)));
  if (answer.status == DenseLpStatus::kInfeasible) return {true, std::nullopt};
  if (answer.status != DenseLpStatus::kOptimal) return {};
  return {true, Eigen::VectorXd::Map(answer.x.data(), set.dim)};
}

}  // namespace switchyard
