// program/1: what is written and read again is the same program in all respects.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
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

// The text says everything that a program holds, so equal texts are equal programs; what other
// eyes see of both is compared too.
void ExpectThereAndBack(const MathematicalProgram& program) {
  const std::string text = ProgramText(program, FileFormat::kJson);
  std::vector<std::string> notes;
  const auto again = ReadProgramText(text, "written.json", {.notes = &notes});
  EXPECT_EQ(notes, std::vector<std::string>());
  EXPECT_EQ(ProgramText(*again, FileFormat::kJson), text);
  EXPECT_EQ(Difference(program, *again), "");
  EXPECT_EQ(DifferenceOfNames(program, *again), "");
  const auto costs = program.GetAllCosts();
  const auto costs_again = again->GetAllCosts();
  ASSERT_EQ(costs.size(), costs_again.size());
  for (std::size_t k = 0; k < costs.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      EXPECT_EQ(costs[k].evaluator() == costs[j].evaluator(),
                costs_again[k].evaluator() == costs_again[j].evaluator());
    }
  }
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int Below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(engine_); }
  double Number() {
    const double number = std::normal_distribution<double>()(engine_);
    const int kind = Below(8);
    return kind == 0   ? -0.0
           : kind == 1 ? std::round(4 * number)
           : kind == 2 ? 1e200 * number
                       : number;
  }
  // Some of its entries are zeros that stay.
  SparseMatrix Matrix(int rows, int cols) {
    std::vector<Eigen::Triplet<double>> triplets;
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < cols; ++j) {
        if (Below(2) == 0) triplets.emplace_back(i, j, Number());
      }
    }
    SparseMatrix M(rows, cols);
    M.setFromTriplets(triplets.begin(), triplets.end());
    return M;
  }
  Eigen::VectorXd Vector(int size) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return Number(); });
  }
  void Sides(int size, Eigen::VectorXd* lower, Eigen::VectorXd* upper) {
    *lower = Vector(size);
    *upper = *lower;
    for (Eigen::Index i = 0; i < size; ++i) {
      const int kind = Below(5);
      if (kind == 1 || kind == 4) (*lower)(i) = -std::numeric_limits<double>::infinity();
      if (kind == 2 || kind == 4) (*upper)(i) = std::numeric_limits<double>::infinity();
      if (kind == 3) (*upper)(i) += std::abs(Number());
    }
  }

 private:
  std::mt19937 engine_;
};

std::shared_ptr<Cost> RandomCost(Random* random, int n) {
  const int rows = 1 + random->Below(3);
  switch (random->Below(6)) {
    case 0:
      return std::make_shared<LinearCost>(random->Vector(n), random->Number());
    case 1:
      return std::make_shared<QuadraticCost>(random->Matrix(n, n), random->Vector(n),
                                             random->Number(), random->Below(2) == 0);
    case 2:
      return std::make_shared<L1NormCost>(random->Matrix(rows, n), random->Vector(rows));
    case 3:
      return std::make_shared<L2NormCost>(random->Matrix(rows, n), random->Vector(rows));
    case 4:
      return std::make_shared<LInfNormCost>(random->Matrix(rows, n), random->Vector(rows));
    default:
      return std::make_shared<PerspectiveQuadraticCost>(random->Matrix(rows, n),
                                                        random->Vector(rows));
  }
}

std::shared_ptr<Constraint> RandomCone(Random* random, int n) {
  const int rows = 2 + random->Below(3);
  switch (random->Below(4)) {
    case 0:
      return std::make_shared<LorentzConeConstraint>(random->Matrix(rows, n), random->Vector(rows));
    case 1:
      return std::make_shared<RotatedLorentzConeConstraint>(random->Matrix(rows, n),
                                                            random->Vector(rows));
    case 2:
      return std::make_shared<ExponentialConeConstraint>(random->Matrix(3, n), random->Vector(3));
    default:
      return std::make_shared<PowerConeConstraint>(random->Matrix(3, n), random->Vector(3),
                                                   0.01 * (1 + random->Below(99)));
  }
}

std::shared_ptr<Constraint> RandomMatrixCone(Random* random, int n) {
  const int rows = 1 + random->Below(3);
  std::vector<Eigen::MatrixXd> F;
  for (int k = 0; k <= n; ++k) {
    const Eigen::MatrixXd M = random->Matrix(rows, rows);
    F.push_back(M + M.transpose());
  }
  auto cone = std::make_shared<LinearMatrixInequalityConstraint>(F);
  if (random->Below(2) == 0) {
    cone->UpdateCoefficients(random->Matrix(rows * rows, n), random->Vector(rows * rows));
  }
  return cone;
}

