// Functions and quadratic constraints in program/1: as steps, and what is said of wrong ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/io/op_words.hpp"
#include "core/io/program_json.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/io/same_program.hpp"

namespace switchyard::io {
namespace {

using Place = Tape::Place;
using switchyard::testing::Difference;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::unique_ptr<MathematicalProgram> Read(const std::string& members) {
  return ReadProgramText("{\"format\": \"program/1\", " + members + "}", "a.json");
}

std::string SaidOf(const std::string& members) {
  try {
    Read(members);
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string Variables(int count) {
  std::string list;
  for (int i = 0; i < count; ++i) {
    list += (i == 0 ? "{\"name\": \"x" : ", {\"name\": \"x") + std::to_string(i) + "\"}";
  }
  return "\"variables\": [" + list + "]";
}

// A program whose cost is the one function of two variables.
std::string Cost(const std::string& members) {
  return Variables(2) + ", \"functions\": {\"f\": {\"type\": \"function\", " + members +
         "}}, \"costs\": [{\"function\": \"f\", \"variables\": [0, 1]}]";
}
std::string Rows(const std::string& members) {
  return Variables(2) + ", \"constraints\": {\"c\": {\"type\": " + members +
         "}}, \"subject_to\": [{\"constraint\": \"c\", \"variables\": [0, 1]}]";
}

const Function& CostOf(const MathematicalProgram& program) {
  return *FunctionOf(*program.generic_costs().at(0).evaluator());
}

bool SameBits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::equal(a.data(), a.data() + a.size(), b.data(), [](double s, double t) {
           return std::bit_cast<std::uint64_t>(s) == std::bit_cast<std::uint64_t>(t);
         });
}

void ExpectThereAndBack(const MathematicalProgram& program) {
  const std::string text = ProgramText(program, FileFormat::kJson);
  std::vector<std::string> notes;
  const auto again = ReadProgramText(text, "written.json", {.notes = &notes});
  EXPECT_EQ(notes, std::vector<std::string>());
  EXPECT_EQ(ProgramText(*again, FileFormat::kJson), text);
  EXPECT_EQ(Difference(program, *again), "") << text;
}

// ---- Steps ----

// Every operation on places and constants drawn from those there are, and two outputs.
Tape RandomTape(std::mt19937& engine, int inputs) {
  const auto below = [&](std::size_t limit) { return static_cast<Place>(engine() % limit); };
  constexpr std::array kConstants = {0.0, -0.0, 0.5, -2.0, 1e300, 5e-324, kInf, -kInf, kNaN, -kNaN};
  Tape tape(inputs);
  for (const double constant : kConstants) {
    if (below(3) == 0) tape.Constant(constant);
  }
  tape.Constant(0.75);
  for (int k = 0; k < 40; ++k) {
    const Op op = kOpWords[2 + static_cast<std::size_t>(below(kOpWords.size() - 2))].op;
    const auto place = [&] { return below(tape.steps().size()); };
    const int operands = NumOperands(op);
    if (operands == 1) tape.Apply(op, place());
    if (operands == 2) tape.Apply(op, place(), place());
    if (operands == 3) tape.Apply(op, place(), place(), place());
  }
  tape.AddOutput(static_cast<Place>(tape.steps().size()) - 1);
  return tape;
}

TEST(ProgramFunctions, KeepTapesOfEveryOperationToTheLastBit) {
  std::mt19937 engine(1);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const int n = static_cast<int>(engine() % 4);
    MathematicalProgram program;
    const auto x = program.NewContinuousVariables(n);
    Tape tape = RandomTape(engine, n);
    program.AddFunctionCost(CompileTape(tape), x, trial % 2 == 0);
    tape.AddOutput(0);
    program.AddFunctionConstraint(CompileTape(tape), Eigen::Vector2d(-kInf, -1),
                                  Eigen::Vector2d(trial, kInf), x, trial % 3 == 0);
    ExpectThereAndBack(program);
    const auto again = ReadProgramText(ProgramText(program, FileFormat::kJson), "a.json");
    const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(n, 0.3, 0.9);
    const Evaluated ours = At(CostOf(program), at);
    const Evaluated theirs = At(CostOf(*again), at);
    EXPECT_TRUE(SameBits(ours.values, theirs.values));
    EXPECT_TRUE(SameBits(ours.jacobian, theirs.jacobian));
    EXPECT_TRUE(SameBits(ours.hessian, theirs.hessian));
  }
}

TEST(ProgramFunctions, AreWrittenAsSteps) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddCost(
      [](const auto& v) {
        const auto scaled = 2.5 * v[0];
        return scaled * exp(v[1]);
      },
      x);
  const std::string text = ProgramText(program, FileFormat::kJson);
  EXPECT_NE(text.find("\"f0\": {\"type\": \"function\", \"arguments\": 2, \"steps\": "
                      "[[\"constant\", 2.5], [\"multiply\", 0, 2], [\"exp\", 1], "
                      "[\"multiply\", 3, 4]], \"outputs\": [5], \"convex\": false}"),
            text.npos)
      << text;
}

TEST(ProgramFunctions, KeepWhatWasTracedOrGivenByExpressions) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.AddCost(exp(Expression(x[0])) * x[1] - x[2]);
  program.AddConstraint(sin(Expression(x[0])) + x[1] * Expression(x[2]), -1, 1);
  FunctionTermOptions declared;
  declared.description = "a \"declared\" one";
  declared.function.jacobian = SparsityPattern::Dense(2, 3);
  program.AddConstraint(
      [](const auto& v) {
        return std::vector{v[0] * v[1], pow(v[2], 3)};
      },
      Eigen::Vector2d(0, -kInf), Eigen::Vector2d(kInf, 4), x, declared);
  ExpectThereAndBack(program);
}

