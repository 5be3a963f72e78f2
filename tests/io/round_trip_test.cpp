// What is read, written and read again is the same program.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"
#include "tests/io/same_program.hpp"

namespace switchyard::io {
namespace {

using switchyard::testing::Difference;
using switchyard::testing::DifferenceOfNames;

void ExpectThereAndBack(const MathematicalProgram& program, FileFormat format, bool names) {
  const std::string text = ProgramText(program, format);
  const auto again = ReadProgramText(text, "written", {.format = format});
  EXPECT_EQ(Difference(program, *again), "");
  if (names) {
    EXPECT_EQ(DifferenceOfNames(program, *again), "");
  }
}

std::vector<std::filesystem::path> Instances(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  const std::filesystem::path root = std::filesystem::path(SWITCHYARD_INSTANCES) / folder;
  if (std::filesystem::is_directory(root)) {
    for (const auto& entry : std::filesystem::directory_iterator(root)) paths.push_back(entry);
  }
  return paths;
}

void ExpectInstancesThereAndBack(std::initializer_list<const char*> folders, FileFormat format) {
  int count = 0;
  for (const char* folder : folders) {
    for (const auto& path : Instances(folder)) {
      SCOPED_TRACE(path.filename().string());
      ExpectThereAndBack(*ReadProgram(path.string()), format, format == FileFormat::kMps);
      ++count;
    }
  }
  if (count == 0) GTEST_SKIP() << "no instances beside the source tree";
}

TEST(RoundTrip, KeepsTheLinearAndQuadraticInstances) {
  ExpectInstancesThereAndBack({"lp", "milp", "qp"}, FileFormat::kMps);
}

TEST(RoundTrip, KeepsTheConicInstances) {
  ExpectInstancesThereAndBack({"socp", "misocp"}, FileFormat::kCbf);
}

TEST(RoundTrip, HoldsNoQuadraticInstanceInCbf) {
  for (const auto& path : Instances("qp")) {
    const auto program = ReadProgram(path.string());
    const auto reasons = CannotHold(*program, FileFormat::kCbf);
    if (reasons.empty()) continue;
    EXPECT_EQ(reasons, std::vector<std::string>{"costs that are quadratic: 1"}) << path;
  }
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int Below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(engine_); }
  double Number() {
    const double number = std::normal_distribution<double>()(engine_);
    return Below(3) == 0 ? std::round(4 * number) : number;
  }
  SparseMatrix Matrix(int rows, int cols) {
    std::vector<Eigen::Triplet<double>> triplets;
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < cols; ++j) {
        if (Below(2) == 0) triplets.emplace_back(i, j, Number());
      }
    }
    SparseMatrix M(rows, cols);
    M.setFromTriplets(triplets.begin(), triplets.end());
    M.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
    return M;
  }
  Eigen::VectorXd Vector(int size) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return Number(); });
  }
  // Sides of every kind: none, one, both, equal.
  void Sides(int size, Eigen::VectorXd* lower, Eigen::VectorXd* upper, bool free_too) {
    *lower = Vector(size);
    *upper = *lower;
    for (Eigen::Index i = 0; i < size; ++i) {
      const int kind = Below(free_too ? 5 : 4);
      if (kind == 1 || kind == 4) (*lower)(i) = -std::numeric_limits<double>::infinity();
      if (kind == 2 || kind == 4) (*upper)(i) = std::numeric_limits<double>::infinity();
      if (kind == 3) (*upper)(i) += std::abs(Number()) + 0.1;
    }
  }

 private:
  std::mt19937 engine_;
};

TEST(RoundTrip, KeepsRandomProgramsOfMps) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    MathematicalProgram program;
    const int n = 1 + random.Below(8);
    std::vector<std::string> names;
    std::vector<VariableType> types;
    for (int j = 0; j < n; ++j) {
      names.push_back("column" + std::to_string(j));
      types.push_back(static_cast<VariableType>(random.Below(3)));
    }
    const auto x = program.NewVariables(names, types);
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
    random.Sides(n, &lower, &upper, true);
    program.AddBoundingBoxConstraint(lower, upper, x);
    for (int k = random.Below(3); k > 0; --k) {
      const int rows = random.Below(5);
      random.Sides(rows, &lower, &upper, false);
      program.AddLinearConstraint(random.Matrix(rows, n), lower, upper, x);
    }
    for (int k = random.Below(3); k > 0; --k) {
      program.AddLinearCost(random.Vector(n), random.Number(), x);
    }
    if (random.Below(2) == 0) {
      program.AddQuadraticCost(random.Matrix(n, n), random.Vector(n), random.Number(), x);
    }
    if (random.Below(2) == 0) program.set_objective_sense(ObjectiveSense::kMaximize);
    std::vector<std::string> notes;
    const std::string text = ProgramText(program, FileFormat::kMps, &notes);
    const auto again = ReadProgramText(text, "written.mps");
    bool rounded = false;
    for (const std::string& note : notes) rounded |= note.starts_with("one side of a row moves");
    if (!rounded) {
      EXPECT_EQ(Difference(program, *again), "") << text;
    }
  }
}

