#include "core/io/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace switchyard {

FileError::FileError(const std::string& file, int line, int column, const std::string& expected,
                     const std::string& found)
    : InvalidArgument(Text(file, ":", line, ":", column, ": expected ", expected, ", got ", found)),
      file_(file),
      line_(line),
      column_(column),
      expected_(expected),
      found_(found) {}

FileError::FileError(const std::string& file, const std::string& pointer,
                     const std::string& expected, const std::string& found)
    : InvalidArgument(Text(file, ": ", pointer, pointer.empty() ? "" : ": ", "needs ", expected,
                           ", got ", found)),
      file_(file),
      pointer_(pointer),
      expected_(expected),
      found_(found) {}

FileError::~FileError() = default;

}  // namespace switchyard

namespace switchyard::io {
namespace {

constexpr std::size_t kLineLimit = std::size_t{1} << 16;
constexpr std::size_t kQuoteLimit = 60;

int ToInt(std::ptrdiff_t count) {
  return static_cast<int>(std::min<std::ptrdiff_t>(count, std::numeric_limits<int>::max()));
}

std::string HexByte(char c) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

bool EqualsIgnoringCase(std::string_view a, std::string_view lower_case) {
  return std::equal(a.begin(), a.end(), lower_case.begin(), lower_case.end(), [](char x, char y) {
    return (x >= 'A' && x <= 'Z' ? static_cast<char>(x - 'A' + 'a') : x) == y;
  });
}

// The length of the UTF-8 sequence that starts at text[i]; 0 where there is none.
std::size_t SequenceLength(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0) != 0x80) return 0;
  }
  // Overlong forms, surrogates, and what is beyond Unicode.
  const unsigned char second = byte(i + 1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

bool IsUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = SequenceLength(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

}  // namespace

std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  std::size_t i = 0;
  while (i < text.size() && i < kQuoteLimit) {
    const std::size_t length = SequenceLength(text, i);
    if (length == 0 || (length == 1 && (text[i] < ' ' || text[i] == 0x7F))) {
      quoted += HexByte(text[i++]);
    } else {
      quoted += text.substr(i, length);
      i += length;
    }
  }
  return quoted + (i < text.size() ? "...\"" : "\"");
}

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  return text;
}

std::size_t SplitAtBlanks(std::string_view line, std::span<std::string_view> fields) {
  std::size_t count = 0;
  const char* at = line.data();
  const char* const end = at + line.size();
  for (;; ++count) {
    while (at != end && IsBlank(*at)) ++at;
    if (at == end) return count;
    if (count == fields.size()) return count + 1;
    const char* const start = at;
    while (at != end && !IsBlank(*at)) ++at;
    fields[count] = {start, static_cast<std::size_t>(at - start)};
  }
}

bool ParseNumber(std::string_view field, double* value) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, *value);
  if (error != std::errc()) return false;
  if (stop == end) return std::isfinite(*value);
  if (*stop != 'd' && *stop != 'D') return false;
  // from_chars knows one letter for exponents, Fortran writes another.
  std::array<char, 64> copy;
  if (field.size() > copy.size()) return false;
  std::replace_copy_if(
      field.begin(), field.end(), copy.begin(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  const char* const copy_end = copy.data() + field.size();
  const auto again = std::from_chars(copy.data(), copy_end, *value);
  return again.ec == std::errc() && again.ptr == copy_end && std::isfinite(*value);
}

bool ParseInfinity(std::string_view field, double* value) {
  const bool negative = !field.empty() && field[0] == '-';
  if (!field.empty() && (field[0] == '-' || field[0] == '+')) field.remove_prefix(1);
  if (!EqualsIgnoringCase(field, "inf") && !EqualsIgnoringCase(field, "infinity")) return false;
  *value =
      negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  return true;
}

FileText::FileText(std::string_view bytes, std::string file)
    : bytes_(bytes), file_(std::move(file)) {
  const std::size_t nul = bytes_.find('\0');
  if (nul != std::string_view::npos) Fail(bytes_.substr(nul, 1), "text");
}

void FileText::CheckLines() const {
  for (std::size_t start = 0; start < bytes_.size();) {
    const std::size_t end = std::min(bytes_.find('\n', start), bytes_.size());
    if (end - start > kLineLimit) {
      Fail(bytes_.substr(start, end - start), Text("a line of at most ", kLineLimit, " bytes"),
           Text("one of ", end - start));
    }
    start = end + 1;
  }
}

int FileText::LineOf(std::string_view at) const {
  return 1 + ToInt(std::count(bytes_.data(), at.data(), '\n'));
}

void FileText::Fail(std::string_view at, const std::string& expected) const {
  if (!at.empty()) Fail(at, expected, Quoted(at));
  const bool ended = at.data() == bytes_.data() + bytes_.size();
  Fail(at, expected, ended ? "the end of the file" : "the end of the line");
}

void FileText::Fail(std::string_view at, const std::string& expected,
                    const std::string& found) const {
  const std::string_view before =
      bytes_.substr(0, static_cast<std::size_t>(at.data() - bytes_.data()));
  const std::size_t newline = before.rfind('\n');
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  throw FileError(file_, LineOf(at), ToInt(static_cast<std::ptrdiff_t>(before.size() - start)) + 1,
                  expected, found);
}

void FileText::FailNumber(std::string_view field) const {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool number = error == std::errc::result_out_of_range;
  Fail(field, number ? "a number that a double can hold" : "a number");
}

void FileText::FailInteger(std::string_view field, int first, int limit, const char* what) const {
  if (limit <= first) Fail(field, Text(what, " (there is none)"));
  Fail(field, Text(what, " from ", first, " to ", limit - 1));
}

bool Lines::Next() {
  if (rest_.empty()) {
    line_ = rest_;
    return false;
  }
  const auto* newline = static_cast<const char*>(std::memchr(rest_.data(), '\n', rest_.size()));
  const std::size_t length =
      newline == nullptr ? rest_.size() : static_cast<std::size_t>(newline - rest_.data());
  line_ = rest_.substr(0, length);
  rest_.remove_prefix(newline == nullptr ? length : length + 1);
  while (!line_.empty() && IsBlank(line_.back())) line_.remove_suffix(1);
  return true;
}

void Notes::Count(const std::string& what, std::string_view example) {
  if (sink_ == nullptr) return;
  for (Kind& kind : kinds_) {
    if (kind.what == what) {
      ++kind.count;
      return;
    }
  }
  kinds_.push_back({what, std::string(example), 1});
}

void Notes::Say(const std::string& what) {
  if (sink_ != nullptr) kinds_.push_back({what, "", 1});
}

void Notes::Finish() {
  for (const Kind& kind : kinds_) {
    if (kind.example.empty()) {
      sink_->push_back(kind.what);
    } else if (kind.count == 1) {
      sink_->push_back(Text(kind.what, " (", Quoted(kind.example), ")"));
    } else {
      sink_->push_back(
          Text(kind.what, " (", kind.count, " times, first: ", Quoted(kind.example), ")"));
    }
  }
  kinds_.clear();
}

std::string Utf8(std::string_view name, Notes* notes) {
  if (std::all_of(name.begin(), name.end(), [](char c) { return c > 0; }) || IsUtf8(name)) {
    return std::string(name);
  }
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xC0 | (byte >> 6));
      text += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  notes->Count("a name that is not UTF-8 is read as Latin-1", text);
  return text;
}

}  // namespace switchyard::io
