// Long random sequences of updates, clones among them.
#include <gtest/gtest.h>

#include "tests/conic/evolving.hpp"

namespace switchyard::conic {
namespace {

void ChangeSomehow(Evolving& program) {
  switch (program.random().Below(9)) {
    case 0:
      return program.MoveAllBounds();
    case 1:
      return program.MoveSingleBounds(3);
    case 2:
      return program.ChangeCosts();
    case 3:
      return program.ChangeValues();
    case 4:
      if (program.Now().num_cones() > 1) program.SwitchCones(1);
      return;
    case 5:
      return program.RemoveRows(1);
    case 6:
      if (program.Now().num_cones() > 2) program.RemoveCones(1);
      return;
    case 7:
      if (program.Now().num_vars < 24) program.Append();
      return;
    default:
      return program.MoveFiniteBounds();
  }
}

class Sequences : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Sequences, OfUpdatesAnswerAsAFreshLoadAtEachEnd) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Evolving program(seed);
    Solver solver(program.data(), GetParam());
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE(step);
      for (int k = program.random().Below(3); k >= 0; --k) ChangeSomehow(program);
      program.Send(solver);
      program.ExpectAsFresh(solver);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST_P(Sequences, OfUpdatesToClonesToo) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Evolving program(seed);
    Solver solver(program.data(), GetParam());
    for (int step = 0; step < 8; ++step) {
      SCOPED_TRACE(step);
      ChangeSomehow(program);
      program.Send(solver);
      if (step % 2 == 0) solver = solver.Clone();  // the original goes
      program.ExpectAsFresh(solver);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ToldOf, Sequences,
                         ::testing::Values(std::uint64_t{0}, Conic::Describe().updates),
                         [](const auto& of) { return of.param == 0 ? "none" : "all"; });

}  // namespace
}  // namespace switchyard::conic
