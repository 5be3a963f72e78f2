#include "solvers/rounding/candidates.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/bound.hpp"
#include "solvers/rounding/restriction.hpp"
#include "solvers/rounding/verdict.hpp"
#include "solvers/rounding/verify.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kFeasibility = 1e-6;

std::string Join(const std::string& one, const std::string& other) {
  return one.empty() || other.empty() ? one + other : one + "; " + other;
}

class Solving {
 public:
  Solving(const PathProblem& whole, const sy_host& host, const Options& options,
          std::int64_t instances, Budget& budget)
      : whole_(whole), host_(host), options_(options), instances_(instances), budget_(budget) {}

  /// Never throws: what cannot be compared is tried last.
  void Compare(Candidate& candidate) const noexcept {
    try {
      if (!budget_.Stopped()) Estimate(candidate);
    } catch (const std::exception&) {
    }
  }

  /// Never throws: what fails is the candidate's reason.
  void Solve(Candidate& candidate) const noexcept {
    try {
      if (budget_.Stopped()) {
        candidate.termination = budget_.reason();
      } else if (whole_.paths().solve_path != nullptr) {
        SolveByFrontEnd(candidate);
      } else {
        SolveRestriction(candidate);
      }
    } catch (const std::exception& e) {
      candidate.termination = SY_NUMERICAL_TROUBLE;
      candidate.text = e.what();
    }
  }

 private:
  void SolveRestriction(Candidate& candidate) const {
    const Restriction restriction = Restrict(whole_, candidate.path);
    if (!restriction.contradiction.empty()) {
      candidate.termination = SY_INFEASIBLE;
      candidate.text = restriction.contradiction;
      return;
    }
    Answer answer;
    answer.termination = SY_OPTIMAL;
    answer.primal = SY_FEASIBLE;
    if (!restriction.variables.empty()) {
      const Problem problem(restriction.problem);
      const char* names = options_.solver.empty() ? nullptr : options_.solver.c_str();
      const sy_solver& solver = FindBackend(host_, problem.view(), names, instances_);
      answer = SolveBy(solver, host_, problem.view(), budget_.Part(1));
    }
    candidate.termination = answer.termination;
    candidate.text = answer.text;
    candidate.iterations = answer.iterations;
    if (answer.primal == SY_NO_POINT || answer.primal == SY_CERTIFICATE) return;
    Judge(InWhole(whole_, restriction, answer.x), candidate);
  }

  void Estimate(Candidate& candidate) const {
    const Restriction restriction = Restrict(whole_, candidate.path);
    if (!restriction.contradiction.empty()) return Exclude(restriction.contradiction, candidate);
    const Problem problem(restriction.problem);
    Answer answer;
    answer.primal = SY_FEASIBLE;
    if (!restriction.variables.empty()) {
      const char* names = options_.solver.empty() ? nullptr : options_.solver.c_str();
      const sy_solver& solver = FindBackend(host_, problem.view(), names, instances_);
      answer = SolveBy(solver, host_, problem.view(), budget_.Part(1));
    }
    candidate.iterations = answer.iterations;
    if (!ComparisonsBind()) return Take(std::move(answer), problem.view(), candidate);
    ProblemData boxed = restriction.problem;
    TakeBoxes(restriction.variables, boxed);
    const Problem proving(std::move(boxed));
    if (answer.dual == SY_CERTIFICATE) {
      if (ProvesInfeasible(proving.view(), answer)) Exclude(answer.text, candidate);
      return;
    }
    if (IsPoint(answer.primal)) candidate.bound = ProvenBound(proving.view(), answer, kInfinity);
    Take(std::move(answer), problem.view(), candidate);
  }

  [[nodiscard]] bool ComparisonsBind() const {
    return (whole_.paths().flags & SY_PATHS_BOUND) != 0;
  }

  void Exclude(const std::string& why, Candidate& candidate) const {
    if (!ComparisonsBind()) return;
    candidate.tried = true;
    candidate.termination = SY_INFEASIBLE;
    candidate.text = why;
  }

  static void Take(Answer answer, const sy_problem& problem, Candidate& candidate) {
    if (!IsPoint(answer.primal)) return;
    candidate.estimate = Objective(problem, answer.x.data());
    candidate.start = std::move(answer.x);
  }

