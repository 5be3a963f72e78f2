// core/problem/builder.hpp - a sy_problem from triplets: structure once, numbers often.
#pragma once

#include <cstdint>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard {

/// A matrix written entry by entry, in any order; equal places add up. The first writing finds the
/// pattern; a later one in the same order writes numbers into it without sorting.
class TripletMatrix {
 public:
  void Add(std::int32_t row, std::int32_t col, double value) {
    if (!sealed_) {
      row_.push_back(row);
      col_.push_back(col);
      value_.push_back(value);
    } else if (next_ < slot_.size() && row_[next_] == row && col_[next_] == col) {
      matrix_.value[static_cast<std::size_t>(slot_[next_++])] += value;
    } else {
      same_ = false;
    }
  }

  /// Sorts what was written; from here on the pattern stands.
  const Csc& Seal(std::int32_t rows, std::int32_t cols);
  /// The same for a matrix that is written once: moved out, all else given back.
  Csc SealOnce(std::int32_t rows, std::int32_t cols);
  /// All numbers 0: a second writing follows.
  void Rewrite();
  /// Did the writing since Rewrite() follow the first to the end?
  [[nodiscard]] bool same() const { return same_ && (!sealed_ || next_ == slot_.size()); }
  [[nodiscard]] const Csc& matrix() const { return matrix_; }

 private:
  /// Were the triplets written column by column, rows ascending, none twice?
  [[nodiscard]] bool InOrder() const;
  const Csc& TakeAsWritten(std::int32_t rows, std::int32_t cols);

  std::vector<std::int32_t> row_;
  std::vector<std::int32_t> col_;
  std::vector<double> value_;       // of the first writing
  std::vector<std::int32_t> slot_;  // where triplet k stands in matrix_.value
  std::size_t next_ = 0;
  bool sealed_ = false;
  bool same_ = true;
  Csc matrix_;
};

/// Collects the sections of a problem. Used twice or more over the same structure: write, Finish;
/// then Rewrite, write again, and Finish tells whether the structure was the same.
class ProblemBuilder {
 public:
  /// `count` free continuous variables without cost; returns the first one's index.
  std::int32_t AddVariables(std::int32_t count);
  /// `count` rows without entries, free on both sides; returns the first one's index.
  std::int32_t AddRows(std::int32_t count);
  /// A cone; returns the index of its first cone row. g is 0.
  std::int32_t AddCone(const sy_cone& cone);

  TripletMatrix P;  // i <= j
  TripletMatrix A;
  TripletMatrix F;
  std::vector<double> q;
  double offset = 0;
  std::vector<double> x_lower;
  std::vector<double> x_upper;
  std::vector<std::uint8_t> integer;
  std::vector<double> row_lower;
  std::vector<double> row_upper;
  std::vector<double> g;
  std::vector<sy_cone> cones;
  std::uint32_t flags = 0;

  /// The problem. A section in which nothing was said is absent.
  [[nodiscard]] ProblemData Finish();
  /// The same of a builder that is used once: without a second copy of a matrix.
  [[nodiscard]] ProblemData FinishOnce();
  /// Clears all but the patterns.
  void Rewrite();
  /// After a second writing: were all patterns those of the first?
  [[nodiscard]] bool SamePatterns() const { return P.same() && A.same() && F.same(); }

 private:
  void TakeVectors(ProblemData& d);
};

}  // namespace switchyard
