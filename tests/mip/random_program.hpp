// tests/mip/random_program.hpp - mixed-integer conic programs of every class, small enough to be
// solved by enumeration.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard::testing {

/// kOnOff has blocks of variables that a binary z switches off: cones that are {0} where z = 0.
/// kPotentials has second-order cones over differences of variables without ends, which rows make
/// what the others would say: they may all move together, so nothing closes their boxes.
enum class ProgramClass {
  kLinear,
  kQuadratic,
  kLorentz,
  kRotated,
  kSemidefinite,
  kExponential,
  kPower,
  kMixed,
  kOnOff,
  kPotentials
};
inline constexpr std::array kProgramClasses = {
    ProgramClass::kLinear,    ProgramClass::kQuadratic,    ProgramClass::kLorentz,
    ProgramClass::kRotated,   ProgramClass::kSemidefinite, ProgramClass::kExponential,
    ProgramClass::kPower,     ProgramClass::kMixed,        ProgramClass::kOnOff,
    ProgramClass::kPotentials};
const char* NameOf(ProgramClass c);

/// Two to eight integers first, in [0, 1] or within [-2, 3] and at most 256 assignments in all,
/// then up to five continuous variables in boxes, and at times one without, which is the head of a
/// cone and has a positive cost, and potentials whose costs add up to 0: so every program is
/// bounded, and has an optimum where it is feasible. Most rows and cones hold at one drawn point;
/// one in five is moved, which leaves some programs without any. The same for the same seed.
ProblemData RandomProgram(ProgramClass c, std::uint32_t seed);

}  // namespace switchyard::testing
