// The entries of program/1's tables: a new kind of cost or constraint is a row here.
#include <algorithm>
#include <array>
#include <cmath>
#include <typeinfo>
#include <utility>

#include "core/io/program_json.hpp"

namespace switchyard::io {
namespace {

constexpr int kLargestMatrix = 46340;  // the largest n with n^2 < 2^31
constexpr int kAnyNumber = -1;
constexpr std::size_t kFreeNumbers = std::size_t{1} << 20;
constexpr std::size_t kNumbersPerByte = 16;
constexpr std::size_t kFreeDense = std::size_t{1} << 20;
constexpr std::size_t kDensePerByte = 1024;
constexpr std::size_t kFreeOperations = std::size_t{1} << 26;
constexpr std::size_t kOperationsPerByte = 256;

std::size_t Squared(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }

void AppendMember(const char* name, const VectorRef& value, EntrySink* sink) {
  *sink->text += Text(", \"", name, "\": ");
  AppendJson(value, sink->text);
}
void AppendMember(const char* name, double value, EntrySink* sink) {
  *sink->text += Text(", \"", name, "\": ");
  AppendJson(value, sink->text);
}

// ---- Costs ----

std::shared_ptr<Cost> ReadLinear(JsonValue entry, EntrySource* /*source*/) {
  const JsonFields fields(entry, {"type", "description", "a", "b"});
  return std::make_shared<LinearCost>(ReadVector(fields["a"]), fields["b"].Number());
}

void WriteLinear(const Cost& cost, EntrySink* sink) {
  const auto& linear = static_cast<const LinearCost&>(cost);
  AppendMember("a", linear.a(), sink);
  AppendMember("b", linear.b(), sink);
}

std::shared_ptr<Cost> ReadQuadratic(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "Q", "b", "c", "convex"});
  const SparseMatrix Q = source->Matrix(fields["Q"]);
  if (Q.rows() != Q.cols()) {
    fields["Q"].Fail("a square matrix", Text("one of ", Q.rows(), " x ", Q.cols()));
  }
  CheckEntries(fields["b"], Q.rows(), "row of Q");
  const auto convex = fields.Find("convex");
  return std::make_shared<QuadraticCost>(Q, ReadVector(fields["b"]), fields["c"].Number(),
                                         convex ? std::optional(convex->Bool()) : std::nullopt);
}

void WriteQuadratic(const Cost& cost, EntrySink* sink) {
  const auto& quadratic = static_cast<const QuadraticCost&>(cost);
  sink->Append("Q", quadratic.Q());
  AppendMember("b", quadratic.b(), sink);
  AppendMember("c", quadratic.c(), sink);
  *sink->text += quadratic.is_convex() ? ", \"convex\": true" : ", \"convex\": false";
}

struct AffineMap {  // z = Ax + b
  SparseMatrix A;
  Eigen::VectorXd b;
};

AffineMap ReadMap(const JsonFields& fields, int least, int most, EntrySource* source) {
  SparseMatrix A = source->Matrix(fields["A"]);
  if (A.rows() < least || (most != kAnyNumber && A.rows() > most)) {
    fields["A"].Fail(Text("a matrix of ", least, most == least ? "" : " or more", " rows"),
                     Text("one of ", A.rows()));
  }
  CheckEntries(fields["b"], A.rows(), "row of A");
  return {std::move(A), ReadVector(fields["b"])};
}

template <class C>
std::shared_ptr<Cost> ReadNorm(JsonValue entry, EntrySource* source) {
  const AffineMap z =
      ReadMap(JsonFields(entry, {"type", "description", "A", "b"}), 1, kAnyNumber, source);
  return std::make_shared<C>(z.A, z.b);
}

void WriteNorm(const Cost& cost, EntrySink* sink) {
  const auto& norm = static_cast<const NormCost&>(cost);
  sink->Append("A", norm.A());
  AppendMember("b", norm.b(), sink);
}

