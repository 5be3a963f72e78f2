#include "floor_graph.hpp"

#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard::cli {
namespace {

SparseMatrix Sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

Eigen::MatrixXd Difference() {
  Eigen::MatrixXd d(2, 4);
  d << -1, 0, 1, 0, 0, -1, 0, 1;
  return d;
}

Eigen::MatrixXd Head() {
  Eigen::MatrixXd h(2, 4);
  h << 0, 0, 1, 0, 0, 0, 0, 1;
  return h;
}

std::shared_ptr<Cost> Make(StepCost cost) {
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  if (cost == StepCost::kLength) return std::make_shared<L2NormCost>(Sparse(Difference()), zero);
  return std::make_shared<L1NormCost>(Sparse(Difference()), zero);
}

}  // namespace

FloorGraph::FloorGraph(std::string name, StepCost cost) : cost_(Make(cost)), head_(Sparse(Head())) {
  problem_.name = std::move(name);
  problem_.graph = std::make_unique<GraphOfConvexSets>();
}

FloorGraph::Vertex* FloorGraph::AddBox(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper,
                                       std::string name) {
  inside_.push_back(std::make_shared<LinearConstraint>(head_, lower, upper));
  return problem_.graph->AddVertex(std::make_shared<Hyperrectangle>(lower, upper), std::move(name));
}

void FloorGraph::Join(Vertex* a, Vertex* b) {
  AddStep(a, b);
  AddStep(b, a);
}

void FloorGraph::AddStep(Vertex* u, Vertex* v) {
  auto* edge = problem_.graph->AddEdge(u, v);
  const VariableList ends{u->x(), v->x()};
  edge->AddCost({cost_, ends});
  edge->AddConstraint({inside_[static_cast<std::size_t>(u->id().value)], ends});
}

void FloorGraph::SetEnds(const Eigen::Vector2d& start, Vertex* first, const Eigen::Vector2d& goal,
                         Vertex* last) {
  problem_.source = problem_.graph->AddVertex(std::make_shared<Point>(start), "start");
  problem_.target = problem_.graph->AddVertex(std::make_shared<Point>(goal), "goal");
  const auto add = [this](Vertex* u, Vertex* v) {
    problem_.graph->AddEdge(u, v)->AddCost({cost_, VariableList{u->x(), v->x()}});
  };
  add(problem_.source, first);  // both ends lie in `first`
  add(last, problem_.target);
}

}  // namespace switchyard::cli
