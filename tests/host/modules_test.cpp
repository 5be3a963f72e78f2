// What the host makes of files: plugins that are wrong in one way each, and files that are none.
#include <elf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <set>

#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string Fake(const std::string& name) { return SWITCHYARD_FAKES "/" + name + ".so"; }

/// What a host says of one file: "" where it gave a backend.
std::string Verdict(const std::string& path) {
  Host host(Nowhere());
  if (host.Load(path)) return "";
  EXPECT_EQ(host.problems().size(), 1U);
  EXPECT_EQ(host.problems().front().path, path);
  EXPECT_TRUE(host.backends().empty());
  return to_string(host.problems().front().state) + ": " + host.problems().front().reason;
}

std::string Bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder that goes with the test.
class Folder {
 public:
  Folder() {
    std::string pattern = fs::temp_directory_path() / "switchyard-host-XXXXXX";
    path_ = mkdtemp(pattern.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  [[nodiscard]] std::string path() const { return path_.string(); }
  std::string Write(const std::string& name, const std::string& bytes) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  std::string Copy(const std::string& fake, const std::string& name) const {
    return Write(name, Bytes(Fake(fake)));
  }

 private:
  fs::path path_;
};

/// A variable of the environment, as it was before once this is gone.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() {
    if (before_) {
      setenv(name_, before_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

double Optimum(const Host& host, const std::string& id) {
  Session session(host, *host.Find(id));
  ProblemData d;
  d.num_vars = 2;
  d.P = Csc(2, 2);
  d.A = d.F = Csc(0, 2);
  d.q = {2, -3};
  d.x_lower = {1, 0};
  d.x_upper = {9, 5};
  session.Load(d);
  const Answer answer = session.Solve();
  EXPECT_EQ(answer.error, "");
  return answer.result.objective;
}

TEST(Modules, AWellBehavedOneServes) {
  Host host(Nowhere());
  ASSERT_TRUE(host.Load(Fake("well_behaved")));
  ASSERT_EQ(host.backends().size(), 1U);
  EXPECT_EQ(host.backends()[0]->id, "org.fake.module");
  EXPECT_EQ(host.backends()[0]->short_name, "module");
  EXPECT_EQ(host.backends()[0]->plugin, "fake 1.0");
  EXPECT_EQ(host.backends()[0]->origin, Fake("well_behaved"));
  EXPECT_EQ(Optimum(host, "org.fake.module"), 2 * 1 - 3 * 5);
}

TEST(Modules, OneOfAnOlderAuthorServesThoughItsTableEndsAtSolve) {
  Host host(Nowhere());
  ASSERT_TRUE(host.Load(Fake("old_table")));
  EXPECT_EQ(host.Find("module")->facts.update, nullptr);
  EXPECT_TRUE(host.Ready(*host.Find("module")).ready);
  EXPECT_EQ(Optimum(host, "module"), 2 * 1 - 3 * 5);
}

TEST(Modules, EachWayOfBeingWrongIsSaid) {
  EXPECT_EQ(Verdict(Fake("entry_absent")),
            "not compatible: not a plugin: it has no symbol switchyard_plugin_v1");
  EXPECT_EQ(Verdict(Fake("entry_of_version_2")),
            "not compatible: made for version 2 of the plugin ABI, this host speaks 1");
  EXPECT_EQ(Verdict(Fake("entry_returns_null")),
            "not compatible: its entry switchyard_plugin_v1 returned nothing");
  EXPECT_EQ(Verdict(Fake("entry_throws")),
            "not compatible: its entry switchyard_plugin_v1 threw an exception");
  EXPECT_EQ(Verdict(Fake("major_9")),
            "not compatible: made for version 9 of the plugin ABI, this host speaks 1");
  EXPECT_EQ(Verdict(Fake("short_plugin")),
            "not compatible: the plugin's table is short: 16 bytes, at least 32 needed");
  EXPECT_THAT(Verdict(Fake("short_solver")),
              StartsWith("not compatible: a solver's table is short: "));
  EXPECT_EQ(Verdict(Fake("no_id")), "not compatible: a solver has no id");
  EXPECT_EQ(Verdict(Fake("no_solvers")),
            "not compatible: it offers no solver, and no table of another kind");
  EXPECT_EQ(Verdict(Fake("needs_library")),
            "not loadable: dependency absent: libfake_dependency.so is not on this machine");
  EXPECT_THAT(Verdict(Fake("needs_symbol")),
              AllOf(StartsWith("not loadable: symbol absent: "), HasSubstr("fake_symbol_absent")));
}

TEST(Modules, APluginMayOfferTablesThatAreNoSolvers) {
  Host host(Nowhere());
  ASSERT_TRUE(host.Load(Fake("well_behaved")));
  EXPECT_TRUE(host.Tables("test.seventeen/1").empty());
  ASSERT_TRUE(host.Load(Fake("tables_alone")));
  EXPECT_EQ(host.backends().size(), 1u);
  EXPECT_TRUE(host.Tables("test.eighteen/1").empty());
  const std::vector<PluginTable> found = host.Tables("test.seventeen/1");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(*static_cast<const int*>(found[0].table), 17);
  EXPECT_EQ(found[0].plugin, "fake 1.0");
  EXPECT_EQ(found[0].origin, Fake("tables_alone"));
}

TEST(Modules, OneThatIsNotReadySaysWhyAndIsAskedAnew) {
  HostOptions options = Nowhere();
  bool licensed = false;
  options.setting = [&](const std::string& id, const std::string& name) {
    return licensed && id == "org.fake.module" && name == "license"
               ? std::optional<std::string>("paid")
               : std::nullopt;
  };
  Host host(options);
  ASSERT_TRUE(host.Load(Fake("not_ready")));
  const Backend& backend = *host.Find("module");
  EXPECT_FALSE(host.Ready(backend).ready);
  EXPECT_EQ(host.Ready(backend).text, "no license: set the setting license");
  licensed = true;
  EXPECT_TRUE(host.Ready(backend).ready);
}

TEST(Modules, WhatThrowsThroughTheTableIsCaughtAndSaid) {
  for (const auto& [fake, said] :
       {std::pair("load_throws", "thrown through the table"),
        std::pair("throws_no_exception_class", "let an exception out")}) {
    Host host(Nowhere());
    ASSERT_TRUE(host.Load(Fake(fake)));
    Session session(host, *host.Find("module"));
    ProblemData box = SmallLp();
    box.A = Csc(0, 2);
    box.row_lower.clear();
    box.row_upper.clear();
    const std::string text = Failed([&] { session.Load(box); }, SY_E_INTERNAL);
    EXPECT_THAT(text, AllOf(StartsWith("org.fake.module: load"), HasSubstr(said)));
  }
}

TEST(Modules, TheFirstOfTwoWithOneIdServesAndTheOtherIsReported) {
  Host host(Nowhere());
  ASSERT_TRUE(host.Load(Fake("well_behaved")));
  EXPECT_FALSE(host.Load(Fake("twin")));
  ASSERT_EQ(host.backends().size(), 1U);
  EXPECT_EQ(host.Ready(*host.Find("module")).version, "1.0");
  EXPECT_EQ(host.problems().back().reason, "org.fake.module is already there, from " +
                                               Fake("well_behaved") + ", which comes first");
}

TEST(Files, WhatIsNoModuleIsSaid) {
  const Folder folder;
  EXPECT_EQ(Verdict(folder.path() + "/none.so"), "not loadable: file absent");
  EXPECT_EQ(Verdict(folder.path() + "/none/none.so"), "not loadable: file absent");
  EXPECT_EQ(Verdict(folder.path()), "not loadable: not a file");
  EXPECT_EQ(Verdict(folder.Write("empty.so", "")), "not loadable: not a module: the file is empty");
  for (const std::string text : {"x", "NAME a\nROWS\n", "#!/bin/sh\n"}) {
    EXPECT_EQ(Verdict(folder.Write("text.so", text)),
              "not loadable: not a module: it does not begin as an ELF file does");
  }
  EXPECT_THAT(Verdict(folder.Write("text/below.so", "x") + "/file.so"),
              StartsWith("not loadable: cannot be read: "));
  EXPECT_THAT(Verdict(""), StartsWith("not loadable: "));
  fs::create_symlink(folder.path() + "/nowhere", folder.path() + "/dangling.so");
  EXPECT_EQ(Verdict(folder.path() + "/dangling.so"), "not loadable: file absent");
}

TEST(Files, APipeDoesNotBlock) {
  const Folder folder;
  const std::string pipe = folder.path() + "/pipe.so";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(Verdict(pipe), "not loadable: not a file");
  EXPECT_EQ(Verdict("/dev/zero"), "not loadable: not a file");
}

TEST(Files, OneThatMayNotBeReadIsSaid) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read every file";
  const Folder folder;
  const std::string path = folder.Copy("well_behaved", "closed.so");
  fs::permissions(path, fs::perms::none);
  EXPECT_EQ(Verdict(path), "not loadable: cannot be read: Permission denied");
}

TEST(Files, AnotherMachineOrKindOfFileIsSaid) {
  const Folder folder;
  const std::string good = Bytes(Fake("well_behaved"));
  const auto with = [&](std::size_t at, char byte) {
    std::string bytes = good;
    bytes[at] = byte;
    return folder.Write("other.so", bytes);
  };
  EXPECT_EQ(Verdict(with(offsetof(Elf64_Ehdr, e_machine), 8)),  // MIPS
            "not loadable: a module for another processor");
  EXPECT_EQ(Verdict(with(EI_CLASS, ELFCLASS32)), "not loadable: a module for another processor");
  EXPECT_EQ(Verdict(with(offsetof(Elf64_Ehdr, e_type), ET_REL)),
            "not loadable: not a module: an ELF file, but not a shared library");
  EXPECT_EQ(Verdict(with(offsetof(Elf64_Ehdr, e_phentsize), 1)),
            "not loadable: not a module: odd program headers");
  EXPECT_EQ(Verdict(with(offsetof(Elf64_Ehdr, e_phoff) + 7, '\x7f')),
            "not loadable: not a module: cut short in its program headers");
  EXPECT_EQ(Verdict(with(offsetof(Elf64_Ehdr, e_phoff) + 7, '\xff')),
            "not loadable: not a module: cut short in its program headers");
}

// The loader maps what the headers promise and dies of a file that is shorter.
/// Where what the loader maps of a module ends; behind it stands what linkers and debuggers read.
std::size_t EndOfSegments(const std::string& module) {
  Elf64_Ehdr header{};
  std::memcpy(&header, module.data(), sizeof header);
  std::size_t end = 0;
  for (std::size_t k = 0; k < header.e_phnum; ++k) {
    Elf64_Phdr segment{};
    std::memcpy(&segment, module.data() + header.e_phoff + k * sizeof segment, sizeof segment);
    if (segment.p_type != PT_LOAD) continue;
    end = std::max<std::size_t>(end, segment.p_offset + segment.p_filesz);
  }
  return end;
}

TEST(Files, AModuleCutShortAnywhereIsNoCrash) {
  const Folder folder;
  const std::string good = Bytes(Fake("well_behaved"));
  const std::size_t needed = EndOfSegments(good);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> inside(0, needed - 1);
  std::uniform_int_distribution<std::size_t> anywhere(0, good.size() - 1);
  // Each once: a file that is written again while it is loaded is a crash of another kind.
  std::set<std::size_t> lengths = {1, 4, EI_NIDENT, sizeof(Elf64_Ehdr) - 1, sizeof(Elf64_Ehdr)};
  while (lengths.size() < 155) lengths.insert(inside(random));
  while (lengths.size() < 205) lengths.insert(anywhere(random));
  for (const std::size_t n : lengths) {
    Host host(Nowhere());
    const std::string path = folder.Write("cut" + std::to_string(n) + ".so", good.substr(0, n));
    const bool loaded = host.Load(path);
    EXPECT_EQ(loaded, n >= needed) << n << " bytes of " << needed;
    if (loaded) continue;
    EXPECT_EQ(host.problems().back().state, BackendState::kNotLoadable);
    EXPECT_THAT(host.problems().back().reason, StartsWith("not a module: ")) << n << " bytes";
  }
}

TEST(Search, AFileNamedComesBeforeTheFoldersInTheirOrder) {
  const Folder folder;
  const std::string named = folder.Copy("well_behaved", "elsewhere/module.so");
  const std::string listed = folder.Copy("twin", "listed/module.so");
  const std::string other = folder.Copy("another", "listed/another.so");
  const std::string users = folder.Copy("twin", "data/switchyard/plugins/module.so");
  folder.Write("listed/notes.txt", "not looked at");
  const Environment path("SWITCHYARD_PLUGIN_PATH",
                         folder.path() + "/absent::" + folder.path() + "/listed");
  const Environment data("XDG_DATA_HOME", folder.path() + "/data");
  HostOptions options;
  options.files = {named};
  const Host host(options);
  ASSERT_EQ(host.backends().size(), 2U);
  EXPECT_EQ(host.backends()[0]->origin, named);
  EXPECT_EQ(host.backends()[1]->origin, other);
  ASSERT_GE(host.folders().size(), 3U);
  EXPECT_EQ(host.folders()[0], folder.path() + "/absent");
  EXPECT_EQ(host.folders()[1], folder.path() + "/listed");
  EXPECT_EQ(host.folders()[2], folder.path() + "/data/switchyard/plugins");
  ASSERT_EQ(host.problems().size(), 2U);
  EXPECT_EQ(host.problems()[0].path, listed);
  EXPECT_EQ(host.problems()[1].path, users);
  EXPECT_THAT(host.problems()[1].reason, HasSubstr("already there, from " + named));
}

TEST(Search, TheUsersFolderIsBelowHomeWhereNothingElseIsSaid) {
  const Folder folder;
  const Environment path("SWITCHYARD_PLUGIN_PATH", "");
  const Environment data("XDG_DATA_HOME", "");
  const Environment home("HOME", folder.path());
  folder.Copy("another", ".local/share/switchyard/plugins/another.so");
  const Host host;
  EXPECT_EQ(host.folders().front(), folder.path() + "/.local/share/switchyard/plugins");
  EXPECT_NE(host.Find("org.fake.another"), nullptr);
}

TEST(Search, AFileThatIsNamedAndFoundIsNotItsOwnRival) {
  const Folder folder;
  const std::string file = folder.Copy("well_behaved", "module.so");
  HostOptions options;
  options.files = {
      file, folder.path() + "/../" + fs::path(folder.path()).filename().string() + "/module.so"};
  options.folders = std::vector<std::string>{folder.path(), folder.path()};
  const Host host(options);
  EXPECT_EQ(host.backends().size(), 1U);
  EXPECT_TRUE(host.problems().empty()) << host.problems().front().reason;
}

TEST(Search, AFolderFullOfRubbishHidesNoPlugin) {
  const Folder folder;
  folder.Write("a.so", "");
  folder.Write("b.so", "text");
  folder.Write("c.so/d.so", "a folder of that name");
  folder.Copy("needs_library", "e.so");
  folder.Copy("well_behaved", "f.so");
  HostOptions options;
  options.folders = std::vector<std::string>{folder.path()};
  const Host host(options);
  EXPECT_EQ(host.backends().size(), 1U);
  EXPECT_EQ(host.problems().size(), 4U);
}

}  // namespace
}  // namespace switchyard::test
