// solvers/conic/run.hpp - one solve of a problem that was made ready.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "solvers/conic/answer_check.hpp"
#include "solvers/conic/interior_point.hpp"
#include "solvers/conic/options.hpp"
#include "solvers/conic/prepared.hpp"
#include "switchyard/abi.h"
#include "switchyard/boxes.hpp"

namespace switchyard::conic {

/// Follows the method within the budget of a sy_control, holds what it finds against the problem as
/// it was given, and writes the answer.
class Run {
 public:
  Run(const Problem& problem, Prepared& prepared, const Options& options, const sy_host& host,
      const sy_control& control);

  /// `from`: an iterate near which the solution may be; or nullptr.
  void Solve(const Iterate* from);
  /// The last iterate, where it came to an optimum.
  [[nodiscard]] const std::optional<Iterate>& optimum() const { return optimum_; }
  void Write(sy_result& result) const;

 private:
  bool Watch(int iteration, const Iterate& at, const Distance& distance);
  bool Judge(Ending ending, const Iterate& at);
  bool JudgePoint(const Iterate& at);
  bool ProvesCutoff(const Iterate& at, const Distance& distance);
  bool Tell(int iteration, const Distance& distance) const;
  void Log(int iteration, const Iterate& at, const Distance& distance) const;
  void Conclude(Solution found);
  void ConcludeOptimal(Iterate at);
  void ScaleToWorth();
  void Describe();
  [[nodiscard]] double Seconds() const;
  [[nodiscard]] sy_point_kind KindOf(double error) const;

  const Problem& problem_;
  Prepared& prepared_;
  const Options& options_;
  const sy_host& host_;
  const sy_control& control_;
  const std::chrono::steady_clock::time_point begin_;
  double tolerance_;

  std::optional<sy_termination> stopped_;  // by the watch
  struct BelowCutoff {
    Boxes boxes;                    // that hold it all
    std::vector<double> curvature;  // of P: see SafeDualBound
  };
  std::optional<BelowCutoff> below_;
  std::optional<Iterate> optimum_;
  presolve::Answer answer_;
  AnswerErrors errors_;
  bool has_answer_ = false;
  double proven_ = -kInfinity;  // bound
  sy_termination termination_ = SY_NOT_SOLVED;
  int iterations_ = 0;
  std::string text_;
};

}  // namespace switchyard::conic
