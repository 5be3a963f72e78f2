// tools/switchyard/describe.hpp - a backend's table in words.
#pragma once

#include <string>
#include <vector>

#include "switchyard/host/host.hpp"

namespace switchyard::cli {

/// The bits of a field of sy_solver as words, in their order.
std::vector<std::string> SectionWords(std::uint64_t accepts);
std::vector<std::string> ConeWords(std::uint64_t cones);
std::vector<std::string> TraitWords(std::uint64_t traits);
std::vector<std::string> LimitWords(std::uint64_t honors);
std::vector<std::string> UpdateWords(std::uint64_t updates);

std::string Joined(const std::vector<std::string>& words);

/// "LP, QP, SOCP, SDP, MILP, ...": the classes that these sections make. Those of a strategy are
/// what serves underneath.
std::string ProblemClasses(const sy_solver& solver);

/// "integer 0 to 100, 10 unless set".
std::string OptionRange(const sy_option& option);

}  // namespace switchyard::cli
