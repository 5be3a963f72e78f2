// Every program of the suite by every backend and algorithm that claims its class. What counts as
// solved is recomputed in the user's program.
//
// SWITCHYARD_SUITE_TABLE=1 prints a table of all answers at the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "switchyard/host/host.hpp"
#include "switchyard/solve/solve.hpp"
#include "tests/nonlinear_suite/suite.hpp"

namespace switchyard::testing {
namespace {

constexpr double kAccurate = 1e-6;
constexpr int kAnyNumber = std::numeric_limits<int>::max();

/// A backend, or one algorithm of it, and the programs that it claims.
struct Way {
  std::string name = {};
  std::string backend = "nlopt";
  std::string algorithm = {};  // "": the backend's own choice
  Conditions hardest = Conditions::kEqualities;
  bool by_gradients = false;
  bool needs_box = false;
  bool takes_many_rows = true;
  int least_vars = 1;
  int most_vars = kAnyNumber;  // more would take too long here

  [[nodiscard]] bool Claims(const KnownProgram& row) const {
    const int vars = static_cast<int>(row.start.size());
    return row.conditions <= hardest && (!needs_box || row.Is(kBox)) &&
           (takes_many_rows || !row.Is(kManyRows)) && vars >= least_vars && vars <= most_vars;
  }
};

/// An algorithm of NLopt, by its name for it.
Way Algorithm(const std::string& name, Way way) {
  way.name = way.algorithm = name;
  return way;
}

// MMA solves, at every step, a dual problem of as many variables as there are rows: with 20 of them
// NLopt itself has not ended after a minute.
const std::vector<Way>& Ways() {
  constexpr auto kBelow = Conditions::kInequalities;
  constexpr auto kBounded = Conditions::kBounds;
  constexpr int kFew = 4;
  static const std::vector<Way> ways = {
      {.name = "ipopt", .backend = "ipopt", .by_gradients = true},
      Algorithm("LD_SLSQP", {.by_gradients = true}),
      Algorithm("LD_MMA", {.hardest = kBelow, .by_gradients = true, .takes_many_rows = false}),
      Algorithm("LN_COBYLA", {.most_vars = kFew}),
      Algorithm("LN_BOBYQA", {.hardest = kBounded, .least_vars = 2, .most_vars = kFew}),
      Algorithm("GN_ISRES", {.needs_box = true, .most_vars = kFew}),
      Algorithm("GN_DIRECT_L", {.hardest = kBounded, .needs_box = true, .most_vars = kFew}),
  };
  return ways;
}

struct Case {
  const KnownProgram* row;
  const Way* way;
};

std::string NameOf(const Case& c) { return c.row->name + "_" + c.way->name; }
void PrintTo(const Case& c, std::ostream* out) { *out << NameOf(c) << ", " << c.row->source; }

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const KnownProgram& row : Suite()) {
    for (const Way& way : Ways()) {
      if (way.Claims(row)) cases.push_back({&row, &way});
    }
  }
  return cases;
}

// The backends of this build, whatever else is installed.
Host& Backends() {
  static Host host([] {
    HostOptions options;
    options.folders = {SWITCHYARD_PLUGIN_FOLDER};
    return options;
  }());
  return host;
}

double LargestViolation(const MathematicalProgram& program, const Eigen::VectorXd& x) {
  double largest = 0;
  for (const auto& binding : program.GetAllConstraints()) {
    const double v = binding.evaluator()->Violation(program.ValuesOf(binding.variables(), x));
    if (!(v <= largest)) largest = v;  // NaN too
  }
  return largest;
}

/// The largest entry of grad f - J'y, over all costs f and constraints with the duals y that the
/// result gives, relative to 1 + the largest entry of grad f.
double Stationarity(const MathematicalProgram& program, const MathematicalProgramResult& result) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(program.num_vars());
  Eigen::VectorXd balance = gradient;
  const auto add = [&](const auto& binding, const Eigen::VectorXd& weights, Eigen::VectorXd& to) {
    const Eigen::VectorXd x = program.ValuesOf(binding.variables(), result.get_x_val());
    const Eigen::VectorXd slope = binding.evaluator()->EvalJacobian(x).transpose() * weights;
    const std::vector<int> index = program.FindDecisionVariableIndices(binding.variables());
    for (std::size_t k = 0; k < index.size(); ++k) {
      to[index[k]] += slope[static_cast<Eigen::Index>(k)];
    }
  };
  for (const auto& cost : program.GetAllCosts()) add(cost, Eigen::VectorXd::Ones(1), gradient);
  for (const auto& constraint : program.GetAllConstraints()) {
    add(constraint, result.GetDualSolution(constraint), balance);
  }
  return (gradient - balance).cwiseAbs().maxCoeff() / (1 + gradient.cwiseAbs().maxCoeff());
}

/// |value - known|, relative where the known value is large.
double Error(double value, double known) {
  return std::abs(value - known) / std::max(1.0, std::abs(known));
}

bool IsKnownOptimum(const KnownProgram& row, double value) {
  const auto meets = [&](double known) { return Error(value, known) <= kAccurate; };
  return meets(row.optimum) || std::any_of(row.local_optima.begin(), row.local_optima.end(), meets);
}

SolverOptions OptionsOf(const Way& way) {
  SolverOptions options;
  options.threads = 1;
  options.time_limit = way.by_gradients ? 20 : 1;
  if (!way.algorithm.empty()) {
    options.SetOption(SolverId(way.backend), "algorithm", way.algorithm);
  }
  return options;
}

