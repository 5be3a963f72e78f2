// solvers/rounding/backend.hpp - a solver of the host's, as a strategy uses it: asked for by the
// shape of a problem, given one problem, solved once.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {

/// What a backend found, by value. Its word is not yet taken for anything.
struct Answer {
  sy_termination termination = SY_NOT_SOLVED;
  sy_point_kind primal = SY_NO_POINT;
  sy_point_kind dual = SY_NO_POINT;
  std::int64_t iterations = 0;
  std::vector<double> x, x_dual, row_dual, cone_dual;
  std::string text;
};

/// The host's best for a problem of this shape among `names` (NULL: any): one that gives duals
/// where there is one, and better with `traits` too. `updates`: kinds to come. Throws Failure
/// (SY_E_UNSUPPORTED) with the host's reasons where none will.
const sy_solver& FindBackend(const sy_host& host, const sy_problem& problem, const char* names,
                             std::int64_t instances, std::uint64_t updates = 0,
                             std::uint64_t traits = 0);

/// Solves `problem` once by an instance of its own: from nothing, or from an answer to a problem of
/// which it is an extension, variables and rows behind. Throws Failure with the backend's id and
/// words where a call fails.
Answer SolveBy(const sy_solver& solver, const sy_host& host, const sy_problem& problem,
               const sy_control& control, const Answer* from = nullptr);

/// A problem in an instance of its own, solved again and again under other bounds of its variables.
/// It is borrowed and stays in place. Calls throw Failure as SolveBy does.
class Loaded {
 public:
  /// `updates`: the kinds to come.
  Loaded(const sy_solver& solver, const sy_host& host, const sy_problem& problem,
         std::uint64_t updates);
  /// By an update of those that differ where the backend takes one, else by another load.
  void SetBounds(const std::vector<double>& lower, const std::vector<double>& upper);
  /// Rows lower <= At'x behind the others, a column of At for each.
  void AppendRows(const Csc& At, const std::vector<double>& lower);
  /// Ascending; the rows behind move up.
  void RemoveRows(const std::vector<std::int32_t>& rows);
  /// From an answer to a problem of which this is an extension, variables and rows behind. A start
  /// that is not taken is no failure.
  void StartFrom(const Answer& answer);
  Answer Solve(const sy_control& control);

 private:
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Update(const sy_update& update);

  const sy_solver& solver_;
  std::unique_ptr<sy_instance, void (*)(sy_instance*) noexcept> instance_;
  sy_problem problem_;
  std::vector<double> lower_, upper_;                // that the instance has
  std::vector<double> loaded_lower_, loaded_upper_;  // that problem_ points to after another load
};

}  // namespace switchyard::rounding
