// Two products share the hours of a machine and the kilograms of a material. How much of each?
#include <iostream>

#include "switchyard/model/program.hpp"
#include "switchyard/solve/solve.hpp"

int main() {
  switchyard::MathematicalProgram prog;
  const auto made = prog.NewContinuousVariables(2, "made");

  prog.AddLinearCost(Eigen::Vector2d(-30, -20), made);              // a unit earns 30 or 20
  prog.AddLinearConstraint(Eigen::RowVector2d(2, 1), 0, 40, made);  // hours
  prog.AddLinearConstraint(Eigen::RowVector2d(1, 2), 0, 50, made);  // kilograms
  prog.AddBoundingBoxConstraint(0, 100, made);

  const auto result = switchyard::Solve(prog);  // the least cost, by the best backend that is there
  if (!result.is_success()) {
    std::cerr << "no plan was found\n";
    return 1;
  }
  std::cout << "make " << result.GetSolution(made).transpose() << ", which earns "
            << -result.get_optimal_cost() << "\n";
}
