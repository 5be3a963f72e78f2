#include <utility>

#include "core/model/checks.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard {
namespace {

SparseMatrix ScaledIdentity(Eigen::Index size, double scale) {
  SparseMatrix I(size, size);
  I.setIdentity();
  return scale * I;
}

Eigen::VectorXd One(double value) { return Eigen::VectorXd::Constant(1, value); }

Eigen::Index SizeOf(const VariableList& vars) { return vars.vector().size(); }

// Appends the binding to `stored` where its evaluator is a C.
template <class C, class Base>
bool StoreAs(const Binding<Base>& binding, std::vector<Binding<C>>* stored) {
  auto evaluator = std::dynamic_pointer_cast<C>(binding.evaluator());
  if (evaluator == nullptr) return false;
  stored->emplace_back(std::move(evaluator), binding.variables());
  return true;
}

// Those of `stored` whose evaluator is a C.
template <class C, class Base>
std::vector<Binding<C>> Those(const std::vector<Binding<Base>>& stored) {
  std::vector<Binding<C>> found;
  for (const auto& binding : stored) StoreAs(binding, &found);
  return found;
}

template <class C, class Base>
int EraseEqual(const Binding<Base>& given, std::vector<Binding<C>>* stored) {
  return static_cast<int>(std::erase_if(*stored, [&](const Binding<C>& binding) {
    return binding.evaluator() == given.evaluator() && Binding<Base>(binding) == given;
  }));
}

template <class C, class Base>
void Append(const std::vector<Binding<C>>& some, std::vector<Binding<Base>>* all) {
  all->insert(all->end(), some.begin(), some.end());
}

}  // namespace

void MathematicalProgram::CheckVariables(const EvaluatorBase& evaluator,
                                         const VectorXDecisionVariable& vars) const {
  for (Eigen::Index i = 0; i < vars.size(); ++i) {
    if (FindIndex(vars[i]) >= 0) [[likely]]
      continue;
    Refuse(evaluator.Name(), ": variable ", i, " of ", vars.size(), " is ",
           vars[i].is_dummy() ? "a dummy, it belongs to no program" : "not of this program");
  }
}

// ---- Costs ----

Binding<Cost> MathematicalProgram::AddCost(const Binding<Cost>& binding) {
  ++structure_version_;
  CheckVariables(*binding.evaluator(), binding.variables());
  if (!StoreAs(binding, &linear_costs_) && !StoreAs(binding, &quadratic_costs_) &&
      !StoreAs(binding, &norm_costs_)) {
    Refuse(binding.evaluator()->Name(),
           ": a program holds linear, quadratic and norm costs, got a ",
           binding.evaluator()->Kind());
  }
  return binding;
}

Binding<LinearCost> MathematicalProgram::AddLinearCost(const VectorRef& a, double b,
                                                       const VariableList& vars) {
  return AddCost(std::make_shared<LinearCost>(a, b), vars);
}

Binding<LinearCost> MathematicalProgram::AddLinearCost(const VectorRef& a,
                                                       const VariableList& vars) {
  return AddLinearCost(a, 0, vars);
}

Binding<QuadraticCost> MathematicalProgram::AddQuadraticCost(const CoefficientMatrix& Q,
                                                             const VectorRef& b, double c,
                                                             const VariableList& vars,
                                                             std::optional<bool> is_convex) {
  return AddCost(std::make_shared<QuadraticCost>(Q, b, c, is_convex), vars);
}

Binding<QuadraticCost> MathematicalProgram::AddQuadraticCost(const CoefficientMatrix& Q,
                                                             const VectorRef& b,
                                                             const VariableList& vars,
                                                             std::optional<bool> is_convex) {
  return AddQuadraticCost(Q, b, 0, vars, is_convex);
}

// (x - d)'Q(x - d) = 1/2 x'(Q + Q')x - ((Q + Q')d)'x + d'Qd.
Binding<QuadraticCost> MathematicalProgram::AddQuadraticErrorCost(const CoefficientMatrix& Q,
                                                                  const VectorRef& x_desired,
                                                                  const VariableList& vars) {
  constexpr const char* kName = "quadratic error cost";
  CheckSize(kName, "x_desired", x_desired, SizeOf(vars));
  CheckShape(kName, "Q", Q.sparse(), SizeOf(vars), SizeOf(vars));
  CheckFinite(kName, "x_desired", x_desired);
  const SparseMatrix transposed = Q.sparse().transpose();
  const SparseMatrix twice = Q.sparse() + transposed;
  const Eigen::VectorXd slope = twice * x_desired;
  return AddQuadraticCost(twice, -slope, 0.5 * slope.dot(x_desired), vars);
}

