#include "switchyard/solve/solve_in_parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>

#include "switchyard/error.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

template <class T>
void CheckLength(const char* what, const std::vector<T>* list, std::size_t programs) {
  if (list == nullptr) return;
  Require(list->empty() || list->size() == programs, "SolveInParallel: ", what, " needs an entry ",
          "for each of ", programs, " programs, got ", list->size());
}

template <class T>
const T* EntryOf(const std::vector<T>* list, std::size_t k) {
  return list == nullptr || list->empty() ? nullptr : &(*list)[k];
}

/// work(k) for each k of `some`, by `threads` threads.
void Distribute(const std::vector<std::size_t>& some, int threads, bool dynamic,
                const std::function<void(std::size_t)>& work) {
  const std::size_t count = std::min(static_cast<std::size_t>(threads), some.size());
  if (count <= 1) {
    for (const std::size_t k : some) work(k);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> workers;
  for (std::size_t t = 0; t < count; ++t) {
    workers.emplace_back([&, t] {
      if (dynamic) {
        for (std::size_t i; (i = next.fetch_add(1)) < some.size();) work(some[i]);
      } else {
        for (std::size_t i = t; i < some.size(); i += count) work(some[i]);
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
}

}  // namespace

std::vector<MathematicalProgramResult> SolveInParallel(
    const std::vector<const MathematicalProgram*>& programs,
    const std::vector<const Eigen::VectorXd*>* initial_guesses,
    const std::vector<const SolverOptions*>* solver_options,
    const std::vector<std::optional<SolverId>>* solver_ids, Parallelism parallelism,
    bool dynamic_schedule) {
  CheckLength("initial_guesses", initial_guesses, programs.size());
  CheckLength("solver_options", solver_options, programs.size());
  CheckLength("solver_ids", solver_ids, programs.size());
  std::vector<std::size_t> at_once;
  std::vector<std::size_t> alone;
  for (std::size_t k = 0; k < programs.size(); ++k) {
    Require(programs[k] != nullptr, "SolveInParallel: program ", k, " is a null pointer");
    (programs[k]->IsThreadSafe() ? at_once : alone).push_back(k);
  }
  std::vector<MathematicalProgramResult> results(programs.size());
  std::vector<std::exception_ptr> thrown(programs.size());
  const auto solve = [&](std::size_t k) {
    try {
      const auto* guess = EntryOf(initial_guesses, k);
      const auto* own = EntryOf(solver_options, k);
      const auto* id = EntryOf(solver_ids, k);
      SolverOptions options = own != nullptr && *own != nullptr ? **own : SolverOptions();
      options.Merge(programs[k]->solver_options());
      if (options.threads == 0) options.threads = 1;
      const std::string names = id != nullptr && id->has_value() ? (*id)->name() : "";
      results[k] = SolverInterface(names).Solve(
          *programs[k],
          guess != nullptr && *guess != nullptr ? std::optional(**guess) : std::nullopt, options);
    } catch (...) {
      thrown[k] = std::current_exception();
    }
  };
  Distribute(at_once, parallelism.num_threads(), dynamic_schedule, solve);
  for (const std::size_t k : alone) solve(k);
  for (const std::exception_ptr& one : thrown) {
    if (one != nullptr) std::rethrow_exception(one);
  }
  return results;
}

std::vector<MathematicalProgramResult> SolveInParallel(
    const std::vector<const MathematicalProgram*>& programs,
    const std::vector<const Eigen::VectorXd*>* initial_guesses, const SolverOptions* solver_options,
    const std::optional<SolverId>& solver_id, Parallelism parallelism, bool dynamic_schedule) {
  const std::vector<const SolverOptions*> options(programs.size(), solver_options);
  const std::vector<std::optional<SolverId>> ids(programs.size(), solver_id);
  return SolveInParallel(programs, initial_guesses, &options, &ids, parallelism, dynamic_schedule);
}

}  // namespace switchyard
