// clp.hpp - CLP behind the table of switchyard/abi.h.
#pragma once

#include <cstdint>
#include <string_view>

#include "ClpSimplex.hpp"
#include "coin/clp_watch.hpp"
#include "coin/host_log.hpp"
#include "linear/duals.hpp"
#include "linear/settings.hpp"
#include "linear/start.hpp"
#include "switchyard/abi.h"

namespace switchyard::clp {

class Solver {
 public:
  static sy_solver Describe();
  explicit Solver(const sy_host& host);

  void SetOption(std::string_view name, const sy_value& value) { settings_.Set(name, value); }
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Update(const sy_update& update);
  void WarmStart(const sy_start& start);
  void Solve(const sy_control& control, sy_result& result);

 private:
  /// How one call of CLP goes about it.
  enum class Way {
    kPresolved,  // from nothing
    kPlain,      // from nothing, without presolve: leaves rays
    kDual        // from the basis that is there
  };

  void TakeWhole(const sy_problem& problem, std::uint32_t kinds);
  void TakeValues(const sy_csc& a);
  void Append(const sy_more& more);

  void Configure(const sy_control& control);
  Way Begin(bool proceed);
  void Run(Way way, coin::ClpSession& session);
  void RunToCutoff(Way way, coin::ClpSession& session, double cutoff);
  [[nodiscard]] double Bound();
  [[nodiscard]] sy_termination Reason(const linear::Watch& watch) const;
  void Report(const linear::Watch& watch, sy_result& result);
  void ReportBasis(sy_result& result) const;

  const sy_host& host_;
  coin::HostLog log_;
  ClpSimplex model_;
  linear::Settings settings_;
  linear::Start start_;
  bool start_is_new_ = false;
  bool solved_ = false;        // a basis is left from an earlier solve
  bool may_presolve_ = false;  // no update will follow
  bool met_cutoff_ = false;
};

}  // namespace switchyard::clp
