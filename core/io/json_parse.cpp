// From the text to the list of values; the lexer and the grammar are nlohmann-json's.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/io/json.hpp"
#include "switchyard/error.hpp"

namespace switchyard::io {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 28;
constexpr std::size_t kMostLevels = 64;
constexpr std::size_t kFewNames = 16;  // so many are compared each with each
constexpr int kNumberTooLarge = 406;   // nlohmann-json's id of that error

bool IsJsonBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::size_t Trues(std::string_view text, std::string_view among) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [&](char c) { return among.find(c) != std::string_view::npos; }));
}

// Where the token ends that starts at `start`; a string without its closing quote ends before the
// first byte that no string has.
std::size_t EndOfToken(std::string_view bytes, std::size_t start) {
  constexpr std::string_view kSingle = ",:[]{}";
  std::size_t end = start + 1;
  if (bytes[start] == '"') {
    while (end < bytes.size() && bytes[end] != '"' && (bytes[end] < 0 || bytes[end] >= ' ')) {
      end += bytes[end] == '\\' ? 2 : 1;
    }
    const bool closed = end < bytes.size() && bytes[end] == '"';
    return std::min(end, bytes.size()) + (closed ? 1 : 0);
  }
  if (kSingle.find(bytes[start]) != std::string_view::npos) return end;
  while (end < bytes.size() && !IsJsonBlank(bytes[end]) && bytes[end] != '"' &&
         kSingle.find(bytes[end]) == std::string_view::npos) {
    ++end;
  }
  return end;
}

// Is the token one that the lexer left at its end, not behind it?
bool IsWhole(std::string_view token) {
  const char last = token.back();
  if (token[0] == '"') return token.size() > 1 && last == '"';
  return (last >= '0' && last <= '9') || std::string_view(",:[]{}").find(last) != token.npos ||
         token == "true" || token == "false" || token == "null";
}

// The token that the lexer was at after `position` bytes, all before it being right: it has read
// one byte beyond a token that broke off. Empty at the end of the text.
std::string_view TokenAt(std::string_view bytes, std::size_t position) {
  std::size_t start = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    while (start < bytes.size() && IsJsonBlank(bytes[start])) ++start;
    if (start == bytes.size()) return bytes.substr(start);
    const std::size_t end = EndOfToken(bytes, start);
    const std::string_view token = bytes.substr(start, end - start);
    if (end >= position || !IsWhole(token)) return token;
    start = end;
  }
}

}  // namespace

// Takes what the parser finds, in order. It ends the parse by throwing; the names of its members
// are the library's.
class JsonBuilder {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  explicit JsonBuilder(JsonDocument* document)
      : document_(document),
        text_(document->text_),
        nodes_(document->nodes_),
        strings_(document->strings_) {
    // Each value but the first stands behind a comma, a colon or a bracket, each name behind a
    // comma or a brace.
    nodes_.reserve(1 + Trues(text_.bytes(), ",:[{"));
  }

