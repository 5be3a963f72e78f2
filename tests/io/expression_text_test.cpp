// Expressions as people write them: what they mean, and what is said of those that mean nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/io/op_words.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"
#include "tests/io/same_program.hpp"

namespace switchyard::io {
namespace {

// A program of two variables whose cost is the expression.
std::unique_ptr<MathematicalProgram> Read(const std::string& expression) {
  return ReadProgramText(
      "{\"format\": \"program/1\", \"variables\": [{\"name\": \"x\"}, {\"name\": \"y\"}], "
      "\"functions\": {\"f\": {\"type\": \"function\", \"arguments\": 2, \"expressions\": [\"" +
          expression + "\"]}}, \"costs\": [{\"function\": \"f\", \"variables\": [0, 1]}]}",
      "a.json");
}

std::string SaidOf(const std::string& expression) {
  try {
    Read(expression);
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

struct Formula {
  const char* text;
  double (*value)(double x, double y);
};

TEST(ExpressionText, IsWhatCppComputes) {
  const std::vector<Formula> formulas = {
      {"x[0] + 2*x[1] - 3/x[0]", [](double x, double y) { return x + 2 * y - 3 / x; }},
      {"x[0] - x[1] - 0.1", [](double x, double y) { return x - y - 0.1; }},
      {"x[0] / x[1] / 7", [](double x, double y) { return x / y / 7; }},
      {" ( x [ 0 ] + x[ 1 ] ) * x[0]", [](double x, double y) { return (x + y) * x; }},
      {"-x[0]^2", [](double x, double) { return -(x * x); }},
      {"(-x[0])^2", [](double x, double) { return (-x) * (-x); }},
      {"2^x[0]^x[1]", [](double x, double y) { return std::pow(2, std::pow(x, y)); }},
      {"x[0]^-x[1]", [](double x, double y) { return std::pow(x, -y); }},
      {"x[0]*-x[1] + --x[0] - +x[1]", [](double x, double y) { return x * -y + x - y; }},
      {"1.5e2*x[0] + .5 + 5. + 1E-3*x[1]",
       [](double x, double y) { return 1.5e2 * x + .5 + 5. + 1E-3 * y; }},
      {"sqrt(x[0])", [](double x, double) { return std::sqrt(x); }},
      {"exp(x[0])", [](double x, double) { return std::exp(x); }},
      {"log(x[0])", [](double x, double) { return std::log(x); }},
      {"sin(x[0])", [](double x, double) { return std::sin(x); }},
      {"cos(x[0])", [](double x, double) { return std::cos(x); }},
      {"tan(x[0])", [](double x, double) { return std::tan(x); }},
      {"asin(x[1])", [](double, double y) { return std::asin(y); }},
      {"acos(x[1])", [](double, double y) { return std::acos(y); }},
      {"atan(x[0])", [](double x, double) { return std::atan(x); }},
      {"sinh(x[0])", [](double x, double) { return std::sinh(x); }},
      {"cosh(x[0])", [](double x, double) { return std::cosh(x); }},
      {"tanh(x[0])", [](double x, double) { return std::tanh(x); }},
      {"abs(x[1] - x[0])", [](double x, double y) { return std::abs(y - x); }},
      {"floor(x[0])", [](double x, double) { return std::floor(x); }},
      {"ceil(x[0])", [](double x, double) { return std::ceil(x); }},
      {"min(x[0], x[1])", [](double x, double y) { return std::min(x, y); }},
      {"max(x[0], x[1])", [](double x, double y) { return std::max(x, y); }},
      {"atan2(x[0], x[1])", [](double x, double y) { return std::atan2(x, y); }},
      {"pow(x[0], x[1])", [](double x, double y) { return std::pow(x, y); }},
      {"pi*x[0]", [](double x, double) { return M_PI * x; }},
      {"x[0]*x[1]*(x[0]+x[1]+exp(sin(x[0]))) + x[1]",
       [](double x, double y) { return x * y * (x + y + std::exp(std::sin(x))) + y; }},
  };
  for (const Formula& formula : formulas) {
    const auto program = Read(formula.text);
    for (const auto& [x, y] : {std::pair(1.7, 0.3), std::pair(0.2, -0.9), std::pair(12.5, 0.5)}) {
      EXPECT_EQ(program->EvalCosts(Eigen::Vector2d(x, y)), formula.value(x, y)) << formula.text;
    }
    const std::string written = ProgramText(*program, FileFormat::kJson);
    EXPECT_EQ(testing::Difference(*program, *ReadProgramText(written, "b.json")), "") << written;
  }
}

TEST(ExpressionText, HasEveryCall) {
  const auto words = WordsOf(&OpWords::call);
  EXPECT_EQ(words.size(), 19u);
  for (const std::string_view word : words) {
    const bool two = NumOperands(OpCalled(word, &OpWords::call)->op) == 2;
    EXPECT_EQ(SaidOf(std::string(word) + (two ? "(x[0], x[1])" : "(x[0])")), "read");
  }
}

std::string SaidOfText(const std::string& text) {
  const std::string said = SaidOf(text);
  const std::string place = "a.json: /functions/f/expressions/0: ";
  return said.starts_with(place) ? said.substr(place.size()) : said;
}

TEST(ExpressionText, ThatIsWrongIsToldWithTheColumn) {
  EXPECT_EQ(SaidOf("x[0] +"),
            "a.json: /functions/f/expressions/0: needs a number, x[i], a function or \"(\" at "
            "column 7, got the end of the text");
  EXPECT_EQ(SaidOfText("x[0] + *2"),
            "needs a number, x[i], a function or \"(\" at column 8, got \"*\"");
  EXPECT_EQ(SaidOfText(""),
            "needs a number, x[i], a function or \"(\" at column 1, got the end of the text");
  EXPECT_EQ(SaidOfText("2x[0]"),
            "needs an operator, or the end of the text at column 2, got \"x\"");
  EXPECT_EQ(SaidOfText("x[0] 3.5"),
            "needs an operator, or the end of the text at column 6, got \"3.5\"");
  EXPECT_EQ(SaidOfText("(x[0] + 1"), "needs \")\" at column 10, got the end of the text");
  EXPECT_EQ(SaidOfText("x[0])"),
            "needs an operator, or the end of the text at column 5, got \")\"");
  EXPECT_EQ(SaidOfText("x[2]"),
            "needs the number of an argument from 0 to 1 at column 3, got \"2\"");
  EXPECT_EQ(SaidOfText("x[-1] + x[0]"),
            "needs the number of an argument from 0 to 1 at column 3, got \"-1\"");
  EXPECT_EQ(SaidOfText("x[99999999999]"),
            "needs the number of an argument from 0 to 1 at column 3, got \"99999999999\"");
  EXPECT_EQ(SaidOfText("x[1.5]"), "needs \"]\" at column 4, got \".\"");
  EXPECT_EQ(SaidOfText("x + 1"), "needs \"[\" at column 3, got \"+\"");
  EXPECT_EQ(SaidOfText("sin x[0]"), "needs \"(\" at column 5, got \"x\"");
  EXPECT_EQ(SaidOfText("sin(x[0], 2)"), "needs \")\" at column 9, got \",\"");
  EXPECT_EQ(SaidOfText("pow(x[0])"), "needs \",\" and argument 2 of pow at column 9, got \")\"");
  EXPECT_EQ(SaidOfText("1e999"),
            "needs a number that a double can hold at column 1, got \"1e999\"");
  EXPECT_EQ(SaidOfText("."), "needs a number, x[i], a function or \"(\" at column 1, got \".\"");
  EXPECT_EQ(SaidOfText("2e"), "needs an operator, or the end of the text at column 2, got \"e\"");
  EXPECT_EQ(SaidOfText("x[0] \xC3\x97 2"),
            "needs an operator, or the end of the text at column 6, got \"\xC3\x97\"");
  EXPECT_EQ(SaidOfText("1\\u0000"),
            "needs an operator, or the end of the text at column 2, got \"\\x00\"");
  EXPECT_EQ(
      SaidOfText("1 + sine(x[0])"),
      "needs a name that is known (x[i], pi, sqrt, exp, log, sin, cos, tan, asin, acos, atan, "
      "sinh, cosh, tanh, abs, floor, ceil, pow, atan2, min, max) at column 5, got \"sine\" "
      "(the nearest is \"sin\")");
}

TEST(ExpressionText, IsReadHoweverLongAndRefusedWhereTooDeep) {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '(') + "x[0]" + std::string(levels, ')');
  };
  const std::string deep = "needs at most 200 levels of brackets and powers at column ";
  EXPECT_EQ(SaidOfText(nested(199)), "read");
  EXPECT_EQ(SaidOfText(nested(200)), deep + "201, got more");
  EXPECT_EQ(SaidOfText(std::string(1'000'000, '(')), deep + "201, got more");
  std::string powers = "x[0]";
  for (int k = 0; k < 199; ++k) powers += "^2";
  EXPECT_EQ(SaidOfText(powers), "read");
  EXPECT_TRUE(SaidOfText(powers + "^2").starts_with(deep));
  EXPECT_EQ(SaidOfText(std::string(100'001, '-') + "x[0]"), "read");
  std::string sum = "x[0]";
  for (int k = 0; k < 20'000; ++k) sum += "+sin(" + std::to_string(k) + "*x[1])";
  EXPECT_EQ(SaidOfText(sum), "read");
}

}  // namespace
}  // namespace switchyard::io
