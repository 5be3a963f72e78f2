// solvers/mip/integer_cuts.hpp - rows that every integer point of a second-order cone keeps, and
// its relaxation does not.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/mip/affine_columns.hpp"
#include "solvers/mip/node_boxes.hpp"
#include "solvers/rounding/entries.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// sum of entries >= lower.
struct Row {
  std::vector<rounding::Entry> entries;
  double lower = 0;
};

/// Two families, both valid in the whole tree, and proven row by row: coefficients are numbers, and
/// what they must keep to is checked in intervals, rounded outward.
///
/// *Chords.* A cone 2 r t >= |u|^2 in which r and all members u depend on one integer k alone says
/// t >= f(k) = |u(k)|^2 / (2 r(k)), a convex function where r > 0. No integer is between K and
/// K + 1, so that
///
///   t >= f(K) + (f(K+1) - f(K)) (k - K)
///
/// at every integer k: what splitting at k would prove of both sides at once.
///
/// *Binaries below a root.* With members u_i = a_i z_i of binaries, z_i^2 = z_i, so that t >= |u|
/// is t >= sqrt(c + sum a_i^2 z_i), a submodular function of the set {i : z_i = 1}. For every order
/// of the members, and S_i the sum of the first i squares,
///
///   t >= sqrt(c) + sum_i (sqrt(c + S_i) - sqrt(c + S_{i-1})) z_i
///
/// (Edmonds 1970; Atamturk and Narayanan, Polymatroids and mean-risk minimization, 2008), and the
/// order of falling z_i is the one that a point violates the most. A rotated cone whose heads are
/// multiples of one variable is such a cone, too.
class IntegerCuts {
 public:
  /// Borrows nothing. `boxes`: where all feasible points are.
  IntegerCuts(const sy_problem& problem, const NodeBoxes& boxes);

  /// Is there no cone of either kind?
  [[nodiscard]] bool empty() const { return chords_.empty() && roots_.empty(); }
  /// Appends rows that x violates by more than `tolerance`, relative.
  void Separate(const std::vector<double>& x, double tolerance, std::vector<Row>& rows) const;

 private:
  /// A head of a cone: entries x + constant.
  struct Head {
    std::vector<rounding::Entry> entries;
    double constant = 0;
  };
  struct Chord {
    Head t;
    std::int32_t k = -1;
    Affine r;
    std::vector<Affine> u;
    double least = 0, most = 0;  // k
    bool raised = false;         // below `least` the cone holds no point, though the box does
  };
  struct Member {
    std::int32_t z;
    double square;  // at most a^2
  };
  struct Rooted {
    Head t;
    double constant = 0;  // c, at most
    std::vector<Member> members;
  };

  void AddChord(const std::vector<std::optional<Affine>>& values, const Head& t, std::size_t r,
                const NodeBoxes& boxes);
  void AddRoot(const std::vector<std::optional<Affine>>& values, std::size_t heads, Head t,
               const NodeBoxes& boxes);
  [[nodiscard]] static Interval Least(const Chord& chord, double k);
  static void SeparateChord(const Chord& chord, const std::vector<double>& x, double tolerance,
                            std::vector<Row>& rows);
  static void SeparateRoot(const Rooted& root, const std::vector<double>& x, double tolerance,
                           std::vector<Row>& rows);

  std::vector<Chord> chords_;
  std::vector<Rooted> roots_;
};

}  // namespace switchyard::mip
