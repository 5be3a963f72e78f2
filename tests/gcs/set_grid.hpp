// Random graphs over sets of every kind, and the points of their programs that paths are.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "core/gcs/transcription.hpp"
#include "core/host/instance.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/gcs/grid.hpp"

namespace switchyard::testing {

enum class SetKind { kBox, kPolyhedron, kEllipsoid, kVPolytope, kPoint, kNothing };

/// Grids of overlapping sets around jittered points, edges both ways between neighbours less a few,
/// some of them twice. Costs are norms of x_v - x_u where both ends have two coordinates, else
/// constants; some vertices and edges have a row that the points inside keep.
class SetGrid {
 public:
  SetGrid(int width, int height, const std::vector<SetKind>& kinds, EdgeCost cost, unsigned seed,
          double size = 0.7)
      : engine_(seed) {
    for (int k = 0; k < width * height; ++k) {
      const bool end = k == 0 || k == width * height - 1;
      AddVertex(Eigen::Vector2d(k % width + Uniform(-0.2, 0.2), k / width + Uniform(-0.2, 0.2)),
                end ? SetKind::kPoint : kinds[engine_() % kinds.size()], size);
    }
    for (int k = 0; k < width * height; ++k) {
      if (k % width + 1 < width) Connect(k, k + 1, cost);
      if (k / width + 1 < height) Connect(k, k + width, cost);
    }
  }

  double Uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  [[nodiscard]] const GraphOfConvexSets::Vertex& source() const { return *vertices.front(); }
  [[nodiscard]] const GraphOfConvexSets::Vertex& target() const { return *vertices.back(); }
  [[nodiscard]] std::vector<std::vector<const GraphOfConvexSets::Edge*>> Paths() const {
    return SimplePaths(source(), target());
  }

  /// A point in each set of a path that keeps the rows of its vertices and edges.
  std::vector<Eigen::VectorXd> PointsOn(const std::vector<const GraphOfConvexSets::Edge*>& path) {
    std::vector<const GraphOfConvexSets::Vertex*> along = {&source()};
    for (const auto* edge : path) along.push_back(&edge->v());
    std::vector<Eigen::VectorXd> drawn;
    for (const auto* v : along) drawn.push_back(Draw(*v));
    for (double share = 1;; share = share > 1e-3 ? share / 2 : 0) {
      std::vector<Eigen::VectorXd> points;
      for (std::size_t k = 0; k < along.size(); ++k) {
        points.emplace_back(Inside(*along[k]) + share * (drawn[k] - Inside(*along[k])));
      }
      if (share == 0 || RowsHold(along, path, points)) return points;
    }
  }

  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;

 private:
  void AddVertex(const Eigen::Vector2d& inside, SetKind kind, double size) {
    const Eigen::Vector2d half(Uniform(0.3, 1) * size, Uniform(0.3, 1) * size);
    inside_.emplace_back(inside);
    switch (kind) {
      case SetKind::kBox:
        vertices.push_back(graph.AddVertex(Hyperrectangle(inside - half, inside + half)));
        break;
      case SetKind::kPolyhedron:
        vertices.push_back(graph.AddVertex(PolyhedronAround(inside, size)));
        break;
      case SetKind::kEllipsoid: {
        const Eigen::Matrix2d A =
            half.cwiseInverse().asDiagonal() * Eigen::Rotation2Dd(Uniform(0, 3)).toRotationMatrix();
        vertices.push_back(graph.AddVertex(Hyperellipsoid(A, inside)));
        break;
      }
      case SetKind::kVPolytope: {
        Eigen::MatrixXd corners = Eigen::MatrixXd::NullaryExpr(
            2, 5, [&](Eigen::Index, Eigen::Index) { return Uniform(-size, size); });
        corners.colwise() += inside - corners.rowwise().mean();
        vertices.push_back(graph.AddVertex(VPolytope(corners)));
        break;
      }
      case SetKind::kPoint:
        vertices.push_back(graph.AddVertex(Point(inside)));
        break;
      case SetKind::kNothing:
        inside_.back() = Eigen::VectorXd();
        vertices.push_back(graph.AddVertex(Point(Eigen::VectorXd())));
        break;
    }
    if (kind != SetKind::kNothing && Uniform(0, 1) < 0.3) AddRowAt(*vertices.back());
    if (Uniform(0, 1) < 0.3) {
      vertices.back()->AddCost(Binding<Cost>(
          std::make_shared<LinearCost>(Eigen::VectorXd::Constant(inside_.back().size(), 0.1), 1),
          vertices.back()->x()));
    }
  }

  HPolyhedron PolyhedronAround(const Eigen::Vector2d& inside, double size) {
    Eigen::MatrixXd A(7, 2);
    A << Eigen::MatrixXd::NullaryExpr(3, 2,
                                      [&](Eigen::Index, Eigen::Index) { return Uniform(-1, 1); }),
        Eigen::Matrix2d::Identity(), -Eigen::Matrix2d::Identity();
    Eigen::VectorXd b = A * inside;
    for (double& side : b) side += Uniform(0.3, 1) * size;
    return {A, b};
  }

