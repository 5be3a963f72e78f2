// core/io/text.hpp - the text of a file: its lines, fields and numbers, and where an error is.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/io/file_error.hpp"

namespace switchyard::io {

inline bool IsBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// `text` in quotes, cut to a length that a message can carry, unprintable bytes as \xNN.
std::string Quoted(std::string_view text);
std::string_view Trimmed(std::string_view text);
/// The fields between blanks, at most fields.size() of them; returns how many there are, of which
/// those beyond fields.size() count as one more.
std::size_t SplitAtBlanks(std::string_view line, std::span<std::string_view> fields);
/// A finite number, with a "+" or a Fortran exponent where it has one. False: it is none, or none
/// that a double holds.
bool ParseNumber(std::string_view field, double* value);
bool ParseInfinity(std::string_view field, double* value);

/// The bytes of a file under the file's name. Every view that the readers hold is a part of these
/// bytes, so the place of an error is where its view starts, and nobody counts lines before there
/// is one.
class FileText {
 public:
  /// Throws FileError at a NUL byte.
  FileText(std::string_view bytes, std::string file);
  /// Throws FileError at a line of more than 2^16 bytes: for formats whose lines mean something.
  void CheckLines() const;

  [[nodiscard]] std::string_view bytes() const { return bytes_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] int LineOf(std::string_view at) const;

  /// Throws FileError: got what stands in `at`, or the end of the line or file where it is empty.
  [[noreturn]] void Fail(std::string_view at, const std::string& expected) const;
  [[noreturn]] void Fail(std::string_view at, const std::string& expected,
                         const std::string& found) const;

  [[nodiscard]] double Number(std::string_view field) const {
    double value = 0;
    if (!ParseNumber(field, &value)) FailNumber(field);
    return value;
  }
  /// An integer in [first, limit), which `what` names.
  [[nodiscard]] int Integer(std::string_view field, int first, int limit, const char* what) const {
    int value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || value < first ||
        value >= limit) {
      FailInteger(field, first, limit, what);
    }
    return value;
  }

 private:
  [[noreturn]] void FailNumber(std::string_view field) const;
  [[noreturn]] void FailInteger(std::string_view field, int first, int limit,
                                const char* what) const;
  std::string_view bytes_;
  std::string file_;
};

/// Walks over the lines of a text; "\r" and blanks at a line's end are no part of it.
class Lines {
 public:
  explicit Lines(const FileText& text) : rest_(text.bytes()), line_(rest_.substr(0, 0)) {}
  bool Next();
  [[nodiscard]] std::string_view line() const { return line_; }
  /// What has not been walked over.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string_view line_;
};

/// Sentences about what was read, of which each kind is said once with a count.
class Notes {
 public:
  explicit Notes(std::vector<std::string>* sink) : sink_(sink) {}
  /// "WHAT (3 times, first: EXAMPLE)"; kinds are told apart by `what`.
  void Count(const std::string& what, std::string_view example);
  void Say(const std::string& what);
  /// Hands the sentences over; what was counted so far is said.
  void Finish();

 private:
  struct Kind {
    std::string what;
    std::string example;
    int count;
  };
  std::vector<std::string>* sink_;
  std::vector<Kind> kinds_;
};

/// The name as UTF-8: bytes that are none are read as Latin-1, which every byte is.
std::string Utf8(std::string_view name, Notes* notes);

}  // namespace switchyard::io
