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

}  // namespace switchyard::rounding
