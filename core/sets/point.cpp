#include "switchyard/sets/point.hpp"

#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {

Point::Point(const VectorRef& x) : ConvexSet(static_cast<int>(x.size())) { set_x(x); }

void Point::set_x(const VectorRef& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Require(std::isfinite(x[i]), "point: x[", i, "] must be a finite number, got ", x[i]);
  }
  x_ = x;
  Changed(static_cast<int>(x.size()));
}

std::unique_ptr<ConvexSet> Point::DoClone() const { return std::make_unique<Point>(*this); }

ScaledSet Point::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  for (int i = 0; i < ambient_dimension(); ++i) {
    rows.AddTwoSided(x_[i], x_[i], [&](int row) { rows.Set(row, 1 + i, 1); });
  }
  return rows.Finish();
}

std::optional<SetBox> Point::DoBoundingBox() const { return SetBox{x_, x_, false}; }

}  // namespace switchyard
