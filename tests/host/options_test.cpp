// Options of backends: names that are nearly right, ranges, and how they reach an instance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "switchyard/error.hpp"
#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {
using testing::ElementsAre;
using testing::Pair;

constexpr std::uint32_t kSize = sizeof(sy_option);
const char* const kChoices[] = {"simplex", "ipm", nullptr};
const sy_option kTolerance = {kSize, 0, "tolerance", "how near", {SY_REAL, 0, {}}, 0, 1, nullptr};
const sy_option kRounds = {kSize, 0, "rounds", "how often", {SY_INTEGER, 0, {}}, -1, 100, nullptr};
const sy_option kPresolve = {kSize, 0, "presolve", "first?", {SY_INTEGER, 0, {}}, 0, 1, nullptr};
const sy_option kMethod = {kSize, 0, "method", "which", {SY_TEXT, 0, {}}, 0, 0, kChoices};
const sy_option kFile = {kSize, 0, "file", "where", {SY_TEXT, 0, {}}, 0, 0, nullptr};
const sy_option* const kOptions[] = {&kTolerance, &kRounds, &kPresolve, &kMethod, &kFile, nullptr};

template <class Call>
std::string Said(Call&& call) {
  try {
    call();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "(nothing was thrown)";
}

class Options : public testing::Test {
 protected:
  Options() {
    script_.table.options = kOptions;
    Add(host_, script_);
  }
  std::string Set(const std::string& name, const std::string& value) {
    return Said([&] { host_.SetOption("scripted", name, value); });
  }
  Script script_;
  Host host_{Nowhere()};
};

TEST_F(Options, AnUnknownNameIsSaidWithTheNearest) {
  EXPECT_EQ(Set("tolerence", "0.1"),
            "org.fake.scripted has no option \"tolerence\"; the nearest is \"tolerance\"");
  EXPECT_EQ(Set("xyzzy_quux", "1"), "org.fake.scripted has no option \"xyzzy_quux\"");
  EXPECT_EQ(Said([&] { host_.SetOption("scriptd", "rounds", "1"); }),
            "there is no backend \"scriptd\" to set rounds of; the nearest is \"scripted\"");
}

TEST_F(Options, AValueOutOfItsRangeIsSaid) {
  EXPECT_EQ(Set("tolerance", "2"), "option tolerance needs a number from 0 to 1, got 2");
  EXPECT_EQ(Set("tolerance", "nan"), "option tolerance needs a number, got \"nan\"");
  EXPECT_EQ(Set("tolerance", ""), "option tolerance needs a number, got \"\"");
  EXPECT_EQ(Set("tolerance", "1e-3x"), "option tolerance needs a number, got \"1e-3x\"");
  EXPECT_EQ(Set("rounds", "101"), "option rounds needs an integer from -1 to 100, got 101");
  EXPECT_EQ(Set("rounds", "1.5"), "option rounds needs an integer, got \"1.5\"");
  EXPECT_EQ(Set("rounds", "99999999999999999999"),
            "option rounds needs an integer, got \"99999999999999999999\"");
  EXPECT_EQ(Set("presolve", "maybe"), "option presolve needs true or false, got \"maybe\"");
  EXPECT_EQ(Set("method", "barrier"), "option method needs one of simplex, ipm; got \"barrier\"");
}

TEST_F(Options, EveryInstanceGetsThemAsWhatTheyAre) {
  for (const auto& [name, value] :
       {std::pair("tolerance", "0.25"), std::pair("rounds", "-1"), std::pair("presolve", "off"),
        std::pair("method", "ipm"), std::pair("file", "a b")}) {
    EXPECT_EQ(Set(name, value), "(nothing was thrown)");
  }
  const Session session(host_, script_);
  EXPECT_THAT(script_.options,
              testing::UnorderedElementsAre(Pair("tolerance", "0.250000"), Pair("rounds", "-1"),
                                            Pair("presolve", "0"), Pair("method", "ipm"),
                                            Pair("file", "a b")));
  script_.options.clear();
  host_.ClearOptions();
  const Session another(host_, script_);
  EXPECT_TRUE(script_.options.empty());
}

TEST_F(Options, OneThatIsNotInTheTableReachesABackendThatJudgesItself) {
  Script open("org.fake.open");
  open.table.traits = SY_OPEN_OPTIONS;
  Add(host_, open);
  host_.SetOption("open", "anything", "goes");
  const Session session(host_, open);
  EXPECT_THAT(open.options, ElementsAre(Pair("anything", "goes")));
}

TEST_F(Options, AStrategysOwnSettingIsCheckedByTheHost) {
  Session session(host_, script_);
  sy_value value{};
  EXPECT_THAT(Failed([&] { session.instance().SetOption("round", value); }, SY_E_ARGUMENT),
              testing::HasSubstr("the nearest is \"rounds\""));
}

TEST(NearestName, IsNearOrNone) {
  EXPECT_EQ(NearestName("highs", {"clp", "highs"}), "highs");
  EXPECT_EQ(NearestName("higs", {"clp", "highs"}), "highs");
  EXPECT_EQ(NearestName("gurobi", {"clp", "highs"}), "");
  EXPECT_EQ(NearestName("", {}), "");
}

}  // namespace
}  // namespace switchyard::test
