#include "plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "switchyard/plugin.hpp"

namespace switchyard::nlopt {
namespace {

using plugin::Failure;

// Variables and constraints up to which LD_SLSQP, a step of which takes their third power, is
// quick.
constexpr std::size_t kSmall = 500;
// The same without constraints, where LD_LBFGS does well.
constexpr std::size_t kSmallFree = 100;
// Evaluations of a run, for each variable: of a global one, and of a later one, which has converged
// by then or does not converge.
constexpr int kGlobalEvaluations = 2000;
constexpr int kLaterEvaluations = 50;
constexpr std::size_t kFewVariables = 60;  // fewer are taken for as many
// Relative tolerances of a later run: with derivatives until rounding errors are all that moves.
// The augmented Lagrangian would fail in them.
constexpr double kTight = 1e-15;
constexpr double kTightPenalty = 1e-10;
constexpr double kTightWithout = 1e-10;
// The first step of another run without derivatives, beside x.
constexpr double kShort = 1e-3;

/// Is it small enough for what takes the third power of its size?
bool IsSmall(const Program& program) {
  const std::size_t conditions = program.num_spoken();
  return program.moving().size() + conditions <= (conditions > 0 ? kSmall : kSmallFree);
}

int Times(int factor, std::size_t count) {
  const double product = static_cast<double>(factor) * static_cast<double>(count);
  return static_cast<int>(std::min<double>(product, std::numeric_limits<int>::max()));
}

int LaterEvaluations(const Program& program) {
  return Times(kLaterEvaluations, std::max(kFewVariables, program.moving().size()));
}

/// LD_SLSQP refuses more equations than variables.
Equations WayOf(const std::vector<nlopt_algorithm>& nest, const Program& program) {
  const bool too_many = program.num_equations() > program.moving().size();
  return nest.front() == NLOPT_LD_SLSQP && too_many ? Equations::kAsPairs : Equations::kAsTheyAre;
}

Order OrderOf(nlopt_algorithm algorithm, const Algorithm* local, const Program& program) {
  Order order;
  order.nest = Nest(FactsOf(algorithm), local, program.Demands());
  order.equations = WayOf(order.nest, program);
  return order;
}

void Check(const Order& order, Program& program) {
  const Functions& functions = program.functions();
  for (const nlopt_algorithm id : order.nest) {
    const Algorithm& algorithm = FactsOf(id);
    if (algorithm.Is(kGradients) && !functions.has_gradients()) {
      throw Failure(SY_E_UNSUPPORTED, std::string(algorithm.name()) +
                                          " asks for derivatives, which the nonlinear functions "
                                          "do not have");
    }
    for (const std::int32_t j : program.moving()) {
      const bool lower = std::isfinite(functions.problem().x_lower[j]);
      const bool upper = std::isfinite(functions.problem().x_upper[j]);
      if (!algorithm.Is(kGlobal) || (lower && upper)) continue;
      throw Failure(SY_E_UNSUPPORTED, std::string(algorithm.name()) + " searches a finite box: x[" +
                                          std::to_string(j) + "] has no " +
                                          (lower ? "upper" : "lower") + " bound");
    }
  }
}

}  // namespace

Order FirstOrder(const Options& options, Program& program) {
  const nlopt_algorithm fitting = !program.functions().has_gradients() ? NLOPT_LN_COBYLA
                                  : IsSmall(program)                   ? NLOPT_LD_SLSQP
                                                                       : NLOPT_LD_LBFGS;
  const Algorithm* chosen = options.algorithm();
  Order order =
      OrderOf(chosen != nullptr ? chosen->id : fitting, options.local_algorithm(), program);
  Check(order, program);
  order.initial_step = options.Real("initial_step");
  order.maxeval = options.Integer("maxeval");
  if (order.maxeval == 0 && AnyIs(order.nest, kGlobal)) {
    order.maxeval = Times(kGlobalEvaluations, program.moving().size() + 1);
  }
  return order;
}

std::vector<Order> LaterOrders(const Options& options, const Order& first, Program& program) {
  const bool local = AnyIs(first.nest, kGradients) && !AnyIs(first.nest, kGlobal);
  if (!local && options.Integer("polish") == 0) return {};
  const Order by_hessian = OrderOf(NLOPT_LD_SLSQP, nullptr, program);
  const Order by_penalty = OrderOf(NLOPT_LD_LBFGS, nullptr, program);
  std::vector<Order> orders;
  if (IsSmall(program)) {
    orders = {by_hessian, by_penalty, by_hessian};
    if (program.Demands().equalities) {
      orders.push_back(by_hessian);
      orders.back().equations = Equations::kAsPairs;
    }
  } else {
    orders = {by_penalty, by_penalty};
  }
  for (Order& order : orders) {
    order.tightest = order.nest.size() > 1 ? kTightPenalty : kTight;
    order.maxeval = LaterEvaluations(program);
    if (const int asked = options.Integer("maxeval")) {
      order.maxeval = std::min(order.maxeval, asked);
    }
  }
  return orders;
}

Order AgainOrder(const Options& options, const Order& before, bool failed,
                 const std::vector<double>& x, Program& program) {
  const bool other = failed || AnyIs(before.nest, kGlobal);
  Order order = other ? OrderOf(NLOPT_LN_COBYLA, nullptr, program) : before;
  double size = 1;
  for (const double v : program.Moving(x)) size = std::max(size, std::abs(v));
  order.initial_step = kShort * size;
  order.maxeval = options.Integer("maxeval");
  order.tightest = kTightWithout;
  return order;
}

Order FeasibilityOrder(Program& program) {
  Order order;
  order.nest = {IsSmall(program) ? NLOPT_LD_SLSQP : NLOPT_LD_LBFGS};
  order.aim = Aim::kViolation;
  order.tightest = kTight;
  order.maxeval = LaterEvaluations(program);
  return order;
}

}  // namespace switchyard::nlopt
