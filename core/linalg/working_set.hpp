// core/linalg/working_set.hpp - n rows of [A; I] that hold with equality, and the point where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/linalg/dense_lp.hpp"

namespace switchyard {

/// The side at which a row is held. A free one has no sides and is held where it is.
enum class Side : std::int8_t { kUpper, kFree, kLower, kFixed };

/// The rows G = [A; I] of a program, scaled by powers of two, and n of them, B, with B x = value.
/// All of it is public to the simplex method, which is the only one that knows it.
struct WorkingSet {
  using Index = std::size_t;

  std::size_t n = 0;
  std::size_t m = 0;              // of A; row m + j of G is x_j
  std::vector<double> row_scale;  // m: row i of A is row_scale_i times the given one
  std::vector<double> col_scale;  // n: the given x is col_scale x
  std::vector<double> A;          // m x n by columns
  std::vector<double> lower;      // m + n
  std::vector<double> upper;
  std::vector<double> side_size;  // m + n: of the finite sides, the larger absolute value

  std::vector<Index> working;  // n rows of G
  std::vector<Side> side;      // n
  std::vector<double> value;   // n
  std::vector<std::uint8_t> is_working;
  std::vector<double> inverse;  // of B, by columns: column k raises working row k alone, by 1
  std::vector<double> x;
  std::vector<double> activity;  // G x
  std::vector<double> along;     // G d, see Along
  int exchanges = 0;             // since the inverse was computed

  void Load(const DenseLp& lp);
  /// Holds the bounds of the variables, each at the side that `cost` prefers or else the nearest to
  /// 0, free ones at 0.
  void HoldBounds(const std::vector<double>& cost);

  [[nodiscard]] const double* column(Index k) const { return inverse.data() + k * n; }
  /// Row `row` of G as a combination of the working ones.
  void Combine(Index row, std::vector<double>& alpha) const;
  /// One step of refinement for what Combine gave.
  void Correct(Index row, std::vector<double>& alpha);
  /// along = G d.
  void Along(const double* d);
  /// x moves by `length` along d, whose G d is in `along`.
  void Move(const double* d, double length);
  /// Row `row` takes the place of working row k; alpha is what Combine says of it.
  void Exchange(Index k, Index row, Side at, const std::vector<double>& alpha);
  void Hold(Index k, Side at);
  /// The inverse anew, and x with one step of refinement; false where B is singular.
  bool Factor();
  /// By how much row i of G leaves its sides, at most 0 where it does not.
  [[nodiscard]] double Violation(Index i) const;
  [[nodiscard]] double SizeOfX() const;

 private:
  bool Invert();
  void Place();
  std::vector<double> basis_;  // n x n by columns
  std::vector<double> rest_;
};

}  // namespace switchyard
