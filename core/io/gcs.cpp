// gcs/1: graphs of convex sets, read.
#include <limits>
#include <utility>

#include "core/gcs/perspective.hpp"
#include "core/io/bytes.hpp"
#include "core/io/gcs_sets.hpp"
#include "core/io/json.hpp"
#include "core/sets/box.hpp"
#include "core/sets/scaled_constraint.hpp"
#include "switchyard/io/graph.hpp"

namespace switchyard {
namespace io {
namespace {

using Vertex = GraphOfConvexSets::Vertex;

VectorXDecisionVariable Stacked(const VectorXDecisionVariable& tail,
                                const VectorXDecisionVariable& head) {
  VectorXDecisionVariable both(tail.size() + head.size());
  both << tail, head;
  return both;
}

class GraphReader {
 public:
  GraphReader(const FileText& text, Notes* notes)
      : document_(text), source_(text), notes_(*notes) {}
  GraphProblem Read();

 private:
  static void CheckNames(JsonValue root);
  void ReadHead(const JsonFields& fields);
  std::shared_ptr<Cost> ReadConvexCost(JsonValue entry);
  std::shared_ptr<Constraint> ReadConvexRows(JsonValue entry);
  template <class T, class ReadOne>
  void ReadTable(const JsonTable& table, std::vector<T>* entries, ReadOne read);
  void ReadVertices(JsonValue list, const JsonTable& sets);
  void ReadEdges(JsonValue list, bool directed);
  void AddTerms(const JsonFields& fields, const VectorXDecisionVariable& x,
                const std::string& where, GraphOfConvexSets::Edge* edge, Vertex* vertex);
  VectorXDecisionVariable VariablesOf(JsonValue term, const EvaluatorBase& evaluator,
                                      const char* what, const VectorXDecisionVariable& x) const;
  [[nodiscard]] static JsonValue NameIn(JsonValue term, const char* what) {
    if (term.kind() != JsonKind::kObject) return term;
    return JsonFields(term, {what, "variables"})[what];
  }
  [[nodiscard]] Vertex* VertexAt(JsonValue number) const {
    return vertices_[static_cast<std::size_t>(
        number.Integer(0, static_cast<int>(vertices_.size()), "the number of a vertex"))];
  }
  void NoteUnused(const char* what, const JsonTable& table, const std::vector<bool>& used);

