// Small linear programs: every answer is checked by what proves it, in wider arithmetic.
#include "core/linalg/dense_lp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "switchyard/error.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

enum class Kind { kFeasible, kDegenerate, kIntegers, kEqualities, kScaled, kInfeasible, kCount };

/// Programs of all shapes around a point known to be feasible, or with a contradiction added.
class RandomPrograms {
 public:
  explicit RandomPrograms(unsigned seed) : engine_(seed) {}

  DenseLp Next(Kind kind) {
    const int n = Chance(0.02) ? Int(20, 60) : Int(1, 14);
    const int m = Chance(0.1) ? 0 : Int(1, Chance(0.05) ? 300 : 40);
    DenseLp lp(n);
    inside_.assign(std::size_t(n), 0);
    for (double& v : inside_) v = Number(kind);
    for (std::size_t j = 0; j < lp.c.size(); ++j) {
      lp.c[j] = Chance(0.2) ? 0 : Number(kind);
      if (Chance(0.5)) lp.x_lower[j] = inside_[j] - Slack(kind);
      if (Chance(0.5)) lp.x_upper[j] = inside_[j] + Slack(kind);
      if (Chance(0.05)) lp.x_lower[j] = lp.x_upper[j] = inside_[j];
    }
    for (int i = 0; i < m; ++i) AddRow(lp, kind);
    if (kind == Kind::kInfeasible) Contradict(lp);
    if (kind == Kind::kScaled) Rescale(lp);
    return lp;
  }

  bool Chance(double p) { return std::uniform_real_distribution<double>()(engine_) < p; }
  int Int(int a, int b) { return std::uniform_int_distribution<int>(a, b)(engine_); }
  double Uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }

 private:
  double Number(Kind kind) { return kind == Kind::kIntegers ? Int(-3, 3) : Uniform(-1, 1); }
  double Slack(Kind kind) {
    if (kind == Kind::kIntegers) return Int(0, 2);
    return kind == Kind::kDegenerate && Chance(0.7) ? 0 : Uniform(0, 1);
  }

  void AddRow(DenseLp& lp, Kind kind) {
    const int rows = lp.num_rows();
    double* a = lp.AddRow(-kInf, kInf);
    const auto n = lp.c.size();
    const bool again = rows > 0 && Chance(0.1);
    const double* other = lp.row(again ? std::size_t(Int(0, rows - 1)) : 0);
    double value = 0;
    for (std::size_t j = 0; j < n; ++j) {
      a[j] = again ? other[j] : Chance(0.3) ? 0 : Number(kind);
      value += a[j] * inside_[j];
    }
    if (!Chance(0.4)) lp.row_lower.back() = value - Slack(kind);
    if (!Chance(0.4)) lp.row_upper.back() = value + Slack(kind);
    if (Chance(kind == Kind::kEqualities ? 0.3 : 0.03)) {
      lp.row_lower.back() = lp.row_upper.back() = value;
    }
  }

  /// A row that the sum of some of the others excludes.
  void Contradict(DenseLp& lp) {
    const auto n = lp.c.size();
    std::vector<double> sum(n, 0);
    double bound = 0;
    for (int i = 0; i < lp.num_rows(); ++i) {
      const auto row = std::size_t(i);
      if (!std::isfinite(lp.row_upper[row]) || !Chance(0.5)) continue;
      const double weight = Uniform(0, 1);
      for (std::size_t j = 0; j < n; ++j) sum[j] += weight * lp.row(row)[j];
      bound += weight * lp.row_upper[row];
    }
    double* a = lp.AddRow(bound + Uniform(1e-3, 1), kInf);
    std::copy(sum.begin(), sum.end(), a);
  }

  void Rescale(DenseLp& lp) {
    for (std::size_t j = 0; j < lp.c.size(); ++j) {
      const double by = std::pow(10, Uniform(-3, 3));
      lp.x_lower[j] /= by;
      lp.x_upper[j] /= by;
      lp.c[j] *= by;
      for (std::size_t k = j; k < lp.A.size(); k += lp.c.size()) lp.A[k] *= by;
    }
    for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
      const double by = std::pow(10, Uniform(-4, 4));
      lp.row_lower[i] *= by;
      lp.row_upper[i] *= by;
      for (std::size_t j = 0; j < lp.c.size(); ++j) lp.A[i * lp.c.size() + j] *= by;
    }
  }

  std::mt19937_64 engine_;
  std::vector<double> inside_;
};

/// Rows of [A; I] with their sides.
struct Row {
  std::vector<double> a;
  double lower;
  double upper;
};
std::vector<Row> AllRows(const DenseLp& lp) {
  std::vector<Row> rows;
  const std::size_t n = lp.c.size();
  for (std::size_t i = 0; i < lp.row_lower.size(); ++i) {
    rows.push_back({{lp.row(i), lp.row(i) + n}, lp.row_lower[i], lp.row_upper[i]});
  }
  for (std::size_t j = 0; j < n; ++j) {
    rows.push_back({std::vector<double>(n, 0), lp.x_lower[j], lp.x_upper[j]});
    rows.back().a[j] = 1;
  }
  return rows;
}