TEST(ProgramFunctions, AnEntryIsOneEvaluatorHoweverManyUseIt) {
  const auto program = Read(
      Variables(2) +
      ", \"functions\": {\"f\": {\"type\": \"function\", \"arguments\": 1, \"convex\": true, "
      "\"description\": \"d\", \"expressions\": [\"x[0]^4\"]}}, \"costs\": [{\"function\": \"f\", "
      "\"variables\": [0]}, {\"function\": \"f\", \"variables\": [1]}]");
  const auto& costs = program->generic_costs();
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_EQ(costs[0].evaluator(), costs[1].evaluator());
  EXPECT_TRUE(costs[0].evaluator()->is_convex());
  EXPECT_EQ(costs[0].evaluator()->Name(), "d");
  EXPECT_DOUBLE_EQ(program->EvalCosts(Eigen::Vector2d(2, 3)), 16 + 81);
  ExpectThereAndBack(*program);
}

// Another program need not know what a tape folds.
TEST(ProgramFunctions, StepsThatATapeWouldFoldMeanWhatTheySay) {
  const auto program = Read(Cost(
      "\"arguments\": 2, \"steps\": [[\"constant\", 3], [\"constant\", 4], [\"multiply\", 2, 3], "
      "[\"add\", 4, 0], [\"add\", 0, 4], [\"subtract\", 6, 5], [\"if nonnegative\", 1, 6, 7]], "
      "\"outputs\": [8]"));
  EXPECT_EQ(program->EvalCosts(Eigen::Vector2d(5, 1)), 17);
  EXPECT_EQ(program->EvalCosts(Eigen::Vector2d(5, -1)), 0);
  ExpectThereAndBack(*program);
}

struct Own {
  double operator()(const Eigen::VectorXd& x) const { return x.sum(); }
};

TEST(ProgramFunctions, OfTheUsersOwnAreRefusedByName) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddCost(Own(), x, {.description = "wind"});
  program.AddConstraint(Own(), Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1), x);
  program.AddCost(
      [](const auto& v) {
        if (v[0] > 0) return v[0];
        return v[1];
      },
      x, {.description = "branches"});
  const std::string why =
      "is a function of the user's own program; a file holds functions given by expressions or "
      "traced";
  EXPECT_EQ(
      CannotHold(program, FileFormat::kJson),
      (std::vector<std::string>{"wind " + why, "branches " + why, "function constraint " + why}));
  try {
    WriteProgram(program, "no_such_folder/a.json");
    ADD_FAILURE();
  } catch (const InvalidArgument& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("json cannot hold this program; wind " + why))
        << error.what();
  }
}

TEST(ProgramFunctions, AreNeitherInMpsNorInCbf) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddCost(exp(Expression(x[0])));
  program.AddConstraint(sin(Expression(x[0])), -1, 1);
  program.AddQuadraticConstraint(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), -kInf, 1, x);
  for (const FileFormat format : {FileFormat::kMps, FileFormat::kCbf}) {
    EXPECT_EQ(CannotHold(program, format),
              (std::vector<std::string>{
                  "costs that are functions: 1 of kind function cost",
                  "constraints that are quadratic: 1 of kind quadratic constraint",
                  "constraints that are functions: 1 of kind function constraint"}));
    EXPECT_THROW(ProgramText(program, format), InvalidArgument);
  }
}

// ---- What is wrong with an entry ----

