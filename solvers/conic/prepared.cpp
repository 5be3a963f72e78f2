#include "solvers/conic/prepared.hpp"

#include <cstring>
#include <string_view>
#include <vector>

#include "solvers/conic/blocks.hpp"
#include "switchyard/hints.h"

namespace switchyard::conic {
namespace {

bool HasFixed(const ProblemData& p) {
  for (std::size_t j = 0; j < p.x_lower.size(); ++j) {
    if (p.x_lower[j] == p.x_upper[j]) return true;
  }
  return false;
}

// Fixed variables have no inside: they must go, and the pattern with them.
presolve::Limits LimitsOf(const ProblemData& problem, const Options& options,
                          std::uint64_t updates) {
  if (HasFixed(problem)) return {};
  if (options.presolve == 0) return {false, false, false};
  return {(updates & SY_UPDATES_BOUNDS) == 0, (updates & SY_UPDATES_VECTORS) == 0,
          (updates & SY_UPDATES_VALUES) == 0};
}

const sy_blocks* BlockHint(const sy_hint* hints) {
  for (; hints != nullptr && hints->id != nullptr; ++hints) {
    if (std::string_view(hints->id) == "sy.blocks/1") {
      return static_cast<const sy_blocks*>(hints->data);
    }
  }
  return nullptr;
}

}  // namespace

Prepared::Prepared(const ProblemData& problem, Index hinted_vars, const Options& options,
                   std::uint64_t updates, const Prepared* before)
    : presolve_(problem, LimitsOf(problem, options, updates)), form_(presolve_.reduced()) {
  shares_ = before != nullptr && form_.SamePattern(before->form_);
  if (shares_) {
    kkt_ = std::make_unique<Kkt>(form_, *before->kkt_);
  } else {
    kkt_ = std::make_unique<Kkt>(form_,
                                 options.blocks != 0 ? BlocksOf(problem, hinted_vars) : Blocks{});
  }
}

// Variables that were appended after the hint belong to no block.
Blocks Prepared::BlocksOf(const ProblemData& problem, Index hinted_vars) const {
  const sy_blocks* hint = BlockHint(problem.hints);
  if (hint == nullptr) return FindBlocks(form_);
  std::vector<Index> block;
  for (const Index k : form_.variable) {
    const Index j = presolve_.variables()[k];
    block.push_back(j < hinted_vars ? hint->x[j] : -1);
  }
  return GivenBlocks(form_, block);
}

presolve::Answer Prepared::Back(const Iterate& at, presolve::Meaning meaning) const {
  const Shape& s = form_.shape;
  const double scale = meaning == presolve::Meaning::kOptimum ? 1 / at.tau : 1;
  Vector x = at.x, y(s.rows()), bounds(s.vars, 0.0);
  for (double& v : x) v *= scale;
  for (Index i = 0; i < s.conic_rows(); ++i) y[i] = at.z[i] * scale;
  for (Index i = 0; i < s.ranges; ++i) y[s.cone_rows + i] -= at.z[s.range_tops() + i] * scale;
  for (Index i = 0; i < s.equations; ++i) y[s.conic_rows() + i] = at.y[i] * scale;
  for (Index j = 0; j < s.bounded; ++j) bounds[j] = at.z[s.lower_bounds() + j] * scale;
  for (Index j = 0; j < s.boxed; ++j) bounds[j] -= at.z[s.upper_bounds() + j] * scale;
  const ProblemData& r = presolve_.reduced();
  presolve::Answer reduced;
  reduced.meaning = meaning;
  reduced.x.resize(r.num_vars);
  reduced.x_dual.resize(r.num_vars);
  reduced.row_dual.resize(r.num_rows());
  reduced.cone_dual.resize(r.num_cone_rows());
  form_.PointBack(x, reduced.x.data());
  form_.DualsBack(y, bounds, reduced.x_dual.data(), reduced.row_dual.data(),
                  reduced.cone_dual.data(), r.num_vars, r.num_rows(), r.num_cone_rows());
  return presolve_.Back(reduced);
}

}  // namespace switchyard::conic
