// Some point of a set. Of a polyhedron by the dense simplex method; of others, successive
// projections on rows, and steps towards cones, find one of most sets in a few sweeps (Kaczmarz's
// method for inequalities: Agmon, Motzkin and Schoenberg, 1954); the rest is a program for a
// backend.
#include "core/sets/feasible_point.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/sets/section_lp.hpp"
#include "switchyard/error.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr int kSweeps = 50;
constexpr double kInside = 1e-9;         // absolute, per unit of the point's size
constexpr double kOverProjection = 1.5;  // beyond 1, so that an inner point is met in finitely many

Eigen::VectorXd Middle(const SetBox& box) {
  Eigen::VectorXd x(box.lower.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double l = box.lower[i];
    const double u = box.upper[i];
    if (std::isfinite(l) && std::isfinite(u)) {
      x[i] = 0.5 * (l + u);
    } else {
      x[i] = std::isfinite(l) ? l + 1 : std::isfinite(u) ? u - 1 : 0;
    }
  }
  return x;
}

/// One sweep over the rows l <= a'x <= u.
void Sweep(const Csc& by_rows, const ProblemData& d, Eigen::VectorXd& x) {
  for (std::int32_t i = 0; i < by_rows.cols; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const auto first = static_cast<std::size_t>(by_rows.start[row]);
    const auto last = static_cast<std::size_t>(by_rows.start[row + 1]);
    double value = 0;
    double square = 0;
    for (std::size_t k = first; k < last; ++k) {
      value += by_rows.value[k] * x[by_rows.row[k]];
      square += by_rows.value[k] * by_rows.value[k];
    }
    const double above = std::max(0.0, value - d.row_upper[row]);
    const double below = std::max(0.0, d.row_lower[row] - value);
    if (square == 0 || (above == 0 && below == 0)) continue;
    const bool equality = d.row_lower[row] == d.row_upper[row];
    const double step = (equality ? 1 : kOverProjection) * (below - above) / square;
    for (std::size_t k = first; k < last; ++k) x[by_rows.row[k]] += step * by_rows.value[k];
  }
}

/// One sweep over the second-order cones: for |s_w| > s_0 a step down the slope of |s_w| - s_0.
void SweepCones(const Csc& by_rows, const ProblemData& d, Eigen::VectorXd& x) {
  std::size_t next = 0;
  for (const sy_cone& cone : d.cones) {
    const auto dim = static_cast<std::size_t>(cone.dim);
    const std::size_t first = next;
    next += dim;
    std::vector<double> s(d.g.begin() + static_cast<std::ptrdiff_t>(first),
                          d.g.begin() + static_cast<std::ptrdiff_t>(first + dim));
    const auto entries = [&](std::size_t i, auto&& visit) {
      for (auto k = static_cast<std::size_t>(by_rows.start[first + i]);
           k < static_cast<std::size_t>(by_rows.start[first + i + 1]); ++k) {
        visit(by_rows.row[k], by_rows.value[k]);
      }
    };
    double square = 0;
    for (std::size_t i = 0; i < dim; ++i) {
      entries(i, [&](std::int32_t j, double value) { s[i] += value * x[j]; });
      if (i > 0) square += s[i] * s[i];
    }
    const double norm = std::sqrt(square);
    if (cone.kind != SY_CONE_SECOND_ORDER || norm <= s[0]) continue;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(x.size());
    for (std::size_t i = 0; i < dim; ++i) {
      const double weight = i == 0 ? -1 : s[i] / norm;
      entries(i, [&](std::int32_t j, double value) { slope[j] += weight * value; });
    }
    if (slope.squaredNorm() == 0) continue;
    x -= kOverProjection * (norm - s[0]) / slope.squaredNorm() * slope;
  }
}

std::optional<Eigen::VectorXd> ByProjections(const ConvexSet& set) {
  const ScaledSet& scaled = set.scaled();
  if (scaled.num_aux > 0) return std::nullopt;
  const SetBox& box = set.bounding_box();
  Eigen::VectorXd x = Middle(box);
  const ProblemData d = AtScaleOne(scaled);
  const Csc by_rows = Transpose(d.A.View());
  const Csc cone_rows = Transpose(d.F.View());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    if (set.PointInSet(x, kInside * (1 + x.lpNorm<Eigen::Infinity>()))) return x;
    if (d.A.rows == 0 && d.F.rows == 0) return std::nullopt;
    Sweep(by_rows, d, x);
    SweepCones(cone_rows, d, x);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Eigen::VectorXd> FeasiblePoint(const ConvexSet& set) {
  if (IsSmallPolyhedron(set.scaled())) {
    if (const PointByLp found = FeasiblePointByLp(set.scaled()); found.decided) return found.point;
  }
  if (set.bounding_box().empty) return std::nullopt;
  if (set.ambient_dimension() == 0) return Eigen::VectorXd();
  if (auto x = ByProjections(set)) return x;
  MathematicalProgram program;
  const VectorXDecisionVariable x = program.NewContinuousVariables(set.ambient_dimension());
  set.AddPointInSetConstraints(&program, x);
  const MathematicalProgramResult result = Solve(program);
  if (result.termination == Termination::kInfeasible) return std::nullopt;
  if (result.primal == PointKind::kFeasible) return result.GetSolution(x);
  throw std::runtime_error(Text("whether the set (", set.Kind(), ") is empty could not be told: ",
                                to_string(result.termination), ", ", result.message));
}

}  // namespace switchyard
