// Which backend serves: ranking, "sy.solvers/1" as a strategy asks it, settings and the log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <map>

#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint64_t kIntegers = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_INTEGER;

/// A host with four backends: `plain` (LP), `rich` (LP with duals, cheap updates, limits), `whole`
/// (MILP) and `plan` (a strategy over others).
class Find : public testing::Test {
 protected:
  Find() {
    rich_.table.traits = SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_ONE_AT_A_TIME;
    rich_.table.updates = SY_UPDATES_BOUNDS;
    rich_.table.honors = SY_HONORS_SECONDS | SY_HONORS_CANCELLED;
    whole_.table.integer_accepts = kIntegers;
    whole_.table.accepts = kIntegers;
    plan_.table.traits = SY_STRATEGY;
    for (Script* script : {&plain_, &rich_, &whole_, &plan_}) Add(host_, *script);
    unsetenv("SWITCHYARD_SOLVERS");
    wish_.size = sizeof wish_;
    wish_.problem = &lp_.view();
    wish_.instances = 1;
  }

  /// The id of what a strategy gets; or, where it gets nothing, what is said.
  std::string Ask() {
    const sy_host& table = *host_.table();
    const auto& solvers =
        *static_cast<const sy_solvers*>(table.extension(table.context, "sy.solvers/1"));
    sy_error error{};
    const sy_solver* found = solvers.find(solvers.context, &wish_, &error);
    EXPECT_EQ(found == nullptr, error.text[0] != '\0');
    return found != nullptr ? found->id : error.text;
  }
  std::vector<std::string> Ranked(const sy_problem& problem, const std::string& names = "") {
    std::vector<std::string> ids;
    for (const Candidate& c : host_.Rank(problem, names)) {
      ids.push_back(c.backend->short_name + (c.suitable ? "" : ": " + c.why));
    }
    return ids;
  }

  Script plain_{"org.fake.plain"}, rich_{"org.fake.rich"}, whole_{"org.fake.whole"},
      plan_{"org.fake.plan"};
  Host host_{Nowhere()};
  Problem lp_{SmallLp()};
  sy_wish wish_{};
};

TEST_F(Find, TheOneThatCanBeKnownMostIsFirstAndNoStrategyIsAmongThem) {
  EXPECT_THAT(Ranked(lp_.view()), ElementsAre("rich", "plain", "whole"));
}

TEST_F(Find, ThoseThatCannotComeLastWithTheReason) {
  lp_.Change([](ProblemData& d) { d.integer = {1, 0}; });
  const auto ranked = Ranked(lp_.view());
  EXPECT_THAT(ranked, ElementsAre("whole", "rich: does not take integer variables",
                                  "plain: does not take integer variables"));
}

TEST_F(Find, NamesAreAnOrderAndNothingElseIsConsidered) {
  EXPECT_THAT(Ranked(lp_.view(), "whole,org.fake.plain"), ElementsAre("whole", "plain"));
  EXPECT_THAT(Ranked(lp_.view(), "plan"), ElementsAre("plan"));
  EXPECT_THAT(Ranked(lp_.view(), "nobody"), ElementsAre());
}

TEST_F(Find, TheUsersOrderComesFirstAndTheRestBehindIt) {
  setenv("SWITCHYARD_SOLVERS", "whole,nobody", 1);
  EXPECT_THAT(Ranked(lp_.view()), ElementsAre("whole", "rich", "plain"));
  EXPECT_THAT(Ranked(lp_.view(), "plain"), ElementsAre("plain"));
  unsetenv("SWITCHYARD_SOLVERS");
}

TEST_F(Find, OneThatIsNotReadyOrRefusesThisProblemIsNotSuitable) {
  Script unready("org.fake.unready");
  unready.table.ready = [](const sy_solver*, const sy_host*, sy_facts*, sy_error* e) noexcept {
    std::strcpy(e->text, "no device");
    return sy_status{SY_E_RESOURCE};
  };
  Script picky("org.fake.picky");
  picky.table.supports = [](const sy_solver*, const sy_host*, const sy_problem* problem,
                            sy_error* e) noexcept {
    EXPECT_EQ(problem->num_vars, 2);
    std::strcpy(e->text, "row[1] is too long");
    return sy_status{SY_E_UNSUPPORTED};
  };
  Add(host_, unready);
  Add(host_, picky);
  EXPECT_THAT(Ranked(lp_.view(), "unready,picky,plain"),
              ElementsAre("plain", "unready: not ready: no device", "picky: row[1] is too long"));
}

