// switchyard/model/solver_options.hpp - what a user sets for a solve.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "switchyard/abi.h"
#include "switchyard/export.hpp"

namespace switchyard {

/// Names a backend: its id ("org.coin-or.clp") or short name ("clp").
class SWITCHYARD_EXPORT SolverId {
 public:
  SolverId() = default;
  explicit SolverId(std::string name) : name_(std::move(name)) {}
  [[nodiscard]] const std::string& name() const { return name_; }
  friend bool operator==(const SolverId&, const SolverId&) = default;
  friend auto operator<=>(const SolverId&, const SolverId&) = default;

 private:
  std::string name_;
};
inline const std::string& to_string(const SolverId& id) { return id.name(); }

/// Settings that Drake's users know by these names; the struct below has them as fields.
enum class CommonSolverOption {
  kPrintFileName,                   // log_file
  kPrintToConsole,                  // verbosity 1 instead of 0, and log_to_console
  kStandaloneReproductionFileName,  // problem_file
  kMaxThreads,                      // threads
};

/// What a solve reports while it runs; numbers that are not known are NaN, counts -1.
struct SolveProgress {
  double seconds = 0;
  std::int64_t iteration = -1;
  std::int64_t nodes = -1;
  std::int64_t open_nodes = -1;
  double objective = std::numeric_limits<double>::quiet_NaN();  // in the program's sense
  double bound = std::numeric_limits<double>::quiet_NaN();
  double primal_residual = std::numeric_limits<double>::quiet_NaN();
  double dual_residual = std::numeric_limits<double>::quiet_NaN();
  bool new_incumbent = false;
};

/// Settings that all backends share; what a backend does not keep is said in the result's notes.
/// NaN: the backend's own.
struct SWITCHYARD_EXPORT SolverOptions {
  using OptionValue = std::variant<double, int, std::string>;

  double time_limit = std::numeric_limits<double>::infinity();  // seconds of wall clock
  std::int64_t iteration_limit = std::numeric_limits<std::int64_t>::max();
  std::int64_t node_limit = std::numeric_limits<std::int64_t>::max();
  int threads = 0;              // 0: the cores allowed
  int verbosity = 0;            // of the log
  bool log_to_console = false;  // lines of the log to standard error
  std::string log_file;         // lines of the log are appended to it; "": nowhere
  std::string problem_file;     // the lowered problem is written there as JSON; "": nowhere
  double cutoff = std::numeric_limits<double>::quiet_NaN();  // in the program's sense
  double target = std::numeric_limits<double>::quiet_NaN();
  double feasibility_tolerance = std::numeric_limits<double>::quiet_NaN();
  double optimality_tolerance = std::numeric_limits<double>::quiet_NaN();
  double integrality_tolerance = std::numeric_limits<double>::quiet_NaN();
  double absolute_gap = std::numeric_limits<double>::quiet_NaN();
  double relative_gap = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t seed = 0;
  /// Called by the backend, one call at a time, from any thread; true: stop.
  std::function<bool(const SolveProgress&)> progress;
  /// Set from anywhere to stop the solve.
  const std::atomic<bool>* cancelled = nullptr;
  /// A backend's own options by backend ("": whichever is chosen) and name.
  std::map<std::string, std::map<std::string, OptionValue>> options;

  void SetOption(const SolverId& solver, const std::string& key, OptionValue value) {
    options[solver.name()][key] = std::move(value);
  }
  /// Throws InvalidArgument for a value of another type.
  void SetOption(CommonSolverOption key, const OptionValue& value);
  /// What is unset here is taken from `other`.
  void Merge(const SolverOptions& other);
};

}  // namespace switchyard
