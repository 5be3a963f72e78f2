// tests/solvers/small_integer_problem.hpp - mixed-integer convex problems small enough to be solved
// by enumeration, in closed form.
#pragma once

#include <cstdint>
#include <vector>

#include "switchyard/arcs.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::test {

enum class IntegerKind { kLinear, kQuadratic, kConic };

/// Two to eight integers in small boxes and up to two continuous variables, drawn. Rows have whole
/// coefficients, each at most one continuous variable; so the continuous rest of fixed integers is
/// an interval for each, and its cost, linear or a parabola, is least at an end or a vertex.
/// Boxes of integers are bounds or, of some, rows. A kQuadratic one has P = G'G over the integers,
/// a kConic one a second-order cone over the integers with a head that may be continuous.
class SmallIntegerProblem {
 public:
  SmallIntegerProblem(IntegerKind kind, std::uint64_t seed);

  [[nodiscard]] const sy_problem& view() const { return problem_.view(); }
  [[nodiscard]] std::int32_t num_integers() const { return num_integers_; }
  /// The least objective over all integer points; infinity where there is none.
  [[nodiscard]] double Optimum() const;
  /// The least objective with the integers as in x; infinity where nothing is left.
  [[nodiscard]] double OptimumOfRest(const std::vector<double>& x) const;

 private:
  struct Row {
    std::vector<double> a;  // of all variables
    double lower, upper;
  };

  double Whole(int size);  // an integer in [-size, size]
  void DrawBoxes();
  void DrawObjective(IntegerKind kind);
  void DrawRows();
  void DrawCone();
  void Seal();
  [[nodiscard]] bool NarrowByRow(const Row& row, const std::vector<double>& x,
                                 std::vector<double>& lower, std::vector<double>& upper) const;

  Random random_;
  std::int32_t num_integers_ = 0, num_continuous_ = 0;
  std::vector<double> lower_, upper_;       // boxes, finite
  std::vector<std::uint8_t> boxed_by_row_;  // not by a bound
  std::vector<double> point_;               // that most rows keep
  std::vector<std::vector<double>> g_;      // P = g'g over the integers
  std::vector<double> q_, curvature_;
  std::vector<Row> rows_;
  std::vector<Row> cone_;  // lower: the constant
  Problem problem_;
};

}  // namespace switchyard::test