// |Ax + b|^2 = 1/2 x'(2 A'A)x + (2 A'b)'x + b'b. It is written as the quadratic it is held as.
std::shared_ptr<Cost> ReadSquaredNorm(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "A", "b"});
  const AffineMap z = ReadMap(fields, 0, kAnyNumber, source);
  const SparseMatrix transposed = z.A.transpose();
  const SparseMatrix gram = transposed * z.A;
  const Eigen::VectorXd slope = 2 * (transposed * z.b);
  const double constant = z.b.squaredNorm();
  const bool held = std::isfinite(constant) && slope.allFinite() &&
                    Eigen::VectorXd::Map(gram.valuePtr(), gram.nonZeros()).allFinite();
  if (!held) entry.Fail("numbers whose squares a double can hold", "larger ones");
  return std::make_shared<QuadraticCost>(2 * gram, slope, constant, true);
}

bool IsNone(const Cost& /*cost*/) { return false; }

template <class C, class Base>
bool Is(const Base& evaluator) {
  return typeid(evaluator) == typeid(C);
}

template <class C, class Base>
bool IsTape(const Base& evaluator) {
  return Is<C>(evaluator) && TapeOf(*FunctionOf(evaluator)) != nullptr;
}

template <class C>
constexpr EvaluatorFacts<Cost> NormRow(std::string_view type) {
  return {type, Is<C, Cost>, ReadNorm<C>, WriteNorm};
}

constexpr std::array kFunctions = {
    EvaluatorFacts<Cost>{"linear", Is<LinearCost, Cost>, ReadLinear, WriteLinear},
    EvaluatorFacts<Cost>{"quadratic", Is<QuadraticCost, Cost>, ReadQuadratic, WriteQuadratic},
    EvaluatorFacts<Cost>{"squared_l2_norm", IsNone, ReadSquaredNorm, nullptr},
    NormRow<L1NormCost>("l1_norm"),
    NormRow<L2NormCost>("l2_norm"),
    NormRow<LInfNormCost>("linf_norm"),
    NormRow<PerspectiveQuadraticCost>("perspective_quadratic"),
    EvaluatorFacts<Cost>{"function", IsTape<FunctionCost, Cost>, ReadFunctionCost,
                         WriteFunctionCost},
};

// ---- Constraints ----

std::shared_ptr<Constraint> ReadBox(JsonValue entry, EntrySource* /*source*/) {
  const JsonFields fields(entry, {"type", "description", "row_names", "lb", "ub"});
  const JsonSides sides = ReadSides(fields["lb"], fields["ub"]);
  return std::make_shared<BoundingBoxConstraint>(sides.lower, sides.upper);
}

void WriteBox(const Constraint& constraint, EntrySink* sink) {
  AppendMember("lb", constraint.lower_bound(), sink);
  AppendMember("ub", constraint.upper_bound(), sink);
}

std::shared_ptr<Constraint> ReadRows(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "A", "lb", "ub"});
  SparseMatrix A = source->Matrix(fields["A"]);
  CheckEntries(fields["lb"], A.rows(), "row of A");
  const JsonSides sides = ReadSides(fields["lb"], fields["ub"]);
  return std::make_shared<LinearConstraint>(std::move(A), sides.lower, sides.upper);
}

void WriteRows(const Constraint& constraint, EntrySink* sink) {
  sink->Append("A", static_cast<const LinearConstraint&>(constraint).get_sparse_A());
  WriteBox(constraint, sink);
}

std::shared_ptr<Constraint> ReadEquality(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "A", "b"});
  AffineMap z = ReadMap(fields, 0, kAnyNumber, source);
  return std::make_shared<LinearEqualityConstraint>(std::move(z.A), z.b);
}

void WriteEquality(const Constraint& constraint, EntrySink* sink) {
  sink->Append("A", static_cast<const LinearConstraint&>(constraint).get_sparse_A());
  AppendMember("b", constraint.lower_bound(), sink);
}

template <class C, int least, int most>
std::shared_ptr<Constraint> ReadCone(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "A", "b"});
  AffineMap z = ReadMap(fields, least, most, source);
  return std::make_shared<C>(std::move(z.A), z.b);
}

