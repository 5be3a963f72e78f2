// What Ipopt takes through Switchyard, with derivatives from the operations of a function, beside
// Ipopt called directly, with derivatives written by hand.
//
//   against_ipopt [TURNS]
//
// rosenbrock: the chain sum_i 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2. chain: links hang between two
// nails, the least sum of heights. hs 71: of Hock and Schittkowski, with 4 variables. Both ways
// take turns in one process, with the options of the plugin (plugins/ipopt/options.cpp). `build` is
// the recording of functions and the adding of terms, once for a program; `solve` all that a solve
// takes, from the program to the checked result; the ratios are those of `solve`, and of `build`
// and `solve` together, to Ipopt's own. Milliseconds of processor time; medians of the turns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "IpIpoptApplication.hpp"
#include "IpSolveStatistics.hpp"
#include "IpTNLP.hpp"
#include "switchyard/error.hpp"
#include "switchyard/functions/make_function.hpp"
#include "switchyard/solve/solve.hpp"

namespace {

using namespace switchyard;
using Ipopt::Index;
using Ipopt::Number;
using Vector = std::vector<Number>;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kWidening = 1e-9;  // of bounds, by Ipopt

std::size_t At(Index i) { return static_cast<std::size_t>(i); }

// ---- Ipopt called directly -----------------------------------------------------------------

struct Pattern {
  std::vector<Index> row, col;

  void Add(Index i, Index j) {
    row.push_back(i);
    col.push_back(j);
  }
};

/// f and g_lower <= c(x) <= g_upper with derivatives, each written into the array that is given.
struct Direct {
  Vector start, x_lower, x_upper, g_lower, g_upper;
  Pattern jacobian, hessian;  // the Hessian's lower triangle
  std::function<Number(const Number* x)> f;
  std::function<void(const Number* x, Number* to)> gradient;
  std::function<void(const Number* x, Number* to)> c;
  std::function<void(const Number* x, Number* to)> slopes;
  std::function<void(const Number* x, Number factor, const Number* y, Number* to)> curvature;
};

class AsTnlp final : public Ipopt::TNLP {
 public:
  explicit AsTnlp(const Direct& p) : p_(p) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(p_.start.size());
    m = static_cast<Index>(p_.g_lower.size());
    jacobian = static_cast<Index>(p_.jacobian.row.size());
    hessian = static_cast<Index>(p_.hessian.row.size());
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    Copy(p_.x_lower, x_l);
    Copy(p_.x_upper, x_u);
    Copy(p_.g_lower, g_l);
    Copy(p_.g_upper, g_u);
    return true;
  }
  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    Copy(p_.start, x);
    return true;
  }
  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = p_.f(x);
    return std::isfinite(value);
  }
  bool eval_grad_f(Index, const Number* x, bool, Number* to) override {
    p_.gradient(x, to);
    return true;
  }
  bool eval_g(Index, const Number* x, bool, Index m, Number* to) override {
    if (m > 0) p_.c(x, to);
    return true;
  }
  bool eval_jac_g(Index, const Number* x, bool, Index m, Index, Index* row, Index* col,
                  Number* to) override {
    if (to == nullptr) return Give(p_.jacobian, row, col);
    if (m > 0) p_.slopes(x, to);
    return true;
  }
  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* y, bool, Index,
              Index* row, Index* col, Number* to) override {
    if (to == nullptr) return Give(p_.hessian, row, col);
    p_.curvature(x, factor, y, to);
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*,
                         Index, const Number*, const Number*, Number value, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    objective = value;
  }

  Number objective = 0;

 private:
  static void Copy(const Vector& from, Number* to) { std::copy(from.begin(), from.end(), to); }
  static bool Give(const Pattern& pattern, Index* row, Index* col) {
    std::copy(pattern.row.begin(), pattern.row.end(), row);
    std::copy(pattern.col.begin(), pattern.col.end(), col);
    return true;
  }

  const Direct& p_;
};

struct Outcome {
  double milliseconds = 0;
  double objective = 0;
  std::int64_t iterations = 0;
};

