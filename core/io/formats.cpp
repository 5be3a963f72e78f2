#include "core/io/formats.hpp"

#include <algorithm>
#include <array>

#include "core/io/bytes.hpp"
#include "core/io/cbf.hpp"
#include "core/io/mps_data.hpp"
#include "core/io/mps_writer.hpp"
#include "core/io/program_json.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"

namespace switchyard {
namespace io {
namespace {

constexpr std::array<std::string_view, 2> kMpsEndings = {".mps", ".qps"};
constexpr std::array<std::string_view, 1> kCbfEndings = {".cbf"};
constexpr std::array<std::string_view, 1> kJsonEndings = {".json"};

bool StartsLikeMps(std::string_view line) {
  return std::any_of(line.begin(), line.end(), IsBlank)
             ? line.starts_with("NAME") || line.starts_with("OBJSENSE")
             : line == "NAME" || line == "ROWS" || line == "OBJSENSE" || line == "OBJNAME";
}

bool StartsLikeCbf(std::string_view line) { return line == "VER"; }

bool StartsLikeJson(std::string_view line) { return line.starts_with("{"); }

constexpr std::array<FormatFacts, 3> kFormats = {{
    {FileFormat::kMps, "mps", kMpsEndings, true, StartsLikeMps, ReadMps, MpsCannotHold, WriteMps},
    {FileFormat::kCbf, "cbf", kCbfEndings, true, StartsLikeCbf, ReadCbf, CbfCannotHold, WriteCbf},
    {FileFormat::kJson, "json", kJsonEndings, false, StartsLikeJson, ReadProgramJson,
     ProgramJsonCannotHold, WriteProgramJson},
}};

const FormatFacts& FactsOf(FileFormat format) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const FormatFacts& f) { return f.format == format; });
  Require(found != kFormats.end(), "a file format is needed, got FileFormat ",
          static_cast<int>(format));
  return *found;
}

bool EndsIn(std::string_view path, std::string_view ending) {
  return path.size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(),
                    path.end() - static_cast<std::ptrdiff_t>(ending.size()), [](char a, char b) {
                      return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
                    });
}

const FormatFacts* ByEnding(std::string_view path) {
  if (EndsIn(path, ".gz")) path.remove_suffix(3);
  for (const FormatFacts& facts : kFormats) {
    for (const std::string_view ending : facts.endings) {
      if (EndsIn(path, ending)) return &facts;
    }
  }
  return nullptr;
}

const FormatFacts* ByFirstLine(const FileText& text) {
  for (Lines lines(text); lines.Next();) {
    const std::string_view line = lines.line();
    if (line.empty() || line[0] == '*' || line[0] == '#') continue;
    const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                    [&](const FormatFacts& f) { return f.starts_with(line); });
    return found == kFormats.end() ? nullptr : &*found;
  }
  return nullptr;
}

std::string KnownEndings() {
  std::string endings;
  for (const FormatFacts& facts : kFormats) {
    for (const std::string_view ending : facts.endings) {
      endings += Text(endings.empty() ? "" : ", ", ending);
    }
  }
  return endings;
}

const FormatFacts& Recognized(const FileText& text, FileFormat format) {
  if (format != FileFormat::kByEnding) return FactsOf(format);
  const FormatFacts* facts = ByEnding(text.file());
  if (facts == nullptr) facts = ByFirstLine(text);
  Require(facts != nullptr, text.file(), ": a format to read is named, or told by an ending (",
          KnownEndings(), "; each with .gz too) or by the first line; here none tells");
  return *facts;
}

std::unique_ptr<MathematicalProgram> ReadText(std::string_view bytes, const std::string& name,
                                              const ReadOptions& options) {
  const FileText text(bytes, name);
  Notes notes(options.notes);
  const FormatFacts& facts = Recognized(text, options.format);
  if (facts.by_lines) text.CheckLines();
  auto program = facts.read(text, &notes);
  notes.Finish();
  return program;
}

}  // namespace

std::span<const FormatFacts> Formats() { return kFormats; }

}  // namespace io

FileFormat FileFormatByName(const std::string& name) {
  std::string names;
  for (const io::FormatFacts& facts : io::kFormats) {
    if (facts.name == name) return facts.format;
    names += Text(names.empty() ? "" : ", ", facts.name);
  }
  Refuse("a file format needs to be one of ", names, ", got ", io::Quoted(name));
}

std::vector<std::string> FileFormatNames() {
  std::vector<std::string> names;
  for (const io::FormatFacts& facts : io::kFormats) names.emplace_back(facts.name);
  return names;
}

std::unique_ptr<MathematicalProgram> ReadProgram(const std::string& path,
                                                 const ReadOptions& options) {
  std::string bytes = io::ReadBytes(path, options.byte_limit);
  if (io::IsGzip(bytes)) bytes = io::Unzipped(bytes, path, options.byte_limit);
  return io::ReadText(bytes, path, options);
}

std::unique_ptr<MathematicalProgram> ReadProgramText(std::string_view text, const std::string& name,
                                                     const ReadOptions& options) {
  Require(text.size() <= options.byte_limit, name, ": the limit is ", options.byte_limit,
          " bytes, this has ", text.size());
  return io::ReadText(text, name, options);
}

std::vector<std::string> CannotHold(const MathematicalProgram& program, FileFormat format) {
  return io::FactsOf(format).cannot_hold(program);
}

std::string ProgramText(const MathematicalProgram& program, FileFormat format,
                        std::vector<std::string>* notes) {
  const io::FormatFacts& facts = io::FactsOf(format);
  std::string reasons;
  for (const std::string& reason : facts.cannot_hold(program)) reasons += "; " + reason;
  Require(reasons.empty(), facts.name, " cannot hold this program", reasons);
  io::Notes noted(notes);
  std::string text = facts.write(program, &noted);
  noted.Finish();
  return text;
}

void WriteProgram(const MathematicalProgram& program, const std::string& path,
                  const WriteOptions& options) {
  FileFormat format = options.format;
  if (format == FileFormat::kByEnding) {
    const io::FormatFacts* facts = io::ByEnding(path);
    Require(facts != nullptr, path, ": a format to write is named, or told by an ending (",
            io::KnownEndings(), "; each with .gz too); here none tells");
    format = facts->format;
  }
  const std::string text = ProgramText(program, format, options.notes);
  io::WriteBytes(path, io::EndsIn(path, ".gz") ? io::Zipped(text) : text);
}

}  // namespace switchyard
