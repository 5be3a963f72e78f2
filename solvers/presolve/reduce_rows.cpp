#include <algorithm>
#include <cmath>

#include "solvers/presolve/narrow.hpp"
#include "solvers/presolve/reductions.hpp"

namespace switchyard::presolve {
namespace {

/// What the bounds of its variables say of a row.
struct Activity {
  double least = 0, most = 0;
  double least_size, most_size;  // of their terms, and of what the sides were made of
  int count = 0;
};

class Rows {
 public:
  explicit Rows(Draft& draft) : d_(draft) {}

  int Reduce() {
    for (Index i = 0; i < d_.num_rows() && !d_.contradiction; ++i) {
      if (d_.row_alive[i] != 0) Look(i);
    }
    return removed_;
  }

  int DropEmpty() {
    for (Index i = 0; i < d_.num_rows(); ++i) {
      if (d_.row_alive[i] != 0 && d_.SidesStay(i) && ActivityOf(i).count == 0) Empty(i);
    }
    return removed_;
  }

 private:
  void Look(Index i) {
    if (!d_.SidesStay(i)) return;
    if (HasNoSides(i)) return Drop(i);
    const Activity a = ActivityOf(i);
    if (a.count == 0) return Empty(i);
    if (!d_.limits.values_stay) return;
    if (a.count == 1) return Singleton(i);
    if (a.least > d_.row_upper[i] + kRounding * a.least_size ||
        a.most < d_.row_lower[i] - kRounding * a.most_size) {
      d_.contradiction = true;
      return;
    }
    if (a.least >= d_.row_lower[i]) d_.row_lower[i] = -kInfinity;
    if (a.most <= d_.row_upper[i]) d_.row_upper[i] = kInfinity;
    if (HasNoSides(i)) return Drop(i);
    if (a.least >= d_.row_upper[i]) return Force(i, true);
    if (a.most <= d_.row_lower[i]) return Force(i, false);
  }

  [[nodiscard]] bool HasNoSides(Index i) const {
    return d_.row_lower[i] == -kInfinity && d_.row_upper[i] == kInfinity;
  }

  [[nodiscard]] Activity ActivityOf(Index i) const {
    Activity a;
    a.least_size = a.most_size = d_.row_size[i];
    d_.EachIn(i, [&](const Entry& e) {
      const double low = e.value * (e.value > 0 ? d_.lower[e.column] : d_.upper[e.column]);
      const double high = e.value * (e.value > 0 ? d_.upper[e.column] : d_.lower[e.column]);
      a.least += low;
      a.most += high;
      a.least_size = std::max(a.least_size, std::abs(low));
      a.most_size = std::max(a.most_size, std::abs(high));
      ++a.count;
    });
    return a;
  }

  void Drop(Index i) {
    d_.DropRow(i);
    ++removed_;
  }

  void Empty(Index i) {
    const double side = std::max(d_.row_lower[i], -d_.row_upper[i]);  // > 0: it does not hold
    if (side > kRounding * d_.row_size[i]) d_.contradiction = true;
    Drop(i);
  }

  void Singleton(Index i) {
    Entry e{0, 0};
    d_.EachIn(i, [&](const Entry& only) { e = only; });
    const double one = d_.row_lower[i] / e.value, other = d_.row_upper[i] / e.value;
    const double low = std::min(one, other), high = std::max(one, other);
    const Narrowed moved = Narrow(low, high, d_.lower[e.column], d_.upper[e.column]);
    if (moved.apart) {
      d_.contradiction = true;
      return;
    }
    if (moved.lower || moved.upper) {
      d_.undo.Add(SingletonRow{i, e.column, e.value, moved.lower, moved.upper});
    }
    Drop(i);
  }

  // The row holds only where each term is at its end.
  void Force(Index i, bool at_upper) {
    std::vector<Entry> entries;
    d_.EachIn(i, [&](const Entry& e) { entries.push_back(e); });
    d_.undo.Add(ForcingRow{i, at_upper, d_.undo.Keep(entries)});
    Drop(i);
    for (const Entry& e : entries) {
      const bool at_lower = at_upper == (e.value > 0);
      d_.Fix(e.column, at_lower ? d_.lower[e.column] : d_.upper[e.column]);
    }
  }

  Draft& d_;
  int removed_ = 0;
};

}  // namespace

int ReduceRows(Draft& draft) { return Rows(draft).Reduce(); }

int DropEmptyRows(Draft& draft) { return Rows(draft).DropEmpty(); }

}  // namespace switchyard::presolve
