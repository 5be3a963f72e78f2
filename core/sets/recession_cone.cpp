// Cones of which an entry is 0 for all (0, x, w). With s the entries:
//   second order   s_0 = 0: all others are 0
//   rotated        s_0 or s_1 = 0: s_2, s_3, ... are 0, the other of the two is at least 0
//   exponential    s_1 = 0: s_0 <= 0 <= s_2;   s_2 = 0: s_1 = 0 as well
//   power          s_0 or s_1 = 0: s_2 = 0, the other at least 0
//   semidefinite   a diagonal entry 0: its row is 0, the rest is semidefinite
#include "core/sets/recession_cone.hpp"

#include <cmath>
#include <vector>

#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

class AtScaleZero {
 public:
  explicit AtScaleZero(const ScaledSet& set)
      : set_(set), by_rows_(Transpose(set.F.View())), rows_(set.dim, set.num_aux) {}

  ScaledSet Write() {
    WriteRows();
    int first = 0;
    for (const sy_cone& cone : set_.cones) {
      WriteCone(cone, first);
      first += cone.dim;
    }
    return rows_.Finish();
  }

 private:
  template <class Put>
  static void ForEntries(const Csc& by_rows, int row, Put&& put) {
    for (auto k = by_rows.start[static_cast<std::size_t>(row)];
         k < by_rows.start[static_cast<std::size_t>(row) + 1]; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (by_rows.row[at] > 0) put(by_rows.row[at], by_rows.value[at]);
    }
  }
  [[nodiscard]] bool IsZero(int row) const {
    bool zero = true;
    ForEntries(by_rows_, row, [&zero](int, double value) { zero = zero && value == 0; });
    return zero;
  }
  void AddRow(int cone_row, double lower, double upper) {
    const int row = rows_.AddRow(lower, upper);
    ForEntries(by_rows_, cone_row, [&](int column, double v) { rows_.Set(row, column, v); });
  }
  void AddCone(const sy_cone& cone, const std::vector<int>& cone_rows) {
    int row = rows_.AddCone(cone);
    for (const int from : cone_rows) {
      ForEntries(by_rows_, from, [&](int column, double v) { rows_.SetCone(row, column, v); });
      ++row;
    }
  }

  void WriteRows() {
    const Csc by_rows = Transpose(set_.A.View());
    for (std::size_t i = 0; i < set_.lower.size(); ++i) {
      const int row = rows_.AddRow(set_.lower[i], set_.upper[i]);
      ForEntries(by_rows, static_cast<int>(i),
                 [&](int column, double v) { rows_.Set(row, column, v); });
    }
  }

  void WriteCone(const sy_cone& cone, int first) {
    const auto all = [&](int from, double lower, double upper) {
      for (int i = from; i < cone.dim; ++i) AddRow(first + i, lower, upper);
    };
    const bool flat_0 = cone.dim > 0 && IsZero(first);
    const bool flat_1 = cone.dim > 1 && IsZero(first + 1);
    if (cone.kind == SY_CONE_ZERO) return all(0, 0, 0);
    if (cone.kind == SY_CONE_NONNEGATIVE) return all(0, 0, kInfinity);
    if (cone.kind == SY_CONE_SECOND_ORDER && flat_0) return all(1, 0, 0);
    const bool two_heads = cone.kind == SY_CONE_ROTATED || cone.kind == SY_CONE_POWER;
    if (two_heads && (flat_0 || flat_1)) {
      AddRow(first, 0, kInfinity);
      AddRow(first + 1, 0, kInfinity);
      return all(2, 0, 0);
    }
    if (cone.kind == SY_CONE_EXPONENTIAL && (flat_1 || IsZero(first + 2))) {
      AddRow(first, -kInfinity, 0);
      AddRow(first + 1, 0, 0);
      return AddRow(first + 2, 0, kInfinity);
    }
    if (cone.kind == SY_CONE_PSD) return WriteMatrix(cone, first);
    std::vector<int> same;
    for (int i = 0; i < cone.dim; ++i) same.push_back(first + i);
    AddCone(cone, same);
  }

  // Entries of the upper triangle, column by column.
  void WriteMatrix(const sy_cone& cone, int first) {
    const int order = static_cast<int>((std::sqrt(8.0 * cone.dim + 1) - 1) / 2 + 0.5);
    const auto place = [first](int i, int j) { return first + j * (j + 1) / 2 + i; };
    std::vector<int> kept;
    for (int j = 0; j < order; ++j) {
      const bool flat = IsZero(place(j, j));
      for (int i = 0; i < j; ++i) {
        if (flat || IsZero(place(i, i))) AddRow(place(i, j), 0, 0);
      }
      if (flat) continue;
      for (int i = 0; i <= j; ++i) {
        if (!IsZero(place(i, i))) kept.push_back(place(i, j));
      }
    }
    const auto size = static_cast<std::int32_t>(kept.size());
    if (size > 0) AddCone({cone.kind, size, cone.parameter}, kept);
  }

  const ScaledSet& set_;
  Csc by_rows_;
  ScaledRows rows_;
};

}  // namespace

ScaledSet RecessionCone(const ScaledSet& set) { return AtScaleZero(set).Write(); }

}  // namespace switchyard