struct Sum {
  long double value = 0;
  long double size = 0;
  void Add(long double term) {
    value += term;
    size += std::abs(term);
  }
};
Sum Dot(const std::vector<double>& a, const std::vector<double>& b) {
  Sum sum;
  for (std::size_t j = 0; j < a.size(); ++j) sum.Add((long double)(a[j]) * b[j]);
  return sum;
}

void ExpectFeasible(const DenseLp& lp, const std::vector<double>& x) {
  for (const Row& row : AllRows(lp)) {
    const Sum value = Dot(row.a, x);
    if (std::isfinite(row.lower)) {
      EXPECT_GE(value.value, row.lower - 1e-9L * (value.size + std::abs(row.lower)));
    }
    if (std::isfinite(row.upper)) {
      EXPECT_LE(value.value, row.upper + 1e-9L * (value.size + std::abs(row.upper)));
    }
  }
}

/// The sum of the sides that the multipliers point to, whose columns are share c.
Sum SumOfSides(const DenseLp& lp, const DenseLpAnswer& answer, double share, long double part) {
  std::vector<double> multipliers = answer.row_dual;
  multipliers.insert(multipliers.end(), answer.x_dual.begin(), answer.x_dual.end());
  std::vector<Sum> columns(lp.c.size());
  Sum sides;
  const std::vector<Row> rows = AllRows(lp);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (multipliers[i] == 0) continue;
    const double side = multipliers[i] > 0 ? rows[i].lower : rows[i].upper;
    EXPECT_TRUE(std::isfinite(side)) << "the multiplier of row " << i << " points to no side";
    sides.Add((long double)(multipliers[i]) * side);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      columns[j].Add((long double)(rows[i].a[j]) * multipliers[i]);
    }
  }
  for (std::size_t j = 0; j < columns.size(); ++j) {
    columns[j].Add(-share * lp.c[j]);
    EXPECT_LE(std::abs(columns[j].value), part * columns[j].size);
  }
  return sides;
}

void ExpectProven(const DenseLp& lp, const DenseLpAnswer& answer) {
  switch (answer.status) {
    case DenseLpStatus::kOptimal: {
      ExpectFeasible(lp, answer.x);
      Sum gap = SumOfSides(lp, answer, 1, 1e-9L);
      const Sum cost = Dot(lp.c, answer.x);
      EXPECT_LE(std::abs(cost.value - gap.value), 1e-9L * (cost.size + gap.size));
      EXPECT_NEAR(answer.objective, double(cost.value), 1e-12 * double(cost.size));
      return;
    }
    case DenseLpStatus::kInfeasible:
      EXPECT_GT(SumOfSides(lp, answer, 0, 1e-11L).value, 0);
      return;
    case DenseLpStatus::kUnbounded:
      ExpectFeasible(lp, answer.x);
      EXPECT_LT(Dot(lp.c, answer.ray).value, 0);
      for (const Row& row : AllRows(lp)) {
        const Sum along = Dot(row.a, answer.ray);
        if (std::isfinite(row.lower)) {
          EXPECT_GE(along.value, -1e-9L * along.size);
        }
        if (std::isfinite(row.upper)) {
          EXPECT_LE(along.value, 1e-9L * along.size);
        }
      }
      return;
    case DenseLpStatus::kUndecided:
      return;
  }
}

TEST(DenseLp, ProvesItsAnswersOnTwentyThousandPrograms) {
  RandomPrograms random(5);
  DenseSimplex simplex;
  int count[4] = {0, 0, 0, 0};
  for (int trial = 0; trial < 20000 && !::testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    const Kind kind = Kind(trial % int(Kind::kCount));
    const DenseLp lp = random.Next(kind);
    const DenseLpAnswer& answer = simplex.Solve(lp);
    ++count[int(answer.status)];
    ExpectProven(lp, answer);
    // The programs are feasible, or infeasible, by how they are made.
    if (kind == Kind::kInfeasible) {
      EXPECT_EQ(answer.status, DenseLpStatus::kInfeasible);
    } else {
      EXPECT_NE(answer.status, DenseLpStatus::kInfeasible) << int(kind);
    }
  }
  EXPECT_EQ(count[int(DenseLpStatus::kUndecided)], 0);
  EXPECT_GT(count[int(DenseLpStatus::kOptimal)], 4000);
  EXPECT_GT(count[int(DenseLpStatus::kUnbounded)], 3000);
}

TEST(DenseLp, FindsTheSameOptimumFromWhereTheLastOneWas) {
  RandomPrograms random(6);
  DenseSimplex simplex;
  DenseSimplex again;
  for (int trial = 0; trial < 500; ++trial) {
    DenseLp lp = random.Next(Kind(trial % int(Kind::kInfeasible)));
    again.Solve(lp);
    for (int turn = 0; turn < 5; ++turn) {
      for (double& entry : lp.c) entry = random.Uniform(-1, 1);
      const DenseLpAnswer& second = again.SolveAgain(lp);
      const DenseLpAnswer& first = simplex.Solve(lp);
      ExpectProven(lp, second);
      ASSERT_EQ(second.status, first.status) << trial;
      if (first.status == DenseLpStatus::kOptimal) {
        EXPECT_NEAR(first.objective, second.objective, 1e-7 * (1 + std::abs(first.objective)));
      }
    }
  }
}

