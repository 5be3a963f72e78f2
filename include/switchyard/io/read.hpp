// switchyard/io/read.hpp - programs from files.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/io/file_error.hpp"
#include "switchyard/io/format.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard {

struct ReadOptions {
  FileFormat format = FileFormat::kByEnding;
  std::size_t byte_limit = std::size_t{1} << 30;  // of the text, after decompression
  /// Where not null: gets a sentence for each convention that decided what was read, and for all
  /// that the file says and a program does not keep.
  std::vector<std::string>* notes = nullptr;
};

/// The program in a file; "-" is standard input; gzip is recognized by its first bytes. Variables
/// and linear rows stand in the file's order, under the file's names.
/// Throws FileError where the file is not of its format, InvalidArgument where it cannot be read.
SWITCHYARD_EXPORT std::unique_ptr<MathematicalProgram> ReadProgram(const std::string& path,
                                                                   const ReadOptions& options = {});

/// The same of a text in memory; `name` is what errors call it, and its ending counts.
SWITCHYARD_EXPORT std::unique_ptr<MathematicalProgram> ReadProgramText(
    std::string_view text, const std::string& name, const ReadOptions& options = {});

}  // namespace switchyard
