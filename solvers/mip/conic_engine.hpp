// solvers/mip/conic_engine.hpp - nodes bounded by the problem's own continuous relaxation.
#pragma once

#include <list>
#include <string>
#include <vector>

#include "solvers/mip/engine.hpp"
#include "solvers/mip/reduced_problem.hpp"
#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/budget.hpp"

namespace switchyard::mip {

class ConicEngine : public Engine {
 public:
  /// Borrows both, which stay in place. `relaxation`: the problem, perhaps without bounds of
  /// continuous variables that rows and cones imply. `solver`: of the host's, for it.
  ConicEngine(const sy_problem& problem, const sy_problem& relaxation, const sy_solver& solver,
              const sy_host& host, rounding::Budget& budget);

  Relaxed Solve(const NodeBoxes& boxes, double cutoff, int rounds) override;
  /// Likewise, as accurately as the backend can: for a last node, whose bound is all there is. The
  /// backend is told the boxes of integers and what is fixed, or those of all variables.
  Relaxed SolveFinely(const NodeBoxes& boxes, double cutoff, bool in_all_boxes);
  Relaxed Glance(const NodeBoxes& boxes, double cutoff) override { return Solve(boxes, cutoff, 0); }
  [[nodiscard]] std::string Name() const override { return solver_.id; }
  [[nodiscard]] sy_termination last_termination() const { return last_termination_; }

 private:
  /// What a part of the tree has left of the relaxation, loaded.
  struct Part {
    Part(const sy_problem& whole, const std::vector<double>& lower,
         const std::vector<double>& upper, const sy_solver& solver, const sy_host& host)
        : problem(whole, lower, upper), loaded(solver, host, problem.view(), SY_UPDATES_BOUNDS) {}
    ReducedProblem problem;
    rounding::Loaded loaded;
  };

  void SetBoxes(const NodeBoxes& boxes, bool all);
  Part* SmallestPart();
  rounding::Answer Ask(const sy_control& control);
  Relaxed Judge(const rounding::Answer& answer, const NodeBoxes& boxes, double cutoff);

  sy_problem problem_;
  sy_problem relaxation_;
  const sy_solver& solver_;
  const sy_host& host_;
  rounding::Budget& budget_;
  std::vector<double> lower_, upper_;  // what the backend is given
  rounding::Loaded loaded_;            // the whole relaxation
  std::list<Part> parts_;              // the one that was needed last in front
  Part* part_ = nullptr;               // at hand; nullptr: the whole
  sy_termination last_termination_ = SY_NOT_SOLVED;
};

}  // namespace switchyard::mip
