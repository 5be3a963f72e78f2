// The host's table over a backend that answers badly, fails, or runs one at a time.
#include "core/host/facade.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {
using testing::Contains;
using testing::Each;
using testing::HasSubstr;

TEST(Facade, GivesABackendItsOwnTable) {
  Script script;
  Host host(Nowhere());
  Add(host, script);
  const Session session(host, script);
  EXPECT_EQ(script.self, &script.table);
}

TEST(Facade, SaysThatCreateFailed) {
  Script script;
  script.create = [] { throw plugin::Failure(SY_E_RESOURCE, "no seat is free"); };
  Host host(Nowhere());
  Add(host, script);
  EXPECT_EQ(Failed([&] { Session(host, script); }, SY_E_RESOURCE),
            "org.fake.scripted: no seat is free");
}

TEST(Facade, RefusesAnInstanceThatIsNone) {
  Script script;
  script.table.create = [](const sy_solver*, const sy_host*, sy_instance**, sy_error*) noexcept {
    return sy_status{SY_OK};
  };
  Host host(Nowhere());
  Add(host, script);
  EXPECT_EQ(Failed([&] { Session(host, script); }, SY_E_INTERNAL),
            "org.fake.scripted: create gave no instance");
}

TEST(Facade, ReadsAnErrorThatHasNoTextOrNoEnd) {
  Script script;
  script.table.create = [](const sy_solver*, const sy_host*, sy_instance**,
                           sy_error* error) noexcept {
    std::fill(std::begin(error->text), std::end(error->text), 'a');
    return sy_status{SY_E_INTERNAL};
  };
  Host host(Nowhere());
  Add(host, script);
  EXPECT_THAT(Failed([&] { Session(host, script); }, SY_E_INTERNAL), HasSubstr("aaaa"));

  Script silent("org.fake.silent");
  silent.table.create = [](const sy_solver*, const sy_host*, sy_instance**, sy_error*) noexcept {
    return sy_status{SY_E_INTERNAL};
  };
  Add(host, silent);
  EXPECT_EQ(Failed([&] { Session(host, silent); }, SY_E_INTERNAL),
            "org.fake.silent: no reason given");
}

TEST(Facade, RefusesNumbersThatAreNone) {
  for (const double bad : {kNaN, kInfinity}) {
    Script script;
    script.solve = [&](const sy_control&, sy_result& r) {
      r.termination = SY_OPTIMAL;
      r.primal = SY_FEASIBLE;
      r.x[0] = 1;
      r.x[1] = bad;
    };
    Host host(Nowhere());
    Add(host, script);
    Session session(host, script);
    session.Load(SmallLp());
    const Answer answer = session.Solve();
    EXPECT_EQ(answer.status, SY_E_INTERNAL);
    EXPECT_EQ(answer.error, Text("org.fake.scripted: it returned ", bad, " in x[1]"));
  }
}

TEST(Facade, ReadsWordsOfANewerAuthorAsNothing) {
  Script script;
  script.solve = [](const sy_control&, sy_result& r) {
    r.termination = 99;
    r.primal = 42;
    r.dual = -3;
  };
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  const Answer answer = session.Solve();
  EXPECT_EQ(answer.status, SY_OK);
  EXPECT_EQ(answer.result.termination, SY_NOT_SOLVED);
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
  EXPECT_EQ(answer.result.dual, SY_NO_POINT);
}

TEST(Facade, TakesSilenceForNoAnswer) {
  Script script;
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  script.solve = [](const sy_control&, sy_result&) {};
  // What a caller left in the record from the time before is not an answer either.
  sy_result result{};
  result.size = sizeof result;
  result.termination = SY_OPTIMAL;
  result.primal = SY_FEASIBLE;
  result.dual = SY_FEASIBLE;
  result.objective = 5;
  result.bound = 5;
  session.instance().Solve(Freely(), result);
  EXPECT_EQ(result.termination, SY_NOT_SOLVED);
  EXPECT_EQ(result.primal, SY_NO_POINT);
  EXPECT_EQ(result.dual, SY_NO_POINT);
  EXPECT_TRUE(std::isnan(result.objective));
  EXPECT_EQ(result.bound, -kInfinity);
}

