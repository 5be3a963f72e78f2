// switchyard/model/program.hpp - an optimization program: variables, and costs and constraints
// bound to them. It knows no solver.
#pragma once

#include <concepts>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/binding.hpp"
#include "switchyard/model/constraint.hpp"
#include "switchyard/model/cost.hpp"
#include "switchyard/model/name_table.hpp"
#include "switchyard/model/variable.hpp"

namespace switchyard {

enum class ObjectiveSense { kMinimize, kMaximize };

/// minimize (or maximize) the sum of the costs over the variables, subject to every constraint.
///
/// Variables are added in blocks; evaluators are shared, never copied, by bindings. Adding throws
/// InvalidArgument for a variable of another program, a size that does not fit, a number that is
/// NaN, and leaves the program as it was. Not thread-safe while it changes; const use is.
class SWITCHYARD_EXPORT MathematicalProgram {
 public:
  MathematicalProgram() = default;
  MathematicalProgram& operator=(const MathematicalProgram&) = delete;

  /// Another program with the same variables (ids included); evaluators are shared.
  [[nodiscard]] std::unique_ptr<MathematicalProgram> Clone() const;

  void set_name(std::string name) { name_ = std::move(name); }
  [[nodiscard]] const std::string& name() const { return name_; }
  void set_objective_sense(ObjectiveSense sense) {
    sense_ = sense;
    ++structure_version_;
  }
  [[nodiscard]] ObjectiveSense objective_sense() const { return sense_; }

  /// Grows when variables, bindings or the sense are added, removed or changed; coefficients have
  /// versions of their own.
  [[nodiscard]] std::uint64_t structure_version() const { return structure_version_; }

  // ---- Variables ----

  VectorXDecisionVariable NewContinuousVariables(int rows, const std::string& name = "x");
  VectorXDecisionVariable NewBinaryVariables(int rows, const std::string& name = "b");
  VectorXDecisionVariable NewIntegerVariables(int rows, const std::string& name = "z");
  MatrixXDecisionVariable NewContinuousVariables(int rows, int cols, const std::string& name = "X");
  MatrixXDecisionVariable NewBinaryVariables(int rows, int cols, const std::string& name = "B");
  template <int Rows, int Cols = 1>
  MatrixDecisionVariable<Rows, Cols> NewContinuousVariables(const std::string& name = "X") {
    if constexpr (Cols == 1) {
      return NewContinuousVariables(Rows, name);
    } else {
      return NewContinuousVariables(Rows, Cols, name);
    }
  }
  template <int Rows, int Cols = 1>
  MatrixDecisionVariable<Rows, Cols> NewBinaryVariables(const std::string& name = "b") {
    if constexpr (Cols == 1) {
      return NewBinaryVariables(Rows, name);
    } else {
      return NewBinaryVariables(Rows, Cols, name);
    }
  }
  /// rows x rows with X(i, j) and X(j, i) one variable: rows (rows + 1) / 2 new ones.
  MatrixXDecisionVariable NewSymmetricContinuousVariables(int rows, const std::string& name = "X");
  /// One variable for each name and type: what file readers use.
  VectorXDecisionVariable NewVariables(std::vector<std::string> names,
                                       const std::vector<VariableType>& types);
  /// Variables of another program, under their ids, with generic names and continuous; those that
  /// are here already stay as they are.
  void AddDecisionVariables(const VariableList& variables);

  [[nodiscard]] int num_vars() const { return static_cast<int>(types_.size()); }
  [[nodiscard]] Variable decision_variable(int i) const;
  [[nodiscard]] VectorXDecisionVariable decision_variables() const;
  [[nodiscard]] VariableType variable_type(int i) const {
    return types_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] bool has_integers() const;
  /// Throws InvalidArgument where the variable is not of this program.
  [[nodiscard]] int FindDecisionVariableIndex(Variable variable) const;
  [[nodiscard]] std::vector<int> FindDecisionVariableIndices(const VariableList& variables) const;
  [[nodiscard]] bool Contains(Variable variable) const { return FindIndex(variable) >= 0; }
  /// The name of variable i: "x", "x(3)" or "X(1,2)", or the one that a file gave.
  [[nodiscard]] std::string VariableName(int i) const { return names_.Name(i); }

  // ---- Costs: their sum is the objective ----

