// solvers/mip/perspectives.hpp - cones that a binary switches off, written with the binary in them.
#pragma once

#include <cstdint>

#include "solvers/mip/node_boxes.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

/// In each cone 2 r t >= |u|^2 whose head r is a number c while rows of two entries, and bounds,
/// say that every member is 0 where a binary z is, that head becomes c z; how many there were.
///
/// The integer points are the same: with z = 1 the cone is as it was, with z = 0 there is u = 0 in
/// both, and t >= 0. The relaxation is the convex hull of the two (Frangioni and Gentile,
/// Perspective cuts for a class of convex 0-1 mixed integer programs, 2006). c is the upper end of
/// what is known of it.
std::int32_t TakePerspectives(Problem& problem, const NodeBoxes& boxes);

}  // namespace switchyard::mip
