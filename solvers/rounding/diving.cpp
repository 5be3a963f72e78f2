#include "solvers/rounding/diving.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "switchyard/arcs.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kFeasibility = 1e-6;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

double Distance(double v) { return std::abs(v - std::round(v)); }

bool IsIntegral(double v) { return Distance(v) <= 1e-6 * std::max(1.0, std::abs(v)); }

/// The part that rounding and dives have in common: relaxations over a domain, and points judged.
class Search {
 public:
  Search(const Root& root, double cutoff, Budget& budget)
      : root_(root), cutoff_(cutoff), budget_(budget), domain_(root.domain), x_(root.x) {}

 protected:
  [[nodiscard]] const std::vector<std::int32_t>& integers() const { return root_.whole.integers(); }

  /// Fixes integers to the values nearest to x_. Where that contradicts, in halves; a single one
  /// to its other neighbour.
  bool FixNearest(std::span<const std::int32_t> variables) {
    const Domain before = domain_;
    for (const std::int32_t j : variables) {
      const double v = domain_.Nearest(j, x_[At(j)]);
      domain_.Impose(j, v, v);
    }
    if (domain_.Propagate(cutoff_)) return true;
    domain_ = before;
    if (variables.size() > 1) {
      const std::size_t half = variables.size() / 2;
      return FixNearest(variables.first(half)) && FixNearest(variables.subspan(half));
    }
    return !variables.empty() && FixToOtherNeighbour(variables.front());
  }

  /// Solves the relaxation over the domain, and rounds its point as it stands.
  bool Resolve() {
    Answer answer = SolveWithin(domain_, {});
    if (!HasPoint(answer)) return Fail("its relaxation ended without a point: " + answer.text);
    x_ = std::move(answer.x);
    if (Objective(root_.whole.problem(), x_.data()) >= cutoff_) {
      return Fail("its relaxation is no better than the best point");
    }
    const double before = found_.objective;
    Judge(RoundedByLocks());
    by_locks_ = by_locks_ || found_.objective < before;
    return true;
  }

  /// The point whose integers are next to x_, an optimum of a relaxation where they are integral:
  /// as it stands or, where that does not hold, with the continuous rest solved. A point that holds
  /// to no more than what is asked costs too little by as much, and is for want of a better.
  void Settle() {
    std::vector<double> point = x_;
    bool integral = true;
    for (const std::int32_t j : integers()) {
      point[At(j)] = domain_.Nearest(j, x_[At(j)]);
      integral = integral && std::abs(point[At(j)] - x_[At(j)]) <= kFeasibility;
    }
    constexpr double kExact = 1e-9;
    const bool alone = integers().size() == point.size();
    const bool exact = integral && root_.whole.WhatIsViolatedBy(point, kExact).empty();
    if ((alone || exact) && (Judge(point) || alone)) return;
    SolveRest(domain_, point);
    if (integral && !found_.feasible) Judge(point);
  }

  /// What rounding by locks found has the rest of another point.
  Try Polished() {
    if (found_.feasible && by_locks_ && integers().size() < found_.x.size()) {
      SolveRest(root_.domain, found_.x);
    }
    return std::move(found_);
  }

  bool Fail(std::string why) {
    if (!found_.feasible) found_.text = std::move(why);
    return false;
  }

  const Root& root_;
  const double cutoff_;
  Budget& budget_;
  Domain domain_;
  std::vector<double> x_;  // the last relaxed point
  Try found_;

 private:
  bool FixToOtherNeighbour(std::int32_t j) {
    const double v = domain_.Nearest(j, x_[At(j)]);
    double other = x_[At(j)] > v ? v + 1 : v - 1;
    if (other < domain_.lower(j) || other > domain_.upper(j)) other = 2 * v - other;
    if (other < domain_.lower(j) || other > domain_.upper(j)) return Fail(Contradicted());
    domain_.Impose(j, other, other);
    return domain_.Propagate(cutoff_) || Fail(Contradicted());
  }
  [[nodiscard]] std::string Contradicted() const {
    return "rounding contradicts " + domain_.Contradiction();
  }

