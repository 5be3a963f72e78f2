// ipopt.hpp - Ipopt behind the table of switchyard/abi.h.
#pragma once

#include <cstdint>
#include <string_view>

#include "linear/duals.hpp"
#include "linear/watch.hpp"
#include "nlp.hpp"
#include "options.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::ipopt {

class Solver {
 public:
  static sy_solver Describe();
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
  bool AnswerConstants(const sy_control& control, sy_result& result) const;
  [[nodiscard]] sy_termination Reason(const Found& found, const linear::Watch& watch) const;
  void Report(Found found, linear::Watch& watch, sy_result& result);
  void ReportPoint(const Point& point, sy_result& result) const;
  void SeekProof(linear::Watch& watch, sy_result& result);

  const sy_host& host_;
  Problem problem_;  // with all its bounds
  Options options_;
  Point start_;
  bool start_is_new_ = false;
  Point last_;  // where the last solve ended
};

}  // namespace switchyard::ipopt
