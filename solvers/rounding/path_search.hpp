// solvers/rounding/path_search.hpp - from a relaxed flow to the best path that is found.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/candidates.hpp"
#include "solvers/rounding/options.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/abi.h"

namespace switchyard::rounding {

/// Paths are drawn from the relaxed flow and tried, then ones that are made of their parts.
///
/// Where the front end solves paths itself, which takes long, many more are drawn than are tried.
/// What dropping blocks gives for each is their order, its point is where the front end starts; and
/// where it bounds what the front end can find, a path that cannot be better than the best one is
/// not tried.
class PathSearch {
 public:
  PathSearch(const PathProblem& whole, const Options& options, const sy_host& host, Budget& budget)
      : whole_(whole), options_(options), host_(host), budget_(budget) {}

  /// The path that the flow draws most often, tried; NULL: it was before, or there is none.
  const Candidate* TryLikeliest(const std::vector<double>& relaxed);
  /// `bound`: on what every path costs; -infinity: unknown.
  void Run(const std::vector<double>& relaxed, double bound);

  /// All that were drawn or made.
  [[nodiscard]] const std::vector<Candidate>& candidates() const { return candidates_; }
  [[nodiscard]] const Candidate* Best() const;
  [[nodiscard]] std::size_t NumFeasible() const;
  [[nodiscard]] std::size_t NumTried() const;

 private:
  using Paths = std::vector<std::vector<std::int32_t>>;

  void Draw(const std::vector<double>& relaxed);
  void DrawAndCompare(const std::vector<double>& relaxed);
  void Recombine(double bound);
  void RecombineCompared();
  [[nodiscard]] Paths Detours() const;
  [[nodiscard]] Paths Exchanges() const;
  [[nodiscard]] Paths Deviations() const;
  bool Improve(Paths paths);

  [[nodiscard]] bool Compares() const { return whole_.paths().solve_path != nullptr; }
  [[nodiscard]] bool MayBeBest(const Candidate& candidate) const;
  [[nodiscard]] std::vector<Candidate*> Promising();
  std::size_t TryPromising(std::size_t feasible, std::size_t most);
  [[nodiscard]] std::size_t NumSettled() const;
  void Compare();
  void TryAll();

  const PathProblem& whole_;
  const Options& options_;
  const sy_host& host_;
  Budget& budget_;
  std::vector<Candidate> candidates_;
  std::vector<double> length_;  // of arcs: short paths are likely
};

}  // namespace switchyard::rounding
