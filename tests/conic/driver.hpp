// tests/conic/driver.hpp - the backend driven as the C++ class that it is, and what it found held
// against abi.h.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "solvers/conic/conic.hpp"
#include "switchyard/problem_update.hpp"
#include "tests/support/answer_errors.hpp"

namespace switchyard::conic {

using testing::Random;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline sy_control Freely() {
  sy_control c = {};
  c.size = sizeof c;
  c.threads = 1;
  c.seconds = kInfinity;
  c.iterations = c.nodes = std::numeric_limits<std::int64_t>::max();
  c.cutoff = kInfinity;
  c.target = -kInfinity;
  c.feasibility = c.optimality = c.integrality = c.absolute_gap = c.relative_gap = kNaN;
  return c;
}

inline sy_control WithTolerance(double tolerance) {
  sy_control c = Freely();
  c.feasibility = c.optimality = tolerance;
  return c;
}

/// Vectors that were not written are NaN.
struct Found {
  sy_result result{};
  Vectors at;
  std::string text;
};

inline const sy_host& QuietHost() {
  static const sy_host host = [] {
    sy_host h = {};
    h.size = sizeof h;
    h.name = "quiet";
    return h;
  }();
  return host;
}

inline Found SolveWith(Conic& conic, const ProblemData& d, const sy_control& control) {
  Found found;
  found.at.x.assign(static_cast<std::size_t>(d.num_vars), kNaN);
  found.at.x_dual = found.at.x;
  found.at.row_dual.assign(d.row_lower.size(), kNaN);
  found.at.cone_dual.assign(d.g.size(), kNaN);
  char text[512] = "";
  found.result.size = sizeof found.result;
  found.result.x = found.at.x.data();
  found.result.x_dual = found.at.x_dual.data();
  found.result.row_dual = found.at.row_dual.data();
  found.result.cone_dual = found.at.cone_dual.data();
  found.result.text = text;
  found.result.text_size = sizeof text;
  conic.Solve(control, found.result);
  found.text = text;
  return found;
}

/// An instance, and the problem that it should have by now.
class Solver {
 public:
  Solver() : conic_(std::make_unique<Conic>(QuietHost())) {}
  explicit Solver(const ProblemData& d, std::uint64_t updates = 0) : Solver() { Load(d, updates); }

  Solver& Set(const char* name, std::int64_t integer) {
    sy_value value = {};
    value.type = SY_INTEGER;
    value.as.integer = integer;
    conic_->SetOption(name, value);
    return *this;
  }
  Solver& Load(const ProblemData& d, std::uint64_t updates = 0) {
    problem_ = std::make_unique<Problem>(d);
    conic_->Load(problem_->view(), updates);
    return *this;
  }
  void Update(const sy_update& update) {
    conic_->Update(update);
    problem_->Apply(update);
  }
  Found Solve(const sy_control& control = Freely()) {
    return SolveWith(*conic_, problem_->data(), control);
  }
  [[nodiscard]] Solver Clone() const {
    Solver copy;
    copy.conic_ = conic_->Clone();
    copy.problem_ = std::make_unique<Problem>(problem_->data());
    return copy;
  }
  [[nodiscard]] const ProblemData& data() const { return problem_->data(); }
  [[nodiscard]] bool shares() const { return conic_->shares_symbolic_phase(); }

