// solvers/conic/prepared.hpp - a problem made ready for the interior-point method.
#pragma once

#include <memory>

#include "solvers/conic/form.hpp"
#include "solvers/conic/interior_point.hpp"
#include "solvers/conic/kkt.hpp"
#include "solvers/conic/options.hpp"
#include "solvers/presolve/presolve.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::conic {

/// Presolved, formed, the symbolic phase of its equations done; and the way back.
class Prepared {
 public:
  /// Borrows the problem. `hinted_vars`: as many variables as its hints know of. `updates`: the
  /// SY_UPDATES_* to come: what these may change is not presolved away, so that the pattern stays.
  /// `before`, if any: where its pattern is the same, its symbolic phase is shared.
  Prepared(const ProblemData& problem, Index hinted_vars, const Options& options,
           std::uint64_t updates, const Prepared* before);

  [[nodiscard]] const Form& form() const { return form_; }
  [[nodiscard]] Kkt& kkt() { return *kkt_; }
  [[nodiscard]] const Kkt& kkt() const { return *kkt_; }
  [[nodiscard]] const presolve::Presolve& presolve() const { return presolve_; }
  [[nodiscard]] bool shares_symbolic_phase() const { return shares_; }

  /// In the problem as it was given.
  [[nodiscard]] presolve::Answer Back(const Iterate& at, presolve::Meaning meaning) const;

 private:
  [[nodiscard]] Blocks BlocksOf(const ProblemData& problem, Index hinted_vars) const;

  presolve::Presolve presolve_;
  Form form_;
  std::unique_ptr<Kkt> kkt_;
  bool shares_ = false;
};

}  // namespace switchyard::conic
