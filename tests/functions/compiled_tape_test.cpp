#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "switchyard/functions/tape.hpp"
#include "tests/functions/evaluated.hpp"

namespace switchyard {
namespace {

using Eigen::VectorXd;

// Outputs sin(x_i) x_{i+1}^2 + x_i / 2.
Tape Chain(int n) {
  Tape tape(n + 1);
  for (int i = 0; i < n; ++i) {
    const auto square = tape.Apply(Op::kMultiply, i + 1, i + 1);
    const auto product = tape.Apply(Op::kMultiply, tape.Apply(Op::kSin, i), square);
    tape.AddOutput(tape.Apply(Op::kAdd, product, tape.Apply(Op::kDivide, i, tape.Constant(2))));
  }
  return tape;
}

TEST(CompiledTape, IsItsFormula) {
  const auto f = CompileTape(Chain(1));
  const double x = 0.4;
  const double y = -1.5;
  const double w = 3;
  const Evaluated at = At(*f, Eigen::Vector2d(x, y), VectorXd::Constant(1, w));
  EXPECT_EQ(at.values[0], std::sin(x) * (y * y) + x / 2);
  EXPECT_DOUBLE_EQ(at.jacobian(0, 0), std::cos(x) * y * y + 0.5);
  EXPECT_DOUBLE_EQ(at.jacobian(0, 1), std::sin(x) * 2 * y);
  EXPECT_DOUBLE_EQ(at.hessian(0, 0), -w * std::sin(x) * y * y);
  EXPECT_DOUBLE_EQ(at.hessian(0, 1), w * std::cos(x) * 2 * y);
  EXPECT_DOUBLE_EQ(at.hessian(1, 1), w * std::sin(x) * 2);
}

TEST(CompiledTape, HasThePatternsOfItsStructureColumnByColumn) {
  const auto f = CompileTape(Chain(3));
  EXPECT_EQ(f->jacobian(), Pattern(3, 4, {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}}));
  EXPECT_EQ(f->hessian(), Pattern(4, 4, {{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}}));
}

TEST(CompiledTape, HasNoHessianEntryOfWhatIsLinear) {
  Tape tape(4);  // 3 (x_0 - x_1) / 2 + x_2 x_3, and -x_0
  const auto difference = tape.Apply(Op::kSubtract, 0, 1);
  const auto linear = tape.Apply(
      Op::kDivide, tape.Apply(Op::kMultiply, tape.Constant(3), difference), tape.Constant(2));
  tape.AddOutput(tape.Apply(Op::kAdd, linear, tape.Apply(Op::kMultiply, 2, 3)));
  tape.AddOutput(tape.Apply(Op::kNegate, 0));
  const auto f = CompileTape(tape);
  EXPECT_EQ(f->hessian(), Pattern(4, 4, {{2, 3}}));
  const Evaluated at = At(*f, Eigen::Vector4d(1, 2, 3, 4));
  EXPECT_EQ(at.jacobian, (Eigen::MatrixXd(2, 4) << 1.5, -1.5, 4, 3, -1, 0, 0, 0).finished());
}

TEST(CompiledTape, HasNoEntryByOperationsThatNeverMove) {
  Tape tape(3);  // floor(x_0) + (x_1 > 0 ? x_2 : 0)
  tape.AddOutput(tape.Apply(Op::kAdd, tape.Apply(Op::kFloor, 0),
                            tape.Apply(Op::kIfPositive, 1, 2, tape.Constant(0))));
  const auto f = CompileTape(tape);
  EXPECT_EQ(f->jacobian(), Pattern(1, 3, {{0, 2}}));
  EXPECT_EQ(f->hessian().size(), 0);
  EXPECT_EQ(At(*f, Eigen::Vector3d(1.5, 1, 7)).values[0], 8);
}

TEST(CompiledTape, TakesOutputsThatAreConstantsInputsOrEqual) {
  Tape tape(2);
  const auto product = tape.Apply(Op::kMultiply, 0, 1);
  for (const auto place : {tape.Constant(5), 1, product, product}) tape.AddOutput(place);
  const auto f = CompileTape(tape);
  EXPECT_EQ(f->jacobian(), Pattern(4, 2, {{2, 0}, {3, 0}, {1, 1}, {2, 1}, {3, 1}}));
  const Evaluated at = At(*f, Eigen::Vector2d(3, 4), Eigen::Vector4d(1, 1, 10, 100));
  EXPECT_EQ(at.values, Eigen::Vector4d(5, 4, 12, 12));
  EXPECT_EQ(at.jacobian, (Eigen::MatrixXd(4, 2) << 0, 0, 0, 1, 4, 3, 4, 3).finished());
  EXPECT_EQ(at.hessian, (Eigen::Matrix2d() << 0, 110, 110, 0).finished());
}

TEST(CompiledTape, TakesAnOperandTwice) {
  Tape tape(1);
  tape.AddOutput(tape.Apply(Op::kPower, 0, 0));
  tape.AddOutput(tape.Apply(Op::kMultiply, 0, 0));
  tape.AddOutput(tape.Apply(Op::kAdd, 0, 0));
  tape.AddOutput(tape.Apply(Op::kDivide, 0, 0));
  const double x = 1.7;
  const double l = 1 + std::log(x);
  const auto f = CompileTape(tape);
  const Evaluated at = At(*f, VectorXd::Constant(1, x), Eigen::Vector4d(1, 10, 100, 1000));
  EXPECT_DOUBLE_EQ(at.jacobian(0, 0), std::pow(x, x) * l);
  EXPECT_DOUBLE_EQ(at.jacobian(1, 0), 2 * x);
  EXPECT_DOUBLE_EQ(at.jacobian(2, 0), 2);
  EXPECT_NEAR(at.jacobian(3, 0), 0, 1e-15);
  EXPECT_NEAR(at.hessian(0, 0), std::pow(x, x) * (l * l + 1 / x) + 20, 1e-12);
}

TEST(CompiledTape, TakesNoInputsAndNoOutputs) {
  Tape constant(0);
  constant.AddOutput(constant.Constant(7));
  EXPECT_EQ(At(*CompileTape(constant), VectorXd(0)).values[0], 7);
  const auto nothing = CompileTape(Tape(3));
  EXPECT_EQ(nothing->num_outputs(), 0);
  EXPECT_EQ(nothing->jacobian(), Pattern(0, 3, {}));
  EXPECT_EQ(nothing->hessian(), Pattern(3, 3, {}));
}

TEST(CompiledTape, WritesOnlyWhatIsAskedFor) {
  const auto f = CompileTape(Chain(2));
  const Eigen::Vector3d x(1, 2, 3);
  const Eigen::Vector2d w(1, -1);
  const Evaluated all = At(*f, x, w);
  Eigen::Vector2d values;
  f->Evaluate({.x = x.data(), .values = values.data()});
  EXPECT_EQ(values, all.values);
  std::vector<double> hessian(f->hessian().row.size());
  f->Evaluate({.x = x.data(), .weights = w.data(), .hessian = hessian.data()});
  for (int k = 0; k < f->hessian().size(); ++k) {
    EXPECT_EQ(hessian[k], all.hessian(f->hessian().row[k], f->hessian().col[k]));
  }
}

TEST(CompiledTape, SaysTheSameBitsFromSeveralThreads) {
  const auto f = CompileTape(Chain(200));
  const auto g = CompileTape(Chain(50));
  const VectorXd x = VectorXd::LinSpaced(201, -2, 2);
  const Evaluated alone = At(*f, x);
  std::atomic<int> different = 0;
  const auto evaluate = [&] {
    for (int k = 0; k < 300; ++k) {
      (void)At(*g, x.head(51));
      const Evaluated now = At(*f, x);
      const bool same = now.values == alone.values && now.jacobian == alone.jacobian &&
                        now.hessian == alone.hessian;
      different += same ? 0 : 1;
    }
  };
  std::thread first(evaluate);
  std::thread second(evaluate);
  first.join();
  second.join();
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace switchyard
