#include "switchyard/solve/multi_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "switchyard/error.hpp"
#include "switchyard/solve/solve_in_parallel.hpp"

namespace switchyard {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

struct Box {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

Box BoxOf(const MathematicalProgram& program) {
  Box box{Eigen::VectorXd::Constant(program.num_vars(), -kInf),
          Eigen::VectorXd::Constant(program.num_vars(), kInf)};
  for (const auto& binding : program.bounding_box_constraints()) {
    const auto index = program.FindDecisionVariableIndices(binding.variables());
    for (std::size_t k = 0; k < index.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      double& lower = box.lower[index[k]];
      double& upper = box.upper[index[k]];
      lower = std::max(lower, binding.evaluator()->lower_bound()[row]);
      upper = std::min(upper, binding.evaluator()->upper_bound()[row]);
    }
  }
  return box;
}

// The distributions of the standard library differ between its implementations; these do not.
class Sampler {
 public:
  explicit Sampler(std::uint64_t seed) : bits_(seed) {}
  double Uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return radius * std::cos(2 * std::numbers::pi * Uniform());
  }

 private:
  std::mt19937_64 bits_;
};

Eigen::VectorXd Sample(const Box& box, const Eigen::VectorXd& guess, double spread,
                       Sampler& sampler) {
  Eigen::VectorXd x(guess.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double l = box.lower[j];
    const double u = box.upper[j];
    if (std::isfinite(l) && std::isfinite(u)) {
      x[j] = l + (u - l) * sampler.Uniform();
      continue;
    }
    const double centre = !std::isnan(guess[j]) ? guess[j]
                          : std::isfinite(l)    ? l
                          : std::isfinite(u)    ? u
                                                : 0;
    const double scale = spread * std::max(1.0, std::abs(centre));
    x[j] = std::min(std::max(centre + scale * sampler.Normal(), l), u);
  }
  return x;
}

int BestOf(const MathematicalProgram& program,
           const std::vector<MathematicalProgramResult>& results) {
  const double sign = program.objective_sense() == ObjectiveSense::kMaximize ? -1 : 1;
  const auto rank = [](const MathematicalProgramResult& r) {
    return r.is_success() ? 0 : r.primal == PointKind::kFeasible ? 1 : 2;
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < results.size(); ++k) {
    const int mine = rank(results[k]);
    const int others = rank(results[best]);
    const bool better = mine < 2 && sign * results[k].objective < sign * results[best].objective;
    if (mine < others || (mine == others && better)) best = k;
  }
  return static_cast<int>(best);
}

}  // namespace

MultiStartResult SolveFromManyStarts(const MathematicalProgram& program,
                                     const MultiStartOptions& options) {
  Require(options.num_starts >= 1, "SolveFromManyStarts: num_starts needs to be 1 or more, got ",
          options.num_starts);
  MultiStartResult answer;
  const Box box = BoxOf(program);
  const Eigen::VectorXd guess = program.initial_guess();
  Sampler sampler(options.seed);
  for (int k = 0; k < options.num_starts; ++k) {
    const bool own = k == 0 && !guess.array().isNaN().all() && !options.sample;
    answer.starts.push_back(own              ? guess
                            : options.sample ? options.sample(k)
                                             : Sample(box, guess, options.spread, sampler));
    Require(answer.starts.back().size() == program.num_vars(), "SolveFromManyStarts: start ", k,
            " needs ", program.num_vars(), " entries, got ", answer.starts.back().size());
  }
  std::vector<const MathematicalProgram*> programs(answer.starts.size(), &program);
  std::vector<const Eigen::VectorXd*> guesses;
  for (const Eigen::VectorXd& start : answer.starts) guesses.push_back(&start);
  answer.results = SolveInParallel(programs, &guesses, &options.solver_options, options.solver,
                                   options.parallelism);
  answer.best_start = BestOf(program, answer.results);
  answer.best = answer.results[static_cast<std::size_t>(answer.best_start)];
  return answer;
}

}  // namespace switchyard
