#include "core/solve/control.hpp"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace switchyard {

double SolveControl::InProblemSense(double value, double unset) const {
  if (std::isnan(value)) return unset;
  return maximize_ ? -value : value;
}

bool SolveControl::Report(const sy_progress& p) {
  const double sign = maximize_ ? -1 : 1;
  try {
    return options_.progress({p.seconds, p.iteration, p.nodes, p.open_nodes, sign * p.objective,
                              sign * p.bound, p.primal_residual, p.dual_residual,
                              p.incumbent != nullptr});
  } catch (...) {
    thrown_ = std::current_exception();
    return true;
  }
}

sy_control SolveControl::Record(double seconds, bool proceed) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  sy_control control{};
  control.size = sizeof control;
  control.flags = proceed ? std::uint32_t{SY_CONTINUE} : 0;
  control.threads = options_.threads > 0
                        ? options_.threads
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  control.verbosity = options_.verbosity;
  control.seconds = std::max(0.0, seconds);
  control.iterations = options_.iteration_limit;
  control.nodes = options_.node_limit;
  control.cutoff = InProblemSense(options_.cutoff, kInf);
  control.target = InProblemSense(options_.target, -kInf);
  control.feasibility = options_.feasibility_tolerance;
  control.optimality = options_.optimality_tolerance;
  control.integrality = options_.integrality_tolerance;
  control.absolute_gap = options_.absolute_gap;
  control.relative_gap = options_.relative_gap;
  control.seed = options_.seed;
  control.context = this;
  control.cancelled = [](void* context) noexcept -> std::int32_t {
    const auto* self = static_cast<const SolveControl*>(context);
    const std::atomic<bool>* cancelled = self->options_.cancelled;
    return (cancelled != nullptr && cancelled->load()) || self->thrown_ != nullptr ? 1 : 0;
  };
  if (!options_.progress) return control;
  control.progress = [](void* context, const sy_progress* p) noexcept -> std::int32_t {
    return static_cast<SolveControl*>(context)->Report(*p) ? 1 : 0;
  };
  return control;
}

void SolveControl::RethrowWhatWasThrown() {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace switchyard
