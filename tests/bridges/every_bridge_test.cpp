// What holds of every bridge in the table, over random problems with a known answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/bridges/bridge.hpp"
#include "core/problem/difference.hpp"
#include "core/solve/tangent.hpp"
#include "tests/support/known_answers.hpp"

namespace switchyard::testing {
namespace {

constexpr unsigned kSeeds = 20;
constexpr double kTight = 1e-9;  // of problems whose numbers are about 1

const Shape& Everything() {
  static const Shape shape = {.vars = 7, .rows = 6, .cones = AllCones(), .quadratic = true};
  return shape;
}

void ExpectNear(const Vector& left, const Vector& right, const char* what) {
  ASSERT_EQ(left.size(), right.size()) << what;
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_NEAR(left[i], right[i], kTight) << what << " at " << i;
  }
}

void NaNToZero(Vectors& v) {
  for (Vector* part : {&v.x, &v.x_dual, &v.row_dual, &v.cone_dual}) {
    for (double& e : *part) e = std::isnan(e) ? 0 : e;
  }
}

/// The image with functions at their tangents, and the duals of that: a point is an optimum of the
/// one where it is of the other.
ProblemData WithoutFunctions(const ProblemData& image, Vectors& v) {
  if (image.nlp == nullptr) return image;
  const auto tangent = TangentProblem(Problem(image).view(), v.x);
  if (!tangent.has_value()) return {};
  DualsOfTangentProblem(v);
  return tangent->data();
}

class EveryBridge : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] const BridgeKind& kind() const { return BridgeKinds()[GetParam()]; }
  [[nodiscard]] Bridged Apply(const ProblemData& d) const { return kind().apply(d); }
};

TEST_P(EveryBridge, RemovesWhatItSaysAndAddsNothingElse) {
  Random random(1);
  const KnownAnswer known = KnownOptimum(Everything(), random);
  const Problem problem(known.problem);
  const Features before = FeaturesOf(problem.view());
  const auto bridge = kind().apply(problem.data());
  const Features after = FeaturesOf(Problem(bridge.image).view());
  EXPECT_EQ(after & kind().removes, Features{0});
  EXPECT_EQ(after & ~(before | kind().adds), Features{0});
}

TEST_P(EveryBridge, IsAPureMap) {
  Random random(2);
  const KnownAnswer known = KnownOptimum(Everything(), random);
  EXPECT_EQ(ProblemDifference(Apply(known.problem).image, Apply(known.problem).image), 0u);
}

TEST_P(EveryBridge, TakesAnOptimumToAnOptimumOfTheSameObjective) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const KnownAnswer known = KnownOptimum(Everything(), random);
    ASSERT_LT(OptimumError(known.problem, known.at), kTight);
    const auto bridge = Apply(known.problem);
    Vectors v = known.at;
    bridge.maps->Forward(v);
    const Vectors image_point = v;
    const ProblemData image = WithoutFunctions(bridge.image, v);
    EXPECT_LT(OptimumError(image, v), kTight) << seed;
    v = image_point;
    EXPECT_NEAR(Objective(Problem(bridge.image).view(), v.x.data()),
                Objective(Problem(known.problem).view(), known.at.x.data()), kTight);
  }
}

TEST_P(EveryBridge, ComesBackToWhereItStarted) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const KnownAnswer known = KnownOptimum(Everything(), random);
    const auto bridge = Apply(known.problem);
    Vectors v = known.at;
    bridge.maps->Forward(v);
    bridge.maps->Back(v);
    ExpectNear(v.x, known.at.x, "x");
    ExpectNear(v.x_dual, known.at.x_dual, "x_dual");
    ExpectNear(v.row_dual, known.at.row_dual, "row_dual");
    ExpectNear(v.cone_dual, known.at.cone_dual, "cone_dual");
  }
}

// Duals of the image at any quality: what they combine to, column by column, and what they are
// worth must be the same in the original, so that a bound proven there is proven here. Two sides of
// one row that are both charged cancel, which only gains.
TEST_P(EveryBridge, BringsDualsBackAtTheirWorth) {
  if ((kind().adds & SY_ACCEPTS_NLP) != 0) GTEST_SKIP() << "functions have no certificates";
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    Shape shape = Everything();
    shape.quadratic = false;
    const KnownAnswer known = KnownOptimum(shape, random);
    const auto bridge = Apply(known.problem);
    const ProblemData& image = bridge.image;
    Vectors v;
    v.x_dual.assign(image.q.size(), 0.0);
    for (std::size_t j = 0; j < image.q.size(); ++j) {
      if (image.x_lower.empty()) {
        v.x_dual[j] = 0.01 * random.Normal();  // what is left of stationarity at an early stop
      } else if (image.x_lower[j] > -kInfinity) {
        v.x_dual[j] = std::abs(random.Normal());
      }
    }
    for (std::size_t i = 0; i < image.row_lower.size(); ++i) {
      const double y = std::abs(random.Normal());
      v.row_dual.push_back(image.row_lower[i] > -kInfinity  ? y
                           : image.row_upper[i] < kInfinity ? -y
                                                            : 0);
    }
    for (const sy_cone& cone : image.cones) {
      const Pair pair = ComplementaryPair(cone, random);
      v.cone_dual.insert(v.cone_dual.end(), pair.z.begin(), pair.z.end());
    }
    Vector combined = Combined(image, v);
    combined.resize(known.problem.q.size());
    const double worth = SideSum(image, v);
    bridge.maps->Back(v);
    ExpectNear(Combined(known.problem, v), combined, "combined duals");
    EXPECT_LT(ConeDualError(known.problem, v.cone_dual), kTight);
    if (std::isfinite(worth)) {
      EXPECT_GE(SideSum(known.problem, v), worth - kTight);
    }
  }
}