  Binding<LinearCost> AddLinearCost(const VectorRef& a, double b, const VariableList& vars);
  Binding<LinearCost> AddLinearCost(const VectorRef& a, const VariableList& vars);
  /// 1/2 x'Qx + b'x + c.
  Binding<QuadraticCost> AddQuadraticCost(const CoefficientMatrix& Q, const VectorRef& b, double c,
                                          const VariableList& vars,
                                          std::optional<bool> is_convex = std::nullopt);
  Binding<QuadraticCost> AddQuadraticCost(const CoefficientMatrix& Q, const VectorRef& b,
                                          const VariableList& vars,
                                          std::optional<bool> is_convex = std::nullopt);
  /// (x - x_desired)'Q(x - x_desired), with Q = w I for a number w.
  Binding<QuadraticCost> AddQuadraticErrorCost(const CoefficientMatrix& Q,
                                               const VectorRef& x_desired,
                                               const VariableList& vars);
  Binding<QuadraticCost> AddQuadraticErrorCost(double w, const VectorRef& x_desired,
                                               const VariableList& vars);
  /// |Ax - b|_2^2.
  Binding<QuadraticCost> Add2NormSquaredCost(const CoefficientMatrix& A, const VectorRef& b,
                                             const VariableList& vars);
  /// |Ax + b|_2.
  Binding<L2NormCost> AddL2NormCost(const CoefficientMatrix& A, const VectorRef& b,
                                    const VariableList& vars);

  /// Stores a binding by the type of its evaluator, whatever type the binding names.
  Binding<Cost> AddCost(const Binding<Cost>& binding);
  template <class C>
  requires(std::derived_from<C, Cost> &&
           !std::same_as<C, Cost>) Binding<C> AddCost(const Binding<C>& binding) {
    AddCost(Binding<Cost>(binding));
    return binding;
  }
  template <class C>
  requires std::derived_from<C, Cost> Binding<C> AddCost(const std::shared_ptr<C>& cost,
                                                         const VariableList& vars) {
    return AddCost(Binding<C>(cost, vars));
  }

  // ---- Constraints ----

  /// lower <= Ax <= upper.
  Binding<LinearConstraint> AddLinearConstraint(CoefficientMatrix A, const VectorRef& lower,
                                                const VectorRef& upper, const VariableList& vars);
  Binding<LinearConstraint> AddLinearConstraint(const Eigen::Ref<const Eigen::RowVectorXd>& a,
                                                double lower, double upper,
                                                const VariableList& vars);
  Binding<LinearEqualityConstraint> AddLinearEqualityConstraint(CoefficientMatrix A,
                                                                const VectorRef& b,
                                                                const VariableList& vars);
  Binding<LinearEqualityConstraint> AddLinearEqualityConstraint(
      const Eigen::Ref<const Eigen::RowVectorXd>& a, double b, const VariableList& vars);
  Binding<BoundingBoxConstraint> AddBoundingBoxConstraint(const VectorRef& lower,
                                                          const VectorRef& upper,
                                                          const VariableList& vars);
  Binding<BoundingBoxConstraint> AddBoundingBoxConstraint(double lower, double upper,
                                                          const VariableList& vars);
  /// Ax + b, or the variables themselves, in the cone; see constraint.hpp for each cone's form.
  Binding<LorentzConeConstraint> AddLorentzConeConstraint(CoefficientMatrix A, const VectorRef& b,
                                                          const VariableList& vars);
  Binding<LorentzConeConstraint> AddLorentzConeConstraint(const VariableList& vars);
  Binding<RotatedLorentzConeConstraint> AddRotatedLorentzConeConstraint(CoefficientMatrix A,
                                                                        const VectorRef& b,
                                                                        const VariableList& vars);
  Binding<RotatedLorentzConeConstraint> AddRotatedLorentzConeConstraint(const VariableList& vars);
  Binding<ExponentialConeConstraint> AddExponentialConeConstraint(CoefficientMatrix A,
                                                                  const VectorRef& b,
                                                                  const VariableList& vars);
  Binding<PowerConeConstraint> AddPowerConeConstraint(CoefficientMatrix A, const VectorRef& b,
                                                      double alpha, const VariableList& vars);
  /// A symmetric matrix of variables is positive semidefinite.
  Binding<PositiveSemidefiniteConstraint> AddPositiveSemidefiniteConstraint(
      const Eigen::Ref<const MatrixXDecisionVariable>& X);
  Binding<LinearMatrixInequalityConstraint> AddLinearMatrixInequalityConstraint(
      const std::vector<Eigen::MatrixXd>& F, const VariableList& vars);

  /// Stores a binding by the type of its evaluator, whatever type the binding names.
  Binding<Constraint> AddConstraint(const Binding<Constraint>& binding);
  template <class C>
  requires(std::derived_from<C, Constraint> &&
           !std::same_as<C, Constraint>) Binding<C> AddConstraint(const Binding<C>& binding) {
    AddConstraint(Binding<Constraint>(binding));
    return binding;
  }
  template <class C>
  requires std::derived_from<C, Constraint> Binding<C> AddConstraint(
      const std::shared_ptr<C>& constraint, const VariableList& vars) {
    return AddConstraint(Binding<C>(constraint, vars));
  }

