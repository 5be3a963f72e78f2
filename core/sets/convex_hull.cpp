#include "switchyard/sets/convex_hull.hpp"

#include <algorithm>

#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

ConvexSets WithPoints(const ConvexSets& sets) {
  ConvexSets kept;
  std::copy_if(sets.begin(), sets.end(), std::back_inserter(kept),
               [](const ConvexSetPointer& set) { return !set->IsEmpty(); });
  return kept;
}

}  // namespace

ConvexHull::ConvexHull(ConvexSets sets, bool remove_empty_sets)
    : ConvexSet(sets.empty() ? 0 : sets.front()->ambient_dimension()),
      sets_(std::move(sets)),
      empty_sets_removed_(remove_empty_sets) {
  for (const ConvexSetPointer& set : sets_) {
    Require(set->ambient_dimension() == ambient_dimension(), "convex hull: sets in R^",
            ambient_dimension(), " and in R^", set->ambient_dimension(), " have no hull");
  }
  participating_ = remove_empty_sets ? WithPoints(sets_) : sets_;
}

ConvexSets ConvexHull::Members() const {
  return empty_sets_removed_ ? participating_ : WithPoints(participating_);
}

std::unique_ptr<ConvexSet> ConvexHull::DoClone() const {
  return std::make_unique<ConvexHull>(*this);
}

// (a_j, x_j) in the cone of S_j, a_j >= 0, for all but the last member; for that the rest,
// (t - sum a_j, x - sum x_j).
ScaledSet ConvexHull::DoScaled() const {
  const int n = ambient_dimension();
  const ConvexSets members = Members();
  ScaledRows rows(n);
  if (members.empty()) {
    for (int j = 0; j <= n; ++j) rows.Set(rows.AddRow(0, 0), j, 1);
    return rows.Finish();
  }
  std::vector<ScaledRows::Combination> rest;
  for (int j = 0; j <= n; ++j) rest.push_back({{j, 1.0}});
  for (auto set = members.begin(); set != members.end() - 1; ++set) {
    const int first = rows.AddAux(1 + n);
    std::vector<ScaledRows::Combination> columns;
    for (int j = 0; j <= n; ++j) {
      columns.push_back({{first + j, 1.0}});
      rest[static_cast<std::size_t>(j)].emplace_back(first + j, -1.0);
    }
    rows.Set(rows.AddRow(0, kInfinity), first, 1);
    rows.AddSet((*set)->scaled(), columns);
  }
  const int last = rows.AddRow(0, kInfinity);
  for (const auto& [column, value] : rest[0]) rows.Set(last, column, value);
  rows.AddSet(members.back()->scaled(), rest);
  return rows.Finish();
}

std::optional<SetBox> ConvexHull::DoBoundingBox() const {
  const int n = ambient_dimension();
  SetBox hull{Eigen::VectorXd::Constant(n, kInfinity), Eigen::VectorXd::Constant(n, -kInfinity),
              true};
  for (const ConvexSetPointer& set : Members()) {
    const SetBox& box = set->bounding_box();
    hull.lower = hull.lower.cwiseMin(box.lower);
    hull.upper = hull.upper.cwiseMax(box.upper);
    hull.empty = false;
  }
  return hull;
}

std::optional<Eigen::VectorXd> ConvexHull::DoMaybeGetPoint() const {
  std::optional<Eigen::VectorXd> x;
  for (const ConvexSetPointer& set : Members()) {
    const std::optional<Eigen::VectorXd> point = set->MaybeGetPoint();
    if (!point || (x && *x != *point)) return std::nullopt;
    x = point;
  }
  return x;
}

std::optional<Eigen::VectorXd> ConvexHull::DoMaybeGetFeasiblePoint() const {
  const ConvexSets members = Members();
  if (members.empty()) return std::nullopt;
  return members.front()->MaybeGetFeasiblePoint();
}

bool ConvexHull::DoIsBounded(Parallelism parallelism) const {
  const ConvexSets members = Members();
  return std::all_of(members.begin(), members.end(),
                     [&](const ConvexSetPointer& set) { return set->IsBounded(parallelism); });
}

double ConvexHull::DoSupport(const Eigen::VectorXd& direction) const {
  double most = -kInfinity;
  for (const ConvexSetPointer& set : Members()) {
    most = std::max(most, set->SupportFunction(direction));
  }
  return most;
}

}  // namespace switchyard