DenseLp Square(double lower, double upper) {
  DenseLp lp(2);
  lp.x_lower = {lower, lower};
  lp.x_upper = {upper, upper};
  return lp;
}

TEST(DenseLp, KnowsTheCornersOfASquare) {
  DenseLp lp = Square(-1, 2);
  lp.c = {1, -3};
  DenseSimplex simplex;
  const DenseLpAnswer& answer = simplex.Solve(lp);
  ASSERT_EQ(answer.status, DenseLpStatus::kOptimal);
  EXPECT_EQ(answer.x, (std::vector<double>{-1, 2}));
  EXPECT_EQ(answer.objective, -7);
}

// Beale's program, on which the largest slope and the lowest row cycle for ever.
TEST(DenseLp, EndsWhereThePlainRuleCycles) {
  DenseLp lp(4);
  lp.c = {-0.75, 150, -0.02, 6};
  lp.x_lower = {0, 0, 0, 0};
  const double rows[3][4] = {{0.25, -60, -0.04, 9}, {0.5, -90, -0.02, 3}, {0, 0, 1, 0}};
  for (const auto& row : rows) std::copy(row, row + 4, lp.AddRow(-kInf, &row == rows + 2 ? 1 : 0));
  DenseSimplex simplex;
  const DenseLpAnswer& answer = simplex.Solve(lp);
  ASSERT_EQ(answer.status, DenseLpStatus::kOptimal);
  EXPECT_NEAR(answer.objective, -0.05, 1e-12);
}

// Klee and Minty's cube: exponentially many vertices in the way of a greedy rule.
TEST(DenseLp, SolvesTheCubesOfKleeAndMinty) {
  DenseSimplex simplex;
  for (int n = 1; n <= 8; ++n) {
    DenseLp lp(n);
    for (int i = 0; i < n; ++i) {
      lp.x_lower[std::size_t(i)] = 0;
      lp.c[std::size_t(i)] = -std::pow(10, n - 1 - i);
      double* a = lp.AddRow(-kInf, std::pow(100, i));
      for (int j = 0; j < i; ++j) a[j] = 2 * std::pow(10, i - j);
      a[i] = 1;
    }
    const DenseLpAnswer& answer = simplex.Solve(lp);
    ASSERT_EQ(answer.status, DenseLpStatus::kOptimal);
    EXPECT_NEAR(answer.objective, -std::pow(100, n - 1), 1e-9 * std::pow(100, n - 1));
  }
}

TEST(DenseLp, SaysThatNothingIsThere) {
  DenseLp empty(0);
  DenseSimplex simplex;
  EXPECT_EQ(simplex.Solve(empty).status, DenseLpStatus::kOptimal);
  empty.AddRow(1, 2);  // 0 in [1, 2]
  EXPECT_EQ(simplex.Solve(empty).status, DenseLpStatus::kInfeasible);
}

TEST(DenseLp, NamesTheSidesThatCross) {
  DenseLp lp = Square(-1, 2);
  lp.x_lower[1] = 3;
  try {
    DenseSimplex().Solve(lp);
    FAIL();
  } catch (const InvalidArgument& e) {
    EXPECT_STREQ(e.what(), "linear program: the lower side of variable 1 is 3, the upper one 2");
  }
}

/// The same program for a backend.
MathematicalProgramResult BySolver(const DenseLp& lp) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(lp.num_vars());
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  program.AddLinearCost(vector(lp.c), 0, x);
  program.AddBoundingBoxConstraint(vector(lp.x_lower), vector(lp.x_upper), x);
  if (lp.num_rows() > 0) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXd A = Eigen::Map<const RowMajor>(lp.A.data(), lp.num_rows(), lp.num_vars());
    program.AddLinearConstraint(A, vector(lp.row_lower), vector(lp.row_upper), x);
  }
  return Solve(program);
}

TEST(DenseLp, AgreesWithABackend) {
  setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);
  RandomPrograms random(7);
  DenseSimplex simplex;
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const DenseLp lp = random.Next(Kind(trial % int(Kind::kCount)));
    const DenseLpAnswer& answer = simplex.Solve(lp);
    if (answer.status != DenseLpStatus::kOptimal) continue;
    const MathematicalProgramResult result = BySolver(lp);
    if (result.termination != Termination::kOptimal) continue;
    ++compared;
    double size = 0;
    for (std::size_t j = 0; j < lp.c.size(); ++j) size += std::abs(lp.c[j] * answer.x[j]);
    EXPECT_NEAR(answer.objective, result.objective, 1e-6 * (1 + size)) << trial;
  }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace switchyard