TEST(Facade, WantsNoBufferThatTheCallerDoesNotWant) {
  Script script;
  script.table.accepts = SY_ACCEPTS_ROWS;  // a bridge stands between
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  sy_result result{};
  result.size = sizeof result;
  session.instance().Solve(Freely(), result);
  EXPECT_EQ(result.termination, SY_OPTIMAL);
  EXPECT_EQ(result.x, nullptr);
}

TEST(Facade, KeepsTheOrderOfCalls) {
  Script script;
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  EXPECT_EQ(session.Solve().status, SY_E_STATE);
  EXPECT_THAT(session.Solve().error, HasSubstr("call load first"));
  EXPECT_NE(Failed([&] { session.WarmStart({}); }, SY_E_STATE), "");
  script.load = [] { throw plugin::Failure(SY_E_RESOURCE, "too large"); };
  EXPECT_EQ(Failed([&] { session.Load(SmallLp()); }, SY_E_RESOURCE),
            "org.fake.scripted: too large");
  EXPECT_EQ(session.Solve().status, SY_E_STATE);
  script.load = nullptr;
  session.Load(SmallLp());
  EXPECT_EQ(session.Solve().status, SY_OK);
}

TEST(Facade, ChecksAProblemBeforeTheBackendSeesIt) {
  Script script;
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  ProblemData d = SmallLp();
  d.x_lower[1] = 5;
  EXPECT_THAT(Failed([&] { session.Load(d); }, SY_E_ARGUMENT),
              HasSubstr("x[1] has lower bound 5 above its upper bound 4"));
  EXPECT_THAT(script.calls, testing::Not(Contains("load")));
}

TEST(Facade, SaysWhatABackendDoesNotTake) {
  Script script;
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  ProblemData d = SmallLp();
  d.integer = {1, 0};
  EXPECT_THAT(Failed([&] { session.Load(d); }, SY_E_UNSUPPORTED),
              HasSubstr("does not take integer variables"));
  EXPECT_THAT(Failed([&] { session.Load(SmallCones()); }, SY_E_UNSUPPORTED),
              HasSubstr("does not take"));
}

TEST(Facade, MapsAStartThroughItsBridges) {
  Script script;
  script.table.accepts = SY_ACCEPTS_ROWS;  // so bounds become rows 2 and 3
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  const double x[] = {0.5, 0.5};
  const double row_dual[] = {1, 0};
  const double x_dual[] = {0, 7};
  const std::uint8_t basis[] = {1, 1};
  sy_start start{};
  start.size = sizeof start;
  start.x = x;
  start.row_dual = row_dual;
  start.x_dual = x_dual;
  start.x_basis = basis;
  session.WarmStart(start);
  EXPECT_THAT(script.start_x, testing::ElementsAre(0.5, 0.5));
  EXPECT_THAT(script.start_row_dual, testing::ElementsAre(1, 0, 0, 7));
  EXPECT_FALSE(script.start_has_basis);
}

TEST(Facade, AStartIsAWish) {
  Script script;
  script.table.warm_start = nullptr;
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  sy_start start{};
  start.size = sizeof start;
  EXPECT_NO_THROW(session.WarmStart(start));
}

// ---- One at a time -----------------------------------------------------------------------------

/// A slow backend that says so, and may be made to say the contrary.
void MakeSlow(Script& script, std::uint64_t traits) {
  script.table.traits = traits;
  script.table.update = nullptr;
  const auto slow = [] { std::this_thread::sleep_for(std::chrono::milliseconds(3)); };
  script.create = script.load = slow;
  script.solve = [slow](const sy_control&, sy_result&) { slow(); };
}