TEST_P(EveryBridge, TakesAContradictionThereAndBack) {
  if ((kind().adds & SY_ACCEPTS_NLP) != 0) GTEST_SKIP() << "functions have no certificates";
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const KnownAnswer known = KnownContradiction(Everything(), random);
    ASSERT_LT(ContradictionError(known.problem, known.at), kTight);
    const auto bridge = Apply(known.problem);
    Vectors v = known.at;
    bridge.maps->Forward(v);
    NaNToZero(v);
    EXPECT_LT(ContradictionError(bridge.image, v), kTight) << seed;
    bridge.maps->Back(v);
    EXPECT_LT(ContradictionError(known.problem, v), kTight) << seed;
    EXPECT_NEAR(SideSum(known.problem, v), 1, kTight);
  }
}

TEST_P(EveryBridge, TakesARayThereAndBack) {
  if ((kind().adds & SY_ACCEPTS_NLP) != 0) GTEST_SKIP() << "functions have no certificates";
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const KnownAnswer known = KnownRay(Everything(), random);
    ASSERT_LT(RayError(known.problem, known.at.x), kTight);
    const auto bridge = Apply(known.problem);
    Vectors v = known.at;
    bridge.maps->Forward(v);
    EXPECT_LT(RayError(bridge.image, v.x), kTight) << seed;
    bridge.maps->Back(v);
    EXPECT_EQ(v.x, known.at.x);
  }
}

TEST_P(EveryBridge, AppendsVariablesAndLeavesTheOthersAsTheyAre) {
  Random random(3);
  KnownAnswer known = KnownOptimum(Everything(), random);
  ProblemData& d = known.problem;
  d.integer = {0, 1, 0, 0, 1, 0, 1};
  const auto bridge = Apply(d);
  const ProblemData& image = bridge.image;
  const auto n = static_cast<std::ptrdiff_t>(d.q.size());
  ASSERT_GE(image.num_vars, d.num_vars);
  EXPECT_EQ(Vector(image.q.begin(), image.q.begin() + n), d.q);
  EXPECT_EQ(image.offset, d.offset);
  EXPECT_EQ(std::vector<std::uint8_t>(image.integer.begin(), image.integer.begin() + n), d.integer);
  EXPECT_TRUE(std::all_of(image.integer.begin() + n, image.integer.end(),
                          [](std::uint8_t i) { return i == 0; }));
  if ((kind().removes & SY_ACCEPTS_BOUNDS) == 0) {
    EXPECT_EQ(Vector(image.x_lower.begin(), image.x_lower.begin() + n), d.x_lower);
    EXPECT_EQ(Vector(image.x_upper.begin(), image.x_upper.begin() + n), d.x_upper);
  }
}

// Other numbers where there were numbers, sides that were equal still equal: an update, never
// another structure. (A quadratic objective's factor has as many rows as P has rank: a diagonal P
// keeps its rank.)
TEST_P(EveryBridge, HasAPatternThatDoesNotDependOnTheNumbers) {
  Random random(4);
  KnownAnswer known = KnownOptimum(Everything(), random);
  ProblemData& d = known.problem;
  d.P = Csc(d.num_vars, d.num_vars);
  for (std::int32_t j = 0; j < d.num_vars; ++j) {
    d.P.row.push_back(j);
    d.P.value.push_back(1);
    d.P.start[static_cast<std::size_t>(j) + 1] = j + 1;
  }
  ProblemData other = d;
  for (Vector* numbers : {&other.A.value, &other.F.value, &other.q, &other.g}) {
    for (double& e : *numbers) e = random.Normal();
  }
  for (double& e : other.P.value) e = random.Uniform(0.5, 2);
  other.F.value[0] = other.A.value[0] = 0;
  for (Vector* sides : {&other.x_lower, &other.x_upper, &other.row_lower, &other.row_upper}) {
    for (double& side : *sides) side += 0.5;
  }
  EXPECT_NE(ProblemDifference(Apply(d).image, Apply(other).image), kStructureChanged);
}

TEST_P(EveryBridge, LeavesWhatIsNotThereNotThere) {
  Random random(5);
  const KnownAnswer known = KnownOptimum(Everything(), random);
  const auto bridge = Apply(known.problem);
  Vectors v;
  v.x = known.at.x;
  bridge.maps->Forward(v);
  EXPECT_TRUE(v.x_dual.empty() && v.row_dual.empty() && v.cone_dual.empty());
  bridge.maps->Back(v);
  EXPECT_EQ(v.x, known.at.x);
  EXPECT_TRUE(v.x_dual.empty() && v.row_dual.empty() && v.cone_dual.empty());
}

std::string NameOf(const ::testing::TestParamInfo<std::size_t>& info) {
  std::string name = BridgeKinds()[info.param].name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Table, EveryBridge, ::testing::Range<std::size_t>(0, BridgeKinds().size()),
                         NameOf);

}  // namespace
}  // namespace switchyard::testing
