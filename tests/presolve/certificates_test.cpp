// Rays and contradictions of the reduced problem, carried back.
#include "tests/presolve/programs.hpp"
#include "tests/presolve/solved.hpp"

namespace switchyard::presolve {
namespace {

constexpr double kInf = kInfinity;

Vectors Contradiction(const ProblemData& d, const Presolve& presolve, const Vectors& reduced) {
  EXPECT_LE(testing::ContradictionError(presolve.reduced(), reduced), 1e-12)
      << "of the reduced one";
  const Vectors at = VectorsOf(presolve.Back(AnswerOf(reduced, Meaning::kContradiction)));
  EXPECT_LE(testing::ContradictionError(d, at), 1e-12);
  EXPECT_NEAR(testing::SideSum(d, at), testing::SideSum(presolve.reduced(), reduced), 1e-12);
  return at;
}

Vector Ray(const ProblemData& d, const Presolve& presolve, const Vector& reduced) {
  EXPECT_LE(testing::RayError(presolve.reduced(), reduced), 1e-12) << "of the reduced one";
  const Vector x = presolve.Back(AnswerOf({reduced, {}, {}, {}}, Meaning::kRay)).x;
  EXPECT_LE(testing::RayError(d, x), 1e-12);
  return x;
}

// x_0 + x_1 >= 1 and x_0 - x_1 >= 1 with x_0 <= 0.
Rows Core(std::size_t vars) {
  Rows rows(2, Vector(vars, 0.0));
  rows[0][0] = rows[0][1] = rows[1][0] = 1;
  rows[1][1] = -1;
  return rows;
}

TEST(PresolveCertificates, AContradictionOfBoundsThatWereRows) {
  Rows rows = Core(2);
  rows.push_back({-2, 0});
  const ProblemData d = WithRows(Nearest({0, 0}), rows, {1, 1, 0}, {kInf, kInf, kInf});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
  const Vectors at = Contradiction(d, presolve, {{}, {-2, 0}, {1, 1}, {}});
  EXPECT_EQ(at.row_dual, (Vector{1, 1, 1}));
  EXPECT_EQ(at.x_dual, (Vector{0, 0}));
}

TEST(PresolveCertificates, AContradictionOverParallelRowsAndFixedAndForcedVariables) {
  // x_2 = 4 in both rows, x_3 = x_4 = 0 by force, a row parallel to the first that is tighter.
  Rows rows = Core(5);
  rows[0][2] = 1;
  rows[1][2] = -1;
  rows[0][3] = 3;
  rows[1][4] = -2;
  rows.push_back({-2, -2, -2, -6, 0});
  rows.push_back({0, 0, 0, 1, 1});
  ProblemData d = Nearest(Vector(5, 7.0));
  d.x_lower = {-kInf, -kInf, 4, 0, 0};
  d.x_upper = {0, kInf, 4, 9, kInf};
  d = WithRows(d, rows, {4, -3, -kInf, -kInf}, {kInf, kInf, -10, 0});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
  const Vectors at = Contradiction(d, presolve, {{}, {-2, 0}, {1, 1}, {}});
  EXPECT_EQ(at.row_dual[0], 0);
  EXPECT_EQ(at.row_dual[2], -0.5);
}

TEST(PresolveCertificates, AContradictionPastFreeColumns) {
  // x_2 has a cost and stands in one row; x_3 = x_0 + x_1 / 2 in the first row.
  ProblemData d = Nearest({0, 0, 0, 0}, {1, 1, 0, 0});
  d.q[2] = 5;
  d.x_upper[0] = 0;
  d = WithRows(d, {{0, 0.5, 0, 1}, {1, -1, 0, 0}, {1, 1, 1, 0}, {1, 0.5, 0, -1}}, {1, 1, -3, 0},
               {kInf, kInf, 12, 0});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
  const Vectors at = Contradiction(d, presolve, {{}, {-2, 0}, {1, 1}, {}});
  EXPECT_EQ(at.row_dual, (Vector{1, 1, 0, 1}));
}

// -x_0 falls forever along x_0 = x_1, in x_0 - x_1 <= 0.
TEST(PresolveCertificates, ARayMovesFreeColumnsAsTheirRowsAllow) {
  struct {
    double of_x0, lower, upper, step;  // of the free column
  } const cases[] = {
      {1, 5, 5, -1},     {1, -3, 5, -1},    {1, -kInf, 5, -1}, {1, -5, kInf, 0},
      {-1, -kInf, 5, 0}, {-1, -5, kInf, 1}, {-1, 4, 5, 1},
  };
  for (const auto& c : cases) {
    const ProblemData d = WithRows(Bounded(Costs({-1, 0, 0}), {0, 0, -kInf}, {kInf, kInf, kInf}),
                                   {{1, -1, 0}, {c.of_x0, 0, 1}}, {-kInf, c.lower}, {0, c.upper});
    const Presolve presolve(d, {});
    EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
    EXPECT_EQ(Ray(d, presolve, {1, 1}), (Vector{1, 1, c.step}));
  }
}

TEST(PresolveCertificates, ARayKeepsARowTightWhereAFreeColumnHasACost) {
  const ProblemData d = WithRows(Bounded(Costs({-1, 0, 0.5}), {0, 0, -kInf}, {kInf, kInf, kInf}),
                                 {{1, -1, 0}, {1, 0, 1}}, {-kInf, 3}, {0, kInf});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
  EXPECT_EQ(presolve.reduced().q[0], -1.5);
  EXPECT_EQ(Ray(d, presolve, {1, 1}), (Vector{1, 1, -1}));
}

TEST(PresolveCertificates, ARayDoesNotMoveWhatIsFixed) {
  // x_2 is fixed, and bent with x_3, which the ray leaves alone; x_4 goes to its bound.
  ProblemData d =
      Bounded(Costs({-1, 0, 1, 1, 1}), {0, 0, 6, -kInf, 8}, {kInf, kInf, 6, kInf, kInf});
  d.P = Dense({{0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}, {0, 0, 2, 1, 0}, {0, 0, 0, 1, 0}}, 5);
  d.P.rows = 5;
  d = WithRows(d, {{1, -1, 3, 0, 0}}, {-kInf}, {0});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{3, 1, 0}));
  EXPECT_EQ(Ray(d, presolve, {1, 1, 0}), (Vector{1, 1, 0, 0, 0}));
}

