// What a graph costs before any backend sees it: grids of boxes in the plane, built, pruned and
// transcribed, with a time limit of 0 so that nothing is solved.
//
//   graph_scale [SIZE ...]          (default 10 20 50 100 200 250)
//
// A size of n is n x n boxes and 4 n (n - 1) edges; the last column should not grow.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <vector>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/sets/hyperrectangle.hpp"

namespace {

using namespace switchyard;

struct Built {
  std::unique_ptr<GraphOfConvexSets> graph = std::make_unique<GraphOfConvexSets>();
  std::vector<GraphOfConvexSets::Vertex*> vertices;
};

Built Build(int size) {
  Built built;
  Eigen::MatrixXd A(2, 4);
  A << -1, 0, 1, 0, 0, -1, 0, 1;
  const auto cost = std::make_shared<L2NormCost>(A, Eigen::Vector2d::Zero());
  for (int i = 0; i < size * size; ++i) {
    const Eigen::Vector2d corner(i / size, i % size);
    built.vertices.push_back(
        built.graph->AddVertex(Hyperrectangle(corner, corner + Eigen::Vector2d(0.8, 0.8))));
  }
  const auto connect = [&](int a, int b) {
    auto* edge = built.graph->AddEdge(built.vertices[static_cast<std::size_t>(a)],
                                      built.vertices[static_cast<std::size_t>(b)]);
    edge->AddCost(Binding<Cost>(cost, VariableList({edge->xu(), edge->xv()})));
  };
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      const int at = i * size + j;
      for (const int other : {j + 1 < size ? at + 1 : -1, i + 1 < size ? at + size : -1}) {
        if (other < 0) continue;
        connect(at, other);
        connect(other, at);
      }
    }
  }
  return built;
}

double PeakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {10, 20, 50, 100, 200, 250};
  std::cout << fmt::format("{:>6} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>12}\n", "size",
                           "edges", "build s", "prune s", "lower s", "total s", "graph MB",
                           "peak MB", "us per edge");
  for (const int size : sizes) {
    const auto start = std::chrono::steady_clock::now();
    const Built built = Build(size);
    const double build =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double graph_megabytes = PeakMegabytes();
    GraphOfConvexSetsOptions options;
    options.solver_options.time_limit = 0;
    const ShortestPath found =
        FindShortestPath(*built.graph, *built.vertices.front(), *built.vertices.back(), options);
    const double prune = found.result.seconds.presolve;
    const double lower = found.result.seconds.lower;
    const int edges = built.graph->num_edges();
    std::cout << fmt::format("{:6} {:8} {:9.3f} {:9.3f} {:9.3f} {:9.3f} {:8.0f} {:8.0f} {:12.2f}\n",
                             size, edges, build, prune, lower, build + prune + lower,
                             graph_megabytes, PeakMegabytes(),
                             1e6 * (build + prune + lower) / edges);
  }
}