void WriteCone(const Constraint& constraint, EntrySink* sink) {
  const auto& cone = static_cast<const ConeConstraint&>(constraint);
  sink->Append("A", cone.A());
  AppendMember("b", cone.b(), sink);
}

std::shared_ptr<Constraint> ReadPower(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "alpha", "A", "b"});
  AffineMap z = ReadMap(fields, 3, 3, source);
  const double alpha = fields["alpha"].Number();
  if (!(alpha > 0 && alpha < 1)) fields["alpha"].Fail("a number between 0 and 1");
  return std::make_shared<PowerConeConstraint>(std::move(z.A), z.b, alpha);
}

void WritePower(const Constraint& constraint, EntrySink* sink) {
  AppendMember("alpha", static_cast<const ConeConstraint&>(constraint).cone().parameter, sink);
  WriteCone(constraint, sink);
}

// Coefficients of a matrix cone stand there where they are not those of its construction.
std::shared_ptr<Constraint> ReadSemidefinite(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "rows", "A", "b"});
  const int n = fields["rows"].Integer(1, kLargestMatrix + 1, "a number of rows");
  source->numbers.Take(Squared(n), fields["rows"]);
  const auto changed = fields.Find("A");
  if (!changed && fields.Find("b")) static_cast<void>(fields["A"]);
  auto cone = std::make_shared<PositiveSemidefiniteConstraint>(n);
  if (!changed) return cone;
  AffineMap z = ReadMap(fields, n * n, n * n, source);
  if (z.A.cols() != n * n) {
    changed->Fail(Text("a matrix of ", n * n, " columns"), Text("one of ", z.A.cols()));
  }
  cone->UpdateCoefficients(std::move(z.A), z.b);
  return cone;
}

void WriteSemidefinite(const Constraint& constraint, EntrySink* sink) {
  const auto& cone = static_cast<const PositiveSemidefiniteConstraint&>(constraint);
  *sink->text += Text(", \"rows\": ", cone.matrix_rows());
  bool as_made = cone.A().nonZeros() == cone.A().cols();
  for (int j = 0; as_made && j < cone.A().outerSize(); ++j) as_made = cone.A().coeff(j, j) == 1;
  for (const double entry : cone.b()) as_made = as_made && entry == 0 && !std::signbit(entry);
  if (!as_made) WriteCone(constraint, sink);
}

// Made with zeros and then given its coefficients, which keeps their pattern.
std::shared_ptr<Constraint> ReadMatrixInequality(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "rows", "A", "b"});
  const int n = fields["rows"].Integer(1, kLargestMatrix + 1, "a number of rows");
  AffineMap z = ReadMap(fields, n * n, n * n, source);
  const auto matrices = static_cast<std::size_t>(z.A.cols()) + 1;
  source->dense.Take(matrices * Squared(n), fields["A"]);
  auto cone = std::make_shared<LinearMatrixInequalityConstraint>(
      std::vector<Eigen::MatrixXd>(matrices, Eigen::MatrixXd::Zero(n, n)));
  cone->UpdateCoefficients(std::move(z.A), z.b);
  return cone;
}

void WriteMatrixInequality(const Constraint& constraint, EntrySink* sink) {
  const auto& cone = static_cast<const LinearMatrixInequalityConstraint&>(constraint);
  *sink->text += Text(", \"rows\": ", cone.matrix_rows());
  WriteCone(constraint, sink);
}

struct HessianName {
  QuadraticConstraint::HessianType type;
  std::string_view name;
};
constexpr std::array kHessians = {
    HessianName{QuadraticConstraint::HessianType::kPositiveSemidefinite, "positive_semidefinite"},
    HessianName{QuadraticConstraint::HessianType::kNegativeSemidefinite, "negative_semidefinite"},
    HessianName{QuadraticConstraint::HessianType::kIndefinite, "indefinite"},
};

