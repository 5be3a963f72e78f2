// core/functions/placed_function.hpp - a function whose derivatives stand in larger patterns.
#pragma once

#include <memory>
#include <vector>

#include "core/functions/pattern_index.hpp"
#include "switchyard/functions/function.hpp"
#include "switchyard/functions/tape.hpp"

namespace switchyard {

/// A compiled tape seen with the patterns that a caller declared.
class PlacedFunction {
 public:
  /// Throws InvalidArgument for an entry of `f` that has no place.
  PlacedFunction(std::shared_ptr<const Function> f, const PatternIndex& jacobian,
                 const PatternIndex& hessian);

  /// As `as` asks it, whose patterns are the larger ones.
  void Evaluate(const Function& as, const Evaluation& wanted) const;

 private:
  std::shared_ptr<const Function> f_;
  std::vector<int> jacobian_place_;  // of each entry
  std::vector<int> hessian_place_;
};

}  // namespace switchyard
