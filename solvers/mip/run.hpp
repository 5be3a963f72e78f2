// solvers/mip/run.hpp - one solve of branch and bound: the root, the workers, the verdict.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solvers/mip/instance.hpp"
#include "solvers/mip/shared.hpp"
#include "solvers/mip/worker.hpp"
#include "solvers/rounding/budget.hpp"

namespace switchyard::mip {

class Run {
 public:
  /// Borrows all; `start` may be empty, or have NaNs.
  Run(const rounding::IntegerProblem& whole, const rounding::PathProblem* paths,
      const Options& options, const sy_host& host, const sy_control& control,
      const std::vector<double>& start);

  void Solve();
  void Write(sy_result& result) const;
  [[nodiscard]] std::vector<Solution> Pool() const { return shared_.incumbents().all(); }

 private:
  bool Tighten();
  void Probe();
  bool Relax();
  void ChooseEngine();
  void TakeStart();
  void Dive();
  void Search();
  void Work(std::size_t index) noexcept;
  void SearchInRounds();
  void Conclude();
  void Finish(sy_termination termination, const std::string& why);
  void OfferIfFeasible(std::vector<double> x);
  [[nodiscard]] const sy_problem& problem() const { return whole_.problem(); }

  const rounding::IntegerProblem& whole_;
  const rounding::PathProblem* paths_;
  const Options& options_;
  const sy_host& host_;
  const std::vector<double>& start_;
  rounding::Budget budget_;
  Propagator propagator_;
  Workspace workspace_;
  Shared shared_;
  Instance instance_;
  std::optional<OuterModel> outer_;
  std::size_t workers_ = 1;

  Relaxed root_;  // the problem's own relaxation
  double root_bound_ = -kInfinity;
  std::string engine_;
  sy_termination termination_ = SY_NOT_SOLVED;
  std::string text_;
};

}  // namespace switchyard::mip