std::optional<QuadraticConstraint::HessianType> ReadHessian(std::optional<JsonValue> name) {
  if (!name) return std::nullopt;
  for (const HessianName& row : kHessians) {
    if (name->String() == row.name) return row.type;
  }
  name->Fail("positive_semidefinite, negative_semidefinite or indefinite");
}

std::shared_ptr<Constraint> ReadForm(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry,
                          {"type", "description", "row_names", "Q", "b", "lb", "ub", "hessian"});
  const SparseMatrix Q = source->Matrix(fields["Q"]);
  if (Q.rows() != Q.cols()) {
    fields["Q"].Fail("a square matrix", Text("one of ", Q.rows(), " x ", Q.cols()));
  }
  CheckEntries(fields["b"], Q.rows(), "row of Q");
  if (fields["lb"].Size() != 1) fields["lb"].Fail("a list of 1, the side of the form");
  const JsonSides sides = ReadSides(fields["lb"], fields["ub"]);
  return std::make_shared<QuadraticConstraint>(Q, ReadVector(fields["b"]), sides.lower(0),
                                               sides.upper(0), ReadHessian(fields.Find("hessian")));
}

void WriteForm(const Constraint& constraint, EntrySink* sink) {
  const auto& form = static_cast<const QuadraticConstraint&>(constraint);
  sink->Append("Q", form.Q());
  AppendMember("b", form.b(), sink);
  WriteBox(constraint, sink);
  for (const HessianName& row : kHessians) {
    if (row.type == form.hessian_type()) *sink->text += Text(", \"hessian\": \"", row.name, "\"");
  }
}

template <class C>
constexpr EvaluatorFacts<Constraint> Row(std::string_view type,
                                         std::shared_ptr<Constraint> (*read)(JsonValue,
                                                                             EntrySource*),
                                         void (*write)(const Constraint&, EntrySink*)) {
  return {type, Is<C, Constraint>, read, write};
}

constexpr std::array kConstraints = {
    Row<BoundingBoxConstraint>("bounding_box", ReadBox, WriteBox),
    Row<LinearConstraint>("linear", ReadRows, WriteRows),
    Row<LinearEqualityConstraint>("linear_equality", ReadEquality, WriteEquality),
    Row<LorentzConeConstraint>("lorentz_cone", ReadCone<LorentzConeConstraint, 1, kAnyNumber>,
                               WriteCone),
    Row<RotatedLorentzConeConstraint>(
        "rotated_lorentz_cone", ReadCone<RotatedLorentzConeConstraint, 2, kAnyNumber>, WriteCone),
    Row<ExponentialConeConstraint>("exponential_cone", ReadCone<ExponentialConeConstraint, 3, 3>,
                                   WriteCone),
    Row<PowerConeConstraint>("power_cone", ReadPower, WritePower),
    Row<PositiveSemidefiniteConstraint>("positive_semidefinite", ReadSemidefinite,
                                        WriteSemidefinite),
    Row<LinearMatrixInequalityConstraint>("linear_matrix_inequality", ReadMatrixInequality,
                                          WriteMatrixInequality),
    Row<QuadraticConstraint>("quadratic", ReadForm, WriteForm),
    EvaluatorFacts<Constraint>{"function", IsTape<FunctionConstraint, Constraint>, ReadFunctionRows,
                               WriteFunctionRows},
};

// ---- Both ----

template <class Table, class Base>
auto FactsFor(const Table& table, const Base& evaluator) {
  return std::find_if(table.begin(), table.end(), [&](const auto& f) { return f.is(evaluator); });
}

template <class Table, class Base>
std::string WhyNone(const Table& table, const Base& evaluator) {
  if (FactsFor(table, evaluator) != table.end()) return "";
  return FunctionOf(evaluator) != nullptr
             ? "is a function of the user's own program; a file holds functions given by "
               "expressions or traced"
             : "is of a class that is not the library's";
}

