#include "run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "switchyard/plugin.hpp"

namespace switchyard::nlopt {
namespace {

struct Destroy {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using Optimizer = std::unique_ptr<nlopt_opt_s, Destroy>;

// Evaluations of a global search inside of the augmented Lagrangian, for each variable and one.
constexpr int kInnerGlobal = 200;

void SetLimits(nlopt_opt opt, const Order& order, const Options& options) {
  nlopt_set_xtol_rel(opt, std::min(options.Real("xtol_rel"), order.tightest));
  nlopt_set_ftol_rel(opt, std::min(options.Real("ftol_rel"), order.tightest));
  if (order.tightest == 1) {
    nlopt_set_xtol_abs1(opt, options.Real("xtol_abs"));
    nlopt_set_ftol_abs(opt, options.Real("ftol_abs"));
  }
  nlopt_set_vector_storage(opt, static_cast<unsigned>(options.Integer("vector_storage")));
  nlopt_set_population(opt, static_cast<unsigned>(options.Integer("population")));
}

/// The optimizers of the nest, from the inside out: each takes a copy of the one inside.
Optimizer Build(const Order& order, const Options& options, const Program& program) {
  const auto n = static_cast<unsigned>(program.moving().size());
  Optimizer inner;
  for (auto id = order.nest.rbegin(); id != order.nest.rend(); ++id) {
    Optimizer opt(nlopt_create(*id, n));
    if (opt == nullptr) throw std::bad_alloc();
    SetLimits(opt.get(), order, options);
    if (inner != nullptr) nlopt_set_local_optimizer(opt.get(), inner.get());
    const bool outermost = std::next(id) == order.nest.rend();
    if (!outermost && FactsOf(*id).Is(kGlobal)) {
      nlopt_set_maxeval(opt.get(), kInnerGlobal * (static_cast<int>(n) + 1));
    }
    inner = std::move(opt);
  }
  return inner;
}

}  // namespace

std::string NameOf(const Order& order) {
  std::string name;
  for (const nlopt_algorithm id : order.nest) {
    name += (name.empty() ? "" : " of ") + std::string(nlopt_algorithm_to_string(id));
  }
  return order.aim == Aim::kViolation ? name + " on the violation" : name;
}

Ended Run(const Order& order, const Options& options, double constraint_tolerance,
          const std::vector<double>& x, const linear::Watch& watch, Program& program) {
  const Optimizer opt = Build(order, options, program);
  const sy_problem& p = program.functions().problem();
  program.Begin(opt.get(), order.aim, order.equations, BitsOf(order.nest));
  nlopt_set_lower_bounds(opt.get(), program.Moving({p.x_lower, p.x_lower + p.num_vars}).data());
  nlopt_set_upper_bounds(opt.get(), program.Moving({p.x_upper, p.x_upper + p.num_vars}).data());
  program.AddConditions(constraint_tolerance);
  nlopt_set_maxeval(opt.get(), order.maxeval);
  constexpr double kLeastSeconds = 1e-3;  // NLopt reads 0 as no limit
  const double left = watch.Left();
  if (std::isfinite(left)) nlopt_set_maxtime(opt.get(), std::max(left, kLeastSeconds));
  if (order.initial_step > 0) nlopt_set_initial_step1(opt.get(), order.initial_step);

  std::vector<double> y = program.Moving(x);
  double value = 0;
  Ended ended{nlopt_optimize(opt.get(), y.data(), &value), x};
  if (ended.result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  for (std::size_t k = 0; k < y.size(); ++k) {
    const std::int32_t j = program.moving()[k];
    ended.x[static_cast<std::size_t>(j)] = std::clamp(y[k], p.x_lower[j], p.x_upper[j]);
  }
  return ended;
}

}  // namespace switchyard::nlopt
