// switchyard/model/program.hpp - an optimization program: variables, and costs and constraints
// bound to them. It knows no solver.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/model/program_terms.hpp"
#include "switchyard/model/solver_options.hpp"

namespace switchyard {

enum class ObjectiveSense { kMinimize, kMaximize };

/// minimize (or maximize) the sum of the costs over the variables, subject to every constraint.
///
/// Variables are added in blocks; evaluators are shared, never copied, by bindings. Adding throws
/// InvalidArgument for a variable of another program, a size that does not fit, a number that is
/// NaN, and leaves the program as it was. Not thread-safe while it changes; const use is.
class SWITCHYARD_EXPORT MathematicalProgram final : public ProgramTerms {
 public:
  MathematicalProgram() = default;
  MathematicalProgram& operator=(const MathematicalProgram&) = delete;

  /// Another program with the same variables (ids included); evaluators are shared.
  [[nodiscard]] std::unique_ptr<MathematicalProgram> Clone() const;

  void set_name(std::string name) { name_ = std::move(name); }
  [[nodiscard]] const std::string& name() const { return name_; }
  void set_objective_sense(ObjectiveSense sense) {
    sense_ = sense;
    StructureChanged();
  }
  [[nodiscard]] ObjectiveSense objective_sense() const { return sense_; }

  /// The variables, costs and constraints, a line each, for people; program/1 is for programs.
  [[nodiscard]] std::string to_string() const;

  // ---- Options: for all solves; those of a call go before them ----

  void SetSolverOption(const SolverId& solver, const std::string& key,
                       SolverOptions::OptionValue value) {
    solver_options_.SetOption(solver, key, std::move(value));
  }
  void SetSolverOptions(SolverOptions options) { solver_options_ = std::move(options); }
  [[nodiscard]] const SolverOptions& solver_options() const { return solver_options_; }

  // ---- Terms from expressions: parse.hpp says what each becomes and what is refused ----

  using ProgramTerms::AddConstraint;
  using ProgramTerms::AddCost;
  using ProgramTerms::AddL2NormCost;
  using ProgramTerms::AddLinearConstraint;
  using ProgramTerms::AddLinearCost;
  using ProgramTerms::AddLinearEqualityConstraint;
  using ProgramTerms::AddLorentzConeConstraint;
  using ProgramTerms::AddQuadraticConstraint;
  using ProgramTerms::AddQuadraticCost;
  using ProgramTerms::AddRotatedLorentzConeConstraint;

  Binding<LinearCost> AddLinearCost(const Expression& e);
  Binding<QuadraticCost> AddQuadraticCost(const Expression& e,
                                          std::optional<bool> is_convex = std::nullopt);
  Binding<L2NormCost> AddL2NormCost(const Expression& e, double psd_tol = 1e-8,
                                    double coefficient_tol = 1e-8);
  Binding<Cost> AddCost(const Expression& e);

  Binding<LinearConstraint> AddLinearConstraint(const Expression& e, double lower, double upper);
  Binding<LinearConstraint> AddLinearConstraint(const ExpressionList& e, const MatrixRef& lower,
                                                const MatrixRef& upper);
  Binding<LinearConstraint> AddLinearConstraint(const FormulaList& formulas);
  Binding<LinearEqualityConstraint> AddLinearEqualityConstraint(const Expression& e, double b);
  Binding<LinearEqualityConstraint> AddLinearEqualityConstraint(const ExpressionList& e,
                                                                const MatrixRef& b,
                                                                bool lower_triangle = false);
  Binding<LinearEqualityConstraint> AddLinearEqualityConstraint(const FormulaList& formulas);
  Binding<QuadraticConstraint> AddQuadraticConstraint(
      const Expression& e, double lower, double upper,
      std::optional<QuadraticConstraint::HessianType> hessian_type = std::nullopt);
  Binding<Constraint> AddConstraint(const Expression& e, double lower, double upper);
  Binding<Constraint> AddConstraint(const ExpressionList& e, const MatrixRef& lower,
                                    const MatrixRef& upper);
  Binding<Constraint> AddConstraint(const FormulaList& formulas);

  Binding<LorentzConeConstraint> AddLorentzConeConstraint(const Formula& formula,
                                                          double psd_tol = 1e-8,
                                                          double coefficient_tol = 1e-8);
  Binding<LorentzConeConstraint> AddLorentzConeConstraint(const Expression& linear,
                                                          const Expression& quadratic,
                                                          double tolerance = 0);
  Binding<RotatedLorentzConeConstraint> AddRotatedLorentzConeConstraint(const Expression& linear1,
                                                                        const Expression& linear2,
                                                                        const Expression& quadratic,
                                                                        double tolerance = 0);
  /// Of vectors of expressions; variables themselves go without these.
  template <class Derived>
  requires std::same_as<typename Derived::Scalar, Expression> Binding<LorentzConeConstraint>
  AddLorentzConeConstraint(const Eigen::MatrixBase<Derived>& z) {
    return AddConstraint(ParseLorentzConeConstraint(z));
  }
  template <class Derived>
  requires std::same_as<typename Derived::Scalar, Expression> Binding<RotatedLorentzConeConstraint>
  AddRotatedLorentzConeConstraint(const Eigen::MatrixBase<Derived>& z) {
    return AddConstraint(ParseRotatedLorentzConeConstraint(z));
  }
  Binding<LinearConstraint> AddPositiveDiagonallyDominantDualConeMatrixConstraint(
      const ExpressionList& X);

  // ---- Evaluation at a point x of num_vars() entries ----

  template <class C>
  [[nodiscard]] Eigen::VectorXd EvalBinding(const Binding<C>& binding, VectorRef x) const {
    Eigen::VectorXd y;
    binding.evaluator()->Eval(ValuesOf(binding.variables(), x), &y);
    return y;
  }
  /// The values of all, one behind the other.
  template <class C>
  [[nodiscard]] Eigen::VectorXd EvalBindings(const std::vector<Binding<C>>& bindings,
                                             VectorRef x) const {
    std::vector<double> all;
    for (const auto& binding : bindings) {
      const Eigen::VectorXd y = EvalBinding(binding, x);
      all.insert(all.end(), y.begin(), y.end());
    }
    return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }
  template <class C>
  [[nodiscard]] Eigen::VectorXd EvalBindingAtInitialGuess(const Binding<C>& binding) const {
    return EvalBinding(binding, initial_guess());
  }
  /// The sum of the costs.
  [[nodiscard]] double EvalCosts(const VectorRef& x) const;
  [[nodiscard]] bool CheckSatisfied(const Binding<Constraint>& binding, const VectorRef& x,
                                    double tolerance = 1e-6) const;
  [[nodiscard]] bool CheckSatisfied(const std::vector<Binding<Constraint>>& bindings,
                                    const VectorRef& x, double tolerance = 1e-6) const;
  [[nodiscard]] bool CheckSatisfiedAtInitialGuess(const Binding<Constraint>& binding,
                                                  double tolerance = 1e-6) const {
    return CheckSatisfied(binding, initial_guess(), tolerance);
  }
  [[nodiscard]] bool CheckSatisfiedAtInitialGuess(const std::vector<Binding<Constraint>>& bindings,
                                                  double tolerance = 1e-6) const {
    return CheckSatisfied(bindings, initial_guess(), tolerance);
  }

 private:
  MathematicalProgram(const MathematicalProgram&) = default;  // Clone's

  std::string name_;
  ObjectiveSense sense_ = ObjectiveSense::kMinimize;
  SolverOptions solver_options_;
};

}  // namespace switchyard
