#include "switchyard/sets/constraint_set.hpp"

#include "core/sets/scaled_constraint.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {

ConstraintSet::ConstraintSet(int dimension, Constraints constraints)
    : ConvexSet(dimension), constraints_(std::move(constraints)) {
  Require(dimension >= 0, "a set of constraints needs a dimension, got ", dimension);
  for (const auto& constraint : constraints_) {
    Require(constraint != nullptr, "a set of constraints needs constraints, got a null pointer");
    Require(constraint->num_vars() == dimension, "a set in R^", dimension, " needs constraints on ",
            dimension, " variables, got ", constraint->Name(), " on ", constraint->num_vars());
    RequirePerspective(*constraint);
  }
}

std::unique_ptr<ConvexSet> ConstraintSet::DoClone() const {
  return std::make_unique<ConstraintSet>(*this);
}

ScaledSet ConstraintSet::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  for (const auto& constraint : constraints_) WriteScaled(*constraint, rows);
  return rows.Finish();
}

}  // namespace switchyard