void AddRandomCone(Random* random, MathematicalProgram* program, const VectorXDecisionVariable& x) {
  const int n = static_cast<int>(x.size());
  const auto affine = [&](int rows, auto add) {
    add(random->Matrix(rows, n), random->Vector(rows));
  };
  switch (random->Below(5)) {
    case 0:
      return affine(1 + random->Below(4), [&](const SparseMatrix& A, const Eigen::VectorXd& b) {
        program->AddLorentzConeConstraint(A, b, x);
      });
    case 1:
      return affine(2 + random->Below(3), [&](const SparseMatrix& A, const Eigen::VectorXd& b) {
        program->AddRotatedLorentzConeConstraint(A, b, x);
      });
    case 2:
      return affine(3, [&](const SparseMatrix& A, const Eigen::VectorXd& b) {
        program->AddExponentialConeConstraint(A, b, x);
      });
    case 3:
      return affine(3, [&](const SparseMatrix& A, const Eigen::VectorXd& b) {
        program->AddPowerConeConstraint(A, b, 0.01 * (1 + random->Below(99)), x);
      });
    default:
      break;
  }
}

Eigen::MatrixXd RandomSymmetric(Random* random, int size) {
  const Eigen::MatrixXd M = random->Matrix(size, size);
  return M + M.transpose();
}

TEST(RoundTrip, KeepsRandomProgramsOfCbf) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    MathematicalProgram program;
    const int n = 1 + random.Below(6);
    auto x = program.NewContinuousVariables(n);
    const auto z = program.NewIntegerVariables(random.Below(3));
    program.AddBoundingBoxConstraint(0, std::numeric_limits<double>::infinity(), z);
    // A reader has matrices of PSDVAR first among cones, matrices of PSDCON last.
    if (random.Below(2) == 0) {
      const auto X = program.NewSymmetricContinuousVariables(1 + random.Below(3));
      program.AddPositiveSemidefiniteConstraint(X);
    }
    const auto all = program.decision_variables();
    const int size = static_cast<int>(all.size());
    for (int k = random.Below(5); k > 0; --k) AddRandomCone(&random, &program, all);
    const int rows = random.Below(4);
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
    random.Sides(rows, &lower, &upper, true);
    for (Eigen::Index i = 0; i < rows; ++i) {
      if (std::isfinite(lower(i)) && std::isfinite(upper(i))) upper(i) = lower(i);
    }
    program.AddLinearConstraint(random.Matrix(rows, size), lower, upper, all);
    program.AddLinearCost(random.Vector(size), random.Number(), all);
    if (random.Below(2) == 0) {
      const int matrix_size = 1 + random.Below(3);
      std::vector<Eigen::MatrixXd> F;
      for (int k = 0; k < 3; ++k) F.push_back(RandomSymmetric(&random, matrix_size));
      program.AddLinearMatrixInequalityConstraint(F, {x.head(1), x.tail(1)});
    }
    ExpectThereAndBack(program, FileFormat::kCbf, false);
  }
}

// In MPS as in CBF an LP means the same, though bounds become rows: its cost and its feasible
// points are the same.
TEST(RoundTrip, KeepsTheMeaningFromMpsToCbf) {
  const auto program = ReadProgramText(
      "OBJSENSE MAX\nROWS\n N o\n L a\n G b\n E c\nCOLUMNS\n x o 1 a 1\n x b 1\n y o 2 a 1\n"
      " y c 3\nRHS\n o 4 a 5\n b -2 c 3\nRANGES\n a 3\nBOUNDS\n UP x 2\n LO x -1\n FR y\nENDATA\n",
      "a.mps");
  const auto conic = ReadProgramText(ProgramText(*program, FileFormat::kCbf), "a.cbf");
  EXPECT_EQ(conic->objective_sense(), ObjectiveSense::kMaximize);
  const auto feasible = [](const MathematicalProgram& p, const Eigen::VectorXd& point) {
    for (const auto& constraint : p.GetAllConstraints()) {
      if (!p.CheckSatisfied(constraint, point, 1e-12)) return false;
    }
    return true;
  };
  for (double x = -2; x <= 3; x += 0.5) {
    for (double y = -2; y <= 7; y += 0.5) {
      const Eigen::Vector2d point(x, y);
      EXPECT_EQ(feasible(*program, point), feasible(*conic, point)) << x << " " << y;
      EXPECT_EQ(program->EvalCosts(point), conic->EvalCosts(point));
    }
  }
}

}  // namespace
}  // namespace switchyard::io
