// Options of relax-and-round: each has its range, and what does not fit is a sentence.
#include "solvers/rounding/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "switchyard/plugin.hpp"

namespace switchyard::test {
namespace {

using rounding::Options;
using testing::HasSubstr;
using testing::StartsWith;

sy_value Integer(std::int64_t value) {
  sy_value v{};
  v.type = SY_INTEGER;
  v.as.integer = value;
  return v;
}
sy_value Real(double value) {
  sy_value v{};
  v.type = SY_REAL;
  v.as.real = value;
  return v;
}
sy_value Text(const char* value) {
  sy_value v{};
  v.type = SY_TEXT;
  v.as.text = value;
  return v;
}

std::string Refusal(const std::string& name, const sy_value& value) {
  Options options;
  try {
    options.Set(name, value);
  } catch (const plugin::Failure& why) {
    return why.what();
  }
  return "";
}

TEST(RoundingOptions, TakeTheirDefaultAndTheEndsOfTheirRange) {
  for (const sy_option* const* row = rounding::OptionTable(); *row != nullptr; ++row) {
    const sy_option& option = **row;
    EXPECT_EQ(Refusal(option.name, option.fallback), "");
    EXPECT_STRNE(option.help, "");
    for (const double end : {option.lower, option.upper}) {
      if (option.fallback.type == SY_INTEGER) {
        EXPECT_EQ(Refusal(option.name, Integer(static_cast<std::int64_t>(end))), "");
      } else if (option.fallback.type == SY_REAL) {
        EXPECT_EQ(Refusal(option.name, Real(end)), "");
      }
    }
  }
}

TEST(RoundingOptions, RefuseWhatIsOutOfRangeInASentenceThatSaysWhatCame) {
  for (const sy_option* const* row = rounding::OptionTable(); *row != nullptr; ++row) {
    const sy_option& option = **row;
    const std::string begin = std::string("option ") + option.name + " lies in [";
    if (option.fallback.type == SY_INTEGER) {
      for (const double out : {option.lower - 1, option.upper + 1}) {
        const auto value = static_cast<std::int64_t>(out);
        EXPECT_THAT(Refusal(option.name, Integer(value)), StartsWith(begin));
        EXPECT_THAT(Refusal(option.name, Integer(value)),
                    HasSubstr("]; " + std::to_string(value) + " came"));
      }
    } else if (option.fallback.type == SY_REAL) {
      for (const double out : {option.lower - 0.5, option.upper + 0.5, std::nan("")}) {
        EXPECT_THAT(Refusal(option.name, Real(out)), StartsWith(begin));
      }
    }
  }
}

TEST(RoundingOptions, RefuseAnotherType) {
  for (const sy_option* const* row = rounding::OptionTable(); *row != nullptr; ++row) {
    const sy_option& option = **row;
    const std::string begin = std::string("option ") + option.name + " takes a";
    switch (option.fallback.type) {
      case SY_INTEGER:
        EXPECT_THAT(Refusal(option.name, Real(1.5)), StartsWith(begin + "n integer; 1.5 came"));
        EXPECT_THAT(Refusal(option.name, Text("many")),
                    StartsWith(begin + "n integer; 'many' came"));
        break;
      case SY_REAL:
        EXPECT_EQ(Refusal(option.name, Integer(1)), "");  // serves for a real
        EXPECT_THAT(Refusal(option.name, Text("few")),
                    StartsWith(begin + " real number; 'few' came"));
        break;
      default:
        EXPECT_THAT(Refusal(option.name, Integer(3)), StartsWith(begin + " text; 3 came"));
        EXPECT_THAT(Refusal(option.name, Text(nullptr)), StartsWith(begin + " text; '' came"));
    }
  }
}

TEST(RoundingOptions, KnowNoOtherName) {
  EXPECT_EQ(Refusal("cuts", Integer(1)), "relax-and-round has no option 'cuts'");
}

}  // namespace
}  // namespace switchyard::test
