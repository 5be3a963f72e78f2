// solvers/cones/kinds.hpp - the cones that an interior-point method knows: one file each, one row
// each. Facts that are no barrier's stand in switchyard/cones.hpp.
#pragma once

#include <memory>

#include "solvers/cones/group.hpp"

namespace switchyard::cones {

using Maker = std::unique_ptr<Group> (*)(const Layout& layout, double parameter);

std::unique_ptr<Group> MakeSecondOrder(const Layout& layout, double parameter);
std::unique_ptr<Group> MakeSemidefinite(const Layout& layout, double parameter);
std::unique_ptr<Group> MakeExponential(const Layout& layout, double parameter);
std::unique_ptr<Group> MakePower(const Layout& layout, double parameter);

/// How a kind of cone is had.
struct Kind {
  sy_cone_kind kind;
  Index lanes;  // as many as may stand side by side
  Maker make;
  /// Is (H + r)^-1 diagonal but for two terms, the first of negative weight? Else it is all terms,
  /// as many as the cone has rows, of positive weights.
  bool diagonal_but_for_two;

  [[nodiscard]] Index rank(Index dim) const { return diagonal_but_for_two ? 2 : dim; }
};

inline constexpr Kind kKinds[] = {
    {SY_CONE_SECOND_ORDER, linalg::kLanes, MakeSecondOrder, true},
    {SY_CONE_PSD, 1, MakeSemidefinite, false},
    {SY_CONE_EXPONENTIAL, 1, MakeExponential, false},
    {SY_CONE_POWER, 1, MakePower, false},
};

/// nullptr where there is no row: such cones are rewritten before.
inline const Kind* FindKind(sy_cone_kind kind) {
  for (const Kind& k : kKinds) {
    if (k.kind == kind) return &k;
  }
  return nullptr;
}

}  // namespace switchyard::cones
