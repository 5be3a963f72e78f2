#include <iostream>

#include "switchyard/model/program.hpp"
#include "switchyard/solve/solve.hpp"

int main() {
  using std::exp;
  switchyard::MathematicalProgram prog;
  const auto x = prog.NewContinuousVariables(2, "x");

  // A function of one's own: its first and second derivatives are exact, by its operations.
  prog.AddCost(
      [](const auto& v) {
        const auto bend = v[1] - v[0] * v[0];
        return 100 * bend * bend + (1 - v[0]) * (1 - v[0]);
      },
      x);
  prog.AddConstraint(x.squaredNorm() <= 1.5);  // an expression: a quadratic constraint
  prog.AddConstraint(exp(x[0]) + x[1] <= 3);   // another: a function
  prog.SetInitialGuess(x, Eigen::Vector2d(-1.2, 1));

  const auto result = switchyard::Solve(prog);
  if (!result.is_success()) {
    std::cerr << result.message << "\n";
    return 1;
  }
  std::cout << to_string(result.termination) << " by " << result.solver << ": "
            << result.get_optimal_cost() << " at " << result.GetSolution(x).transpose()
            << ", after " << result.evaluations.hessian << " Hessians\n";
}
