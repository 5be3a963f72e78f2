// The equations of a step hold, however they are arranged.
#include "solvers/conic/kkt.hpp"

#include <gtest/gtest.h>

#include "solvers/conic/slacks.hpp"
#include "solvers/linalg/workers.hpp"
#include "tests/conic/blocky.hpp"

namespace switchyard::conic {
namespace {

Vector Normals(Random& random, Index n) {
  Vector v(static_cast<std::size_t>(n));
  for (double& e : v) e = random.Normal();
  return v;
}

Triple SomeSide(const Shape& s, Random& random) {
  Triple right(s);
  right.x = Normals(random, s.vars);
  right.y = Normals(random, s.equations);
  right.z = Normals(random, s.slacks());
  return right;
}

/// Cones scaled at a point inside, `share` of the way from the center to the boundary.
ProductCone ScaledCones(const Form& form, Random& random, double share) {
  ProductCone cones(form);
  const auto slacks = static_cast<std::size_t>(form.shape.slacks());
  Vector s(slacks), z(slacks);
  cones.Center(s);
  cones.Center(z);
  const Vector ds = Normals(random, form.shape.slacks()), dz = Normals(random, form.shape.slacks());
  const double step = share * cones.Step(s, z, ds, dz, 1e3);
  double product = 0;
  for (std::size_t i = 0; i < slacks; ++i) {
    s[i] += step * ds[i];
    z[i] += step * dz[i];
    product += s[i] * z[i];
  }
  EXPECT_TRUE(cones.Scale(s, z, product / std::max(1.0, cones.degree())));
  return cones;
}

/// What P dx - E'dy - G'dz = a, E dx = b, G dx + H dz = c leave, the largest entry; of the last
/// without what a step mends.
double LeftBy(const Form& form, const ProductCone& cones, const Triple& right,
              const KktStep& step) {
  const Shape& s = form.shape;
  Vector p_x(step.x.size(), 0.0), a_x(static_cast<std::size_t>(s.rows()));
  Vector columns(step.x.size(), 0.0), rows(a_x.size()), h_z(step.z.size());
  AddProduct(form.P, 1, step.x.data(), p_x.data());
  Multiply(form.A, step.x.data(), a_x.data());
  AddSlackColumns(form, step.y, step.z, nullptr, rows, columns);
  cones.Multiply(step.z, h_z);
  double left = 0;
  for (std::size_t j = 0; j < p_x.size(); ++j) {
    left = std::max(left, std::abs(p_x[j] - columns[j] - right.x[j]));
  }
  for (Index i = 0; i < s.equations; ++i) {
    left = std::max(left, std::abs(a_x[s.conic_rows() + i] - right.y[i]));
  }
  EachSlack(s, step.x, a_x, [&](Index k, double g_x) { h_z[k] += g_x - right.z[k]; });
  cones.Unmended(h_z);
  for (const double e : h_z) left = std::max(left, std::abs(e));
  for (Index i = 0; i < s.rows(); ++i) left = std::max(left, std::abs(a_x[i] - step.a_x[i]));
  return left;
}

double SizeOfStep(const KktStep& step) {
  double size = 1;
  for (const Vector* v : {&step.x, &step.y, &step.z}) {
    for (const double e : *v) size = std::max(size, std::abs(e));
  }
  return size;
}

/// The step for a right side, that of `kkt`, and that its equations hold.
KktStep StepOf(const Form& form, Kkt& kkt, ProductCone& cones, const Triple& right) {
  KktStep step(form.shape);
  kkt.Restart();
  kkt.Factor(cones);
  kkt.Solve(cones, right, {1e-11, 1e-11}, step);
  EXPECT_LE(LeftBy(form, cones, right, step), 1e-9 * SizeOfStep(step));
  return step;
}

void ExpectSameStep(const KktStep& a, const KktStep& b, double tolerance) {
  const double size = SizeOfStep(a);
  const auto near = [&](const Vector& u, const Vector& v, const char* what) {
    for (std::size_t i = 0; i < u.size(); ++i) ASSERT_NEAR(u[i], v[i], tolerance * size) << what;
  };
  near(a.x, b.x, "x");
  near(a.y, b.y, "y");
  near(a.z, b.z, "z");
}

/// No more equations than variables, so that the step is the only one.
ProblemData WithFewEquations(ProblemData d) {
  Index equations = 0;
  for (std::size_t i = 0; i < d.row_lower.size(); ++i) {
    if (d.row_lower[i] == d.row_upper[i] && ++equations > 3) d.row_upper[i] = d.row_lower[i] + 1;
  }
  for (std::size_t j = 0; j < d.x_lower.size(); ++j) {
    if (std::isinf(d.x_lower[j]) && std::isinf(d.x_upper[j])) d.x_lower[j] = -5;
    if (d.x_lower[j] == d.x_upper[j]) d.x_upper[j] += 1;
  }
  return d;
}

class KktOf : public ::testing::TestWithParam<Sort> {};

TEST_P(KktOf, StepEquationsHoldNearThePathAndNearTheBoundary) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    Random random(seed);
    const Form form(WithFewEquations(testing::KnownOptimum(GetParam().shape, random).problem));
    Kkt kkt(form, {});
    for (const double share : {0.0, 0.5, 0.99}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", share " + std::to_string(share));
      ProductCone cones = ScaledCones(form, random, share);
      StepOf(form, kkt, cones, SomeSide(form.shape, random));
    }
  }
}

