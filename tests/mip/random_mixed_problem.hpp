// tests/mip/random_mixed_problem.hpp - small mixed-integer problems with rows, cones of every kind,
// groups and a quadratic objective, and their feasible points by enumeration of the integers.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "switchyard/hints.h"
#include "switchyard/problem.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {

/// Feasible at a point drawn with it, most of them. Two to five integers in small boxes, then up to
/// two continuous variables. Rows over integers alone have whole numbers, so that what they say of
/// integers is free of rounding.
class RandomMixedProblem {
 public:
  explicit RandomMixedProblem(unsigned seed, bool binaries_only = false);
  RandomMixedProblem(const RandomMixedProblem&) = delete;
  RandomMixedProblem& operator=(const RandomMixedProblem&) = delete;

  [[nodiscard]] const sy_problem& view() const { return problem_.view(); }
  [[nodiscard]] const ProblemData& data() const { return problem_.data(); }
  [[nodiscard]] std::int32_t num_integers() const { return num_integers_; }
  [[nodiscard]] double cutoff() const { return cutoff_; }

  /// Is x feasible, in its group, with an objective of at most the cutoff, by more than rounding
  /// wherever there is rounding?
  [[nodiscard]] bool Holds(const Vector& x) const;
  /// Points that hold: of each assignment of the integers those that a few draws find, moved along
  /// each continuous variable until they nearly hold no more.
  [[nodiscard]] std::vector<Vector> Points(Random& random) const;

 private:
  void DrawBoxes(Random& random, bool binaries_only);
  void DrawObjective(Random& random);
  void DrawRows(Random& random);
  void DrawCones(Random& random);
  void DrawGroup(Random& random);
  void ExtremePoints(const Vector& x, std::vector<Vector>& points) const;
  [[nodiscard]] bool RowsHold(const Vector& x) const;
  [[nodiscard]] bool ConesHold(const Vector& x) const;

  std::int32_t num_integers_ = 0;
  Vector center_;  // feasible, but for what was spoiled
  ProblemData data_;
  std::vector<std::int32_t> group_start_, group_;
  sy_sos1 groups_{};
  std::vector<sy_hint> hints_;
  double cutoff_ = kInfinity;
  Problem problem_;
};

}  // namespace switchyard::testing
