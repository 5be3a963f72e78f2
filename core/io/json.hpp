// core/io/json.hpp - a JSON text as a flat list of values, and what is wrong with one, where.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/name_index.hpp"
#include "core/io/text.hpp"

namespace switchyard::io {

enum class JsonKind : std::uint8_t { kNull, kBool, kNumber, kString, kArray, kObject };

/// A container stands before what it holds, the name of a member before its value. Where a node is
/// found from the first one on, a pointer is known only when it is asked for.
struct JsonNode {
  struct Range {
    std::uint32_t size;  // elements, or members
    std::uint32_t next;  // the node behind the last
  };
  struct Place {
    std::uint32_t first;  // in the document's strings
    std::uint32_t length;
  };
  union {
    double number;  // 0 or 1 of a bool
    Range holds;
    Place text;
  };
  JsonKind kind;
};

class JsonValue;

/// Bounded: at most 2^28 bytes, 16 bytes of memory or fewer for each comma, bracket or colon of the
/// text, at most 64 levels; each name once in an object. Not recursive.
class JsonDocument {
 public:
  /// Throws FileError. The text stays where it is while the document is used.
  explicit JsonDocument(const FileText& text);
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;

  [[nodiscard]] JsonValue root() const;
  [[nodiscard]] const FileText& text() const { return text_; }

 private:
  friend class JsonBuilder;
  friend class JsonValue;
  const FileText& text_;
  std::vector<JsonNode> nodes_;
  std::string strings_;
};

/// One value of a document: an index, cheap to copy. What reads a value throws FileError, with the
/// pointer to it, where it is another thing than asked for.
class JsonValue {
 public:
  JsonValue(const JsonDocument* document, std::uint32_t at) : document_(document), at_(at) {}

  [[nodiscard]] JsonKind kind() const { return node().kind; }
  /// A finite number; from infinity to infinity where "inf" and "-inf" may stand too.
  [[nodiscard]] double Number() const;
  [[nodiscard]] double NumberOrInfinity() const;
  /// An integer in [first, limit), which `what` names.
  [[nodiscard]] int Integer(int first, int limit, const char* what) const;
  [[nodiscard]] bool Bool() const;
  [[nodiscard]] std::string_view String() const;

  /// The elements of an array, in order.
  [[nodiscard]] std::vector<JsonValue> Elements() const;
  /// How many an array has.
  [[nodiscard]] int Size() const;
  /// Calls visit(value) for each element of an array.
  template <class Visit>
  void ForEach(Visit visit) const {
    CheckIs(JsonKind::kArray, "a list");
    for (std::uint32_t at = at_ + 1; at < node().holds.next; at = Behind(at)) {
      visit(JsonValue(document_, at));
    }
  }
  /// Calls visit(name, value) for each member of an object.
  template <class Visit>
  void ForEachMember(Visit visit) const {
    CheckIs(JsonKind::kObject, "an object");
    for (std::uint32_t at = at_ + 1; at < node().holds.next; at = Behind(at + 1)) {
      visit(TextAt(at), JsonValue(document_, at + 1));
    }
  }
  [[nodiscard]] std::optional<JsonValue> Member(std::string_view name) const;

  [[noreturn]] void Fail(const std::string& needs) const;
  [[noreturn]] void Fail(const std::string& needs, const std::string& found) const;
  /// The JSON pointer to it.
  [[nodiscard]] std::string Pointer() const;

 private:
  [[nodiscard]] const JsonNode& node() const { return document_->nodes_[at_]; }
  [[nodiscard]] std::uint32_t Behind(std::uint32_t at) const {
    const JsonNode& node = document_->nodes_[at];
    return node.kind < JsonKind::kArray ? at + 1 : node.holds.next;
  }
  [[nodiscard]] std::string_view TextAt(std::uint32_t at) const {
    const JsonNode::Place place = document_->nodes_[at].text;
    return std::string_view(document_->strings_).substr(place.first, place.length);
  }
  void CheckIs(JsonKind kind, const char* needs) const {
    if (node().kind != kind) [[unlikely]]
      Fail(needs);
  }
  [[nodiscard]] std::string Phrase() const;

  const JsonDocument* document_;
  std::uint32_t at_;
};

/// An object whose members have these names and no others.
class JsonFields {
 public:
  JsonFields(JsonValue object, std::initializer_list<std::string_view> known);
  /// Throws FileError where it is absent.
  [[nodiscard]] JsonValue operator[](std::string_view name) const;
  [[nodiscard]] std::optional<JsonValue> Find(std::string_view name) const {
    return object_.Member(name);
  }

 private:
  JsonValue object_;
};

/// An object whose members are entries that other places of the text name.
class JsonTable {
 public:
  /// `what` is what messages call an entry: "a function". Absent: a table without entries.
  JsonTable(std::optional<JsonValue> table, const char* what);

  [[nodiscard]] int size() const { return names_.size(); }
  [[nodiscard]] JsonValue entry(int i) const { return entries_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::string_view name(int i) const {
    return names_.names()[static_cast<std::size_t>(i)];
  }
  /// The number of the entry that a string names. Throws FileError, with the nearest name.
  [[nodiscard]] int Find(JsonValue reference) const;

 private:
  const char* what_;
  NameIndex names_;
  std::vector<JsonValue> entries_;
};

/// "NAME" in quotes, and the nearest of the names that are known where one is near.
std::string QuotedWithNearest(std::string_view name, const std::vector<std::string_view>& known);

}  // namespace switchyard::io
