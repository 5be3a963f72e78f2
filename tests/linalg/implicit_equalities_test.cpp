// Inequalities that hold with equality everywhere.
#include "core/linalg/implicit_equalities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace switchyard {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

class Polyhedra {
 public:
  double Uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  int Int(int a, int b) { return std::uniform_int_distribution<int>(a, b)(engine_); }

  /// Around a point: `loose` rows with room there; then `groups` of rows whose weighted sum is 0
  /// and that hold with equality there, so that each must: -a_k'x <= ... for the others.
  DenseLp Next(int n, int loose, int groups) {
    DenseLp lp(n);
    tight.clear();
    inside.assign(std::size_t(n), 0);
    for (double& v : inside) v = Uniform(-3, 3);
    for (int i = 0; i < loose; ++i) Add(lp, Direction(n), Uniform(0.1, 1));
    for (int g = 0; g < groups; ++g) {
      std::vector<double> rest(std::size_t(n), 0);
      for (int k = Int(1, 3); k > 0; --k) {
        const std::vector<double> a = Direction(n);
        for (std::size_t j = 0; j < a.size(); ++j) rest[j] -= a[j];
        tight.insert(lp.num_rows());
        Add(lp, a, 0);
      }
      tight.insert(lp.num_rows());
      Add(lp, rest, 0);
    }
    return lp;
  }

  std::set<int> tight;
  std::vector<double> inside;

 private:
  std::vector<double> Direction(int n) {
    std::vector<double> a(std::size_t(n), 0);
    for (double& v : a) v = Uniform(-1, 1);
    return a;
  }
  void Add(DenseLp& lp, const std::vector<double>& a, double room) {
    double value = 0;
    for (std::size_t j = 0; j < a.size(); ++j) value += a[j] * inside[j];
    const bool upper = Uniform(0, 1) < 0.5;  // a'x <= b, or -a'x >= -b
    double* row = upper ? lp.AddRow(-kInf, value + room) : lp.AddRow(-value - room, kInf);
    for (std::size_t j = 0; j < a.size(); ++j) row[j] = upper ? a[j] : -a[j];
  }
  std::mt19937_64 engine_{3};
};

TEST(ImplicitEqualities, AreThoseThatTheConstructionForces) {
  Polyhedra random;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const int n = random.Int(2, 8);
    // Few groups, so that what they leave has a dimension and the loose rows room.
    const DenseLp lp = random.Next(n, random.Int(0, 15), random.Int(0, n / 4 + 1));
    const ImplicitEqualities found = FindImplicitEqualities(lp);
    ASSERT_EQ(found.status, DenseLpStatus::kOptimal);
    std::set<int> rows;
    for (const ImplicitEquality& equality : found.equalities) {
      rows.insert(equality.row);
      const auto i = std::size_t(equality.row);
      EXPECT_TRUE(equality.value == lp.row_lower[i] || equality.value == lp.row_upper[i]);
    }
    EXPECT_EQ(rows, random.tight);
    for (int i = 0; i < lp.num_rows(); ++i) {
      const auto at = std::size_t(i);
      double value = 0;
      for (std::size_t j = 0; j < found.x.size(); ++j) value += lp.row(at)[j] * found.x[j];
      const double room = std::min(value - lp.row_lower[at], lp.row_upper[at] - value);
      if (rows.count(i) != 0) {
        EXPECT_NEAR(room, 0, 1e-7);
      } else {
        EXPECT_GT(room, 1e-7);
      }
    }
  }
}

TEST(ImplicitEqualities, OfAnEmptySetAreNone) {
  DenseLp lp(2);
  lp.AddRow(1, kInf)[0] = 1;
  lp.AddRow(-kInf, 0)[0] = 1;
  EXPECT_EQ(FindImplicitEqualities(lp).status, DenseLpStatus::kInfeasible);
}

TEST(ImplicitEqualities, NameBoundsAndExplicitOnes) {
  DenseLp lp(3);  // x + y <= 0 with x, y >= 0; z = 4; z <= 5
  double* a = lp.AddRow(-kInf, 0);
  a[0] = a[1] = 1;
  lp.x_lower[0] = lp.x_lower[1] = 0;
  lp.x_lower[2] = lp.x_upper[2] = 4;
  lp.AddRow(-kInf, 5)[2] = 1;
  const ImplicitEqualities found = FindImplicitEqualities(lp);
  ASSERT_EQ(found.status, DenseLpStatus::kOptimal);
  std::vector<int> rows;
  for (const ImplicitEquality& equality : found.equalities) rows.push_back(equality.row);
  EXPECT_EQ(rows, (std::vector<int>{0, 2, 3, 4}));
  EXPECT_EQ(found.x, (std::vector<double>{0, 0, 4}));
}

}  // namespace
}  // namespace switchyard
