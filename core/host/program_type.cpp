#include "switchyard/host/program_type.hpp"

#include <algorithm>

#include "core/bridges/bridge.hpp"

namespace switchyard {
namespace {

constexpr std::array<std::string_view, 13> kNames = {"lp",
                                                     "qp",
                                                     "socp",
                                                     "sdp",
                                                     "cgp",
                                                     "milp",
                                                     "miqp",
                                                     "misocp",
                                                     "misdp",
                                                     "micgp",
                                                     "quadratic_cost_conic_constraint",
                                                     "nlp",
                                                     "minlp"};
static_assert(static_cast<std::size_t>(ProgramType::kMINLP) + 1 == kNames.size());

bool Any(Features features, std::initializer_list<sy_cone_kind> kinds) {
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](sy_cone_kind kind) { return (features & ConeFeature(kind)) != 0; });
}

}  // namespace

std::string_view to_string(ProgramType type) { return kNames[static_cast<std::size_t>(type)]; }

std::optional<ProgramType> ProgramTypeNamed(std::string_view name) {
  const auto* found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<ProgramType>(found - kNames.begin());
}

ProgramType ProgramTypeOf(const sy_problem& problem) {
  const Features f = FeaturesOf(problem);
  const bool integer = (f & SY_ACCEPTS_INTEGER) != 0;
  const bool quadratic = (f & SY_ACCEPTS_QUADRATIC_OBJECTIVE) != 0;
  if ((f & (SY_ACCEPTS_NLP | SY_ACCEPTS_NONCONVEX_OBJECTIVE)) != 0) {
    return integer ? ProgramType::kMINLP : ProgramType::kNLP;
  }
  const bool general = Any(f, {SY_CONE_EXPONENTIAL, SY_CONE_POWER});
  const bool matrix = Any(f, {SY_CONE_PSD});
  const bool second_order = Any(f, {SY_CONE_SECOND_ORDER, SY_CONE_ROTATED});
  if (quadratic && !integer && (general || matrix || second_order)) {
    return ProgramType::kQuadraticCostConicConstraint;
  }
  if (general) return integer ? ProgramType::kMICGP : ProgramType::kCGP;
  if (matrix) return integer ? ProgramType::kMISDP : ProgramType::kSDP;
  if (second_order) return integer ? ProgramType::kMISOCP : ProgramType::kSOCP;
  if (quadratic) return integer ? ProgramType::kMIQP : ProgramType::kQP;
  return integer ? ProgramType::kMILP : ProgramType::kLP;
}

}  // namespace switchyard
