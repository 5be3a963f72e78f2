// switchyard/solve/result.hpp - what a solve found, in the program's own terms, recomputed there.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/evaluation_counts.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/model/solver_options.hpp"

namespace switchyard {

/// Why a solve ended. The first values are the ABI's.
enum class Termination {
  kNotSolved,
  kOptimal,
  kLocallyOptimal,
  kInfeasible,
  kUnbounded,
  kInfeasibleOrUnbounded,
  kLocallyInfeasible,
  kIterationLimit,
  kTimeLimit,
  kNodeLimit,
  kCancelled,
  kNumericalTrouble,
  kEvaluationFailed,
  kCutoff,
  kTarget,
  kMemoryLimit,
  kNoPath,
  kRestrictionsFailed,
  kNoBackend,
  kBackendFailed
};
/// "optimal", "time_limit", ...: the words of result/1.
SWITCHYARD_EXPORT std::string_view to_string(Termination termination);

/// The one word that Drake's users know for a termination; kNumericalTrouble and whatever has no
/// word of its own is kSolverSpecificError.
enum class SolutionResult {
  kSolutionFound = 0,
  kInvalidInput = -1,
  kInfeasibleConstraints = -2,
  kUnbounded = -3,
  kSolverSpecificError = -4,
  kInfeasibleOrUnbounded = -5,
  kIterationLimit = -6,
  kDualInfeasible = -7,
  kSolutionResultNotSet = -8
};

/// What a vector of the result is.
enum class PointKind { kNone, kFeasible, kNearlyFeasible, kInfeasible, kRay };
SWITCHYARD_EXPORT std::string_view to_string(PointKind kind);

/// How far x is from feasible in the program, absolute; each the largest over its kind.
struct Violation {
  double bounds = 0;
  double rows = 0;
  double cones = 0;
  double integrality = 0;
  double nonlinear = 0;
};

struct SolveTimes {  // seconds
  double read = 0;
  double build = 0;
  double lower = 0;
  double presolve = 0;
  double solve = 0;
  double recover = 0;
  double total = 0;
};

struct Considered {
  std::string solver;
  bool chosen = false;
  std::string why;
};

/// Three things apart: why it stopped, what the primal vector is, what the dual vectors are.
///
/// Nothing here is taken on trust: the objective and violation are recomputed in the program, an
/// optimum of a continuous convex program stands, where the backend gives duals, only if they
/// support it to 1e-6, and certificates are checked. Where the backend's word was not supported,
/// `termination` is kNumericalTrouble and `notes` says what it claimed.
class SWITCHYARD_EXPORT MathematicalProgramResult {
 public:
  /// Solved to optimality, or to a target or local optimum asked for, at a feasible point.
  [[nodiscard]] bool is_success() const;
  Termination termination = Termination::kNotSolved;
  PointKind primal = PointKind::kNone;
  PointKind dual = PointKind::kNone;
  std::string message;               // the backend's own words, or the reason
  std::vector<std::string> notes;    // what was not kept, dropped or replaced
  std::vector<std::string> bridges;  // by name, in order
  std::vector<Considered> considered;

  std::string solver;  // id
  std::string solver_version;
  double objective = std::numeric_limits<double>::quiet_NaN();  // in the program's sense
  /// On the optimum: proven by us from the duals where the program is continuous and convex, which
  /// of functions is taken as declared (NaN: nothing could be proven); the backend's word where
  /// there are integers, or where it proves global optima.
  double bound = std::numeric_limits<double>::quiet_NaN();
  Violation violation;
  std::int64_t iterations = -1;
  std::int64_t nodes = -1;
  EvaluationCounts evaluations;  // of the program's functions by the backend
  SolveTimes seconds;

  /// |objective - bound| / max(1e-10, |objective|); NaN without both.
  [[nodiscard]] double gap() const;

  // ---- By the names of the program ----