TEST(ProgramFunctions, WrongEntriesAreToldWithTheirPlace) {
  EXPECT_EQ(SaidOf(Cost("\"arguments\": 2")),
            "a.json: /functions/f: needs \"expressions\" or \"steps\", got an object without them");
  EXPECT_EQ(SaidOf(Cost("\"arguments\": 2, \"expressions\": [\"1\"], \"steps\": []")),
            "a.json: /functions/f: needs \"expressions\" or \"steps\", got an object with both");
  EXPECT_EQ(SaidOf(Cost("\"arguments\": 2, \"expressions\": [\"1\"], \"outputs\": []")),
            "a.json: /functions/f/outputs: needs \"steps\" beside it, got \"expressions\"");
  EXPECT_EQ(SaidOf(Cost("\"arguments\": -1, \"expressions\": []")),
            "a.json: /functions/f/arguments: needs a number of arguments from 0 to 2147483646, got "
            "-1");
  EXPECT_EQ(SaidOf(Cost("\"arguments\": 2147483646, \"expressions\": []")).substr(0, 93),
            "a.json: /functions/f/arguments: needs dimensions that go with the size of the file, "
            "got 21474");
  EXPECT_EQ(SaidOf(Cost("\"arguments\": 2, \"expressions\": [\"1\", \"2\"]")),
            "a.json: /functions/f/expressions: needs a list of 1, the value of a cost, got a list "
            "of 2");
  EXPECT_EQ(SaidOf(Cost("\"arguments\": 1, \"expressions\": [\"x[0]\"]")),
            "a.json: /costs/0/variables: needs a list of 1, one for each variable of f, got a list "
            "of 2");
  EXPECT_EQ(
      SaidOf(Cost("\"arguments\": 0, \"expressions\": [\"x[0]\"]")),
      "a.json: /functions/f/expressions/0: needs the number of an argument (there is none) at "
      "column 3, got \"0\"");
  EXPECT_EQ(SaidOf(Rows("\"function\", \"arguments\": 2, \"expressions\": [\"1\", \"2\"], \"lb\": "
                        "[0], \"ub\": [1]")),
            "a.json: /constraints/c/lb: needs a list of 2, one for each value of the function, got "
            "a list of 1");
  EXPECT_EQ(SaidOf(Rows("\"function\", \"arguments\": 2, \"expressions\": [\"1\"], \"lb\": [2], "
                        "\"ub\": [1]")),
            "a.json: /constraints/c/ub/0: needs an upper side of 2, the lower one, or more, got 1");
}

TEST(ProgramFunctions, WrongStepsAreToldWithTheirPlace) {
  const auto said = [](const std::string& steps, const std::string& outputs = "[0]") {
    const std::string all =
        SaidOf(Cost("\"arguments\": 2, \"steps\": [" + steps + "], \"outputs\": " + outputs));
    const std::string place = "a.json: /functions/f/";
    return all.starts_with(place) ? all.substr(place.size()) : all;
  };
  EXPECT_EQ(said(""), "read");
  EXPECT_EQ(said("[\"sin\", 0], 3"),
            "steps/1: needs an operation and its operands in a list, got 3");
  EXPECT_EQ(said("[]"), "steps/0: needs an operation and its operands in a list, got a list of 0");
  EXPECT_EQ(said("[\"sinn\", 0]"),
            "steps/0/0: needs an operation (constant, add, subtract, multiply, divide, negate, "
            "sqrt, exp, log, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, abs, floor, ceil, "
            "power, atan2, min, max, if positive, if nonnegative), got \"sinn\" (the nearest is "
            "\"sin\")");
  EXPECT_EQ(said("[\"input\", 0]").substr(0, 29), "steps/0/0: needs an operation");
  EXPECT_EQ(said("[\"\"]").substr(0, 29), "steps/0/0: needs an operation");
  EXPECT_EQ(said("[\"sin\"]"), "steps/0: needs \"sin\" and 1 place, got a list of 1");
  EXPECT_EQ(said("[\"add\", 0, 1, 1]"), "steps/0: needs \"add\" and 2 places, got a list of 4");
  EXPECT_EQ(said("[\"constant\"]"), "steps/0: needs \"constant\" and a number, got a list of 1");
  EXPECT_EQ(said("[\"constant\", \"many\"]"),
            "steps/0/1: needs a number, \"inf\" or \"-inf\", got \"many\"");
  EXPECT_EQ(said("[\"sin\", 0], [\"add\", 2, 3]"),
            "steps/1/2: needs the place of an earlier value from 0 to 2, got 3");
  EXPECT_EQ(said("", "[2]"), "outputs/0: needs the place of a value from 0 to 1, got 2");
  EXPECT_EQ(said("", "[]"), "outputs: needs a list of 1, the value of a cost, got a list of 0");
}

