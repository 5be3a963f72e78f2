// r_l <= Ax <= r_u becomes cone rows before those there are: equalities Ax - r_l in one zero cone,
// then Ax - r_l and r_u - Ax in one nonnegative cone, where the side is finite. A row's dual is
// that of its lower side less that of its upper side.
#include <cmath>

#include "core/bridges/bridges.hpp"

namespace switchyard {
namespace {

constexpr std::int32_t kNone = -1;

/// Where the sides of a row stand among the cone rows.
struct Sides {
  std::int32_t equal = kNone;
  std::int32_t lower = kNone;
  std::int32_t upper = kNone;
};

class RowsToConesBridge final : public Bridge {
 public:
  RowsToConesBridge(std::vector<Sides> sides, std::size_t added, std::size_t cone_rows)
      : sides_(std::move(sides)), added_(added), cone_rows_(cone_rows) {}

  void Back(Vectors& v) const override {
    if (v.cone_dual.empty()) return;
    v.row_dual.assign(sides_.size(), 0.0);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const Sides& s = sides_[i];
      const auto dual = [&](std::int32_t row) {
        return row == kNone ? 0.0 : v.cone_dual[static_cast<std::size_t>(row)];
      };
      v.row_dual[i] = dual(s.equal) + dual(s.lower) - dual(s.upper);
    }
    v.cone_dual.erase(v.cone_dual.begin(),
                      v.cone_dual.begin() + static_cast<std::ptrdiff_t>(added_));
  }

  void Forward(Vectors& v) const override {
    if (v.row_dual.empty() && v.cone_dual.empty()) return;
    v.cone_dual.resize(cone_rows_, std::nan(""));
    v.cone_dual.insert(v.cone_dual.begin(), added_, std::nan(""));
    for (std::size_t i = 0; i < sides_.size() && !v.row_dual.empty(); ++i) {
      const double y = v.row_dual[i];
      const auto put = [&](std::int32_t row, double dual) {
        if (row != kNone) v.cone_dual[static_cast<std::size_t>(row)] = dual;
      };
      put(sides_[i].equal, y);
      put(sides_[i].lower, y > 0 ? y : 0 * y);
      put(sides_[i].upper, y < 0 ? -y : 0 * y);
    }
    v.row_dual.clear();
  }

 private:
  std::vector<Sides> sides_;
  std::size_t added_;
  std::size_t cone_rows_;  // of the original
};

struct Placed {
  std::vector<Sides> sides;
  std::int32_t equalities = 0;
  std::int32_t inequalities = 0;
};

Placed PlaceRows(const ProblemData& d) {
  Placed placed;
  placed.sides.resize(d.row_lower.size());
  for (std::size_t i = 0; i < d.row_lower.size(); ++i) {
    if (d.row_lower[i] == d.row_upper[i]) placed.sides[i].equal = placed.equalities++;
  }
  for (std::size_t i = 0; i < d.row_lower.size(); ++i) {
    Sides& s = placed.sides[i];
    if (s.equal != kNone) continue;
    if (d.row_lower[i] > -kInfinity) s.lower = placed.equalities + placed.inequalities++;
    if (d.row_upper[i] < kInfinity) s.upper = placed.equalities + placed.inequalities++;
  }
  return placed;
}

/// [equalities; sides; F], columns ascending since each pass meets its rows in order.
Csc StackSides(const ProblemData& d, const Placed& placed) {
  const std::int32_t added = placed.equalities + placed.inequalities;
  Csc all(added + d.num_cone_rows(), d.num_vars);
  all.row.reserve(2 * d.A.row.size() + d.F.row.size());
  all.value.reserve(all.row.capacity());
  const auto put = [&](std::int32_t row, double value) {
    if (row == kNone) return;
    all.row.push_back(row);
    all.value.push_back(value);
  };
  for (std::size_t j = 0; j < static_cast<std::size_t>(d.num_vars); ++j) {
    const auto first = static_cast<std::size_t>(d.A.start[j]);
    const auto last = static_cast<std::size_t>(d.A.start[j + 1]);
    for (std::size_t k = first; k < last; ++k) {
      put(placed.sides[static_cast<std::size_t>(d.A.row[k])].equal, d.A.value[k]);
    }
    for (std::size_t k = first; k < last; ++k) {
      const Sides& s = placed.sides[static_cast<std::size_t>(d.A.row[k])];
      put(s.lower, d.A.value[k]);
      put(s.upper, -d.A.value[k]);
    }
    for (auto k = static_cast<std::size_t>(d.F.start[j]);
         k < static_cast<std::size_t>(d.F.start[j + 1]); ++k) {
      put(added + d.F.row[k], d.F.value[k]);
    }
    all.start[j + 1] = static_cast<std::int32_t>(all.row.size());
  }
  return all;
}

Bridged Apply(ProblemData d) {
  Placed placed = PlaceRows(d);
  const auto added = static_cast<std::size_t>(placed.equalities + placed.inequalities);
  const std::size_t cone_rows = d.g.size();
  d.F = StackSides(d, placed);
  std::vector<double> g(added);
  for (std::size_t i = 0; i < placed.sides.size(); ++i) {
    const Sides& s = placed.sides[i];
    if (s.equal != kNone) g[static_cast<std::size_t>(s.equal)] = -d.row_lower[i];
    if (s.lower != kNone) g[static_cast<std::size_t>(s.lower)] = -d.row_lower[i];
    if (s.upper != kNone) g[static_cast<std::size_t>(s.upper)] = d.row_upper[i];
  }
  d.g.insert(d.g.begin(), g.begin(), g.end());
  std::vector<sy_cone> cones;
  if (placed.equalities > 0) cones.push_back({SY_CONE_ZERO, placed.equalities, 0});
  if (placed.inequalities > 0) cones.push_back({SY_CONE_NONNEGATIVE, placed.inequalities, 0});
  d.cones.insert(d.cones.begin(), cones.begin(), cones.end());
  d.A = Csc(0, d.num_vars);
  d.row_lower.clear();
  d.row_upper.clear();
  return {std::move(d),
          std::make_unique<RowsToConesBridge>(std::move(placed.sides), added, cone_rows)};
}

}  // namespace

BridgeKind RowsToCones() {
  return {"rows to zero and nonnegative cones", SY_ACCEPTS_ROWS,
          ConeFeature(SY_CONE_ZERO) | ConeFeature(SY_CONE_NONNEGATIVE), Apply};
}

}  // namespace switchyard