double MillisecondsOf(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

Outcome SolveDirectly(const Direct& p) {
  Outcome outcome;
  outcome.milliseconds = MillisecondsOf([&] {
    constexpr bool kConsole = false;
    Ipopt::SmartPtr<Ipopt::IpoptApplication> solver = new Ipopt::IpoptApplication(kConsole);
    for (const auto& [name, value] : {std::pair{"tol", 1e-9},
                                      {"constr_viol_tol", 1e-7},
                                      {"dual_inf_tol", 1e-6},
                                      {"compl_inf_tol", 1e-6},
                                      {"bound_relax_factor", kWidening},
                                      {"diverging_iterates_tol", 1e15}}) {
      solver->Options()->SetNumericValue(name, value);
    }
    for (const auto& [name, value] : {std::pair{"mu_strategy", "adaptive"},
                                      {"honor_original_bounds", "no"},
                                      {"jac_c_constant", p.g_lower.empty() ? "yes" : "no"},
                                      {"jac_d_constant", p.g_lower.empty() ? "yes" : "no"},
                                      {"sb", "yes"}}) {
      solver->Options()->SetStringValue(name, value);
    }
    solver->Options()->SetIntegerValue("acceptable_iter", 0);
    solver->Options()->SetIntegerValue("print_level", 0);
    solver->Initialize("");
    Ipopt::SmartPtr<AsTnlp> program = new AsTnlp(p);
    const auto status = solver->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(program)));
    Require(status == Ipopt::Solve_Succeeded, "Ipopt ended with its status ", int(status));
    outcome.objective = program->objective;
    outcome.iterations = solver->Statistics()->IterationCount();
  });
  return outcome;
}

Outcome SolveThroughSwitchyard(const MathematicalProgram& program) {
  Outcome outcome;
  MathematicalProgramResult result;
  outcome.milliseconds = MillisecondsOf([&] { result = SolverInterface("ipopt").Solve(program); });
  Require(result.is_success(), "Switchyard ended with ", to_string(result.termination), ": ",
          result.message);
  outcome.objective = result.objective;
  outcome.iterations = result.iterations;
  return outcome;
}

// ---- The problems, both ways ---------------------------------------------------------------

using Made = std::unique_ptr<MathematicalProgram>;

Eigen::VectorXd OneNumber(double value) { return Eigen::VectorXd::Constant(1, value); }

void SetStart(MathematicalProgram& program, const Vector& start) {
  program.SetInitialGuessForAllVariables(
      Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size())));
}

Vector RosenbrockStart(Index n) { return Vector(At(n), 0.5); }

Made Rosenbrock(Index n) {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(n);
  const auto link = std::make_shared<FunctionCost>(MakeFunction(2, [](const auto& v) {
    const auto t = v[1] - v[0] * v[0];
    const auto u = 1 - v[0];
    return 100 * t * t + u * u;
  }));
  for (Index i = 0; i + 1 < n; ++i) program->AddCost(link, x.segment(i, 2));
  SetStart(*program, RosenbrockStart(n));
  return program;
}

Direct RosenbrockDirectly(Index n) {
  Direct p;
  p.start = RosenbrockStart(n);
  p.x_lower.assign(At(n), -kInf);
  p.x_upper.assign(At(n), kInf);
  for (Index i = 0; i < n; ++i) p.hessian.Add(i, i);
  for (Index i = 0; i + 1 < n; ++i) p.hessian.Add(i + 1, i);
  p.f = [n](const Number* x) {
    Number sum = 0;
    for (Index i = 0; i + 1 < n; ++i) {
      const Number t = x[i + 1] - x[i] * x[i];
      sum += 100 * t * t + (1 - x[i]) * (1 - x[i]);
    }
    return sum;
  };
  p.gradient = [n](const Number* x, Number* to) {
    std::fill_n(to, n, 0.0);
    for (Index i = 0; i + 1 < n; ++i) {
      const Number t = x[i + 1] - x[i] * x[i];
      to[i] -= 400 * x[i] * t + 2 * (1 - x[i]);
      to[i + 1] += 200 * t;
    }
  };
  p.curvature = [n](const Number* x, Number factor, const Number*, Number* to) {
    std::fill_n(to, n, 0.0);
    for (Index i = 0; i + 1 < n; ++i) {
      to[i] += factor * (1200 * x[i] * x[i] - 400 * x[i + 1] + 2);
      to[i + 1] += 200 * factor;
      to[n + i] = -400 * factor * x[i];
    }
  };
  return p;
}

/// x_0, ..., x_m, y_0, ..., y_m along the straight line between the nails (0, 0) and (1, 0).
Vector ChainStart(Index m) {
  Vector start(At(2 * (m + 1)), 0);
  for (Index k = 0; k <= m; ++k) start[At(k)] = double(k) / m;
  return start;
}

