// Threads that share a loop, and what they share: parts of a tree of fronts, rows, blocks.
#include "solvers/linalg/workers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <thread>

#include "solvers/linalg/block_ldl.hpp"
#include "solvers/linalg/ordering.hpp"
#include "solvers/linalg/subtrees.hpp"
#include "tests/linalg/bordered.hpp"
#include "tests/linalg/twofold_matrices.hpp"

namespace switchyard::linalg {
namespace {

TEST(Workers, DoEachOnce) {
  for (const int threads : {0, 1, 2, 5}) {
    Workers workers(threads);
    EXPECT_GE(workers.threads(), 1);
    for (std::size_t count = 0; count < 200; ++count) {
      std::vector<int> done(count, 0);
      workers.Each(count, [&](std::size_t i) { ++done[i]; });
      EXPECT_EQ(done, std::vector<int>(count, 1));
    }
  }
}

// Loops that follow each other at once, and after those who wait have fallen asleep.
TEST(Workers, SeeWhatTheLoopBeforeLeft) {
  Workers workers(3);
  std::vector<long> v(1000, 1);
  for (int round = 0; round < 300; ++round) {
    workers.Each(v.size(), [&](std::size_t i) { ++v[i]; });
    if (round % 100 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(v, std::vector<long>(1000, 301));
}

TEST(EachPart, CoversEveryNumberOnce) {
  Workers workers(2);
  for (Workers* shared : {static_cast<Workers*>(nullptr), &workers}) {
    for (const std::size_t count : {0, 1, 9, 10, 11, 95}) {
      std::vector<int> done(count, 0);
      EachPart(shared, count, 10, [&](std::size_t begin, std::size_t end) {
        EXPECT_LT(begin, end);
        for (std::size_t i = begin; i < end; ++i) ++done[i];
      });
      EXPECT_EQ(done, std::vector<int>(count, 1));
    }
  }
}

Signed Grid(Random& random, Index width, Index height) {
  return Quasidefinite(random, RandomSigns(random, width * height), GridPairs(width, height));
}

TEST(Subtrees, AreWholeAndApart) {
  Random random(3);
  for (const auto& [width, height] : {std::pair{60, 70}, {9, 900}, {5, 5}, {1, 1}}) {
    const Signed k = Grid(random, width, height);
    const Elimination e = Eliminate(k.pattern, MinimumDegreeOrder(k.pattern));
    const Supernodes tree = FindSupernodes(e);
    const Subtrees found = FindSubtrees(tree, k.pattern.n);
    EXPECT_EQ(found.parts.size() > 3, k.pattern.n > 1000);
    std::vector<int> part_of(tree.nodes.size(), -1);
    for (std::size_t p = 0; p < found.parts.size(); ++p) {
      for (std::size_t s = found.parts[p].begin; s < found.parts[p].end; ++s) {
        EXPECT_EQ(part_of[s], -1);
        part_of[s] = static_cast<int>(p);
      }
    }
    EXPECT_EQ(std::count(part_of.begin(), part_of.end(), -1),
              static_cast<std::ptrdiff_t>(found.top.size()));
    for (const std::size_t s : found.top) EXPECT_EQ(part_of[s], -1);
    Index places = 0;
    for (std::size_t s = 0; s < tree.nodes.size(); ++s) {
      const Supernode& node = tree.nodes[s];
      if (part_of[s] < 0) continue;
      const Subtrees::Part& part = found.parts[part_of[s]];
      if (node.parent >= 0) {  // in the part, or above all
        EXPECT_TRUE(part_of[node.parent] == part_of[s] || part_of[node.parent] == -1);
      }
      const Supernode& last = tree.nodes[part.end - 1];
      for (Index r = 0; r < node.rows; ++r) {
        const Index row = tree.row[node.row_start + r], place = found.row[node.row_start + r];
        if (row < last.first + last.pivots) {
          EXPECT_EQ(place, row);
        } else {
          EXPECT_EQ(part.above[place - part.first_place], row);
        }
      }
    }
    for (const Subtrees::Part& part : found.parts) {
      EXPECT_EQ(part.first_place, k.pattern.n + places);
      places += static_cast<Index>(part.above.size());
    }
    EXPECT_EQ(found.room, k.pattern.n + places);
  }
}

/// What factors of `k` say to one right side, shared by so many threads; what is left is small.
template <class Matrix, class Factors>
std::vector<double> SolutionBy(Factors& factors, const Matrix& k, const Numbers& values,
                               int threads) {
  Workers workers(threads);
  EXPECT_EQ(factors.Factor(values, {}, &workers), 0);
  std::vector<double> x(k.pattern.n), low(x.size(), 0.0);
  std::iota(x.begin(), x.end(), 1.0);
  const Eigen::Map<Eigen::VectorXd> at(x.data(), k.pattern.n);
  const Eigen::VectorXd b = at;
  if constexpr (std::is_same_v<Factors, Ldl>) {
    factors.Solve(x.data(), low.data(), &workers);
  } else {
    factors.Solve({x.data(), low.data()}, &workers);
  }
  Eigen::VectorXd left = b;
  ForEntries(k.pattern, [&](Index i, Index j, Index e) {
    left[i] -= values.high[e] * x[j];
    if (i != j) left[j] -= values.high[e] * x[i];
  });
  EXPECT_LE(left.norm(), 1e-11 * b.norm());
  return x;
}

TEST(Factors, AreTheSameWithMoreThreads) {
  Random random(8);
  const Signed k = Grid(random, 60, 70);
  const std::vector<double> low(k.value.size(), 0.0);
  for (const Numbers& values : {Numbers{k.value.data(), nullptr}, {k.value.data(), low.data()}}) {
    Ldl factors(k.pattern, k.sign, {});
    const std::vector<double> x = SolutionBy(factors, k, values, 1);
    EXPECT_EQ(SolutionBy(factors, k, values, 2), x);
    EXPECT_EQ(SolutionBy(factors, k, values, 4), x);
  }
}

TEST(Factors, OfBlocksAreTheSameWithMoreThreads) {
  Random random(9);
  const Bordered shape = RandomBordered(random, {{12, 5, 700, 0.3}, {6, 3, 300, 0.5}}, 300, 0.02);
  const Signed k = Quasidefinite(random, shape.sign, shape.pairs);
  const std::vector<double> low(k.value.size(), 0.0);
  for (const Numbers& values : {Numbers{k.value.data(), nullptr}, {k.value.data(), low.data()}}) {
    BlockLdl factors(k.pattern, k.sign, {}, shape.block, shape.count);
    const std::vector<double> x = SolutionBy(factors, k, values, 1);
    EXPECT_EQ(SolutionBy(factors, k, values, 2), x);
    EXPECT_EQ(SolutionBy(factors, k, values, 4), x);
  }
}

}  // namespace
}  // namespace switchyard::linalg
