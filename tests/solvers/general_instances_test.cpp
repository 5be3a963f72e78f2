// Public mixed-integer programs, where they stand beside the source tree: points that hold, between
// the bound and nothing better than the optimum of their reference.csv.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "core/lower/lowering.hpp"
#include "switchyard/io/read.hpp"
#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

struct Reference {
  const char* name;
  double optimum;
};
void PrintTo(const Reference& r, std::ostream* out) { *out << r.name; }

class MixedInteger : public ::testing::TestWithParam<Reference> {};

TEST_P(MixedInteger, PointAndBoundEncloseTheReference) {
  const std::filesystem::path path = std::filesystem::path(SWITCHYARD_INSTANCES) / "milp" /
                                     (std::string(GetParam().name) + ".mps.gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path << " beside the source tree";
  const auto host = HostWith({"clp"});
  if (host->Find("clp") == nullptr) GTEST_SKIP() << "clp was not built";
  const auto program = ReadProgram(path.string());
  const Lowering lowering(*program);
  const double optimum = lowering.maximize() ? -GetParam().optimum : GetParam().optimum;
  const double slack = 1e-5 * (1 + std::abs(optimum));
  const StrategyAnswer answer = RelaxAndRoundOn(*host, lowering.problem().view());
  ASSERT_EQ(answer.status, SY_OK) << answer.error;
  EXPECT_LE(answer.result.bound, optimum + slack);
  EXPECT_GT(answer.result.bound, -kInfinity);
  std::cout << GetParam().name << ": bound " << answer.result.bound << ", optimum " << optimum
            << ", found " << answer.result.objective << "\n";
  if (answer.result.primal != SY_FEASIBLE) {
    EXPECT_EQ(answer.result.termination, SY_RESTRICTIONS_FAILED) << answer.text;
    return;
  }
  EXPECT_GE(answer.result.objective, optimum - slack);
}

INSTANTIATE_TEST_SUITE_P(Small, MixedInteger,
                         ::testing::Values(Reference{"bell5", 8966406.4915},
                                           Reference{"blend2", 7.598985},
                                           Reference{"dcmulti", 188182}, Reference{"enigma", 0},
                                           Reference{"flugpl", 1201500}, Reference{"gt2", 21166},
                                           Reference{"p0548", 8691}, Reference{"rgn", 82.19999924},
                                           Reference{"semicon1", 1.1}, Reference{"sp150x300d", 69}),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace switchyard::test
