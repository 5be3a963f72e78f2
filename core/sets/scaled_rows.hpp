// core/sets/scaled_rows.hpp - a scaled form written row by row.
#pragma once

#include "core/problem/builder.hpp"
#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// Collects rows and cones over (t, x, w); columns are 0 for t, 1 + i for x_i, then w.
class ScaledRows {
 public:
  explicit ScaledRows(int dim, int num_aux = 0) : dim_(dim), num_aux_(num_aux) {}

  /// sum entries >= 0, or <= 0, or = 0, as the sides say; returns the row.
  int AddRow(double lower, double upper) {
    lower_.push_back(lower);
    upper_.push_back(upper);
    return static_cast<int>(lower_.size()) - 1;
  }
  void Set(int row, int column, double value) {
    if (value != 0) A_.Add(row, column, value);
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
    if (value != 0) F_.Add(row, column, value);
  }

  [[nodiscard]] ScaledSet Finish() {
    const int columns = 1 + dim_ + num_aux_;
    return {dim_,   num_aux_, A_.Seal(static_cast<std::int32_t>(lower_.size()), columns),
            lower_, upper_,   F_.Seal(cone_rows_, columns),
            cones_};
  }

 private:
  int dim_;
  int num_aux_;
  int cone_rows_ = 0;
  TripletMatrix A_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  TripletMatrix F_;
  std::vector<sy_cone> cones_;
};

}  // namespace switchyard
