#include "core/io/text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/io/name_index.hpp"

namespace switchyard::io {
namespace {

TEST(Numbers, AreReadAsCAndFortranWriteThem) {
  const auto number = [](std::string_view field) {
    double value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(ParseNumber(field, &value)) << field;
    return value;
  };
  EXPECT_EQ(number("1"), 1);
  EXPECT_EQ(number("1."), 1);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("+2.5e-3"), 2.5e-3);
  EXPECT_EQ(number("-1.5D+02"), -150);
  EXPECT_EQ(number("1d3"), 1000);
  EXPECT_EQ(number("5e-324"), 5e-324);
}

TEST(Numbers, OfOtherKindsAreNone) {
  double value = 0;
  for (const char* field : {"", "+", "-", "x", "1x", "1e", "1e400", "-1e400", "nan", "inf", "+-1",
                            "0x10", "1D", "1,5", "--1", "1d2d3", "1e2d3"}) {
    EXPECT_FALSE(ParseNumber(field, &value)) << field;
  }
}

TEST(Quotes, ShowBytesThatATerminalWouldNot) {
  EXPECT_EQ(Quoted("a\tb\x01"), "\"a\\x09b\\x01\"");
  EXPECT_EQ(Quoted("\xC3\xA4\xE4"), "\"\xC3\xA4\\xE4\"");
  EXPECT_EQ(Quoted(std::string(100, 'a')), Text('"', std::string(60, 'a'), "...\""));
}

TEST(Lines, EndInAnyCustomAndTheLastNeedsNone) {
  const FileText text("a\r\n\nb \t\nc", "f");
  Lines lines(text);
  std::string all;
  while (lines.Next()) all += Text("[", lines.line(), "]");
  EXPECT_EQ(all, "[a][][b][c]");
}

TEST(Names, ThatAreNotUtf8AreReadAsLatin1) {
  std::vector<std::string> said;
  Notes notes(&said);
  EXPECT_EQ(Utf8("K\xF6ln", &notes), "K\xC3\xB6ln");
  EXPECT_EQ(Utf8("K\xC3\xB6ln", &notes), "K\xC3\xB6ln");
  notes.Finish();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0], "a name that is not UTF-8 is read as Latin-1 (\"K\xC3\xB6ln\")");
}

TEST(NameIndex, FindsEachNameItWasGivenAndNoOther) {
  std::vector<std::string> names;
  for (int i = 0; i < 5000; ++i) names.push_back(Text("name", i));
  NameIndex index;
  EXPECT_EQ(index.Find("name0"), -1);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(index.Add(names[static_cast<std::size_t>(i)]), i);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(index.Find(names[static_cast<std::size_t>(i)]), i);
  EXPECT_EQ(index.Add("name17"), -1);
  EXPECT_EQ(index.Find("name5000"), -1);
  EXPECT_EQ(index.size(), 5000);
}

}  // namespace
}  // namespace switchyard::io