  [[nodiscard]] const Eigen::VectorXd& get_x_val() const { return x_; }
  [[nodiscard]] double get_optimal_cost() const { return objective; }
  [[nodiscard]] SolverId get_solver_id() const { return SolverId(solver); }
  /// Throws InvalidArgument where there is no point, or the variable is not the program's.
  [[nodiscard]] double GetSolution(Variable variable) const;
  template <class Derived>
  requires std::is_same_v<typename Derived::Scalar, Variable>
  [[nodiscard]] auto GetSolution(const Eigen::MatrixBase<Derived>& variables) const {
    Eigen::Matrix<double, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> values(
        variables.rows(), variables.cols());
    for (Eigen::Index j = 0; j < variables.cols(); ++j) {
      for (Eigen::Index i = 0; i < variables.rows(); ++i) {
        values(i, j) = GetSolution(variables(i, j));
      }
    }
    return values;
  }
  [[nodiscard]] const Eigen::VectorXd& GetSolution() const { return x_; }
  /// What else the backend found where it keeps a pool, the best first, without the solution
  /// itself: each is feasible and its objective recomputed.
  [[nodiscard]] int num_suboptimal_solution() const { return static_cast<int>(suboptimal_.size()); }
  /// Throws InvalidArgument where `number` is not in [0, num_suboptimal_solution()).
  [[nodiscard]] double get_suboptimal_objective(int number) const;
  /// Likewise, and where the variable is not the program's.
  [[nodiscard]] double GetSuboptimalSolution(Variable variable, int number) const;
  template <class Derived>
  requires std::is_same_v<typename Derived::Scalar, Variable>
  [[nodiscard]] auto GetSuboptimalSolution(const Eigen::MatrixBase<Derived>& variables,
                                           int number) const {
    return variables.derived()
        .unaryExpr([this, number](const Variable& v) { return GetSuboptimalSolution(v, number); })
        .eval();
  }
  /// With the solution's values put for the program's variables; others stay.
  [[nodiscard]] Expression GetSolution(const Expression& e) const;
  template <class Derived>
  requires std::is_same_v<typename Derived::Scalar, Expression>
  [[nodiscard]] auto GetSolution(const Eigen::MatrixBase<Derived>& expressions) const {
    Eigen::Matrix<Expression, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> values(
        expressions.rows(), expressions.cols());
    for (Eigen::Index j = 0; j < expressions.cols(); ++j) {
      for (Eigen::Index i = 0; i < expressions.rows(); ++i) {
        values(i, j) = GetSolution(expressions(i, j));
      }
    }
    return values;
  }
  /// The evaluator's value at the solution.
  template <class C>
  [[nodiscard]] Eigen::VectorXd EvalBinding(const Binding<C>& binding) const {
    Eigen::VectorXd y;
    binding.evaluator()->Eval(GetSolution(binding.variables()), &y);
    return y;
  }
  /// In one word.
  [[nodiscard]] SolutionResult get_solution_result() const;
  /// The shadow price of the constraint's right-hand side: d(optimal cost) / d(rhs), an active
  /// lower side >= 0 and an active upper side <= 0 where the program minimizes; of a cone, the dual
  /// y in its dual cone, -d(cost)/d(b). Throws InvalidArgument where there is none.
  [[nodiscard]] Eigen::VectorXd GetDualSolution(const Binding<Constraint>& constraint) const;
  [[nodiscard]] bool has_duals() const { return !duals_.empty(); }
  /// The constraints that x violates by more than `tolerance`.
  [[nodiscard]] std::vector<Binding<Constraint>> GetInfeasibleConstraints(
      const MathematicalProgram& program, double tolerance = 1e-6) const;
  [[nodiscard]] std::vector<std::string> GetInfeasibleConstraintNames(
      const MathematicalProgram& program, double tolerance = 1e-6) const;

  /// For a layer that answers in variables of its own: x[k] belongs to variables[k], whose ids
  /// ascend.
  void SetPoint(std::vector<Variable> variables, Eigen::VectorXd x);
  /// Has a point, and the variable is one of it?
  [[nodiscard]] bool Knows(Variable variable) const {
    return x_.size() > 0 && IndexOf(variable) >= 0;
  }

 private:
  friend class Recovery;
  [[nodiscard]] int IndexOf(Variable variable) const;

  struct Suboptimal {
    double objective;
    Eigen::VectorXd x;
  };
  [[nodiscard]] const Suboptimal& SuboptimalOf(int number) const;

  Eigen::VectorXd x_;
  std::vector<Suboptimal> suboptimal_;
  std::vector<Variable> variables_;  // ascending
  std::vector<int> index_;           // of each, in the program
  std::vector<std::pair<Binding<Constraint>, Eigen::VectorXd>> duals_;
};

}  // namespace switchyard
