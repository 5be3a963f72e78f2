// core/functions/tape_function.hpp - the function that a tape computes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/functions/graph.hpp"
#include "core/functions/hessian_plan.hpp"
#include "core/functions/jacobian_plan.hpp"
#include "switchyard/functions/tape.hpp"

namespace switchyard {

struct PlanOptions {
  JacobianMode jacobian = JacobianMode::kByPredictedWork;
  std::int64_t most_hessian_terms = HessianPlan::kMostTerms;
};

/// Operations that one evaluation carries out.
struct PlannedWork {
  std::int64_t values = 0;
  std::int64_t derivatives = 0;  // local ones, first and second
  std::int64_t jacobian = 0;     // products
  std::int64_t hessian = 0;      // products
  bool jacobian_is_forward = false;
};

/// A function that a tape computes everywhere, as it is or seen with larger patterns.
class OfTape {
 public:
  [[nodiscard]] virtual const Tape& tape() const = 0;

 protected:
  ~OfTape() = default;
};

/// Everything happens in one workspace of numbers, its slots: inputs, values, local derivatives,
/// weights, the sums of both plans, constants.
class TapeFunction final : public Function, public OfTape {
 public:
  explicit TapeFunction(const Tape& tape, const PlanOptions& options = {});

  void Evaluate(const Evaluation& wanted) const override;
  [[nodiscard]] PlannedWork Work() const;
  [[nodiscard]] const Tape& tape() const override { return tape_; }

 private:
  [[nodiscard]] double* Workspace() const;

  Tape tape_;
  Graph graph_;
  Slot weights_;
  JacobianPlan jacobian_;
  HessianPlan hessian_;
  Slot constants_;
  int tangents_;
  int size_;
  std::uint64_t serial_;
};

}  // namespace switchyard