template <class Table>
auto ReadEntry(const Table& table, const char* what, JsonValue entry, EntrySource* source) {
  const auto type = entry.Member("type");
  if (!type) entry.Fail("\"type\"", "an object without it");
  const std::string_view name = type->String();
  const auto facts =
      std::find_if(table.begin(), table.end(), [&](const auto& f) { return f.type == name; });
  if (facts == table.end()) {
    std::vector<std::string_view> names;
    std::string list;
    for (const auto& f : table) {
      names.push_back(f.type);
      list += Text(list.empty() ? "" : ", ", f.type);
    }
    type->Fail(Text("a type of ", what, " (", list, ")"), QuotedWithNearest(name, names));
  }
  auto evaluator = facts->read(entry, source);
  if (const auto description = entry.Member("description")) {
    evaluator->set_description(std::string(description->String()));
  }
  return evaluator;
}

template <class Table, class Base>
void AppendTyped(const Table& table, const Base& evaluator, EntrySink* sink) {
  const auto facts = FactsFor(table, evaluator);
  Require(facts != table.end(), "program/1 holds no ", evaluator.Kind());
  *sink->text += Text("{\"type\": \"", facts->type, "\"");
  if (!evaluator.get_description().empty()) {
    *sink->text += ", \"description\": ";
    AppendJson(evaluator.get_description(), sink->notes, sink->text);
  }
  facts->write(evaluator, sink);
}

}  // namespace

EntrySource::EntrySource(const FileText& text)
    : numbers(text, kFreeNumbers, kNumbersPerByte),
      dense(text, kFreeDense, kDensePerByte),
      operations(text, kFreeOperations, kOperationsPerByte) {}

SparseMatrix EntrySource::Matrix(JsonValue value) {
  if (matrices == nullptr || value.kind() != JsonKind::kString) {
    return ReadMatrix(value, &numbers);
  }
  const int number = matrices->Find(value);
  read.resize(static_cast<std::size_t>(matrices->size()));
  auto& matrix = read[static_cast<std::size_t>(number)];
  if (!matrix) matrix = ReadMatrix(matrices->entry(number), &numbers);
  numbers.Take(static_cast<std::size_t>(matrix->cols() + matrix->nonZeros()), value);
  return *matrix;
}

void EntrySink::Append(const char* member, const SparseMatrix& matrix) {
  *text += Text(", \"", member, "\": ");
  if (matrices == nullptr) return AppendJson(matrix, text);
  std::string entry;
  AppendJson(matrix, &entry);
  const int next = static_cast<int>(matrices->numbers.size());
  const auto [at, is_new] = matrices->numbers.emplace(std::move(entry), next);
  if (is_new) {
    matrices->entries += Text(next == 0 ? "" : ",", "\n  \"M", next, "\": ", at->first);
  }
  *text += Text("\"M", at->second, "\"");
}

std::shared_ptr<Cost> ReadFunction(JsonValue entry, EntrySource* source) {
  return ReadEntry(kFunctions, "function", entry, source);
}

std::shared_ptr<Constraint> ReadConstraint(JsonValue entry, EntrySource* source) {
  auto constraint = ReadEntry(kConstraints, "constraint", entry, source);
  if (const auto list = entry.Member("row_names")) {
    CheckEntries(*list, constraint->num_constraints(), "row");
    std::vector<std::string> names;
    list->ForEach([&](JsonValue name) { names.emplace_back(name.String()); });
    constraint->set_row_names(std::move(names));
  }
  return constraint;
}

void AppendEntry(const Cost& function, EntrySink* sink) {
  AppendTyped(kFunctions, function, sink);
  *sink->text += '}';
}

void AppendEntry(const Constraint& constraint, EntrySink* sink) {
  AppendTyped(kConstraints, constraint, sink);
  const char* before = ", \"row_names\": [";
  for (const std::string& name : constraint.row_names()) {
    *sink->text += std::exchange(before, ", ");
    AppendJson(name, sink->notes, sink->text);
  }
  *sink->text += constraint.row_names().empty() ? "}" : "]}";
}

std::string WhyNoEntry(const Cost& function) { return WhyNone(kFunctions, function); }

std::string WhyNoEntry(const Constraint& constraint) { return WhyNone(kConstraints, constraint); }

}  // namespace switchyard::io
