#include "algorithms.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "switchyard/plugin.hpp"

namespace switchyard::nlopt {
namespace {

constexpr unsigned kBoth = kInequalities | kEqualities;
constexpr unsigned kEither = kInnerWithout | kInnerWith;

// In NLopt's order, so that an algorithm is the place of its row.
constexpr std::array kAlgorithms = {
    Algorithm{NLOPT_GN_DIRECT, kGlobal},
    Algorithm{NLOPT_GN_DIRECT_L, kGlobal},
    Algorithm{NLOPT_GN_DIRECT_L_RAND, kGlobal},
    Algorithm{NLOPT_GN_DIRECT_NOSCAL, kGlobal},
    Algorithm{NLOPT_GN_DIRECT_L_NOSCAL, kGlobal},
    Algorithm{NLOPT_GN_DIRECT_L_RAND_NOSCAL, kGlobal},
    Algorithm{NLOPT_GN_ORIG_DIRECT, kGlobal | kInequalities},
    Algorithm{NLOPT_GN_ORIG_DIRECT_L, kGlobal | kInequalities},
    Algorithm{NLOPT_GD_STOGO, kGlobal | kGradients},
    Algorithm{NLOPT_GD_STOGO_RAND, kGlobal | kGradients},
    Algorithm{NLOPT_LD_LBFGS_NOCEDAL, kGradients},
    Algorithm{NLOPT_LD_LBFGS, kGradients},
    Algorithm{NLOPT_LN_PRAXIS, 0},
    Algorithm{NLOPT_LD_VAR1, kGradients},
    Algorithm{NLOPT_LD_VAR2, kGradients},
    Algorithm{NLOPT_LD_TNEWTON, kGradients},
    Algorithm{NLOPT_LD_TNEWTON_RESTART, kGradients},
    Algorithm{NLOPT_LD_TNEWTON_PRECOND, kGradients},
    Algorithm{NLOPT_LD_TNEWTON_PRECOND_RESTART, kGradients},
    Algorithm{NLOPT_GN_CRS2_LM, kGlobal},
    Algorithm{NLOPT_GN_MLSL, kGlobal | kInnerWithout},
    Algorithm{NLOPT_GD_MLSL, kGlobal | kGradients | kInnerWith},
    Algorithm{NLOPT_GN_MLSL_LDS, kGlobal | kInnerWithout},
    Algorithm{NLOPT_GD_MLSL_LDS, kGlobal | kGradients | kInnerWith},
    Algorithm{NLOPT_LD_MMA, kGradients | kInequalities},
    Algorithm{NLOPT_LN_COBYLA, kBoth},
    Algorithm{NLOPT_LN_NEWUOA, kTwoVariables},
    Algorithm{NLOPT_LN_NEWUOA_BOUND, kTwoVariables},
    Algorithm{NLOPT_LN_NELDERMEAD, 0},
    Algorithm{NLOPT_LN_SBPLX, 0},
    Algorithm{NLOPT_LN_AUGLAG, kBoth | kInnerWithout},
    Algorithm{NLOPT_LD_AUGLAG, kGradients | kBoth | kInnerWith},
    Algorithm{NLOPT_LN_AUGLAG_EQ, kBoth | kInnerWithout},
    Algorithm{NLOPT_LD_AUGLAG_EQ, kGradients | kBoth | kInnerWith},
    Algorithm{NLOPT_LN_BOBYQA, kTwoVariables},
    Algorithm{NLOPT_GN_ISRES, kGlobal | kBoth},
    Algorithm{NLOPT_AUGLAG, kBoth | kEither},
    Algorithm{NLOPT_AUGLAG_EQ, kBoth | kEither},
    Algorithm{NLOPT_G_MLSL, kGlobal | kEither},
    Algorithm{NLOPT_G_MLSL_LDS, kGlobal | kEither},
    Algorithm{NLOPT_LD_SLSQP, kGradients | kBoth},
    Algorithm{NLOPT_LD_CCSAQ, kGradients | kInequalities},
    Algorithm{NLOPT_GN_ESCH, kGlobal},
    Algorithm{NLOPT_GN_AGS, kGlobal | kInequalities},
};

constexpr bool RowsStandInOrder() {
  for (std::size_t k = 0; k < kAlgorithms.size(); ++k) {
    if (kAlgorithms[k].id != static_cast<nlopt_algorithm>(k)) return false;
  }
  return kAlgorithms.size() == NLOPT_NUM_ALGORITHMS;
}
static_assert(RowsStandInOrder());

/// How many letters to change, drop or add to get from one word to the other.
std::size_t Distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t above = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, above + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

/// What NLopt has only a name for refuses to run.
bool IsBuilt(const Algorithm& algorithm) {
  constexpr unsigned kVars = 2;
  const nlopt_opt run = nlopt_create(algorithm.id, kVars);
  const nlopt_opt local = nlopt_create(NLOPT_LN_COBYLA, kVars);
  const auto flat = [](unsigned n, const double*, double* gradient, void*) {
    if (gradient != nullptr) std::fill(gradient, gradient + n, 1.0);
    return 0.0;
  };
  nlopt_set_maxeval(local, 1);
  nlopt_set_local_optimizer(run, local);
  nlopt_set_min_objective(run, flat, nullptr);
  nlopt_set_lower_bounds1(run, 0);
  nlopt_set_upper_bounds1(run, 1);
  nlopt_set_maxeval(run, 1);
  double x[kVars] = {0.5, 0.5};
  double value = 0;
  const nlopt_result result = nlopt_optimize(run, x, &value);
  nlopt_destroy(local);
  nlopt_destroy(run);
  return result != NLOPT_INVALID_ARGS;
}

bool LeavesInequalitiesInside(const Algorithm& algorithm) {
  return algorithm.id == NLOPT_AUGLAG_EQ || algorithm.id == NLOPT_LN_AUGLAG_EQ ||
         algorithm.id == NLOPT_LD_AUGLAG_EQ;
}

}  // namespace

const Algorithm& FactsOf(nlopt_algorithm id) { return kAlgorithms[static_cast<std::size_t>(id)]; }

const Algorithm& AlgorithmNamed(std::string_view option, std::string_view name) {
  const auto distance = [&](const Algorithm& row) { return Distance(name, row.name()); };
  const Algorithm& nearest =
      *std::min_element(kAlgorithms.begin(), kAlgorithms.end(),
                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const std::size_t apart = distance(nearest);
  std::string why;
  if (apart > 0) {
    why = "NLopt has no algorithm '" + std::string(name) + "'";
    if (apart <= std::max<std::size_t>(2, name.size() / 2)) {
      why += std::string("; the nearest is ") + nearest.name();
    }
  } else if (!IsBuilt(nearest)) {
    why = std::string("the NLopt that is here was built without ") + nearest.name();
  } else {
    return nearest;
  }
  throw plugin::Failure(SY_E_ARGUMENT, "option " + std::string(option) + ": " + why);
}

std::vector<nlopt_algorithm> Nest(const Algorithm& algorithm, const Algorithm* local,
                                  const Demand& demand) {
  std::vector<nlopt_algorithm> nest;
  const bool fits = (algorithm.Is(kEqualities) || !demand.equalities) &&
                    (algorithm.Is(kInequalities) || !demand.inequalities);
  if (!fits) {
    const bool inside = algorithm.Is(kInequalities) && demand.inequalities;
    nest.push_back(inside ? NLOPT_AUGLAG_EQ : NLOPT_AUGLAG);
  }
  const auto too_few = [&](const Algorithm& a) {
    return a.Is(kTwoVariables) && demand.num_vars < 2;
  };
  nest.push_back(too_few(algorithm) ? NLOPT_LN_COBYLA : algorithm.id);
  if (!algorithm.Is(kEither)) return nest;
  const bool with = algorithm.Is(kInnerWith) && (demand.gradients || !algorithm.Is(kInnerWithout));
  const bool constrained = LeavesInequalitiesInside(algorithm) && demand.inequalities;
  nlopt_algorithm inner = !with ? NLOPT_LN_COBYLA : constrained ? NLOPT_LD_CCSAQ : NLOPT_LD_LBFGS;
  if (local != nullptr && !too_few(*local)) inner = local->id;
  if (constrained && !FactsOf(inner).Is(kInequalities)) nest.back() = NLOPT_AUGLAG;
  nest.push_back(inner);
  return nest;
}

unsigned BitsOf(const std::vector<nlopt_algorithm>& nest) {
  unsigned bits = 0;
  for (const nlopt_algorithm id : nest) bits |= FactsOf(id).bits;
  return bits;
}

}  // namespace switchyard::nlopt
