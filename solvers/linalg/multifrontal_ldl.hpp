// solvers/linalg/multifrontal_ldl.hpp - LDL' of a matrix whose factor has dense parts.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/linalg/dense_kernels.hpp"
#include "solvers/linalg/elimination.hpp"
#include "solvers/linalg/pivots.hpp"
#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/subtrees.hpp"
#include "solvers/linalg/supernodes.hpp"
#include "solvers/linalg/workers.hpp"

namespace switchyard::linalg {

/// Front by front (Duff and Reid, ACM Trans. Math. Softw. 9, 1983; Liu, SIAM Review 34, 1992): a
/// front gathers its entries of the matrix and what its children's fronts left, eliminates its own
/// columns, and leaves the rest on a stack for its parent. Subtrees are worked on apart, each with
/// a stack of its own, before what is above them.
class MultifrontalLdl {
 public:
  /// `elimination` must outlive it.
  MultifrontalLdl(const Elimination& elimination, const std::vector<std::int8_t>& sign,
                  Digits digits);

  /// `values`: of the entries of the given pattern. How many pivots were raised.
  int Factor(const Numbers& values, const PivotRule& rule, Workers* workers = nullptr);
  /// b <- (LDL')^-1 b, in the order of elimination. b has room() numbers; those behind the columns
  /// are its own.
  void Solve(const NumbersOf<double>& b, Workers* workers = nullptr) const;
  [[nodiscard]] Index room() const { return subtrees_.room; }

 private:
  /// What a front left. It stands on a stack; or on another one, where it is not to be taken off.
  struct Left {
    std::size_t node;
    const double* numbers;
    std::int64_t begin;  // -1: on another one
  };
  /// What one who goes through nodes needs: of the largest of them.
  struct Room {
    Vector stack, work;
    Vector column, own;  // of the longest front: rows below, pivots
    std::int64_t top = 0;
    std::vector<Left> left;
  };
  [[nodiscard]] Front FrontOf(std::size_t node) const;
  void PlanStorage();
  void PlanRoom(const std::vector<std::size_t>& nodes, Room& room) const;
  int Eliminate(std::size_t node, const Numbers& values, const PivotRule& rule, Room& room);
  int EliminateTop(const Numbers& values, const PivotRule& rule);
  void Gather(std::size_t node, const Front& front, const Numbers& values);
  void AddChild(const Supernode& child, const double* left, const Front& front,
                double* update) const;
  void Forward(std::size_t node, const NumbersOf<double>& b, Room& room) const;
  void Backward(std::size_t node, const NumbersOf<double>& b, Room& room) const;
  [[nodiscard]] double* Load(const Supernode& node, const NumbersOf<double>& b, Room& room) const;
  void Store(const Supernode& node, const NumbersOf<double>& b, const Room& room) const;
  /// What stands at the places of parts is added to the rows.
  void AddPlaces(const NumbersOf<double>& v) const;

  const Supernodes tree_;
  const Subtrees subtrees_;
  const Digits digits_;
  const std::ptrdiff_t parts_;
  std::vector<std::int8_t> sign_;          // in the order of elimination
  std::vector<std::int64_t> front_start_;  // of each node in fronts_
  Vector fronts_;
  mutable std::vector<Room> rooms_;  // of each part, and behind them the top's
  Vector pivot_, inverse_pivot_;
  std::vector<double> size_;  // of each pivot's terms: see PivotRule
};

}  // namespace switchyard::linalg
