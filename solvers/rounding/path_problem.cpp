#include "solvers/rounding/path_problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

#include "switchyard/cones.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {
namespace {

using plugin::Failure;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

const void* HintOf(const sy_problem& problem, const char* id) {
  for (const sy_hint* hint = problem.hints; hint != nullptr && hint->id != nullptr; ++hint) {
    if (std::strcmp(hint->id, id) == 0) return hint->data;
  }
  return nullptr;
}

std::span<const std::int32_t> Span(const std::int32_t* first, std::int32_t count) {
  return {first, At(count)};
}

/// Each index[i] of `what` must be in [least, end).
void NeedIndices(const std::string& what, const std::int32_t* index, std::int32_t count,
                 std::int32_t least, std::int32_t end) {
  if (count > 0 && index == nullptr) throw Failure(SY_E_ARGUMENT, what + " is absent");
  for (std::int32_t i = 0; i < count; ++i) {
    if (index[i] >= least && index[i] < end) continue;
    throw Failure(SY_E_ARGUMENT, what + "[" + std::to_string(i) + "] must be in [" +
                                     std::to_string(least) + ", " + std::to_string(end) +
                                     "), and is " + std::to_string(index[i]));
  }
}

sy_blocks CheckedBlocks(const sy_problem& p) {
  if (const char* why = WhyNot(p); *why != '\0') throw Failure(SY_E_UNSUPPORTED, why);
  if (!IsPathProblem(p)) {
    throw Failure(SY_E_UNSUPPORTED,
                  "a path problem needs the hints sy.paths/1 and sy.blocks/1, and the problem does "
                  "not have both");
  }
  const auto blocks = plugin::Whole(*static_cast<const sy_blocks*>(HintOf(p, "sy.blocks/1")));
  NeedIndices("sy.blocks/1: x", blocks.x, p.num_vars, -1, blocks.num_blocks);
  NeedIndices("sy.blocks/1: row", blocks.row, p.num_rows, -1, blocks.num_blocks);
  NeedIndices("sy.blocks/1: cone", blocks.cone, p.num_cones, -1, blocks.num_blocks);
  return blocks;
}

sy_paths CheckedPaths(const sy_problem& p, const sy_blocks& blocks) {
  const auto paths = plugin::Whole(*static_cast<const sy_paths*>(HintOf(p, "sy.paths/1")));
  NeedIndices("sy.paths/1: tail", paths.tail, paths.num_arcs, 0, paths.num_vertices);
  NeedIndices("sy.paths/1: head", paths.head, paths.num_arcs, 0, paths.num_vertices);
  NeedIndices("sy.paths/1: flow", paths.flow, paths.num_arcs, 0, p.num_vars);
  NeedIndices("sy.paths/1: source", &paths.source, 1, 0, paths.num_vertices);
  NeedIndices("sy.paths/1: target", &paths.target, 1, 0, paths.num_vertices);
  NeedIndices("sy.paths/1: scale", paths.scale, blocks.num_blocks, -1, p.num_vars);
  for (std::int32_t b = 0; b < blocks.num_blocks; ++b) {
    if (paths.scale[b] < 0) continue;
    const std::string of = " of block " + std::to_string(b) + ", entry ";
    NeedIndices("sy.paths/1: arc_in" + of, paths.arc_in + b, 1, 0, paths.num_arcs);
    NeedIndices("sy.paths/1: arc_out" + of, paths.arc_out + b, 1, 0, paths.num_arcs);
  }
  return paths;
}

double LowerOf(const sy_problem& p, std::int32_t j) {
  return p.x_lower != nullptr ? p.x_lower[j] : -kInfinity;
}
double UpperOf(const sy_problem& p, std::int32_t j) {
  return p.x_upper != nullptr ? p.x_upper[j] : kInfinity;
}

/// Arcs that a bound closes do not leave their vertex.
std::vector<std::uint8_t> Open(const sy_problem& p, const sy_paths& paths) {
  std::vector<std::uint8_t> open(At(paths.num_arcs));
  for (std::int32_t a = 0; a < paths.num_arcs; ++a) open[At(a)] = UpperOf(p, paths.flow[a]) >= 1;
  return open;
}

std::vector<std::int32_t> ArcOfScaledBlocks(const sy_paths& paths, std::int32_t num_blocks) {
  std::vector<std::int32_t> arc(At(num_blocks), -1);
  for (std::int32_t b = 0; b < num_blocks; ++b) {
    if (paths.scale[b] >= 0) arc[At(b)] = paths.arc_in[b];
  }
  return arc;
}

/// Rows of nonnegative terms that have a positive upper side, by row, and the first that may be
/// one.
struct BoundingRows {
  std::vector<std::uint8_t> is;
  std::int32_t first = 0;
};

/// Rows of scaled blocks, which are most and come first, have sides of 0.
BoundingRows RowsThatBound(const sy_problem& p) {
  BoundingRows rows{std::vector<std::uint8_t>(At(p.num_rows), 0), p.num_rows};
  if (p.A == nullptr || p.row_upper == nullptr) return rows;
  for (std::int32_t i = p.num_rows - 1; i >= 0; --i) {
    if (!(p.row_upper[i] > 0 && p.row_upper[i] < kInfinity)) continue;
    rows.is[At(i)] = 1;
    rows.first = i;
  }
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    const bool column = LowerOf(p, j) >= 0;
    for (std::int32_t k = p.A->start[j + 1] - 1; k >= p.A->start[j]; --k) {
      if (p.A->row[k] < rows.first) break;
      std::uint8_t& row = rows.is[At(p.A->row[k])];
      if (row != 0 && (!column || p.A->value[k] < 0)) row = 0;
    }
  }
  return rows;
}

}  // namespace

