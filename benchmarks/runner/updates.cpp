// What conic saves on a problem that changes a little: the symbolic phase, and iterations.
//
//   updates GRAPH... [--change SHARE]
//
// For the relaxation of each graph of convex sets, its costs are changed by a normal share each,
// and the changed problem is solved after a load, after an update, from where the last solve ended
// (SY_CONTINUE), from its answer as a start (warm_start), and by a clone. Times in ms, the least of
// five.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/gcs/pruning.hpp"
#include "core/gcs/transcription.hpp"
#include "solvers/conic/conic.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/io/graph.hpp"
#include "switchyard/problem_update.hpp"

namespace {

using namespace switchyard;
using conic::Conic;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Answer {
  explicit Answer(const sy_problem& p)
      : x(std::size_t(p.num_vars)),
        row_dual(std::size_t(p.num_rows)),
        cone_dual(std::size_t(p.num_cone_rows)) {
    raw.size = sizeof raw;
    raw.x = x.data();
    raw.row_dual = row_dual.data();
    raw.cone_dual = cone_dual.data();
  }
  sy_result raw{};
  std::vector<double> x, row_dual, cone_dual;
};

void Solve(Conic& solver, std::uint32_t flags, Answer& answer) {
  sy_control c{};
  c.size = sizeof c;
  c.flags = flags;
  c.threads = 1;
  c.seconds = c.cutoff = kInfinity;
  c.iterations = c.nodes = std::numeric_limits<std::int64_t>::max();
  c.target = -kInfinity;
  c.feasibility = c.optimality = c.integrality = c.absolute_gap = c.relative_gap = kNaN;
  solver.Solve(c, answer.raw);
}

Problem Changed(const sy_problem& problem, double share) {
  ProblemData data(problem);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (double& q : data.q) q *= 1 + share * normal(random);
  return Problem(std::move(data));
}

struct Measured {
  double prepare = kInfinity, solve = kInfinity;  // ms
  std::int64_t iterations = 0;
};

/// `prepare` makes the solver ready, which is then solved with.
Measured Measure(const sy_problem& problem, std::uint32_t flags,
                 const std::function<void(std::unique_ptr<Conic>&)>& first,
                 const std::function<void(std::unique_ptr<Conic>&)>& prepare) {
  Measured m;
  for (int k = 0; k < 5; ++k) {
    std::unique_ptr<Conic> solver;
    first(solver);
    const auto begin = std::chrono::steady_clock::now();
    prepare(solver);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    Answer answer(problem);
    Solve(*solver, flags, answer);
    m.prepare = std::min(m.prepare, took.count());
    m.solve = std::min(m.solve, 1e3 * answer.raw.seconds);
    m.iterations = answer.raw.iterations;
  }
  return m;
}

void Compare(const std::string& file, double share) {
  const GraphProblem g = ReadGraph(file);
  const PrunedGraph pruned = Prune(*g.graph, *g.source, *g.target, true);
  const GcsTranscription transcription(pruned, GraphOfConvexSets::Transcription::kRelaxation);
  const rounding::PathProblem paths(transcription.problem().view());
  const sy_problem& before = paths.relaxation();
  const Problem after = Changed(before, share);
  sy_host host{};
  host.size = sizeof host;
  sy_update update{};
  update.size = sizeof update;
  update.whole = SY_UPDATES_VECTORS;
  update.problem = &after.view();
  Answer old(before);
  const auto solved = [&](std::unique_ptr<Conic>& solver) {
    solver = std::make_unique<Conic>(host);
    solver->Load(before, SY_UPDATES_VECTORS);
    Solve(*solver, 0, old);
  };
  const auto updated = [&](std::unique_ptr<Conic>& solver) { solver->Update(update); };
  const auto row = [&](const char* how, const Measured& m) {
    const std::string name = file.substr(file.rfind('/') + 1);
    fmt::print("{:<30}{:<12}{:>10.2f}{:>10.2f}{:>6}\n", name, how, m.prepare, m.solve,
               m.iterations);
  };
  row("load", Measure(
                  before, 0, [](auto&) {},
                  [&](std::unique_ptr<Conic>& solver) {
                    solver = std::make_unique<Conic>(host);
                    solver->Load(after.view(), SY_UPDATES_VECTORS);
                  }));
  row("update", Measure(before, 0, solved, updated));
  row("continue", Measure(before, SY_CONTINUE, solved, updated));
  row("warm start", Measure(before, 0, solved, [&](std::unique_ptr<Conic>& solver) {
        sy_start start{};
        start.size = sizeof start;
        start.x = old.x.data();
        start.row_dual = old.row_dual.data();
        start.cone_dual = old.cone_dual.data();
        solver->Update(update);
        solver->WarmStart(start);
      }));
  row("clone", Measure(before, 0, solved, [&](std::unique_ptr<Conic>& solver) {
        solver->Update(update);
        solver = solver->Clone();
      }));
}

}  // namespace

int main(int argc, char** argv) try {
  double share = 0.01;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--change" && i + 1 < argc) {
      share = std::stod(argv[++i]);
    } else {
      files.push_back(word);
    }
  }
  fmt::print("{:<30}{:<12}{:>10}{:>10}{:>6}\n", "graph", "after", "ready ms", "solve ms", "iter");
  for (const std::string& file : files) Compare(file, share);
  return 0;
} catch (const std::exception& e) {
  fmt::print(stderr, "updates: {}\n", e.what());
  return 2;
}
