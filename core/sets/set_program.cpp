#include "core/sets/set_program.hpp"

#include <stdexcept>

#include "core/sets/recession_cone.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

/// {r : (0, r, w) in the scaled form}: as a set, since t has no entry there.
class Directions final : public ConvexSet {
 public:
  explicit Directions(const ConvexSet& set)
      : ConvexSet(set.ambient_dimension()), cone_(RecessionCone(set.scaled())) {}
  [[nodiscard]] std::string Kind() const override { return "directions of recession"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override {
    return std::make_unique<Directions>(*this);
  }
  [[nodiscard]] ScaledSet DoScaled() const override { return cone_; }
  ScaledSet cone_;
};

}  // namespace

SetProgram::SetProgram(const ConvexSet& set)
    : x(program.NewContinuousVariables(set.ambient_dimension())) {
  set.AddPointInSetConstraints(&program, x);
}

RecessionProgram::RecessionProgram(const ConvexSet& set, const VectorRef& direction)
    : kind(set.Kind()) {
  const VectorXDecisionVariable r = program.NewContinuousVariables(set.ambient_dimension(), "r");
  Directions(set).AddPointInSetConstraints(&program, r);
  program.AddBoundingBoxConstraint(-1, 1, r);
  program.AddLinearCost(direction, r);
  program.set_objective_sense(ObjectiveSense::kMaximize);
}

double RecessionProgram::Value(const MathematicalProgramResult& result) const {
  if (!result.is_success()) CouldNotTell(kind, "whether it is bounded", result);
  return result.objective;
}

void CouldNotTell(const std::string& kind, const std::string& what,
                  const MathematicalProgramResult& result) {
  throw std::runtime_error(Text("of a set (", kind, ") ", what, " could not be told: ",
                                to_string(result.termination), ", ", result.message));
}

}  // namespace switchyard
