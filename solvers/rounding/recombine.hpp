// solvers/rounding/recombine.hpp - new paths from parts of those that were tried.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "switchyard/arcs.hpp"

namespace switchyard::rounding {

/// `path`, with each stretch of `other` that leaves it and comes back to it later put in the place
/// of its own: simple where `path` is.
std::vector<std::vector<std::int32_t>> Detours(const Arcs& arcs, std::span<const std::int32_t> path,
                                               std::span<const std::int32_t> other);

/// At each vertex of a path from its source to `target`, by each other arc of finite length that
/// leaves it: the shortest way on that meets no vertex of the path up to there (Yen, Management
/// Science 17, 1971). The shortest first; lengths are at least 0, infinity: not to be used.
std::vector<std::vector<std::int32_t>> Deviations(const Arcs& arcs, const Leaving& out,
                                                  std::span<const double> length,
                                                  std::span<const std::int32_t> path,
                                                  std::int32_t target);

/// `path` with up to two vertices in a row left out, and up to two put in their place: by arcs of
/// finite length, simple, the shortest first. So two neighbours change places, too.
std::vector<std::vector<std::int32_t>> Exchanges(const Arcs& arcs, const Leaving& out,
                                                 std::span<const double> length,
                                                 std::span<const std::int32_t> path);

}  // namespace switchyard::rounding