Binding<QuadraticCost> MathematicalProgram::AddQuadraticErrorCost(double w,
                                                                  const VectorRef& x_desired,
                                                                  const VariableList& vars) {
  return AddQuadraticErrorCost(ScaledIdentity(SizeOf(vars), w), x_desired, vars);
}

// |Ax - b|^2 = 1/2 x'(2 A'A)x - (2 A'b)'x + b'b: convex by its form.
Binding<QuadraticCost> MathematicalProgram::Add2NormSquaredCost(const CoefficientMatrix& A,
                                                                const VectorRef& b,
                                                                const VariableList& vars) {
  constexpr const char* kName = "2-norm squared cost";
  CheckShape(kName, "A", A.sparse(), b.size(), SizeOf(vars));
  CheckFinite(kName, "A", A.sparse());
  CheckFinite(kName, "b", b);
  const SparseMatrix transposed = A.sparse().transpose();
  const SparseMatrix gram = transposed * A.sparse();
  return AddQuadraticCost(2 * gram, -2 * (transposed * b), b.squaredNorm(), vars, true);
}

Binding<L2NormCost> MathematicalProgram::AddL2NormCost(const CoefficientMatrix& A,
                                                       const VectorRef& b,
                                                       const VariableList& vars) {
  return AddCost(std::make_shared<L2NormCost>(A, b), vars);
}

// ---- Constraints ----

Binding<Constraint> MathematicalProgram::AddConstraint(const Binding<Constraint>& binding) {
  ++structure_version_;
  CheckVariables(*binding.evaluator(), binding.variables());
  if (!StoreAs(binding, &bounding_boxes_) && !StoreAs(binding, &affine_) &&
      !StoreAs(binding, &cones_)) {
    Refuse(binding.evaluator()->Name(),
           ": a program holds linear, bounding box and cone constraints, got a ",
           binding.evaluator()->Kind());
  }
  return binding;
}

Binding<LinearConstraint> MathematicalProgram::AddLinearConstraint(CoefficientMatrix A,
                                                                   const VectorRef& lower,
                                                                   const VectorRef& upper,
                                                                   const VariableList& vars) {
  return AddConstraint(std::make_shared<LinearConstraint>(std::move(A), lower, upper), vars);
}

Binding<LinearConstraint> MathematicalProgram::AddLinearConstraint(
    const Eigen::Ref<const Eigen::RowVectorXd>& a, double lower, double upper,
    const VariableList& vars) {
  return AddLinearConstraint(CoefficientMatrix(a), One(lower), One(upper), vars);
}

Binding<LinearEqualityConstraint> MathematicalProgram::AddLinearEqualityConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<LinearEqualityConstraint>(std::move(A), b), vars);
}

Binding<LinearEqualityConstraint> MathematicalProgram::AddLinearEqualityConstraint(
    const Eigen::Ref<const Eigen::RowVectorXd>& a, double b, const VariableList& vars) {
  return AddLinearEqualityConstraint(CoefficientMatrix(a), One(b), vars);
}

Binding<BoundingBoxConstraint> MathematicalProgram::AddBoundingBoxConstraint(
    const VectorRef& lower, const VectorRef& upper, const VariableList& vars) {
  return AddConstraint(std::make_shared<BoundingBoxConstraint>(lower, upper), vars);
}

Binding<BoundingBoxConstraint> MathematicalProgram::AddBoundingBoxConstraint(
    double lower, double upper, const VariableList& vars) {
  return AddBoundingBoxConstraint(Eigen::VectorXd::Constant(SizeOf(vars), lower),
                                  Eigen::VectorXd::Constant(SizeOf(vars), upper), vars);
}

Binding<LorentzConeConstraint> MathematicalProgram::AddLorentzConeConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<LorentzConeConstraint>(std::move(A), b), vars);
}