TEST_F(Find, AStrategyGetsTheHostsTableOverTheBest) {
  EXPECT_EQ(Ask(), "org.fake.rich");
  const sy_host& table = *host_.table();
  const auto& solvers =
      *static_cast<const sy_solvers*>(table.extension(table.context, "sy.solvers/1"));
  sy_error error{};
  EXPECT_EQ(solvers.find(solvers.context, &wish_, &error), host_.Facade(*host_.Find("rich")));
  EXPECT_EQ(table.extension(table.context, "sy.unknown/1"), nullptr);
  EXPECT_EQ(table.extension(table.context, nullptr), nullptr);
}

TEST_F(Find, RanksGoOnToTheNextOnesAndEnd) {
  EXPECT_EQ(Ask(), "org.fake.rich");
  wish_.rank = 1;
  EXPECT_EQ(Ask(), "org.fake.plain");
  wish_.rank = 2;
  EXPECT_EQ(Ask(), "org.fake.whole");
  wish_.rank = 3;
  EXPECT_EQ(Ask(), "there is none of rank 3, only 3 would serve");
  wish_.rank = -1;
  EXPECT_EQ(Ask(), "a wish needs a rank from 0 on, got -1");
}

TEST_F(Find, NamesDecideWhereTheyAreGiven) {
  wish_.names = "whole,plain";
  EXPECT_EQ(Ask(), "org.fake.whole");
  wish_.names = "nobody,plain";
  EXPECT_EQ(Ask(), "org.fake.plain");
  wish_.names = "plan";
  EXPECT_EQ(Ask(), "org.fake.plan");
  wish_.names = "nobody";
  EXPECT_EQ(Ask(), "nobody: there is none of that name");
}

TEST_F(Find, TraitsAndLimitsThatAreNeededExcludeThoseWithout) {
  wish_.traits = SY_GIVES_DUALS;
  wish_.rank = 1;
  EXPECT_EQ(Ask(),
            "plain: lacks a trait that is needed; whole: lacks a trait that is needed; "
            "there is none of rank 1, only 1 would serve");
  wish_.rank = 0;
  wish_.traits = 0;
  wish_.honors = SY_HONORS_NODES;
  EXPECT_THAT(Ask(), AllOf(HasSubstr("plain: does not keep a limit that is needed"),
                           HasSubstr("rich: does not keep"), HasSubstr("whole: does not keep")));
  // Time is kept by the host where the backend asks whether to stop.
  plain_.table.honors = SY_HONORS_CANCELLED;
  Script asks("org.fake.asks");
  asks.table.honors = SY_HONORS_CANCELLED;
  Add(host_, asks);
  wish_.honors = SY_HONORS_SECONDS;
  wish_.names = "asks";
  EXPECT_EQ(Ask(), "org.fake.asks");
}

TEST_F(Find, WhereNoneWillDoEachIsNamedWithItsReason) {
  lp_.Change([](ProblemData& d) { d.integer = {1, 0}; });
  wish_.traits = SY_PROVES_GLOBAL;
  EXPECT_EQ(Ask(),
            "whole: lacks a trait that is needed; rich: does not take integer variables; plain: "
            "does not take integer variables");
}

TEST_F(Find, CheapUpdatesAndManyInstancesAreBetter) {
  wish_.updates = SY_UPDATES_BOUNDS;
  EXPECT_EQ(Ask(), "org.fake.rich");
  wish_.instances = 4;  // and rich runs one at a time
  EXPECT_EQ(Ask(), "org.fake.plain");
}

TEST_F(Find, AWishOfAnOlderAuthorOrWithoutAProblemIsNoCrash) {
  wish_.size = offsetof(sy_wish, traits);
  wish_.traits = SY_PROVES_GLOBAL;  // behind its end
  EXPECT_EQ(Ask(), "org.fake.rich");
  wish_.size = sizeof wish_;
  wish_.traits = 0;
  wish_.problem = nullptr;
  EXPECT_EQ(Ask(), "a wish needs a problem");
}

TEST(FindWithoutBackends, SaysSo) {
  const Host host(Nowhere());
  const sy_host& table = *host.table();
  const auto& solvers =
      *static_cast<const sy_solvers*>(table.extension(table.context, "sy.solvers/1"));
  const Problem lp(SmallLp());
  sy_wish wish{};
  wish.size = sizeof wish;
  wish.problem = &lp.view();
  sy_error error{};
  EXPECT_EQ(solvers.find(solvers.context, &wish, &error), nullptr);
  EXPECT_STREQ(error.text, "no backend is there");
}

