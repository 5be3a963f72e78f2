// core/gcs/perspective.hpp - a cost or constraint by its perspective.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "switchyard/model/constraint.hpp"
#include "switchyard/model/cost.hpp"
#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// t g(x / t), closed: the minimum of cost'(t, x, w) + |Sx|^2 / (2t) over the w with (t, x, w) in
/// the cone. Constraints have no cost. The squares stand apart so that an edge writes all of its
/// own in one rotated cone.
struct Perspective {
  ScaledSet cone;
  std::vector<double> cost;  // of t, x, w; empty: none
  Csc S;                     // rows x dim; no rows: no square
};

/// Is it linear, a norm, or quadratic and said to be convex?
bool HasPerspective(const Cost& cost);

/// Throws InvalidArgument, naming it, for a cost that is not convex or a constraint that has no
/// perspective. A linear cost has no rows: it goes into the objective.
Perspective PerspectiveOf(const Cost& cost);
Perspective PerspectiveOf(const Constraint& constraint);

/// Perspectives by evaluator: many edges share one.
class Perspectives {
 public:
  /// Of its coefficients as they are now. Keeps the evaluator, so that its address means it.
  template <class Evaluator>
  const Perspective& Of(const std::shared_ptr<Evaluator>& evaluator) {
    Known& known = known_[evaluator.get()];
    if (known.evaluator == nullptr || known.version != evaluator->version()) {
      known = {evaluator, evaluator->version(), PerspectiveOf(*evaluator)};
    }
    return known.perspective;
  }

 private:
  struct Known {
    std::shared_ptr<const EvaluatorBase> evaluator;
    std::uint64_t version = 0;
    Perspective perspective;
  };
  std::unordered_map<const EvaluatorBase*, Known> known_;
};

}  // namespace switchyard
