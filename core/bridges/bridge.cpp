#include "core/bridges/bridge.hpp"

#include <algorithm>
#include <cstring>
#include <deque>
#include <map>

#include "core/bridges/bridges.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/hints.h"

namespace switchyard {
namespace {

constexpr Features kConeBits = ~Features{0} << 32;

struct Section {
  Features bit;
  const char* name;
};
constexpr Section kSections[] = {
    {SY_ACCEPTS_BOUNDS, "variable bounds"},
    {SY_ACCEPTS_ROWS, "linear rows"},
    {SY_ACCEPTS_QUADRATIC_OBJECTIVE, "a quadratic objective"},
    {SY_ACCEPTS_NONCONVEX_OBJECTIVE, "a nonconvex objective"},
    {SY_ACCEPTS_INTEGER, "integer variables"},
    {SY_ACCEPTS_NLP, "nonlinear functions"},
};

}  // namespace

Features FeaturesOf(const sy_problem& problem) {
  Features f = 0;
  if (problem.x_lower != nullptr || problem.x_upper != nullptr) f |= SY_ACCEPTS_BOUNDS;
  if (problem.num_rows > 0) f |= SY_ACCEPTS_ROWS;
  if (problem.P != nullptr) {
    f |= SY_ACCEPTS_QUADRATIC_OBJECTIVE;
    if ((problem.flags & SY_PROBLEM_CONVEX) == 0) f |= SY_ACCEPTS_NONCONVEX_OBJECTIVE;
  }
  if (problem.integer != nullptr) f |= SY_ACCEPTS_INTEGER;
  if (problem.nlp != nullptr) f |= SY_ACCEPTS_NLP;
  for (std::int32_t c = 0; c < problem.num_cones; ++c) f |= ConeFeature(problem.cones[c].kind);
  return f;
}

Features AbilitiesOf(const sy_solver& solver, bool with_integers) {
  const std::uint64_t accepts = with_integers ? solver.integer_accepts : solver.accepts;
  const std::uint64_t cones = with_integers ? solver.integer_cones : solver.cones;
  return (accepts & ~kConeBits) | (cones << 32);
}

std::string DescribeFeatures(Features features) {
  std::string text;
  const auto say = [&](const std::string& name) { text += (text.empty() ? "" : ", ") + name; };
  for (const Section& section : kSections) {
    if ((features & section.bit) != 0) say(section.name);
  }
  for (sy_cone_kind kind = SY_CONE_ZERO; kind <= SY_CONE_ROTATED; ++kind) {
    if ((features & ConeFeature(kind)) != 0) say(std::string(FactsOf(kind).name) + " cones");
  }
  return text;
}

bool AnyOff(const ProblemData& problem) {
  return std::any_of(problem.cone_on.begin(), problem.cone_on.end(),
                     [](std::uint8_t on) { return on == 0; });
}

const std::vector<BridgeKind>& BridgeKinds() {
  static const std::vector<BridgeKind> kinds = {
      BoundsToRows(),         RowsToCones(),          LinearConesToRows(),
      RotatedToSecondOrder(), SecondOrderToRotated(), QuadraticObjectiveToCone(),
      ConesToFunctions(),
  };
  return kinds;
}

// Breadth first over sets of features: a few dozen states at the most.
Planned PlanBridges(Features features, Features abilities) {
  std::map<Features, BridgePlan> seen = {{features, {}}};
  std::deque<Features> open = {features};
  Features best_missing = features & ~abilities;
  while (!open.empty()) {
    const Features now = open.front();
    open.pop_front();
    const Features missing = now & ~abilities;
    if (missing == 0) return {true, seen[now], 0};
    if (__builtin_popcountll(missing) < __builtin_popcountll(best_missing)) best_missing = missing;
    for (const BridgeKind& kind : BridgeKinds()) {
      if ((missing & kind.removes) == 0) continue;
      const Features next = (now & ~kind.removes) | kind.adds;
      if (seen.contains(next)) continue;
      BridgePlan plan = seen[now];
      plan.push_back(&kind);
      seen.emplace(next, std::move(plan));
      open.push_back(next);
    }
  }
  return {false, {}, best_missing};
}

BridgeChain::BridgeChain(const Problem& problem, const BridgePlan& plan) {
  const bool any_off = AnyOff(problem.data());
  if (plan.empty() && !any_off) return;
  ProblemData now = problem.data();
  if (!any_off) now.cone_on.clear();
  const auto take = [&](Bridged next) {
    now = std::move(next.image);
    bridges_.push_back(std::move(next.maps));
  };
  if (any_off) take(LeaveOutSwitchedOff(std::move(now)));
  for (const BridgeKind* kind : plan) take(kind->apply(std::move(now)));
  image_ = Problem(std::move(now));
  if (problem.view().hints != nullptr) MapHints(problem.view());
}

// Groups of variables pass as they are, since variables keep their places; what has an entry for
// each variable passes where none was appended; blocks and paths speak of rows that have moved.
void BridgeChain::MapHints(const sy_problem& problem) {
  const bool appended = image().data().num_vars != problem.num_vars;
  for (const sy_hint* hint = problem.hints; hint->id != nullptr; ++hint) {
    const bool groups = std::strcmp(hint->id, "sy.sos1/1") == 0;
    const bool per_variable = std::strcmp(hint->id, "sy.branching/1") == 0;
    if (groups || (per_variable && !appended)) {
      hints_.push_back(*hint);
    } else {
      dropped_.push_back(std::string("the hint ") + hint->id +
                         " was dropped: a bridge moved what it speaks of");
    }
  }
  hints_.push_back({nullptr, nullptr});
  image_.Change([&](ProblemData& d) { d.hints = hints_.data(); });
}

void BridgeChain::Back(Vectors& v) const {
  for (auto bridge = bridges_.rbegin(); bridge != bridges_.rend(); ++bridge) (*bridge)->Back(v);
}

void BridgeChain::Forward(Vectors& v) const {
  for (const auto& bridge : bridges_) bridge->Forward(v);
}

}  // namespace switchyard
