// tests/cones/groups.hpp - every kind of cone that an interior-point method knows, and random
// points of it.
#pragma once

#include <memory>
#include <ostream>
#include <vector>

#include "solvers/cones/kinds.hpp"
#include "switchyard/cones.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::cones {

using testing::Random;

/// A few equal cones, so laid out.
struct Case {
  const char* name;
  sy_cone cone;
  Index count;
  Index lanes;
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

inline const std::vector<Case>& Cases() {
  static const std::vector<Case> cases = {
      {"second_order_of_2", {SY_CONE_SECOND_ORDER, 2, 0}, 3, 1},
      {"second_order_of_5", {SY_CONE_SECOND_ORDER, 5, 0}, 3, 1},
      {"second_order_of_40", {SY_CONE_SECOND_ORDER, 40, 0}, 2, 1},
      {"second_order_side_by_side", {SY_CONE_SECOND_ORDER, 4, 0}, 16, linalg::kLanes},
      {"semidefinite_of_order_1", {SY_CONE_PSD, 1, 0}, 2, 1},
      {"semidefinite_of_order_3", {SY_CONE_PSD, 6, 0}, 2, 1},
      {"semidefinite_of_order_8", {SY_CONE_PSD, 36, 0}, 1, 1},
      {"exponential", {SY_CONE_EXPONENTIAL, 3, 0}, 4, 1},
      {"power_of_a_half", {SY_CONE_POWER, 3, 0.5}, 4, 1},
      {"power_of_a_tenth", {SY_CONE_POWER, 3, 0.1}, 4, 1},
  };
  return cases;
}

inline std::unique_ptr<Group> Make(const Case& c) {
  return FindKind(c.cone.kind)->make({c.count, c.cone.dim, c.lanes}, c.cone.parameter);
}

using Points = linalg::Vector;

/// The coordinates of one of the cones, and back.
inline std::vector<double> Coordinates(const Layout& layout, const Points& v, Index cone) {
  std::vector<double> s;
  for (Index i = 0; i < layout.dim; ++i) s.push_back(v[layout.Row(cone, i)]);
  return s;
}

/// How far outside a cone, or its dual; 0 inside.
inline double Violation(const Case& c, const Layout& layout, const Points& v, bool dual) {
  double worst = 0;
  for (Index k = 0; k < layout.count; ++k) {
    const std::vector<double> s = Coordinates(layout, v, k);
    worst = std::max(worst,
                     dual ? DualViolation(c.cone, s.data())
                          : FactsOf(c.cone.kind).violation(s.data(), c.cone.dim, c.cone.parameter));
  }
  return worst;
}

/// Inside all cones: the center, moved at random as far as `share` of the way to the boundary.
inline Points Inside(const Case& c, const Group& group, Random& random, bool dual, double share) {
  const auto rows = static_cast<std::size_t>(group.layout().rows());
  Points at(rows);
  group.Center(at.data());
  Points move(rows);
  for (double& m : move) m = random.Normal();
  double low = 0, high = 100;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    Points there = at;
    for (std::size_t i = 0; i < rows; ++i) there[i] += middle * move[i];
    (Violation(c, group.layout(), there, dual) == 0 ? low : high) = middle;
  }
  for (std::size_t i = 0; i < rows; ++i) at[i] += share * low * move[i];
  return at;
}

inline double Product(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace switchyard::cones
