// l <= x_j <= u becomes a row with one entry 1, behind the rows there are: for every variable with
// a finite side, in order. Its row's dual is the bound's dual, beside what a solver that stopped
// early left of stationarity in x_dual.
#include <cmath>

#include "core/bridges/bridges.hpp"

namespace switchyard {
namespace {

class BoundsToRowsBridge final : public Bridge {
 public:
  BoundsToRowsBridge(std::size_t vars, std::vector<std::int32_t> bounded, std::size_t rows)
      : vars_(vars), bounded_(std::move(bounded)), rows_(rows) {}

  void Back(Vectors& v) const override {
    if (v.row_dual.empty()) return;
    v.x_dual.resize(vars_, 0.0);
    for (std::size_t k = 0; k < bounded_.size(); ++k) {
      v.x_dual[static_cast<std::size_t>(bounded_[k])] += v.row_dual[rows_ + k];
    }
    v.row_dual.resize(rows_);
  }

  void Forward(Vectors& v) const override {
    if (v.row_dual.empty() && v.x_dual.empty()) return;
    v.row_dual.resize(rows_ + bounded_.size(), std::nan(""));
    for (std::size_t k = 0; k < bounded_.size() && !v.x_dual.empty(); ++k) {
      v.row_dual[rows_ + k] = v.x_dual[static_cast<std::size_t>(bounded_[k])];
    }
    v.x_dual.clear();
  }

 private:
  std::size_t vars_;
  std::vector<std::int32_t> bounded_;
  std::size_t rows_;
};

Bridged Apply(ProblemData d) {
  const auto rows = static_cast<std::size_t>(d.num_rows());
  std::vector<std::int32_t> bounded;
  Csc singles(0, d.num_vars);
  for (std::size_t j = 0; j < d.x_lower.size(); ++j) {
    if (d.x_lower[j] > -kInfinity || d.x_upper[j] < kInfinity) {
      singles.row.push_back(static_cast<std::int32_t>(bounded.size()));
      singles.value.push_back(1);
      bounded.push_back(static_cast<std::int32_t>(j));
      d.row_lower.push_back(d.x_lower[j]);
      d.row_upper.push_back(d.x_upper[j]);
    }
    singles.start[j + 1] = static_cast<std::int32_t>(bounded.size());
  }
  singles.rows = static_cast<std::int32_t>(bounded.size());
  d.A = StackRows(d.A, singles);
  d.x_lower.clear();
  d.x_upper.clear();
  const auto vars = static_cast<std::size_t>(d.num_vars);
  return {std::move(d), std::make_unique<BoundsToRowsBridge>(vars, std::move(bounded), rows)};
}

}  // namespace

BridgeKind BoundsToRows() {
  return {"variable bounds to rows", SY_ACCEPTS_BOUNDS, SY_ACCEPTS_ROWS, Apply};
}

}  // namespace switchyard
