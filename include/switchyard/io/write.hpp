// switchyard/io/write.hpp - programs to files.
#pragma once

#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/io/format.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard {

struct WriteOptions {
  FileFormat format = FileFormat::kByEnding;
  /// Where not null: gets a sentence for each thing that is said in other words than the
  /// program's: names that were replaced, bounds that became rows.
  std::vector<std::string>* notes = nullptr;
};

/// What `format` cannot hold of the program, a sentence each; none: a file of it means the same.
SWITCHYARD_EXPORT std::vector<std::string> CannotHold(const MathematicalProgram& program,
                                                      FileFormat format);

/// Writes the program; "-" is standard output; an ending ".gz" compresses. Numbers are the shortest
/// that read back to the same. Throws InvalidArgument with the sentences of CannotHold, before
/// anything is written, and where the file cannot be written.
SWITCHYARD_EXPORT void WriteProgram(const MathematicalProgram& program, const std::string& path,
                                    const WriteOptions& options = {});

/// The text that WriteProgram writes.
SWITCHYARD_EXPORT std::string ProgramText(const MathematicalProgram& program, FileFormat format,
                                          std::vector<std::string>* notes = nullptr);

}  // namespace switchyard