  /// How many bindings equal to the given one were removed.
  int RemoveCost(const Binding<Cost>& cost);
  int RemoveConstraint(const Binding<Constraint>& constraint);

  // ---- What is stored ----

  [[nodiscard]] const std::vector<Binding<LinearCost>>& linear_costs() const {
    return linear_costs_;
  }
  [[nodiscard]] const std::vector<Binding<QuadraticCost>>& quadratic_costs() const {
    return quadratic_costs_;
  }
  [[nodiscard]] const std::vector<Binding<NormCost>>& norm_costs() const { return norm_costs_; }
  [[nodiscard]] const std::vector<Binding<BoundingBoxConstraint>>& bounding_box_constraints()
      const {
    return bounding_boxes_;
  }
  /// Rows lower <= Ax <= upper, equalities among them.
  [[nodiscard]] const std::vector<Binding<LinearConstraint>>& affine_constraints() const {
    return affine_;
  }
  /// All cones.
  [[nodiscard]] const std::vector<Binding<ConeConstraint>>& cone_constraints() const {
    return cones_;
  }
  [[nodiscard]] std::vector<Binding<LinearConstraint>> linear_constraints() const;
  [[nodiscard]] std::vector<Binding<LinearEqualityConstraint>> linear_equality_constraints() const;
  [[nodiscard]] std::vector<Binding<LorentzConeConstraint>> lorentz_cone_constraints() const;
  [[nodiscard]] std::vector<Binding<RotatedLorentzConeConstraint>>
  rotated_lorentz_cone_constraints() const;
  [[nodiscard]] std::vector<Binding<Cost>> GetAllCosts() const;
  [[nodiscard]] std::vector<Binding<Constraint>> GetAllConstraints() const;

  // ---- Evaluation at a point x of num_vars() entries ----

  template <class C>
  [[nodiscard]] Eigen::VectorXd EvalBinding(const Binding<C>& binding, VectorRef x) const {
    Eigen::VectorXd y;
    binding.evaluator()->Eval(ValuesOf(binding.variables(), x), &y);
    return y;
  }
  /// The sum of the costs.
  [[nodiscard]] double EvalCosts(const VectorRef& x) const;
  [[nodiscard]] bool CheckSatisfied(const Binding<Constraint>& binding, const VectorRef& x,
                                    double tolerance = 1e-6) const;
  /// The entries of x that belong to `variables`.
  [[nodiscard]] Eigen::VectorXd ValuesOf(const VectorXDecisionVariable& variables,
                                         const VectorRef& x) const;

  // ---- Initial guess: NaN where unset, and NaN unsets ----

  void SetInitialGuess(Variable variable, double value);
  void SetInitialGuess(const VariableList& variables, const VectorRef& values);
  void SetInitialGuessForAllVariables(const VectorRef& values);
  [[nodiscard]] double GetInitialGuess(Variable variable) const;
  [[nodiscard]] Eigen::VectorXd GetInitialGuess(const VariableList& variables) const;
  [[nodiscard]] Eigen::VectorXd initial_guess() const;

 private:
  MathematicalProgram(const MathematicalProgram&) = default;  // Clone's

  struct Block {  // consecutive ids under consecutive indices
    Variable::Id first_id;
    int first_index;
    int count;
  };
  VectorXDecisionVariable AddBlock(std::int64_t count, VariableType type);
  VectorXDecisionVariable NewVector(int rows, VariableType type, const std::string& name);
  MatrixXDecisionVariable NewMatrix(int rows, int cols, VariableType type, const std::string& name);
  [[nodiscard]] int FindIndex(Variable variable) const;  // -1: not of this program
  void CheckVariables(const EvaluatorBase& evaluator, const VectorXDecisionVariable& vars) const;

  std::string name_;
  ObjectiveSense sense_ = ObjectiveSense::kMinimize;
  std::uint64_t structure_version_ = 0;
  std::vector<Block> blocks_;        // by first_id
  std::vector<Variable> variables_;  // by index, as types_
  std::vector<VariableType> types_;
  NameTable names_;
  std::map<int, double> guess_;  // of those that have one
  std::vector<Binding<LinearCost>> linear_costs_;
  std::vector<Binding<QuadraticCost>> quadratic_costs_;
  std::vector<Binding<NormCost>> norm_costs_;
  std::vector<Binding<BoundingBoxConstraint>> bounding_boxes_;
  std::vector<Binding<LinearConstraint>> affine_;
  std::vector<Binding<ConeConstraint>> cones_;
};

}  // namespace switchyard
