// solvers/rounding/integer_problem.hpp - a problem with integer variables and no paths, and the
// boxes of its variables while integers are fixed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/boxes.hpp"
#include "switchyard/sos1_groups.hpp"

namespace switchyard::rounding {

/// In how many rows and cone rows a variable may not grow, and may not fall, without an effect on
/// whether they hold.
struct Locks {
  std::int32_t up = 0, down = 0;
};

/// Borrows the problem and its hints, which stay in place until the next load.
class IntegerProblem {
 public:
  /// Throws Failure (SY_E_ARGUMENT): "sy.sos1/1" does not fit the problem.
  explicit IntegerProblem(const sy_problem& problem);
  IntegerProblem(const IntegerProblem&) = delete;
  IntegerProblem& operator=(const IntegerProblem&) = delete;

  [[nodiscard]] const sy_problem& problem() const { return problem_; }
  [[nodiscard]] const std::vector<std::int32_t>& integers() const { return integers_; }
  /// Of each of integers(). A cone K is indifferent to growth of row i where e_i is in K.
  [[nodiscard]] const std::vector<Locks>& locks() const { return locks_; }
  /// At most one of each is not 0.
  [[nodiscard]] std::int32_t num_groups() const { return groups_.size(); }
  [[nodiscard]] std::span<const std::int32_t> Group(std::int32_t i) const { return groups_.Of(i); }

  /// What x violates by more than `tolerance`, relative: the problem's own or a group; "": nothing.
  /// A row over integers alone is held to its sides: large terms of either sign excuse nothing,
  /// since whole numbers have no error. The product of a rotated cone is held to its squares, too,
  /// relative to both: next to a huge head the cone is near, also for members of any size beside a
  /// head that an integer has switched off.
  [[nodiscard]] std::string WhatIsViolatedBy(const std::vector<double>& x, double tolerance) const;

 private:
  void CountLocks();
  [[nodiscard]] std::string WhatIntegerRowIsViolatedBy(const std::vector<double>& x,
                                                       double tolerance) const;
  [[nodiscard]] std::string WhatProductIsViolatedBy(const std::vector<double>& x,
                                                    double tolerance) const;

  sy_problem problem_;
  Sos1Groups groups_;
  std::vector<std::int32_t> integers_;
  std::vector<Locks> locks_;
  std::vector<std::uint8_t> has_continuous_;  // of each row
};

/// Boxes that hold every feasible point with what was imposed, narrowed by propagation.
class Domain {
 public:
  explicit Domain(const IntegerProblem& whole);

  [[nodiscard]] double lower(std::int32_t j) const { return boxes_.lower[std::size_t(j)]; }
  [[nodiscard]] double upper(std::int32_t j) const { return boxes_.upper[std::size_t(j)]; }
  [[nodiscard]] bool IsFixed(std::int32_t j) const { return lower(j) == upper(j); }
  [[nodiscard]] const Boxes& boxes() const { return boxes_; }
  /// The integer next to v in the box.
  [[nodiscard]] double Nearest(std::int32_t j, double v) const;

  /// From here on x_j is in [lower, upper] too. Those that lie outside the box: a contradiction.
  void Impose(std::int32_t j, double lower, double upper);
  /// Propagates over rows, cones, groups and objective <= cutoff. Is a point left, as far as that
  /// can tell?
  [[nodiscard]] bool Propagate(double cutoff = kInfinity);
  /// Where the last contradiction was found, as "row[3]".
  [[nodiscard]] std::string Contradiction() const;

 private:
  [[nodiscard]] bool PropagateGroups(bool& changed);

  const IntegerProblem* whole_;
  Boxes boxes_;
  std::int32_t contradictory_group_ = -1;
};

}  // namespace switchyard::rounding
