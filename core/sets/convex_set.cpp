#include "switchyard/sets/convex_set.hpp"

#include <mutex>

#include "core/sets/box.hpp"
#include "core/sets/feasible_point.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/intersection.hpp"

namespace switchyard {

struct ConvexSet::Known {
  std::once_flag scaled_once;
  std::once_flag box_once;
  std::once_flag point_once;
  std::once_flag bounded_once;
  ScaledSet scaled;
  SetBox box;
  std::optional<Eigen::VectorXd> point;
  bool bounded = false;
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
    if (!known_->point.has_value()) known_->point = DoMaybeGetFeasiblePoint();
  });
  return known_->point;
}

bool ConvexSet::IsEmpty() const { return !MaybeGetFeasiblePoint().has_value(); }

std::optional<Eigen::VectorXd> ConvexSet::DoMaybeGetFeasiblePoint() const {
  return FeasiblePoint(*this);
}

bool ConvexSet::IsBounded(Parallelism parallelism) const {
  std::call_once(known_->bounded_once, [&] { known_->bounded = DoIsBounded(parallelism); });
  return known_->bounded;
}

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

}  // namespace switchyard
