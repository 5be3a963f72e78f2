// program.hpp - a program as NLopt asks for it: variables that are free to move, one objective, and
// constraints that are <= 0 or = 0.
#pragma once

#include <nlopt.h>

#include <cstdint>
#include <vector>

#include "algorithms.hpp"
#include "functions.hpp"
#include "linear/watch.hpp"
#include "patience.hpp"

namespace switchyard::nlopt {

/// What a run minimizes.
enum class Aim {
  kObjective,
  kViolation  // 1/2 the sum of the squared violations, without constraints
};

/// How a run takes an equation.
enum class Equations {
  kAsTheyAre,
  kAsPairs  // h <= 0 and -h <= 0: more of them than variables, or dependent ones, do no harm
};

/// Why a run was stopped from here.
enum class Halt {
  kNone,
  kWatch,    // its reason says why
  kAborted,  // a function ended the solve
  kFalls,    // the objective, without end
  kStands,   // one point again and again
  kIdles     // no gain for long
};

/// scale sign (value - bound) of one constraint, which NLopt wants <= 0 or = 0.
struct Condition {
  std::int32_t constraint;
  double sign;
  double bound;
  double scale;
};

/// A point and what it is worth. All variables; empty where there is none.
struct Visited {
  std::vector<double> x;
  double objective = 0;
  double violation = 0;
};

class Program {
 public:
  /// Borrows both. A violation up to `feasible`, relative as Functions has it, is none.
  Program(Functions& functions, linear::Watch& watch, double feasible);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] Functions& functions() { return functions_; }
  /// The variables that are not fixed: NLopt sees these alone.
  [[nodiscard]] const std::vector<std::int32_t>& moving() const { return moving_; }
  [[nodiscard]] std::vector<double> Moving(const std::vector<double>& x) const;

  /// Brings objective and constraints to gradients of size 1 or so, at the point where the
  /// functions are, where they have gradients.
  void Scale();
  [[nodiscard]] Demand Demands() const;
  /// The constraints that NLopt sees, and the equations among them.
  [[nodiscard]] std::size_t num_spoken() const { return spoken_.size(); }
  [[nodiscard]] std::size_t num_equations() const;
  /// A constraint of no moving variable that is outside its sides where the functions are; -1:
  /// there is none.
  [[nodiscard]] std::int32_t BrokenConstant() const;

  /// The largest entry of the gradient of the Euclidean norm of all scaled violations, less what
  /// the bounds hold back, where the functions are.
  [[nodiscard]] double SlopeOfViolation() const;

  /// What the next run is to be: `bits` is what its algorithms ask for, and it is ended by
  /// nlopt_force_stop.
  void Begin(nlopt_opt run, Aim aim, Equations equations, unsigned bits);
  /// Gives it its constraints. NLopt calls feasible what violates them by `tolerance`, relative to
  /// 1 + their scaled side.
  void AddConditions(double tolerance);

  [[nodiscard]] Halt halt() const { return halt_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
  /// How many points of the run were outside the domain of the functions.
  [[nodiscard]] std::int64_t undefined() const { return undefined_; }
  /// Of all runs: the feasible point of the least objective, else the one of the least violation.
  [[nodiscard]] const Visited& best() const { return best_; }
  /// The last point of the run where everything was defined; empty where none was.
  [[nodiscard]] const std::vector<double>& last() const { return last_; }

 private:
  struct Group {
    Program* program;
    std::vector<Condition> conditions;
  };

  static double ObjectiveOf(unsigned n, const double* y, double* gradient, void* data) noexcept;
  static void ConditionsOf(unsigned m, double* values, unsigned n, const double* y,
                           double* gradients, void* data) noexcept;
  double Evaluate(const double* y, double* gradient);
  double Undefined(double* gradient);
  bool Take(const double* y);  // is it where the run was?
  double See();                // how far the point is outside
  void Stop(Halt why);
  double Violations(double* gradient) const;
  void AddNormal(std::int32_t constraint, double factor, double* gradient) const;

  Functions& functions_;
  linear::Watch& watch_;
  const double feasible_;
  std::vector<std::int32_t> moving_;
  std::vector<std::int32_t> place_;   // of each variable among the moving; -1: fixed
  std::vector<std::int32_t> spoken_;  // the constraints with a moving variable and a finite side
  std::vector<double> scale_;         // of each constraint
  double objective_scale_ = 1;

  nlopt_opt run_ = nullptr;
  Aim aim_ = Aim::kObjective;
  bool by_gradients_ = false;
  Group equations_{this, {}}, inequalities_{this, {}};
  Halt halt_ = Halt::kNone;
  Patience patience_;
  std::int64_t evaluations_ = 0, undefined_ = 0;
  double worst_ = 0;       // objective seen in the run
  std::vector<double> x_;  // all variables, where the run is
  std::vector<double> last_;
  std::vector<double> last_gradient_;
  Visited best_;
};

}  // namespace switchyard::nlopt
