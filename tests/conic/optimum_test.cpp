// Optima that are known by construction: found, and shown to be optimal by their duals.
#include <gtest/gtest.h>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

constexpr int kSeeds = 12;

class KnownOptima : public ::testing::TestWithParam<Sort> {
 protected:
  template <class Check>
  void ForSeeds(Check&& check) {
    for (int seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE(seed);
      Random random(static_cast<unsigned>(100 + seed));
      check(testing::KnownOptimum(GetParam().shape, random));
    }
  }
};

TEST_P(KnownOptima, AreFoundWithAndWithoutPresolveAndBlocks) {
  ForSeeds([](const KnownAnswer& known) {
    for (const int options : {0, 1, 2, 3}) {
      SCOPED_TRACE(options);
      Solver solver;
      solver.Set("presolve", options & 1).Set("blocks", options >> 1).Load(known.problem);
      const Found found = solver.Solve();
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    }
  });
}

TEST_P(KnownOptima, AreFoundToTenDigitsOnRequest) {
  ForSeeds([](const KnownAnswer& known) {
    const Found found = Solver(known.problem).Solve(WithTolerance(1e-10));
    ExpectOptimal(known.problem, found, 1e-10);
    ExpectSameOptimum(known.problem, found, OptimumOf(known), 1e-10);
  });
}

TEST_P(KnownOptima, AreFoundWhateverMayBeUpdatedLater) {
  ForSeeds([](const KnownAnswer& known) {
    for (const std::uint64_t updates :
         {std::uint64_t{SY_UPDATES_BOUNDS}, std::uint64_t{SY_UPDATES_VECTORS},
          std::uint64_t{SY_UPDATES_VALUES}, Conic::Describe().updates}) {
      SCOPED_TRACE(updates);
      const Found found = Solver(known.problem, updates).Solve();
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Every, KnownOptima, ::testing::ValuesIn(Sorts()),
                         [](const auto& of) { return of.param.name; });

/// Optima of programs over one cone each.
void ExpectFoundOverEach(const std::vector<sy_cone>& cones) {
  for (std::size_t k = 0; k < cones.size(); ++k) {
    SCOPED_TRACE("dim " + std::to_string(cones[k].dim) + ", parameter " +
                 std::to_string(cones[k].parameter));
    for (unsigned seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed + 7);
      testing::Shape shape{cones[k].dim + 4, 3, {cones[k]}};
      shape.quadratic = seed % 2 == 1;
      const KnownAnswer known = testing::KnownOptimum(shape, random);
      const Found found = Solver(known.problem).Solve();
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    }
  }
}

TEST(Optima, OfSecondOrderConesOfOrders1To20) {
  std::vector<sy_cone> cones;
  for (std::int32_t dim = 1; dim <= 20; ++dim) cones.push_back(SecondOrder(dim));
  ExpectFoundOverEach(cones);
}

TEST(Optima, OfRotatedConesOfOrders2To20) {
  std::vector<sy_cone> cones;
  for (std::int32_t dim = 2; dim <= 20; ++dim) cones.push_back(Rotated(dim));
  ExpectFoundOverEach(cones);
}

TEST(Optima, OfSemidefiniteConesOfOrders1To8) {
  std::vector<sy_cone> cones;
  for (std::int32_t order = 1; order <= 8; ++order) cones.push_back(Semidefinite(order));
  ExpectFoundOverEach(cones);
}

TEST(Optima, OfPowerConesOfManyParameters) {
  std::vector<sy_cone> cones;
  for (const double a : {0.02, 0.1, 0.25, 0.5, 0.6, 0.75, 0.9, 0.98}) cones.push_back(Power(a));
  ExpectFoundOverEach(cones);
}

TEST(Optima, OfManyAlikeConesAndSomeThatAreNot) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    testing::Shape shape{40, 10, std::vector<sy_cone>(21, SecondOrder(4))};
    shape.cones.insert(shape.cones.begin() + 9, Exponential());
    shape.cones.insert(shape.cones.begin() + 4, Semidefinite(3));
    shape.cones.push_back(SecondOrder(7));
    shape.density = 0.2;
    const KnownAnswer known = testing::KnownOptimum(shape, random);
    const Found found = Solver(known.problem).Solve();
    ExpectOptimal(known.problem, found);
    ExpectSameOptimum(known.problem, found, OptimumOf(known));
  }
}

TEST(Optima, DoNotMoveWithTheUnitsOfCostsAndVariables) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    testing::Shape shape{12, 5, {SecondOrder(4), Rotated(3)}};
    shape.quadratic = true;
    const KnownAnswer known = testing::KnownOptimum(shape, random);
    for (const double unit : {1e-3, 1e3}) {
      ProblemData d = known.problem;
      for (double& v : d.q) v *= unit;
      for (double& v : d.P.value) v *= unit;
      d.offset *= unit;
      const Found found = Solver(d).Solve();
      ExpectOptimal(d, found);
      EXPECT_NEAR(found.result.objective, unit * OptimumOf(known),
                  1e-6 * (1 + unit * std::abs(OptimumOf(known))));
    }
  }
}

}  // namespace
}  // namespace switchyard::conic
