// Functions of Traced numbers.
#include "switchyard/functions/make_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "switchyard/functions/check_derivatives.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorX;
using Eigen::VectorXd;

void ExpectRightDerivatives(const Function& f, const VectorXd& x) {
  const DerivativeReport report = CheckDerivatives(f, x);
  EXPECT_TRUE(report.agrees()) << to_string(report);
}

struct Rosenbrock {
  template <class T>
  T operator()(const VectorX<T>& x) const {
    const T a = 1 - x[0];
    const T b = x[1] - x[0] * x[0];
    return a * a + 100 * b * b;
  }
};

template <class T>
T Distance(const VectorX<T>& x) {
  return x.norm();
}

TEST(MakeFunction, TakesAGenericLambda) {
  const auto f = MakeFunction(3, [](const auto& x) { return sin(x[0]) * x[2]; });
  EXPECT_EQ(f->num_vars(), 3);
  EXPECT_EQ(f->num_outputs(), 1);
  EXPECT_TRUE(f->is_thread_safe());
  EXPECT_EQ(f->jacobian(), Pattern(1, 3, {{0, 0}, {0, 2}}));
  EXPECT_EQ(f->hessian(), Pattern(3, 3, {{0, 0}, {0, 2}}));
  EXPECT_EQ(At(*f, Vector3d(1, 2, 3)).values[0], std::sin(1.0) * 3);
  ExpectRightDerivatives(*f, Vector3d(1, 2, 3));
}

TEST(MakeFunction, TakesATemplateAndAFunctionOfTraced) {
  const auto f = MakeFunction(2, Rosenbrock());
  EXPECT_EQ(At(*f, Vector2d(1, 1)).values[0], 0);
  ExpectRightDerivatives(*f, Vector2d(-1.2, 1));
  ExpectRightDerivatives(*MakeFunction(2, Distance<Traced>), Vector2d(3, 4));
  const auto g = MakeFunction(2, [](const VectorX<Traced>& x) { return x[0].value() * x[1]; });
  EXPECT_EQ(At(*g, Vector2d(3, 4)).values[0], 12);
  EXPECT_EQ(At(*g, Vector2d(3, 4)).jacobian, Eigen::RowVector2d(0, 3));  // a value is a constant
}

TEST(MakeFunction, KeepsTheTapeOfWhatItTraced) {
  const auto f = MakeFunction(2, [](const auto& x) { return sin(x[0]) + x[1]; });
  Tape expected(2);
  expected.AddOutput(expected.Apply(Op::kAdd, expected.Apply(Op::kSin, 0), 1));
  ASSERT_NE(TapeOf(*f), nullptr);
  EXPECT_EQ(*TapeOf(*f), expected);
  const auto branching = MakeFunction(1, [](const auto& x) { return x[0] > 0 ? x[0] : -x[0]; });
  EXPECT_EQ(TapeOf(*branching), nullptr);
}

TEST(MakeFunction, TakesEveryKindOfAnswer) {
  const auto outputs = [](auto f) { return At(*MakeFunction(2, f), Vector2d(3, 4)).values; };
  EXPECT_EQ(outputs([](const auto&) { return 7; }), VectorXd::Constant(1, 7));
  EXPECT_EQ(outputs([](const auto& x) { return x[1]; }), VectorXd::Constant(1, 4));
  EXPECT_EQ(outputs([](const auto& x) { return x * 2.0; }), Vector2d(6, 8));
  EXPECT_EQ(outputs([](const auto& x) { return x.array() + 1.0; }), Vector2d(4, 5));
  EXPECT_EQ(outputs([](const auto& x) { return x.transpose() * x; }), VectorXd::Constant(1, 25));
  EXPECT_EQ(outputs([](const auto&) { return Vector2d(1, 2); }), Vector2d(1, 2));
  EXPECT_EQ(outputs([](const auto& x) {
              return std::vector{x[0], x[1], x[0] + x[1]};
            }),
            Vector3d(3, 4, 7));
  EXPECT_EQ(outputs([](const auto& x) { return std::array{x[0]}; }), VectorXd::Constant(1, 3));
  EXPECT_EQ(outputs([](const auto&) { return std::vector<double>(); }).size(), 0);
  EXPECT_EQ(Said([&] { outputs([](const auto& x) { return (x * x.transpose()).eval(); }); }),
            "function: needs to return a vector, got 2 x 2");
}

