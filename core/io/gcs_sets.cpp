#include "core/io/gcs_sets.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <typeinfo>
#include <utility>

#include "switchyard/error.hpp"
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/constraint_set.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/sets/vpolytope.hpp"

namespace switchyard::io {
namespace {

using SetPointer = std::shared_ptr<const ConvexSet>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Elements = std::vector<const ConvexSet*>;

// One class of sets: a new one is a row of kSets.
struct SetFacts {
  std::string_view type;
  bool (*is)(const ConvexSet& set);
  Elements (*elements)(const ConvexSet& set);  // the sets that it is made of
  SetPointer (*read)(JsonValue entry, EntrySource* source, const ConstraintOf& constraint_of);
  void (*write)(const ConvexSet& set, const NameOf& name_of, EntrySink* sink);
};

template <class S>
bool Is(const ConvexSet& set) {
  return typeid(set) == typeid(S);
}

Elements None(const ConvexSet& /*set*/) { return {}; }

void AppendVector(const char* member, const VectorRef& numbers, EntrySink* sink) {
  *sink->text += Text(", \"", member, "\": ");
  AppendJson(numbers, sink->text);
}

// A list of rows of `cols` entries, as `why` asks for.
Eigen::MatrixXd ReadRows(JsonValue list, Eigen::Index cols, const char* why) {
  list.ForEach([&](JsonValue row) { CheckEntries(row, cols, why); });
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(list.Size()), cols);
  Eigen::Index i = 0;
  list.ForEach([&](JsonValue row) { matrix.row(i++) = ReadVector(row); });
  return matrix;
}

// The same with as many entries as the first row has.
Eigen::MatrixXd ReadEqualRows(JsonValue list) {
  std::optional<Eigen::Index> cols;
  list.ForEach([&](JsonValue row) { cols = cols.value_or(row.Size()); });
  return ReadRows(list, cols.value_or(0), "entry of the first row");
}

void AppendRows(const char* member, const Eigen::MatrixXd& matrix, EntrySink* sink) {
  *sink->text += Text(", \"", member, "\": [");
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (i > 0) *sink->text += ", ";
    AppendJson(Eigen::VectorXd(matrix.row(i)), sink->text);
  }
  *sink->text += ']';
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
  const Eigen::MatrixXd A = ReadRows(fields["A"], center.size(), "coordinate of the center");
  return std::make_shared<Hyperellipsoid>(A, center);
}

void WriteEllipsoid(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  const auto& ellipsoid = static_cast<const Hyperellipsoid&>(set);
  AppendVector("center", ellipsoid.center(), sink);
  AppendRows("A", ellipsoid.A(), sink);
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

SetPointer ReadPolytope(JsonValue entry, EntrySource* /*source*/, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "vertices"});
  return std::make_shared<VPolytope>(ReadEqualRows(fields["vertices"]).transpose());
}

void WritePolytope(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  AppendRows("vertices", static_cast<const VPolytope&>(set).vertices().transpose(), sink);
}

// One row of the matrix for each entry of the vector.
Eigen::MatrixXd ReadRowsFor(JsonValue list, const Eigen::VectorXd& vector, const char* why) {
  CheckEntries(list, vector.size(), why);
  return ReadEqualRows(list);
}

SetPointer ReadBall(JsonValue entry, EntrySource* /*source*/, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "center", "B"});
  const Eigen::VectorXd center = ReadVector(fields["center"]);
  const Eigen::MatrixXd B = ReadRowsFor(fields["B"], center, "row for a coordinate of the center");
  return std::make_shared<AffineBall>(B, center);
}

void WriteBall(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  AppendVector("center", static_cast<const AffineBall&>(set).center(), sink);
  AppendRows("B", static_cast<const AffineBall&>(set).B(), sink);
}

SetPointer ReadSubspace(JsonValue entry, EntrySource* source, const ConstraintOf& /*of*/) {
  const JsonFields fields(entry, {"type", "translation", "basis"});
  const Eigen::VectorXd translation = ReadVector(fields["translation"]);
  const auto n = static_cast<std::size_t>(translation.size());
  source->dense.Take(n * n, entry);  // what is orthogonal to it
  const Eigen::MatrixXd basis =
      ReadRowsFor(fields["basis"], translation, "row for a coordinate of the translation");
  try {
    return std::make_shared<AffineSubspace>(basis, translation);
  } catch (const InvalidArgument&) {
    fields["basis"].Fail("linearly independent columns", "a matrix of lower rank");
  }
}

void WriteSubspace(const ConvexSet& set, const NameOf& /*name_of*/, EntrySink* sink) {
  AppendVector("translation", static_cast<const AffineSubspace&>(set).translation(), sink);
  AppendRows("basis", static_cast<const AffineSubspace&>(set).basis(), sink);
}

// ---- Sets made of sets, which stand in place: nested no deeper than the document is ----

ConvexSets ReadElements(JsonValue list, EntrySource* source, const ConstraintOf& of) {
  ConvexSets sets;
  list.ForEach([&](JsonValue element) { sets.emplace_back(ReadSet(element, source, of)); });
  return sets;
}

// All of one dimension, one or more.
ConvexSets ReadAlike(JsonValue list, EntrySource* source, const ConstraintOf& of) {
  ConvexSets sets = ReadElements(list, source, of);
  std::size_t i = 0;
  list.ForEach([&](JsonValue element) {
    const int dimension = sets[i++]->ambient_dimension();
    if (dimension != sets.front()->ambient_dimension()) {
      element.Fail(Text("a set in R^", sets.front()->ambient_dimension(), " as the first is"),
                   Text("one in R^", dimension));
    }
  });
  if (sets.empty()) list.Fail("one set or more");
  return sets;
}

