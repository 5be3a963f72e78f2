// Functions of doubles, with derivatives of their own or without any.
#include <gtest/gtest.h>

#include <Eigen/SparseCore>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "switchyard/functions/check_derivatives.hpp"
#include "switchyard/functions/make_function.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

double Product(const VectorXd& x) { return x[0] * x[1]; }

void ExpectRightDerivatives(const Function& f, const VectorXd& x) {
  const DerivativeReport report = CheckDerivatives(f, x);
  EXPECT_TRUE(report.agrees()) << to_string(report);
}

TEST(FunctionOfDoubles, HasNoDerivatives) {
  std::function<double(const VectorXd&)> wrapped = Product;
  const auto plain = [](const VectorXd& x) { return Product(x); };
  const auto by_reference = [](const Eigen::Ref<const VectorXd>& x) { return x[0] * x[1]; };
  for (const auto& f : {MakeFunction(2, plain), MakeFunction(2, by_reference),
                        MakeFunction(2, Product), MakeFunction(2, wrapped)}) {
    EXPECT_FALSE(f->has_jacobian());
    EXPECT_FALSE(f->has_hessian());
    EXPECT_EQ(f->num_outputs(), 1);
    EXPECT_EQ(At(*f, Vector2d(3, 4)).values[0], 12);
    const Vector2d x(3, 4);
    double J[2];
    EXPECT_EQ(Said([&] { f->Evaluate({.x = x.data(), .jacobian = J}); }),
              "function: it has no Jacobian");
  }
}

TEST(FunctionOfDoubles, MayKeepWhatCannotBeCopied) {
  auto factor = std::make_unique<double>(3);
  const auto f = MakeFunction(
      1, [kept = std::move(factor)](const VectorXd& x) { return VectorXd(*kept * x); });
  EXPECT_EQ(At(*f, VectorXd::Ones(1)).values[0], 3);
}

TEST(FunctionOfDoubles, IsLookedAtWhereItIsDefined) {
  const auto f = [](const VectorXd& x) {
    if (x[0] != 5) throw std::domain_error("not at 5");
    return x;
  };
  EXPECT_THROW(MakeFunction(1, f), std::domain_error);
  const VectorXd five = VectorXd::Constant(1, 5);
  EXPECT_EQ(At(*MakeFunction(1, f, {.probe = five}), five).values, five);
}

TEST(FunctionOfDoubles, SaysThatTheNumberOfOutputsChanged) {
  const auto f =
      MakeFunction(1, [](const VectorXd& x) { return VectorXd::Ones(x[0] > 2 ? 3 : 1).eval(); });
  EXPECT_EQ(Said([&] { At(*f, VectorXd::Constant(1, 3)); }),
            "function: needs to return 1 numbers as at first, got 3");
}

TEST(FunctionOfDoubles, MayCountItsCallsOnOneThread) {
  int calls = 0;
  auto counting = [&calls, last = 0.0](const VectorXd& x) mutable {
    ++calls;
    return last = x[0];
  };
  EXPECT_EQ(Said([&] { MakeFunction(1, counting); }),
            "function: a call that is not const needs the option is_thread_safe = false");
  const auto f = MakeFunction(1, counting, {.is_thread_safe = false});
  EXPECT_FALSE(f->is_thread_safe());
  At(*f, VectorXd::Ones(1));
  EXPECT_EQ(calls, 2);
}

// (x_0 x_1, x_0^2) with what a test wants to be wrong.
struct Pair {
  VectorXd operator()(const VectorXd& x) const { return Vector2d(x[0] * x[1], x[0] * x[0]); }
  MatrixXd Jacobian(const VectorXd& x) const {
    return (MatrixXd(2, 2) << x[1], x[0], 2 * x[0], 0).finished();
  }
  MatrixXd Hessian(const VectorXd&, const VectorXd& w) const {
    return (MatrixXd(2, 2) << 2 * w[1], w[0], w[0], 0).finished();
  }
};

TEST(OwnDerivatives, AreUsedAsTheyAre) {
  const auto f = MakeFunction(2, Pair());
  EXPECT_EQ(f->jacobian(), SparsityPattern::Dense(2, 2));
  EXPECT_EQ(f->hessian(), SparsityPattern::DenseUpperTriangle(2));
  ExpectRightDerivatives(*f, Vector2d(3, 4));
}

struct SparsePair : Pair {
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse Jacobian(const VectorXd& x) const { return Pair::Jacobian(x).sparseView(); }
  Sparse Hessian(const VectorXd& x, const VectorXd& w) const {
    return Pair::Hessian(x, w).sparseView();
  }
  static SparsityPattern JacobianPattern() { return Pattern(2, 2, {{0, 0}, {0, 1}, {1, 0}}); }
  SparsityPattern HessianPattern() const { return Pattern(2, 2, {{0, 0}, {0, 1}}); }
};

TEST(OwnDerivatives, MayBeSparse) {
  const auto f = MakeFunction(2, SparsePair());
  EXPECT_EQ(f->jacobian(), SparsePair::JacobianPattern());
  EXPECT_EQ(f->hessian().size(), 2);
  ExpectRightDerivatives(*f, Vector2d(3, 4));
  const auto narrower = MakeFunction(2, SparsePair(), {.hessian = Pattern(2, 2, {{0, 1}})});
  EXPECT_EQ(Said([&] { At(*narrower, Vector2d(3, 4)); }),
            "Hessian: the entry in row 0 and column 0 is not in the declared pattern");
}

