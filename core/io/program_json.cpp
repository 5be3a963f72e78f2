#include "core/io/program_json.hpp"

#include <array>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/io/flat.hpp"

namespace switchyard::io {
namespace {

constexpr std::string_view kFormat = "program/1";

struct TypeName {
  VariableType type;
  std::string_view name;
};
constexpr std::array kTypes = {TypeName{VariableType::kContinuous, "continuous"},
                               TypeName{VariableType::kInteger, "integer"},
                               TypeName{VariableType::kBinary, "binary"}};

VariableType TypeOf(JsonValue name) {
  for (const TypeName& row : kTypes) {
    if (name.String() == row.name) return row.type;
  }
  name.Fail("continuous, integer or binary");
}

class ProgramReader {
 public:
  ProgramReader(const FileText& text, Notes* notes)
      : document_(text), source_(text), notes_(*notes) {}

  std::unique_ptr<MathematicalProgram> Read() {
    const JsonValue root = document_.root();
    CheckFormat(root);
    const JsonFields fields(root, {"format", "name", "notes", "sense", "variables", "functions",
                                   "constraints", "costs", "subject_to"});
    if (const auto name = fields.Find("name")) program_->set_name(std::string(name->String()));
    if (const auto notes = fields.Find("notes")) {
      notes_.Count("the file's notes are not kept", notes->String());
    }
    if (const auto sense = fields.Find("sense")) ReadSense(*sense);
    ReadVariables(fields["variables"]);
    const JsonTable functions(fields.Find("functions"), "a function");
    const JsonTable constraints(fields.Find("constraints"), "a constraint");
    ReadBindings(fields.Find("costs"), "function", functions, ReadFunction,
                 [&](const Binding<Cost>& cost) { program_->AddCost(cost); });
    ReadBindings(fields.Find("subject_to"), "constraint", constraints, ReadConstraint,
                 [&](const Binding<Constraint>& row) { program_->AddConstraint(row); });
    return std::move(program_);
  }

 private:
  static void CheckFormat(JsonValue root) {
    const auto format = root.Member("format");
    if (!format) root.Fail("\"format\": \"program/1\"", "an object without it");
    if (format->String() == kFormat) return;
    format->Fail(Quoted(kFormat), Quoted(format->String()) +
                                      (format->String() == "gcs/1" ? ", a graph to plan in" : ""));
  }
  void ReadSense(JsonValue sense) {
    const bool maximize = sense.String() == "maximize";
    if (!maximize && sense.String() != "minimize") sense.Fail("minimize or maximize");
    if (maximize) program_->set_objective_sense(ObjectiveSense::kMaximize);
  }
  void ReadVariables(JsonValue list);
  VectorXDecisionVariable Variables(JsonValue list) const {
    VectorXDecisionVariable some(list.Size());
    Eigen::Index i = 0;
    list.ForEach([&](JsonValue index) {
      some(i++) = x_(index.Integer(0, static_cast<int>(x_.size()), "the number of a variable"));
    });
    return some;
  }
  template <class ReadEntry, class Add>
  void ReadBindings(std::optional<JsonValue> list, const char* what, const JsonTable& table,
                    ReadEntry read, Add add);

  JsonDocument document_;
  EntrySource source_;
  Notes& notes_;
  std::unique_ptr<MathematicalProgram> program_ = std::make_unique<MathematicalProgram>();
  VectorXDecisionVariable x_;
};

void ProgramReader::ReadVariables(JsonValue list) {
  std::vector<std::string> names;
  std::vector<VariableType> types;
  std::vector<std::pair<int, double>> guesses;
  names.reserve(static_cast<std::size_t>(list.Size()));
  types.reserve(names.capacity());
  list.ForEach([&](JsonValue variable) {
    const JsonFields fields(variable, {"name", "type", "guess"});
    const auto type = fields.Find("type");
    if (const auto guess = fields.Find("guess")) {
      guesses.emplace_back(static_cast<int>(names.size()), guess->Number());
    }
    names.emplace_back(fields["name"].String());
    types.push_back(type ? TypeOf(*type) : VariableType::kContinuous);
  });
  x_ = program_->NewVariables(std::move(names), types);
  for (const auto& [index, value] : guesses) program_->SetInitialGuess(x_(index), value);
}

// Every entry is read, so that every mistake is found; each is one evaluator, however many use it.
template <class ReadEntry, class Add>
void ProgramReader::ReadBindings(std::optional<JsonValue> list, const char* what,
                                 const JsonTable& table, ReadEntry read, Add add) {
  std::vector<decltype(read(document_.root(), &source_))> evaluators;
  std::vector<bool> used(static_cast<std::size_t>(table.size()), false);
  for (int i = 0; i < table.size(); ++i) evaluators.push_back(read(table.entry(i), &source_));
  if (list) {
    list->ForEach([&](JsonValue binding) {
      const JsonFields fields(binding, {what, "variables"});
      const auto entry = static_cast<std::size_t>(table.Find(fields[what]));
      CheckEntries(fields["variables"], evaluators[entry]->num_vars(),
                   Text("variable of ", table.name(static_cast<int>(entry))).c_str());
      used[entry] = true;
      add({evaluators[entry], Variables(fields["variables"])});
    });
  }
  for (int i = 0; i < table.size(); ++i) {
    if (!used[static_cast<std::size_t>(i)]) {
      notes_.Count(Text("a ", what, " that nothing uses is left out"), table.name(i));
    }
  }
}

class ProgramWriter {
 public:
  ProgramWriter(const MathematicalProgram& program, Notes* notes)
      : program_(program), notes_(notes) {}

