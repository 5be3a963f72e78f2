// A transcribed graph, its hints, what backends make of it, and the points of its program that
// paths are.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/gcs/transcription.hpp"
#include "core/host/instance.hpp"
#include "switchyard/host/host.hpp"

namespace switchyard::testing {

/// A graph's program; Graph has graph, source() and target().
struct Transcribed {
  template <class Graph>
  explicit Transcribed(
      const Graph& of, bool transitions = true,
      GraphOfConvexSets::Transcription as = GraphOfConvexSets::Transcription::kRelaxation)
      : pruned(Prune(of.graph, of.source(), of.target(), true)), program(pruned, as, transitions) {}
  [[nodiscard]] const ProblemData& data() const { return program.problem().data(); }
  [[nodiscard]] const sy_problem& view() const { return program.problem().view(); }
  [[nodiscard]] const sy_blocks& blocks() const { return Hint<sy_blocks>("sy.blocks/1"); }
  [[nodiscard]] const sy_paths& paths() const { return Hint<sy_paths>("sy.paths/1"); }
  /// Empty where an edge was pruned.
  [[nodiscard]] std::vector<std::int32_t> ArcsOf(
      const std::vector<const GraphOfConvexSets::Edge*>& path) const {
    std::vector<std::int32_t> arcs;
    for (const auto* edge : path) {
      const auto at = std::find(pruned.edges.begin(), pruned.edges.end(), edge);
      if (at == pruned.edges.end()) return {};
      arcs.push_back(static_cast<std::int32_t>(at - pruned.edges.begin()));
    }
    return arcs;
  }

  PrunedGraph pruned;
  GcsTranscription program;

 private:
  template <class Record>
  [[nodiscard]] const Record& Hint(const std::string& id) const {
    const sy_hint* hint = data().hints;
    while (hint->id != nullptr && hint->id != id) ++hint;
    return *static_cast<const Record*>(hint->data);
  }
};

struct Solved {
  sy_termination termination = SY_NOT_SOLVED;
  double objective = kInfinity;  // where optimal
  std::vector<double> x;
};

/// By the best backend of the host for a problem without integers.
inline Solved SolvedBy(Host& host, const sy_problem& given) {
  sy_problem problem = given;
  problem.integer = nullptr;
  problem.hints = nullptr;
  Solved solved;
  const auto ranked = host.Rank(problem);
  if (ranked.empty() || !ranked.front().suitable) return solved;
  Instance instance(*host.Facade(*ranked.front().backend), *host.table());
  instance.Load(problem, 0);
  solved.x.assign(static_cast<std::size_t>(problem.num_vars), 0.0);
  sy_control control = {};
  control.size = sizeof control;
  control.threads = 1;
  control.seconds = control.cutoff = kInfinity;
  control.target = -kInfinity;
  control.iterations = control.nodes = std::numeric_limits<std::int64_t>::max();
  control.feasibility = control.optimality = control.integrality = std::nan("");
  control.absolute_gap = control.relative_gap = std::nan("");
  sy_result result{};
  result.size = sizeof result;
  result.x = solved.x.data();
  instance.Solve(control, result);
  solved.termination = result.termination;
  if (result.termination == SY_OPTIMAL) solved.objective = Objective(problem, solved.x.data());
  return solved;
}

/// x with what is NaN in it filled in: by equations that leave one such variable, then, in a
/// problem without cones, by a linear program, else by 1000, as epigraphs may be anything large.
inline std::vector<double> Completed(Host& host, const sy_problem& problem, std::vector<double> x) {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  const Csc rows = Transpose(*problem.A);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::int32_t i = 0; i < problem.num_rows; ++i) {
      if (problem.row_lower[i] != problem.row_upper[i]) continue;
      double left = problem.row_lower[i], value = 0;
      std::int32_t unknown = -1, count = 0;
      for (auto k = at(rows.start[at(i)]); k < at(rows.start[at(i) + 1]); ++k) {
        if (std::isnan(x[at(rows.row[k])])) {
          unknown = rows.row[k];
          value = rows.value[k];
          ++count;
        } else {
          left -= rows.value[k] * x[at(rows.row[k])];
        }
      }
      if (count != 1) continue;
      x[at(unknown)] = left / value;
      changed = true;
    }
  }
  ProblemData rest(problem);
  rest.x_lower.resize(x.size(), -kInfinity);
  rest.x_upper.resize(x.size(), kInfinity);
  bool complete = true;
  for (std::size_t j = 0; j < x.size(); ++j) {
    complete = complete && !std::isnan(x[j]);
    if (!std::isnan(x[j])) rest.x_lower[j] = rest.x_upper[j] = x[j];
    if (std::isnan(x[j]) && problem.num_cones > 0) x[j] = 1000;
  }
  if (complete || problem.num_cones > 0) return x;
  rest.q.assign(x.size(), 0.0);
  return SolvedBy(host, Problem(rest).view()).x;
}

/// The point of the program that a path of arcs is, with a point at each of its vertices. Variables
/// of the path's blocks that no equation ties to these are completed.
inline std::vector<double> PointOfPath(Host& host, const Transcribed& t,
                                       const std::vector<std::int32_t>& arcs,
                                       const std::vector<Eigen::VectorXd>& points) {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  const sy_blocks& blocks = t.blocks();
  const sy_paths& paths = t.paths();
  std::vector<std::uint8_t> on(at(paths.num_arcs), 0);
  for (const std::int32_t a : arcs) on[at(a)] = 1;
  std::vector<double> x(t.data().q.size(), std::nan(""));
  for (std::int32_t j = 0; j < t.data().num_vars; ++j) {
    const std::int32_t b = blocks.x[j];
    const bool is_on = on[at(paths.arc_in[b])] != 0 && on[at(paths.arc_out[b])] != 0;
    if (!is_on) x[at(j)] = 0;
    if (is_on && paths.scale[b] == j) x[at(j)] = 1;
  }
  std::int32_t tail = 0, head = 0;
  for (std::int32_t a = 0; a < paths.num_arcs; ++a) {
    const auto put = [&](const sy_csc& of, std::int32_t first, const Eigen::VectorXd& point) {
      for (Eigen::Index i = 0; i < point.size(); ++i) {
        const std::int32_t k = of.start[first + static_cast<std::int32_t>(i)];
        if (of.row[k] != paths.flow[a]) x[at(of.row[k])] = point[i] / of.value[k];
      }
    };
    const auto place = std::find(arcs.begin(), arcs.end(), a);
    if (place != arcs.end()) {
      const auto k = static_cast<std::size_t>(place - arcs.begin());
      put(paths.tail_point, tail, points[k]);
      put(paths.head_point, head, points[k + 1]);
    }
    tail += paths.dim[paths.tail[a]];
    head += paths.dim[paths.head[a]];
  }
  return Completed(host, t.view(), std::move(x));
}

}  // namespace switchyard::testing
