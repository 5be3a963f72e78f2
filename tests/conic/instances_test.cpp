// Public instances, where they stand beside the source tree: the optimum of their reference.csv,
// with certificates.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "core/lower/lowering.hpp"
#include "switchyard/io/read.hpp"
#include "tests/conic/driver.hpp"

namespace switchyard::conic {
namespace {

const std::filesystem::path kRoot = SWITCHYARD_INSTANCES;

/// "class/instance" to what reference.csv says of it.
const std::map<std::string, std::string>& References() {
  static const std::map<std::string, std::string> references = [] {
    std::map<std::string, std::string> read;
    std::ifstream file(kRoot / "reference.csv");
    for (std::string line; std::getline(file, line);) {
      std::istringstream row(line);
      std::string sort, name, optimum;
      std::getline(row, sort, ',');
      std::getline(row, name, ',');
      std::getline(row, optimum, ',');
      read[sort + "/" + name] = optimum;
    }
    return read;
  }();
  return references;
}

/// Of numbers as large as an instance's: each error beside its terms, as the solver judges, is
/// recomputed from the objective's two sides.
void ExpectOptimalTo(const ProblemData& d, const Found& found, double tolerance) {
  ASSERT_EQ(found.result.termination, SY_OPTIMAL) << found.text;
  Vectors at = found.at;
  const double size = SizeOf(d, at);
  DropOpenDuals(d, tolerance * size, at);
  EXPECT_LE(testing::PrimalError(d, at.x), tolerance * size);
  EXPECT_LE(testing::ConeDualError(d, at.cone_dual), tolerance * size);
  const double objective = Objective(Problem(d).view(), at.x.data());
  const double dual =
      d.offset - 0.5 * QuadraticForm(d.P.View(), at.x.data()) + testing::SideSum(d, at);
  EXPECT_NEAR(objective, dual, 1e-7 * (1 + std::abs(objective)));
  EXPECT_NEAR(found.result.objective, objective, 1e-9 * (1 + std::abs(objective)));
}

class Instances : public ::testing::TestWithParam<const char*> {};

TEST_P(Instances, HaveTheirReference) {
  const std::filesystem::path path = kRoot / (std::string(GetParam()) + ".gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path << " beside the source tree";
  const std::string reference = References().at(GetParam());
  const auto program = ReadProgram(path.string());
  const Lowering lowering(*program);
  const ProblemData& d = lowering.problem().data();
  const Found found = Solver(d).Solve();
  if (reference == "infeasible") return ExpectContradiction(d, found);
  if (reference == "unbounded") return ExpectRay(d, found);
  ExpectOptimalTo(d, found, 1e-8);
  if (reference.empty()) return;  // the certificate says it
  const double sign = lowering.maximize() ? -1 : 1;
  const double optimum = sign * std::stod(reference);
  EXPECT_NEAR(found.result.objective, optimum, 1e-6 * (1 + std::abs(optimum)));
}

INSTANTIATE_TEST_SUITE_P(Small, Instances,
                         ::testing::Values("lp/afiro.mps", "lp/galenet.mps", "lp/forest6.mps",
                                           "lp/bgetam.mps", "lp/gas11.mps", "lp/e226.mps",
                                           "lp/standata.mps", "qp/HS21.qps", "qp/HS76.qps",
                                           "qp/HS268.qps", "qp/CVXQP1_S.qps", "qp/QADLITTL.qps",
                                           "qp/QSC205.qps", "qp/DUALC1.qps", "qp/QSHARE2B.qps",
                                           "qp/LOTSCHD.qps", "socp/nql30.cbf",
                                           "socp/chainsing_1000_2.cbf", "socp/qssp30.cbf"),
                         [](const auto& of) {
                           std::string name = of.param;
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace switchyard::conic
