// Grids of sets in the plane, with every kind of cost that a graph can have.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "switchyard/gcs/graph_of_convex_sets.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard::testing {

enum class EdgeCost { kL1, kL2, kSquared, kLinear };

/// `size` x `size` boxes (or balls) around jittered grid points, edges both ways between
/// neighbours, the first and the last vertex a point.
struct Grid {
  Grid(int size, EdgeCost kind, unsigned seed, bool balls = false) : engine(seed) {
    for (int i = 0; i < size * size; ++i) {
      const Eigen::Vector2d center(i / size + Jitter(), i % size + Jitter());
      const double half = 0.2 + std::abs(Jitter());
      if (i == 0 || i == size * size - 1) {
        vertices.push_back(graph.AddVertex(Point(center)));
      } else if (balls) {
        vertices.push_back(graph.AddVertex(Hyperellipsoid::MakeHypersphere(half, center)));
      } else {
        vertices.push_back(graph.AddVertex(Hyperrectangle(
            center - Eigen::Vector2d::Constant(half), center + Eigen::Vector2d::Constant(half))));
      }
    }
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        const int at = size * i + j;
        if (j + 1 < size) Connect(at, at + 1, kind);
        if (i + 1 < size) Connect(at, at + size, kind);
      }
    }
  }

  void Connect(int a, int b, EdgeCost kind) {
    AddEdge(a, b, kind);
    AddEdge(b, a, kind);
  }
  GraphOfConvexSets::Edge* AddEdge(int a, int b, EdgeCost kind) {
    auto* edge =
        graph.AddEdge(vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)]);
    VectorXDecisionVariable x(4);
    x << edge->xu(), edge->xv();
    edge->AddCost(Binding<Cost>(CostOf(kind), x));
    return edge;
  }
  std::shared_ptr<Cost> CostOf(EdgeCost kind) {
    Eigen::MatrixXd A(2, 4);
    A << -1, 0, 1, 0, 0, -1, 0, 1;
    const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
    switch (kind) {
      case EdgeCost::kL1:
        return std::make_shared<L1NormCost>(A, zero);
      case EdgeCost::kL2:
        return std::make_shared<L2NormCost>(A, zero);
      case EdgeCost::kSquared:
        return std::make_shared<QuadraticCost>(2 * A.transpose() * A, Eigen::VectorXd::Zero(4));
      default:
        return std::make_shared<LinearCost>(Eigen::Vector4d(0.1, 0, 0.2, 0.1), 1 + Jitter());
    }
  }
  double Jitter() { return std::uniform_real_distribution<double>(-0.2, 0.2)(engine); }
  const GraphOfConvexSets::Vertex& source() const { return *vertices.front(); }
  const GraphOfConvexSets::Vertex& target() const { return *vertices.back(); }

  std::mt19937_64 engine;
  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
};

/// All simple paths.
inline void SimplePaths(const GraphOfConvexSets::Vertex& at,
                        const GraphOfConvexSets::Vertex& target,
                        std::vector<const GraphOfConvexSets::Edge*>& path,
                        std::vector<const GraphOfConvexSets::Vertex*>& seen,
                        std::vector<std::vector<const GraphOfConvexSets::Edge*>>& all) {
  if (&at == &target) {
    all.push_back(path);
    return;
  }
  seen.push_back(&at);
  for (const GraphOfConvexSets::Edge* edge : at.outgoing_edges()) {
    if (std::find(seen.begin(), seen.end(), &edge->v()) != seen.end()) continue;
    path.push_back(edge);
    SimplePaths(edge->v(), target, path, seen, all);
    path.pop_back();
  }
  seen.pop_back();
}

inline std::vector<std::vector<const GraphOfConvexSets::Edge*>> SimplePaths(
    const GraphOfConvexSets::Vertex& source, const GraphOfConvexSets::Vertex& target) {
  std::vector<std::vector<const GraphOfConvexSets::Edge*>> all;
  std::vector<const GraphOfConvexSets::Edge*> path;
  std::vector<const GraphOfConvexSets::Vertex*> seen;
  SimplePaths(source, target, path, seen, all);
  return all;
}

}  // namespace switchyard::testing