void UseFromThreads(Script& script) {
  Host host(Nowhere());
  Add(host, script);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k) {
        Session session(host, script);
        session.Load(SmallLp());
        EXPECT_EQ(session.Solve().error, "");
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(OneAtATime, NoTwoThreadsAreInsideAtOnce) {
  Script script;
  MakeSlow(script, SY_ONE_AT_A_TIME);
  UseFromThreads(script);
  EXPECT_EQ(script.most_inside, 1);
}

TEST(OneAtATime, OthersRunSideBySide) {
  Script script;
  MakeSlow(script, 0);
  UseFromThreads(script);
  EXPECT_GT(script.most_inside, 1);
}

/// What nested uses of a backend said, from a hook of its own solve.
struct Nested {
  Host& host;
  Script& script;
  Session& second;  // loaded before
  std::string created, solved;

  void Try() {
    created = Failed([&] { Session(host, script); }, SY_E_STATE);
    solved = second.Solve().error;
  }
};

void ExpectRefused(bool on_a_thread_of_its_own) {
  Script script;
  script.table.traits = SY_ONE_AT_A_TIME;
  script.solve = [&](const sy_control& control, sy_result& result) {
    sy_progress progress{};
    progress.size = sizeof progress;
    const auto report = [&] { control.progress(control.context, &progress); };
    if (on_a_thread_of_its_own) {
      std::thread(report).join();
    } else {
      report();
    }
    result.termination = SY_OPTIMAL;
  };
  Host host(Nowhere());
  Add(host, script);
  Session first(host, script);
  Session second(host, script);
  first.Load(SmallLp());
  second.Load(SmallLp());
  Nested nested{host, script, second, "", ""};
  sy_control control = Freely();
  control.context = &nested;
  control.progress = [](void* context, const sy_progress*) noexcept -> std::int32_t {
    static_cast<Nested*>(context)->Try();
    return 0;
  };
  const Answer answer = first.Solve(control);
  EXPECT_EQ(answer.result.termination, SY_OPTIMAL);
  const std::string need = "it cannot be used from inside its own solve";
  EXPECT_THAT(nested.created, HasSubstr(need));
  EXPECT_THAT(nested.solved, HasSubstr(need));
  EXPECT_EQ(second.Solve().error, "") << "afterwards it can be used again";
}

TEST(OneAtATime, AUseFromItsOwnHookIsAnErrorAndNoDeadlock) { ExpectRefused(false); }

TEST(OneAtATime, SoItIsWhereTheBackendCallsTheHookFromAThreadOfItsOwn) { ExpectRefused(true); }

TEST(OneAtATime, AnInstanceMayEndInsideAHook) {
  Script script;
  script.table.traits = SY_ONE_AT_A_TIME;
  script.solve = [](const sy_control& control, sy_result&) { control.cancelled(control.context); };
  Host host(Nowhere());
  Add(host, script);
  Session first(host, script);
  first.Load(SmallLp());
  auto second = std::make_unique<Session>(host, script);
  sy_control control = Freely();
  control.context = &second;
  control.cancelled = [](void* context) noexcept -> std::int32_t {
    static_cast<std::unique_ptr<Session>*>(context)->reset();
    return 0;
  };
  EXPECT_EQ(first.Solve(control).error, "");
  EXPECT_EQ(second, nullptr);
}

TEST(OneAtATime, AnotherBackendMayBeUsedFromAHook) {
  Script outer("org.fake.outer");
  Script inner("org.fake.inner");
  outer.table.traits = inner.table.traits = SY_ONE_AT_A_TIME;
  Host host(Nowhere());
  Add(host, outer);
  Add(host, inner);
  outer.solve = [&](const sy_control&, sy_result& result) {
    Session nested(host, inner);
    nested.Load(SmallLp());
    result.termination = nested.Solve().result.termination;
  };
  Session session(host, outer);
  session.Load(SmallLp());
  EXPECT_EQ(session.Solve().result.termination, SY_OPTIMAL);
}

}  // namespace
}  // namespace switchyard::test
