// What a program stores of its bindings: each by the type of its evaluator.
#include <algorithm>
#include <utility>

#include "switchyard/model/program_terms.hpp"

namespace switchyard {
namespace {

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

Binding<Cost> ProgramTerms::AddCost(const Binding<Cost>& binding) {
  StructureChanged();
  CheckVariables(*binding.evaluator(), binding.variables());
  if (!StoreAs(binding, &linear_costs_) && !StoreAs(binding, &quadratic_costs_) &&
      !StoreAs(binding, &norm_costs_)) {
    generic_costs_.push_back(binding);
  }
  return binding;
}

Binding<Constraint> ProgramTerms::AddConstraint(const Binding<Constraint>& binding) {
  StructureChanged();
  CheckVariables(*binding.evaluator(), binding.variables());
  const Constraint& given = *binding.evaluator();
  Require(given.lower_bound().size() == given.num_constraints(), given.Name(), ": it needs bounds ",
          "of its ", given.num_constraints(), " rows, and its class has set none");
  if (!StoreAs(binding, &bounding_boxes_) && !StoreAs(binding, &affine_) &&
      !StoreAs(binding, &cones_) && !StoreAs(binding, &quadratic_constraints_)) {
    generic_constraints_.push_back(binding);
  }
  return binding;
}

int ProgramTerms::RemoveCost(const Binding<Cost>& cost) {
  StructureChanged();
  return EraseEqual(cost, &linear_costs_) + EraseEqual(cost, &quadratic_costs_) +
         EraseEqual(cost, &norm_costs_) + EraseEqual(cost, &generic_costs_);
}

int ProgramTerms::RemoveConstraint(const Binding<Constraint>& constraint) {
  StructureChanged();
  return EraseEqual(constraint, &bounding_boxes_) + EraseEqual(constraint, &affine_) +
         EraseEqual(constraint, &cones_) + EraseEqual(constraint, &quadratic_constraints_) +
         EraseEqual(constraint, &generic_constraints_);
}

std::vector<Binding<LinearConstraint>> ProgramTerms::linear_constraints() const {
  std::vector<Binding<LinearConstraint>> found;
  for (const auto& binding : affine_) {
    const auto* equality = dynamic_cast<const LinearEqualityConstraint*>(binding.evaluator().get());
    if (equality == nullptr) found.push_back(binding);
  }
  return found;
}

std::vector<Binding<LinearEqualityConstraint>> ProgramTerms::linear_equality_constraints() const {
  return Those<LinearEqualityConstraint>(affine_);
}

std::vector<Binding<LorentzConeConstraint>> ProgramTerms::lorentz_cone_constraints() const {
  return Those<LorentzConeConstraint>(cones_);
}

std::vector<Binding<RotatedLorentzConeConstraint>> ProgramTerms::rotated_lorentz_cone_constraints()
    const {
  return Those<RotatedLorentzConeConstraint>(cones_);
}

std::vector<Binding<L2NormCost>> ProgramTerms::l2norm_costs() const {
  return Those<L2NormCost>(norm_costs_);
}

std::vector<Binding<LinearConstraint>> ProgramTerms::GetAllLinearConstraints() const {
  std::vector<Binding<LinearConstraint>> all;
  Append(affine_, &all);
  Append(bounding_boxes_, &all);
  return all;
}

bool ProgramTerms::IsThreadSafe() const {
  const auto safe = [](const auto& bindings) {
    return std::all_of(bindings.begin(), bindings.end(),
                       [](const auto& binding) { return binding.evaluator()->is_thread_safe(); });
  };
  return safe(generic_costs_) && safe(generic_constraints_);
}

std::vector<Binding<Cost>> ProgramTerms::GetAllCosts() const {
  std::vector<Binding<Cost>> all;
  Append(linear_costs_, &all);
  Append(quadratic_costs_, &all);
  Append(norm_costs_, &all);
  Append(generic_costs_, &all);
  return all;
}

std::vector<Binding<Constraint>> ProgramTerms::GetAllConstraints() const {
  std::vector<Binding<Constraint>> all;
  Append(bounding_boxes_, &all);
  Append(affine_, &all);
  Append(cones_, &all);
  Append(quadratic_constraints_, &all);
  Append(generic_constraints_, &all);
  return all;
}

}  // namespace switchyard