std::shared_ptr<Constraint> RandomConstraint(Random* random, int n) {
  const int rows = random->Below(4);
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  switch (random->Below(6)) {
    case 0:
      random->Sides(n, &lower, &upper);
      return std::make_shared<BoundingBoxConstraint>(lower, upper);
    case 1:
      random->Sides(rows, &lower, &upper);
      return std::make_shared<LinearConstraint>(random->Matrix(rows, n), lower, upper);
    case 2:
      return std::make_shared<LinearEqualityConstraint>(random->Matrix(rows, n),
                                                        random->Vector(rows));
    case 3:
      return RandomCone(random, n);
    case 4:
      random->Sides(1, &lower, &upper);
      return std::make_shared<QuadraticConstraint>(
          random->Matrix(n, n), random->Vector(n), lower(0), upper(0),
          static_cast<QuadraticConstraint::HessianType>(random->Below(3)));
    default:
      return RandomMatrixCone(random, n);
  }
}

VectorXDecisionVariable Some(Random* random, const VectorXDecisionVariable& x, int n) {
  return VectorXDecisionVariable::NullaryExpr(
      n, [&] { return x(random->Below(static_cast<int>(x.size()))); });
}

TEST(ProgramJson, KeepsRandomProgramsOfEveryKind) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    MathematicalProgram program;
    if (random.Below(2) == 0) program.set_name("a \"name\" of \\ and \x01 and \xC3\xA4");
    if (random.Below(2) == 0) program.set_objective_sense(ObjectiveSense::kMaximize);
    program.NewContinuousVariables(1 + random.Below(4));
    program.NewIntegerVariables(random.Below(3));
    program.NewBinaryVariables(random.Below(2), 2, "B");
    if (random.Below(3) == 0) {
      auto X = program.NewSymmetricContinuousVariables(1 + random.Below(3));
      auto cone = program.AddPositiveSemidefiniteConstraint(X).evaluator();
      const int size = static_cast<int>(X.size());
      if (random.Below(2) == 0) {
        cone->UpdateCoefficients(random.Matrix(size, size), random.Vector(size));
      }
    }
    const auto x = program.decision_variables();
    if (random.Below(2) == 0) {
      program.SetInitialGuess(Some(&random, x, 3), Eigen::Vector3d(0.1, -0.0, 1e-300));
    }
    for (int k = random.Below(4); k > 0; --k) {
      const int n = 1 + random.Below(4);
      const auto cost = RandomCost(&random, n);
      if (random.Below(2) == 0) cost->set_description("cost number " + std::to_string(k));
      for (int uses = random.Below(3); uses > 0; --uses) {
        program.AddCost(cost, Some(&random, x, n));
      }
    }
    for (int k = random.Below(6); k > 0; --k) {
      const int n = 1 + random.Below(4);
      const auto constraint = RandomConstraint(&random, n);
      if (random.Below(3) == 0) {
        std::vector<std::string> names;
        for (int i = 0; i < constraint->num_constraints(); ++i) names.push_back(std::to_string(i));
        constraint->set_row_names(names);
      }
      for (int uses = 1 + random.Below(2); uses > 0; --uses) {
        program.AddConstraint(constraint, Some(&random, x, n));
      }
    }
    ExpectThereAndBack(program);
  }
}