  /// a'x <= a'inside + 0.3.
  void AddRowAt(GraphOfConvexSets::Vertex& v) {
    const Eigen::Vector2d a(Uniform(-1, 1), Uniform(-1, 1));
    v.AddConstraint(Binding<Constraint>(
        std::make_shared<LinearConstraint>(a.transpose(), Eigen::VectorXd::Constant(1, -kInfinity),
                                           Eigen::VectorXd::Constant(1, a.dot(Inside(v)) + 0.3)),
        v.x()));
  }

  void Connect(int a, int b, EdgeCost cost) {
    if (Uniform(0, 1) < 0.1) return;
    AddEdge(a, b, cost);
    AddEdge(b, a, cost);
    if (Uniform(0, 1) < 0.15) AddEdge(a, b, cost);
  }

  void AddEdge(int a, int b, EdgeCost cost) {
    GraphOfConvexSets::Edge* edge =
        graph.AddEdge(vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)]);
    VectorXDecisionVariable x(edge->xu().size() + edge->xv().size());
    x << edge->xu(), edge->xv();
    if (x.size() < 4 || cost == EdgeCost::kLinear) {
      edge->AddCost(Binding<Cost>(
          std::make_shared<LinearCost>(Eigen::VectorXd::Constant(x.size(), 0.1), Uniform(1, 2)),
          x));
    } else {
      edge->AddCost(Binding<Cost>(NormCost(cost), x));
    }
    if (x.size() < 4 || Uniform(0, 1) > 0.2) return;
    Eigen::VectorXd inside(4);
    inside << Inside(edge->u()), Inside(edge->v());
    const Eigen::VectorXd row =
        Eigen::VectorXd::NullaryExpr(4, [&](Eigen::Index) { return Uniform(-1, 1); });
    edge->AddConstraint(Binding<Constraint>(
        std::make_shared<LinearConstraint>(row.transpose(),
                                           Eigen::VectorXd::Constant(1, -kInfinity),
                                           Eigen::VectorXd::Constant(1, row.dot(inside) + 0.3)),
        x));
  }

  static std::shared_ptr<Cost> NormCost(EdgeCost kind) {
    Eigen::MatrixXd A(2, 4);
    A << -1, 0, 1, 0, 0, -1, 0, 1;
    const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
    if (kind == EdgeCost::kL1) return std::make_shared<L1NormCost>(A, zero);
    if (kind == EdgeCost::kL2) return std::make_shared<L2NormCost>(A, zero);
    return std::make_shared<QuadraticCost>(2 * A.transpose() * A, Eigen::VectorXd::Zero(4));
  }

  [[nodiscard]] const Eigen::VectorXd& Inside(const GraphOfConvexSets::Vertex& v) const {
    return inside_[static_cast<std::size_t>(v.id().value)];
  }

  Eigen::VectorXd Draw(const GraphOfConvexSets::Vertex& v) {
    if (const auto point = v.set().MaybeGetPoint()) return *point;
    if (const auto* polytope = dynamic_cast<const VPolytope*>(&v.set())) {
      Eigen::VectorXd weight = Eigen::VectorXd::NullaryExpr(
          polytope->vertices().cols(), [&](Eigen::Index) { return Uniform(0, 1); });
      return polytope->vertices() * weight / weight.sum();
    }
    const Eigen::Vector2d step(Uniform(-1.5, 1.5), Uniform(-1.5, 1.5));
    for (double share = 1;; share *= 0.8) {
      const Eigen::VectorXd x = Inside(v) + share * step;
      if (v.set().PointInSet(x)) return x;
    }
  }

  static bool RowsHold(const std::vector<const GraphOfConvexSets::Vertex*>& along,
                       const std::vector<const GraphOfConvexSets::Edge*>& path,
                       const std::vector<Eigen::VectorXd>& points) {
    const auto holds = [](const auto& owner, const Eigen::VectorXd& x) {
      const auto all = owner.GetConstraints();
      return std::all_of(all.begin(), all.end(), [&](const Binding<Constraint>& c) {
        return c.evaluator()->CheckSatisfied(x, 0);
      });
    };
    for (std::size_t k = 0; k < along.size(); ++k) {
      if (!holds(*along[k], points[k])) return false;
    }
    for (std::size_t k = 0; k < path.size(); ++k) {
      Eigen::VectorXd ends(points[k].size() + points[k + 1].size());
      ends << points[k], points[k + 1];
      if (!holds(*path[k], ends)) return false;
    }
    return true;
  }

  std::mt19937_64 engine_;
  std::vector<Eigen::VectorXd> inside_;  // a point of each set that keeps all rows
};

}  // namespace switchyard::testing
