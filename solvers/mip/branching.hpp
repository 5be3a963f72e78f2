// solvers/mip/branching.hpp - how a node is split in two.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "solvers/mip/engine.hpp"
#include "solvers/mip/node.hpp"
#include "solvers/mip/options.hpp"
#include "solvers/mip/propagation.hpp"
#include "solvers/mip/pseudocosts.hpp"
#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/integer_problem.hpp"
#include "solvers/rounding/path_problem.hpp"

namespace switchyard::mip {

/// One child of a node.
struct Child {
  std::vector<VariableBox> decided;
  Step step;
};

/// Every integer point of the node is in one of them, or in both.
struct Split {
  Child children[2];
  int first = 0;  // the one to look at first
};

/// An integer of x that is none, and its distance from the integer below.
struct Fractional {
  std::int32_t variable;
  double fraction;
};

/// Integers' values that are further than `tolerance` from whole ones.
std::vector<Fractional> FractionalIn(const rounding::IntegerProblem& whole, const NodeBoxes& boxes,
                                     const std::vector<double>& x, double tolerance);

/// What a worker needs to split: its engine, its boxes' propagation, what all have learned.
struct SplitContext {
  const rounding::IntegerProblem& whole;
  const Options& options;
  const Propagator& propagator;
  Workspace& workspace;
  Engine& engine;
  rounding::Budget& budget;
  const std::int32_t* priority;        // by variable, or nullptr
  const rounding::PathProblem* paths;  // nullptr: there are none
  bool glances_are_dear = false;       // is a child's relaxation a whole solve?
  bool may_glance = true;              // else pseudocosts decide, known or not
};

/// What looking at children showed.
struct Lookahead {
  std::vector<Step> seen;  // of children that were solved; `from`: the gain
  bool tightened = false;  // the boxes are narrower: one child was empty
  bool empty = false;      // so were both
};

/// By reliability: candidates in the order of their pseudocosts, children of those that are not
/// known well enough solved for a few iterations; groups of which at most one is not 0, and arcs
/// out of a vertex, in halves. Nothing where no integer is fractional, or where the lookahead says
/// more.
std::optional<Split> ChooseSplit(const SplitContext& context, NodeBoxes& boxes,
                                 const Relaxed& relaxed, double cutoff,
                                 const Pseudocosts& pseudocosts, Lookahead& lookahead);

/// Where x is no guide: the widest box of an integer in two at x, or at its middle; nothing where
/// all are fixed.
std::optional<Split> SplitAnywhere(const rounding::IntegerProblem& whole, const NodeBoxes& boxes,
                                   const std::vector<double>& x);

}  // namespace switchyard::mip