  /// The continuous variables where the integers are those of `point`.
  void SolveRest(Domain domain, std::vector<double> point) {
    for (const std::int32_t j : integers()) domain.Impose(j, point[At(j)], point[At(j)]);
    if (!domain.Propagate()) {
      Fail("its integers leave nothing: " + domain.Contradiction());
      return;
    }
    const Answer answer = SolveWithin(domain, LeftOut(point));
    if (!HasPoint(answer)) {
      Fail("its integers leave no point: " + answer.text);
      return;
    }
    for (std::size_t j = 0; j < point.size(); ++j) {
      if (root_.whole.problem().integer[j] == 0) point[j] = answer.x[j];
    }
    Judge(point);
  }

  [[nodiscard]] static bool HasPoint(const Answer& answer) {
    return answer.primal == SY_FEASIBLE || answer.primal == SY_NEARLY_FEASIBLE;
  }

  /// The integers in the domain's boxes, the continuous ones in their own; `zero`: at 0.
  Answer SolveWithin(const Domain& domain, const std::vector<std::int32_t>& zero) {
    const auto n = At(root_.relaxation.num_vars);
    std::vector<double> lower(root_.relaxation.x_lower, root_.relaxation.x_lower + n);
    std::vector<double> upper(root_.relaxation.x_upper, root_.relaxation.x_upper + n);
    for (const std::int32_t j : integers()) {
      lower[At(j)] = domain.lower(j);
      upper[At(j)] = domain.upper(j);
    }
    for (const std::int32_t j : zero) lower[At(j)] = upper[At(j)] = 0;
    if (!loaded_) loaded_.emplace(root_.solver, root_.host, root_.relaxation, SY_UPDATES_BOUNDS);
    loaded_->SetBounds(lower, upper);
    sy_control control = budget_.Part(1);
    control.flags = SY_CONTINUE;
    Answer answer = loaded_->Solve(control);
    found_.iterations += answer.iterations;
    ++found_.relaxations;
    return answer;
  }

  /// The continuous members of each group but the largest, where they may be 0.
  [[nodiscard]] std::vector<std::int32_t> LeftOut(const std::vector<double>& point) const {
    std::vector<std::int32_t> zero;
    for (std::int32_t g = 0; g < root_.whole.num_groups(); ++g) {
      const auto group = root_.whole.Group(g);
      const auto size = [&](std::int32_t j) { return std::abs(point[At(j)]); };
      const auto largest =
          std::max_element(group.begin(), group.end(),
                           [&](std::int32_t a, std::int32_t b) { return size(a) < size(b); });
      for (const std::int32_t j : group) {
        const bool may_be_zero = domain_.lower(j) <= 0 && domain_.upper(j) >= 0;
        const bool continuous = root_.whole.problem().integer[j] == 0;
        if (continuous && may_be_zero && j != *largest) zero.push_back(j);
      }
    }
    return zero;
  }

  /// x_ with each integer rounded to where it has no lock, else to nearest.
  [[nodiscard]] std::vector<double> RoundedByLocks() const {
    std::vector<double> point = x_;
    for (std::size_t i = 0; i < integers().size(); ++i) {
      const std::int32_t j = integers()[i];
      const Locks& locks = root_.whole.locks()[i];
      double v = x_[At(j)];
      if (!IsIntegral(v) && locks.up == 0) v = std::ceil(v);
      if (!IsIntegral(v) && locks.down == 0) v = std::floor(v);
      point[At(j)] = domain_.Nearest(j, v);
    }
    return point;
  }

  bool Judge(const std::vector<double>& point) {
    const std::string violated = root_.whole.WhatIsViolatedBy(point, kFeasibility);
    if (!violated.empty()) return Fail("its point does not hold: " + violated);
    const double objective = Objective(root_.whole.problem(), point.data());
    if (objective < found_.objective) {
      found_.feasible = true;
      by_locks_ = false;
      found_.objective = objective;
      found_.x = point;
      found_.text.clear();
    }
    return true;
  }

