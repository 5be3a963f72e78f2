#include "switchyard/sets/convex_set.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "core/sets/box.hpp"
#include "core/sets/feasible_point.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/intersection.hpp"

namespace switchyard {

struct ConvexSet::Known {
  std::once_flag scaled_once;
  std::once_flag box_once;
  std::once_flag point_once;
  ScaledSet scaled;
  SetBox box;
  std::optional<Eigen::VectorXd> point;
};

ConvexSet::ConvexSet(int dimension) : dimension_(dimension), known_(std::make_shared<Known>()) {}
ConvexSet::~ConvexSet() = default;

void ConvexSet::Changed(int dimension) {
  dimension_ = dimension;
  known_ = std::make_shared<Known>();
}

const ScaledSet& ConvexSet::scaled() const {
  std::call_once(known_->scaled_once, [&] { known_->scaled = DoScaled(); });
  return known_->scaled;
}

const SetBox& ConvexSet::bounding_box() const {
  std::call_once(known_->box_once, [&] {
    std::optional<SetBox> box = DoBoundingBox();
    known_->box = box.has_value() ? std::move(*box) : BoxOf(scaled());
  });
  return known_->box;
}

std::optional<Eigen::VectorXd> ConvexSet::MaybeGetFeasiblePoint() const {
  std::call_once(known_->point_once, [&] {
    known_->point = DoMaybeGetPoint();
    if (!known_->point.has_value()) known_->point = FeasiblePoint(*this);
  });
  return known_->point;
}

bool ConvexSet::IsEmpty() const { return !MaybeGetFeasiblePoint().has_value(); }

bool ConvexSet::IsBounded() const { return bounding_box().empty || bounding_box().is_finite(); }

bool ConvexSet::IntersectsWith(const ConvexSet& other) const {
  const SetBox& a = bounding_box();
  const SetBox& b = other.bounding_box();
  Require(ambient_dimension() == other.ambient_dimension(), "IntersectsWith needs a set in R^",
          ambient_dimension(), ", got one in R^", other.ambient_dimension());
  if (a.empty || b.empty) return false;
  if ((a.lower.array() > b.upper.array()).any() || (b.lower.array() > a.upper.array()).any()) {
    return false;
  }
  return !Intersection(*this, other).IsEmpty();
}

double ConvexSet::Violation(const VectorRef& x) const {
  Require(x.size() == dimension_, "a point of a ", Kind(), " needs ", dimension_, " entries, got ",
          x.size());
  const ScaledSet& set = scaled();
  if (set.num_aux > 0) throw std::logic_error(Kind() + " measures its own violation");
  std::vector<double> at(static_cast<std::size_t>(set.num_columns()), 1.0);
  std::copy(x.data(), x.data() + x.size(), at.begin() + 1);
  std::vector<double> rows(static_cast<std::size_t>(set.A.rows), 0.0);
  std::vector<double> s(static_cast<std::size_t>(set.F.rows), 0.0);
  MultiplyAdd(set.A.View(), 1, at.data(), rows.data());
  MultiplyAdd(set.F.View(), 1, at.data(), s.data());
  double worst = 0;
  const auto see = [&worst](double violation) {
    if (!(violation <= worst)) worst = violation;  // NaN stays
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    see(std::max(set.lower[i] - rows[i], rows[i] - set.upper[i]));
  }
  const double* next = s.data();
  for (const sy_cone& cone : set.cones) {
    see(FactsOf(cone.kind).violation(next, cone.dim, cone.parameter));
    next += cone.dim;
  }
  return worst;
}

bool ConvexSet::PointInSet(const VectorRef& x, double tolerance) const {
  return Violation(x) <= tolerance;
}

}  // namespace switchyard