class NonlinearSuite : public ::testing::TestWithParam<Case> {
 public:
  static void TearDownTestSuite() {
    if (std::getenv("SWITCHYARD_SUITE_TABLE") == nullptr) return;
    std::printf("%-22s %-12s %-19s %17s %9s %9s %11s %8s %6s %8s\n", "program", "by", "ended",
                "objective", "error", "violation", "duals", "values", "steps", "ms");
    for (const std::string& line : Table()) std::printf("%s\n", line.c_str());
  }

 protected:
  void Solve() {
    const Case& c = GetParam();
    program_ = Make(*c.row);
    result_ = SolverInterface(c.way->backend, Backends()).Solve(*program_, {}, OptionsOf(*c.way));
    const bool has_point = result_.get_x_val().size() > 0 && result_.primal != PointKind::kRay;
    if (has_point) violation_ = LargestViolation(*program_, result_.get_x_val());
    char line[256];
    std::snprintf(
        line, sizeof line, "%-22s %-12s %-19s %17.10g %9.1e %9.1e %11s %8lld %6lld %8.1f",
        c.row->name.c_str(), c.way->name.c_str(),
        std::string(to_string(result_.termination)).c_str(), result_.objective,
        Error(result_.objective, c.row->optimum), violation_,
        std::string(to_string(result_.dual)).c_str(),
        static_cast<long long>(result_.evaluations.objective + result_.evaluations.constraints),
        static_cast<long long>(result_.iterations), 1e3 * result_.seconds.total);
    Table().emplace_back(line);
  }

  [[nodiscard]] std::string Words() const {
    std::string words = Table().back() + "\n" + result_.message;
    for (const std::string& note : result_.notes) words += "\n" + note;
    return words;
  }

  /// Of a success: a feasible point of the objective that is said, which is the optimum where the
  /// program is convex, and else satisfies the conditions of first order.
  void ExpectTrueSuccess() const {
    const KnownProgram& row = *GetParam().row;
    ASSERT_EQ(row.answer, Answer::kOptimum) << Words();
    EXPECT_LE(violation_, kAccurate) << Words();
    EXPECT_LE(Error(result_.objective, program_->EvalCosts(result_.get_x_val())), 1e-12) << Words();
    const double unbalanced = result_.has_duals() ? Stationarity(*program_, result_) : 0;
    EXPECT_LE(unbalanced, kAccurate) << Words();
    const bool known = IsKnownOptimum(row, result_.objective);
    if (row.Is(kConvex)) {
      EXPECT_TRUE(known) << Words();
    } else {
      EXPECT_TRUE(known || result_.dual == PointKind::kFeasible) << Words();
      EXPECT_EQ(result_.termination, Termination::kLocallyOptimal) << Words();
    }
  }

  static std::vector<std::string>& Table() {
    static std::vector<std::string> table;
    return table;
  }

  std::unique_ptr<MathematicalProgram> program_;
  MathematicalProgramResult result_;
  double violation_ = kNoValue;
};

bool IsOneOf(Termination t, std::initializer_list<Termination> some) {
  return std::find(some.begin(), some.end(), t) != some.end();
}

TEST_P(NonlinearSuite, IsAnsweredHonestly) {
  const auto& [row, way] = GetParam();
  if (!SolverInterface(way->backend, Backends()).available()) {
    GTEST_SKIP() << "there is no " << way->backend;
  }
  Solve();
  if (result_.is_success()) return ExpectTrueSuccess();

  const Termination t = result_.termination;
  const bool at_a_limit = IsOneOf(t, {Termination::kIterationLimit, Termination::kTimeLimit});
  if (row->answer == Answer::kInfeasible) {
    EXPECT_TRUE(IsOneOf(t, {Termination::kInfeasible, Termination::kLocallyInfeasible}) ||
                (way->backend == "nlopt" && at_a_limit))
        << Words();
  } else if (row->answer == Answer::kUnbounded) {
    EXPECT_FALSE(IsOneOf(t, {Termination::kInfeasible, Termination::kLocallyInfeasible,
                             Termination::kBackendFailed}))
        << Words();
  } else if (row->Is(kUndefinedStart)) {
    EXPECT_EQ(t, Termination::kEvaluationFailed) << Words();
  } else {
    EXPECT_TRUE(at_a_limit || t == Termination::kNumericalTrouble) << Words();
    EXPECT_TRUE(!way->by_gradients || row->Is(kNoMultipliers)) << Words();
  }
}

INSTANTIATE_TEST_SUITE_P(All, NonlinearSuite, ::testing::ValuesIn(Cases()),
                         [](const auto& made) { return NameOf(made.param); });

TEST(Suite, IsLargeAndOfAllClasses) {
  const auto count = [](auto&& is) { return std::count_if(Suite().begin(), Suite().end(), is); };
  EXPECT_GE(Suite().size(), 40U);
  EXPECT_GE(count([](const KnownProgram& row) { return row.name.starts_with("HS"); }), 28);
  for (const auto conditions : {Conditions::kNone, Conditions::kBounds, Conditions::kInequalities,
                                Conditions::kEqualities}) {
    EXPECT_GE(count([&](const KnownProgram& row) { return row.conditions == conditions; }), 4);
  }
}

TEST(Suite, HasAStartForEveryVariable) {
  for (const KnownProgram& row : Suite()) {
    EXPECT_EQ(row.terms()->num_vars(), static_cast<int>(row.start.size())) << row.name;
    EXPECT_TRUE(Make(row)->initial_guess().allFinite()) << row.name;
    EXPECT_EQ(std::isfinite(row.optimum), row.answer == Answer::kOptimum) << row.name;
  }
}

}  // namespace
}  // namespace switchyard::testing
