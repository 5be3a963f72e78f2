// A shortest path from a point to another, through one of two rooms.
#include <iostream>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"

using namespace switchyard;

int main() {
  GraphOfConvexSets graph;
  const auto room = [&](double left, double right, double low, double high, const char* name) {
    return graph.AddVertex(Hyperrectangle(Eigen::Vector2d(left, low), Eigen::Vector2d(right, high)),
                           name);
  };
  auto* start = graph.AddVertex(Point(Eigen::Vector2d(0, 0)), "start");
  auto* above = room(1, 2, 2, 3, "above");
  auto* below = room(1, 2, -2, -1, "below");
  auto* goal = graph.AddVertex(Point(Eigen::Vector2d(4, -1)), "goal");
  for (auto* way : {above, below}) {
    for (auto* edge : {graph.AddEdge(start, way), graph.AddEdge(way, goal)}) {
      edge->AddCost((edge->xu() - edge->xv()).norm());
    }
  }

  const ShortestPath found = FindShortestPath(graph, *start, *goal);
  if (found.edges.empty()) {
    std::cerr << found.result.message << "\n";
    return 1;
  }
  std::cout << "through the room " << found.edges.front()->v().name() << ", at "
            << found.points[1].transpose() << ": " << found.result.objective
            << ", and no path is shorter than " << found.result.bound << "\n";
}
