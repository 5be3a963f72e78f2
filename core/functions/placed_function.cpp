#include "core/functions/placed_function.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace switchyard {
namespace {

std::vector<int> Places(std::string_view what, const SparsityPattern& entries,
                        const PatternIndex& index) {
  std::vector<int> places;
  places.reserve(entries.size());
  for (int k = 0; k < entries.size(); ++k) {
    places.push_back(index.Need(what, entries.row[k], entries.col[k]));
  }
  return places;
}

void Scatter(const std::vector<double>& entries, const std::vector<int>& places, int size,
             double* target) {
  std::fill_n(target, size, 0.0);
  for (std::size_t k = 0; k < places.size(); ++k) target[places[k]] = entries[k];
}

}  // namespace

PlacedFunction::PlacedFunction(std::shared_ptr<const Function> f, const PatternIndex& jacobian,
                               const PatternIndex& hessian)
    : f_(std::move(f)),
      jacobian_place_(Places("Jacobian", f_->jacobian(), jacobian)),
      hessian_place_(Places("Hessian", f_->hessian(), hessian)) {}

void PlacedFunction::Evaluate(const Function& as, const Evaluation& wanted) const {
  std::vector<double> jacobian(wanted.jacobian != nullptr ? jacobian_place_.size() : 0);
  std::vector<double> hessian(wanted.hessian != nullptr ? hessian_place_.size() : 0);
  Evaluation inner = wanted;
  if (wanted.jacobian != nullptr) inner.jacobian = jacobian.data();
  if (wanted.hessian != nullptr) inner.hessian = hessian.data();
  f_->Evaluate(inner);
  if (wanted.jacobian != nullptr) {
    Scatter(jacobian, jacobian_place_, as.jacobian().size(), wanted.jacobian);
  }
  if (wanted.hessian != nullptr) {
    Scatter(hessian, hessian_place_, as.hessian().size(), wanted.hessian);
  }
}

}  // namespace switchyard
