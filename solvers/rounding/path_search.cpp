#include "solvers/rounding/path_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solvers/rounding/recombine.hpp"
#include "solvers/rounding/verdict.hpp"

namespace switchyard::rounding {
namespace {

constexpr std::size_t kCompared = 3;  // for each path to try
constexpr std::size_t kRounds = 8;    // for each path to draw that many are made, at most
constexpr double kSame = 1e-8;        // costs that far apart, relative, are one

std::size_t Less(std::size_t a, std::size_t b) { return a - std::min(a, b); }

}  // namespace

const Candidate* PathSearch::TryLikeliest(const std::vector<double>& relaxed) {
  const std::size_t before = candidates_.size();
  AddLikeliest(whole_, relaxed, options_, candidates_);
  if (candidates_.size() == before) return nullptr;
  TryAll();
  return &candidates_.back();
}

void PathSearch::Run(const std::vector<double>& relaxed, double bound) {
  length_ = Improbabilities(whole_, relaxed, options_);
  if (!Compares()) {
    Draw(relaxed);
    return Recombine(bound);
  }
  DrawAndCompare(relaxed);
  RecombineCompared();
}

// The likeliest draw is worth a try, drawn or not. A path that turns out to have no point does not
// count: another one is drawn for it.
void PathSearch::Draw(const std::vector<double>& relaxed) {
  Random random(budget_.control().seed);
  int trials = options_.trials;
  const auto wanted = static_cast<std::size_t>(options_.paths);
  AddLikeliest(whole_, relaxed, options_, candidates_);
  for (std::size_t tried = 0; !budget_.Stopped(); tried = candidates_.size()) {
    const std::size_t missing = Less(wanted, NumFeasible());
    const std::size_t waiting = Less(candidates_.size(), NumTried());
    SampleCandidates(whole_, relaxed, options_, Less(missing, waiting), random, trials,
                     candidates_);
    if (candidates_.size() == tried) break;
    TryAll();
  }
}

// Likewise, many at a time; one that cannot be the best any more counts as one with a point.
void PathSearch::DrawAndCompare(const std::vector<double>& relaxed) {
  Random random(budget_.control().seed);
  int trials = options_.trials;
  const auto wanted = static_cast<std::size_t>(options_.paths);
  AddLikeliest(whole_, relaxed, options_, candidates_);
  for (std::size_t known = 0; !budget_.Stopped() && NumSettled() < wanted;
       known = candidates_.size()) {
    SampleCandidates(whole_, relaxed, options_, kCompared * (wanted - NumSettled()), random, trials,
                     candidates_);
    if (candidates_.size() == known) break;
    Compare();
    TryPromising(Less(wanted, NumFeasible()), std::numeric_limits<std::size_t>::max());
  }
}

// Around the best path, as long as one is better: detours along the others, where they do not help
// exchanges of a few vertices, then likely deviations; of each as many as paths were asked for.
void PathSearch::Recombine(double bound) {
  constexpr std::array kWays = {&PathSearch::Detours, &PathSearch::Exchanges,
                                &PathSearch::Deviations};
  const std::size_t enough =
      candidates_.size() + kRounds * static_cast<std::size_t>(options_.paths);
  while (candidates_.size() < enough && Best() != nullptr &&
         !IsWithinTheGap(budget_.control(), Best()->objective, bound)) {
    const bool better = std::any_of(kWays.begin(), kWays.end(),
                                    [this](auto way) { return Improve((this->*way)()); });
    if (!better) return;
  }
}

// The same, all at once: what was compared says which are worth a try.
void PathSearch::RecombineCompared() {
  auto left = static_cast<std::size_t>(options_.paths);
  const std::size_t share = std::max<std::size_t>(1, left / 3);
  while (left > 0 && Best() != nullptr && !budget_.Stopped()) {
    std::size_t more = kCompared * static_cast<std::size_t>(options_.paths);
    for (Paths& paths : std::array{Detours(), Exchanges(), Deviations()}) {
      for (auto& path : paths) {
        if (more > 0 && AddPath(std::move(path), candidates_)) --more;
      }
    }
    Compare();
    const std::size_t tried = TryPromising(share, std::min(share, left));
    if (tried == 0) return;
    left -= tried;
  }
}

PathSearch::Paths PathSearch::Detours() const {
  Paths detours;
  const Candidate* best = Best();
  for (const Candidate& c : candidates_) {
    if (best == nullptr || (c.tried && !c.feasible)) continue;
    for (auto& detour : rounding::Detours(whole_.arcs(), best->path, c.path)) {
      detours.push_back(std::move(detour));
    }
  }
  return detours;
}

PathSearch::Paths PathSearch::Exchanges() const {
  const Candidate* best = Best();
  if (best == nullptr) return {};
  return rounding::Exchanges(whole_.arcs(), whole_.out(), length_, best->path);
}

/// Of the best path first, then of the next.
PathSearch::Paths PathSearch::Deviations() const {
  std::vector<const Candidate*> order;
  for (const Candidate& c : candidates_) {
    if (c.feasible) order.push_back(&c);
  }
  std::stable_sort(order.begin(), order.end(), [](const Candidate* a, const Candidate* b) {
    return a->objective < b->objective;
  });
  Paths deviations;
  const auto enough = 4 * static_cast<std::size_t>(options_.paths);  // some are known
  for (const Candidate* c : order) {
    if (deviations.size() > enough) break;
    for (auto& path : rounding::Deviations(whole_.arcs(), whole_.out(), length_, c->path,
                                           whole_.paths().target)) {
      deviations.push_back(std::move(path));
    }
  }
  return deviations;
}

/// Is one of the first that are new, as many as paths were asked for, better than the best so far?
bool PathSearch::Improve(Paths paths) {
  if (budget_.Stopped()) return false;
  const double before = Best()->objective;
  auto most = static_cast<std::size_t>(options_.paths);
  for (auto& path : paths) {
    if (most > 0 && AddPath(std::move(path), candidates_)) --most;
  }
  TryAll();
  return Best()->objective < before - kSame * (1 + std::abs(before));
}

bool PathSearch::MayBeBest(const Candidate& candidate) const {
  const Candidate* best = Best();
  return best == nullptr ||
         candidate.bound < best->objective - kSame * (1 + std::abs(best->objective));
}

/// Those that were not tried and may be the best, the cheapest first.
std::vector<Candidate*> PathSearch::Promising() {
  std::vector<Candidate*> some;
  for (Candidate& c : candidates_) {
    if (!c.tried && MayBeBest(c)) some.push_back(&c);
  }
  std::stable_sort(some.begin(), some.end(), [](const Candidate* a, const Candidate* b) {
    return a->estimate < b->estimate;
  });
  return some;
}

// As many at a time as there are threads: what is found decides which of the others are promising.
// In their order those that are tried are the same for any number of threads, but for some at the
// end that cannot be the best.
std::size_t PathSearch::TryPromising(std::size_t feasible, std::size_t most) {
  const auto threads = static_cast<std::size_t>(std::max(1, budget_.control().threads));
  const std::size_t begin = NumTried(), found = NumFeasible();
  while (!budget_.Stopped()) {
    std::vector<Candidate*> some = Promising();
    some.resize(std::min({some.size(), threads, Less(feasible, NumFeasible() - found),
                          Less(most, NumTried() - begin)}));
    if (some.empty()) break;
    SolveCandidates(whole_, host_, options_, budget_.control().threads, budget_, std::move(some));
  }
  return NumTried() - begin;
}

void PathSearch::Compare() {
  CompareCandidates(whole_, host_, options_, budget_.control().threads, budget_, candidates_);
}

void PathSearch::TryAll() {
  SolveCandidates(whole_, host_, options_, budget_.control().threads, budget_, candidates_);
}

const Candidate* PathSearch::Best() const {
  const Candidate* best = nullptr;
  for (const Candidate& c : candidates_) {
    if (c.feasible && (best == nullptr || c.objective < best->objective)) best = &c;
  }
  return best;
}

std::size_t PathSearch::NumFeasible() const {
  return static_cast<std::size_t>(std::count_if(candidates_.begin(), candidates_.end(),
                                                [](const Candidate& c) { return c.feasible; }));
}

std::size_t PathSearch::NumTried() const {
  return static_cast<std::size_t>(std::count_if(candidates_.begin(), candidates_.end(),
                                                [](const Candidate& c) { return c.tried; }));
}

std::size_t PathSearch::NumSettled() const {
  return static_cast<std::size_t>(
      std::count_if(candidates_.begin(), candidates_.end(),
                    [&](const Candidate& c) { return c.feasible || (!c.tried && !MayBeBest(c)); }));
}

}  // namespace switchyard::rounding
