// switchyard/solve/solve.hpp - a program solved by whatever backend is there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/model/solver_options.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// Solves with the best backend for the program. What a solve finds is a value, also that no
/// backend serves (kNoBackend); a mistake in the options throws InvalidArgument.
SWITCHYARD_EXPORT MathematicalProgramResult
Solve(const MathematicalProgram& program,
      const std::optional<Eigen::VectorXd>& initial_guess = std::nullopt,
      const SolverOptions& options = {});

/// A handle on a backend, or on an order of preference among backends. A value: it holds names.
class SWITCHYARD_EXPORT SolverInterface final {
 public:
  /// `names`: ids or short names in order of preference, comma-separated; "": the best for each
  /// program. `host` must outlive the handle.
  explicit SolverInterface(std::string names = "", Host& host = Host::Default());

  /// Is one of the backends there and ready?
  [[nodiscard]] bool available() const;
  [[nodiscard]] bool enabled() const { return available(); }
  [[nodiscard]] SolverId solver_id() const { return SolverId(names_); }
  /// Does one of the backends take this program? `why` receives the reasons where none does.
  [[nodiscard]] bool Accepts(const MathematicalProgram& program, std::string* why = nullptr) const;
  [[nodiscard]] bool AreProgramAttributesSatisfied(const MathematicalProgram& program) const {
    return Accepts(program);
  }
  /// "" where it is accepted.
  [[nodiscard]] std::string ExplainUnsatisfiedProgramAttributes(
      const MathematicalProgram& program) const;
  [[nodiscard]] MathematicalProgramResult Solve(
      const MathematicalProgram& program,
      const std::optional<Eigen::VectorXd>& initial_guess = std::nullopt,
      const SolverOptions& options = {}) const;
  void Solve(const MathematicalProgram& program,
             const std::optional<Eigen::VectorXd>& initial_guess,
             const std::optional<SolverOptions>& options, MathematicalProgramResult* result) const;

 private:
  std::string names_;
  Host* host_;
};

/// A program loaded into a backend, solved again after changes of its numbers: coefficients,
/// bounds and constants reach the backend as an update where it takes one. The program must outlive
/// the session. One thread at a time; sessions are independent.
class SWITCHYARD_EXPORT SolverSession {
 public:
  explicit SolverSession(const MathematicalProgram& program, std::string names = "",
                         const SolverOptions& options = {}, Host& host = Host::Default());
  SolverSession(SolverSession&&) noexcept;
  ~SolverSession();

  /// Looks at the program again; solves. The backend may start where it last ended.
  MathematicalProgramResult Solve(const std::optional<Eigen::VectorXd>& initial_guess = {});
  /// How often the problem was handed over whole, and how often as an update.
  [[nodiscard]] int num_loads() const;
  [[nodiscard]] int num_updates() const;
  /// Writes the lowered problem as JSON, for a bug report.
  void Dump(const std::string& path) const;

 private:
  friend class SolverInterface;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace switchyard