  std::string Write() {
    out_ = Text("{\n\"format\": ", Quoted(kFormat), ",\n");
    if (!program_.name().empty()) {
      out_ += "\"name\": ";
      AppendJson(program_.name(), notes_, &out_);
      out_ += ",\n";
    }
    const bool maximize = program_.objective_sense() == ObjectiveSense::kMaximize;
    out_ += maximize ? "\"sense\": \"maximize\",\n" : "\"sense\": \"minimize\",\n";
    Variables();
    const auto costs = program_.GetAllCosts();
    const auto constraints = program_.GetAllConstraints();
    const auto functions = Table("functions", "f", costs);
    const auto rows = Table("constraints", "c", constraints);
    Bindings("costs", "function", "f", costs, functions);
    out_ += ",\n";
    Bindings("subject_to", "constraint", "c", constraints, rows);
    out_ += "\n}\n";
    return std::move(out_);
  }

 private:
  using Numbers = std::unordered_map<const EvaluatorBase*, int>;

  void Variables() {
    out_ += "\"variables\": [";
    const Eigen::VectorXd guess = program_.initial_guess();
    for (int i = 0; i < program_.num_vars(); ++i) {
      out_ += i == 0 ? "\n  {\"name\": " : ",\n  {\"name\": ";
      AppendJson(program_.VariableName(i), notes_, &out_);
      for (const TypeName& row : kTypes) {
        if (row.type != program_.variable_type(i) || row.type == VariableType::kContinuous) {
          continue;
        }
        out_ += Text(", \"type\": ", Quoted(row.name));
      }
      if (guess(i) == guess(i)) {
        out_ += ", \"guess\": ";
        AppendJson(guess(i), &out_);
      }
      out_ += '}';
    }
    out_ += "\n],\n";
  }

  // Each evaluator once, in the order of its first use.
  template <class C>
  Numbers Table(const char* name, const char* prefix, const std::vector<Binding<C>>& bindings) {
    Numbers numbers;
    out_ += Text("\"", name, "\": {");
    for (const Binding<C>& binding : bindings) {
      const int number = static_cast<int>(numbers.size());
      if (!numbers.emplace(binding.evaluator().get(), number).second) continue;
      out_ += Text(number == 0 ? "" : ",", "\n  \"", prefix, number, "\": ");
      AppendEntry(*binding.evaluator(), &sink_);
    }
    out_ += "\n},\n";
    return numbers;
  }

  template <class C>
  void Bindings(const char* name, const char* what, const char* prefix,
                const std::vector<Binding<C>>& bindings, const Numbers& numbers) {
    out_ += Text("\"", name, "\": [");
    const char* before = "\n";
    for (const Binding<C>& binding : bindings) {
      out_ += Text(std::exchange(before, ",\n"), "  {\"", what, "\": \"", prefix,
                   numbers.at(binding.evaluator().get()), "\", \"variables\": [");
      const char* separator = "";
      for (const int index : IndicesOf(program_, binding)) {
        out_ += std::exchange(separator, ", ");
        out_ += std::to_string(index);
      }
      out_ += "]}";
    }
    out_ += "\n]";
  }

  const MathematicalProgram& program_;
  Notes* notes_;
  std::string out_;
  EntrySink sink_{&out_, notes_};
};

template <class C>
void AddForeign(const std::vector<Binding<C>>& bindings, std::vector<std::string>* reasons) {
  std::unordered_set<const EvaluatorBase*> seen;
  for (const Binding<C>& binding : bindings) {
    const std::string why = WhyNoEntry(*binding.evaluator());
    if (why.empty() || !seen.insert(binding.evaluator().get()).second) continue;
    reasons->push_back(Text(binding.evaluator()->Name(), " ", why));
  }
}

}  // namespace

std::unique_ptr<MathematicalProgram> ReadProgramJson(const FileText& text, Notes* notes) {
  return ProgramReader(text, notes).Read();
}

std::vector<std::string> ProgramJsonCannotHold(const MathematicalProgram& program) {
  std::vector<std::string> reasons;
  AddForeign(program.GetAllCosts(), &reasons);
  AddForeign(program.GetAllConstraints(), &reasons);
  return reasons;
}

std::string WriteProgramJson(const MathematicalProgram& program, Notes* notes) {
  return ProgramWriter(program, notes).Write();
}

}  // namespace switchyard::io
