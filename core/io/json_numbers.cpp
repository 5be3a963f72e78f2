#include "core/io/json_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/io/flat.hpp"
#include "core/io/sparse.hpp"

namespace switchyard::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kIntLimit = std::numeric_limits<int>::max();

struct Entry {
  int row;
  int col;
  double value;
  JsonValue at;
};

bool InOrder(const Entry& a, const Entry& b) {
  return a.col < b.col || (a.col == b.col && a.row < b.row);
}

std::vector<Entry> ReadEntries(JsonValue list, int rows, int cols) {
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(list.Size()));
  list.ForEach([&](JsonValue place) {
    if (place.kind() != JsonKind::kArray || place.Size() != 3) {
      place.Fail("a row, a column and a number");
    }
    std::array<double, 2> index{};
    double value = 0;
    int k = 0;
    place.ForEach([&](JsonValue part) {
      if (k == 2) {
        value = part.Number();
      } else {
        index[static_cast<std::size_t>(k)] =
            part.Integer(0, k == 0 ? rows : cols, k == 0 ? "a row" : "a column");
      }
      ++k;
    });
    entries.push_back({static_cast<int>(index[0]), static_cast<int>(index[1]), value, place});
  });
  return entries;
}

}  // namespace

void JsonRoom::Take(std::size_t count, JsonValue value) {
  if (count > left_) {
    value.Fail("dimensions that go with the size of the file", Text(count, " beyond them"));
  }
  left_ -= count;
}

Eigen::VectorXd ReadVector(JsonValue list) {
  Eigen::VectorXd numbers(list.Size());
  Eigen::Index i = 0;
  list.ForEach([&](JsonValue number) { numbers(i++) = number.Number(); });
  return numbers;
}

Eigen::VectorXd ReadInfiniteVector(JsonValue list) {
  Eigen::VectorXd numbers(list.Size());
  Eigen::Index i = 0;
  list.ForEach([&](JsonValue number) { numbers(i++) = number.NumberOrInfinity(); });
  return numbers;
}

void CheckEntries(JsonValue list, Eigen::Index size, const char* why) {
  if (list.Size() != size) list.Fail(Text("a list of ", size, ", one for each ", why));
}

SparseMatrix ReadMatrix(JsonValue matrix, JsonRoom* room) {
  const JsonFields fields(matrix, {"rows", "cols", "entries"});
  const int rows = fields["rows"].Integer(0, kIntLimit, "a number of rows");
  const int cols = fields["cols"].Integer(0, kIntLimit, "a number of columns");
  room->Take(static_cast<std::size_t>(cols), fields["cols"]);
  room->Take(static_cast<std::size_t>(rows), fields["rows"]);  // Eigen reserves by the larger one
  std::vector<Entry> entries = ReadEntries(fields["entries"], rows, cols);
  if (!std::is_sorted(entries.begin(), entries.end(), InOrder)) {
    std::stable_sort(entries.begin(), entries.end(), InOrder);
  }
  for (std::size_t k = 1; k < entries.size(); ++k) {
    if (InOrder(entries[k - 1], entries[k])) continue;
    entries[k].at.Fail("each place once",
                       Text("row ", entries[k].row, " and column ", entries[k].col, " again"));
  }
  std::vector<int> start(static_cast<std::size_t>(cols) + 1, 0);
  std::vector<int> row;
  std::vector<double> value;
  row.reserve(entries.size());
  value.reserve(entries.size());
  for (const Entry& entry : entries) {
    ++start[static_cast<std::size_t>(entry.col) + 1];
    row.push_back(entry.row);
    value.push_back(entry.value);
  }
  for (std::size_t j = 0; j + 1 < start.size(); ++j) start[j + 1] += start[j];
  return CompressedColumns(rows, cols, start, row, value);
}

JsonSides ReadSides(JsonValue lower, JsonValue upper) {
  JsonSides sides{ReadInfiniteVector(lower), ReadInfiniteVector(upper)};
  CheckEntries(upper, sides.lower.size(), "lower side");
  Eigen::Index i = 0;
  lower.ForEach([&](JsonValue side) {
    if (sides.lower(i++) == kInfinity) side.Fail("a lower side below infinity");
  });
  i = 0;
  upper.ForEach([&](JsonValue side) {
    if (sides.upper(i) == -kInfinity) side.Fail("an upper side above -infinity");
    if (!(sides.lower(i) <= sides.upper(i))) {
      side.Fail(Text("an upper side of ", sides.lower(i), ", the lower one, or more"));
    }
    ++i;
  });
  return sides;
}

void AppendJson(double number, std::string* text) {
  if (std::isinf(number)) {
    *text += number > 0 ? "\"inf\"" : "\"-inf\"";
  } else if (number == 0 && std::signbit(number)) {
    *text += "-0.0";  // readers take -0 for an integer, which has one zero
  } else {
    AppendNumber(number, text);
  }
}

void AppendJson(const VectorRef& numbers, std::string* text) {
  *text += '[';
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    if (i > 0) *text += ", ";
    AppendJson(numbers(i), text);
  }
  *text += ']';
}

void AppendJson(const SparseMatrix& matrix, std::string* text) {
  *text += Text("{\"rows\": ", matrix.rows(), ", \"cols\": ", matrix.cols(), ", \"entries\": [");
  bool first = true;
  for (int j = 0; j < matrix.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
      if (!first) *text += ", ";
      first = false;
      *text += '[';
      *text += std::to_string(it.row());
      *text += ", ";
      *text += std::to_string(j);
      *text += ", ";
      AppendJson(it.value(), text);
      *text += ']';
    }
  }
  *text += "]}";
}

void AppendJson(std::string_view text, Notes* notes, std::string* to) {
  constexpr char kDigits[] = "0123456789abcdef";
  *to += '"';
  for (const char c : Utf8(text, notes)) {
    if (c == '"' || c == '\\') {
      *to += '\\';
      *to += c;
    } else if (c >= 0 && c < ' ') {
      *to += "\\u00";
      *to += kDigits[c >> 4];
      *to += kDigits[c & 15];
    } else {
      *to += c;
    }
  }
  *to += '"';
}

}  // namespace switchyard::io