TEST(PresolveCertificates, ARayOfSubstitutedColumns) {
  const ProblemData d = WithRows(Bounded(Costs({0, -1, 0}), {-kInf, 0, 0}, {kInf, kInf, kInf}),
                                 {{1, -1, -1}, {1, 2, -5}}, {1, -kInf}, {1, 20});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
  EXPECT_EQ(Ray(d, presolve, {1, 1}), (Vector{2, 1, 1}));
}

// What presolve finds contradictory is solved whole, where the proof is.
TEST(PresolveCertificates, AContradictionThatPresolveFindsHasAProofInTheWholeProblem) {
  const ProblemData two = Nearest({0, 0});
  for (const ProblemData& d :
       {WithRows(two, {{1, 1}, {1, 1}}, {5, -kInf}, {kInf, 3}),
        Bounded(WithRows(two, {{1, 1}}, {5}, {kInf}), {0, 0}, {2, 2}),
        Bounded(WithRows(two, {{1, 1}}, {5}, {kInf}), {1, 1}, {1, 2}),
        WithCones(WithRows(two, {{1, 0}}, {5}, {kInf}), {{1, 0}, {0, 1}, {1, 1}}, {-3, 0, 1},
                  {{SY_CONE_ZERO, 1, 0}, {SY_CONE_SECOND_ORDER, 2, 0}})}) {
    const Presolve presolve(d, {});
    const Solved solved = Solve(presolve.reduced());
    ASSERT_EQ(solved.ending, conic::Ending::kInfeasible);
    EXPECT_LE(testing::ContradictionError(d, VectorsOf(presolve.Back(solved.answer))), 1e-6);
  }
}

}  // namespace
}  // namespace switchyard::presolve