 private:
  std::unique_ptr<Conic> conic_;
  std::unique_ptr<Problem> problem_;
};

inline sy_update Nothing() {
  sy_update update = {};
  update.size = sizeof update;
  return update;
}

/// Whole sections of `problem`.
inline sy_update Whole(std::uint32_t kinds, const Problem& problem) {
  sy_update update = Nothing();
  update.whole = kinds;
  update.problem = &problem.view();
  return update;
}

inline double LargestOf(const std::vector<double>& v) {
  double largest = 0;
  for (const double e : v) largest = std::max(largest, std::isfinite(e) ? std::abs(e) : 0.0);
  return largest;
}

/// The largest term that meets in a row or in stationarity is no larger; at least 1.
inline double SizeOf(const ProblemData& d, const Vectors& v) {
  const double matrix =
      std::max({1.0, LargestOf(d.P.value), LargestOf(d.A.value), LargestOf(d.F.value)});
  const double at = std::max(
      {LargestOf(v.x), LargestOf(v.x_dual), LargestOf(v.row_dual), LargestOf(v.cone_dual)});
  return std::max({1.0, matrix * at, LargestOf(d.q), LargestOf(d.g)});
}

/// Without the cones that are off, whose duals must be 0.
inline void DropConesThatAreOff(ProblemData& d, Vectors& at) {
  if (d.cone_on.empty()) return;
  std::vector<std::uint8_t> keep;
  for (std::size_t c = 0; c < d.cones.size(); ++c) {
    keep.insert(keep.end(), static_cast<std::size_t>(d.cones[c].dim), d.cone_on[c]);
  }
  for (std::size_t i = 0; i < keep.size() && !at.cone_dual.empty(); ++i) {
    if (keep[i] == 0) {
      EXPECT_EQ(at.cone_dual[i], 0) << "of a cone that is off";
    }
  }
  if (!at.cone_dual.empty()) at.cone_dual = Keep(at.cone_dual, keep);
  d.F = KeepRows(d.F, keep);
  d.g = Keep(d.g, keep);
  d.cones = Keep(d.cones, d.cone_on);
  d.cone_on.clear();
}

/// Multipliers up to `most` against an infinite side are 0: stationarity then lacks them.
inline void DropOpenDuals(const ProblemData& d, double most, Vectors& v) {
  const auto drop = [most](double lower, double upper, double& dual) {
    if (dual != 0 && std::isinf(dual > 0 ? lower : upper) && std::abs(dual) <= most) dual = 0;
  };
  for (std::size_t j = 0; j < v.x_dual.size(); ++j) {
    drop(d.x_lower.empty() ? -kInfinity : d.x_lower[j],
         d.x_upper.empty() ? kInfinity : d.x_upper[j], v.x_dual[j]);
  }
  for (std::size_t i = 0; i < v.row_dual.size(); ++i) {
    drop(d.row_lower[i], d.row_upper[i], v.row_dual[i]);
  }
}

/// Optimal, and shown to be so by what was returned, each of the sums over all variables, rows and
/// cones to `tolerance` beside its largest term.
inline void ExpectOptimal(const ProblemData& given, const Found& found, double tolerance = 1e-8) {
  ASSERT_EQ(found.result.termination, SY_OPTIMAL) << found.text;
  EXPECT_EQ(found.result.primal, SY_FEASIBLE);
  EXPECT_EQ(found.result.dual, SY_FEASIBLE);
  ProblemData d = given;
  Vectors at = found.at;
  DropConesThatAreOff(d, at);
  const double size = SizeOf(d, at);
  const double terms = 2 + d.num_vars + d.num_rows() + d.num_cone_rows();
  DropOpenDuals(d, 2 * tolerance * size, at);
  EXPECT_LE(testing::PrimalError(d, at.x), 2 * tolerance * size);
  EXPECT_LE(testing::OptimumError(d, at), tolerance * size * terms);
  const double objective = Objective(Problem(d).view(), found.at.x.data());
  EXPECT_NEAR(found.result.objective, objective, 1e-11 * size * terms);
  EXPECT_NEAR(found.result.bound, objective, 4 * tolerance * (1 + std::abs(objective)));
}

/// The objective of two optima to `tolerance`: what is left of rows is worth its multiplier.
inline void ExpectSameOptimum(const ProblemData& d, const Found& found, double optimum,
                              double tolerance = 1e-8) {
  const double size = SizeOf(d, found.at);
  EXPECT_NEAR(found.result.objective, optimum, 4 * tolerance * size * (1 + std::abs(optimum)));
}

inline void ExpectContradiction(const ProblemData& given, const Found& found) {
  ASSERT_EQ(found.result.termination, SY_INFEASIBLE) << found.text;
  EXPECT_EQ(found.result.dual, SY_CERTIFICATE);
  EXPECT_EQ(found.result.primal, SY_NO_POINT);
  ProblemData d = given;
  Vectors at = found.at;
  DropConesThatAreOff(d, at);
  EXPECT_LE(testing::ContradictionError(d, at), 1e-7);
}

inline void ExpectRay(const ProblemData& given, const Found& found) {
  ASSERT_EQ(found.result.termination, SY_UNBOUNDED) << found.text;
  EXPECT_EQ(found.result.primal, SY_CERTIFICATE);
  EXPECT_EQ(found.result.dual, SY_NO_POINT);
  ProblemData d = given;
  Vectors at;
  at.x = found.at.x;
  DropConesThatAreOff(d, at);
  EXPECT_LE(testing::RayError(d, at.x), 1e-6);
}

}  // namespace switchyard::conic