  /// The bounds that the whole problem has, which a restriction to be solved is better off without.
  void TakeBoxes(const std::vector<std::int32_t>& variables, ProblemData& data) const {
    const sy_problem& p = whole_.problem();
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (p.x_lower != nullptr) data.x_lower[k] = p.x_lower[variables[k]];
      if (p.x_upper != nullptr) data.x_upper[k] = p.x_upper[variables[k]];
    }
  }

  /// A point that holds counts, whatever its backend says of it.
  void Judge(std::vector<double> x, Candidate& candidate) const {
    const std::string violated = WhatIsViolated(whole_.problem(), x.data(), kFeasibility);
    if (!violated.empty()) {
      if (candidate.termination == SY_OPTIMAL) candidate.termination = SY_NUMERICAL_TROUBLE;
      candidate.text = Join(candidate.text, "its point does not hold: " + violated);
      return;
    }
    candidate.feasible = candidate.verified = true;
    candidate.objective = Objective(whole_.problem(), x.data());
    candidate.x = std::move(x);
  }

  void SolveByFrontEnd(Candidate& candidate) const {
    std::vector<double> x(static_cast<std::size_t>(whole_.problem().num_vars), std::nan(""));
    std::array<char, 512> text{};
    sy_result result{};
    result.size = sizeof result;
    result.objective = result.relaxed = std::nan("");
    result.bound = -kInfinity;
    result.x = x.data();
    result.text = text.data();
    result.text_size = text.size();
    std::vector<double> start;
    if (!candidate.start.empty()) {
      start = InWhole(whole_, Restrict(whole_, candidate.path), candidate.start);
      result.relaxed = candidate.estimate;
      result.relaxed_x = start.data();
    }
    sy_error error{};
    const sy_paths& paths = whole_.paths();
    const sy_control control = budget_.Part(1);
    const sy_status status = paths.solve_path(paths.context, candidate.path.data(),
                                              static_cast<std::int32_t>(candidate.path.size()),
                                              &control, &result, &error);
    if (status < 0) throw std::runtime_error(error.text);
    text.back() = '\0';
    candidate.termination = result.termination;
    candidate.text = text.data();
    candidate.iterations += result.iterations;
    if (result.primal != SY_FEASIBLE || !std::isfinite(result.objective)) return;
    candidate.feasible = true;
    candidate.objective = result.objective;
    candidate.verified = WhatIsViolated(whole_.problem(), x.data(), kFeasibility).empty();
    if (candidate.verified) candidate.x = std::move(x);
  }

  const PathProblem& whole_;
  const sy_host& host_;
  const Options& options_;
  const std::int64_t instances_;
  Budget& budget_;
};

}  // namespace

namespace {

std::vector<double> Improbabilities(const Arcs& arcs, const std::vector<double>& flow,
                                    double tolerance) {
  std::vector<double> through(static_cast<std::size_t>(arcs.num_vertices), 0.0);
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    if (flow[a] > tolerance) through[static_cast<std::size_t>(arcs.tail[a])] += flow[a];
  }
  std::vector<double> length(arcs.size(), kInfinity);
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    if (!(flow[a] > tolerance)) continue;
    length[a] = std::max(0.0, -std::log(flow[a] / through[static_cast<std::size_t>(arcs.tail[a])]));
  }
  return length;
}

