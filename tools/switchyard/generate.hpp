// tools/switchyard/generate.hpp - graphs of convex sets of any size, made from a seed.
#pragma once

#include <cstdint>

#include "floor_graph.hpp"

namespace switchyard::cli {

/// size x size square cells of side 1, from the lower left to the upper right corner. The walls are
/// those of a random spanning tree, and one in twenty of the others is open too, so that there are
/// several ways.
GraphProblem GenerateMaze(int size, std::uint64_t seed, StepCost cost);

/// `size` rooms of different sizes and the doorways between them; lengths are meters, walls and
/// doorways 0.25 m thick, doorways 1 m wide. Each room can be reached; about a third of the walls
/// that could have a further door has one.
GraphProblem GenerateBuilding(int size, std::uint64_t seed, StepCost cost);

}  // namespace switchyard::cli
