// gcs/1: graphs of convex sets, written.
#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>
#include <variant>

#include "core/gcs/perspective.hpp"
#include "core/io/bytes.hpp"
#include "core/io/gcs_sets.hpp"
#include "core/sets/scaled_constraint.hpp"
#include "switchyard/io/graph.hpp"

namespace switchyard {
namespace io {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

class GraphWriter {
 public:
  GraphWriter(const GraphProblem& problem, Notes* notes) : problem_(problem), notes_(notes) {}

  std::string Write() {
    Vertices();
    Edges();
    std::string out = Head();
    AppendTable("matrices", matrices_.entries, "{}", &out);
    AppendTable("functions", functions_.entries, "{}", &out);
    AppendTable("constraints", constraints_.entries, "{}", &out);
    AppendTable("sets", sets_.entries, "{}", &out);
    AppendTable("vertices", vertices_, "[]", &out);
    AppendTable("edges", edges_, "[]", &out);
    return out + "\n}\n";
  }

 private:
  struct Table {  // each thing once
    std::unordered_map<const void*, int> numbers;
    std::string entries;
  };
  template <class T, class AppendOne>
  static std::string NameIn(Table* table, const char* prefix, const T& thing, AppendOne append) {
    const int next = static_cast<int>(table->numbers.size());
    const auto [at, is_new] = table->numbers.emplace(&thing, next);
    std::string name = prefix;
    name += std::to_string(at->second);
    if (is_new) {
      std::string entry;
      append(&entry);
      table->entries += Text(next == 0 ? "" : ",", "\n  \"", name, "\": ", entry);
    }
    return name;
  }
  std::string NameOf(const Cost& cost) {
    return NameIn(&functions_, "f", cost, [&](std::string* entry) {
      EntrySink sink{entry, notes_, &matrices_};
      AppendEntry(cost, &sink);
    });
  }
  std::string NameOf(const Constraint& constraint) {
    return NameIn(&constraints_, "c", constraint, [&](std::string* entry) {
      EntrySink sink{entry, notes_, &matrices_};
      AppendEntry(constraint, &sink);
    });
  }
  std::string NameOf(const ConvexSet& set) {
    return NameIn(&sets_, "s", set, [&](std::string* entry) {
      EntrySink sink{entry, notes_, &matrices_};
      AppendSet(
          set, [this](const auto& constraint) { return NameOf(*constraint); }, &sink);
    });
  }
  void Vertices();
  void Edges();
  template <class B>
  void Terms(const char* list, const char* what, const std::vector<B>& terms,
             const VectorXDecisionVariable& x, std::string* text);
  [[nodiscard]] std::string Head() const;
  static void AppendTable(const char* name, const std::string& entries, const char* brackets,
                          std::string* out) {
    *out +=
        Text(",\n\"", name, "\": ", brackets[0], entries, entries.empty() ? "" : "\n", brackets[1]);
  }

