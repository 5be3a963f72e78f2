#include "switchyard/solve/result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/model/eigenvalues.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr std::array<std::string_view, 20> kTerminations = {
    "not_solved",         "optimal",         "locally_optimal",
    "infeasible",         "unbounded",       "infeasible_or_unbounded",
    "locally_infeasible", "iteration_limit", "time_limit",
    "node_limit",         "cancelled",       "numerical_trouble",
    "evaluation_failed",  "cutoff",          "target",
    "memory_limit",       "no_path",         "restrictions_failed",
    "no_backend",         "backend_failed"};
static_assert(static_cast<int>(Termination::kRestrictionsFailed) == SY_RESTRICTIONS_FAILED);
static_assert(static_cast<int>(Termination::kBackendFailed) + 1 == kTerminations.size());

constexpr std::array<std::string_view, 5> kKinds = {"none", "feasible", "nearly_feasible",
                                                    "infeasible", "ray"};

}  // namespace

std::string_view to_string(Termination termination) {
  return kTerminations[static_cast<std::size_t>(termination)];
}

std::string_view to_string(PointKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

bool MathematicalProgramResult::is_success() const {
  return primal == PointKind::kFeasible &&
         (termination == Termination::kOptimal || termination == Termination::kLocallyOptimal ||
          termination == Termination::kTarget);
}

double MathematicalProgramResult::gap() const {
  if (std::isnan(objective) || std::isnan(bound)) return std::nan("");
  return std::abs(objective - bound) / std::max(1e-10, std::abs(objective));
}

void MathematicalProgramResult::SetPoint(std::vector<Variable> variables, Eigen::VectorXd x) {
  Require(static_cast<Eigen::Index>(variables.size()) == x.size(), "a point of ", variables.size(),
          " variables needs as many entries, got ", x.size());
  variables_ = std::move(variables);
  x_ = std::move(x);
  index_.resize(variables_.size());
  std::iota(index_.begin(), index_.end(), 0);
}

int MathematicalProgramResult::IndexOf(Variable variable) const {
  const auto place =
      std::lower_bound(variables_.begin(), variables_.end(), variable, std::less<Variable>());
  if (place == variables_.end() || *place != variable) return -1;
  return index_[static_cast<std::size_t>(place - variables_.begin())];
}

double MathematicalProgramResult::GetSolution(Variable variable) const {
  Require(x_.size() > 0, "there is no solution to read: the solve ended with ",
          to_string(termination));
  const int j = IndexOf(variable);
  Require(j >= 0, "GetSolution: the variable with id ", variable.get_id(),
          " is not of the program that was solved");
  return x_[j];
}

const MathematicalProgramResult::Suboptimal& MathematicalProgramResult::SuboptimalOf(
    int number) const {
  Require(number >= 0 && number < num_suboptimal_solution(), "there are ",
          num_suboptimal_solution(), " suboptimal solutions, and number ", number, " is asked for");
  return suboptimal_[static_cast<std::size_t>(number)];
}

double MathematicalProgramResult::get_suboptimal_objective(int number) const {
  return SuboptimalOf(number).objective;
}

double MathematicalProgramResult::GetSuboptimalSolution(Variable variable, int number) const {
  const Suboptimal& solution = SuboptimalOf(number);
  const int j = IndexOf(variable);
  Require(j >= 0, "GetSuboptimalSolution: the variable with id ", variable.get_id(),
          " is not of the program that was solved");
  return solution.x[j];
}

Expression MathematicalProgramResult::GetSolution(const Expression& e) const {
  Expression::Substitution values;
  for (const Variable v : e.GetVariables()) {
    if (Knows(v)) values.emplace(v, Expression(GetSolution(v)));
  }
  return e.Substitute(values);
}

SolutionResult MathematicalProgramResult::get_solution_result() const {
  if (is_success()) return SolutionResult::kSolutionFound;
  switch (termination) {
    case Termination::kNotSolved:
      return SolutionResult::kSolutionResultNotSet;
    case Termination::kInfeasible:
    case Termination::kLocallyInfeasible:
    case Termination::kNoPath:
      return SolutionResult::kInfeasibleConstraints;
    case Termination::kUnbounded:
      return SolutionResult::kUnbounded;
    case Termination::kInfeasibleOrUnbounded:
      return SolutionResult::kInfeasibleOrUnbounded;
    case Termination::kIterationLimit:
    case Termination::kTimeLimit:
    case Termination::kNodeLimit:
      return SolutionResult::kIterationLimit;
    default:
      return SolutionResult::kSolverSpecificError;
  }
}

Eigen::VectorXd MathematicalProgramResult::GetDualSolution(
    const Binding<Constraint>& constraint) const {
  for (const auto& [binding, values] : duals_) {
    if (binding == constraint) return values;
  }
  Refuse("there is no dual of ", constraint.evaluator()->Name(), ": ",
         duals_.empty() ? "the backend gave none" : "it was not in the program that was solved");
}

std::vector<Binding<Constraint>> MathematicalProgramResult::GetInfeasibleConstraints(
    const MathematicalProgram& program, double tolerance) const {
  std::vector<Binding<Constraint>> violated;
  for (const auto& binding : program.GetAllConstraints()) {
    if (!program.CheckSatisfied(binding, x_, tolerance)) violated.push_back(binding);
  }
  return violated;
}

namespace {

// "c[1]: 0 <= -2 <= 3" for each row that is outside; of a cone by how much, and of a matrix which
// eigenvalue.
void DescribeViolation(const Constraint& constraint, const Eigen::VectorXd& y, double tolerance,
                       double violation, std::vector<std::string>& names) {
  if (const auto* cone = dynamic_cast<const ConeConstraint*>(&constraint)) {
    std::string how = Text("violated by ", violation);
    if (cone->cone().kind == SY_CONE_PSD) {
      const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(y.size())));
      how = DescribeNegativeEigenvalues(Eigen::Map<const Eigen::MatrixXd>(y.data(), n, n));
    }
    names.push_back(Text(constraint.Name(), ": ", how));
    return;
  }
  for (int i = 0; i < constraint.num_constraints(); ++i) {
    const double lower = constraint.lower_bound()[i];
    const double upper = constraint.upper_bound()[i];
    if (y[i] >= lower - tolerance && y[i] <= upper + tolerance) continue;
    names.push_back(Text(constraint.RowName(i), ": ", lower, " <= ", y[i], " <= ", upper));
  }
}

}  // namespace

std::vector<std::string> MathematicalProgramResult::GetInfeasibleConstraintNames(
    const MathematicalProgram& program, double tolerance) const {
  std::vector<std::string> names;
  for (const auto& binding : GetInfeasibleConstraints(program, tolerance)) {
    DescribeViolation(*binding.evaluator(), program.EvalBinding(binding, x_), tolerance,
                      binding.evaluator()->Violation(program.ValuesOf(binding.variables(), x_)),
                      names);
  }
  return names;
}

}  // namespace switchyard