TEST(MakeFunction, TracesBranchesAnewAtEveryPoint) {
  const auto f = MakeFunction(2, [](const auto& x) {
    auto y = x[1] * x[1];
    if (x[0] > 1) y = y * x[0];
    return y;
  });
  EXPECT_EQ(f->jacobian(), SparsityPattern::Dense(1, 2));
  EXPECT_EQ(f->hessian(), SparsityPattern::DenseUpperTriangle(2));
  for (int k = 0; k < 3; ++k) {
    const Evaluated below = At(*f, Vector2d(0.5, 3));
    EXPECT_EQ(below.values[0], 9);
    EXPECT_EQ(below.jacobian, Eigen::RowVector2d(0, 6));
    EXPECT_EQ(below.hessian, (Eigen::Matrix2d() << 0, 0, 0, 2).finished());
    const Evaluated above = At(*f, Vector2d(2 + k, 3));
    EXPECT_EQ(above.values[0], 9 * (2 + k));
    EXPECT_EQ(above.jacobian, Eigen::RowVector2d(9, 6 * (2 + k)));
    EXPECT_EQ(above.hessian, (Eigen::Matrix2d() << 0, 6, 6, 2 * (2 + k)).finished());
  }
}

TEST(MakeFunction, TracesLoopsThatAskForTheirEnd) {
  const auto newton = MakeFunction(1, [](const auto& x) {  // the square root of x
    auto y = x[0];
    for (int k = 0; k < 50 && abs(y * y - x[0]) > 1e-14; ++k) y = 0.5 * (y + x[0] / y);
    return y;
  });
  for (const double x : {0.2, 2.0, 50.0}) {
    const Evaluated at = At(*newton, VectorXd::Constant(1, x));
    EXPECT_NEAR(at.values[0], std::sqrt(x), 1e-13);
    EXPECT_NEAR(at.jacobian(0, 0), 0.5 / std::sqrt(x), 1e-9);
  }
}

TEST(MakeFunction, KeepsDeclaredPatterns) {
  const FunctionOptions options{.jacobian = Pattern(2, 3, {{1, 2}, {0, 0}, {0, 1}}),
                                .hessian = Pattern(3, 3, {{0, 0}, {2, 2}})};
  const auto straight = [](const auto& x) { return std::vector{x[0] * x[0], x[2]}; };
  const auto branching = [](const auto& x) {
    return std::vector{x[0] > 0 ? x[0] * x[0] : -x[0], x[2]};
  };
  for (const auto& f : {MakeFunction(3, straight, options), MakeFunction(3, branching, options)}) {
    EXPECT_EQ(f->jacobian(), *options.jacobian);
    EXPECT_EQ(f->hessian(), *options.hessian);
    ExpectRightDerivatives(*f, Vector3d(3, 4, 5));
  }
}

TEST(MakeFunction, SaysWhatIsOutsideADeclaredPattern) {
  const auto product = [](const auto& x) { return x[0] * x[1]; };
  EXPECT_EQ(Said([&] {
              MakeFunction(2, product, {.jacobian = Pattern(1, 2, {{0, 0}})});
            }),
            "Jacobian: the entry in row 0 and column 1 is not in the declared pattern");
  EXPECT_EQ(Said([&] {
              MakeFunction(2, product, {.hessian = Pattern(2, 2, {{0, 0}})});
            }),
            "Hessian: the entry in row 0 and column 1 is not in the declared pattern");
  const auto branching = [](const auto& x) { return x[0] > 2 ? x[0] * x[1] : x[0]; };
  const auto f = MakeFunction(2, branching, {.jacobian = Pattern(1, 2, {{0, 0}})});
  EXPECT_EQ(At(*f, Vector2d(1, 7)).jacobian, Eigen::RowVector2d(1, 0));
  EXPECT_EQ(Said([&] { At(*f, Vector2d(3, 7)); }),
            "Jacobian: the entry in row 0 and column 1 is not in the declared pattern");
}