struct Single {
  double operator()(const VectorXd& x) const { return x[0] * x[0] * x[1]; }
  VectorXd Gradient(const VectorXd& x) const { return Vector2d(2 * x[0] * x[1], x[0] * x[0]); }
  MatrixXd Hessian(const VectorXd& x) const {
    return (MatrixXd(2, 2) << 2 * x[1], 2 * x[0], 2 * x[0], 0).finished();
  }
};

TEST(OwnDerivatives, OfOneOutputAreAGradientAndAHessian) {
  const auto f = MakeFunction(2, Single());
  ExpectRightDerivatives(*f, Vector2d(3, 4));
  EXPECT_EQ(At(*f, Vector2d(3, 4), VectorXd::Constant(1, 10)).hessian(0, 1), 60);
}

struct WithoutHessian {
  double operator()(const VectorXd& x) const { return x.squaredNorm(); }
  Eigen::RowVectorXd Gradient(const VectorXd& x) const { return 2 * x.transpose(); }
};

TEST(OwnDerivatives, MayLackAHessian) {
  const auto f = MakeFunction(2, WithoutHessian());
  EXPECT_TRUE(f->has_jacobian());
  EXPECT_FALSE(f->has_hessian());
  ExpectRightDerivatives(*f, Vector2d(3, 4));
}

struct GenericWithItsOwn {
  template <class T>
  T operator()(const Eigen::VectorX<T>& x) const {
    return x[0] * x[0];
  }
  VectorXd Gradient(const VectorXd&) const { return VectorXd::Constant(1, 123); }
};

TEST(OwnDerivatives, ComeBeforeTraced) {
  EXPECT_EQ(At(*MakeFunction(1, GenericWithItsOwn()), VectorXd::Ones(1)).jacobian(0, 0), 123);
}

struct WrongShapes {
  int rows;
  int hessian_rows;
  double below;
  VectorXd operator()(const VectorXd& x) const { return Pair()(x); }
  MatrixXd Jacobian(const VectorXd&) const { return MatrixXd::Zero(rows, 2); }
  MatrixXd Hessian(const VectorXd&, const VectorXd&) const {
    MatrixXd H = MatrixXd::Zero(hessian_rows, 2);
    H(1, 0) = below;
    return H;
  }
};

TEST(OwnDerivatives, OfAnotherShapeAreNamed) {
  const auto said = [](const WrongShapes& f) {
    return Said([&] { At(*MakeFunction(2, f), Vector2d(1, 2)); });
  };
  EXPECT_EQ(said({.rows = 3, .hessian_rows = 2, .below = 0}),
            "Jacobian: needs to be 2 x 2, got 3 x 2");
  EXPECT_EQ(said({.rows = 2, .hessian_rows = 4, .below = 0}),
            "Hessian: needs to be 2 x 2, got 4 x 2");
  EXPECT_EQ(said({.rows = 2, .hessian_rows = 2, .below = 7}),
            "Hessian: needs to be symmetric, but row 1 and column 0 has 7, row 0 and column 1 has "
            "0");
}

struct GradientOfTwo : Pair {
  VectorXd Gradient(const VectorXd&) const { return Vector2d(1, 1); }

 private:
  using Pair::Hessian;
  using Pair::Jacobian;
};

TEST(OwnDerivatives, OfSeveralOutputsAreNoGradient) {
  const auto f = MakeFunction(2, GradientOfTwo());
  EXPECT_EQ(Said([&] { At(*f, Vector2d(1, 2)); }), "Jacobian: needs to be 2 x 2, got 1 x 2");
}

struct HessianOfOneOfTwo : Pair {
  MatrixXd Hessian(const VectorXd&) const { return MatrixXd::Zero(2, 2); }
};

TEST(OwnDerivatives, OfSeveralOutputsNeedWeights) {
  const auto f = MakeFunction(2, HessianOfOneOfTwo());
  EXPECT_EQ(Said([&] { At(*f, Vector2d(1, 2)); }),
            "function: Hessian(x) is for one output and this one has 2; give Hessian(x, weights)");
}

struct Throws : Pair {
  MatrixXd Jacobian(const VectorXd&) const { throw std::out_of_range("no table here"); }
};

TEST(OwnDerivatives, MayThrowWhatTheyLike) {
  const auto f = MakeFunction(2, Throws());
  EXPECT_THROW(At(*f, Vector2d(1, 2)), std::out_of_range);
}

struct NotConst : Pair {
  MatrixXd Jacobian(const VectorXd& x) { return Pair::Jacobian(x); }
};

TEST(OwnDerivatives, ThatAreNotConstAreForOneThread) {
  EXPECT_EQ(Said([] { MakeFunction(2, NotConst()); }),
            "function: a call that is not const needs the option is_thread_safe = false");
  ExpectRightDerivatives(*MakeFunction(2, NotConst(), {.is_thread_safe = false}), Vector2d(3, 4));
}

}  // namespace
}  // namespace switchyard