Groups::Groups(std::int32_t num_groups, std::span<const std::int32_t> group)
    : start_(At(num_groups) + 1, 0) {
  for (const std::int32_t g : group) {
    if (g >= 0) ++start_[At(g) + 1];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  member_.resize(At(start_.back()));
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (group[i] >= 0) member_[At(next[At(group[i])]++)] = static_cast<std::int32_t>(i);
  }
}

std::span<const std::int32_t> Groups::Of(std::int32_t group) const {
  const std::int32_t first = start_[At(group)];
  return std::span(member_).subspan(At(first), At(start_[At(group) + 1] - first));
}

bool IsPathProblem(const sy_problem& problem) {
  return HintOf(problem, "sy.paths/1") != nullptr && HintOf(problem, "sy.blocks/1") != nullptr;
}

std::vector<std::int32_t> FirstPoints(const sy_paths& paths, const std::int32_t* vertex) {
  std::vector<std::int32_t> first(At(paths.num_arcs), 0);
  for (std::int32_t a = 1; a < paths.num_arcs; ++a) {
    first[At(a)] = first[At(a - 1)] + paths.dim[vertex[a - 1]];
  }
  return first;
}

const char* WhyNot(const sy_problem& problem) {
  if (problem.P != nullptr && (problem.flags & SY_PROBLEM_CONVEX) == 0) {
    return "relax-and-round needs an objective that is known to be convex, and P is not";
  }
  return problem.nlp == nullptr ? "" : "relax-and-round takes no nonlinear functions";
}

PathProblem::PathProblem(const sy_problem& problem)
    : problem_(problem),
      blocks_(CheckedBlocks(problem)),
      paths_(CheckedPaths(problem, blocks_)),
      arcs_{paths_.num_vertices, Span(paths_.tail, paths_.num_arcs),
            Span(paths_.head, paths_.num_arcs)},
      out_(arcs_, Open(problem, paths_)),
      variables_(blocks_.num_blocks, Span(blocks_.x, problem.num_vars)),
      blocks_of_arc_(paths_.num_arcs, ArcOfScaledBlocks(paths_, blocks_.num_blocks)) {
  ListBlocks();
  ListCones();
  Relax();
}

void PathProblem::ListBlocks() {
  for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
    if (blocks_.x[j] < 0) coupling_.push_back(j);
  }
  for (std::int32_t b = 0; b < blocks_.num_blocks; ++b) {
    if (paths_.scale[b] < 0) always_on_.push_back(b);
  }
  for (std::int32_t i = 0; i < problem_.num_rows; ++i) {
    const bool below = problem_.row_lower != nullptr && problem_.row_lower[i] > 0;
    const bool above = problem_.row_upper != nullptr && problem_.row_upper[i] < 0;
    if (below || above) needy_rows_.push_back(i);
  }
}

void PathProblem::ListCones() {
  std::int32_t row = 0;
  for (std::int32_t c = 0; c < problem_.num_cones; ++c) {
    const sy_cone& cone = problem_.cones[c];
    cone_begin_.push_back(row);
    cone_of_row_.insert(cone_of_row_.end(), At(cone.dim), c);
    const double* g = problem_.g != nullptr ? problem_.g + row : nullptr;
    row += cone.dim;
    if (g == nullptr) continue;
    if (FactsOf(cone.kind).violation(g, cone.dim, cone.parameter) > 0) needy_cones_.push_back(c);
  }
}

void PathProblem::Relax() {
  const sy_problem& p = problem_;
  Relaxation& r = relaxation_;
  r.x_lower.resize(At(p.num_vars));
  r.x_upper.resize(At(p.num_vars));
  std::vector<std::uint8_t> scales(At(p.num_vars), 0);
  for (std::int32_t a = 0; a < paths_.num_arcs; ++a) scales[At(paths_.flow[a])] = 1;
  for (std::int32_t b = 0; b < blocks_.num_blocks; ++b) {
    if (paths_.scale[b] >= 0) scales[At(paths_.scale[b])] = 1;
  }
  const BoundingRows bounding = RowsThatBound(p);
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    const std::int32_t block = blocks_.x[j];
    const bool implied = block >= 0 && paths_.scale[block] >= 0 && scales[At(j)] == 0;
    r.x_lower[At(j)] = implied ? -kInfinity : LowerOf(p, j);
    r.x_upper[At(j)] = implied ? kInfinity : UpperOf(p, j);
    if (scales[At(j)] == 0 || p.A == nullptr) continue;
    if (!(LowerOf(p, j) < UpperOf(p, j))) continue;
    for (std::int32_t k = p.A->start[j + 1] - 1; k >= p.A->start[j]; --k) {
      const std::int32_t i = p.A->row[k];
      if (i < bounding.first) break;
      const bool bounds = bounding.is[At(i)] != 0 && p.A->value[k] > 0;
      if (bounds && p.row_upper[i] <= p.A->value[k] * UpperOf(p, j)) r.x_upper[At(j)] = kInfinity;
    }
  }
  r.hints = {{"sy.blocks/1", HintOf(p, "sy.blocks/1")}, {nullptr, nullptr}};
  r.problem = p;
  r.problem.integer = nullptr;
  r.problem.x_lower = r.x_lower.data();
  r.problem.x_upper = r.x_upper.data();
  r.problem.hints = r.hints.data();
}

}  // namespace switchyard::rounding
