// tests/conic/programs.hpp - random programs with known answers, for every sort of cone and mixed.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/conic/driver.hpp"
#include "tests/support/known_answers.hpp"

namespace switchyard::conic {

using testing::KnownAnswer;
using Values = testing::Vector;

/// A shape with a name.
struct Sort {
  std::string name;
  testing::Shape shape;
};
inline void PrintTo(const Sort& sort, std::ostream* out) { *out << sort.name; }

inline sy_cone SecondOrder(std::int32_t dim) { return {SY_CONE_SECOND_ORDER, dim, 0}; }
inline sy_cone Rotated(std::int32_t dim) { return {SY_CONE_ROTATED, dim, 0}; }
inline sy_cone Semidefinite(std::int32_t order) {
  return {SY_CONE_PSD, order * (order + 1) / 2, 0};
}
inline sy_cone Exponential() { return {SY_CONE_EXPONENTIAL, 3, 0}; }
inline sy_cone Power(double a) { return {SY_CONE_POWER, 3, a}; }

/// One sort for each kind of cone, orders mixed, then mixtures.
inline std::vector<Sort> Sorts() {
  std::vector<Sort> sorts = {
      {"no_cones", {12, 8, {}}},
      {"zero", {10, 3, {{SY_CONE_ZERO, 2, 0}, {SY_CONE_ZERO, 1, 0}}}},
      {"nonnegative", {8, 3, {{SY_CONE_NONNEGATIVE, 6, 0}, {SY_CONE_NONNEGATIVE, 1, 0}}}},
      {"second_order", {12, 4, {SecondOrder(4), SecondOrder(3), SecondOrder(6)}}},
      {"second_order_side_by_side", {20, 4, std::vector<sy_cone>(19, SecondOrder(3))}},
      {"rotated", {12, 4, {Rotated(2), Rotated(3), Rotated(5), Rotated(3)}}},
      {"semidefinite", {14, 4, {Semidefinite(3), Semidefinite(4), Semidefinite(2)}}},
      {"exponential", {10, 3, {Exponential(), Exponential()}}},
      {"power", {12, 3, {Power(0.5), Power(0.1), Power(0.8), Power(1.0 / 3)}}},
      {"mixed", {24, 6, {SecondOrder(4), Semidefinite(3), Exponential(), Rotated(4), Power(0.3)}}},
      {"mixed_with_rows",
       {24,
        6,
        {{SY_CONE_ZERO, 2, 0},
         SecondOrder(5),
         {SY_CONE_NONNEGATIVE, 4, 0},
         Rotated(3),
         Semidefinite(2)}}}};
  const std::size_t plain = sorts.size();
  for (std::size_t k = 0; k < plain; ++k) {
    Sort sort = sorts[k];
    sort.name += "_quadratic";
    sort.shape.quadratic = true;
    sorts.push_back(sort);
  }
  return sorts;
}

inline double OptimumOf(const KnownAnswer& known) {
  return Objective(Problem(known.problem).view(), known.at.x.data());
}

/// An optimum over given patterns and values of P, A and F: sides, g and q follow.
inline KnownAnswer OptimumOver(ProblemData d, Random& random) {
  Vectors v;
  v.x = random.Normals(d.num_vars);
  v.x_dual.assign(v.x.size(), 0.0);
  d.x_lower.assign(v.x.size(), -kInfinity);
  d.x_upper.assign(v.x.size(), kInfinity);
  for (std::size_t j = 0; j < v.x.size(); ++j) {
    testing::ChooseSides(random, v.x[j], d.x_lower[j], d.x_upper[j], v.x_dual[j]);
  }
  const Values Ax = testing::Product(d.A, v.x);
  d.row_lower.resize(Ax.size());
  d.row_upper.resize(Ax.size());
  v.row_dual.resize(Ax.size());
  for (std::size_t i = 0; i < Ax.size(); ++i) {
    testing::ChooseSides(random, Ax[i], d.row_lower[i], d.row_upper[i], v.row_dual[i]);
  }
  const Values Fx = testing::Product(d.F, v.x);
  d.g.assign(Fx.size(), 0.0);
  for (const sy_cone& cone : d.cones) {
    const testing::Pair pair = testing::ComplementaryPair(cone, random);
    for (std::size_t i = 0; i < pair.s.size(); ++i) {
      d.g[v.cone_dual.size()] = pair.s[i] - Fx[v.cone_dual.size()];
      v.cone_dual.push_back(pair.z[i]);
    }
  }
  d.q = testing::Combined(d, v);
  SymmetricMultiplyAdd(d.P.View(), -1, v.x.data(), d.q.data());
  return {std::move(d), std::move(v)};
}

/// Every variable in a box around the known one: no side is infinite that a bound could need.
inline KnownAnswer Boxed(KnownAnswer known, Random& random) {
  ProblemData& d = known.problem;
  for (std::size_t j = 0; j < d.x_lower.size(); ++j) {
    if (std::isinf(d.x_lower[j])) d.x_lower[j] = known.at.x[j] - random.Uniform(1, 3);
    if (std::isinf(d.x_upper[j])) d.x_upper[j] = known.at.x[j] + random.Uniform(1, 3);
  }
  return known;
}

/// A point inside all cones, rows and bounds, that the ray starts from.
inline ProblemData WithAPoint(ProblemData d, Random& random) {
  const Values x = random.Normals(d.num_vars);
  const auto around = [&](const Values& at, Values& lower, Values& upper) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const bool equal = std::isfinite(lower[i]) && lower[i] == upper[i];
      const double room = equal ? 0 : random.Uniform(0.1, 1);
      if (std::isfinite(lower[i])) lower[i] = at[i] - room;
      if (std::isfinite(upper[i])) upper[i] = at[i] + room;
    }
  };
  around(x, d.x_lower, d.x_upper);
  around(testing::Product(d.A, x), d.row_lower, d.row_upper);
  const Values Fx = testing::Product(d.F, x);
  std::size_t row = 0;
  for (const sy_cone& cone : d.cones) {
    for (const double s : testing::PointOf(cone, random, 0.5)) {
      d.g[row] = s - Fx[row];
      ++row;
    }
  }
  return d;
}

/// The ray of a known answer moved inside all cones; its last entry is 1.
inline KnownAnswer WithRayInside(KnownAnswer known, Random& random) {
  Csc& f = known.problem.F;
  const auto last = static_cast<std::size_t>(f.start[static_cast<std::size_t>(f.cols) - 1]);
  std::size_t row = 0;
  for (const sy_cone& cone : known.problem.cones) {
    Random twin = random;  // the same point, twice
    const Values on = testing::PointOf(cone, random, 0), in = testing::PointOf(cone, twin, 0.5);
    for (std::size_t i = 0; i < on.size(); ++i) f.value[last + row++] += in[i] - on[i];
  }
  return known;
}

}  // namespace switchyard::conic
