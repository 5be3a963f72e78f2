// core/solve/solve_log.hpp - the lines that backends write during the solves of one session, where
// its user wants them.
#pragma once

#include <cstdio>
#include <memory>
#include <mutex>
#include <string>

#include "switchyard/host/host.hpp"
#include "switchyard/model/solver_options.hpp"

namespace switchyard {

/// A host's table whose log also reaches a file or standard error. It outlives the instances that
/// were given it.
class SolveLog {
 public:
  /// Throws InvalidArgument where the file cannot be written.
  SolveLog(const Host& host, const SolverOptions& options);
  SolveLog(const SolveLog&) = delete;
  SolveLog& operator=(const SolveLog&) = delete;

  [[nodiscard]] const sy_host& table() const { return wanted_ ? table_ : host_; }

 private:
  void Write(sy_level level, const char* text);

  const sy_host& host_;
  sy_host table_{};
  bool wanted_ = false;
  bool to_console_ = false;
  std::mutex writing_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace switchyard
