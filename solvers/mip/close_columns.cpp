#include "solvers/mip/close_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "switchyard/problem.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr int kPasses = 8;
constexpr double kMore = 1.01;  // of what is missing
constexpr double kFar = 1e-6;   // relative: more is no matter of rounding

class Closing {
 public:
  Closing(const sy_problem& p, const std::vector<double>& lower, const std::vector<double>& upper,
          rounding::Duals& duals)
      : p_(p), lower_(lower), upper_(upper), duals_(duals) {
    open_in_row_.assign(At(p.num_rows), 0);
    for (std::int32_t j = 0; p.A != nullptr && j < p.num_vars; ++j) {
      if (std::isfinite(lower[At(j)]) && std::isfinite(upper[At(j)])) continue;
      for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
        ++open_in_row_[At(p.A->row[k])];
      }
    }
    MarkHeads();
    PinFreeColumns();
  }

  /// Is a column left that could be closed?
  bool Pass() {
    using namespace safe_bound_detail;
    bool any = false;
    Terms terms;
    const std::vector<double> zero(lower_.size(), 0.0);
    const std::vector<double> row = duals_.row, cone = duals_.cone;
    EachColumn(p_, zero, row.data(), cone.data(), terms,
               [&](std::int32_t j, const Interval& rho, double largest) {
                 const double open = OpenSize(rho, lower_[At(j)], upper_[At(j)]);
                 if (open == 0 || open > kFar * (1 + largest)) return;
                 const bool up = upper_[At(j)] == kInfinity;  // rho is to be at least 0
                 if (up && lower_[At(j)] == -kInfinity) return;
                 any = Move(j, (up ? 1 : -1) * open * kMore + (up ? 1 : -1) * kLeast) || any;
               });
    return any;
  }

 private:
  static constexpr double kLeast = 1e-300;

  // Where a dual that grows stays in the dual cone, whatever it is.
  void MarkHeads() {
    grows_.assign(At(p_.num_cone_rows), 0);
    std::int32_t first = 0;
    for (std::int32_t c = 0; c < p_.num_cones; ++c) {
      const sy_cone& cone = p_.cones[c];
      const bool all = cone.kind == SY_CONE_NONNEGATIVE || cone.kind == SY_CONE_ZERO;
      const std::int32_t heads = all                                 ? cone.dim
                                 : cone.kind == SY_CONE_SECOND_ORDER ? 1
                                 : cone.kind == SY_CONE_ROTATED      ? 2
                                                                     : 0;
      for (std::int32_t i = 0; i < heads; ++i) grows_[At(first + i)] = 1;
      first += cone.dim;
    }
  }

  /// Raises rho_j by `amount`. First one-sided rows give what they have, down to 0, which leaves
  /// them as good as any; then the row with the fewest open columns that bears it, or a head. Was
  /// anything moved?
  bool Move(std::int32_t j, double amount) {
    const bool any = TakeFromRows(j, amount);
    if (amount == 0) return true;
    std::int32_t best = -1, fewest = std::numeric_limits<std::int32_t>::max();
    double step = 0;
    for (std::int32_t k = Begin(p_.A, j); k < End(p_.A, j); ++k) {
      const std::int32_t i = p_.A->row[k];
      const double by = -amount / p_.A->value[k];
      if (pinned_[At(i)] != 0 || !HasRoom(i, by) || open_in_row_[At(i)] >= fewest) continue;
      fewest = open_in_row_[At(i)];
      best = i;
      step = by;
    }
    for (std::int32_t k = Begin(p_.F, j); k < End(p_.F, j) && fewest > 1; ++k) {
      const std::int32_t i = p_.F->row[k];
      const double by = -amount / p_.F->value[k];
      if (grows_[At(i)] != 0 && by > 0) return Add(duals_.cone[At(i)], by);
    }
    return best >= 0 ? Add(duals_.row[At(best)], step) : any;
  }

  bool TakeFromRows(std::int32_t j, double& amount) {
    bool any = false;
    for (std::int32_t k = Begin(p_.A, j); k < End(p_.A, j) && amount != 0; ++k) {
      const std::int32_t i = p_.A->row[k];
      double& dual = duals_.row[At(i)];
      const double all = p_.A->value[k] * dual;
      const bool one_sided = !HasRoom(i, -2 * dual);
      if (pinned_[At(i)] != 0 || !one_sided || all == 0 || (all > 0) != (amount > 0)) continue;
      const bool enough = std::abs(all) > std::abs(amount);
      dual = enough ? dual - amount / p_.A->value[k] : 0;
      amount = enough ? 0 : amount - all;
      any = true;
    }
    return any;
  }

  // A free column with one entry has its row's dual: any other is open.
  void PinFreeColumns() {
    pinned_.assign(At(p_.num_rows), 0);
    for (std::int32_t j = 0; p_.A != nullptr && j < p_.num_vars; ++j) {
      if (std::isfinite(lower_[At(j)]) || std::isfinite(upper_[At(j)])) continue;
      for (std::int32_t k = Begin(p_.A, j); k < End(p_.A, j); ++k) pinned_[At(p_.A->row[k])] = 1;
      const bool alone = End(p_.A, j) - Begin(p_.A, j) == 1 && End(p_.F, j) == Begin(p_.F, j);
      if (!alone) continue;
      const std::int32_t k = Begin(p_.A, j);
      const double q = p_.q != nullptr ? p_.q[j] : 0, dual = q / p_.A->value[k];
      if (dual * p_.A->value[k] == q) duals_.row[At(p_.A->row[k])] = dual;
    }
  }

  static std::int32_t Begin(const sy_csc* m, std::int32_t j) {
    return m != nullptr ? m->start[j] : 0;
  }
  static std::int32_t End(const sy_csc* m, std::int32_t j) {
    return m != nullptr ? m->start[j + 1] : 0;
  }
  static bool Add(double& dual, double by) {
    const double old = dual;
    dual += by;
    if (dual == old) dual = std::nextafter(old, by > 0 ? kInfinity : -kInfinity);
    return true;
  }
  /// Does the dual, moved, stand against a side that is finite?
  [[nodiscard]] bool HasRoom(std::int32_t i, double by) const {
    const double to = duals_.row[At(i)] + by;
    if (to == 0) return true;
    const double* side = to > 0 ? p_.row_lower : p_.row_upper;
    return side != nullptr && std::isfinite(side[i]);
  }

  const sy_problem& p_;
  const std::vector<double>& lower_;
  const std::vector<double>& upper_;
  rounding::Duals& duals_;
  std::vector<std::int32_t> open_in_row_;  // columns that are open to a side
  std::vector<std::uint8_t> grows_;        // of each cone row
  std::vector<std::uint8_t> pinned_;       // rows of a column without ends
};

bool ClosedByPasses(const sy_problem& problem, const std::vector<double>& lower,
                    const std::vector<double>& upper, rounding::Duals& duals) {
  Closing closing(problem, lower, upper, duals);
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!closing.Pass()) return true;
  }
  return false;
}

}  // namespace

// What two columns ask of one row goes to and fro; where its dual is next to nothing, it is
// nothing.
void CloseColumns(const sy_problem& problem, const std::vector<double>& lower,
                  const std::vector<double>& upper, rounding::Duals& duals) {
  constexpr double kNothing = 1e-8;  // of the largest
  rounding::Duals snapped = duals;
  if (ClosedByPasses(problem, lower, upper, duals)) return;
  double largest = 0;
  for (const double y : snapped.row) largest = std::max(largest, std::abs(y));
  for (double& y : snapped.row) {
    if (std::abs(y) <= kNothing * largest) y = 0;
  }
  duals = std::move(snapped);
  ClosedByPasses(problem, lower, upper, duals);
}

}  // namespace switchyard::mip
