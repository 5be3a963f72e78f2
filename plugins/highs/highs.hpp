// highs.hpp - HiGHS behind the table of switchyard/abi.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Highs.h"
#include "linear/duals.hpp"
#include "linear/start.hpp"
#include "linear/watch.hpp"
#include "options.hpp"
#include "switchyard/abi.h"
#include "worker.hpp"

namespace switchyard::highs {

/// Fails with the backend's word where a call of HiGHS did.
void Must(HighsStatus status, const char* what);

/// A problem's P, an upper triangle by columns, as the lower triangle that HiGHS takes.
HighsHessian LowerTriangle(const sy_csc* p, std::int32_t num_vars);

/// The model that HiGHS holds, as a problem; borrows it.
struct ModelView {
  explicit ModelView(const HighsModel& model);
  sy_csc A;
  Csc P;
  sy_csc p;
  sy_problem problem;

 private:
  HighsSparseMatrix by_columns_;  // where the model stands by rows
};

/// A Farkas certificate of a model whose quadratic part is ignored; within the watch's budget.
std::optional<linear::Duals> FindFarkas(const HighsModel& model, const HighsOptions& options,
                                        const sy_host& host, linear::Watch& watch);
/// A direction of recession in which the objective falls and its curvature is 0.
std::optional<std::vector<double>> FindRay(const HighsModel& model, const HighsOptions& options,
                                           const sy_host& host, linear::Watch& watch);

/// Lets `watch` stop `solver`, hears what it finds, and sends its log to the host.
void Attach(Highs& solver, linear::Watch& watch, const sy_host& host);

class Solver {
 public:
  static sy_solver Describe();
  explicit Solver(const sy_host& host);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void SetOption(std::string_view name, const sy_value& value);
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Update(const sy_update& update);
  void WarmStart(const sy_start& start);
  void Solve(const sy_control& control, sy_result& result);

 private:
  void TakeWhole(const sy_problem& problem, std::uint32_t kinds);
  void TakeValues(const sy_problem& problem);
  void Remove(const sy_update& update);
  void Append(const sy_more& more);

  void Run(linear::Watch& watch, sy_result& result);
  void Begin(bool proceed);
  void EndTime();
  sy_termination Reason(const linear::Watch& watch) const;
  void Report(linear::Watch& watch, sy_result& result);
  void ReportDuals(const ModelView& view, sy_result& result);
  void ReportCertificate(const ModelView& view, linear::Watch& watch, sy_result& result);
  void ReportBasis(sy_result& result) const;
  [[nodiscard]] bool has_integers() const { return highs_->getLp().isMip(); }

  const sy_host& host_;
  Worker worker_;                 // HiGHS keeps a scheduler of tasks for each calling thread
  std::unique_ptr<Highs> highs_;  // lives and is used on the worker
  Options options_;
  linear::Start start_;
  bool start_is_new_ = false;
  int threads_ = 0;  // of the scheduler; 0: not started
};

}  // namespace switchyard::highs
