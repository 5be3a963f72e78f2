// solvers/linalg/multifrontal_ldl.hpp - LDL' of a matrix whose factor has dense parts.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/linalg/dense_kernels.hpp"
#include "solvers/linalg/elimination.hpp"
#include "solvers/linalg/pivots.hpp"
#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/supernodes.hpp"

namespace switchyard::linalg {

/// Front by front (Duff and Reid, ACM Trans. Math. Softw. 9, 1983; Liu, SIAM Review 34, 1992): a
/// front gathers its entries of the matrix and what its children's fronts left, eliminates its own
/// columns, and leaves the rest on a stack for its parent.
class MultifrontalLdl {
 public:
  /// `elimination` must outlive it.
  MultifrontalLdl(const Elimination& elimination, const std::vector<std::int8_t>& sign,
                  Digits digits);

  /// `values`: of the entries of the given pattern. How many pivots were raised.
  int Factor(const Numbers& values, const PivotRule& rule);
  /// b <- (LDL')^-1 b, in the order of elimination.
  void Solve(const NumbersOf<double>& b) const;

 private:
  [[nodiscard]] Front FrontOf(std::size_t node) const;
  void PlanStorage();
  void Gather(std::size_t node, const Front& front, const Numbers& values);
  void AddChild(const Supernode& child, const double* left, const Front& front,
                double* update) const;
  [[nodiscard]] double* Load(const Supernode& node, const NumbersOf<double>& b) const;
  void Store(const Supernode& node, const NumbersOf<double>& b) const;

  const Supernodes tree_;
  const Digits digits_;
  const std::ptrdiff_t parts_;
  std::vector<std::int8_t> sign_;          // in the order of elimination
  std::vector<std::int64_t> front_start_;  // of each node in fronts_
  Vector fronts_;
  Vector stack_;
  Vector work_;
  mutable Vector column_, own_;  // of the longest front: rows below, pivots
  Vector pivot_, inverse_pivot_;
  std::vector<double> size_;  // of each pivot's terms: see PivotRule
  struct Left {               // on the stack
    std::size_t node;
    std::int64_t begin;
  };
  std::vector<Left> left_;
};

}  // namespace switchyard::linalg
