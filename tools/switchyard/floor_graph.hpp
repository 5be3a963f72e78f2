// tools/switchyard/floor_graph.hpp - a graph of boxes in the plane that a path walks through.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "switchyard/io/graph.hpp"

namespace switchyard::cli {

/// What an edge costs from point to point.
enum class StepCost {
  kLength,  // |x_v - x_u|_2: needs second-order cones
  kLinear,  // |x_v - x_u|_1: linear programs do
};

/// Boxes that meet, joined by edges. The point of a box is where the path enters it: an edge from U
/// to V asks for x_v in U too, so that the way from x_u to x_v stays in U, which is convex.
class FloorGraph {
 public:
  using Vertex = GraphOfConvexSets::Vertex;

  FloorGraph(std::string name, StepCost cost);

  Vertex* AddBox(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, std::string name);
  /// Edges both ways between two boxes that meet.
  void Join(Vertex* a, Vertex* b);
  /// The path leaves from a point of one box and ends in a point of another.
  void SetEnds(const Eigen::Vector2d& start, Vertex* first, const Eigen::Vector2d& goal,
               Vertex* last);
  [[nodiscard]] GraphProblem Take() { return std::move(problem_); }

 private:
  void AddStep(Vertex* u, Vertex* v);

  GraphProblem problem_;
  std::shared_ptr<Cost> cost_;
  SparseMatrix head_;                                // (x_u, x_v) to x_v
  std::vector<std::shared_ptr<Constraint>> inside_;  // x_v in U, by the id of U
};

}  // namespace switchyard::cli
