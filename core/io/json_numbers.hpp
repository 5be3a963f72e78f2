// core/io/json_numbers.hpp - vectors and sparse matrices in JSON, there and back.
#pragma once

#include <string>
#include <string_view>

#include "core/io/json.hpp"
#include "switchyard/model/evaluator.hpp"

namespace switchyard::io {

/// What a text may ask for beyond its own size: counted, so that a short text of large dimensions
/// is a mistake that is said and not memory that is spent.
class JsonRoom {
 public:
  JsonRoom(const FileText& text, std::size_t free, std::size_t per_byte)
      : left_(free + per_byte * text.bytes().size()) {}
  /// Throws FileError at `value` where `count` more is too much.
  void Take(std::size_t count, JsonValue value);

 private:
  std::size_t left_;
};

/// A list of finite numbers; or of numbers that may be infinite.
Eigen::VectorXd ReadVector(JsonValue list);
Eigen::VectorXd ReadInfiniteVector(JsonValue list);
/// Throws FileError where the list has not `size` entries, as `why` asks for ("a row of A").
void CheckEntries(JsonValue list, Eigen::Index size, const char* why);
/// {"rows": m, "cols": n, "entries": [[i, j, value], ...]}: each place once, in any order; zeros
/// stay where they are written.
SparseMatrix ReadMatrix(JsonValue matrix, JsonRoom* room);

/// Two lists of `size` sides, lower[i] <= upper[i], lower < infinity and upper > -infinity.
struct JsonSides {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};
JsonSides ReadSides(JsonValue lower, JsonValue upper);

/// The shortest text that reads back to the same bits; infinities in quotes.
void AppendJson(double number, std::string* text);
void AppendJson(const VectorRef& numbers, std::string* text);
void AppendJson(const SparseMatrix& matrix, std::string* text);
/// In quotes. Bytes that are no UTF-8 are taken for Latin-1, which a note says.
void AppendJson(std::string_view text, Notes* notes, std::string* to);

}  // namespace switchyard::io
