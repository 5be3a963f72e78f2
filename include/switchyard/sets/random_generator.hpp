// switchyard/sets/random_generator.hpp - where random numbers of a caller's seed come from.
#pragma once

#include <random>

namespace switchyard {

/// RandomGenerator(1234) gives the same numbers on every machine.
using RandomGenerator = std::mt19937_64;

}  // namespace switchyard