/// Twice as long, in all, as the nails are apart: rows m^2 |link|^2 <= 4, of a size that does not
/// depend on m.
constexpr double kSquaredLength = 4;
double Square(Index m) { return double(m) * m; }

Made Chain(Index m) {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(m + 1, "x");
  const auto y = program->NewContinuousVariables(m + 1, "y");
  program->AddLinearCost(Eigen::VectorXd::Constant(m + 1, 1.0 / m), y);
  const auto squared = MakeFunction(4, [m](const auto& v) {
    const auto dx = v[1] - v[0];
    const auto dy = v[3] - v[2];
    return Square(m) * (dx * dx + dy * dy);
  });
  const auto link =
      std::make_shared<FunctionConstraint>(squared, OneNumber(-kInf), OneNumber(kSquaredLength));
  for (Index k = 0; k < m; ++k) {
    program->AddConstraint(link, VariableList{x.segment(k, 2), y.segment(k, 2)});
  }
  const Eigen::Vector4d nails(0, 0, 1, 0);
  program->AddBoundingBoxConstraint(nails, nails, VariableList{x[0], y[0], x[m], y[m]});
  SetStart(*program, ChainStart(m));
  return program;
}

Direct ChainDirectly(Index m) {
  Direct p;
  const Index n = m + 1;  // x_k is variable k, y_k variable n + k
  p.start = ChainStart(m);
  p.x_lower.assign(At(2 * n), -kInf);
  p.x_upper.assign(At(2 * n), kInf);
  for (const Index nail : {0, m, n, n + m}) {
    p.x_lower[At(nail)] = p.x_upper[At(nail)] = p.start[At(nail)];
  }
  p.g_lower.assign(At(m), -kInf);
  p.g_upper.assign(At(m), kSquaredLength);
  for (Index k = 0; k < m; ++k) {
    for (const Index at : {k, k + 1, n + k, n + k + 1}) p.jacobian.Add(k, at);
  }
  for (Index j = 0; j < 2 * n; ++j) p.hessian.Add(j, j);
  for (Index k = 0; k < m; ++k) {
    p.hessian.Add(k + 1, k);
    p.hessian.Add(n + k + 1, n + k);
  }
  p.f = [n, m](const Number* x) {
    Number sum = 0;
    for (Index k = 0; k < n; ++k) sum += x[n + k] / m;
    return sum;
  };
  p.gradient = [n, m](const Number*, Number* to) {
    std::fill_n(to, n, 0.0);
    std::fill_n(to + n, n, 1.0 / m);
  };
  p.c = [n, m](const Number* x, Number* to) {
    for (Index k = 0; k < m; ++k) {
      const Number dx = x[k + 1] - x[k];
      const Number dy = x[n + k + 1] - x[n + k];
      to[k] = Square(m) * (dx * dx + dy * dy);
    }
  };
  p.slopes = [n, m](const Number* x, Number* to) {
    for (Index k = 0; k < m; ++k) {
      const Number dx = 2 * Square(m) * (x[k + 1] - x[k]);
      const Number dy = 2 * Square(m) * (x[n + k + 1] - x[n + k]);
      for (const Number slope : {-dx, dx, -dy, dy}) *to++ = slope;
    }
  };
  p.curvature = [n, m](const Number*, Number, const Number* y, Number* to) {
    std::fill_n(to, 2 * n, 0.0);
    for (Index k = 0; k < m; ++k) {
      const Number curvature = 2 * Square(m) * y[k];
      for (const Index at : {k, k + 1, n + k, n + k + 1}) to[at] += curvature;
      to[2 * n + 2 * k] = to[2 * n + 2 * k + 1] = -curvature;
    }
  };
  return p;
}

Made Hs71(Index) {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddCost([](const auto& v) { return v[0] * v[3] * (v[0] + v[1] + v[2]) + v[2]; }, x);
  program->AddConstraint([](const auto& v) { return v[0] * v[1] * v[2] * v[3]; }, OneNumber(25),
                         OneNumber(kInf), x);
  program->AddQuadraticConstraint(2 * Eigen::Matrix4d::Identity(), Eigen::Vector4d::Zero(), 40, 40,
                                  x);
  program->AddBoundingBoxConstraint(1, 5, x);
  SetStart(*program, {1, 5, 5, 1});
  return program;
}

