// tests/presolve/programs.hpp - small problems, and answers carried back over a presolve.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "solvers/presolve/presolve.hpp"
#include "tests/support/answer_errors.hpp"

namespace switchyard::presolve {

using testing::Vector;
using Rows = std::vector<Vector>;

inline Csc Dense(const Rows& rows, Index cols) {
  Csc a(static_cast<Index>(rows.size()), cols);
  for (Index j = 0; j < cols; ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double value = rows[i][static_cast<std::size_t>(j)];
      if (value == 0) continue;
      a.row.push_back(static_cast<Index>(i));
      a.value.push_back(value);
    }
    a.start[static_cast<std::size_t>(j) + 1] = static_cast<Index>(a.row.size());
  }
  return a;
}

/// min q'x over free x.
inline ProblemData Costs(Vector q) {
  ProblemData d;
  d.num_vars = static_cast<Index>(q.size());
  d.flags = SY_PROBLEM_CONVEX;
  d.x_lower.assign(q.size(), -kInfinity);
  d.x_upper.assign(q.size(), kInfinity);
  d.P = Csc(d.num_vars, d.num_vars);
  d.A = Csc(0, d.num_vars);
  d.F = Csc(0, d.num_vars);
  d.q = std::move(q);
  return d;
}

/// min 1/2 |x - center|^2 but for variables whose weight is 0, free; curved columns stay.
inline ProblemData Nearest(const Vector& center, const Vector& weight) {
  ProblemData d = Costs(center);
  for (std::size_t j = 0; j < center.size(); ++j) {
    d.q[j] = -weight[j] * center[j];
    d.offset += 0.5 * weight[j] * center[j] * center[j];
    if (weight[j] != 0) {
      d.P.row.push_back(static_cast<Index>(j));
      d.P.value.push_back(weight[j]);
    }
    d.P.start[j + 1] = static_cast<Index>(d.P.row.size());
  }
  return d;
}
inline ProblemData Nearest(const Vector& center) {
  return Nearest(center, Vector(center.size(), 1.0));
}

inline ProblemData Bounded(ProblemData d, Vector lower, Vector upper) {
  d.x_lower = std::move(lower);
  d.x_upper = std::move(upper);
  return d;
}

inline ProblemData WithRows(ProblemData d, const Rows& rows, Vector lower, Vector upper) {
  d.A = Dense(rows, d.num_vars);
  d.row_lower = std::move(lower);
  d.row_upper = std::move(upper);
  return d;
}

inline ProblemData WithCones(ProblemData d, const Rows& rows, Vector g,
                             std::vector<sy_cone> cones) {
  d.F = Dense(rows, d.num_vars);
  d.g = std::move(g);
  d.cones = std::move(cones);
  return d;
}

/// Without the cones that are off, and without what the answer says of them.
inline void DropConesThatAreOff(ProblemData& d, Vectors& at) {
  if (d.cone_on.empty()) return;
  std::vector<std::uint8_t> keep;
  for (std::size_t c = 0; c < d.cones.size(); ++c) {
    keep.insert(keep.end(), static_cast<std::size_t>(d.cones[c].dim), d.cone_on[c]);
  }
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) {
      EXPECT_EQ(at.cone_dual[i], 0) << "of a cone that is off";
    }
  }
  d.F = KeepRows(d.F, keep);
  d.g = Keep(d.g, keep);
  at.cone_dual = Keep(at.cone_dual, keep);
  d.cones = Keep(d.cones, d.cone_on);
  d.cone_on.clear();
}

inline Answer AnswerOf(const Vectors& v, Meaning meaning) {
  return {v.x, v.x_dual, v.row_dual, v.cone_dual, meaning};
}
inline Vectors VectorsOf(const Answer& a) { return {a.x, a.x_dual, a.row_dual, a.cone_dual}; }

struct Sizes {
  Index vars = 0, rows = 0, cones = 0;
  bool operator==(const Sizes&) const = default;
};
inline std::ostream& operator<<(std::ostream& out, const Sizes& s) {
  return out << s.vars << " variables, " << s.rows << " rows, " << s.cones << " cones";
}
inline Sizes SizesOf(const ProblemData& d) { return {d.num_vars, d.num_rows(), d.num_cones()}; }

inline double ObjectiveOf(const ProblemData& d, const Vector& x) {
  return Objective(Problem(d).view(), x.data());
}

/// Carries an optimum of the reduced problem back, and holds both against abi.h.
inline Vectors Recovered(const ProblemData& whole, const Presolve& presolve, const Vectors& reduced,
                         double tolerance = 1e-12) {
  EXPECT_LE(testing::OptimumError(presolve.reduced(), reduced), tolerance) << "of the reduced one";
  Vectors at = VectorsOf(presolve.Back(AnswerOf(reduced, Meaning::kOptimum)));
  ProblemData judged = whole;
  Vectors of_judged = at;
  DropConesThatAreOff(judged, of_judged);
  EXPECT_LE(testing::OptimumError(judged, of_judged), tolerance);
  const double objective = ObjectiveOf(whole, at.x);
  EXPECT_NEAR(ObjectiveOf(presolve.reduced(), reduced.x), objective,
              tolerance * (1 + std::abs(objective)));
  return at;
}

/// Of a problem that presolve solves.
inline Vectors RecoveredFromNothing(const ProblemData& whole) {
  const Presolve presolve(whole, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), Sizes());
  return Recovered(whole, presolve, {});
}

}  // namespace switchyard::presolve