Binding<LorentzConeConstraint> MathematicalProgram::AddLorentzConeConstraint(
    const VariableList& vars) {
  return AddLorentzConeConstraint(ScaledIdentity(SizeOf(vars), 1),
                                  Eigen::VectorXd::Zero(SizeOf(vars)), vars);
}

Binding<RotatedLorentzConeConstraint> MathematicalProgram::AddRotatedLorentzConeConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<RotatedLorentzConeConstraint>(std::move(A), b), vars);
}

Binding<RotatedLorentzConeConstraint> MathematicalProgram::AddRotatedLorentzConeConstraint(
    const VariableList& vars) {
  return AddRotatedLorentzConeConstraint(ScaledIdentity(SizeOf(vars), 1),
                                         Eigen::VectorXd::Zero(SizeOf(vars)), vars);
}

Binding<ExponentialConeConstraint> MathematicalProgram::AddExponentialConeConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<ExponentialConeConstraint>(std::move(A), b), vars);
}

Binding<PowerConeConstraint> MathematicalProgram::AddPowerConeConstraint(CoefficientMatrix A,
                                                                         const VectorRef& b,
                                                                         double alpha,
                                                                         const VariableList& vars) {
  return AddConstraint(std::make_shared<PowerConeConstraint>(std::move(A), b, alpha), vars);
}

Binding<PositiveSemidefiniteConstraint> MathematicalProgram::AddPositiveSemidefiniteConstraint(
    const Eigen::Ref<const MatrixXDecisionVariable>& X) {
  constexpr const char* kName = "positive semidefinite constraint";
  Require(X.rows() == X.cols(), kName, ": the matrix needs to be square, got ", X.rows(), " x ",
          X.cols());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      Require(X(i, j) == X(j, i), kName,
              ": the matrix needs to be symmetric, got two variables at (", i, ",", j, ") and (", j,
              ",", i, ")");
    }
  }
  return AddConstraint(std::make_shared<PositiveSemidefiniteConstraint>(static_cast<int>(X.rows())),
                       X);
}

Binding<LinearMatrixInequalityConstraint> MathematicalProgram::AddLinearMatrixInequalityConstraint(
    const std::vector<Eigen::MatrixXd>& F, const VariableList& vars) {
  return AddConstraint(std::make_shared<LinearMatrixInequalityConstraint>(F), vars);
}

// ---- Removing, listing ----

int MathematicalProgram::RemoveCost(const Binding<Cost>& cost) {
  ++structure_version_;
  return EraseEqual(cost, &linear_costs_) + EraseEqual(cost, &quadratic_costs_) +
         EraseEqual(cost, &norm_costs_);
}

int MathematicalProgram::RemoveConstraint(const Binding<Constraint>& constraint) {
  ++structure_version_;
  return EraseEqual(constraint, &bounding_boxes_) + EraseEqual(constraint, &affine_) +
         EraseEqual(constraint, &cones_);
}

std::vector<Binding<LinearConstraint>> MathematicalProgram::linear_constraints() const {
  std::vector<Binding<LinearConstraint>> found;
  for (const auto& binding : affine_) {
    const auto* equality = dynamic_cast<const LinearEqualityConstraint*>(binding.evaluator().get());
    if (equality == nullptr) found.push_back(binding);
  }
  return found;
}

std::vector<Binding<LinearEqualityConstraint>> MathematicalProgram::linear_equality_constraints()
    const {
  return Those<LinearEqualityConstraint>(affine_);
}

std::vector<Binding<LorentzConeConstraint>> MathematicalProgram::lorentz_cone_constraints() const {
  return Those<LorentzConeConstraint>(cones_);
}

std::vector<Binding<RotatedLorentzConeConstraint>>
MathematicalProgram::rotated_lorentz_cone_constraints() const {
  return Those<RotatedLorentzConeConstraint>(cones_);
}

std::vector<Binding<Cost>> MathematicalProgram::GetAllCosts() const {
  std::vector<Binding<Cost>> all;
  Append(linear_costs_, &all);
  Append(quadratic_costs_, &all);
  Append(norm_costs_, &all);
  return all;
}

std::vector<Binding<Constraint>> MathematicalProgram::GetAllConstraints() const {
  std::vector<Binding<Constraint>> all;
  Append(bounding_boxes_, &all);
  Append(affine_, &all);
  Append(cones_, &all);
  return all;
}

}  // namespace switchyard
