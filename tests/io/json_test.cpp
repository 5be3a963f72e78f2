// What JSON is taken and what is said of the rest, word for word; what a value is asked for.
#include "core/io/json.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/io/json_numbers.hpp"

namespace switchyard::io {
namespace {

std::string SaidOf(const std::string& bytes) {
  try {
    const FileText text(bytes, "a.json");
    const JsonDocument document(text);
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(Json, SaysLineAndColumnOfWrongSyntax) {
  EXPECT_EQ(SaidOf(""), "a.json:1:1: expected a value, got the end of the file");
  EXPECT_EQ(SaidOf("{\n \"a\": 1,\n \"b\" 2}"),
            "a.json:3:6: expected \":\" behind a name, got \"2\"");
  EXPECT_EQ(SaidOf("[1, 2\n"), "a.json:2:1: expected \",\" or \"]\", got the end of the file");
  EXPECT_EQ(SaidOf("[1 2]"), "a.json:1:4: expected \",\" or \"]\", got \"2\"");
  EXPECT_EQ(SaidOf("[1,]"), "a.json:1:4: expected a value, got \"]\"");
  EXPECT_EQ(SaidOf("{\"a\": 1,}"), "a.json:1:9: expected a name in quotes, got \"}\"");
  EXPECT_EQ(SaidOf("{a: 1}"), "a.json:1:2: expected a name in quotes or \"}\", got \"a\"");
  EXPECT_EQ(SaidOf("{} x"), "a.json:1:4: expected the end of the file, got \"x\"");
  EXPECT_EQ(SaidOf("[NaN]"), "a.json:1:2: expected a value or \"]\", got \"NaN\"");
  EXPECT_EQ(SaidOf("[-]"), "a.json:1:2: expected a value or \"]\", got \"-\"");
  EXPECT_EQ(SaidOf("[1e999]"),
            "a.json:1:2: expected a number that a double can hold, got "
            "\"1e999\"");
  EXPECT_EQ(SaidOf("[\"a]\n"),
            "a.json:1:2: expected a string that ends on its line, in UTF-8, "
            "with the escapes of JSON, got \"\"a]\"");
}

TEST(Json, RefusesWhatIsAmbiguousOrTooDeep) {
  EXPECT_EQ(SaidOf("[{\"a\": 1, \"b\": {}, \"a\": 2}]"),
            "a.json: /0: needs each name once, got \"a\" twice");
  std::string many = "{\"n\": {\"k0\": [0]";
  for (int k = 1; k < 40; ++k) many += ", \"k" + std::to_string(k) + "\": [1, {\"k0\": 2}]";
  EXPECT_EQ(SaidOf(many + "}}"), "read");
  EXPECT_EQ(SaidOf(many + ", \"k7\": 0}}"), "a.json: /n: needs each name once, got \"k7\" twice");
  EXPECT_EQ(SaidOf(std::string(64, '[') + std::string(64, ']')), "read");
  const std::string deep = SaidOf(std::string(100000, '['));
  EXPECT_TRUE(deep.ends_with("/0: needs at most 64 levels of nesting, got more")) << deep;
}

TEST(Json, NamesThePlaceOfAValueThatIsAnotherThing) {
  const FileText text("{\"a/b\": [0, {\"x~\": [1, 2.5, null, \"inf\", true]}], \"c\": {}}",
                      "a.json");
  const JsonDocument document(text);
  const JsonValue list = *document.root().Member("a/b")->Elements().at(1).Member("x~");
  const std::vector<JsonValue> values = list.Elements();
  const auto said = [](auto ask) -> std::string {
    try {
      ask();
      return "nothing";
    } catch (const FileError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(list.Pointer(), "/a~1b/1/x~0");
  EXPECT_EQ(values[0].Integer(0, 2, "a row"), 1);
  EXPECT_EQ(said([&] { return values[0].Integer(0, 1, "a row"); }),
            "a.json: /a~1b/1/x~0/0: needs a row from 0 to 0, got 1");
  EXPECT_EQ(said([&] { return values[1].Integer(0, 9, "a row"); }),
            "a.json: /a~1b/1/x~0/1: needs a row from 0 to 8, got 2.5");
  EXPECT_EQ(said([&] { return values[2].Number(); }),
            "a.json: /a~1b/1/x~0/2: needs a number, got null");
  EXPECT_EQ(said([&] { return values[3].Number(); }),
            "a.json: /a~1b/1/x~0/3: needs a number, got \"inf\"");
  EXPECT_EQ(values[3].NumberOrInfinity(), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(values[4].Bool());
  EXPECT_EQ(said([&] { return list.String(); }),
            "a.json: /a~1b/1/x~0: needs a text, got a list of 5");
  EXPECT_EQ(said([&] {
              JsonFields(document.root(), {"c", "ab"});
            }),
            "a.json: /a~1b: needs a name that is read here (c, ab), got \"a/b\" (the nearest is "
            "\"ab\")");
  EXPECT_EQ(said([&] { return JsonFields(*document.root().Member("c"), {"d"})["d"]; }),
            "a.json: /c: needs \"d\", got an object without it");
}

std::string SaidOfMatrix(const std::string& bytes) {
  try {
    const FileText text(bytes, "m");
    const JsonDocument document(text);
    JsonRoom room(text, 100, 1);
    ReadMatrix(document.root(), &room);
    return "read";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(Json, ReadsMatricesWhoseEntriesStandInAnyOrderOnce) {
  const std::string head = "{\"rows\": 2, \"cols\": 3, \"entries\": [";
  EXPECT_EQ(SaidOfMatrix(head + "[1, 2, 3], [0, 0, -1]]}"), "read");
  EXPECT_EQ(SaidOfMatrix(head + "[1, 2, 3], [0, 0, 1], [1, 2, 4]]}"),
            "m: /entries/2: needs each place once, got row 1 and column 2 again");
  EXPECT_EQ(SaidOfMatrix(head + "[2, 0, 3]]}"), "m: /entries/0/0: needs a row from 0 to 1, got 2");
  EXPECT_EQ(SaidOfMatrix(head + "[1, 0]]}"),
            "m: /entries/0: needs a row, a column and a number, got a list of 2");
  EXPECT_EQ(SaidOfMatrix("{\"rows\": 2, \"cols\": 2000000000, \"entries\": []}"),
            "m: /cols: needs dimensions that go with the size of the file, got 2000000000 beyond "
            "them");
}

TEST(Json, WritesNumbersThatReadBackToTheSameBits) {
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::VectorXd numbers(9);
  numbers << 0.0, -0.0, 0.1, 1e300, -5e-324, 123456789012345678.0, 1.0 / 3, infinity, -infinity;
  std::string bytes;
  AppendJson(numbers, &bytes);
  const FileText text(bytes, "n");
  const JsonDocument document(text);
  const Eigen::VectorXd again = ReadInfiniteVector(document.root());
  ASSERT_EQ(again.size(), numbers.size());
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(std::signbit(again(i)), std::signbit(numbers(i)));
    EXPECT_EQ(again(i), numbers(i)) << bytes;
  }
}

}  // namespace
}  // namespace switchyard::io
