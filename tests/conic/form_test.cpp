// The scaled form: what is computed in it is, carried back, the same in the problem; and an iterate
// of one form carried to another.
#include "solvers/conic/form.hpp"

#include <gtest/gtest.h>

#include "solvers/conic/warm_start.hpp"
#include "solvers/linalg/vector.hpp"
#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

using linalg::Dot;

constexpr unsigned kSeeds = 20;

Vector Normals(Random& random, Index n) {
  Vector v(static_cast<std::size_t>(n));
  for (double& e : v) e = random.Normal();
  return v;
}

ProblemData SomeProblem(unsigned seed, double spread = 1) {
  Random random(seed);
  testing::Shape shape{16,
                       9,
                       {Rotated(4),
                        SecondOrder(3),
                        {SY_CONE_ZERO, 2, 0},
                        Exponential(),
                        Semidefinite(3),
                        {SY_CONE_NONNEGATIVE, 3, 0},
                        Rotated(3)}};
  shape.quadratic = seed % 2 == 0;
  ProblemData d = testing::KnownOptimum(shape, random).problem;
  for (double& v : d.A.value) v *= std::pow(10, spread * random.Uniform(-1, 1));
  for (double& v : d.q) v *= std::pow(10, spread * random.Uniform(-1, 1));
  return d;
}

/// The problem's point and duals for ones of the form.
Vectors Back(const Form& form, const ProblemData& d, const Vector& x, const Vector& y,
             const Vector& bounds) {
  Vectors v;
  v.x.resize(d.q.size());
  v.x_dual.resize(d.q.size());
  v.row_dual.resize(d.row_lower.size());
  v.cone_dual.resize(d.g.size());
  form.PointBack(x, v.x.data());
  form.DualsBack(y, bounds, v.x_dual.data(), v.row_dual.data(), v.cone_dual.data(), d.num_vars,
                 d.num_rows(), d.num_cone_rows());
  return v;
}

double Sum(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

TEST(Form, HasTheProblemsObjective) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const ProblemData d = SomeProblem(seed);
    const Form form(d);
    Random random(seed);
    const Vector x = Normals(random, form.shape.vars);
    Vector p_x(x.size(), 0.0);
    AddProduct(form.P, 1, x.data(), p_x.data());
    const double ours = (0.5 * Dot(x, p_x) + Dot(form.q, x)) / form.objective_scale + form.offset;
    Values original(x.size());
    form.PointBack(x, original.data());
    EXPECT_NEAR(ours, Objective(Problem(d).view(), original.data()), 1e-9 * (1 + std::abs(ours)));
  }
}

// y'Ax and bounds'x in the form are those of the duals and the point carried back.
TEST(Form, HasTheProblemsProductsOfDualsAndRows) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const ProblemData d = SomeProblem(seed);
    const Form form(d);
    Random random(seed);
    const Vector x = Normals(random, form.shape.vars), y = Normals(random, form.shape.rows());
    const Vector bounds = Normals(random, form.shape.vars);
    const Vectors v = Back(form, d, x, y, bounds);
    Vector a_x(y.size());
    Multiply(form.A, x.data(), a_x.data());
    const double of_rows =
        Sum(v.row_dual, testing::Product(d.A, v.x)) + Sum(v.cone_dual, testing::Product(d.F, v.x));
    const double scale = 1 + std::abs(of_rows);
    EXPECT_NEAR(Dot(y, a_x) / form.objective_scale, of_rows, 1e-9 * scale) << seed;
    EXPECT_NEAR(Dot(bounds, x) / form.objective_scale, Sum(v.x_dual, v.x), 1e-9 * scale) << seed;
    double ours = 0, sides = -Sum(v.cone_dual, d.g);
    for (std::size_t i = 0; i < v.row_dual.size(); ++i) {
      if (v.row_dual[i] == 0) continue;
      // The side that the form's b stands for: the lower one where there is one.
      sides += v.row_dual[i] * (std::isfinite(d.row_lower[i]) ? d.row_lower[i] : d.row_upper[i]);
    }
    for (Index r = 0; r < form.shape.rows(); ++r) ours += y[r] * form.b[r] / form.objective_scale;
    EXPECT_NEAR(ours, sides, 1e-9 * (1 + std::abs(sides))) << seed;
  }
}

TEST(Form, SortsBoundsAndRanges) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const ProblemData d = SomeProblem(seed);
    const Form form(d);
    const Shape& s = form.shape;
    for (Index k = 0; k < s.vars; ++k) {
      const Index j = form.variable[k];
      const bool below = std::isfinite(d.x_lower[j]), above = std::isfinite(d.x_upper[j]);
      EXPECT_EQ(k < s.boxed, below && above);
      EXPECT_EQ(k < s.bounded, below || above);
      if (k >= s.bounded) continue;
      const double side = below ? d.x_lower[j] : d.x_upper[j];
      EXPECT_NEAR(form.lower[k] * form.column_scale[k], side, 1e-12 * (1 + std::abs(side)));
      if (k < s.boxed) {
        EXPECT_NEAR(form.upper[k] * form.column_scale[k], d.x_upper[j],
                    1e-12 * (1 + std::abs(d.x_upper[j])));
      }
    }
    for (Index r = s.cone_rows; r < s.cone_rows + s.ranges; ++r) {
      const Index i = form.source[r];
      ASSERT_GE(i, 0);
      EXPECT_NEAR(form.range_top[r - s.cone_rows] / form.row_scale[r], d.row_upper[i],
                  1e-12 * (1 + std::abs(d.row_upper[i])));
    }
  }
}

