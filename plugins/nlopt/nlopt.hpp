// nlopt.hpp - NLopt behind the table of switchyard/abi.h.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "linear/watch.hpp"
#include "options.hpp"
#include "search.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::nlopt {

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
  void Complete();
  void Report(const Found& found, sy_result& result) const;
  void ReportPoint(const Found& found, sy_result& result) const;

  const sy_host& host_;
  Problem problem_;  // with all its bounds, and an nlp only where that says something
  Options options_;
  std::vector<double> start_;
  bool start_is_new_ = false;
  std::vector<double> last_;  // where the last solve ended
};

}  // namespace switchyard::nlopt