TEST_P(KktOf, AnotherOfTheSamePatternGivesTheSameStep) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ProblemData d = WithFewEquations(testing::KnownOptimum(GetParam().shape, random).problem);
    ProblemData other = d;
    for (double& v : other.A.value) v *= 1.25;
    const Form first(other), form(d);
    Kkt of_first(first, {});
    ASSERT_TRUE(form.SamePattern(first));
    Kkt alike(form, of_first), own(form, {});
    ProductCone cones = ScaledCones(form, random, 0.5);
    const Triple right = SomeSide(form.shape, random);
    const KktStep a = StepOf(form, alike, cones, right), b = StepOf(form, own, cones, right);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
    EXPECT_EQ(a.z, b.z);
  }
}

TEST_P(KktOf, FactorsOfTwiceTheDigitsGiveTheSameStep) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Form form(WithFewEquations(testing::KnownOptimum(GetParam().shape, random).problem));
    Kkt plain(form, {}), twofold(form, {});
    twofold.TakeMoreDigits();
    ProductCone cones = ScaledCones(form, random, 0.5);
    const Triple right = SomeSide(form.shape, random);
    const KktStep a = StepOf(form, plain, cones, right);
    KktStep b(form.shape);
    twofold.Factor(cones);
    twofold.Solve(cones, right, {1e-11, 1e-11}, b);
    EXPECT_LE(LeftBy(form, cones, right, b), 1e-9 * SizeOfStep(b));
    ExpectSameStep(a, b, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, KktOf, ::testing::ValuesIn(Sorts()),
                         [](const auto& of) { return of.param.name; });

TEST(Kkt, SaysHowMuchIsLeft) {
  constexpr double kGoal = 1e-11;
  for (const Sort& sort : Sorts()) {
    SCOPED_TRACE(sort.name);
    Random random(1);
    const Form form(WithFewEquations(testing::KnownOptimum(sort.shape, random).problem));
    Kkt kkt(form, {});
    ProductCone cones = ScaledCones(form, random, 0.5);
    const Triple right = SomeSide(form.shape, random);
    KktStep step(form.shape);
    kkt.Factor(cones);
    const Kkt::Outcome outcome = kkt.Solve(cones, right, {kGoal, kGoal}, step);
    const double rounding = 1e-14 * SizeOfStep(step) * form.shape.rows();
    EXPECT_LE(LeftBy(form, cones, right, step), kGoal * outcome.left + rounding);
  }
}

TEST(KktWithBlocks, GivesTheStepThatItGivesWithout) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    Random random(seed);
    const Blocky shape{12, 5, static_cast<std::int32_t>(seed % 3), 3, 2, seed % 2 == 0};
    const Form form(WithFewEquations(BlockyOptimum(shape, random).problem));
    const BlockHint constant(shape);
    BlockHint hint(shape);
    std::vector<Index> given;
    for (const Index j : form.variable) given.push_back(hint.x()[j]);
    const Blocks blocks = GivenBlocks(form, given);
    Kkt with(form, blocks), without(form, {});
    for (const double share : {0.0, 0.5, 0.9}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", share " + std::to_string(share));
      ProductCone cones = ScaledCones(form, random, share);
      const Triple right = SomeSide(form.shape, random);
      ExpectSameStep(StepOf(form, without, cones, right), StepOf(form, with, cones, right), 1e-6);
    }
  }
}

}  // namespace
}  // namespace switchyard::conic