TEST_F(Find, TheTableOfTheHostTakesWhatBridgesReach) {
  Script conic("org.fake.conic");
  conic.table.accepts = 0;
  conic.table.cones = std::uint64_t{1} << SY_CONE_SECOND_ORDER |
                      std::uint64_t{1} << SY_CONE_NONNEGATIVE | std::uint64_t{1} << SY_CONE_ZERO;
  const sy_solver& facade = *host_.Facade(Add(host_, conic));
  EXPECT_NE(facade.accepts & SY_ACCEPTS_BOUNDS, 0U);
  EXPECT_NE(facade.accepts & SY_ACCEPTS_ROWS, 0U);
  EXPECT_NE(facade.accepts & SY_ACCEPTS_QUADRATIC_OBJECTIVE, 0U);
  EXPECT_EQ(facade.accepts & SY_ACCEPTS_INTEGER, 0U);
  EXPECT_NE(facade.cones & std::uint64_t{1} << SY_CONE_ROTATED, 0U);
  EXPECT_EQ(facade.cones & std::uint64_t{1} << SY_CONE_PSD, 0U);
  sy_error error{};
  Problem lp(SmallLp());
  EXPECT_EQ(facade.supports(&facade, host_.table(), &lp.view(), &error), SY_OK);
  lp.Change([](ProblemData& d) { d.integer = {1, 1}; });
  EXPECT_EQ(facade.supports(&facade, host_.table(), &lp.view(), &error), SY_E_UNSUPPORTED);
  EXPECT_THAT(error.text, HasSubstr("integer variables"));
}

TEST(Register, RefusesATableThatLacksWhatIsNeeded) {
  Script nameless, loadless;
  nameless.table.name = nullptr;
  loadless.table.load = nullptr;
  Host host(Nowhere());
  EXPECT_FALSE(host.Register(nameless.plugin, "the first"));
  EXPECT_EQ(host.problems().back().path, "the first");
  EXPECT_EQ(host.problems().back().reason, "org.fake.scripted has no name");
  EXPECT_FALSE(host.Register(loadless.plugin));
  EXPECT_EQ(host.problems().back().reason,
            "org.fake.scripted lacks one of create, destroy, set_option, load, solve");
  EXPECT_TRUE(host.backends().empty());
}

TEST(Setting, IsAskedOfTheUserAndStaysWhereItIs) {
  std::map<std::string, std::string> values = {{"org.fake.a/place", "here"}};
  HostOptions options = Nowhere();
  options.setting = [&](const std::string& id,
                        const std::string& name) -> std::optional<std::string> {
    const auto found = values.find(id + "/" + name);
    if (found == values.end()) return std::nullopt;
    return found->second;
  };
  const Host host(options);
  const sy_host& table = *host.table();
  const char* first = table.setting(table.context, "org.fake.a", "place");
  EXPECT_STREQ(first, "here");
  EXPECT_EQ(table.setting(table.context, "org.fake.a", "place"), first);
  EXPECT_EQ(table.setting(table.context, "org.fake.b", "place"), nullptr);
  const Host silent(Nowhere());
  EXPECT_EQ(silent.table()->setting(silent.table()->context, "org.fake.a", "place"), nullptr);
}

TEST(Setting, ThatThrowsIsNone) {
  HostOptions options = Nowhere();
  options.setting = [](const std::string&, const std::string&) -> std::optional<std::string> {
    throw std::runtime_error("the user's own");
  };
  const Host host(options);
  EXPECT_EQ(host.table()->setting(host.table()->context, "a", "b"), nullptr);
}

TEST(Log, GoesToTheSinkAndOneThatThrowsLosesItsLine) {
  Host host(Nowhere());
  const sy_host& table = *host.table();
  table.log(table.context, SY_LOG_INFO, "to nobody");
  std::vector<std::pair<sy_level, std::string>> lines;
  host.SetLog([&](sy_level level, const std::string& text) { lines.emplace_back(level, text); });
  table.log(table.context, SY_LOG_WARNING, "careful");
  table.log(table.context, SY_LOG_WARNING, nullptr);
  EXPECT_THAT(lines, ElementsAre(std::pair<sy_level, std::string>(SY_LOG_WARNING, "careful")));
  host.SetLog([](sy_level, const std::string&) { throw std::runtime_error("full"); });
  table.log(table.context, SY_LOG_ERROR, "lost");
}

}  // namespace
}  // namespace switchyard::test
