// switchyard/model/program_terms.hpp - the costs and constraints of a program, given by matrices
// and functions, and what is stored of them.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/make_function.hpp"
#include "switchyard/model/binding.hpp"
#include "switchyard/model/constraint.hpp"
#include "switchyard/model/cost.hpp"
#include "switchyard/model/function_terms.hpp"
#include "switchyard/model/program_variables.hpp"

namespace switchyard {

/// What a caller may say of a function that is a term.
struct FunctionTermOptions {
  std::string description = {};  // what messages call it
  /// See FunctionCost and FunctionConstraint.
  bool is_convex = false;
  FunctionOptions function = {};
};

/// Something to be called with the values of variables: see MakeFunction for its three forms.
template <class F>
concept UserFunction = std::is_class_v<F> && !std::derived_from<F, EvaluatorBase> &&
                       functions_detail::CallableWithAVector<F>;

/// The part of MathematicalProgram that speaks of bindings: of affine functions in boxes and cones,
/// of linear, quadratic and norm costs, and of functions. A binding is stored by the type of its
/// evaluator, whatever type the binding names.
class SWITCHYARD_EXPORT ProgramTerms : public ProgramVariables {
 public:
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

  /// The same as a new variable s with the cost s and the cone s >= |Ax + b|_2.
  std::tuple<Variable, Binding<LinearCost>, Binding<LorentzConeConstraint>>
  AddL2NormCostUsingConicConstraint(const CoefficientMatrix& A, const VectorRef& b,
                                    const VariableList& vars);
  /// |Ax + b|_1; max_i |(Ax + b)_i|; (z_1^2 + z_2^2 + ...) / z_0 at z = Ax + b.
  Binding<L1NormCost> AddL1NormCost(const CoefficientMatrix& A, const VectorRef& b,
                                    const VariableList& vars);
  Binding<LInfNormCost> AddLInfNormCost(const CoefficientMatrix& A, const VectorRef& b,
                                        const VariableList& vars);
  Binding<PerspectiveQuadraticCost> AddPerspectiveQuadraticCost(const CoefficientMatrix& A,
                                                                const VectorRef& b,
                                                                const VariableList& vars);
  /// f(x); see FunctionCost for `is_convex`.
  Binding<Cost> AddFunctionCost(std::shared_ptr<const Function> function, const VariableList& vars,
                                bool is_convex = false);

  /// f(x) of a caller's own: `AddCost([](const auto& x) { return exp(x[0]) - x[1]; }, vars)`.
  template <UserFunction F>
  Binding<Cost> AddCost(F f, const VariableList& vars, const FunctionTermOptions& options = {}) {
    const int size = static_cast<int>(vars.vector().size());
    auto function = MakeFunction(size, std::move(f), options.function);
    auto cost = std::make_shared<FunctionCost>(std::move(function), options.is_convex);
    cost->set_description(options.description);
    return AddCost(Binding<Cost>(std::move(cost), vars));
  }

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
  /// Of matrices of one shape, entry by entry.
  template <class Lower, class Upper, class Variables>
  requires(Variables::ColsAtCompileTime != 1 && std::same_as<typename Variables::Scalar, Variable>)
      Binding<BoundingBoxConstraint> AddBoundingBoxConstraint(
          const Eigen::MatrixBase<Lower>& lower, const Eigen::MatrixBase<Upper>& upper,
          const Eigen::MatrixBase<Variables>& vars) {
    Require(lower.rows() == vars.rows() && upper.rows() == vars.rows() &&
                lower.cols() == vars.cols() && upper.cols() == vars.cols(),
            "bounding box constraint: bounds of a ", vars.rows(), " x ", vars.cols(),
            " matrix of variables need its shape, got ", lower.rows(), " x ", lower.cols(), " and ",
            upper.rows(), " x ", upper.cols());
    const Eigen::MatrixXd l = lower;
    const Eigen::MatrixXd u = upper;
    return AddBoundingBoxConstraint(l.reshaped(), u.reshaped(), VariableList(vars));
  }
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