  std::optional<Loaded> loaded_;
  bool by_locks_ = false;  // is the best point one of RoundedByLocks?
};

class Rounding : public Search {
 public:
  Rounding(const Root& root, Budget& budget) : Search(root, kInfinity, budget) {}

  Try Run() {
    std::vector<std::int32_t> order = integers();
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return Distance(x_[At(a)]) < Distance(x_[At(b)]);
    });
    const std::size_t most = SharePropagation();
    for (std::size_t i = 0; i < order.size();) {
      std::vector<std::int32_t> next;
      for (; i < order.size() && next.size() < most; ++i) {
        if (!domain_.IsFixed(order[i])) next.push_back(order[i]);
      }
      if (budget_.Stopped()) Fail("stopped");
      if (budget_.Stopped() || !(next.empty() || FixNearest(next))) return std::move(found_);
    }
    Settle();
    return std::move(found_);
  }

 private:
  /// How many share one propagation: one, where the problem is not so large that this takes long.
  [[nodiscard]] std::size_t SharePropagation() const {
    constexpr double kEntries = 1e8;  // to go over in all
    const sy_problem& p = root_.whole.problem();
    double entries = p.num_vars;
    for (const sy_csc* m : {p.A, p.F}) entries += m != nullptr ? m->start[m->cols] : 0;
    return 1 +
           static_cast<std::size_t>(static_cast<double>(integers().size()) * entries / kEntries);
  }
};

/// A fractional integer as a rule sees it.
struct Seen {
  double x;
  double guide;
  Locks locks;
  Random& random;
};
struct Direction {
  bool up;
  double cost;  // the least is taken
};

Direction Fractional(const Seen& s) { return {s.x < std::round(s.x), Distance(s.x)}; }

// One that can be rounded without harm is left for last: then rounding by locks does it.
Direction Coefficient(const Seen& s) {
  const double locks = std::min(s.locks.up, s.locks.down);
  const bool tie = s.locks.up == s.locks.down;
  const bool up = tie ? s.x < std::round(s.x) : s.locks.up < s.locks.down;
  return {up, (locks == 0 ? 1e9 : locks) + Distance(s.x)};
}

Direction Guided(const Seen& s) { return {s.x < s.guide, std::abs(s.x - s.guide)}; }

Direction Drawn(const Seen& s) {
  const bool up = s.random.Uniform() < s.x - std::floor(s.x);
  return {up, s.random.Uniform()};
}

struct RuleFacts {
  DiveRule rule;
  Direction (*look)(const Seen&);
};
constexpr std::array kRules = {
    RuleFacts{DiveRule::kFractional, Fractional}, RuleFacts{DiveRule::kCoefficient, Coefficient},
    RuleFacts{DiveRule::kGuided, Guided}, RuleFacts{DiveRule::kDrawn, Drawn}};
constexpr bool RulesStandInOrder() {
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    if (static_cast<std::size_t>(kRules[i].rule) != i) return false;
  }
  return true;
}
static_assert(RulesStandInOrder(), "row i is the rule of number i");

class Diving : public Search {
 public:
  Diving(const Root& root, const DiveOptions& options, Budget& budget)
      : Search(root, options.cutoff, budget), options_(options), random_(options.seed) {}

  Try Run() {
    Descend();
    return Polished();
  }

 private:
  struct Choice {
    double cost;
    std::int32_t variable;
    bool up;
  };

  void Descend() {
    if (!Begin()) return;
    const std::size_t limit = 2 * integers().size() + 10;
    for (std::size_t step = 0; step < limit; ++step) {
      if (budget_.Stopped()) {
        Fail("stopped");
        return;
      }
      const std::vector<Choice> choices = Choose();
      if (choices.empty()) return Settle();
      if (!Advance(choices)) return;
    }
    Fail("no integer point in " + std::to_string(limit) + " steps");
  }

