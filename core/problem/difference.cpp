#include "core/problem/difference.hpp"

#include <algorithm>

namespace switchyard {
namespace {

bool Different(const Csc& a, const Csc& b) {
  return a.rows != b.rows || a.cols != b.cols || a.start != b.start || a.row != b.row;
}

bool SameCones(const std::vector<sy_cone>& a, const std::vector<sy_cone>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const sy_cone& s, const sy_cone& t) {
    return s.kind == t.kind && s.dim == t.dim && s.parameter == t.parameter;
  });
}

}  // namespace

std::uint64_t ProblemDifference(const ProblemData& before, const ProblemData& after) {
  const bool structure = before.num_vars != after.num_vars || Different(before.P, after.P) ||
                         Different(before.A, after.A) || Different(before.F, after.F) ||
                         before.integer != after.integer ||
                         before.x_lower.empty() != after.x_lower.empty() ||
                         !SameCones(before.cones, after.cones);
  if (structure) return kStructureChanged;
  std::uint64_t kinds = 0;
  if (before.x_lower != after.x_lower || before.x_upper != after.x_upper ||
      before.row_lower != after.row_lower || before.row_upper != after.row_upper) {
    kinds |= SY_UPDATES_BOUNDS;
  }
  if (before.q != after.q || before.offset != after.offset || before.g != after.g) {
    kinds |= SY_UPDATES_VECTORS;
  }
  if (before.P.value != after.P.value || before.A.value != after.A.value ||
      before.F.value != after.F.value || before.flags != after.flags) {
    kinds |= SY_UPDATES_VALUES;
  }
  return kinds;
}

}  // namespace switchyard
