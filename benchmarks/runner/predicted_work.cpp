// Does the time of conic's iterations grow as the predicted work of a factorization does?
//
//   predicted_work [SET=]GRAPH...
//
// For the relaxation of each graph of convex sets one line of a table that work_plot.py draws: its
// set (the file's name up to the first digit, where none is given), the multiplications that a
// factorization is predicted to take, and what an iteration took, the least of three solves.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "core/gcs/pruning.hpp"
#include "core/gcs/transcription.hpp"
#include "solvers/conic/interior_point.hpp"
#include "solvers/conic/prepared.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/io/graph.hpp"

namespace {

using namespace switchyard;

void Measure(const std::string& set, const std::string& file) {
  const GraphProblem g = ReadGraph(file);
  const PrunedGraph pruned = Prune(*g.graph, *g.source, *g.target, true);
  const GcsTranscription transcription(pruned, GraphOfConvexSets::Transcription::kRelaxation);
  const rounding::PathProblem paths(transcription.problem().view());
  const ProblemData problem(paths.relaxation());
  conic::Prepared prepared(problem, problem.num_vars, {}, 0, nullptr);
  double least = kInfinity;
  int iterations = 0;
  for (int k = 0; k < 3; ++k) {
    conic::InteriorPoint method(prepared.form(), prepared.kkt(), {}, {});
    const auto begin = std::chrono::steady_clock::now();
    iterations = method.Solve().iterations;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    least = std::min(least, took.count() / iterations);
  }
  const std::string name = file.substr(file.rfind('/') + 1);
  fmt::print("{},{},{:.0f},{:.6f},{}\n",
             set.empty() ? name.substr(0, name.find_first_of("0123456789.")) : set,
             name.substr(0, name.find('.')), prepared.kkt().factors().work(), least, iterations);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  fmt::print("set,instance,predicted work,seconds per iteration,iterations\n");
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t sign = word.find('=');
    const bool named = sign != std::string::npos;
    Measure(named ? word.substr(0, sign) : "", named ? word.substr(sign + 1) : word);
  }
  return 0;
} catch (const std::exception& e) {
  fmt::print(stderr, "predicted_work: {}\n", e.what());
  return 2;
}
