// condensed_kkt.hpp - Ipopt's linear systems without their slacks and inequality multipliers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pivoted_ldl.hpp"

namespace switchyard::ipopt {

/// The augmented system of an interior-point method in its variables x, slacks s and multipliers
/// y_c of equations, y_d of inequalities (Waechter and Biegler, Math. Program. 106, 2006),
///
///     [H       J_c'  J_d'] x        H = W + D_x + delta_x I,  Sigma = D_s + delta_s I > 0
///     [   Sigma      -I  ] s
///     [J_c     -C        ] y_c      C, D >= 0: diagonal
///     [J_d  -I       -D  ] y_d
///
/// Each slack and its multiplier are eliminated first: Sigma > 0 is a pivot, and then
/// -(D + Sigma^-1) < 0 is. Hence they have as many positive eigenvalues as negative ones, and
///
///     K = [H + J_d' S J_d  J_c'; J_c  -C],   S = (D + Sigma^-1)^-1
///
/// has all others. No slack fills in anything, and rows that share their variables add up in the
/// same few entries. K is factored with pivots by size, since H may be indefinite.
///
/// Where S is very large, as at a row that holds as an equation, adding it to H loses digits of H;
/// those come back by iterative refinement with the residual of the whole augmented system. A
/// solution is trusted whose residual becomes small in each row, against the sizes of that row's
/// terms, or as a whole, against those of solution and right side, which is Ipopt's own measure.
class CondensedKkt {
 public:
  using Index = linalg::Index;

  /// A matrix by the places of its entries, of either triangle, from 0; doubles add up.
  struct Entries {
    Index n = 0;
    std::vector<Index> row, col;
  };

  /// How many of the columns are multipliers.
  struct Counts {
    Index equations = 0, inequalities = 0;
  };

  /// Nothing where the slacks are not where they should be, or entries would be more than fit.
  static std::unique_ptr<CondensedKkt> Make(Entries entries, const Counts& counts);

  /// Of the whole system. Nothing where it cannot be condensed, or is not finite. `u`: of
  /// PivotedLdl.
  std::optional<Inertia> Factor(const double* values, double u);
  /// b <- A^-1 b, after a factorization without zeros. Is the solution to be trusted?
  bool Solve(double* b);

  [[nodiscard]] double work() const { return ldl_->work() + static_cast<double>(product_.size()); }

 private:
  /// A slack, its multiplier and the entries of its row of J_d.
  struct Pair {
    Index slack = 0, multiplier = 0;
    std::size_t begin = 0, end = 0;     // in row_col_, row_value_
    std::size_t product = 0;            // the first of its products in product_
    double sigma = 0, link = 0, d = 0;  // of the matrix: [sigma link; link d]
    double s = 0;                       // S
  };
  /// Where an entry of the matrix goes.
  enum class Part : std::uint8_t { kSigma, kLink, kD, kRow, kKept };

  CondensedKkt(Entries entries, const Counts& counts);
  [[nodiscard]] bool FindPairs();
  void FindRows();
  [[nodiscard]] bool FindPattern();
  bool Condense(const double* values);
  void SolveOnce(double* b);
  double Residual(const std::vector<double>& b, const std::vector<double>& x);

  const Entries a_;
  const Counts counts_;
  std::vector<Pair> pairs_;
  std::vector<Index> number_;    // of each column: among those kept, or -1 - its pair
  std::vector<Part> part_;       // of each entry
  std::vector<std::size_t> to_;  // of each entry: its pair, place in row_value_, or entry of K
  std::vector<Index> row_col_;   // rows of J_d by the numbers of columns kept
  std::vector<double> row_value_;
  std::vector<Index> product_;  // entries of K, for each row's pairs of entries, row by row
  Index kept_ = 0;
  std::unique_ptr<PivotedLdl> ldl_;
  std::vector<double> values_, k_;
  std::vector<double> x_, residual_, size_, small_;
  std::vector<double> row_size_;  // sums of the sizes of each row's entries
};

}  // namespace switchyard::ipopt