  const GraphProblem& problem_;
  Notes* notes_;
  MatrixNames matrices_;
  Table functions_;
  Table constraints_;
  Table sets_;
  std::unordered_map<const Vertex*, int> numbers_;
  std::string vertices_;
  std::string edges_;
};

std::string GraphWriter::Head() const {
  std::string out = "{\n\"format\": \"gcs/1\",\n\"name\": ";
  AppendJson(problem_.name, notes_, &out);
  out += ",\n\"problem\": \"shortest_path\",\n\"directed\": true,\n\"notes\": ";
  AppendJson(problem_.notes, notes_, &out);
  out += Text(",\n\"source\": ", numbers_.at(problem_.source),
              ",\n\"target\": ", numbers_.at(problem_.target), ",\n\"reference\": {");
  const char* before = "";
  for (const auto& [name, value] : problem_.reference) {
    out += std::exchange(before, ", ");
    AppendJson(name, notes_, &out);
    out += ": ";
    if (const auto* number = std::get_if<double>(&value)) {
      AppendJson(*number, &out);
    } else {
      AppendJson(std::get<std::string>(value), notes_, &out);
    }
  }
  return out + "}";
}

void GraphWriter::Vertices() {
  const GraphOfConvexSets& graph = *problem_.graph;
  for (const Vertex* vertex : graph.Vertices()) {
    const int number = static_cast<int>(numbers_.size());
    numbers_.emplace(vertex, number);
    vertices_ += number == 0 ? "\n  {\"name\": " : ",\n  {\"name\": ";
    AppendJson(vertex->name(), notes_, &vertices_);
    vertices_ += Text(", \"set\": \"", NameOf(vertex->set()), "\"");
    Terms("costs", "function", vertex->costs(), vertex->x(), &vertices_);
    if (!vertex->constraints().empty()) {
      Terms("constraints", "constraint", vertex->constraints(), vertex->x(), &vertices_);
    }
    vertices_ += '}';
  }
}

void GraphWriter::Edges() {
  const GraphOfConvexSets& graph = *problem_.graph;
  const char* before = "\n  {";
  for (const Edge* edge : graph.Edges()) {
    edges_ += std::exchange(before, ",\n  {");
    const std::string name = edge->name();
    if (name != Text("(", edge->u().name(), ", ", edge->v().name(), ")")) {
      edges_ += "\"name\": ";
      AppendJson(name, notes_, &edges_);
      edges_ += ", ";
    }
    edges_ += "\"tail\": ";
    edges_ += std::to_string(numbers_.at(&edge->u()));
    edges_ += ", \"head\": ";
    edges_ += std::to_string(numbers_.at(&edge->v()));
    VectorXDecisionVariable x(edge->xu().size() + edge->xv().size());
    x << edge->xu(), edge->xv();
    Terms("costs", "function", edge->costs(), x, &edges_);
    Terms("constraints", "constraint", edge->constraints(), x, &edges_);
    edges_ += '}';
  }
}

// A term on all of x is its name; one on others says which.
template <class B>
void GraphWriter::Terms(const char* list, const char* what, const std::vector<B>& terms,
                        const VectorXDecisionVariable& x, std::string* text) {
  ((*text += ", \"") += list) += "\": [";
  const char* before = "";
  for (const auto& term : terms) {
    *text += std::exchange(before, ", ");
    const std::string name = NameOf(*term.binding.evaluator());
    const VectorXDecisionVariable& some = term.binding.variables();
    if (some.size() == x.size() && (some.array() == x.array()).all()) {
      ((*text += '"') += name) += '"';
      continue;
    }
    *text += Text("{\"", what, "\": \"", name, "\", \"variables\": [");
    const char* separator = "";
    for (const Variable variable : some) {
      const auto place = std::find(x.begin(), x.end(), variable) - x.begin();
      *text += std::exchange(separator, ", ");
      *text += std::to_string(place);
    }
    *text += "]}";
  }
  *text += ']';
}

// ---- What cannot be held ----

class Reasons {
 public:
  void Add(const std::string& owner, const std::string& what) {
    const auto [at, is_new] = places_.emplace(what, std::pair(0, owner));
    ++at->second.first;
  }
  [[nodiscard]] std::vector<std::string> Sentences() const {
    std::vector<std::string> sentences;
    for (const auto& [what, place] : places_) {
      sentences.push_back(Text(what, " (", place.first, place.first == 1 ? " time" : " times",
                               ", first: ", place.second, ")"));
    }
    return sentences;
  }

 private:
  std::map<std::string, std::pair<int, std::string>> places_;
};

template <class Owner>
void AddReasons(const Owner& owner, const std::string& name, Reasons* reasons) {
  const auto check = [&](const auto& terms) {
    for (const auto& term : terms) {
      if (!(term.in == GraphOfConvexSets::TranscriptionSet())) {
        reasons->Add(name, "a term that is not for all transcriptions");
      }
      const auto& evaluator = *term.binding.evaluator();
      if (!HasPerspective(evaluator)) {
        reasons->Add(name, Text("a ", evaluator.Kind(), " that has no perspective"));
      } else if (!WhyNoEntry(evaluator).empty()) {
        reasons->Add(name, Text("a ", evaluator.Kind(), " of a user's class"));
      }
    }
  };
  check(owner.costs());
  check(owner.constraints());
}

}  // namespace
}  // namespace io

std::vector<std::string> CannotHold(const GraphProblem& problem) {
  if (problem.graph == nullptr) return {"there is no graph"};
  const GraphOfConvexSets& graph = *problem.graph;
  io::Reasons reasons;
  for (const auto* end : {problem.source, problem.target}) {
    if (end == nullptr || !graph.IsValid(*end)) {
      reasons.Add(end == problem.source ? "source" : "target", "an end that is no vertex of it");
    }
  }
  for (const auto* vertex : graph.Vertices()) {
    io::AddReasons(*vertex, "vertex " + vertex->name(), &reasons);
    const std::string why = io::WhyNoEntry(vertex->set());
    if (!why.empty()) reasons.Add("vertex " + vertex->name(), why);
  }
  for (const auto* edge : graph.Edges()) {
    io::AddReasons(*edge, "edge " + edge->name(), &reasons);
    if (edge->slacks().size() > 0) reasons.Add("edge " + edge->name(), "slack variables");
    if (edge->phi_value()) reasons.Add("edge " + edge->name(), "a fixed flow");
  }
  return reasons.Sentences();
}

std::string GraphText(const GraphProblem& problem, std::vector<std::string>* notes) {
  std::string reasons;
  for (const std::string& reason : CannotHold(problem)) reasons += "; " + reason;
  Require(reasons.empty(), "gcs/1 cannot hold this graph", reasons);
  io::Notes noted(notes);
  std::string text = io::GraphWriter(problem, &noted).Write();
  noted.Finish();
  return text;
}

void WriteGraph(const GraphProblem& problem, const std::string& path,
                std::vector<std::string>* notes) {
  const std::string text = GraphText(problem, notes);
  io::WriteBytes(path, path.ends_with(".gz") ? io::Zipped(text) : text);
}

}  // namespace switchyard
