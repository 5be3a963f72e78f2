// solvers/linalg/simplicial_ldl.hpp - LDL' of a very sparse matrix, entry by entry.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/linalg/elimination.hpp"
#include "solvers/linalg/pivots.hpp"

namespace switchyard::linalg {

/// Row by row (up-looking): row k of L solves L(0:k, 0:k) D y = A(0:k, k), along the paths of the
/// elimination tree that lead from the entries of column k.
class SimplicialLdl {
 public:
  /// `elimination` must outlive it.
  SimplicialLdl(const Elimination& elimination, const std::vector<std::int8_t>& sign);

  /// `values`: of the entries of the given pattern. How many pivots were raised.
  int Factor(const double* values, const PivotRule& rule);
  /// b <- (LDL')^-1 b, in the order of elimination.
  void Solve(double* b) const;

 private:
  const PermutedPattern& a_;
  const std::vector<Index>& parent_;
  std::vector<std::int8_t> sign_;  // in the order of elimination
  std::vector<std::int64_t> start_;
  std::vector<Index> row_;
  std::vector<double> value_;
  std::vector<double> inverse_d_;
  // While factoring: what of each column is there, and the row at hand.
  std::vector<std::int64_t> end_;
  std::vector<double> y_;
  std::vector<Index> seen_, reach_;
};

}  // namespace switchyard::linalg
