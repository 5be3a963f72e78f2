// solvers/linalg/block_ldl.hpp - LDL' of a bordered block-diagonal matrix.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/linalg/lane_kernels.hpp"
#include "solvers/linalg/ldl.hpp"
#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/workers.hpp"

namespace switchyard::linalg {

/// Who is in which batch, and what they leave: all that follows from the pattern.
struct BlockPlan {
  BlockPlan(const SymmetricPattern& pattern, const std::vector<Index>& block, Index count,
            const std::vector<std::int8_t>& sign);

  /// Up to kLanes blocks of one class, side by side.
  struct Batch {
    Index shape = 0;
    Index lanes = 0;  // kLanes or 1
    // Each for lane after lane of one column, border row or entry.
    std::vector<Index> column, border, entry;
    std::vector<Index> pair;  // entries of the rest, for the border's triangle
    // Where its L, its inverse pivots and its part of a right side begin, in numbers.
    std::size_t l = 0, pivots = 0, x = 0, triangle = 0;
  };
  Index columns = 0;
  std::vector<BlockShape> shapes;
  std::vector<Batch> batches;
  std::vector<Index> rest_column;  // of the whole matrix
  std::vector<Index> rest_entry;   // of the rest's pattern: entry of the whole matrix; -1: none
  SymmetricPattern rest_pattern;
  // Numbers to make room for: `triangle` for one batch's, `triangles` for those of all.
  std::size_t l = 0, pivots = 0, x = 0, triangle = 0, triangles = 0;
  double work = 0, factor_size = 0;

 private:
  void MakeBatches(const std::vector<BlockClass>& classes, const std::vector<Index>& rest_number);
  void PlanRest(const SymmetricPattern& pattern, const std::vector<Index>& rest_number);
  /// Of all batches, one after the other.
  void GivePairs(const std::vector<Index>& pairs);
};

/// Blocks are eliminated first, eight of one shape at a time: each step of the shape's elimination
/// is the same step of eight blocks, a vector each. What they leave on the border, and the rest, is
/// a sparse matrix that Ldl factors; sizes of terms (see PivotRule) it counts from there on.
class BlockLdl {
 public:
  /// `block`: of each column, below `count`; -1: of the rest.
  BlockLdl(const SymmetricPattern& pattern, const std::vector<std::int8_t>& sign,
           const EliminationWish& wish, const std::vector<Index>& block, Index count);
  /// Shares what follows from the pattern; has no factors yet.
  BlockLdl(const BlockLdl& other);
  BlockLdl& operator=(const BlockLdl&) = delete;
  ~BlockLdl() = default;

  /// As Ldl. `workers`, if any, share the blocks, where there are enough; factors and solutions are
  /// the same.
  int Factor(const Numbers& values, const PivotRule& rule, Workers* workers = nullptr);
  void Solve(const NumbersOf<double>& given, Workers* workers = nullptr) const;

  [[nodiscard]] double work() const { return plan_->work + rest_.work(); }
  [[nodiscard]] double factor_size() const { return plan_->factor_size + rest_.factor_size(); }
  [[nodiscard]] const Ldl& rest() const { return rest_; }

 private:
  using Batch = BlockPlan::Batch;
  /// What is made at a factorization, and its room.
  struct Made {
    Vector l, inverse_pivot, triangle;
    Vector rest_high, rest_low;  // values of the rest
    mutable Vector x, right_high, right_low;
    mutable Vector low;  // of a right side that has none
  };

  [[nodiscard]] LaneShape ShapeOf(const Batch& batch, Digits digits) const {
    return {plan_->shapes[batch.shape], batch.lanes, digits};
  }
  void MakeRoom(Digits digits, Made& made) const;
  void KeepInfinite(const Numbers& values, Made& to) const;
  int FactorBatches(const Numbers& values, const PivotRule& rule, Made& to) const;
  int FactorBatches(const Numbers& values, const PivotRule& rule, Workers& workers, Made& to) const;
  int FactorBatch(const Batch& batch, const Numbers& values, const PivotRule& rule, Made& to,
                  double* triangle) const;
  void ForwardBatch(const Batch& batch, const NumbersOf<double>& b, const Made& by) const;
  void AddBorder(const Batch& batch, const Made& by) const;
  void SolveRest(const NumbersOf<double>& b, const Made& by, Workers* workers) const;
  void BackwardBatch(const Batch& batch, const Made& by, const NumbersOf<double>& b) const;

  std::shared_ptr<const BlockPlan> plan_;
  Ldl rest_;
  Made plain_, twofold_;
  Digits digits_ = Digits::kPlain;  // of the latest factors
};

}  // namespace switchyard::linalg
