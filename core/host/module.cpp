#include "core/host/module.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr int kFirstUnknownMajor = SY_ABI_MAJOR + 1;
constexpr int kLastProbedMajor = SY_ABI_MAJOR + 8;

constexpr Elf64_Half kMachine =
#if defined(__x86_64__)
    EM_X86_64;
#elif defined(__aarch64__)
    EM_AARCH64;
#else
    EM_NONE;
#endif

/// Empty, or why the file at `path` cannot be a loadable module.
std::string FileFault(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    return errno == ENOENT ? "file absent" : Text("cannot be read: ", std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) return "not a file";
  if (status.st_size == 0) return "not a module: the file is empty";
  std::ifstream in(path, std::ios::binary);
  if (!in) return Text("cannot be read: ", std::strerror(errno));
  Elf64_Ehdr header{};
  in.read(reinterpret_cast<char*>(&header), sizeof header);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    return "not a module: it does not begin as an ELF file does";
  }
  if (!in) return "not a module: cut short in its ELF header";
  if (header.e_ident[EI_CLASS] != ELFCLASS64 ||
      (kMachine != EM_NONE && header.e_machine != kMachine)) {
    return "a module for another processor";
  }
  if (header.e_type != ET_DYN) return "not a module: an ELF file, but not a shared library";
  if (header.e_phentsize != sizeof(Elf64_Phdr)) return "not a module: odd program headers";
  const auto size = static_cast<std::uint64_t>(status.st_size);
  std::vector<Elf64_Phdr> segments(header.e_phnum);
  in.seekg(static_cast<std::streamoff>(header.e_phoff));
  in.read(reinterpret_cast<char*>(segments.data()),
          static_cast<std::streamsize>(segments.size() * sizeof(Elf64_Phdr)));
  if (!in) return "not a module: cut short in its program headers";
  for (const Elf64_Phdr& segment : segments) {
    if (segment.p_type == PT_LOAD &&
        (segment.p_filesz > size || segment.p_offset > size - segment.p_filesz)) {
      return "not a module: the file is cut short";
    }
  }
  return "";
}

/// The loader's words, with what they mean in front.
std::string LoaderReason(const std::string& path) {
  const char* said = dlerror();
  const std::string text = said != nullptr ? said : "no reason given";
  const std::size_t colon = text.find(": cannot open shared object file");
  if (colon != std::string::npos) {
    const std::string library = text.substr(0, colon);
    if (library != path) return "dependency absent: " + library + " is not on this machine";
  }
  if (text.find("undefined symbol") != std::string::npos) return "symbol absent: " + text;
  return "the loader refuses it: " + text;
}

Module NotCompatible(const std::string& reason) {
  return {nullptr, BackendState::kNotCompatible, reason};
}

template <class Record>
bool Reaches(const Record& record, std::size_t end) {
  return record.size >= end;
}

}  // namespace

std::string TableFault(const sy_solver& solver) {
  if (!Reaches(solver, offsetof(sy_solver, solve) + sizeof solver.solve)) {
    return Text("a solver's table is short: ", solver.size, " bytes, at least ",
                offsetof(sy_solver, solve) + sizeof solver.solve, " needed");
  }
  if (solver.id == nullptr || *solver.id == '\0') return "a solver has no id";
  const std::string who = solver.id;
  if (solver.name == nullptr) return who + " has no name";
  if (solver.create == nullptr || solver.destroy == nullptr || solver.set_option == nullptr ||
      solver.load == nullptr || solver.solve == nullptr) {
    return who + " lacks one of create, destroy, set_option, load, solve";
  }
  for (const sy_option* const* o = solver.options; o != nullptr && *o != nullptr; ++o) {
    if (!Reaches(**o, offsetof(sy_option, choices)) || (*o)->name == nullptr) {
      return who + " has an option without a name";
    }
  }
  return "";
}

std::string TableFault(const sy_plugin& plugin) {
  if (!Reaches(plugin, offsetof(sy_plugin, solvers) + sizeof plugin.solvers)) {
    return Text("the plugin's table is short: ", plugin.size, " bytes, at least ",
                offsetof(sy_plugin, solvers) + sizeof plugin.solvers, " needed");
  }
  if (plugin.abi_major != SY_ABI_MAJOR) {
    return Text("made for version ", plugin.abi_major, " of the plugin ABI, this host speaks ",
                SY_ABI_MAJOR);
  }
  if (plugin.name == nullptr || plugin.version == nullptr) return "no name or no version";
  const bool extended = Reaches(plugin, sizeof(sy_plugin)) && plugin.extension != nullptr;
  if ((plugin.solvers == nullptr || *plugin.solvers == nullptr) && !extended) {
    return "it offers no solver, and no table of another kind";
  }
  return "";
}

Module OpenModule(const std::string& path) {
  const std::string fault = FileFault(path);
  if (!fault.empty()) return {nullptr, BackendState::kNotLoadable, fault};
  // A name without a slash would be searched for in the loader's own places.
  const std::string place = path.find('/') == std::string::npos ? "./" + path : path;
  void* library = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return {nullptr, BackendState::kNotLoadable, LoaderReason(place)};
  }
  void* symbol = dlsym(library, SY_PLUGIN_ENTRY);
  if (symbol == nullptr) {
    for (int major = kFirstUnknownMajor; major <= kLastProbedMajor; ++major) {
      if (dlsym(library, Text("switchyard_plugin_v", major).c_str()) != nullptr) {
        return NotCompatible(Text("made for version ", major,
                                  " of the plugin ABI, this host speaks ", SY_ABI_MAJOR));
      }
    }
    return NotCompatible("not a plugin: it has no symbol " SY_PLUGIN_ENTRY);
  }
  const sy_plugin* plugin = nullptr;
  try {
    const sy_plugin* (*entry)() = reinterpret_cast<sy_plugin_entry>(symbol);
    plugin = entry();
  } catch (...) {
    return NotCompatible("its entry " SY_PLUGIN_ENTRY " threw an exception");
  }
  if (plugin == nullptr) return NotCompatible("its entry " SY_PLUGIN_ENTRY " returned nothing");
  const std::string wrong = TableFault(*plugin);
  if (!wrong.empty()) return NotCompatible(wrong);
  return {plugin, BackendState::kReady, ""};
}

}  // namespace switchyard
