// proofs.hpp - proofs that there is no solution, which Ipopt's own verdicts are not.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "linear/duals.hpp"
#include "run.hpp"

namespace switchyard::ipopt {

/// What a search for a proof came to, and the iterations it took.
struct Feasibility {
  std::optional<linear::Duals> farkas;
  bool has_point = false;  // rows and bounds hold somewhere, within the tolerance
  std::int64_t iterations = 0;
};
struct Recession {
  std::optional<std::vector<double>> ray;
  std::int64_t iterations = 0;
};

/// A row whose variables are all fixed and whose value is outside its sides, as a certificate.
std::optional<linear::Duals> ContradictionOfConstants(const sy_problem& problem, double tolerance);

/// Minimizes the sum of the violations of the rows within the bounds: where that is positive, the
/// row duals are a Farkas certificate. Without the functions, which a contradiction does not need.
Feasibility SeekFarkas(const sy_problem& problem, const Session& session, std::int64_t before);

/// Minimizes q'd over the directions in which bounds and rows recede, Pd = 0 and |d_j| <= 1: where
/// that is negative, d is a ray. The problem has no functions.
Recession SeekRay(const sy_problem& problem, const Session& session, std::int64_t before);

}  // namespace switchyard::ipopt
