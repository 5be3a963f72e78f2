// dense_front.hpp - the dense part of a symmetric indefinite factorization: pivots of one front.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::ipopt {

/// How many eigenvalues of a symmetric matrix are below zero, and how many are not told from zero.
struct Inertia {
  std::int32_t negative = 0;
  std::int32_t zero = 0;
};

/// A front gathers all that is known of its first `candidates` columns, of which as many as can be
/// are eliminated as pivots; of the `rows` below it knows a part, and what it leaves for them is
/// for the parent. After Eliminate the pivots come first, in the order they were taken in.
///
/// A pivot is an entry d of the diagonal with u |l| <= |d| for all l of its column, or a block D of
/// two columns with |D^-1| (|l|, |m|)' <= 1 / u for the largest of the other entries of both
/// (Duff and Reid, ACM Trans. Math. Softw. 9, 1983): no entry of L is above 1 / u. A column that
/// cannot be a pivot yet waits for the parent, where more of it is known. By Sylvester's law the
/// signs of the pivots are those of the eigenvalues. An entry of the diagonal that is no larger
/// than the rounding of the terms it is the sum of has no sign, and is no pivot; nor is what is
/// left of a column when that is rounding. Columns are expected to have a largest entry of about 1.
class DenseFront {
 public:
  using Index = linalg::Index;

  /// All entries 0.
  void Reset(Index candidates, Index rows);

  /// Adds to entry (row, column) of the candidates, and below them.
  void Add(Index row, Index column, double value) {
    top_[At(row, column)] += value;
    if (row != column) top_[At(column, row)] += value;
  }
  void AddBelow(Index row, Index column, double value) { below_[BelowAt(row, column)] += value; }

  /// Of the terms that make the entry of the diagonal of a candidate or, behind these, of a row.
  void AddSize(Index k, double size) { size_[k] += size; }

  /// Takes pivots until none is left that is large enough. At a root, `all`: a column that has
  /// nothing left but rounding errors counts as a zero of the inertia; its pivot is infinite.
  void Eliminate(double u, bool all, Inertia& inertia);

  [[nodiscard]] Index candidates() const { return candidates_; }
  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Index pivots() const { return pivots_; }
  /// Which candidate stands k-th now.
  [[nodiscard]] Index candidate(Index k) const { return order_[k]; }

  /// Of the candidates that were no pivots, what is left of entry (i, j) or of that below them.
  [[nodiscard]] double Left(Index i, Index j) const { return top_[At(i, j)]; }
  [[nodiscard]] double LeftBelow(Index i, Index j) const { return below_[BelowAt(i, j)]; }
  /// See AddSize.
  [[nodiscard]] double size(Index k) const { return size_[k]; }
  /// c -= L D L' for the lower triangle of the rows; c by columns, RoundUp(rows) apart.
  void SubtractFrom(double* c, linalg::Vector& work) const;

  // Of a right side x: the candidates in their order now stand at the front, the rows from
  // RoundUp(candidates()) on, with zeros up to a multiple of kLanes behind each; on a cache line.
  /// x <- L^-1 x.
  void Forward(double* x) const;
  /// Of the pivots, x <- L^-T D^-1 x.
  void Backward(double* x) const;

 private:
  /// The largest entries of a column beside its diagonal and `skip`: of all, and of the candidates.
  struct Largest {
    double all = 0;
    double candidate = 0;
    Index row = -1;  // of the latter
  };

  /// A column, in both parts.
  struct Column {
    double* top;
    double* below;
  };

  [[nodiscard]] std::size_t At(Index i, Index j) const {
    return static_cast<std::size_t>(j) * top_stride_ + static_cast<std::size_t>(i);
  }
  [[nodiscard]] std::size_t BelowAt(Index i, Index j) const {
    return static_cast<std::size_t>(j) * below_stride_ + static_cast<std::size_t>(i);
  }
  [[nodiscard]] Largest LargestOf(Index column, Index skip) const;
  bool TakeOne(double u, Inertia& inertia);
  bool TakePair(Index j, Index r, double u, Inertia& inertia);
  void Swap(Index i, Index j);
  void Subtract(const Column& from, const double* factor, Index first);
  void EliminateSingle(double d);
  void EliminatePair();

  Index candidates_ = 0, rows_ = 0, pivots_ = 0;
  std::size_t top_stride_ = 0, below_stride_ = 0;
  linalg::Vector top_;    // square, both triangles while it is not eliminated
  linalg::Vector below_;  // rows x candidates
  std::vector<Index> order_;
  // Of D^-1: entry (k, k), and (k + 1, k) where a block of two begins, else 0.
  std::vector<double> inverse_, inverse_off_;
  std::vector<double> pivot_, pivot_off_;  // of D likewise
  std::vector<double> size_;
  std::vector<double> factor_;  // of the columns that are left
};

}  // namespace switchyard::ipopt