TEST(ProgramJson, KeepsTheInstancesOfOtherFormats) {
  const std::filesystem::path root = SWITCHYARD_INSTANCES;
  int count = 0;
  for (const char* folder : {"lp", "milp", "qp", "socp", "misocp"}) {
    if (!std::filesystem::is_directory(root / folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
      if (std::filesystem::file_size(entry) > (1 << 18)) continue;
      SCOPED_TRACE(entry.path().filename().string());
      ExpectThereAndBack(*ReadProgram(entry.path().string()));
      ++count;
    }
  }
  if (count == 0) GTEST_SKIP() << "no instances beside the source tree";
}

std::string SaidOf(const std::string& members) {
  try {
    ReadProgramText("{\"format\": \"program/1\", " + members + "}", "a.json");
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

const std::string kTwo = "\"variables\": [{\"name\": \"x\"}, {\"name\": \"y\"}]";

TEST(ProgramJson, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(SaidOf(kTwo), "read");
  EXPECT_EQ(SaidOf(kTwo + ", \"cost\": []"),
            "a.json: /cost: needs a name that is read here (format, name, notes, sense, variables, "
            "functions, constraints, costs, subject_to), got \"cost\" (the nearest is \"costs\")");
  EXPECT_EQ(SaidOf("\"variables\": [{\"name\": \"x\", \"type\": \"real\"}]"),
            "a.json: /variables/0/type: needs continuous, integer or binary, got \"real\"");
  EXPECT_EQ(SaidOf("\"variables\": [{}]"),
            "a.json: /variables/0: needs \"name\", got an object without it");
  const auto function = [](const std::string& f) {
    return kTwo + ", \"functions\": {\"f\": " + f + "}";
  };
  EXPECT_EQ(
      SaidOf(function("{\"type\": \"l3_norm\"}")),
      "a.json: /functions/f/type: needs a type of function (linear, quadratic, squared_l2_norm, "
      "l1_norm, l2_norm, linf_norm, perspective_quadratic, function), got \"l3_norm\" (the nearest "
      "is "
      "\"l1_norm\")");
  const std::string linear = "{\"type\": \"linear\", \"a\": [1, 2], \"b\": 0}";
  EXPECT_EQ(SaidOf(function("{\"type\": \"linear\", \"a\": [1, \"inf\"], \"b\": 0}")),
            "a.json: /functions/f/a/1: needs a number, got \"inf\"");
  const auto cost = [&](const std::string& c) {
    return function(linear) + ", \"costs\": [" + c + "]";
  };
  EXPECT_EQ(SaidOf(cost("{\"function\": \"f\", \"variables\": [0, 1]}")), "read");
  EXPECT_EQ(SaidOf(cost("{\"function\": \"f\", \"variables\": [0]}")),
            "a.json: /costs/0/variables: needs a list of 2, one for each variable of f, got a list "
            "of 1");
  EXPECT_EQ(SaidOf(cost("{\"function\": \"f\", \"variables\": [0, 2]}")),
            "a.json: /costs/0/variables/1: needs the number of a variable from 0 to 1, got 2");
  EXPECT_EQ(SaidOf(cost("{\"function\": \"g\", \"variables\": [0, 1]}")),
            "a.json: /costs/0/function: needs the name of a function, got \"g\" (the nearest is "
            "\"f\")");
  const auto constraint = [](const std::string& c) {
    return kTwo + ", \"constraints\": {\"c\": {\"type\": " + c + "}}";
  };
  EXPECT_EQ(SaidOf(constraint("\"bounding_box\", \"lb\": [0, 2], \"ub\": [1, 1]")),
            "a.json: /constraints/c/ub/1: needs an upper side of 2, the lower one, or more, got 1");
  EXPECT_EQ(SaidOf(constraint("\"power_cone\", \"alpha\": 1, \"A\": {\"rows\": 3, \"cols\": 1, "
                              "\"entries\": []}, \"b\": [0, 0, 0]")),
            "a.json: /constraints/c/alpha: needs a number between 0 and 1, got 1");
  EXPECT_EQ(SaidOf(constraint("\"exponential_cone\", \"A\": {\"rows\": 2, \"cols\": 1, "
                              "\"entries\": []}, \"b\": [0, 0]")),
            "a.json: /constraints/c/A: needs a matrix of 3 rows, got one of 2");
  EXPECT_EQ(
      SaidOf(constraint("\"linear\", \"A\": {\"rows\": 2147483646, \"cols\": 1, \"entries\": "
                        "[]}, \"lb\": [], \"ub\": []")),
      "a.json: /constraints/c/A/rows: needs dimensions that go with the size of the file, got "
      "2147483646 beyond them");
  EXPECT_EQ(SaidOf(constraint("\"positive_semidefinite\", \"rows\": 40000")),
            "a.json: /constraints/c/rows: needs dimensions that go with the size of the file, got "
            "1600000000 beyond them");
}

TEST(ProgramJson, SaysThatAnUnusedEntryIsLeftOut) {
  std::vector<std::string> notes;
  ReadProgramText("{\"format\": \"program/1\", " + kTwo +
                      ", \"functions\": {\"f\": {\"type\": \"linear\", \"a\": [], \"b\": 1}}}",
                  "-", {.notes = &notes});
  EXPECT_EQ(notes, std::vector<std::string>{"a function that nothing uses is left out (\"f\")"});
}

TEST(ProgramJson, SaysThatAGraphIsNoProgram) {
  try {
    ReadProgramText("{\"format\": \"gcs/1\", \"source\": 0}", "a.json");
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(),
                 "a.json: /format: needs \"program/1\", got \"gcs/1\", a graph to plan in");
  }
}

}  // namespace
}  // namespace switchyard::io
