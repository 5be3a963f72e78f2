// search.hpp - runs of NLopt, one from where the other ended, until a point stands the plugin's own
// test: that NLopt says it has converged is not enough.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "judge.hpp"
#include "linear/duals.hpp"
#include "linear/watch.hpp"
#include "options.hpp"
#include "program.hpp"
#include "run.hpp"

namespace switchyard::nlopt {

/// What a search came to.
struct Found {
  sy_termination termination = SY_NOT_SOLVED;
  std::string words;  // what is to be said of it, and the runs
  Measured point;
  bool feasible = false;
  bool stationary = false;
  std::optional<linear::Duals> farkas;
  std::optional<std::vector<double>> ray;
};

class Search {
 public:
  /// Borrows all; the problem has all its bounds and q.
  Search(const sy_problem& problem, const Options& options, const sy_host& host,
         linear::Watch& watch);

  /// From x, NaN where unknown; empty where nobody has said where to begin. Throws Failure where
  /// the algorithm that was asked for cannot take the program.
  Found Go(const std::vector<double>& x);

  [[nodiscard]] std::int64_t evaluations() const { return program_.evaluations(); }

 private:
  void GoByGradients(const Order& first, bool given);
  void GoWithoutGradients(const Order& first);
  bool BreaksConstants();

  bool Step(const Order& order, const std::vector<double>& from);
  bool Step(const Order& order) { return Step(order, std::vector<double>(found_.point.x)); }
  [[nodiscard]] bool Converged() const;
  [[nodiscard]] const char* Words() const;
  void Log(const std::string& line) const;
  bool Halted();
  bool Solved();
  bool Regain();
  bool HasNoFeasiblePoint();
  bool HasRay();
  bool ViolationIsStationary(const std::vector<double>& x);

  void Keep(const std::vector<double>& x) { judge_.Keep(x, found_.point); }
  [[nodiscard]] bool IsFeasible() const { return judge_.IsFeasible(found_.point); }
  [[nodiscard]] bool IsConvex() const;
  [[nodiscard]] std::vector<double> Aside(std::vector<double> x) const;

  bool Ends(sy_termination termination, const std::string& words = {});
  void EndUnsolved();

  const sy_problem& problem_;
  const Options& options_;
  const sy_host& host_;
  linear::Watch& watch_;
  const Stop stop_;
  Functions functions_;
  Judge judge_;
  Program program_;
  std::vector<double> start_;
  Ended ended_;           // the last run
  std::string runs_;      // all runs, and how NLopt ended them
  bool limited_ = false;  // did the first run end at its number of evaluations?
  bool sought_proof_ = false;
  Found found_;
};

}  // namespace switchyard::nlopt
