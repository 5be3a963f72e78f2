#include "switchyard/sets/minkowski_sum.hpp"

#include <algorithm>
#include <cfloat>

#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {

MinkowskiSum::MinkowskiSum(ConvexSets sets)
    : ConvexSet(sets.empty() ? 0 : sets.front()->ambient_dimension()), sets_(std::move(sets)) {
  for (const ConvexSetPointer& set : sets_) {
    Require(set->ambient_dimension() == ambient_dimension(), "minkowski sum: sets in R^",
            ambient_dimension(), " and in R^", set->ambient_dimension(), " have no sum");
  }
}

std::unique_ptr<ConvexSet> MinkowskiSum::DoClone() const {
  return std::make_unique<MinkowskiSum>(*this);
}

// x_j in t S_j for all but the last, x - sum of these in t times the last.
ScaledSet MinkowskiSum::DoScaled() const {
  const int n = ambient_dimension();
  ScaledRows rows(n);
  if (sets_.empty()) return rows.Finish();
  std::vector<ScaledRows::Combination> rest = {{{0, 1.0}}};
  for (int i = 0; i < n; ++i) rest.push_back({{1 + i, 1.0}});
  for (auto set = sets_.begin(); set != sets_.end() - 1; ++set) {
    const int first = rows.AddAux(n);
    std::vector<ScaledRows::Combination> columns = {{{0, 1.0}}};
    for (int i = 0; i < n; ++i) {
      columns.push_back({{first + i, 1.0}});
      rest[static_cast<std::size_t>(1 + i)].emplace_back(first + i, -1.0);
    }
    rows.AddSet((*set)->scaled(), columns);
  }
  rows.AddSet(sets_.back()->scaled(), rest);
  return rows.Finish();
}

std::optional<SetBox> MinkowskiSum::DoBoundingBox() const {
  const int n = ambient_dimension();
  SetBox sum{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), false};
  Eigen::VectorXd size = Eigen::VectorXd::Zero(n);
  for (const ConvexSetPointer& set : sets_) {
    const SetBox& box = set->bounding_box();
    if (box.empty) return box;
    sum.lower += box.lower;
    sum.upper += box.upper;
    size += box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs());
  }
  // Outward by what the sums may have lost; an infinite end loses nothing.
  const double part = static_cast<double>(sets_.size()) * DBL_EPSILON;
  const Eigen::ArrayXd margin = size.array().isFinite().select(part * size.array(), 0.0);
  sum.lower.array() -= margin;
  sum.upper.array() += margin;
  return sum;
}

std::optional<Eigen::VectorXd> MinkowskiSum::DoMaybeGetPoint() const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(ambient_dimension());
  for (const ConvexSetPointer& set : sets_) {
    const std::optional<Eigen::VectorXd> term = set->MaybeGetPoint();
    if (!term) return std::nullopt;
    x += *term;
  }
  return x;
}

std::optional<Eigen::VectorXd> MinkowskiSum::DoMaybeGetFeasiblePoint() const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(ambient_dimension());
  for (const ConvexSetPointer& set : sets_) {
    const std::optional<Eigen::VectorXd> term = set->MaybeGetFeasiblePoint();
    if (!term) return std::nullopt;
    x += *term;
  }
  return x;
}

// With a point in each term, the sum holds a translate of each.
bool MinkowskiSum::DoIsBounded(Parallelism parallelism) const {
  const bool bounded = std::all_of(sets_.begin(), sets_.end(), [&](const ConvexSetPointer& set) {
    return set->IsBounded(parallelism);
  });
  return bounded || IsEmpty();
}

double MinkowskiSum::DoSupport(const Eigen::VectorXd& direction) const {
  if (IsEmpty()) return -kInfinity;
  double sum = 0;
  for (const ConvexSetPointer& set : sets_) sum += set->SupportFunction(direction);
  return sum;
}

}  // namespace switchyard