void WriteElements(const Elements& elements, const NameOf& name_of, EntrySink* sink) {
  *sink->text += ", \"sets\": [";
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i > 0) *sink->text += ", ";
    AppendSet(*elements[i], name_of, sink);
  }
  *sink->text += ']';
}

// Of a class with a number of elements, each by its index.
template <class S, auto kCount, auto kElement>
Elements ElementsOf(const ConvexSet& set) {
  const auto& whole = static_cast<const S&>(set);
  Elements elements;
  for (int i = 0; i < (whole.*kCount)(); ++i) elements.push_back(&(whole.*kElement)(i));
  return elements;
}
constexpr auto kMeeting =
    ElementsOf<Intersection, &Intersection::num_elements, &Intersection::element>;
constexpr auto kFactors =
    ElementsOf<CartesianProduct, &CartesianProduct::num_factors, &CartesianProduct::factor>;
constexpr auto kTerms = ElementsOf<MinkowskiSum, &MinkowskiSum::num_terms, &MinkowskiSum::term>;
constexpr auto kMembers = ElementsOf<ConvexHull, &ConvexHull::num_elements, &ConvexHull::element>;

template <class S>
SetPointer ReadMadeOf(JsonValue entry, EntrySource* source, const ConstraintOf& of) {
  const JsonFields fields(entry, {"type", "sets"});
  return std::make_shared<S>(ReadAlike(fields["sets"], source, of));
}

// Which members have points is not asked while reading.
SetPointer ReadHull(JsonValue entry, EntrySource* source, const ConstraintOf& of) {
  const JsonFields fields(entry, {"type", "sets"});
  return std::make_shared<ConvexHull>(ReadAlike(fields["sets"], source, of), false);
}

template <auto kElements>
void WriteMadeOf(const ConvexSet& set, const NameOf& name_of, EntrySink* sink) {
  WriteElements(kElements(set), name_of, sink);
}

SetPointer ReadProduct(JsonValue entry, EntrySource* source, const ConstraintOf& of) {
  const JsonFields fields(entry, {"type", "sets", "A", "b"});
  ConvexSets sets = ReadElements(fields["sets"], source, of);
  const auto A = fields.Find("A");
  const auto b = fields.Find("b");
  if (A.has_value() != b.has_value()) entry.Fail("both \"A\" and \"b\", or neither", "one");
  if (!A) return std::make_shared<CartesianProduct>(std::move(sets));
  Eigen::Index dimensions = 0;
  for (const ConvexSetPointer& set : sets) dimensions += set->ambient_dimension();
  CheckEntries(*b, dimensions, "dimension of the factors");
  const Eigen::VectorXd shift = ReadVector(*b);
  return std::make_shared<CartesianProduct>(
      std::move(sets), ReadRowsFor(*A, shift, "dimension of the factors"), shift);
}

void WriteProduct(const ConvexSet& set, const NameOf& name_of, EntrySink* sink) {
  const auto& product = static_cast<const CartesianProduct&>(set);
  WriteElements(kFactors(set), name_of, sink);
  if (!product.A()) return;
  AppendRows("A", *product.A(), sink);
  AppendVector("b", *product.b(), sink);
}

constexpr std::array kSets = {
    SetFacts{"point", Is<Point>, None, ReadPoint, WritePoint},
    SetFacts{"hyperrectangle", Is<Hyperrectangle>, None, ReadBox, WriteBox},
    SetFacts{"hpolyhedron", Is<HPolyhedron>, None, ReadPolyhedron, WritePolyhedron},
    SetFacts{"hyperellipsoid", Is<Hyperellipsoid>, None, ReadEllipsoid, WriteEllipsoid},
    SetFacts{"intersection_of_constraints", Is<ConstraintSet>, None, ReadConstraints,
             WriteConstraints},
    SetFacts{"intersection", Is<Intersection>, kMeeting, ReadMadeOf<Intersection>,
             WriteMadeOf<kMeeting>},
    SetFacts{"vpolytope", Is<VPolytope>, None, ReadPolytope, WritePolytope},
    SetFacts{"affine_ball", Is<AffineBall>, None, ReadBall, WriteBall},
    SetFacts{"affine_subspace", Is<AffineSubspace>, None, ReadSubspace, WriteSubspace},
    SetFacts{"cartesian_product", Is<CartesianProduct>, kFactors, ReadProduct, WriteProduct},
    SetFacts{"minkowski_sum", Is<MinkowskiSum>, kTerms, ReadMadeOf<MinkowskiSum>,
             WriteMadeOf<kTerms>},
    SetFacts{"convex_hull", Is<ConvexHull>, kMembers, ReadHull, WriteMadeOf<kMembers>},
};

const SetFacts* FactsOf(const ConvexSet& set) {
  const auto facts =
      std::find_if(kSets.begin(), kSets.end(), [&](const SetFacts& f) { return f.is(set); });
  return facts != kSets.end() ? &*facts : nullptr;
}

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
  const SetFacts* const facts = FactsOf(set);
  Require(facts != nullptr, "gcs/1 holds no ", set.Kind());
  *sink->text += Text("{\"type\": \"", facts->type, "\"");
  facts->write(set, name_of, sink);
  *sink->text += '}';
}

std::string WhyNoEntry(const ConvexSet& set) {
  const SetFacts* const facts = FactsOf(set);
  if (facts == nullptr) return Text("a ", set.Kind(), ", a class of sets that files do not hold");
  std::string why;
  for (const ConvexSet* element : facts->elements(set)) {
    if (why.empty()) why = WhyNoEntry(*element);
  }
  return why;
}

}  // namespace switchyard::io