  bool null() { return Scalar(JsonKind::kNull, 0); }
  bool boolean(bool value) { return Scalar(JsonKind::kBool, value ? 1 : 0); }
  bool number_integer(number_integer_t value) {
    return Scalar(JsonKind::kNumber, static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) {
    return Scalar(JsonKind::kNumber, static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t& /*as written*/) {
    return Scalar(JsonKind::kNumber, value);
  }
  bool string(const string_t& value) {
    Count();
    AddText(value);
    return true;
  }
  bool binary(const binary_t& /*value*/) { return false; }  // no JSON text has one
  bool start_object(std::size_t /*unknown*/) { return Open(JsonKind::kObject); }
  bool start_array(std::size_t /*unknown*/) { return Open(JsonKind::kArray); }
  bool key(const string_t& name) {
    Count();
    AddText(name);
    named_ = true;
    return true;
  }
  bool end_object() {
    CheckNames();
    return Close();
  }
  bool end_array() { return Close(); }
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::json::exception& error);

 private:
  bool Scalar(JsonKind kind, double number) {
    Count();
    JsonNode node{};
    node.number = number;
    node.kind = kind;
    nodes_.push_back(node);
    return true;
  }
  void AddText(std::string_view text) {
    JsonNode node{};
    node.text = {static_cast<std::uint32_t>(strings_.size()),
                 static_cast<std::uint32_t>(text.size())};
    node.kind = JsonKind::kString;
    strings_ += text;
    nodes_.push_back(node);
  }
  // The names of members are counted, not their values.
  void Count() {
    if (!open_.empty() && !std::exchange(named_, false)) ++nodes_[open_.back()].holds.size;
  }
  bool Open(JsonKind kind) {
    Count();
    if (open_.size() == kMostLevels) FailAt(open_.back(), "at most 64 levels of nesting", "more");
    open_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    JsonNode node{};
    node.holds = {0, 0};
    node.kind = kind;
    nodes_.push_back(node);
    return true;
  }
  bool Close() {
    nodes_[open_.back()].holds.next = static_cast<std::uint32_t>(nodes_.size());
    open_.pop_back();
    return true;
  }
  void CheckNames();
  [[nodiscard]] std::string Expected(char before, bool number_too_large, char first) const;
  // The place is known by its pointer once all that is open has an end.
  [[noreturn]] void FailAt(std::uint32_t node, const std::string& needs, const std::string& found);

  JsonDocument* document_;
  const FileText& text_;
  std::vector<JsonNode>& nodes_;
  std::string& strings_;
  std::vector<std::uint32_t> open_;  // the containers that are
  bool named_ = false;               // was a name the last thing that came?
};

void JsonBuilder::FailAt(std::uint32_t node, const std::string& needs, const std::string& found) {
  while (!open_.empty()) Close();
  JsonValue(document_, node).Fail(needs, found);
}

void JsonBuilder::CheckNames() {
  const std::uint32_t object = open_.back();
  if (nodes_[object].holds.size < 2) return;
  const auto text_of = [&](std::uint32_t at) {
    return std::string_view(strings_).substr(nodes_[at].text.first, nodes_[at].text.length);
  };
  const bool few = nodes_[object].holds.size <= kFewNames;
  NameIndex many;
  std::array<std::string_view, kFewNames> before;
  std::size_t count = 0;
  for (std::uint32_t at = object + 1; at < nodes_.size();) {
    const std::string_view name = text_of(at);
    const auto end = before.begin() + static_cast<std::ptrdiff_t>(count);
    if (few ? std::find(before.begin(), end, name) != end : many.Add(name) < 0) {
      FailAt(object, "each name once", Quoted(name) + " twice");
    }
    if (few) before[count++] = name;
    const JsonNode& value = nodes_[++at];
    at = value.kind < JsonKind::kArray ? at + 1 : value.holds.next;
  }
}

// What may come here is told by what is open and by the last byte before.
std::string JsonBuilder::Expected(char before, bool number_too_large, char first) const {
  if (number_too_large) return "a number that a double can hold";
  const bool may_be_value = before == '[' || before == ',' || before == ':' || before == '\0';
  if (first == '"' && (may_be_value || before == '{')) {
    return "a string that ends on its line, in UTF-8, with the escapes of JSON";
  }
  if (open_.empty()) return nodes_.empty() ? "a value" : "the end of the file";
  if (nodes_[open_.back()].kind == JsonKind::kArray) {
    return before == '[' ? "a value or \"]\"" : before == ',' ? "a value" : "\",\" or \"]\"";
  }
  if (named_) return before == ':' ? "a value" : "\":\" behind a name";
  return before == '{'   ? "a name in quotes or \"}\""
         : before == ',' ? "a name in quotes"
                         : "\",\" or \"}\"";
}

bool JsonBuilder::parse_error(std::size_t position, const std::string& /*token*/,
                              const nlohmann::json::exception& error) {
  const std::string_view bytes = text_.bytes();
  const std::string_view at = TokenAt(bytes, position);
  const auto start = static_cast<std::size_t>(at.data() - bytes.data());
  std::size_t behind = start;
  while (behind > 0 && IsJsonBlank(bytes[behind - 1])) --behind;
  text_.Fail(at, Expected(behind > 0 ? bytes[behind - 1] : '\0', error.id == kNumberTooLarge,
                          at.empty() ? '\0' : at[0]));
}

JsonDocument::JsonDocument(const FileText& text) : text_(text) {
  Require(text.bytes().size() <= kMostBytes, text.file(), ": JSON of at most ", kMostBytes,
          " bytes is read, this has ", text.bytes().size());
  JsonBuilder builder(this);
  nlohmann::json::sax_parse(text.bytes().begin(), text.bytes().end(), &builder);
}

}  // namespace switchyard::io
