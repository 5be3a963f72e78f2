// solvers/rounding/candidates.hpp - paths drawn from the relaxed flow, and what each is worth.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/options.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/abi.h"
#include "switchyard/arcs.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {

/// A path, and what is known of it: its restriction's answer, judged, once it was tried.
struct Candidate {
  std::vector<std::int32_t> path;  // arcs
  bool compared = false;
  double estimate = kInfinity;  // what the path costs by the terms of the whole problem
  double bound = -kInfinity;    // proven, where the front end says that those bound what it costs
  std::vector<double> start;    // the variables of the restriction, at that cost; or empty
  bool tried = false;
  sy_termination termination = SY_NOT_SOLVED;
  bool feasible = false;  // x holds in the whole problem; or solve_path said so
  bool verified = false;  // x holds in the whole problem
  double objective = 0;   // where feasible
  std::string text;       // the reason
  std::int64_t iterations = 0;
  std::vector<double> x;  // of the whole problem, where verified
};

/// Adds a path, where it is not there yet; was it added?
bool AddPath(std::vector<std::int32_t> path, std::vector<Candidate>& candidates);

/// Adds the path of the largest product of its arcs' parts of the flow, where it is not there yet.
void AddLikeliest(const PathProblem& whole, const std::vector<double>& x, const Options& options,
                  std::vector<Candidate>& candidates);

/// Of each arc, -log of its part of the flow out of its tail; infinity where the tolerance is not
/// passed: what makes the likeliest path the shortest.
std::vector<double> Improbabilities(const PathProblem& whole, const std::vector<double>& x,
                                    const Options& options);

/// Adds up to `count` others, drawn from the relaxed point's flows, and takes the draws from
/// `trials`.
void SampleCandidates(const PathProblem& whole, const std::vector<double>& x,
                      const Options& options, std::size_t count, Random& random, int& trials,
                      std::vector<Candidate>& candidates);

/// What the candidates that were neither compared nor tried cost by dropping blocks, for a front
/// end that solves paths itself: an order in which to ask it, and bounds where they are
/// (SY_PATHS_BOUND). A path that such a restriction proves to have no point counts as tried.
void CompareCandidates(const PathProblem& whole, const sy_host& host, const Options& options,
                       std::int32_t threads, Budget& budget, std::vector<Candidate>& candidates);

/// Solves the restriction of each candidate that was not tried yet, from nothing, at most `threads`
/// at a time, each by one thread: the answers do not depend on how many. A point counts only where
/// it holds in the whole problem, relative 1e-6, and its objective is computed here. Where the
/// front end solves paths itself, its word for the objective stands.
void SolveCandidates(const PathProblem& whole, const sy_host& host, const Options& options,
                     std::int32_t threads, Budget& budget, std::vector<Candidate>& candidates);
/// Of some.
void SolveCandidates(const PathProblem& whole, const sy_host& host, const Options& options,
                     std::int32_t threads, Budget& budget, std::vector<Candidate*> candidates);

}  // namespace switchyard::rounding