// A text of n operations and n outputs that need them all would take memory for n^2.
TEST(ProgramFunctions, OutputsThatNeedTooManyOperationsAreRefused) {
  std::string steps = "[\"sin\", 0]";
  std::string outputs = "1";
  std::string sides = "0";
  const int n = 14'000;
  for (int k = 1; k < n; ++k) {
    steps += ",[\"sin\",";
    steps += std::to_string(k);
    steps += "]";
    outputs += ',';
    outputs += std::to_string(n);
    sides += ",0";
  }
  EXPECT_TRUE(SaidOf(Variables(1) +
                     ", \"constraints\": {\"c\": {\"type\": \"function\", "
                     "\"arguments\": 1, \"steps\": [" +
                     steps + "], \"outputs\": [" + outputs + "], \"lb\": [" + sides +
                     "], \"ub\": [" + sides + "]}}")
                  .starts_with("a.json: /constraints/c/outputs: needs dimensions that go with the "
                               "size of the file, got "));
}

// ---- Quadratic constraints ----

std::string Form(const std::string& entries, const std::string& more) {
  return Rows("\"quadratic\", \"Q\": {\"rows\": 2, \"cols\": 2, \"entries\": [" + entries + "]}, " +
              more);
}

TEST(ProgramFunctions, QuadraticConstraintsAreReadAndKept) {
  using Type = QuadraticConstraint::HessianType;
  const std::string sides = "\"b\": [1, -1], \"lb\": [\"-inf\"], \"ub\": [3]";
  const auto type_of = [](const MathematicalProgram& program) {
    return program.quadratic_constraints().at(0).evaluator()->hessian_type();
  };
  const auto found = Read(Form("[0, 0, 2], [0, 1, 1]", sides));
  const QuadraticConstraint& form = *found->quadratic_constraints().at(0).evaluator();
  EXPECT_EQ(form.Q().coeff(1, 0), 0.5);
  EXPECT_EQ(form.upper_bound()(0), 3);
  EXPECT_EQ(form.lower_bound()(0), -kInf);
  EXPECT_EQ(form.b(), Eigen::Vector2d(1, -1));
  EXPECT_EQ(type_of(*found), Type::kIndefinite);
  ExpectThereAndBack(*found);
  EXPECT_EQ(type_of(*Read(Form("[0, 0, 2]", sides))), Type::kPositiveSemidefinite);
  EXPECT_EQ(type_of(*Read(Form("[0, 0, -2]", sides))), Type::kNegativeSemidefinite);
  const auto said = Read(Form("[0, 0, 2]", sides + ", \"hessian\": \"indefinite\""));
  EXPECT_EQ(type_of(*said), Type::kIndefinite);
  ExpectThereAndBack(*said);
}

TEST(ProgramFunctions, WrongQuadraticConstraintsAreToldWithTheirPlace) {
  const std::string b = "\"b\": [1, -1], ";
  EXPECT_EQ(SaidOf(Form("", b + "\"lb\": [0, 0], \"ub\": [1, 1]")),
            "a.json: /constraints/c/lb: needs a list of 1, the side of the form, got a list of 2");
  EXPECT_EQ(SaidOf(Form("", b + "\"lb\": [0], \"ub\": [1], \"hessian\": \"convex\"")),
            "a.json: /constraints/c/hessian: needs positive_semidefinite, negative_semidefinite or "
            "indefinite, got \"convex\"");
  EXPECT_EQ(SaidOf(Form("", "\"b\": [1], \"lb\": [0], \"ub\": [1]")),
            "a.json: /constraints/c/b: needs a list of 2, one for each row of Q, got a list of 1");
  EXPECT_EQ(SaidOf(Rows("\"quadratic\", \"Q\": {\"rows\": 1, \"cols\": 2, \"entries\": []}, "
                        "\"b\": [1], \"lb\": [0], \"ub\": [1]")),
            "a.json: /constraints/c/Q: needs a square matrix, got one of 1 x 2");
}

// ---- The example ----

TEST(ProgramFunctions, TheExampleIsProblem71) {
  const std::filesystem::path path =
      std::filesystem::path(SWITCHYARD_SOURCE_DIR) / "examples" / "problems" / "hs71.json";
  const auto program = ReadProgram(path.string());
  const Eigen::Vector4d best(1, 4.742999642, 3.821149978, 1.379408293);
  EXPECT_NEAR(program->EvalCosts(best), 17.0140172892, 1e-7);
  EXPECT_TRUE(program->CheckSatisfied(program->GetAllConstraints(), best, 1e-6));
  EXPECT_EQ(program->initial_guess(), Eigen::Vector4d(1, 5, 5, 1));
  ExpectThereAndBack(*program);
}

}  // namespace
}  // namespace switchyard::io
