#include "core/bridges/rotate_cones.hpp"

#include <cmath>

namespace switchyard {
namespace {

const double kHalf = std::sqrt(0.5);

class RotateBridge final : public Bridge {
 public:
  explicit RotateBridge(std::vector<std::size_t> heads) : heads_(std::move(heads)) {}

  void Back(Vectors& v) const override { Rotate(v.cone_dual); }
  void Forward(Vectors& v) const override { Rotate(v.cone_dual); }

 private:
  void Rotate(std::vector<double>& dual) const {
    if (dual.empty()) return;
    for (const std::size_t i : heads_) {
      const double first = dual[i];
      const double second = dual[i + 1];
      dual[i] = kHalf * (first + second);
      dual[i + 1] = kHalf * (first - second);
    }
  }

  std::vector<std::size_t> heads_;  // the first row of each rotated cone
};

/// The rows i and i + 1 of F, i in `heads`, replaced by their sum and difference over sqrt2. Both
/// have entries where either had, so that the pattern does not depend on the numbers.
Csc RotateRows(const Csc& F, const std::vector<std::int8_t>& place) {
  Csc out(F.rows, F.cols);
  out.row.reserve(F.row.size() + F.row.size() / 2);
  out.value.reserve(out.row.capacity());
  for (std::size_t j = 0; j < static_cast<std::size_t>(F.cols); ++j) {
    const auto last = static_cast<std::size_t>(F.start[j + 1]);
    for (auto k = static_cast<std::size_t>(F.start[j]); k < last; ++k) {
      const auto i = static_cast<std::size_t>(F.row[k]);
      if (place[i] < 0) {
        out.row.push_back(F.row[k]);
        out.value.push_back(F.value[k]);
        continue;
      }
      const std::int32_t head = F.row[k] - place[i];
      double first = 0;
      double second = 0;
      (place[i] == 0 ? first : second) = F.value[k];
      if (place[i] == 0 && k + 1 < last && F.row[k + 1] == head + 1) second = F.value[++k];
      out.row.insert(out.row.end(), {head, head + 1});
      out.value.insert(out.value.end(), {kHalf * (first + second), kHalf * (first - second)});
    }
    out.start[j + 1] = static_cast<std::int32_t>(out.row.size());
  }
  return out;
}

}  // namespace

Bridged RotateCones(ProblemData d, sy_cone_kind from, sy_cone_kind to) {
  std::vector<std::size_t> heads;
  std::vector<std::int8_t> place(d.g.size(), -1);  // 0, 1: first or second row of its cone
  std::size_t row = 0;
  for (sy_cone& cone : d.cones) {
    if (cone.kind == from && cone.dim == 1) {
      cone.kind = SY_CONE_NONNEGATIVE;
    } else if (cone.kind == from) {
      heads.push_back(row);
      place[row] = 0;
      place[row + 1] = 1;
      const double g0 = d.g[row];
      const double g1 = d.g[row + 1];
      d.g[row] = kHalf * (g0 + g1);
      d.g[row + 1] = kHalf * (g0 - g1);
      cone.kind = to;
    }
    row += static_cast<std::size_t>(cone.dim);
  }
  d.F = RotateRows(d.F, place);
  return {std::move(d), std::make_unique<RotateBridge>(std::move(heads))};
}

}  // namespace switchyard
