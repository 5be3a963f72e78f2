#include <algorithm>
#include <cmath>

#include "solvers/presolve/reductions.hpp"

namespace switchyard::presolve {
namespace {

class Columns {
 public:
  explicit Columns(Draft& draft) : d_(draft) {}

  int Reduce() {
    for (Index j = 0; j < d_.num_columns(); ++j) {
      if (d_.column_alive[j] == 0) continue;
      if (d_.lower[j] == d_.upper[j]) {
        d_.Fix(j, d_.lower[j]);
        ++removed_;
      } else if (d_.curved[j] == 0 && d_.limits.vectors_stay) {
        Flat(j);
      }
    }
    return removed_;
  }

 private:
  // What the objective does not bend, where it stands in no row or in one.
  void Flat(Index j) {
    Entry entry{};
    const int entries = d_.FewEntries(j, entry);
    if (entries == 0) return Lonely(j);
    if (entries == 1 && entry.column >= 0) Singleton(j, entry);
  }

  // It goes where its cost sends it; what has no end there is the solver's to find unbounded.
  void Lonely(Index j) {
    const double end = d_.q[j] + d_.p_shift[j] > 0   ? d_.lower[j]
                       : d_.q[j] + d_.p_shift[j] < 0 ? d_.upper[j]
                                                     : std::clamp(0.0, d_.lower[j], d_.upper[j]);
    if (!std::isfinite(end)) return;
    d_.Fix(j, end);
    ++removed_;
  }

  void Singleton(Index j, const Entry& at) {
    const Index i = at.column;
    // Small beside its row, it would be had by a division that magnifies.
    double largest = 0;
    d_.EachIn(i, [&](const Entry& e) { largest = std::max(largest, std::abs(e.value)); });
    if (std::abs(at.value) < 1e-3 * largest || !IsImpliedFree(j, at)) return;
    const double cost = d_.q[j];
    const double multiplier = cost / at.value;
    double lower = d_.row_lower[i], upper = d_.row_upper[i];
    if (multiplier > 0) upper = lower;  // the row is tight where its multiplier says
    if (multiplier < 0) lower = upper;
    if (multiplier != 0 && !std::isfinite(lower)) return;  // unbounded, or so it seems
    std::vector<Entry> others;
    d_.EachIn(i, [&](const Entry& e) {
      if (e.column != j) others.push_back(e);
    });
    d_.undo.Add(FreeColumn{i, at.value, lower, upper, d_.undo.Keep(others), {j, cost, {}}});
    d_.column_alive[j] = 0;
    d_.DropRow(i);
    for (const Entry& e : others) d_.ReduceCost(e.column, multiplier * e.value);
    if (multiplier != 0) d_.offset += multiplier * lower;
    ++removed_;
  }

  /// Does the row keep the column within its bounds, whatever the others are?
  [[nodiscard]] bool IsImpliedFree(Index j, const Entry& at) const {
    if (d_.IsFree(j)) return true;
    double least = 0, most = 0;  // of the others
    d_.EachIn(at.column, [&](const Entry& e) {
      if (e.column == j) return;
      least += e.value * (e.value > 0 ? d_.lower[e.column] : d_.upper[e.column]);
      most += e.value * (e.value > 0 ? d_.upper[e.column] : d_.lower[e.column]);
    });
    double low = (d_.row_lower[at.column] - most) / at.value;
    double high = (d_.row_upper[at.column] - least) / at.value;
    if (at.value < 0) std::swap(low, high);
    // An inequality's free column may be at either side of the row or between: both must do.
    if (d_.row_lower[at.column] != d_.row_upper[at.column]) return false;
    return low >= d_.lower[j] && high <= d_.upper[j];
  }

  Draft& d_;
  int removed_ = 0;
};

}  // namespace

int ReduceColumns(Draft& draft) {
  return draft.limits.bounds_stay && draft.limits.values_stay ? Columns(draft).Reduce() : 0;
}

}  // namespace switchyard::presolve