  /// lower <= 1/2 x'Qx + b'x <= upper.
  Binding<QuadraticConstraint> AddQuadraticConstraint(
      const CoefficientMatrix& Q, const VectorRef& b, double lower, double upper,
      const VariableList& vars,
      std::optional<QuadraticConstraint::HessianType> hessian_type = std::nullopt);
  /// 1/2 x'Qx + b'x + c <= 0 for a positive semidefinite Q, as a cone.
  Binding<RotatedLorentzConeConstraint> AddQuadraticAsRotatedLorentzConeConstraint(
      const CoefficientMatrix& Q, const VectorRef& b, double c, const VariableList& vars);
  /// lower <= f(x) <= upper; see FunctionConstraint for `is_convex`.
  Binding<Constraint> AddFunctionConstraint(std::shared_ptr<const Function> function,
                                            const VectorRef& lower, const VectorRef& upper,
                                            const VariableList& vars, bool is_convex = false);

  /// lower <= f(x) <= upper of a caller's own.
  template <UserFunction F>
  Binding<Constraint> AddConstraint(F f, const VectorRef& lower, const VectorRef& upper,
                                    const VariableList& vars,
                                    const FunctionTermOptions& options = {}) {
    const int size = static_cast<int>(vars.vector().size());
    auto function = MakeFunction(size, std::move(f), options.function);
    auto constraint =
        std::make_shared<FunctionConstraint>(std::move(function), lower, upper, options.is_convex);
    constraint->set_description(options.description);
    return AddConstraint(Binding<Constraint>(std::move(constraint), vars));
  }

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
  /// Costs of any other type: functions, and the user's own classes.
  [[nodiscard]] const std::vector<Binding<Cost>>& generic_costs() const { return generic_costs_; }
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
  [[nodiscard]] const std::vector<Binding<QuadraticConstraint>>& quadratic_constraints() const {
    return quadratic_constraints_;
  }
  /// Constraints of any other type: functions, and the user's own classes.
  [[nodiscard]] const std::vector<Binding<Constraint>>& generic_constraints() const {
    return generic_constraints_;
  }
  [[nodiscard]] std::vector<Binding<LinearConstraint>> linear_constraints() const;
  [[nodiscard]] std::vector<Binding<LinearEqualityConstraint>> linear_equality_constraints() const;
  [[nodiscard]] std::vector<Binding<LorentzConeConstraint>> lorentz_cone_constraints() const;
  [[nodiscard]] std::vector<Binding<RotatedLorentzConeConstraint>>
  rotated_lorentz_cone_constraints() const;
  [[nodiscard]] std::vector<Binding<L2NormCost>> l2norm_costs() const;
  /// Equalities, rows and boxes.
  [[nodiscard]] std::vector<Binding<LinearConstraint>> GetAllLinearConstraints() const;
  [[nodiscard]] std::vector<Binding<Cost>> GetAllCosts() const;
  [[nodiscard]] std::vector<Binding<Constraint>> GetAllConstraints() const;
  /// May its functions be evaluated by several threads at once?
  [[nodiscard]] bool IsThreadSafe() const;

 protected:
  ProgramTerms() = default;
  ProgramTerms(const ProgramTerms&) = default;
  ~ProgramTerms() = default;

 private:
  std::vector<Binding<LinearCost>> linear_costs_;
  std::vector<Binding<QuadraticCost>> quadratic_costs_;
  std::vector<Binding<NormCost>> norm_costs_;
  std::vector<Binding<Cost>> generic_costs_;
  std::vector<Binding<BoundingBoxConstraint>> bounding_boxes_;
  std::vector<Binding<LinearConstraint>> affine_;
  std::vector<Binding<ConeConstraint>> cones_;
  std::vector<Binding<QuadraticConstraint>> quadratic_constraints_;
  std::vector<Binding<Constraint>> generic_constraints_;
};

}  // namespace switchyard