TEST(Form, IsOfTheSizeOfOne) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const Form form(SomeProblem(seed, 2));
    double largest = 0;
    for (const double v : form.A.by_row) largest = std::max(largest, std::abs(v));
    EXPECT_LE(largest, 3) << seed;
    EXPECT_GE(largest, 0.3) << seed;
  }
}

TEST(Form, OfTheSamePatternIsKnownWhateverTheNumbers) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const ProblemData d = SomeProblem(seed);
    ProblemData numbers = d, bound = d, row = d;
    for (double& v : numbers.A.value) v *= -2.5;
    for (double& v : numbers.q) v += 1;
    const Form form(d);
    EXPECT_TRUE(form.SamePattern(Form(numbers)));
    bound.x_lower[0] = std::isfinite(bound.x_lower[0]) ? -kInfinity : bound.x_upper[0] - 1;
    if (bound.x_lower[0] == -kInfinity || std::isfinite(bound.x_lower[0])) {
      EXPECT_FALSE(form.SamePattern(Form(bound))) << seed;
    }
    row.row_lower.push_back(0);
    row.row_upper.push_back(kInfinity);
    row.A = StackRows(row.A, Csc(1, row.num_vars));
    EXPECT_FALSE(form.SamePattern(Form(row)));
  }
}

/// Random numbers for an iterate of the form.
Iterate Random_(const Form& form, Random& random) {
  const Shape& s = form.shape;
  return {Normals(random, s.vars),
          Normals(random, s.equations),
          Normals(random, s.slacks()),
          Normals(random, s.slacks()),
          1.5,
          0.5};
}

Vectors BackOf(const Form& form, const ProblemData& d, const Iterate& at) {
  const Shape& s = form.shape;
  Vector y(static_cast<std::size_t>(s.rows())), bounds(static_cast<std::size_t>(s.vars), 0.0);
  for (Index i = 0; i < s.conic_rows(); ++i) y[i] = at.z[i];
  for (Index i = 0; i < s.ranges; ++i) y[s.cone_rows + i] -= at.z[s.range_tops() + i];
  for (Index i = 0; i < s.equations; ++i) y[s.conic_rows() + i] = at.y[i];
  for (Index j = 0; j < s.bounded; ++j) bounds[j] = at.z[s.lower_bounds() + j];
  for (Index j = 0; j < s.boxed; ++j) bounds[j] -= at.z[s.upper_bounds() + j];
  return Back(form, d, at.x, y, bounds);
}

void ExpectNear(const Values& a, const Values& b) {
  const double size = 1 + std::max(LargestOf(a), LargestOf(b));
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-10 * size) << i;
}

TEST(Carried, IsTheSamePointWithTheSameDualsInTheProblem) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ProblemData d = SomeProblem(seed);
    ProblemData other = d;  // of other units
    for (double& v : other.q) v *= random.Uniform(20, 50);
    for (double& v : other.P.value) v *= random.Uniform(20, 50);
    for (double& v : other.A.value) v *= random.Uniform(0.1, 10);
    for (double& v : other.F.value) v *= random.Uniform(0.1, 10);
    const Form from(d), to(other);
    ASSERT_TRUE(from.SamePattern(to));
    const Iterate at = Random_(from, random);
    const Iterate carried = Carried(at, from, to);
    const Vectors before = BackOf(from, d, at), after = BackOf(to, other, carried);
    ExpectNear(before.x, after.x);
    ExpectNear(before.x_dual, after.x_dual);
    ExpectNear(before.row_dual, after.row_dual);
    ExpectNear(before.cone_dual, after.cone_dual);
    EXPECT_EQ(at.tau, carried.tau);
    const double cost = to.objective_scale / from.objective_scale;
    EXPECT_NEAR(Dot(carried.s, carried.z), cost * Dot(at.s, at.z),
                1e-9 * cost * (1 + std::abs(Dot(at.s, at.z))));
  }
}

TEST(Carried, ToTheSameFormIsTheSame) {
  const Form form(SomeProblem(3));
  Random random(3);
  const Iterate at = Random_(form, random);
  const Iterate carried = Carried(at, form, form);
  EXPECT_EQ(carried.x, at.x);
  EXPECT_EQ(carried.y, at.y);
  EXPECT_EQ(carried.z, at.z);
  EXPECT_EQ(carried.s, at.s);
}

}  // namespace
}  // namespace switchyard::conic
