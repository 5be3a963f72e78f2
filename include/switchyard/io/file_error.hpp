// switchyard/io/file_error.hpp - what is wrong with a file, and where.
#pragma once

#include <string>

#include "switchyard/error.hpp"
#include "switchyard/export.hpp"

namespace switchyard {

/// A file that is not what its format asks for. The text is
///   file:line:column: expected EXPECTED, got FOUND
/// or, of JSON whose syntax is right and whose meaning is not, with the JSON pointer of the value,
///   file: POINTER: needs EXPECTED, got FOUND
class SWITCHYARD_EXPORT FileError : public InvalidArgument {
 public:
  /// Lines and columns (bytes) count from 1. `found` is a phrase: what stood there, in quotes, or
  /// "the end of the line".
  FileError(const std::string& file, int line, int column, const std::string& expected,
            const std::string& found);
  /// `pointer` as RFC 6901 writes it, "/edges/17/costs/0"; "" is the whole text.
  FileError(const std::string& file, const std::string& pointer, const std::string& expected,
            const std::string& found);
  ~FileError() override;

  [[nodiscard]] const std::string& file() const { return file_; }
  /// 0 where a pointer says the place.
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] int column() const { return column_; }
  [[nodiscard]] const std::string& pointer() const { return pointer_; }
  [[nodiscard]] const std::string& expected() const { return expected_; }
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  std::string file_;
  int line_ = 0;
  int column_ = 0;
  std::string pointer_;
  std::string expected_;
  std::string found_;
};

}  // namespace switchyard
