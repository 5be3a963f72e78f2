// solvers/mip/outer_engine.hpp - nodes bounded by a linear problem with cuts, by a simplex method
// that goes on where it was.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solvers/mip/engine.hpp"
#include "solvers/mip/outer_model.hpp"
#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/budget.hpp"

namespace switchyard::mip {

class OuterEngine : public Engine {
 public:
  /// Borrows the model. `solver`: of the host's, for linear problems.
  OuterEngine(const OuterModel& model, const sy_solver& solver, const sy_host& host,
              rounding::Budget& budget);

  Relaxed Solve(const NodeBoxes& boxes, double cutoff, int rounds) override;
  Relaxed Glance(const NodeBoxes& boxes, double cutoff) override;
  void See(const std::vector<double>& x) override;
  [[nodiscard]] std::string Name() const override { return solver_.id; }
  [[nodiscard]] std::size_t num_cuts() const { return cuts_.size(); }

 private:
  void SetBoxes(const NodeBoxes& boxes);
  Relaxed SolveOnce(const NodeBoxes& boxes, double cutoff, std::int64_t iterations);
  Relaxed Judge(const rounding::Answer& answer, const NodeBoxes& boxes, double cutoff);
  /// Cuts that the last point asks for; were there any?
  bool Tighten();
  void Append(std::vector<Cut> cuts);
  void Forget();

  const OuterModel& model_;
  const sy_solver& solver_;
  rounding::Budget& budget_;
  std::optional<rounding::Loaded> loaded_;
  std::vector<double> lower_, upper_;  // of the linear problem's columns
  std::vector<double> point_;          // the last one, of all columns
  std::vector<Cut> cuts_;              // behind the model's rows
  std::vector<int> idle_;              // solves since each had a dual
};

}  // namespace switchyard::mip
