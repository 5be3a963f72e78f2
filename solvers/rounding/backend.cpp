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
                             std::int64_t instances, std::uint64_t updates, std::uint64_t traits) {
  const sy_solvers& solvers = Offered(host);
  sy_wish wish{};
  wish.size = sizeof wish;
  wish.names = names;
  wish.problem = &problem;
  wish.updates = updates;
  wish.instances = instances;
  sy_error error{};
  for (const std::uint64_t wanted :
       {SY_GIVES_DUALS | traits, std::uint64_t{SY_GIVES_DUALS}, std::uint64_t{0}}) {
    wish.traits = wanted;
    if (const sy_solver* found = solvers.find(solvers.context, &wish, &error)) return *found;
  }
  throw Failure(SY_E_UNSUPPORTED, std::string("no backend underneath: ") + error.text);
}

Loaded::Loaded(const sy_solver& solver, const sy_host& host, const sy_problem& problem,
               std::uint64_t updates)
    : solver_(solver), instance_(nullptr, solver.destroy), problem_(problem) {
  const auto bounds = [&](const double* from, double none) {
    std::vector<double> all(static_cast<std::size_t>(problem.num_vars), none);
    if (from != nullptr) all.assign(from, from + problem.num_vars);
    return all;
  };
  lower_ = bounds(problem.x_lower, -std::numeric_limits<double>::infinity());
  upper_ = bounds(problem.x_upper, std::numeric_limits<double>::infinity());
  sy_error error{};
  sy_instance* created = nullptr;
  Need(solver_.create(&solver_, &host, &created, &error), solver_, "create", error);
  instance_.reset(created);
  Load(problem_, updates);
}

void Loaded::Load(const sy_problem& problem, std::uint64_t updates) {
  sy_error error{};
  Need(solver_.load(instance_.get(), &problem, updates, &error), solver_, "load", error);
}

void Loaded::SetBounds(const std::vector<double>& lower, const std::vector<double>& upper) {
  std::vector<std::int32_t> changed;
  std::vector<double> below, above;
  for (std::size_t j = 0; j < lower.size(); ++j) {
    if (lower[j] == lower_[j] && upper[j] == upper_[j]) continue;
    changed.push_back(static_cast<std::int32_t>(j));
    below.push_back(lower[j]);
    above.push_back(upper[j]);
  }
  lower_ = lower;
  upper_ = upper;
  if (changed.empty()) return;
  if (solver_.update == nullptr) {
    loaded_lower_ = lower;
    loaded_upper_ = upper;
    problem_.x_lower = loaded_lower_.data();
    problem_.x_upper = loaded_upper_.data();
    return Load(problem_, 0);
  }
  sy_update update{};
  update.size = sizeof update;
  update.num_x = static_cast<std::int32_t>(changed.size());
  update.x = changed.data();
  update.x_lower = below.data();
  update.x_upper = above.data();
  Update(update);
}

void Loaded::Update(const sy_update& update) {
  if (solver_.update == nullptr) {
    throw Failure(SY_E_UNSUPPORTED, std::string(solver_.id) + " takes no updates");
  }
  sy_error error{};
  Need(solver_.update(instance_.get(), &update, &error), solver_, "update", error);
}

void Loaded::AppendRows(const Csc& At, const std::vector<double>& lower) {
  const std::vector<double> upper(lower.size(), std::numeric_limits<double>::infinity());
  const sy_csc by_rows = At.View();
  sy_more more{};
  more.size = sizeof more;
  more.num_rows = At.cols;
  more.At = &by_rows;
  more.row_lower = lower.data();
  more.row_upper = upper.data();
  sy_update update{};
  update.size = sizeof update;
  update.more = &more;
  Update(update);
  problem_.num_rows += At.cols;
}

void Loaded::RemoveRows(const std::vector<std::int32_t>& rows) {
  sy_update update{};
  update.size = sizeof update;
  update.num_gone_rows = static_cast<std::int32_t>(rows.size());
  update.gone_row = rows.data();
  Update(update);
  problem_.num_rows -= update.num_gone_rows;
}

void Loaded::StartFrom(const Answer& answer) {
  if (solver_.warm_start == nullptr) return;
  const auto extended = [](std::vector<double> v, std::int32_t count) {
    v.resize(static_cast<std::size_t>(count), 0.0);
    return v;
  };
  const std::vector<double> x = extended(answer.x, problem_.num_vars);
  const std::vector<double> x_dual = extended(answer.x_dual, problem_.num_vars);
  const std::vector<double> row_dual = extended(answer.row_dual, problem_.num_rows);
  const std::vector<double> cone_dual = extended(answer.cone_dual, problem_.num_cone_rows);
  sy_start start{};
  start.size = sizeof start;
  start.x = x.data();
  start.x_dual = x_dual.data();
  start.row_dual = row_dual.data();
  start.cone_dual = cone_dual.data();
  sy_error error{};
  solver_.warm_start(instance_.get(), &start, &error);
}

Answer Loaded::Solve(const sy_control& control) {
  Answer answer;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  answer.x.assign(static_cast<std::size_t>(problem_.num_vars), kNaN);
  answer.x_dual.assign(static_cast<std::size_t>(problem_.num_vars), 0.0);
  answer.row_dual.assign(static_cast<std::size_t>(problem_.num_rows), 0.0);
  answer.cone_dual.assign(static_cast<std::size_t>(problem_.num_cone_rows), 0.0);
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
  sy_error error{};
  Need(solver_.solve(instance_.get(), &control, &result, &error), solver_, "solve", error);
  answer.termination = result.termination;
  answer.primal = result.primal;
  answer.dual = result.dual;
  answer.iterations = result.iterations;
  text.back() = '\0';
  answer.text = text.data();
  return answer;
}

Answer SolveBy(const sy_solver& solver, const sy_host& host, const sy_problem& problem,
               const sy_control& control, const Answer* from) {
  Loaded loaded(solver, host, problem, 0);
  if (from != nullptr) loaded.StartFrom(*from);
  return loaded.Solve(control);
}

}  // namespace switchyard::rounding
