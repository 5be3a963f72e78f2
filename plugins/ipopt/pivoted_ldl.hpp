// pivoted_ldl.hpp - LDL' of a sparse symmetric matrix that may be indefinite.
#pragma once

#include <cstdint>
#include <vector>

#include "dense_front.hpp"
#include "solvers/linalg/elimination.hpp"
#include "solvers/linalg/supernodes.hpp"

namespace switchyard::ipopt {

/// Front by front along the tree of solvers/linalg, whose order is found once for a pattern; inside
/// a front pivots are chosen by size, and what finds no pivot there is delayed to the parent. So
/// the factors are as stable as those of a dense matrix with the same bound u, whatever the signs,
/// and the inertia is that of a matrix within rounding errors of the given one.
///
/// Rows and columns are scaled first until the largest entry of each is about 1 (Ruiz, RAL-TR-
/// 2001-034): then sizes can be compared, and a column of a positive definite matrix is a pivot as
/// it comes.
class PivotedLdl {
 public:
  using Index = linalg::Index;

  /// `last`: 1 for columns that should go after their neighbours, having no diagonal of their own.
  PivotedLdl(linalg::SymmetricPattern pattern, std::vector<Index> last);

  /// `values`: one for each entry of the pattern, all finite. Pivots have |L| <= 1 / u, u <= 1/2.
  /// Where the inertia has zeros, so has the solution.
  Inertia Factor(const double* values, double u);
  /// b <- A^-1 b.
  void Solve(double* b) const;

  /// Multiplications of a factorization without delays.
  [[nodiscard]] double work() const { return elimination_.Work(); }

 private:
  /// What a front leaves: a lower triangle by columns, RoundUp(index.size()) apart.
  struct Left {
    std::vector<Index> index;  // columns in the order of elimination; those delayed first
    std::vector<double> size;  // of the terms of each one's diagonal
    Index delayed = 0;
    linalg::Vector value;
  };

  void Scale(const double* values);
  void Begin(std::size_t s, std::size_t children);
  void Gather(std::size_t s);
  void AddChild(const Left& child, std::size_t s);
  void Leave(std::size_t s, Left& to);
  void Load(std::size_t s) const;
  void Store(std::size_t s, Index count) const;

  const linalg::SymmetricPattern pattern_;
  const linalg::Elimination elimination_;
  const linalg::Supernodes tree_;
  std::vector<double> scale_, scaled_;  // of each column as given; values
  std::vector<DenseFront> fronts_;
  std::vector<std::vector<Index>> index_;  // of each front: candidates, then rows
  std::vector<Index> place_;               // of each column in the front at hand
  std::vector<Left> stack_;                // of which `top_` are in use
  std::size_t top_ = 0;
  linalg::Vector update_, work_;
  mutable std::vector<double> b_;
  mutable linalg::Vector x_;  // of one front
};

}  // namespace switchyard::ipopt
