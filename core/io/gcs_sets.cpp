#include "core/io/gcs_sets.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <typeinfo>
#include <utility>

#include "switchyard/sets/constraint_set.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard::io {
namespace {

using SetPointer = std::shared_ptr<const ConvexSet>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One class of sets: a new one is a row of kSets.
struct SetFacts {
  std::string_view type;
  bool (*is)(const ConvexSet& set);
  SetPointer (*read)(JsonValue entry, EntrySource* source, const ConstraintOf& constraint_of);
  void (*write)(const ConvexSet& set, const NameOf& name_of, EntrySink* sink);
};

template <class S>
bool Is(const ConvexSet& set) {
  return typeid(set) == typeid(S);
}

void AppendVector(const char* member, const VectorRef& numbers, EntrySink* sink) {
  *sink->text += Text(", \"", member, "\": ");
  AppendJson(numbers, sink->text);
}

SetPointer ReadPoint(JsonValue entry, EntrySource* /*source*/, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "x"});
  return std::make_shared<Point>(ReadVector(fields["x"]));
}

void WritePoint(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  AppendVector("x", static_cast<const Point&>(set).x(), sink);
}

SetPointer ReadBox(JsonValue entry, EntrySource* /*source*/, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "lb", "ub"});
  const JsonSides sides = ReadSides(fields["lb"], fields["ub"]);
  return std::make_shared<Hyperrectangle>(sides.lower, sides.upper);
}

void WriteBox(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  AppendVector("lb", static_cast<const Hyperrectangle&>(set).lb(), sink);
  AppendVector("ub", static_cast<const Hyperrectangle&>(set).ub(), sink);
}

SetPointer ReadPolyhedron(JsonValue entry, EntrySource* source, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "A", "b"});
  SparseMatrix A = source->Matrix(fields["A"]);
  CheckEntries(fields["b"], A.rows(), "row of A");
  fields["b"].ForEach([](JsonValue side) {
    if (side.NumberOrInfinity() == -kInfinity) side.Fail("an upper side above -infinity");
  });
  return std::make_shared<HPolyhedron>(std::move(A), ReadInfiniteVector(fields["b"]));
}

void WritePolyhedron(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  sink->Append("A", static_cast<const HPolyhedron&>(set).sparse_A());
  AppendVector("b", static_cast<const HPolyhedron&>(set).b(), sink);
}

SetPointer ReadEllipsoid(JsonValue entry, EntrySource* /*source*/, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "center", "A"});
  const Eigen::VectorXd center = ReadVector(fields["center"]);
  const auto rows = static_cast<Eigen::Index>(fields["A"].Size());
  fields["A"].ForEach(
      [&](JsonValue row) { CheckEntries(row, center.size(), "coordinate of the center"); });
  Eigen::MatrixXd A(rows, center.size());
  Eigen::Index i = 0;
  fields["A"].ForEach([&](JsonValue row) { A.row(i++) = ReadVector(row); });
  return std::make_shared<Hyperellipsoid>(A, center);
}

void WriteEllipsoid(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  const auto& ellipsoid = static_cast<const Hyperellipsoid&>(set);
  AppendVector("center", ellipsoid.center(), sink);
  *sink->text += ", \"A\": [";
  for (Eigen::Index i = 0; i < ellipsoid.A().rows(); ++i) {
    if (i > 0) *sink->text += ", ";
    AppendJson(Eigen::VectorXd(ellipsoid.A().row(i)), sink->text);
  }
  *sink->text += ']';
}

SetPointer ReadConstraints(JsonValue entry, EntrySource* source, const ConstraintOf& of) {
  const JsonFields fields(entry, {"type", "dimension", "constraints"});
  const int dimension =
      fields["dimension"].Integer(0, std::numeric_limits<int>::max(), "a dimension");
  ConstraintSet::Constraints constraints;
  fields["constraints"].ForEach([&](JsonValue name) {
    constraints.push_back(of(name));
    const int takes = constraints.back()->num_vars();
    if (takes != dimension) {
      name.Fail(Text("a constraint on ", dimension, " variables, the dimension of the set"),
                Text(Quoted(name.String()), " on ", takes));
    }
  });
  if (constraints.empty()) {  // then nothing but this number says how large it is
    source->numbers.Take(static_cast<std::size_t>(dimension), fields["dimension"]);
  }
  return std::make_shared<ConstraintSet>(dimension, std::move(constraints));
}

