// The general contract: Ax + b in (c't + d) S, checked against the set itself.
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

/// The largest violation of the constraints where the program's variables have these values.
double ViolationAt(const MathematicalProgram& program, const Eigen::VectorXd& values) {
  double worst = 0;
  for (const auto& binding : program.GetAllConstraints()) {
    worst = std::max(worst,
                     binding.evaluator()->Violation(program.ValuesOf(binding.variables(), values)));
  }
  return worst;
}

TEST(Scaling, IsTheSetItselfAtScaleOne) {
  RandomSets random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 1 + trial % 3;
    const Eigen::VectorXd inside = random.Vector(n, 3);
    for (const ConvexSetPointer& set : random.OneOfEach(inside)) {
      MathematicalProgram program;
      const auto x = program.NewContinuousVariables(n);
      const auto [aux, constraints] = set->AddPointInSetConstraints(&program, x);
      EXPECT_EQ(aux.size(), 0);
      EXPECT_EQ(constraints.size(), program.GetAllConstraints().size());
      EXPECT_LE(ViolationAt(program, inside), 1e-12) << set->Kind();
      for (int k = 0; k < 50; ++k) {
        const Eigen::VectorXd at = inside + random.Vector(n, 2);
        EXPECT_EQ(ViolationAt(program, at) <= 1e-9, set->PointInSet(at, 1e-9)) << set->Kind();
      }
    }
  }
}

TEST(Scaling, KeepsItsContractForAnyAffineArguments) {
  RandomSets random(4);
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 1 + trial % 3;
    const Eigen::VectorXd inside = random.Vector(n, 3);
    const Eigen::MatrixXd A = random.Matrix(n, 2);
    const Eigen::VectorXd b = random.Vector(n);
    const Eigen::VectorXd c = random.Vector(2);
    const double d = random.Uniform(0, 1);
    for (const ConvexSetPointer& set : random.OneOfEach(inside)) {
      MathematicalProgram program;
      const auto x = program.NewContinuousVariables(2, "x");
      const auto t = program.NewContinuousVariables(2, "t");
      set->AddPointInNonnegativeScalingConstraints(&program, A, b, c, d, x, t);
      for (int k = 0; k < 100; ++k) {
        Eigen::VectorXd at = random.Vector(4, 4);
        // Half of the points are aimed at the set: Ax + b = (c't + d) times one of its points.
        const double scale = c.dot(at.tail(2)) + d;
        if (k % 2 == 0 && scale > 0.1 && n <= 2) {
          at.head(2) = A.completeOrthogonalDecomposition().solve(scale * inside - b);
        }
        const Eigen::VectorXd point = A * at.head(2) + b;
        const bool in = scale > 0 && set->PointInSet(point / scale, 1e-7 / scale);
        const double violation = ViolationAt(program, at);
        if (in) {
          EXPECT_LE(violation, 1e-6) << set->Kind();
        } else if (scale > 1e-6) {
          EXPECT_GT(violation, 0) << set->Kind();
        } else {
          EXPECT_GT(violation + (scale > -1e-6 ? 1 : 0), 0);
        }
      }
    }
  }
}

TEST(Scaling, RefusesANegativeConstantScale) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  const Hyperrectangle box(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  EXPECT_THROW(box.AddPointInNonnegativeScalingConstraints(
                   &program, Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1),
                   Eigen::VectorXd(), -1, x, VariableList()),
               InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
