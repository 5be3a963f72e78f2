// solvers/rounding/diving.hpp - integer points from a relaxed one: rounding to nearest, and dives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/integer_problem.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {

/// What every try starts from: the problem, its relaxation with the integers' propagated bounds,
/// a point of that, and the backend that solves it again.
struct Root {
  const IntegerProblem& whole;
  const sy_problem& relaxation;
  const Domain& domain;
  const std::vector<double>& x;
  const sy_solver& solver;
  const sy_host& host;
};

/// What a try found: a point that holds in the whole problem, relative 1e-6, its objective computed
/// here; or the reason why there is none.
struct Try {
  bool feasible = false;
  double objective = kInfinity;
  std::vector<double> x;
  std::string text;
  std::int64_t iterations = 0;
  int relaxations = 0;
};

/// The integers to the nearest values, the least fractional first, each followed by propagation: on
/// a contradiction the other neighbour, once. Then the continuous rest is solved.
Try RoundToNearest(const Root& root, Budget& budget);

enum class DiveRule {
  kFractional,   // the least fractional, to nearest
  kCoefficient,  // the one with the fewest locks in a direction, that way
  kGuided,       // the one nearest to the guide's value, that way
  kDrawn         // drawn, up with the probability of its fraction
};

struct DiveOptions {
  DiveRule rule = DiveRule::kFractional;
  double cutoff = kInfinity;                   // only points with less count
  const std::vector<double>* guide = nullptr;  // a feasible point, for kGuided
  std::uint64_t seed = 0;
  double noise = 0;         // by which share the order of the rule is shaken
  bool batch = true;        // fix nearly integral ones, too
  bool near_guide = false;  // integers where the guide is the relaxed point stay there
};

/// In the relaxation: a fractional integer is rounded by the rule, of many a sixty-fourth of them;
/// with `batch`, up to an eighth of all integers that are nearly integral are fixed; all is
/// propagated and solved again, until every integer is one. Where that fails the first rounding is
/// tried alone, then the other way, once; then the dive ends. (Achterberg, Constraint Integer
/// Programming, 2007, chapter 9, has the rules and their measures.)
Try Dive(const Root& root, const DiveOptions& options, Budget& budget);

}  // namespace switchyard::rounding
