// switchyard/sets/spectrahedron.hpp - the feasible points of a program.
#pragma once

#include <memory>
#include <vector>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// {x in R^n : every constraint of a program holds}, x its variables in their order. Linear
/// constraints (a row with one infinite side has one), cones of every kind, matrix inequalities,
/// and convex quadratic forms.
class SWITCHYARD_EXPORT Spectrahedron final : public ConvexSet {
 public:
  Spectrahedron() : ConvexSet(0) {}
  /// Costs are no part of the set. Throws InvalidArgument, naming it, where a constraint has no
  /// perspective or a variable is not continuous.
  explicit Spectrahedron(const MathematicalProgram& prog);
  [[nodiscard]] std::string Kind() const override { return "spectrahedron"; }

 private:
  struct Term {
    std::shared_ptr<const Constraint> constraint;
    std::vector<int> variables;  // which x it takes
  };
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  std::vector<Term> terms_;
};

}  // namespace switchyard
