// Zero and nonnegative cones become rows behind those there are: Fx + g = 0, or Fx + g >= 0. A
// cone row's dual is its row's.
#include <cmath>

#include "core/bridges/bridges.hpp"

namespace switchyard {
namespace {

bool IsLinear(const sy_cone& cone) {
  return cone.kind == SY_CONE_ZERO || cone.kind == SY_CONE_NONNEGATIVE;
}

class LinearConesToRowsBridge final : public Bridge {
 public:
  LinearConesToRowsBridge(std::vector<std::uint8_t> linear, std::size_t rows)
      : linear_(std::move(linear)), rows_(rows) {}

  void Back(Vectors& v) const override {
    if (v.row_dual.empty()) return;
    std::vector<double> cone_dual(linear_.size());
    std::size_t from_row = rows_;
    std::size_t from_cone = 0;
    for (std::size_t i = 0; i < linear_.size(); ++i) {
      cone_dual[i] = linear_[i] != 0       ? v.row_dual[from_row++]
                     : v.cone_dual.empty() ? 0.0
                                           : v.cone_dual[from_cone++];
    }
    v.cone_dual = std::move(cone_dual);
    v.row_dual.resize(rows_);
  }

  void Forward(Vectors& v) const override {
    if (v.row_dual.empty() && v.cone_dual.empty()) return;
    v.row_dual.resize(rows_, std::nan(""));
    v.cone_dual.resize(linear_.size(), std::nan(""));
    const std::vector<double> moved = Keep(v.cone_dual, linear_);
    v.row_dual.insert(v.row_dual.end(), moved.begin(), moved.end());
    std::vector<std::uint8_t> stays(linear_.size());
    for (std::size_t i = 0; i < stays.size(); ++i) stays[i] = linear_[i] == 0 ? 1 : 0;
    v.cone_dual = Keep(v.cone_dual, stays);
  }

 private:
  std::vector<std::uint8_t> linear_;  // of each cone row
  std::size_t rows_;
};

Bridged Apply(ProblemData d) {
  const auto rows = static_cast<std::size_t>(d.num_rows());
  std::vector<std::uint8_t> linear;
  std::vector<sy_cone> cones;
  for (const sy_cone& cone : d.cones) {
    linear.insert(linear.end(), static_cast<std::size_t>(cone.dim), IsLinear(cone) ? 1 : 0);
    if (!IsLinear(cone)) cones.push_back(cone);
  }
  std::vector<std::uint8_t> stays(linear.size());
  std::size_t i = 0;
  for (const sy_cone& cone : d.cones) {
    for (std::int32_t k = 0; k < cone.dim; ++k, ++i) {
      stays[i] = linear[i] == 0 ? 1 : 0;
      if (linear[i] == 0) continue;
      d.row_lower.push_back(-d.g[i]);
      d.row_upper.push_back(cone.kind == SY_CONE_ZERO ? -d.g[i] : kInfinity);
    }
  }
  d.A = StackRows(d.A, KeepRows(d.F, linear));
  d.F = KeepRows(d.F, stays);
  d.g = Keep(d.g, stays);
  d.cones = std::move(cones);
  return {std::move(d), std::make_unique<LinearConesToRowsBridge>(std::move(linear), rows)};
}

}  // namespace

BridgeKind LinearConesToRows() {
  return {"zero and nonnegative cones to rows",
          ConeFeature(SY_CONE_ZERO) | ConeFeature(SY_CONE_NONNEGATIVE), SY_ACCEPTS_ROWS, Apply};
}

}  // namespace switchyard
