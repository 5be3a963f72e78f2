#include "solvers/mip/branching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/mip/path_branching.hpp"

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t j) { return static_cast<std::size_t>(j); }

/// The children of a variable at a value between two integers.
Split SplitAt(std::int32_t j, double value, const NodeBoxes& boxes) {
  const double below = std::floor(value), fraction = value - below;
  Split split;
  split.children[0] = {{{j, boxes.lower(j), below}}, {j, false, fraction, 0}};
  split.children[1] = {{{j, below + 1, boxes.upper(j)}}, {j, true, 1 - fraction, 0}};
  split.first = fraction > 0.5 ? 1 : 0;
  return split;
}

/// Those of the highest priority among them.
void KeepTheMostUrgent(const std::int32_t* priority, std::vector<Fractional>& fractional) {
  if (priority == nullptr || fractional.empty()) return;
  std::int32_t highest = std::numeric_limits<std::int32_t>::min();
  for (const Fractional& f : fractional) highest = std::max(highest, priority[f.variable]);
  std::erase_if(fractional, [&](const Fractional& f) { return priority[f.variable] != highest; });
}

/// A group's members in their order, in two: where half of the sum of their sizes is passed.
/// Nothing where fewer than three are fractional, or a side would be without any.
std::optional<Split> HalvesOf(std::span<const std::int32_t> group, const NodeBoxes& boxes,
                              const std::vector<double>& x) {
  constexpr double kSize = 1e-6;
  double sum = 0;
  int many = 0;
  for (const std::int32_t j : group) {
    sum += std::abs(x[At(j)]);
    many += std::abs(x[At(j)]) > kSize ? 1 : 0;
  }
  if (many < 3) return std::nullopt;
  Split split;
  double so_far = 0;
  for (const std::int32_t j : group) {
    const int side = so_far < 0.5 * sum ? 0 : 1;
    so_far += std::abs(x[At(j)]);
    // The first child is without the members of the second half, and the other way round.
    if (!boxes.IsFixed(j)) split.children[1 - side].decided.push_back({j, 0, 0});
  }
  if (split.children[0].decided.empty() || split.children[1].decided.empty()) return std::nullopt;
  return split;
}

std::optional<Split> SplitOfGroups(const rounding::IntegerProblem& whole, const NodeBoxes& boxes,
                                   const std::vector<double>& x) {
  std::optional<Split> best;
  std::size_t most = 0;
  for (std::int32_t g = 0; g < whole.num_groups(); ++g) {
    std::optional<Split> halves = HalvesOf(whole.Group(g), boxes, x);
    if (!halves) continue;
    const std::size_t decided =
        std::min(halves->children[0].decided.size(), halves->children[1].decided.size());
    if (best && decided <= most) continue;
    most = decided;
    best = std::move(halves);
  }
  return best;
}

class ByReliability {
 public:
  ByReliability(const SplitContext& context, NodeBoxes& boxes, const Relaxed& relaxed,
                double cutoff, const Pseudocosts& pseudocosts, Lookahead& lookahead)
      : c_(context),
        boxes_(boxes),
        relaxed_(relaxed),
        cutoff_(cutoff),
        pseudocosts_(pseudocosts),
        lookahead_(lookahead),
        parent_(std::max(relaxed.bound.value, -std::numeric_limits<double>::max())) {}

