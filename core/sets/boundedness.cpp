// Boundedness by the cone of directions of recession, {x : (0, x, w) in the scaled form}.
//
// It is the recession cone of the set where the set has a point and its projection along w is
// closed: without own variables, and of polyhedra. Else a direction found still is one, and where
// none is found the support functions have the last word: {x : x^2 <= w for some w} has none.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/sets/recession_cone.hpp"
#include "core/sets/section_lp.hpp"
#include "core/sets/set_program.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/solve_in_parallel.hpp"

namespace switchyard {
namespace {

// A cone that is not {0} along a coordinate reaches 1 there, whatever its angle.
constexpr double kReaches = 0.5;

/// Plus or minus a coordinate, one for each end of the box that is open.
std::vector<Eigen::VectorXd> OpenEnds(const SetBox& box) {
  std::vector<Eigen::VectorXd> ends;
  const Eigen::Index n = box.lower.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(box.upper[i])) ends.emplace_back(Eigen::VectorXd::Unit(n, i));
    if (!std::isfinite(box.lower[i])) ends.emplace_back(-Eigen::VectorXd::Unit(n, i));
  }
  return ends;
}

std::optional<bool> HasDirectionByLp(const ScaledSet& cone,
                                     const std::vector<Eigen::VectorXd>& ends) {
  for (const Eigen::VectorXd& end : ends) {
    const std::optional<double> value = RecessionByLp(cone, end);
    if (!value) return std::nullopt;
    if (*value > kReaches) return true;
  }
  return false;
}

bool HasDirection(const ConvexSet& set, const std::vector<Eigen::VectorXd>& ends,
                  Parallelism parallelism) {
  const ScaledSet cone = RecessionCone(set.scaled());
  if (IsSmallPolyhedron(cone)) {
    if (const auto answer = HasDirectionByLp(cone, ends)) return *answer;
  }
  const auto at_once = static_cast<std::size_t>(parallelism.num_threads());
  for (std::size_t first = 0; first < ends.size(); first += at_once) {
    std::vector<std::unique_ptr<RecessionProgram>> programs;
    std::vector<const MathematicalProgram*> pointers;
    for (std::size_t k = first; k < std::min(ends.size(), first + at_once); ++k) {
      programs.push_back(std::make_unique<RecessionProgram>(set, ends[k]));
      pointers.push_back(&programs.back()->program);
    }
    const auto results = SolveInParallel(pointers, nullptr, nullptr, std::nullopt, parallelism);
    for (std::size_t k = 0; k < programs.size(); ++k) {
      if (programs[k]->Value(results[k]) > kReaches) return true;
    }
  }
  return false;
}

}  // namespace

bool ConvexSet::DoIsBounded(Parallelism parallelism) const {
  const SetBox& box = bounding_box();
  if (box.empty || box.is_finite()) return true;
  const std::vector<Eigen::VectorXd> ends = OpenEnds(box);
  if (HasDirection(*this, ends, parallelism)) return IsEmpty();
  if (scaled().num_aux == 0 || scaled().cones.empty()) return true;
  return std::all_of(ends.begin(), ends.end(), [this](const Eigen::VectorXd& end) {
    return SupportFunction(end) < kInfinity;
  });
}

}  // namespace switchyard