  /// Below the cutoff, and near the guide where that is asked for.
  bool Begin() {
    if (options_.near_guide && options_.guide != nullptr) {
      for (const std::int32_t j : integers()) {
        const double v = (*options_.guide)[At(j)];
        if (std::abs(v - x_[At(j)]) <= kFeasibility) domain_.Impose(j, v, v);
      }
    }
    if (!(cutoff_ < kInfinity)) return true;
    if (!domain_.Propagate(cutoff_)) return Fail("no better point: " + domain_.Contradiction());
    return Resolve();
  }

  /// The fractional integer of the least cost, and of many a sixty-fourth more.
  std::vector<Choice> Choose() {
    const auto look = kRules[static_cast<std::size_t>(options_.rule)].look;
    std::vector<Choice> choices;
    for (std::size_t i = 0; i < integers().size(); ++i) {
      const std::int32_t j = integers()[i];
      const double x = x_[At(j)];
      if (domain_.IsFixed(j) || IsIntegral(x)) continue;
      const double guide = options_.guide != nullptr ? (*options_.guide)[At(j)] : std::round(x);
      Direction d = look({x, guide, root_.whole.locks()[i], random_});
      if (options_.noise > 0) d.cost *= 1 + options_.noise * random_.Uniform();
      choices.push_back({d.cost, j, d.up});
    }
    std::stable_sort(choices.begin(), choices.end(),
                     [](const Choice& a, const Choice& b) { return a.cost < b.cost; });
    if (choices.size() > 1) choices.resize(1 + (choices.size() - 1) / 64);
    return choices;
  }

  /// An eighth of the integers, at most, that are nearly integral: those first whose value is not
  /// their lower bound.
  [[nodiscard]] std::vector<std::int32_t> NearlyIntegral() const {
    constexpr double kNear = 0.1;
    std::vector<std::pair<double, std::int32_t>> near;
    std::size_t open = 0;
    for (const std::int32_t j : integers()) {
      if (domain_.IsFixed(j)) continue;
      ++open;
      const double x = x_[At(j)];
      if (Distance(x) > kNear) continue;
      const bool at_lower = std::round(x) <= domain_.lower(j);
      near.emplace_back(Distance(x) + (at_lower ? kNear : 0), j);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > open / 8) near.resize(open / 8);
    std::vector<std::int32_t> variables;
    for (const auto& [key, j] : near) variables.push_back(j);
    return variables;
  }

  bool Round(const Choice& choice) {
    const double x = x_[At(choice.variable)];
    if (choice.up) {
      domain_.Impose(choice.variable, std::ceil(x), kInfinity);
    } else {
      domain_.Impose(choice.variable, -kInfinity, std::floor(x));
    }
    if (domain_.Propagate(cutoff_)) return true;
    return Fail("a dead end at x[" + std::to_string(choice.variable) +
                "]: " + domain_.Contradiction());
  }

  bool RoundAll(const std::vector<Choice>& choices) {
    return std::all_of(choices.begin(), choices.end(), [this](const Choice& choice) {
      return domain_.IsFixed(choice.variable) || Round(choice);
    });
  }

  bool Advance(const std::vector<Choice>& choices) {
    Choice first = choices.front();
    const Domain before = domain_;
    const std::vector<double> x = x_;
    const auto afresh = [&] {
      domain_ = before;
      x_ = x;
      return !budget_.Stopped();
    };
    std::vector<std::int32_t> batch;
    if (options_.batch) batch = NearlyIntegral();
    if (choices.size() > 1 || !batch.empty()) {
      if (RoundAll(choices) && (batch.empty() || FixNearest(batch)) && Resolve()) return true;
      if (!afresh()) return false;
    }
    if (Round(first) && Resolve()) return true;
    first.up = !first.up;
    return afresh() && Round(first) && Resolve();
  }

  const DiveOptions& options_;
  Random random_;
};

}  // namespace

Try RoundToNearest(const Root& root, Budget& budget) { return Rounding(root, budget).Run(); }

Try Dive(const Root& root, const DiveOptions& options, Budget& budget) {
  return Diving(root, options, budget).Run();
}

}  // namespace switchyard::rounding
