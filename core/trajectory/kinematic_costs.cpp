// Costs of the duration and of the whole path.
#include <cmath>
#include <numbers>
#include <utility>

#include "core/trajectory/kinematic_point.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

constexpr int kMostPoints = 100;

void CheckWeight(const char* call, double weight) {
  Require(weight >= 0 && std::isfinite(weight), call,
          " needs a weight of 0 or more and finite, got ", weight);
}

/// scale (-I, I): from two points to their difference.
SparseMatrix Difference(int n, double scale) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, -scale);
    entries.emplace_back(i, n + i, scale);
  }
  SparseMatrix A(n, 2 * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

struct Node {
  double at;
  double weight;
};

/// The nodes on [-1, 1]: the zeros of the Legendre polynomial P_m, by Newton's method from
/// cos(pi (i + 3/4) / (m + 1/2)), with the weights 2 / ((1 - x^2) P_m'(x)^2) (Abramowitz and
/// Stegun, Handbook of Mathematical Functions, 25.4.29).
std::vector<Node> GaussLegendre(int m) {
  std::vector<Node> nodes;
  for (int i = 0; i < m; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (m + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double before = 1, value = x;  // P_0, P_1
      for (int k = 2; k <= m; ++k) {
        before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
      }
      slope = m * (x * value - before) / (x * x - 1);
      x -= value / slope;
      if (std::abs(value / slope) <= 1e-16) break;
    }
    nodes.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace

Binding<LinearCost> KinematicTrajectoryOptimization::AddDurationCost(double weight) {
  Require(std::isfinite(weight), "AddDurationCost needs a finite weight, got ", weight);
  return program_.AddLinearCost(Eigen::VectorXd::Constant(1, weight), duration_);
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddPathLengthCost(
    double weight, bool use_conic_constraint) {
  CheckWeight("AddPathLengthCost", weight);
  const int n = num_positions();
  const SparseMatrix A = Difference(n, weight);
  const Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  const auto length = std::make_shared<L2NormCost>(A, b);
  length->set_description("path length");
  std::vector<Binding<Cost>> added;
  for (int j = 1; j < num_control_points(); ++j) {
    const VariableList leg = control_points_.middleCols(j - 1, 2);
    if (use_conic_constraint) {
      added.push_back(std::get<1>(program_.AddL2NormCostUsingConicConstraint(A, b, leg)));
    } else {
      added.push_back(program_.AddCost(length, leg));
    }
  }
  return added;
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddPathEnergyCost(double weight) {
  CheckWeight("AddPathEnergyCost", weight);
  const SparseMatrix A = Difference(num_positions(), 1);
  const auto energy = std::make_shared<QuadraticCost>(
      SparseMatrix(2 * weight * (A.transpose() * A)), Eigen::VectorXd::Zero(A.cols()), 0, true);
  energy->set_description("path energy");
  std::vector<Binding<Cost>> added;
  for (int j = 1; j < num_control_points(); ++j) {
    added.push_back(program_.AddCost(energy, control_points_.middleCols(j - 1, 2)));
  }
  return added;
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddIntegral(
    const std::string& call, const Binding<Cost>& binding, int points, bool timed) {
  Require(points >= 1 && points <= kMostPoints, call, " needs from 1 to ", kMostPoints,
          " points for each interval, got ", points);
  const std::vector<Node> nodes = GaussLegendre(points);
  std::vector<Binding<Cost>> all;
  for (int i = basis_.degree(); i < num_control_points(); ++i) {
    const double begin = basis_.knots()[static_cast<std::size_t>(i)];
    const double half = (basis_.knots()[static_cast<std::size_t>(i) + 1] - begin) / 2;
    if (half == 0) continue;
    for (const Node& node : nodes) {
      all.push_back(CostAt(call, binding, begin + (1 + node.at) * half, half * node.weight, timed));
    }
  }
  for (const auto& one : all) program_.AddCost(one);
  return all;
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddTimeIntegralCost(
    const Binding<Cost>& binding, int points) {
  return AddIntegral("AddTimeIntegralCost", binding, points, true);
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddPathIntegralCost(
    const Binding<Cost>& binding, int points) {
  return AddIntegral("AddPathIntegralCost", binding, points, false);
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddTimeIntegralCost(const Expression& e,
                                                                                int points) {
  return AddTimeIntegralCost(ParseCost(e), points);
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddPathIntegralCost(const Expression& e,
                                                                                int points) {
  return AddPathIntegralCost(ParseCost(e), points);
}

}  // namespace switchyard
