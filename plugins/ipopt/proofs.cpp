#include "proofs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "switchyard/problem.hpp"

namespace switchyard::ipopt {
namespace {

// Below this a sum of violations, or a slope of a direction of largest entry 1, is 0.
constexpr double kNothing = 1e-7;

/// Rows and bounds of `p` with violations: row + u - v in its sides, u, v >= 0 where the side is
/// finite, and the objective sum u + sum v.
ProblemData Elastic(const sy_problem& p) {
  ProblemData e(p);
  e.flags = SY_PROBLEM_CONVEX;
  e.nlp = nullptr;
  std::fill(e.q.begin(), e.q.end(), 0.0);
  e.offset = 0;
  const auto violation = [&e](std::int32_t row, double sign) {
    e.A.row.push_back(row);
    e.A.value.push_back(sign);
    e.A.start.push_back(static_cast<std::int32_t>(e.A.row.size()));
    e.q.push_back(1);
    e.x_lower.push_back(0);
    e.x_upper.push_back(kInfinity);
    ++e.num_vars;
  };
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    if (std::isfinite(p.row_lower[i])) violation(i, 1);
    if (std::isfinite(p.row_upper[i])) violation(i, -1);
  }
  e.A.cols = e.num_vars;
  e.P = Csc(e.num_vars, e.num_vars);
  return e;
}

/// The whole of a symmetric matrix whose upper triangle is given.
Csc BothTriangles(const sy_csc& upper) {
  const Csc lower = Transpose(upper);
  Csc both(upper.cols, upper.cols);
  for (std::int32_t j = 0; j < upper.cols; ++j) {
    const auto column = static_cast<std::size_t>(j);
    both.row.insert(both.row.end(), upper.row + upper.start[j], upper.row + upper.start[j + 1]);
    both.value.insert(both.value.end(), upper.value + upper.start[j],
                      upper.value + upper.start[j + 1]);
    for (auto k = static_cast<std::size_t>(lower.start[column]);
         k < static_cast<std::size_t>(lower.start[column + 1]); ++k) {
      if (lower.row[k] == j) continue;
      both.row.push_back(lower.row[k]);
      both.value.push_back(lower.value[k]);
    }
    both.start[column + 1] = static_cast<std::int32_t>(both.row.size());
  }
  return both;
}

/// 0 where a side is finite, `otherwise` where it is not.
void Recede(std::vector<double>& sides, double otherwise) {
  for (double& side : sides) side = std::isfinite(side) ? 0 : otherwise;
}

ProblemData Directions(const sy_problem& p) {
  ProblemData d(p);
  double largest = 0;
  for (const double q : d.q) largest = std::max(largest, std::abs(q));
  for (double& q : d.q) q /= std::max(largest, 1.0);
  d.flags = SY_PROBLEM_CONVEX;
  d.offset = 0;
  Recede(d.x_lower, -1);
  Recede(d.x_upper, 1);
  Recede(d.row_lower, -kInfinity);
  Recede(d.row_upper, kInfinity);
  d.P = Csc(d.num_vars, d.num_vars);
  if (p.P == nullptr) return d;
  d.A = StackRows(d.A, BothTriangles(*p.P));
  d.row_lower.resize(d.row_lower.size() + static_cast<std::size_t>(p.num_vars), 0.0);
  d.row_upper.resize(d.row_lower.size(), 0.0);
  return d;
}

bool Solved(const Found& found) {
  return found.has_point && (found.status == Ipopt::Solve_Succeeded ||
                             found.status == Ipopt::Solved_To_Acceptable_Level);
}

}  // namespace

std::optional<linear::Duals> ContradictionOfConstants(const sy_problem& p, double tolerance) {
  const auto rows = static_cast<std::size_t>(p.num_rows);
  std::vector<double> value(rows, 0.0);
  std::vector<double> size(rows, 0.0);
  std::vector<std::uint8_t> constant(rows, 1);
  for (std::int32_t j = 0; p.A != nullptr && j < p.num_vars; ++j) {
    const bool fixed = p.x_lower[j] == p.x_upper[j];
    for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(p.A->row[k]);
      if (fixed) {
        value[i] += p.A->value[k] * p.x_lower[j];
        size[i] += std::abs(p.A->value[k] * p.x_lower[j]);
      } else if (p.A->value[k] != 0) {
        constant[i] = 0;
      }
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    const double slack = tolerance * (1 + size[i]);
    const bool below = value[i] < p.row_lower[i] - slack;
    if (constant[i] == 0 || (!below && value[i] <= p.row_upper[i] + slack)) continue;
    std::vector<double> ray(rows, 0.0);
    ray[i] = below ? 1 : -1;
    return linear::Farkas(p, std::move(ray));
  }
  return std::nullopt;
}

Feasibility SeekFarkas(const sy_problem& problem, const Session& session, std::int64_t before) {
  const Problem elastic(Elastic(problem));
  Functions none(elastic.view(), session.watch);
  const Found found = Run(elastic.view(), none, {}, session, before);
  Feasibility answer{std::nullopt, false, found.iterations};
  if (!Solved(found)) return answer;
  const double violation = Objective(elastic.view(), found.point.x.data());
  answer.has_point = violation <= kNothing;
  if (!answer.has_point) answer.farkas = linear::Farkas(problem, found.point.row_dual);
  return answer;
}

Recession SeekRay(const sy_problem& problem, const Session& session, std::int64_t before) {
  const Problem directions(Directions(problem));
  Functions none(directions.view(), session.watch);
  const Found found = Run(directions.view(), none, {}, session, before);
  Recession answer{std::nullopt, found.iterations};
  if (Solved(found) && Objective(directions.view(), found.point.x.data()) < -kNothing) {
    answer.ray = linear::FallingRay(problem, found.point.x);
  }
  return answer;
}

}  // namespace switchyard::ipopt
