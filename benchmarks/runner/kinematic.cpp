// Seven joints from rest to rest in minimum time along a short path, under bounds of velocity,
// acceleration and jerk: what building the program takes, what one evaluation of its functions
// takes, and what Ipopt takes to solve it.
//
//   kinematic [--json] [OPTION=VALUE ...] [CONTROL_POINTS ...]
//
// The optimum is that of duration plus path length. An option is Ipopt's. Times are the best of
// several turns; an evaluation is values, Jacobian and Hessian of all nonlinear rows; `solve` is
// from the program to the trajectory, of which `backend` is Ipopt. The violation is the largest of
// a bound, in rad / s^k. drake/compare_kinematic reads what --json prints.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace {

using namespace switchyard;
using Eigen::VectorXd;

constexpr int kTurns = 5;

VectorXd Vector(const std::vector<double>& values) {
  return VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
}

const VectorXd kGoal = Vector({1.0, -0.8, 0.6, -1.2, 0.4, 0.9, -0.5});   // rad, from 0
const VectorXd kVelocity = Vector({2.0, 2.0, 2.0, 2.0, 2.5, 2.5, 2.5});  // rad / s
const VectorXd kAcceleration = VectorXd::Constant(7, 5.0);               // rad / s^2
const VectorXd kJerk = VectorXd::Constant(7, 30.0);                      // rad / s^3
constexpr double kLeastDuration = 0.1, kMostDuration = 50;               // s
constexpr double kPosition = 3;                                          // rad

class Stopwatch {
 public:
  [[nodiscard]] double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::unique_ptr<KinematicTrajectoryOptimization> Built(int num_control_points) {
  const auto n = static_cast<int>(kGoal.size());
  auto problem = std::make_unique<KinematicTrajectoryOptimization>(n, num_control_points);
  const VectorXd zero = VectorXd::Zero(n), position = VectorXd::Constant(n, kPosition);
  problem->AddDurationConstraint(kLeastDuration, kMostDuration);
  problem->AddDurationCost();
  problem->AddPathLengthCost();
  problem->AddPositionBounds(-position, position);
  problem->AddVelocityBounds(-kVelocity, kVelocity);
  problem->AddAccelerationBounds(-kAcceleration, kAcceleration);
  problem->AddJerkBounds(-kJerk, kJerk);
  problem->AddPathPositionConstraint(zero, zero, 0);
  problem->AddPathPositionConstraint(kGoal, kGoal, 1);
  problem->AddPathVelocityConstraint(zero, zero, 0);
  problem->AddPathVelocityConstraint(zero, zero, 1);
  return problem;
}

/// Values, Jacobian and Hessian of all functions of the program at the initial guess.
double EvaluationSeconds(const MathematicalProgram& program) {
  struct Term {
    std::shared_ptr<Constraint> rows;
    VectorXd x, values, weights;
    std::vector<double> jacobian, hessian;
  };
  std::vector<Term> terms;
  for (const auto& binding : program.generic_constraints()) {
    const auto& rows = binding.evaluator();
    const VectorXd some = VectorXd::Ones(rows->num_constraints());
    terms.push_back({rows, program.GetInitialGuess(binding.variables()), some, some,
                     std::vector<double>(rows->JacobianPattern().row.size()),
                     std::vector<double>(rows->HessianPattern().row.size())});
  }
  constexpr int kTimes = 100;
  const Stopwatch watch;
  for (int k = 0; k < kTimes; ++k) {
    for (Term& term : terms) {
      term.rows->Evaluate({term.x.data(), term.values.data(), term.jacobian.data(),
                           term.weights.data(), term.hessian.data()});
    }
  }
  return watch.Seconds() / kTimes;
}

struct Row {
  int points;
  double build, evaluate, solve, backend;  // seconds
  KinematicTrajectory found;
};

Row Measured(int num_control_points, const SolverOptions& options) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const SolverInterface ipopt("ipopt");
  Row row{num_control_points, kNever, kNever, kNever, kNever, {}};
  for (int turn = 0; turn < kTurns; ++turn) {
    const Stopwatch building;
    const auto problem = Built(num_control_points);
    row.build = std::min(row.build, building.Seconds());
    row.evaluate = std::min(row.evaluate, EvaluationSeconds(problem->prog()));
    const Stopwatch solving;
    row.found = problem->FindTrajectory(options, &ipopt);
    row.solve = std::min(row.solve, solving.Seconds());
    row.backend = std::min(row.backend, row.found.result.seconds.solve);
  }
  return row;
}

double WorstViolation(const KinematicTrajectory& found) {
  double worst = 0;
  for (const double one : found.bound_violation) worst = std::max(worst, one);
  return worst;
}

void PrintTable(const std::vector<Row>& rows) {
  fmt::print("{:>6} {:>9} {:>12} {:>9} {:>10} {:>5} {:>11} {:>10} {:>10}\n", "points", "build ms",
             "evaluate ms", "solve s", "backend s", "iter", "optimum", "T", "violation");
  for (const Row& row : rows) {
    const auto& result = row.found.result;
    fmt::print("{:6} {:9.3f} {:12.4f} {:9.4f} {:10.4f} {:5} {:11.6f} {:10.6f} {:10.1e}  {}\n",
               row.points, 1e3 * row.build, 1e3 * row.evaluate, row.solve, row.backend,
               result.iterations, result.objective,
               row.found.trajectory ? row.found.trajectory->end_time() : 0.0,
               WorstViolation(row.found), to_string(result.termination));
  }
}

std::string Listed(const VectorXd& v) { return fmt::format("[{}]", fmt::join(v, ", ")); }

// The problem, and a line for each row.
void PrintJson(const std::vector<Row>& rows) {
  fmt::print(
      "{{\"goal\": {}, \"position\": {}, \"velocity\": {}, \"acceleration\": {}, \"jerk\": {}, "
      "\"duration\": [{}, {}]}}\n",
      Listed(kGoal), kPosition, Listed(kVelocity), Listed(kAcceleration), Listed(kJerk),
      kLeastDuration, kMostDuration);
  for (const Row& row : rows) {
    const auto& result = row.found.result;
    fmt::print(
        "{{\"points\": {}, \"build\": {}, \"evaluate\": {}, \"solve\": {}, "
        "\"iterations\": {}, \"objective\": {}, \"violation\": {}, \"status\": \"{}\"}}\n",
        row.points, row.build, row.evaluate, row.solve, result.iterations, result.objective,
        WorstViolation(row.found), to_string(result.termination));
  }
}

}  // namespace

int main(int count, char** words) {
  std::vector<int> sizes;
  SolverOptions options;
  bool json = false;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto equals = word.find('=');
    if (word == "--json") {
      json = true;
    } else if (equals != std::string::npos) {
      options.SetOption(SolverId("ipopt"), word.substr(0, equals), word.substr(equals + 1));
    } else if (const int size = std::atoi(words[i]); size >= 4) {
      sizes.push_back(size);
    } else {
      fmt::print(stderr, "CONTROL_POINTS needs to be 4 or more, got {}\n", word);
      return 2;
    }
  }
  if (sizes.empty()) sizes = {10, 20, 50, 200};
  std::vector<Row> rows;
  for (const int size : sizes) rows.push_back(Measured(size, options));
  json ? PrintJson(rows) : PrintTable(rows);
}
