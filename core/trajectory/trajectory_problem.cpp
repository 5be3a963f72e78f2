#include "core/trajectory/trajectory_problem.hpp"

#include <cmath>

namespace switchyard {

void TrajectoryProblem::Know(const JointGroup& joints) {
  for (std::size_t k = 0; k < joints.edges.size(); ++k) {
    const auto id = static_cast<std::size_t>(joints.edges[k]->id().value);
    if (id >= of_edge.size()) of_edge.resize(id + 1);
    of_edge[id] = {&joints, k};
  }
}

DerivativeBound CheckedBound(const std::string& call, int n, int order, const VectorRef& lower,
                             const VectorRef& upper) {
  Require(lower.size() == n && upper.size() == n, call, " needs lb and ub of ", n, " entries, got ",
          lower.size(), " and ", upper.size());
  for (int i = 0; i < n; ++i) {
    Require(lower[i] <= upper[i] && lower[i] < kInfinity && upper[i] > -kInfinity, call,
            " needs lb <= ub, got lb[", i, "] = ", lower[i], " and ub[", i, "] = ", upper[i]);
  }
  return {order, lower, upper};
}

DerivativeBound CheckedNonlinearBound(const std::string& call, int n, int order,
                                      const VectorRef& lower, const VectorRef& upper) {
  Require(order >= 2, call, " needs a derivative order of 2 or more, got ", order,
          ": for velocities there is AddVelocityBounds");
  return CheckedBound(call, n, order, lower, upper);
}

void CheckWeight(const std::string& call, int n, const Eigen::MatrixXd& W) {
  Require(W.cols() == n && W.allFinite(), call, " needs a finite weight matrix of ", n,
          " columns, got ", W.rows(), " x ", W.cols());
}

void CheckWeight(const std::string& call, double weight) {
  Require(weight >= 0 && std::isfinite(weight), call, " needs a finite weight of 0 or more, got ",
          weight);
}

}  // namespace switchyard
