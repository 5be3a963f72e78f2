// core/solve/control.hpp - a user's options as the record of one solve.
#pragma once

#include <exception>

#include "switchyard/abi.h"
#include "switchyard/model/solver_options.hpp"

namespace switchyard {

/// Holds what a sy_control refers to: stays in place while one is in use.
class SolveControl {
 public:
  /// `maximize`: the problem is the negative of what the user sees.
  SolveControl(const SolverOptions& options, bool maximize)
      : options_(options), maximize_(maximize) {}
  SolveControl(const SolveControl&) = delete;
  SolveControl& operator=(const SolveControl&) = delete;

  /// For a solve that may take `seconds`; `proceed`: it may start where the last one ended.
  [[nodiscard]] sy_control Record(double seconds, bool proceed);
  /// What the user's progress function threw, once the solve is over.
  void RethrowWhatWasThrown();

 private:
  [[nodiscard]] double InProblemSense(double value, double unset) const;
  bool Report(const sy_progress& progress);

  const SolverOptions& options_;
  bool maximize_;
  std::exception_ptr thrown_;
};

}  // namespace switchyard
