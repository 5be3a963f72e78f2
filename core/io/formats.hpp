// core/io/formats.hpp - the one table of file formats: a new format is a row here and its file.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/text.hpp"
#include "switchyard/io/format.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

struct FormatFacts {
  FileFormat format;
  std::string_view name;
  std::span<const std::string_view> endings;
  bool by_lines;  // FileText::CheckLines holds
  /// Does the first line that is neither blank nor a comment look like it?
  bool (*starts_with)(std::string_view line);
  std::unique_ptr<MathematicalProgram> (*read)(const FileText& text, Notes* notes);
  std::vector<std::string> (*cannot_hold)(const MathematicalProgram& program);
  std::string (*write)(const MathematicalProgram& program, Notes* notes);
};

std::span<const FormatFacts> Formats();

}  // namespace switchyard::io
