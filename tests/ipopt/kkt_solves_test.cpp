// Programs solved by Ipopt with condensed and with augmented systems: the same optima.
#include <cmath>
#include <thread>
#include <vector>

#include "switchyard/model/program.hpp"
#include "switchyard/solve/solve.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

using Eigen::VectorXd;

VectorXd One(double value) { return VectorXd::Constant(1, value); }

SolverOptions Form(const char* form) {
  SolverOptions options;
  options.SetOption(SolverId("ipopt"), "kkt", form);
  return options;
}

class IpoptKkt : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT("ipopt"); }
};
class IpoptKktForm : public IpoptKkt, public ::testing::WithParamInterface<const char*> {};

/// Three joints in least time, with bounds of all kinds.
double LeastTime(const SolverOptions& options, double acceleration = 5) {
  KinematicTrajectoryOptimization problem(3, 12);
  const VectorXd zero = VectorXd::Zero(3), goal = Eigen::Vector3d(1, -0.7, 0.4);
  problem.AddDurationConstraint(0.1, 50);
  problem.AddDurationCost();
  problem.AddPathLengthCost();
  problem.AddVelocityBounds(VectorXd::Constant(3, -2), VectorXd::Constant(3, 2));
  problem.AddAccelerationBounds(VectorXd::Constant(3, -acceleration),
                                VectorXd::Constant(3, acceleration));
  problem.AddJerkBounds(VectorXd::Constant(3, -30), VectorXd::Constant(3, 30));
  problem.AddPathPositionConstraint(zero, zero, 0);
  problem.AddPathPositionConstraint(goal, goal, 1);
  problem.AddPathVelocityConstraint(zero, zero, 0);
  problem.AddPathVelocityConstraint(zero, zero, 1);
  const SolverInterface ipopt("ipopt", Built());
  const auto found = problem.FindTrajectory(options, &ipopt);
  EXPECT_TRUE(found.result.is_success()) << found.result.message;
  return found.result.objective;
}

// min (x_0 - 2)^2 + (x_1 - 1)^2 over the disc: the projection of (2, 1) onto it.
TEST_P(IpoptKktForm, FindsTheProjectionOntoADisc) {
  MathematicalProgram prog;
  const auto x = prog.NewContinuousVariables(2, "x");
  prog.AddCost([](const auto& v) { return pow(v[0] - 2, 2) + pow(v[1] - 1, 2); }, x);
  prog.AddConstraint([](const auto& v) { return v[0] * v[0] + v[1] * v[1]; }, One(-10), One(1), x);
  const SolverInterface ipopt("ipopt", Built());
  const auto result = ipopt.Solve(prog, std::nullopt, Form(GetParam()));
  ASSERT_TRUE(result.is_success()) << result.message;
  EXPECT_NEAR((result.GetSolution(x) - Eigen::Vector2d(2, 1) / std::sqrt(5.0)).norm(), 0, 1e-6);
}

// max x_0 x_1 on a circle of radius sqrt 2: a Hessian that is indefinite.
TEST_P(IpoptKktForm, FindsAnOptimumOfANonconvexProgram) {
  MathematicalProgram prog;
  const auto x = prog.NewContinuousVariables(2, "x");
  prog.AddCost([](const auto& v) { return -v[0] * v[1]; }, x);
  prog.AddConstraint([](const auto& v) { return v[0] * v[0] + v[1] * v[1]; }, One(2), One(2), x);
  prog.AddLinearConstraint(x[0] + x[1] >= -1);
  prog.SetInitialGuess(x, Eigen::Vector2d(1.3, 0.2));
  const SolverInterface ipopt("ipopt", Built());
  const auto result = ipopt.Solve(prog, std::nullopt, Form(GetParam()));
  ASSERT_TRUE(result.is_success()) << result.message;
  EXPECT_NEAR(result.objective, -1, 1e-6);
}

// Equations that say the same twice, and one that contradicts the others.
TEST_P(IpoptKktForm, BearsDependentEquations) {
  for (const double last : {2.0, 3.0}) {
    MathematicalProgram prog;
    const auto x = prog.NewContinuousVariables(3, "x");
    prog.AddCost([](const auto& v) { return exp(v[0]) + v[1] * v[1] + v[2] * v[2]; }, x);
    prog.AddLinearEqualityConstraint(x[0] + x[1] + x[2], 1);
    prog.AddLinearEqualityConstraint(2 * x[0] + 2 * x[1] + 2 * x[2], last);
    const SolverInterface ipopt("ipopt", Built());
    const auto result = ipopt.Solve(prog, std::nullopt, Form(GetParam()));
    EXPECT_EQ(result.is_success(), last == 2) << result.message;
    if (last == 3) {
      EXPECT_EQ(result.termination, Termination::kInfeasible);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, IpoptKktForm, ::testing::Values("auto", "condensed", "augmented"),
                         [](const auto& form) { return std::string(form.param); });

TEST_F(IpoptKkt, FormsAgreeOnATrajectory) {
  const double augmented = LeastTime(Form("augmented"));
  EXPECT_NEAR(LeastTime(Form("condensed")), augmented, 1e-6);
  EXPECT_NEAR(LeastTime(Form("auto")), augmented, 1e-6);
}

// Whoever names a linear solver means Ipopt's.
TEST_F(IpoptKkt, LeavesALinearSolverThatIsNamedToIpopt) {
  SolverOptions options;
  options.SetOption(SolverId("ipopt"), "linear_solver", "mumps");
  EXPECT_NEAR(LeastTime(options), LeastTime({}), 1e-6);
}

TEST_F(IpoptKkt, SaysWhichFormsThereAre) {
  try {
    LeastTime(Form("sparse"));
    FAIL() << "no exception";
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("option kkt needs one of auto, condensed, augmented"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(IpoptKkt, GivesTheSameAnswersOnManyThreads) {
  constexpr int kThreads = 4;
  std::vector<double> alone, together(kThreads);
  for (int k = 0; k < kThreads; ++k) alone.push_back(LeastTime({}, 3 + k));
  std::vector<std::thread> threads;
  for (int k = 0; k < kThreads; ++k) {
    threads.emplace_back(
        [&together, k] { together[static_cast<std::size_t>(k)] = LeastTime({}, 3 + k); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(together, alone);
}

}  // namespace
}  // namespace switchyard::testing