void WriteConstraints(const ConvexSet& set, const NameOf& name_of, EntrySink* sink) {
  *sink->text += Text(", \"dimension\": ", set.ambient_dimension(), ", \"constraints\": [");
  const char* before = "\"";
  for (const auto& constraint : static_cast<const ConstraintSet&>(set).constraints()) {
    *sink->text += std::exchange(before, ", \"");
    *sink->text += name_of(constraint);
    *sink->text += '"';
  }
  *sink->text += ']';
}

SetPointer ReadIntersection(JsonValue entry, EntrySource* source, const ConstraintOf& of) {
  const JsonFields fields(entry, {"type", "sets"});
  ConvexSets sets;
  fields["sets"].ForEach([&](JsonValue element) {  // nested no deeper than the document is
    sets.emplace_back(ReadSet(element, source, of));
    const int dimension = sets.back()->ambient_dimension();
    if (dimension != sets.front()->ambient_dimension()) {
      element.Fail(Text("a set in R^", sets.front()->ambient_dimension(), " as the first is"),
                   Text("one in R^", dimension));
    }
  });
  if (sets.empty()) fields["sets"].Fail("one set or more");
  return std::make_shared<Intersection>(std::move(sets));
}

void WriteIntersection(const ConvexSet& set, const NameOf& name_of, EntrySink* sink) {
  const auto& intersection = static_cast<const Intersection&>(set);
  *sink->text += ", \"sets\": [";
  for (int i = 0; i < intersection.num_elements(); ++i) {
    if (i > 0) *sink->text += ", ";
    AppendSet(intersection.element(i), name_of, sink);
  }
  *sink->text += ']';
}

constexpr std::array kSets = {
    SetFacts{"point", Is<Point>, ReadPoint, WritePoint},
    SetFacts{"hyperrectangle", Is<Hyperrectangle>, ReadBox, WriteBox},
    SetFacts{"hpolyhedron", Is<HPolyhedron>, ReadPolyhedron, WritePolyhedron},
    SetFacts{"hyperellipsoid", Is<Hyperellipsoid>, ReadEllipsoid, WriteEllipsoid},
    SetFacts{"intersection_of_constraints", Is<ConstraintSet>, ReadConstraints, WriteConstraints},
    SetFacts{"intersection", Is<Intersection>, ReadIntersection, WriteIntersection},
};

}  // namespace

SetPointer ReadSet(JsonValue entry, EntrySource* source, const ConstraintOf& constraint_of) {
  const auto type = entry.Member("type");
  if (!type) entry.Fail("\"type\"", "an object without it");
  const auto facts = std::find_if(kSets.begin(), kSets.end(),
                                  [&](const SetFacts& f) { return f.type == type->String(); });
  if (facts != kSets.end()) return facts->read(entry, source, constraint_of);
  std::vector<std::string_view> names;
  std::string list;
  for (const SetFacts& f : kSets) {
    names.push_back(f.type);
    list += Text(list.empty() ? "" : ", ", f.type);
  }
  type->Fail("a type of set (" + list + ")", QuotedWithNearest(type->String(), names));
}

void AppendSet(const ConvexSet& set, const NameOf& name_of, EntrySink* sink) {
  const auto facts =
      std::find_if(kSets.begin(), kSets.end(), [&](const SetFacts& f) { return f.is(set); });
  Require(facts != kSets.end(), "gcs/1 holds no ", set.Kind());
  *sink->text += Text("{\"type\": \"", facts->type, "\"");
  facts->write(set, name_of, sink);
  *sink->text += '}';
}

bool HasEntry(const ConvexSet& set) {
  if (const auto* intersection = dynamic_cast<const Intersection*>(&set)) {
    for (int i = 0; i < intersection->num_elements(); ++i) {
      if (!HasEntry(intersection->element(i))) return false;
    }
  }
  return std::any_of(kSets.begin(), kSets.end(), [&](const SetFacts& f) { return f.is(set); });
}

}  // namespace switchyard::io
