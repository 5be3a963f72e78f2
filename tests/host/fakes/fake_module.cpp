// One plugin for each way of misbehaving: the compile definition FAKE says which one this is.
// Where it works it is a linear program over a box: x[i] goes to the bound that q[i] asks for.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "switchyard/abi.h"

#define WELL_BEHAVED 0
#define ENTRY_ABSENT 1
#define ENTRY_OF_VERSION_2 2
#define ENTRY_RETURNS_NULL 3
#define ENTRY_THROWS 4
#define MAJOR_9 5
#define SHORT_PLUGIN 6
#define SHORT_SOLVER 7
#define NO_ID 8
#define NEEDS_LIBRARY 9
#define NEEDS_SYMBOL 10
#define OLD_TABLE 11
#define NOT_READY 12
#define LOAD_THROWS 13
#define THROWS_NO_EXCEPTION_CLASS 14
#define NO_SOLVERS 15
#define TABLES_ALONE 16

#ifndef FAKE_ID
#define FAKE_ID "org.fake.module"
#endif
#ifndef FAKE_VERSION
#define FAKE_VERSION "1.0"
#endif

extern "C" int fake_dependency();     // of a library that is not on the run path
extern "C" int fake_symbol_absent();  // of no library

namespace {

struct Box {
  const sy_problem* problem;
};

Box& As(sy_instance* instance) { return *reinterpret_cast<Box*>(instance); }

sy_status Create(const sy_solver*, const sy_host*, sy_instance** out, sy_error*) noexcept {
  *out = reinterpret_cast<sy_instance*>(new Box{});
  return SY_OK;
}

void Destroy(sy_instance* instance) noexcept { delete &As(instance); }

sy_status SetOption(sy_instance*, const char*, const sy_value*, sy_error*) noexcept {
  return SY_OK;
}

sy_status Load(sy_instance* instance, const sy_problem* problem, std::uint64_t, sy_error*) {
#if FAKE == LOAD_THROWS
  throw std::runtime_error("thrown through the table");
#elif FAKE == THROWS_NO_EXCEPTION_CLASS
  throw 7;
#endif
  As(instance).problem = problem;
  return SY_OK;
}

sy_status Solve(sy_instance* instance, const sy_control*, sy_result* result, sy_error*) noexcept {
  const sy_problem& problem = *As(instance).problem;
  double objective = problem.offset;
  for (std::int32_t i = 0; i < problem.num_vars; ++i) {
    const double x = problem.q[i] > 0 ? problem.x_lower[i] : problem.x_upper[i];
    objective += problem.q[i] * x;
    if (result->x != nullptr) result->x[i] = x;
  }
  result->termination = SY_OPTIMAL;
  result->primal = SY_FEASIBLE;
  result->objective = result->bound = objective;
  return SY_OK;
}

#if FAKE == NOT_READY
sy_status Ready(const sy_solver*, const sy_host* host, sy_facts*, sy_error* error) noexcept {
  const char* license = host->setting(host->context, FAKE_ID, "license");
  if (license != nullptr) return SY_OK;
  const char text[] = "no license: set the setting license";
  for (std::size_t i = 0; i < sizeof text; ++i) error->text[i] = text[i];
  return error->code = SY_E_RESOURCE;
}
#endif

sy_solver Table() {
  sy_solver t{};
  t.size = FAKE == SHORT_SOLVER ? offsetof(sy_solver, solve)
           : FAKE == OLD_TABLE  ? offsetof(sy_solver, solve) + sizeof t.solve
                                : sizeof t;
  t.id = FAKE == NO_ID ? nullptr : FAKE_ID;
  t.name = "Fake";
  t.version = FAKE_VERSION;
  t.accepts = SY_ACCEPTS_BOUNDS;
  t.create = Create;
  t.destroy = Destroy;
  t.set_option = SetOption;
  t.load = reinterpret_cast<decltype(t.load)>(Load);
  t.solve = Solve;
#if FAKE == OLD_TABLE
  // What an older author's memory holds behind its record is nobody's business.
  t.update = reinterpret_cast<decltype(t.update)>(std::uintptr_t{0x10});
  t.supports = reinterpret_cast<decltype(t.supports)>(std::uintptr_t{0x10});
  t.ready = reinterpret_cast<decltype(t.ready)>(std::uintptr_t{0x10});
#elif FAKE == NOT_READY
  t.ready = Ready;
#endif
  return t;
}

#if FAKE == TABLES_ALONE
const void* Extension(const char* id) noexcept {
  static const int table = 17;
  return std::strcmp(id, "test.seventeen/1") == 0 ? &table : nullptr;
}
constexpr auto kExtension = Extension;
#else
constexpr std::nullptr_t kExtension = nullptr;
#endif

const sy_plugin* Plugin() {
  static const sy_solver solver = Table();
  static const sy_solver* const solvers[] = {FAKE == NO_SOLVERS ? nullptr : &solver, nullptr};
  static const sy_plugin plugin = {FAKE == SHORT_PLUGIN ? 16 : sizeof(sy_plugin),
                                   FAKE == MAJOR_9 ? 9 : SY_ABI_MAJOR,
                                   SY_ABI_MINOR,
                                   "fake",
                                   FAKE_VERSION,
                                   FAKE == TABLES_ALONE ? nullptr : solvers,
                                   kExtension};
#if FAKE == NEEDS_LIBRARY
  if (fake_dependency() != 0) return nullptr;
#elif FAKE == NEEDS_SYMBOL
  if (fake_symbol_absent() != 0) return nullptr;
#endif
  return &plugin;
}

}  // namespace

#if FAKE == ENTRY_THROWS
extern "C" SY_EXPORT const sy_plugin* ThrowingEntry() __asm__(SY_PLUGIN_ENTRY);
const sy_plugin* ThrowingEntry() { throw std::runtime_error(Plugin()->name); }
#elif FAKE == ENTRY_RETURNS_NULL
const sy_plugin* switchyard_plugin_v1() noexcept {
  return Plugin() == nullptr ? Plugin() : nullptr;
}
#elif FAKE == ENTRY_ABSENT
extern "C" SY_EXPORT const sy_plugin* another_name() { return Plugin(); }
#elif FAKE == ENTRY_OF_VERSION_2
extern "C" SY_EXPORT const sy_plugin* switchyard_plugin_v2() { return Plugin(); }
#else
const sy_plugin* switchyard_plugin_v1() noexcept { return Plugin(); }
#endif
