// What a second search of a graph costs before a backend is asked, beside building the graph and
// writing its first program.
//
//   search_again [VERTICES [DEGREE]]
//
// Random boxes in the plane, each joined to its DEGREE nearest (1000, 5); an L2 cost of its own on
// every edge, a quadratic one on every vertex. Then another source and target, other costs, edges
// switched off: the seconds of presolve and lowering, the median of several, and what part they are
// of the first build and lowering.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/sets/hyperrectangle.hpp"

namespace {

using namespace switchyard;
using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Built {
  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
  std::vector<std::shared_ptr<L2NormCost>> costs;
};

void Build(const std::vector<Eigen::Vector2d>& centers,
           const std::vector<std::pair<int, int>>& pairs, Built& built) {
  const Eigen::Vector2d half(0.3, 0.2);
  for (const Eigen::Vector2d& c : centers) {
    auto* v = built.graph.AddVertex(Hyperrectangle(c - half, c + half));
    v->AddCost(Binding<Cost>(std::make_shared<QuadraticCost>(0.1 * Eigen::Matrix2d::Identity(),
                                                             -0.1 * c, 0.05 * c.squaredNorm()),
                             v->x()));
    built.vertices.push_back(v);
  }
  Eigen::MatrixXd A(2, 4);
  A << -1, 0, 1, 0, 0, -1, 0, 1;
  for (const auto& [i, j] : pairs) {
    auto* e = built.graph.AddEdge(built.vertices[std::size_t(i)], built.vertices[std::size_t(j)]);
    VectorXDecisionVariable x(4);
    x << e->xu(), e->xv();
    built.costs.push_back(std::make_shared<L2NormCost>(A, Eigen::Vector2d::Zero()));
    e->AddCost(Binding<Cost>(built.costs.back(), x));
  }
}

/// Of presolve and lowering: what stands between the question and the backend.
double Before(const ShortestPath& found) {
  return found.result.seconds.presolve + found.result.seconds.lower;
}

void Report(const char* what, double first, std::vector<double> later) {
  std::sort(later.begin(), later.end());
  const double median = later[later.size() / 2];
  fmt::print("{:<28} {:>10.3f} ms {:>8.3f} of the first\n", what, 1e3 * median, median / first);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::stoi(argv[1]) : 1000;
  const int degree = argc > 2 ? std::stoi(argv[2]) : 5;
  std::mt19937_64 engine(1);
  const double side = std::sqrt(double(count));
  std::uniform_real_distribution<double> at(0, side);
  std::vector<Eigen::Vector2d> centers;
  for (int i = 0; i < count; ++i) centers.emplace_back(at(engine), at(engine));
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < count; ++i) {
    std::vector<int> near(static_cast<std::size_t>(count));
    for (int j = 0; j < count; ++j) near[std::size_t(j)] = j;
    std::partial_sort(near.begin(), near.begin() + degree + 1, near.end(), [&](int a, int b) {
      return (centers[std::size_t(a)] - centers[std::size_t(i)]).squaredNorm() <
             (centers[std::size_t(b)] - centers[std::size_t(i)]).squaredNorm();
    });
    for (int k = 1; k <= degree; ++k) pairs.emplace_back(i, near[std::size_t(k)]);
  }
  auto start = Clock::now();
  Built built;
  Build(centers, pairs, built);
  const double build = Since(start);
  ShortestPathSearch search(built.graph);
  GraphOfConvexSetsOptions options;
  options.solver_options.time_limit = 1e-9;  // only what comes before a backend
  const auto find = [&](std::size_t s, std::size_t t) {
    return Before(search.Find(*built.vertices[s], *built.vertices[t], options));
  };
  const std::size_t last = built.vertices.size() - 1;
  const double lower = find(0, last);
  const double first = build + lower;
  fmt::print("{} vertices, {} edges: built in {:.3f} ms, first program {:.3f} ms\n", count,
             pairs.size(), 1e3 * build, 1e3 * lower);
  std::uniform_int_distribution<std::size_t> any(0, last);
  const auto repeat = [&](const char* what, const std::function<double()>& once) {
    std::vector<double> seconds;
    for (int k = 0; k < 9; ++k) seconds.push_back(once());
    Report(what, first, seconds);
  };
  repeat("the same", [&] { return find(0, last); });
  repeat("another source", [&] { return find(any(engine), last); });
  repeat("another target", [&] { return find(0, any(engine)); });
  repeat("ten other costs", [&] {
    Eigen::MatrixXd A(2, 4);
    A << -2, 0, 2, 0, 0, -1, 0, 1;
    for (int k = 0; k < 10; ++k) {
      built.costs[any(engine)]->UpdateCoefficients(A, Eigen::Vector2d::Zero());
    }
    return find(0, last);
  });
  const std::vector<GraphOfConvexSets::Edge*> edges = built.graph.Edges();
  repeat("ten edges off", [&] {
    for (int k = 0; k < 10; ++k) edges[any(engine)]->AddPhiConstraint(false);
    return find(0, last);
  });
  return 0;
}