TEST(MakeFunction, SaysWhatIsWrongWithADeclaredPattern) {
  const auto said = [](const FunctionOptions& options) {
    return Said([&] { MakeFunction(2, Rosenbrock(), options); });
  };
  EXPECT_EQ(said({.jacobian = Pattern(2, 2, {})}),
            "Jacobian: the declared pattern needs to be 1 x 2, got 2 x 2");
  EXPECT_EQ(said({.jacobian = Pattern(1, 2, {{0, 0}, {0, 2}})}),
            "Jacobian: place 1 of the declared pattern, row 0 and column 2, is outside 1 x 2");
  EXPECT_EQ(said({.jacobian = Pattern(1, 2, {{0, 0}, {0, 0}})}),
            "Jacobian: the declared pattern has row 0 and column 0 twice");
  EXPECT_EQ(said({.hessian = Pattern(2, 2, {{1, 0}})}),
            "Hessian: the declared pattern is of the upper triangle, and has row 1 and column 0");
  EXPECT_EQ(said({.probe = Vector3d(1, 2, 3)}), "function: the probe needs 2 entries, got 3");
  EXPECT_EQ(Said([] { MakeFunction(-1, Rosenbrock()); }),
            "function: the number of variables needs to be at least 0, got -1");
}

TEST(MakeFunction, SaysThatTheNumberOfOutputsChanged) {
  const auto f = MakeFunction(1, [](const auto& x) { return std::vector(x[0] > 1 ? 2 : 1, x[0]); });
  EXPECT_EQ(f->num_outputs(), 1);
  EXPECT_EQ(Said([&] { At(*f, VectorXd::Constant(1, 3)); }),
            "function: needs to return 1 numbers as at first, got 2");
}

TEST(MakeFunction, LetsWhatTheFunctionThrowsPass) {
  const auto picky = [](const auto& x) {
    if (x[0] > 2) throw std::domain_error("above 2");
    return x[0];
  };
  const auto f = MakeFunction(1, picky);
  EXPECT_THROW(At(*f, VectorXd::Constant(1, 3)), std::domain_error);
  EXPECT_EQ(At(*f, VectorXd::Constant(1, 1)).values[0], 1);
  EXPECT_THROW(MakeFunction(1, picky, {.probe = VectorXd::Constant(1, 3)}), std::domain_error);
  const auto always = [](const auto& x) -> Traced {
    throw std::runtime_error(x[0] == 0 ? "at zero" : "at first");
  };
  try {
    MakeFunction(1, always);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "at first");
  }
}

TEST(MakeFunction, ProbesZeroWhereAGenericPointThrows) {
  const auto at_rest = [](const auto& x) {
    if (x[0] > 0.1) throw std::domain_error("moves");
    return 2 * x[0];
  };
  EXPECT_EQ(At(*MakeFunction(1, at_rest), VectorXd::Constant(1, -3)).values[0], -6);
}

TEST(MakeFunction, MayBeCalledInsideAFunction) {
  const auto f = MakeFunction(2, [](const auto& x) {
    const auto inner = MakeFunction(1, [](const auto& y) { return y[0] * y[0] * y[0]; });
    return x[0] * At(*inner, VectorXd::Constant(1, 2)).jacobian(0, 0) + sin(x[1]);
  });
  EXPECT_EQ(f->hessian(), Pattern(2, 2, {{1, 1}}));
  EXPECT_EQ(At(*f, Vector2d(1, 0)).values[0], 12);
  ExpectRightDerivatives(*f, Vector2d(1, 2));
}

TEST(MakeFunction, MayBeTracedByTwoThreads) {
  const auto f = MakeFunction(
      2, [](const auto& x) { return x[0] > 0 ? exp(x[0] * x[1]) : x[0] * x[1] * x[1]; });
  const auto expect = [&](const VectorXd& x) {
    const Evaluated alone = At(*f, x);
    for (int k = 0; k < 200; ++k) {
      const Evaluated now = At(*f, (k % 2 == 0 ? 1 : -1) * x);
      if (k % 2 == 0) {
        EXPECT_EQ(now.values, alone.values);
        EXPECT_EQ(now.hessian, alone.hessian);
      }
    }
  };
  std::thread first(expect, Vector2d(1, 2));
  std::thread second(expect, Vector2d(-1, 3));
  first.join();
  second.join();
}

TEST(MakeFunction, AsksForConstCallsFromSeveralThreads) {
  int calls = 0;
  auto counting = [calls](const auto& x) mutable { return x[0] * ++calls; };
  EXPECT_EQ(Said([&] { MakeFunction(1, counting); }),
            "function: a call that is not const needs the option is_thread_safe = false");
  EXPECT_EQ(At(*MakeFunction(1, counting, {.is_thread_safe = false}), VectorXd::Ones(1)).values[0],
            1);
}

}  // namespace
}  // namespace switchyard