  std::optional<Split> Choose(std::vector<Fractional> candidates) {
    const auto score = [&](const Fractional& f) {
      return pseudocosts_.Score(f.variable, f.fraction);
    };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Fractional& a, const Fractional& b) { return score(a) > score(b); });
    const int reliability =
        c_.glances_are_dear ? std::min(1, c_.options.reliability) : c_.options.reliability;
    const int dear = c_.options.candidates / 2;
    const int most = !c_.may_glance ? 0 : c_.glances_are_dear ? dear : c_.options.candidates;
    double best = -1;
    const Fractional* chosen = nullptr;
    int looked = 0;
    for (const Fractional& f : candidates) {
      const bool known = std::min(pseudocosts_.Count(f.variable, false),
                                  pseudocosts_.Count(f.variable, true)) >= reliability;
      double worth = score(f);
      if (!known && looked < most && !c_.budget.Stopped()) {
        ++looked;
        worth = LookAt(f);
        if (lookahead_.empty || lookahead_.tightened) return std::nullopt;
      }
      if (worth <= best) continue;
      best = worth;
      chosen = &f;
    }
    return SplitAt(chosen->variable, relaxed_.x[At(chosen->variable)], boxes_);
  }

 private:
  /// The score, by what its children gain.
  double LookAt(const Fractional& f) {
    const Split split = SplitAt(f.variable, relaxed_.x[At(f.variable)], boxes_);
    double gain[2];
    for (const int side : {0, 1}) {
      gain[side] = GainOf(split.children[side]);
      if (gain[side] < kInfinity) {
        Step step = split.children[side].step;
        step.from = gain[side];
        lookahead_.seen.push_back(step);
      }
    }
    lookahead_.empty = gain[0] == kInfinity && gain[1] == kInfinity;
    for (const int side : {0, 1}) {
      if (lookahead_.empty || gain[side] < kInfinity) continue;
      for (const VariableBox& box : split.children[1 - side].decided) {
        boxes_.Impose(box.variable, box.lower, box.upper);
      }
      lookahead_.tightened = true;
    }
    return Pseudocosts::ScoreOf(gain[0], gain[1]);
  }

  /// Infinity where the child holds nothing.
  double GainOf(const Child& child) {
    const NodeBoxes::Mark mark = boxes_.Now();
    for (const VariableBox& box : child.decided) {
      boxes_.Impose(box.variable, box.lower, box.upper);
    }
    double gain = kInfinity;
    if (c_.propagator.Propagate(boxes_, c_.workspace, cutoff_)) {
      const Relaxed seen = c_.engine.Glance(boxes_, cutoff_);
      const bool nothing =
          seen.state == Relaxed::State::kEmpty || seen.state == Relaxed::State::kCutoff;
      if (!nothing) gain = std::max(0.0, seen.bound.value - parent_);
    }
    boxes_.UndoTo(mark);
    return gain;
  }

  const SplitContext& c_;
  NodeBoxes& boxes_;
  const Relaxed& relaxed_;
  const double cutoff_;
  const Pseudocosts& pseudocosts_;
  Lookahead& lookahead_;
  const double parent_;
};

}  // namespace

std::vector<Fractional> FractionalIn(const rounding::IntegerProblem& whole, const NodeBoxes& boxes,
                                     const std::vector<double>& x, double tolerance) {
  std::vector<Fractional> fractional;
  for (const std::int32_t j : whole.integers()) {
    if (boxes.IsFixed(j)) continue;
    const double value = x[At(j)], fraction = value - std::floor(value);
    if (std::min(fraction, 1 - fraction) <= tolerance) continue;
    if (value <= boxes.lower(j) || value >= boxes.upper(j)) continue;  // outside, by rounding
    fractional.push_back({j, fraction});
  }
  return fractional;
}

std::optional<Split> ChooseSplit(const SplitContext& context, NodeBoxes& boxes,
                                 const Relaxed& relaxed, double cutoff,
                                 const Pseudocosts& pseudocosts, Lookahead& lookahead) {
  constexpr double kWhole = 1e-6;
  std::vector<Fractional> fractional = FractionalIn(context.whole, boxes, relaxed.x, kWhole);
  if (fractional.empty()) return std::nullopt;
  if (context.paths != nullptr) {
    if (auto split = SplitOfArcs(*context.paths, boxes, relaxed.x)) return split;
  }
  KeepTheMostUrgent(context.priority, fractional);
  if (auto split = SplitOfGroups(context.whole, boxes, relaxed.x)) return split;
  return ByReliability(context, boxes, relaxed, cutoff, pseudocosts, lookahead)
      .Choose(std::move(fractional));
}

std::optional<Split> SplitAnywhere(const rounding::IntegerProblem& whole, const NodeBoxes& boxes,
                                   const std::vector<double>& x) {
  std::int32_t widest = -1;
  double width = 0;
  for (const std::int32_t j : whole.integers()) {
    if (boxes.upper(j) - boxes.lower(j) <= width) continue;
    width = boxes.upper(j) - boxes.lower(j);
    widest = j;
  }
  if (widest < 0) return std::nullopt;
  double at = x.empty() ? 0.5 * (boxes.lower(widest) + boxes.upper(widest)) : x[At(widest)];
  if (!std::isfinite(at)) {
    at = std::isfinite(boxes.lower(widest)) ? boxes.lower(widest) + 1 : boxes.upper(widest) - 1;
    if (!std::isfinite(at)) at = 0;
  }
  at = std::clamp(std::round(at), boxes.lower(widest), boxes.upper(widest) - 1);
  Split split;
  split.children[0] = {{{widest, boxes.lower(widest), at}}, {}};
  split.children[1] = {{{widest, at + 1, boxes.upper(widest)}}, {}};
  return split;
}

}  // namespace switchyard::mip
