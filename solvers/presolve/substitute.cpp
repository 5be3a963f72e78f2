#include <algorithm>
#include <cmath>

#include "solvers/presolve/reductions.hpp"

namespace switchyard::presolve {
namespace {

constexpr std::size_t kLongestEquation = 12;
constexpr std::size_t kMostRows = 30;    // that a column may stand in
constexpr double kLeastPivot = 0.05;     // beside the largest entry of the equation
constexpr std::ptrdiff_t kMostFill = 4;  // entries that one substitution may add

class Substituting {
 public:
  explicit Substituting(Draft& draft) : d_(draft) {}

  int Run() {
    for (Index i = 0; i < d_.num_rows(); ++i) {
      if (d_.row_alive[i] == 0 || d_.row_lower[i] != d_.row_upper[i]) continue;
      if (d_.rows.Row(i).size() <= kLongestEquation) TryRow(i);
    }
    return removed_;
  }

 private:
  void TryRow(Index i) {
    equation_.clear();
    double largest = 0;
    d_.EachIn(i, [&](const Entry& e) {
      equation_.push_back(e);
      largest = std::max(largest, std::abs(e.value));
    });
    if (equation_.size() < 2) return;
    // The column in the fewest rows.
    Entry pivot{-1, 0};
    for (const Entry& e : equation_) {
      const Index j = e.column;
      if (!d_.IsFree(j) || d_.curved[j] != 0 || std::abs(e.value) < kLeastPivot * largest) continue;
      d_.Column(j, column_);
      if (pivot.column >= 0 && column_.size() >= pivot_column_.size()) continue;
      pivot = e;
      pivot_column_.swap(column_);
    }
    if (pivot.column < 0 || pivot_column_.size() > kMostRows || !StandTogether()) return;
    if (FillOf(pivot.column, pivot_column_, i) <= kMostFill) Substitute(i, pivot, pivot_column_);
  }

  /// Do all columns of the equation meet a common one in inequalities and cones? Else it joins what
  /// is otherwise apart, and is better left to the factorization.
  [[nodiscard]] bool StandTogether() {
    met_.resize(d_.q.size(), 0);
    touched_.clear();
    Index common = 0;
    for (const Entry& of : equation_) {
      const Index before = common++;
      const auto meet = [&](const Entry& e) {
        if (met_[e.column] != before) return;
        if (before == 0) touched_.push_back(e.column);
        met_[e.column] = common;
      };
      d_.Column(of.column, column_);
      for (const Entry& at : column_) {
        if (at.column < 0) {
          for (const Entry& e : d_.cone_rows.Row(~at.column)) meet(e);
        } else if (d_.row_lower[at.column] != d_.row_upper[at.column]) {
          d_.EachIn(at.column, meet);
        }
      }
    }
    bool together = false;
    for (const Index k : touched_) {
      together = together || met_[k] == common;
      met_[k] = 0;
    }
    return together;
  }

  /// Entries that come less those that go.
  [[nodiscard]] std::ptrdiff_t FillOf(Index j, const std::vector<Entry>& column, Index equation) {
    auto fill = -static_cast<std::ptrdiff_t>(equation_.size());
    for (const Entry& at : column) {
      if (at.column == equation) continue;
      --fill;
      const std::span<const Entry> row =
          at.column >= 0 ? d_.rows.Row(at.column) : d_.cone_rows.Row(~at.column);
      auto place = row.begin();
      for (const Entry& e : equation_) {
        if (e.column == j) continue;
        place = std::lower_bound(place, row.end(), e.column,
                                 [](const Entry& a, Index wanted) { return a.column < wanted; });
        if (place == row.end() || place->column != e.column) ++fill;
      }
    }
    return fill;
  }

  // x_j = (side - others) / pivot in every other row and in the objective.
  void Substitute(Index i, const Entry& pivot, std::vector<Entry>& column) {
    const Index j = pivot.column;
    const double side = d_.row_lower[i];
    std::vector<Entry> others;
    for (const Entry& e : equation_) {
      if (e.column != j) others.push_back(e);
    }
    std::erase_if(column, [&](const Entry& at) { return at.column == i; });
    d_.undo.Add(FreeColumn{
        i, pivot.value, side, side, d_.undo.Keep(others), {j, d_.q[j], d_.undo.Keep(column)}});
    d_.column_alive[j] = 0;
    d_.DropRow(i);
    for (const Entry& at : column) {
      const double factor = at.value / pivot.value;
      d_.SubtractFrom(at.column, factor, others, j);
      d_.TakeConstant(at.column, factor * side);
    }
    const double factor = d_.q[j] / pivot.value;
    for (const Entry& e : others) d_.ReduceCost(e.column, factor * e.value);
    d_.offset += factor * side;
    ++removed_;
  }

  Draft& d_;
  std::vector<Entry> equation_, column_, pivot_column_;
  std::vector<Index> touched_;
  std::vector<Index> met_;  // how many of the equation's columns meet each column; 0 between rows
  int removed_ = 0;
};

}  // namespace

int SubstituteFreeColumns(Draft& draft) {
  const Limits& l = draft.limits;
  return l.bounds_stay && l.values_stay && l.vectors_stay ? Substituting(draft).Run() : 0;
}

}  // namespace switchyard::presolve
