// Clones: the same problem and options, the symbolic phase shared, everything else their own.
#include <gtest/gtest.h>

#include <thread>

#include "tests/conic/evolving.hpp"

namespace switchyard::conic {
namespace {

void ExpectSame(const Found& a, const Found& b) {
  EXPECT_EQ(a.result.termination, b.result.termination);
  EXPECT_EQ(a.result.iterations, b.result.iterations);
  EXPECT_EQ(a.result.objective, b.result.objective);
  EXPECT_EQ(a.at.x, b.at.x);
  EXPECT_EQ(a.at.x_dual, b.at.x_dual);
  EXPECT_EQ(a.at.row_dual, b.at.row_dual);
  EXPECT_EQ(a.at.cone_dual, b.at.cone_dual);
}

KnownAnswer Mixed(unsigned seed) {
  Random random(seed);
  testing::Shape shape{24, 8, {SecondOrder(5), Semidefinite(3), Exponential(), Rotated(4)}};
  shape.quadratic = seed % 2 == 0;
  return testing::KnownOptimum(shape, random);
}

TEST(Clones, ShareTheSymbolicPhaseAndAnswerTheSame) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = Mixed(seed);
    Solver solver(known.problem);
    Solver before = solver.Clone();
    const Found found = solver.Solve();
    ExpectOptimal(known.problem, found);
    Solver after = solver.Clone();
    for (Solver* clone : {&before, &after}) {
      EXPECT_TRUE(clone->shares());
      ExpectSame(clone->Solve(), found);
    }
    EXPECT_TRUE(after.Clone().shares()) << "a clone of a clone";
  }
}

TEST(Clones, KeepTheOptions) {
  const KnownAnswer known = Mixed(2);
  Solver solver(known.problem);
  solver.Set("max_iterations", 3);
  const Found found = solver.Clone().Solve();
  EXPECT_EQ(found.result.termination, SY_ITERATION_LIMIT);
  EXPECT_EQ(found.result.iterations, 3);
}

TEST(Clones, OutliveTheOriginal) {
  const KnownAnswer known = Mixed(3);
  auto original = std::make_unique<Solver>(known.problem, Conic::Describe().updates);
  Solver clone = original->Clone();
  original.reset();
  ExpectOptimal(known.problem, clone.Solve());
}

TEST(Clones, DoNotSeeUpdatesOfTheOriginalNorItTheirs) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Evolving program(seed);
    Solver solver(program.data(), Conic::Describe().updates);
    Solver clone = solver.Clone();
    const Found before = clone.Solve();
    Evolving other = Evolving(seed);
    program.MoveAllBounds();
    program.Append();
    program.Send(solver);
    program.ExpectAsFresh(solver);
    ExpectSame(clone.Solve(), before);
    other.ChangeValues();
    other.RemoveCones(2);
    other.Send(clone);
    other.ExpectAsFresh(clone);
    program.ExpectAsFresh(solver);
  }
}

TEST(Clones, SolveAtTheSameTime) {
  const KnownAnswer known = Mixed(4);
  Solver solver(known.problem, Conic::Describe().updates);
  const Found expected = solver.Clone().Solve();
  constexpr int kClones = 4, kTimes = 25;
  std::vector<Solver> clones;
  for (int k = 0; k < kClones; ++k) clones.push_back(solver.Clone());
  std::vector<Found> found(kClones);
  std::vector<std::thread> threads;
  for (int k = 0; k < kClones; ++k) {
    threads.emplace_back([&, k] {
      for (int time = 0; time < kTimes; ++time) found[k] = clones[k].Solve();
    });
  }
  for (int time = 0; time < kTimes; ++time) ExpectSame(solver.Solve(), expected);
  for (std::thread& thread : threads) thread.join();
  for (const Found& f : found) ExpectSame(f, expected);
}

TEST(Clones, AreUpdatedInTheirThreads) {
  constexpr int kClones = 4;
  const Evolving start(5);
  const Solver solver(start.data(), Conic::Describe().updates);
  std::vector<Solver> clones;
  std::vector<Evolving> programs;
  for (int k = 0; k < kClones; ++k) {
    clones.push_back(solver.Clone());
    programs.emplace_back(5);
    programs.back().random() = Random(static_cast<unsigned>(k));
  }
  std::vector<std::thread> threads;
  for (int k = 0; k < kClones; ++k) {
    threads.emplace_back([&, k] {
      for (int step = 0; step < 5; ++step) {
        programs[k].ChangeCosts();
        programs[k].MoveFiniteBounds();
        programs[k].Send(clones[k]);
        clones[k].Solve();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int k = 0; k < kClones; ++k) programs[k].ExpectAsFresh(clones[k]);
}

TEST(Clones, OfTheSameSolveGiveTheSameVectorsAsASecondLoad) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = Mixed(seed);
    Solver solver(known.problem);
    const Found first = solver.Solve();
    ExpectSame(solver.Solve(), first);
    ExpectSame(Solver(known.problem).Solve(), first);
    ExpectSame(solver.Load(known.problem).Solve(), first);
  }
}

}  // namespace
}  // namespace switchyard::conic