/// The path of the largest product of its arcs' parts of the flows out of their tails: a shortest
/// one where an arc's length is -log of its part. None where arcs above the tolerance hold no path.
std::vector<std::int32_t> MostProbablePath(const PathProblem& whole,
                                           const std::vector<double>& flow, double tolerance) {
  const Arcs& arcs = whole.arcs();
  const sy_paths& paths = whole.paths();
  const std::vector<double> length = Improbabilities(arcs, flow, tolerance);
  const std::vector<double> distance = Distances(arcs, whole.out(), length, paths.source);
  const Leaving in(Reversed(arcs));
  std::vector<std::int32_t> path;
  std::vector<std::uint8_t> seen(distance.size(), 0);  // arcs of length 0 may form a cycle
  for (std::int32_t v = paths.target; v != paths.source;) {
    seen[static_cast<std::size_t>(v)] = 1;
    std::int32_t best = -1;
    double best_distance = kInfinity;
    for (const std::int32_t a : in.Of(v)) {
      const auto u = static_cast<std::size_t>(arcs.tail[static_cast<std::size_t>(a)]);
      const double d = distance[u] + length[static_cast<std::size_t>(a)];
      if (seen[u] != 0 || !(d < best_distance)) continue;
      best = a;
      best_distance = d;
    }
    if (best < 0) return {};
    path.push_back(best);
    v = arcs.tail[static_cast<std::size_t>(best)];
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

namespace {

std::vector<double> FlowIn(const PathProblem& whole, const std::vector<double>& x) {
  const sy_paths& paths = whole.paths();
  std::vector<double> flow;
  for (std::int32_t a = 0; a < paths.num_arcs; ++a) {
    flow.push_back(x[static_cast<std::size_t>(paths.flow[a])]);
  }
  return flow;
}

}  // namespace

bool AddPath(std::vector<std::int32_t> path, std::vector<Candidate>& candidates) {
  const bool known = std::any_of(candidates.begin(), candidates.end(),
                                 [&](const Candidate& c) { return c.path == path; });
  if (!known) candidates.emplace_back().path = std::move(path);
  return !known;
}

void AddLikeliest(const PathProblem& whole, const std::vector<double>& x, const Options& options,
                  std::vector<Candidate>& candidates) {
  std::vector<std::int32_t> path =
      MostProbablePath(whole, FlowIn(whole, x), options.flow_tolerance);
  if (!path.empty()) AddPath(std::move(path), candidates);
}

std::vector<double> Improbabilities(const PathProblem& whole, const std::vector<double>& x,
                                    const Options& options) {
  return Improbabilities(whole.arcs(), FlowIn(whole, x), options.flow_tolerance);
}

void SampleCandidates(const PathProblem& whole, const std::vector<double>& x,
                      const Options& options, std::size_t count, Random& random, int& trials,
                      std::vector<Candidate>& candidates) {
  const sy_paths& paths = whole.paths();
  const std::vector<double> flow = FlowIn(whole, x);
  for (; trials > 0 && count > 0; --trials) {
    auto path = SamplePath(whole.arcs(), whole.out(), flow, options.flow_tolerance, paths.source,
                           paths.target, random);
    if (!path) break;  // then no draw finds one
    if (AddPath(std::move(*path), candidates)) --count;
  }
}

namespace {

/// Each of `some` by one of at most `threads` threads, which take the next one that is left.
template <class Do>
void ForEach(const std::vector<Candidate*>& some, std::size_t threads, Do&& act) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < some.size(); k = next++) act(*some[k]);
  };
  std::vector<std::jthread> others;
  for (std::size_t w = 1; w < threads; ++w) others.emplace_back(work);
  work();
}

std::size_t Workers(const std::vector<Candidate*>& some, std::int32_t threads) {
  return std::clamp<std::size_t>(some.size(), 1, static_cast<std::size_t>(std::max(1, threads)));
}

}  // namespace

void CompareCandidates(const PathProblem& whole, const sy_host& host, const Options& options,
                       std::int32_t threads, Budget& budget, std::vector<Candidate>& candidates) {
  std::vector<Candidate*> waiting;
  for (Candidate& c : candidates) {
    if (!c.tried && !std::exchange(c.compared, true)) waiting.push_back(&c);
  }
  const std::size_t workers = Workers(waiting, threads);
  const Solving solving(whole, host, options, static_cast<std::int64_t>(workers), budget);
  ForEach(waiting, workers, [&](Candidate& c) { solving.Compare(c); });
}

void SolveCandidates(const PathProblem& whole, const sy_host& host, const Options& options,
                     std::int32_t threads, Budget& budget, std::vector<Candidate>& candidates) {
  std::vector<Candidate*> all;
  for (Candidate& c : candidates) all.push_back(&c);
  SolveCandidates(whole, host, options, threads, budget, std::move(all));
}

void SolveCandidates(const PathProblem& whole, const sy_host& host, const Options& options,
                     std::int32_t threads, Budget& budget, std::vector<Candidate*> candidates) {
  std::erase_if(candidates, [](Candidate* c) { return std::exchange(c->tried, true); });
  const std::size_t workers = Workers(candidates, threads);
  const Solving solving(whole, host, options, static_cast<std::int64_t>(workers), budget);
  ForEach(candidates, workers, [&](Candidate& c) { solving.Solve(c); });
}

}  // namespace switchyard::rounding