// The bounds are as much narrower as Ipopt widens them, as the plugin gives them.
Direct Hs71Directly(Index) {
  Direct p;
  p.start = {1, 5, 5, 1};
  p.x_lower.assign(4, 1 + kWidening);
  p.x_upper.assign(4, 5 - 5 * kWidening);
  p.g_lower = {40, 25};
  p.g_upper = {40, kInf};
  for (const Index i : {0, 1}) {
    for (Index j = 0; j < 4; ++j) p.jacobian.Add(i, j);
  }
  for (Index i = 0; i < 4; ++i) {
    for (Index j = 0; j <= i; ++j) p.hessian.Add(i, j);
  }
  p.f = [](const Number* x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; };
  p.gradient = [](const Number* x, Number* to) {
    to[0] = x[3] * (2 * x[0] + x[1] + x[2]);
    to[1] = x[0] * x[3];
    to[2] = x[0] * x[3] + 1;
    to[3] = x[0] * (x[0] + x[1] + x[2]);
  };
  p.c = [](const Number* x, Number* to) {
    to[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    to[1] = x[0] * x[1] * x[2] * x[3];
  };
  p.slopes = [](const Number* x, Number* to) {
    for (Index j = 0; j < 4; ++j) to[j] = 2 * x[j];
    to[4] = x[1] * x[2] * x[3];
    to[5] = x[0] * x[2] * x[3];
    to[6] = x[0] * x[1] * x[3];
    to[7] = x[0] * x[1] * x[2];
  };
  p.curvature = [](const Number* x, Number w, const Number* y, Number* to) {
    to[0] = w * 2 * x[3] + 2 * y[0];
    to[1] = w * x[3] + y[1] * x[2] * x[3];
    to[2] = 2 * y[0];
    to[3] = w * x[3] + y[1] * x[1] * x[3];
    to[4] = y[1] * x[0] * x[3];
    to[5] = 2 * y[0];
    to[6] = w * (2 * x[0] + x[1] + x[2]) + y[1] * x[1] * x[2];
    to[7] = w * x[0] + y[1] * x[0] * x[2];
    to[8] = w * x[0] + y[1] * x[0] * x[1];
    to[9] = 2 * y[0];
  };
  return p;
}

// ---- Side by side --------------------------------------------------------------------------

double Median(Vector values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void Compare(const std::string& name, Index size, Made (*make)(Index), Direct (*directly)(Index),
             int turns) {
  const Direct direct = directly(size);
  Vector direct_ms, build_ms, solve_ms, solve_ratio, program_ratio;
  Outcome theirs, ours;
  for (int k = -1; k < turns; ++k) {  // the first turn warms up
    theirs = SolveDirectly(direct);
    Made program;
    const double build = MillisecondsOf([&] { program = make(size); });
    ours = SolveThroughSwitchyard(*program);
    if (k < 0) continue;
    direct_ms.push_back(theirs.milliseconds);
    build_ms.push_back(build);
    solve_ms.push_back(ours.milliseconds);
    solve_ratio.push_back(ours.milliseconds / theirs.milliseconds);
    program_ratio.push_back((build + ours.milliseconds) / theirs.milliseconds);
  }
  const double apart = std::abs(ours.objective - theirs.objective);
  Require(apart <= 1e-6 * std::max(1.0, std::abs(theirs.objective)), name, ": directly ",
          theirs.objective, ", through Switchyard ", ours.objective);
  fmt::print("{:<16}{:>7}{:>7}{:>7}{:>6}{:>11.2f}{:>9.2f}{:>10.2f}{:>8.2f}{:>9.2f}\n",
             fmt::format("{} {}", name, size), direct.start.size(), direct.g_lower.size(),
             theirs.iterations, ours.iterations, Median(direct_ms), Median(build_ms),
             Median(solve_ms), Median(solve_ratio), Median(program_ratio));
}

}  // namespace

int main(int argc, char** argv) {
  const int turns = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  fmt::print("{:<16}{:>7}{:>7}{:>13}{:>11}{:>9}{:>10}{:>8}{:>9}\n", "", "", "", "iterations",
             "directly", "build", "solve", "solve", "program");
  fmt::print("{:<16}{:>7}{:>7}{:>7}{:>6}{:>11}{:>9}{:>10}{:>8}{:>9}\n", "", "vars", "rows",
             "theirs", "ours", "ms", "ms", "ms", "ratio", "ratio");
  Compare("rosenbrock", 10000, Rosenbrock, RosenbrockDirectly, turns);
  Compare("chain", 1000, Chain, ChainDirectly, turns);
  Compare("hs", 71, Hs71, Hs71Directly, turns);
}