  JsonDocument document_;
  EntrySource source_;
  Notes& notes_;
  GraphProblem problem_;
  std::optional<JsonTable> functions_;
  std::optional<JsonTable> constraints_;
  std::vector<std::shared_ptr<Cost>> costs_;
  std::vector<std::shared_ptr<Constraint>> rows_;
  std::vector<std::shared_ptr<const ConvexSet>> sets_;
  std::vector<bool> costs_used_;
  std::vector<bool> rows_used_;
  std::vector<bool> sets_used_;
  std::vector<Vertex*> vertices_;
};

void GraphReader::CheckNames(JsonValue root) {
  const auto format = root.Member("format");
  if (!format) root.Fail("\"format\": \"gcs/1\"", "an object without it");
  if (format->String() != "gcs/1") format->Fail("\"gcs/1\"");
  if (const auto problem = root.Member("problem")) {
    if (problem->String() != "shortest_path") problem->Fail("\"shortest_path\"");
  }
}

GraphProblem GraphReader::Read() {
  const JsonValue root = document_.root();
  CheckNames(root);
  const JsonFields fields(
      root, {"format", "name", "problem", "directed", "notes", "source", "target", "reference",
             "matrices", "functions", "constraints", "sets", "vertices", "edges"});
  ReadHead(fields);
  const JsonTable matrices(fields.Find("matrices"), "a matrix");
  source_.matrices = &matrices;
  functions_.emplace(fields.Find("functions"), "a function");
  constraints_.emplace(fields.Find("constraints"), "a constraint");
  const JsonTable sets(fields["sets"], "a set");
  costs_used_.resize(static_cast<std::size_t>(functions_->size()));
  rows_used_.resize(static_cast<std::size_t>(constraints_->size()));
  sets_used_.resize(static_cast<std::size_t>(sets.size()));
  ReadTable(*functions_, &costs_, [&](JsonValue entry) { return ReadConvexCost(entry); });
  ReadTable(*constraints_, &rows_, [&](JsonValue entry) { return ReadConvexRows(entry); });
  const ConstraintOf constraint_of = [&](JsonValue name) {
    const auto found = static_cast<std::size_t>(constraints_->Find(name));
    rows_used_[found] = true;
    return rows_[found];
  };
  ReadTable(sets, &sets_, [&](JsonValue entry) {
    auto set = ReadSet(entry, &source_, constraint_of);
    if (IsProvenEmpty(set->scaled())) entry.Fail("a set that has a point", "an empty one");
    return set;
  });
  problem_.graph = std::make_unique<GraphOfConvexSets>();
  ReadVertices(fields["vertices"], sets);
  problem_.source = VertexAt(fields["source"]);
  problem_.target = VertexAt(fields["target"]);
  const auto directed = fields.Find("directed");
  ReadEdges(fields["edges"], !directed || directed->Bool());
  NoteUnused("a function", *functions_, costs_used_);
  NoteUnused("a constraint", *constraints_, rows_used_);
  NoteUnused("a set", sets, sets_used_);
  return std::move(problem_);
}

// Its perspective is that of a cone, which other functions have not.
std::shared_ptr<Cost> GraphReader::ReadConvexCost(JsonValue entry) {
  auto cost = ReadFunction(entry, &source_);
  if (HasPerspective(*cost)) return cost;
  if (FunctionOf(*cost) == nullptr) entry.Fail("a convex function", "a quadratic one that is not");
  entry.Fail("a linear, convex quadratic or norm function", "one given by its operations");
}

std::shared_ptr<Constraint> GraphReader::ReadConvexRows(JsonValue entry) {
  auto rows = ReadConstraint(entry, &source_);
  if (dynamic_cast<const QuadraticConstraint*>(rows.get()) != nullptr) {
    const auto n = static_cast<std::size_t>(rows->num_vars());
    source_.dense.Take(n * n, entry);  // what its factor takes
  }
  if (HasPerspective(*rows)) return rows;
  const bool function = FunctionOf(*rows) != nullptr;
  entry.Fail("a linear, conic or convex quadratic constraint",
             function ? "one given by its operations" : "a quadratic one that is not convex");
}

void GraphReader::ReadHead(const JsonFields& fields) {
  if (const auto name = fields.Find("name")) problem_.name = name->String();
  if (const auto notes = fields.Find("notes")) problem_.notes = notes->String();
  const auto reference = fields.Find("reference");
  if (!reference) return;
  reference->ForEachMember([&](std::string_view name, JsonValue value) {
    auto& known = problem_.reference[std::string(name)];
    if (value.kind() == JsonKind::kNumber) {
      known = value.Number();
    } else if (value.kind() == JsonKind::kString) {
      known = std::string(value.String());
    } else {
      value.Fail("a number or a text");
    }
  });
}

template <class T, class ReadOne>
void GraphReader::ReadTable(const JsonTable& table, std::vector<T>* entries, ReadOne read) {
  entries->reserve(static_cast<std::size_t>(table.size()));
  for (int i = 0; i < table.size(); ++i) entries->push_back(read(table.entry(i)));
}

void GraphReader::NoteUnused(const char* what, const JsonTable& table,
                             const std::vector<bool>& used) {
  for (int i = 0; i < table.size(); ++i) {
    if (used[static_cast<std::size_t>(i)]) continue;
    notes_.Count(Text(what, " that nothing uses is left out"), table.name(i));
  }
}

void GraphReader::ReadVertices(JsonValue list, const JsonTable& sets) {
  vertices_.reserve(static_cast<std::size_t>(list.Size()));
  list.ForEach([&](JsonValue entry) {
    const JsonFields fields(entry, {"name", "set", "costs", "constraints"});
    const auto set = static_cast<std::size_t>(sets.Find(fields["set"]));
    const auto name = fields.Find("name");
    sets_used_[set] = true;
    // Many vertices may share a set of a large dimension, and each has variables.
    source_.numbers.Take(static_cast<std::size_t>(sets_[set]->ambient_dimension()), fields["set"]);
    Vertex* const vertex =
        problem_.graph->AddVertex(sets_[set], name ? std::string(name->String()) : "");
    vertices_.push_back(vertex);
    AddTerms(fields, vertex->x(), "the vertex", nullptr, vertex);
  });
}

void GraphReader::ReadEdges(JsonValue list, bool directed) {
  list.ForEach([&](JsonValue entry) {
    const JsonFields fields(entry, {"name", "tail", "head", "costs", "constraints"});
    Vertex* const tail = VertexAt(fields["tail"]);
    Vertex* const head = VertexAt(fields["head"]);
    const auto name = fields.Find("name");
    const VectorXDecisionVariable x = Stacked(tail->x(), head->x());
    for (const bool reversed : {false, true}) {
      if (reversed && directed) break;
      source_.numbers.Take(static_cast<std::size_t>(x.size()), entry);
      GraphOfConvexSets::Edge* const edge =
          problem_.graph->AddEdge(reversed ? head : tail, reversed ? tail : head,
                                  name && !reversed ? std::string(name->String()) : "");
      AddTerms(fields, x, "both ends of the edge", edge, nullptr);
    }
  });
}

// To the edge, or to the vertex where there is no edge.
void GraphReader::AddTerms(const JsonFields& fields, const VectorXDecisionVariable& x,
                           const std::string& where, GraphOfConvexSets::Edge* edge,
                           Vertex* vertex) {
  if (const auto list = fields.Find("costs")) {
    list->ForEach([&](JsonValue term) {
      const auto found = static_cast<std::size_t>(functions_->Find(NameIn(term, "function")));
      costs_used_[found] = true;
      const Binding<Cost> binding(costs_[found],
                                  VariablesOf(term, *costs_[found], where.c_str(), x));
      edge != nullptr ? edge->AddCost(binding) : vertex->AddCost(binding);
    });
  }
  if (const auto list = fields.Find("constraints")) {
    list->ForEach([&](JsonValue term) {
      const auto found = static_cast<std::size_t>(constraints_->Find(NameIn(term, "constraint")));
      rows_used_[found] = true;
      const Binding<Constraint> binding(rows_[found],
                                        VariablesOf(term, *rows_[found], where.c_str(), x));
      edge != nullptr ? edge->AddConstraint(binding) : vertex->AddConstraint(binding);
    });
  }
}

// All of x, or those that the term lists.
VectorXDecisionVariable GraphReader::VariablesOf(JsonValue term, const EvaluatorBase& evaluator,
                                                 const char* what,
                                                 const VectorXDecisionVariable& x) const {
  if (term.kind() != JsonKind::kObject || !term.Member("variables")) {
    if (evaluator.num_vars() != x.size()) {
      term.Fail(Text("a term on ", x.size(), " variables, those of ", what),
                Text("one on ", evaluator.num_vars()));
    }
    return x;
  }
  const JsonValue list = *term.Member("variables");
  CheckEntries(list, evaluator.num_vars(), "variable of the term");
  VectorXDecisionVariable some(list.Size());
  Eigen::Index i = 0;
  list.ForEach([&](JsonValue number) {
    some(i++) = x(number.Integer(0, static_cast<int>(x.size()), "a variable"));
  });
  return some;
}

GraphProblem ReadText(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const FileText text(bytes, name);
  Notes notes(options.notes);
  GraphProblem problem = GraphReader(text, &notes).Read();
  notes.Finish();
  return problem;
}

}  // namespace
}  // namespace io

GraphProblem ReadGraph(const std::string& path, const ReadOptions& options) {
  std::string bytes = io::ReadBytes(path, options.byte_limit);
  if (io::IsGzip(bytes)) bytes = io::Unzipped(bytes, path, options.byte_limit);
  return io::ReadText(bytes, path, options);
}

GraphProblem ReadGraphText(std::string_view text, const std::string& name,
                           const ReadOptions& options) {
  Require(text.size() <= options.byte_limit, name, ": the limit is ", options.byte_limit,
          " bytes, this has ", text.size());
  return io::ReadText(text, name, options);
}

}  // namespace switchyard
