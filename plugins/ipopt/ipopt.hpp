// ipopt.hpp - Ipopt behind the table of switchyard/abi.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "answer.hpp"
#include "functions.hpp"
#include "nlp.hpp"
#include "options.hpp"
#include "run.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::ipopt {

class Solver {
 public:
  static sy_solver Describe();
  static void Supports(const sy_host& host, const sy_problem& problem);
  explicit Solver(const sy_host& host) : host_(host) {}

  void SetOption(std::string_view name, const sy_value& value) { options_.Set(name, value); }
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Update(const sy_update& update);
  void WarmStart(const sy_start& start);
  void Solve(const sy_control& control, sy_result& result);

 private:
  void FillBounds();
  [[nodiscard]] bool convex() const;
  const Point& Begin(bool proceed);
  bool AnswerConstants(const sy_control& control, Functions& functions, sy_result& result) const;
  [[nodiscard]] sy_termination Reason(const Found& found, const std::optional<Measured>& at,
                                      const Functions& functions, const sy_control& control) const;
  void Report(Found found, Functions& functions, const Session& session, sy_result& result);
  void ReportPoint(const Measured& at, const sy_control& control, sy_result& result) const;
  void SeekProof(const Session& session, sy_result& result) const;
  void SeekUnboundedness(const Session& session, sy_result& result) const;

  const sy_host& host_;
  Problem problem_;  // with all its bounds
  Options options_;
  Point start_;
  bool start_is_new_ = false;
  Point last_;  // where the last solve ended
};

}  // namespace switchyard::ipopt
