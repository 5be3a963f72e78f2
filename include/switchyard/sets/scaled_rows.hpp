// switchyard/sets/scaled_rows.hpp - a scaled form written row by row: all that a class of sets has
// to say of itself.
#pragma once

#include <utility>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// Collects rows and cones over (t, x, w); columns are 0 for t, 1 + i for x_i, then w.
///
/// The disc {x : |x|_2 <= r} in R^2, |x|_2 <= r t:
///   ScaledRows rows(2);
///   const int first = rows.AddCone({SY_CONE_SECOND_ORDER, 3, 0});
///   rows.SetCone(first, 0, r);
///   for (int i = 0; i < 2; ++i) rows.SetCone(first + 1 + i, 1 + i, 1);
///   return rows.Finish();
class SWITCHYARD_EXPORT ScaledRows {
 public:
  explicit ScaledRows(int dim, int num_aux = 0) : dim_(dim), num_aux_(num_aux) {}

  /// More variables w of the set's own, free; returns the first one's column.
  int AddAux(int count) {
    num_aux_ += count;
    return 1 + dim_ + num_aux_ - count;
  }
  /// sum entries >= 0, or <= 0, or = 0, as the sides say; returns the row.
  int AddRow(double lower, double upper) {
    lower_.push_back(lower);
    upper_.push_back(upper);
    return static_cast<int>(lower_.size()) - 1;
  }
  void Set(int row, int column, double value) {
    if (value != 0) A_.push_back({row, column, value});
  }
  /// lower t <= a'x <= upper t for the row that `write` writes: one row where the sides are equal
  /// or one is infinite, two where both are finite and differ, none where both are infinite.
  template <class Write>
  void AddTwoSided(double lower, double upper, Write&& write) {
    const auto side = [&](double bound, double low, double high) {
      const int row = AddRow(low, high);
      write(row);
      Set(row, 0, -bound);
    };
    if (lower == upper) {
      side(lower, 0, 0);
      return;
    }
    if (lower > -kInfinity) side(lower, 0, kInfinity);
    if (upper < kInfinity) side(upper, -kInfinity, 0);
  }
  /// Returns the cone's first row.
  int AddCone(const sy_cone& cone) {
    cones_.push_back(cone);
    cone_rows_ += cone.dim;
    return cone_rows_ - cone.dim;
  }
  void SetCone(int row, int column, double value) {
    if (value != 0) F_.push_back({row, column, value});
  }

  /// sum_k value_k (column_k).
  using Combination = std::vector<std::pair<int, double>>;
  /// The rows and cones of another set with its t, x_0, x_1, ... replaced by combinations of
  /// columns of this one; its own variables become new ones here. That its scale is at least 0 is
  /// the caller's to write where it is not t. Returns the first new column.
  int AddSet(const ScaledSet& set, const std::vector<Combination>& columns);
  /// The same for a set of the same points: t and x stay what they are.
  int AddSet(const ScaledSet& set);

  [[nodiscard]] ScaledSet Finish() const;

 private:
  struct Entry {
    int row;
    int column;
    double value;
  };
  int dim_;
  int num_aux_;
  int cone_rows_ = 0;
  std::vector<Entry> A_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  std::vector<Entry> F_;
  std::vector<sy_cone> cones_;
};

}  // namespace switchyard
