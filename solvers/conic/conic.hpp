// solvers/conic/conic.hpp - the interior-point method as a backend.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "solvers/conic/options.hpp"
#include "solvers/conic/prepared.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::conic {

/// For switchyard/plugin.hpp: continuous convex problems over all cones of abi.h.
///
///   SY_OPTIMAL            residuals and gap within the tolerance (1e-8 where none is given), in
///   the
///                         problem as it was given; the bound is the dual objective
///   SY_INFEASIBLE, SY_UNBOUNDED   with a certificate that holds there
///   SY_CUTOFF             the safe bound has passed the cutoff
///   a limit's, SY_NUMERICAL_TROUBLE   with the best iterate, x_dual such that its dual objective
///                         bounds the optimum where no side is infinite, and the safe bound
class Conic {
 public:
  static sy_solver Describe();
  static void Supports(const sy_host& host, const sy_problem& problem);
  explicit Conic(const sy_host& host) : host_(host) {}

  void SetOption(std::string_view name, const sy_value& value);
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Update(const sy_update& update);
  /// Keeps x and the duals that are given for the next solves, as far as cones are symmetric and
  /// none of x and of the duals of rows and cones is missing.
  void WarmStart(const sy_start& start);
  void Solve(const sy_control& control, sy_result& result);
  [[nodiscard]] std::unique_ptr<Conic> Clone() const;

  /// Did the last update or clone do without a symbolic phase of its own?
  [[nodiscard]] bool shares_symbolic_phase() const { return prepared_->shares_symbolic_phase(); }

 private:
  void Prepare();
  [[nodiscard]] std::optional<Iterate> Given() const;

  const sy_host& host_;
  Options options_;
  std::uint64_t updates_ = 0;
  Problem problem_;
  Index hinted_vars_ = 0;
  bool stale_ = false;  // an option asks for another `prepared_`
  std::unique_ptr<Prepared> prepared_;
  std::optional<presolve::Answer> given_;  // by warm_start, of the whole problem
  std::optional<Iterate> last_;  // where the last solve ended, in the units of `prepared_`
};

}  // namespace switchyard::conic
