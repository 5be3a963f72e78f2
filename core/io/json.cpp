#include "core/io/json.hpp"

#include <algorithm>
#include <limits>

#include "core/io/flat.hpp"
#include "switchyard/error.hpp"

namespace switchyard::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A suggestion costs a comparison with every name: none is made for what is longer or more.
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kMostNames = 10000;

// A name within a JSON pointer.
std::string Escaped(std::string_view name) {
  std::string escaped;
  for (const char c : name) {
    if (c == '~' || c == '/') {
      escaped += c == '~' ? "~0" : "~1";
    } else {
      escaped += c;
    }
  }
  return escaped.size() <= kLongestName ? escaped : escaped.substr(0, kLongestName) + "...";
}

}  // namespace

std::string QuotedWithNearest(std::string_view name, const std::vector<std::string_view>& known) {
  std::string near;
  if (name.size() <= kLongestName && known.size() <= kMostNames) {
    std::vector<std::string> names;
    for (const std::string_view one : known) {
      if (one.size() <= kLongestName) names.emplace_back(one);
    }
    near = NearestName(std::string(name), names);
  }
  return Quoted(name) + (near.empty() ? "" : " (the nearest is " + Quoted(near) + ")");
}

JsonValue JsonDocument::root() const { return {this, 0}; }

double JsonValue::Number() const {
  CheckIs(JsonKind::kNumber, "a number");
  return node().number;
}

double JsonValue::NumberOrInfinity() const {
  if (kind() == JsonKind::kString) {
    const std::string_view word = TextAt(at_);
    if (word == "inf") return kInfinity;
    if (word == "-inf") return -kInfinity;
  }
  CheckIs(JsonKind::kNumber, "a number, \"inf\" or \"-inf\"");
  return node().number;
}

int JsonValue::Integer(int first, int limit, const char* what) const {
  if (limit <= first) Fail(Text(what, " (there is none)"));
  const double number = kind() == JsonKind::kNumber ? node().number : kInfinity;
  if (!(number >= first && number < limit)) Fail(Text(what, " from ", first, " to ", limit - 1));
  const int integer = static_cast<int>(number);
  if (integer != number) Fail(Text(what, " from ", first, " to ", limit - 1));
  return integer;
}

bool JsonValue::Bool() const {
  CheckIs(JsonKind::kBool, "true or false");
  return node().number != 0;
}

std::string_view JsonValue::String() const {
  CheckIs(JsonKind::kString, "a text");
  return TextAt(at_);
}

int JsonValue::Size() const {
  CheckIs(JsonKind::kArray, "a list");
  return static_cast<int>(node().holds.size);
}

std::vector<JsonValue> JsonValue::Elements() const {
  std::vector<JsonValue> elements;
  elements.reserve(static_cast<std::size_t>(Size()));
  ForEach([&](JsonValue element) { elements.push_back(element); });
  return elements;
}

std::optional<JsonValue> JsonValue::Member(std::string_view name) const {
  CheckIs(JsonKind::kObject, "an object");
  for (std::uint32_t at = at_ + 1; at < node().holds.next; at = Behind(at + 1)) {
    if (TextAt(at) == name) return JsonValue(document_, at + 1);
  }
  return std::nullopt;
}

// Down from the root: in each container the child whose nodes the value is among.
std::string JsonValue::Pointer() const {
  std::string pointer;
  for (std::uint32_t inside = 0; inside != at_;) {
    const bool names = document_->nodes_[inside].kind == JsonKind::kObject;
    std::uint32_t child = inside + (names ? 2 : 1);
    std::size_t index = 0;
    for (; Behind(child) <= at_; ++index) child = Behind(child) + (names ? 1 : 0);
    pointer += '/';
    pointer += names ? Escaped(TextAt(child - 1)) : std::to_string(index);
    inside = child;
  }
  return pointer;
}

std::string JsonValue::Phrase() const {
  switch (kind()) {
    case JsonKind::kNull:
      return "null";
    case JsonKind::kBool:
      return node().number != 0 ? "true" : "false";
    case JsonKind::kNumber: {
      std::string number;
      AppendNumber(node().number, &number);
      return number;
    }
    case JsonKind::kString:
      return Quoted(TextAt(at_));
    case JsonKind::kArray:
      return Text("a list of ", node().holds.size);
    case JsonKind::kObject:
      break;
  }
  return "an object";
}

void JsonValue::Fail(const std::string& needs) const { Fail(needs, Phrase()); }

void JsonValue::Fail(const std::string& needs, const std::string& found) const {
  throw FileError(document_->text_.file(), Pointer(), needs, found);
}

JsonFields::JsonFields(JsonValue object, std::initializer_list<std::string_view> known)
    : object_(object) {
  object.ForEachMember([&](std::string_view name, JsonValue value) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    std::string names;
    for (const std::string_view one : known) names += Text(names.empty() ? "" : ", ", one);
    value.Fail("a name that is read here (" + names + ")", QuotedWithNearest(name, known));
  });
}

JsonValue JsonFields::operator[](std::string_view name) const {
  const std::optional<JsonValue> found = Find(name);
  if (!found) object_.Fail(Quoted(name), "an object without it");
  return *found;
}

JsonTable::JsonTable(std::optional<JsonValue> table, const char* what) : what_(what) {
  if (!table) return;
  table->ForEachMember([&](std::string_view name, JsonValue value) {
    names_.Add(name);
    entries_.push_back(value);
  });
}

int JsonTable::Find(JsonValue reference) const {
  const std::string_view name = reference.String();
  const int found = names_.Find(name);
  if (found < 0) {
    reference.Fail(Text("the name of ", what_, size() == 0 ? " (there is none)" : ""),
                   QuotedWithNearest(name, names_.names()));
  }
  return found;
}

}  // namespace switchyard::io
