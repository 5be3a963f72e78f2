// What a second search of a graph costs before a backend is asked, beside building the graph and
// writing its first program.
//
//   search_again [VERTICES [DEGREE [boxes | polytopes]]]
//
// Random boxes, or polytopes of twelve faces, in R^3, each joined to its DEGREE nearest (1000, 5);
// an L2 cost of its own on every edge, a quadratic one on every vertex. Then another source and
// target, other costs, edges switched off: the seconds of presolve and lowering, the median of
// several, and what part they are of the first build and lowering.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
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

/// {x : |x - c|_inf <= 0.4} cut by six more halfspaces.
HPolyhedron Polytope(const Eigen::Vector3d& c, std::mt19937_64& engine) {
  Eigen::MatrixXd A(12, 3);
  A << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity(), Eigen::MatrixXd::Zero(6, 3);
  std::normal_distribution<double> normal;
  for (int i = 6; i < 12; ++i) {
    A.row(i) = Eigen::RowVector3d(normal(engine), normal(engine), normal(engine)).normalized();
  }
  return {A, Eigen::VectorXd(A * c + Eigen::VectorXd::Constant(12, 0.4))};
}

void Build(const std::vector<Eigen::Vector3d>& centers,
           const std::vector<std::pair<int, int>>& pairs, bool polytopes, Built& built) {
  const Eigen::Vector3d half(0.3, 0.2, 0.4);
  std::mt19937_64 engine(2);
  for (const Eigen::Vector3d& c : centers) {
    auto* v = polytopes ? built.graph.AddVertex(Polytope(c, engine))
                        : built.graph.AddVertex(Hyperrectangle(c - half, c + half));
    v->AddCost(Binding<Cost>(std::make_shared<QuadraticCost>(0.1 * Eigen::Matrix3d::Identity(),
                                                             -0.1 * c, 0.05 * c.squaredNorm()),
                             v->x()));
    built.vertices.push_back(v);
  }
  Eigen::MatrixXd A(3, 6);
  A << -Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity();
  for (const auto& [i, j] : pairs) {
    auto* e = built.graph.AddEdge(built.vertices[std::size_t(i)], built.vertices[std::size_t(j)]);
    VectorXDecisionVariable x(6);
    x << e->xu(), e->xv();
    built.costs.push_back(std::make_shared<L2NormCost>(A, Eigen::Vector3d::Zero()));
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

/// Each to its nearest.
std::vector<std::pair<int, int>> Neighbours(const std::vector<Eigen::Vector3d>& centers,
                                            int degree) {
  std::vector<std::pair<int, int>> pairs;
  const auto count = static_cast<int>(centers.size());
  for (int i = 0; i < count; ++i) {
    const auto apart = [&](int j) {
      return (centers[std::size_t(j)] - centers[std::size_t(i)]).squaredNorm();
    };
    std::vector<int> near(centers.size());
    std::iota(near.begin(), near.end(), 0);
    std::partial_sort(near.begin(), near.begin() + degree + 1, near.end(),
                      [&](int a, int b) { return apart(a) < apart(b); });
    for (int k = 1; k <= degree; ++k) pairs.emplace_back(i, near[std::size_t(k)]);
  }
  return pairs;
}

void Compare(Built& built, double build, std::mt19937_64& engine) {
  ShortestPathSearch search(built.graph);
  GraphOfConvexSetsOptions options;
  options.solver_options.time_limit = 1e-9;  // only what comes before a backend
  const auto find = [&](std::size_t s, std::size_t t) {
    return Before(search.Find(*built.vertices[s], *built.vertices[t], options));
  };
  const std::size_t last = built.vertices.size() - 1;
  const double lower = find(0, last);
  fmt::print("{} vertices, {} edges: built in {:.3f} ms, first program {:.3f} ms\n",
             built.vertices.size(), built.costs.size(), 1e3 * build, 1e3 * lower);
  std::uniform_int_distribution<std::size_t> any(0, last);
  const auto repeat = [&](const char* what, const std::function<double()>& once) {
    std::vector<double> seconds;
    for (int k = 0; k < 9; ++k) seconds.push_back(once());
    Report(what, build + lower, seconds);
  };
  repeat("the same", [&] { return find(0, last); });
  repeat("another source", [&] { return find(any(engine), last); });
  repeat("another target", [&] { return find(0, any(engine)); });
  repeat("ten other costs", [&] {
    Eigen::MatrixXd A(3, 6);
    A << -Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity();
    A(0, 0) = -2;
    for (int k = 0; k < 10; ++k) {
      built.costs[any(engine)]->UpdateCoefficients(A, Eigen::Vector3d::Zero());
    }
    return find(0, last);
  });
  const std::vector<GraphOfConvexSets::Edge*> edges = built.graph.Edges();
  repeat("ten edges off", [&] {
    for (int k = 0; k < 10; ++k) edges[any(engine)]->AddPhiConstraint(false);
    return find(0, last);
  });
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::stoi(argv[1]) : 1000;
  const int degree = argc > 2 ? std::stoi(argv[2]) : 5;
  const bool polytopes = argc > 3 && std::string(argv[3]) == "polytopes";
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> at(0, std::cbrt(double(count)));
  std::vector<Eigen::Vector3d> centers;
  for (int i = 0; i < count; ++i) centers.emplace_back(at(engine), at(engine), at(engine));
  const std::vector<std::pair<int, int>> pairs = Neighbours(centers, degree);
  (void)Host::Default().backends();  // finds the plugins
  const auto start = Clock::now();
  Built built;
  Build(centers, pairs, polytopes, built);
  Compare(built, Since(start), engine);
  return 0;
}
