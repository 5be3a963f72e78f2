#include "solvers/rounding/backend.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "switchyard/plugin.hpp"

namespace switchyard::rounding {
namespace {

using plugin::Failure;

void Need(sy_status status, const sy_solver& solver, const char* call, const sy_error& error) {
  if (status >= 0) return;
  throw Failure(status, std::string(solver.id) + ": " + call + ": " + error.text);
}

class Instance {
 public:
  Instance(const sy_solver& solver, const sy_host& host) : solver_(solver) {
    Need(solver_.create(&solver_, &host, &instance_, &error_), solver_, "create", error_);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() { solver_.destroy(instance_); }

  void Load(const sy_problem& problem) {
    Need(solver_.load(instance_, &problem, 0, &error_), solver_, "load", error_);
  }
  void Solve(const sy_control& control, sy_result& result) {
    Need(solver_.solve(instance_, &control, &result, &error_), solver_, "solve", error_);
  }

 private:
  const sy_solver& solver_;
  sy_instance* instance_ = nullptr;
  sy_error error_{};
};

const sy_solvers& Offered(const sy_host& host) {
  const void* table =
      host.extension == nullptr ? nullptr : host.extension(host.context, "sy.solvers/1");
  if (table == nullptr) {
    throw Failure(SY_E_UNSUPPORTED,
                  "a strategy needs a host that offers other solvers (sy.solvers/1); this one does "
                  "not");
  }
  return *static_cast<const sy_solvers*>(table);
}

}  // namespace

const sy_solver& FindBackend(const sy_host& host, const sy_problem& problem, const char* names,
                             std::int64_t instances) {
  const sy_solvers& solvers = Offered(host);
  sy_wish wish{};
  wish.size = sizeof wish;
  wish.names = names;
  wish.problem = &problem;
  wish.instances = instances;
  sy_error error{};
  for (const std::uint64_t traits : {std::uint64_t{SY_GIVES_DUALS}, std::uint64_t{0}}) {
    wish.traits = traits;
    if (const sy_solver* found = solvers.find(solvers.context, &wish, &error)) return *found;
  }
  throw Failure(SY_E_UNSUPPORTED, std::string("no backend underneath: ") + error.text);
}

Answer SolveBy(const sy_solver& solver, const sy_host& host, const sy_problem& problem,
               const sy_control& control) {
  Instance instance(solver, host);
  instance.Load(problem);
  Answer answer;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  answer.x.assign(static_cast<std::size_t>(problem.num_vars), kNaN);
  answer.x_dual.assign(static_cast<std::size_t>(problem.num_vars), 0.0);
  answer.row_dual.assign(static_cast<std::size_t>(problem.num_rows), 0.0);
  answer.cone_dual.assign(static_cast<std::size_t>(problem.num_cone_rows), 0.0);
  std::array<char, 512> text{};
  sy_result result{};
  result.size = sizeof result;
  result.bound = -std::numeric_limits<double>::infinity();
  result.objective = result.relaxed = kNaN;
  result.x = answer.x.data();
  result.x_dual = answer.x_dual.data();
  result.row_dual = answer.row_dual.data();
  result.cone_dual = answer.cone_dual.data();
  result.text = text.data();
  result.text_size = text.size();
  instance.Solve(control, result);
  answer.termination = result.termination;
  answer.primal = result.primal;
  answer.dual = result.dual;
  answer.iterations = result.iterations;
  text.back() = '\0';
  answer.text = text.data();
  return answer;
}

}  // namespace switchyard::rounding
