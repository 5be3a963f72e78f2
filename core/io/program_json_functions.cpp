// Functions in program/1: as expressions, for people, and as the steps of a tape, which are exact.
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/io/expression_text.hpp"
#include "core/io/op_words.hpp"
#include "core/io/program_json.hpp"

namespace switchyard::io {
namespace {

using Place = Tape::Place;
constexpr int kIntLimit = std::numeric_limits<int>::max();

std::size_t At(Place place) { return static_cast<std::size_t>(place); }

// A constant may be any double: what is not a number is the value of a function outside its domain.
double ReadConstant(JsonValue constant) {
  if (constant.kind() == JsonKind::kString) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (constant.String() == "nan") return nan;
    if (constant.String() == "-nan") return -nan;
  }
  return constant.NumberOrInfinity();
}

void AppendConstant(double value, std::string* text) {
  if (std::isnan(value)) {
    *text += std::signbit(value) ? "\"-nan\"" : "\"nan\"";
  } else {
    AppendJson(value, text);
  }
}

// [word, operands...]; `places` has where each place of the file is on the tape.
Place ReadStep(JsonValue step, const std::vector<Place>& places, Tape* tape) {
  if (step.kind() != JsonKind::kArray || step.Size() == 0) {
    step.Fail("an operation and its operands in a list");
  }
  const std::vector<JsonValue> parts = step.Elements();
  const OpWords* const words = OpCalled(parts[0].String(), &OpWords::step);
  if (words == nullptr) {
    const auto names = WordsOf(&OpWords::step);
    std::string list;
    for (const std::string_view name : names) list += Text(list.empty() ? "" : ", ", name);
    parts[0].Fail("an operation (" + list + ")", QuotedWithNearest(parts[0].String(), names));
  }
  const bool constant = words->op == Op::kConstant;
  const int operands = constant ? 1 : NumOperands(words->op);
  if (static_cast<int>(parts.size()) != 1 + operands) {
    const char* const places_needed = operands == 1 ? " place" : " places";
    step.Fail(constant ? "\"constant\" and a number"
                       : Text(Quoted(words->step), " and ", operands, places_needed));
  }
  if (constant) return tape->Constant(ReadConstant(parts[1]));
  std::array<Place, 3> operand = {};
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    operand[k] = places[At(
        parts[k + 1].Integer(0, static_cast<int>(places.size()), "the place of an earlier value"))];
  }
  const auto [a, b, c] = operand;
  return operands == 1   ? tape->Apply(words->op, a)
         : operands == 2 ? tape->Apply(words->op, a, b)
                         : tape->Apply(words->op, a, b, c);
}

// Compiling takes memory for every operation that each output needs.
void TakeRoom(const Tape& tape, JsonValue outputs, JsonRoom* room) {
  std::vector<int> seen_by(tape.steps().size(), -1);
  std::vector<Place> needed;
  int output = 0;
  for (const Place root : tape.outputs()) {
    needed.assign(1, root);
    for (std::size_t k = 0; k < needed.size(); ++k) {
      const Tape::Step& step = tape.steps()[At(needed[k])];
      for (int i = 0; i < NumOperands(step.op); ++i) {
        const Place place = step.operand[static_cast<std::size_t>(i)];
        if (std::exchange(seen_by[At(place)], output) != output) needed.push_back(place);
      }
    }
    room->Take(needed.size(), outputs);
    ++output;
  }
}

std::shared_ptr<const Function> ReadTape(JsonValue entry, const JsonFields& fields,
                                         EntrySource* source) {
  const int inputs = fields["arguments"].Integer(0, kIntLimit, "a number of arguments");
  source->numbers.Take(At(inputs), fields["arguments"]);
  Tape tape(inputs);
  const auto expressions = fields.Find("expressions");
  const auto steps = fields.Find("steps");
  if (expressions.has_value() == steps.has_value()) {
    entry.Fail("\"expressions\" or \"steps\"",
               steps ? "an object with both" : "an object without them");
  }
  if (expressions) {
    if (const auto outputs = fields.Find("outputs")) {
      outputs->Fail("\"steps\" beside it", "\"expressions\"");
    }
    expressions->ForEach([&](JsonValue text) { tape.AddOutput(WriteExpression(text, &tape)); });
    TakeRoom(tape, *expressions, &source->operations);
    return CompileTape(tape);
  }
  std::vector<Place> places(At(inputs));
  std::iota(places.begin(), places.end(), 0);
  steps->ForEach([&](JsonValue step) { places.push_back(ReadStep(step, places, &tape)); });
  const JsonValue outputs = fields["outputs"];
  outputs.ForEach([&](JsonValue place) {
    tape.AddOutput(
        places[At(place.Integer(0, static_cast<int>(places.size()), "the place of a value"))]);
  });
  TakeRoom(tape, outputs, &source->operations);
  return CompileTape(tape);
}

void AppendTape(const Tape& tape, EntrySink* sink) {
  std::string& text = *sink->text;
  text += Text(", \"arguments\": ", tape.num_inputs(), ", \"steps\": [");
  const char* before = "";
  for (std::size_t place = At(tape.num_inputs()); place < tape.steps().size(); ++place) {
    const Tape::Step& step = tape.steps()[place];
    text += std::exchange(before, ", ");
    ((text += "[\"") += kOpWords[static_cast<std::size_t>(step.op)].step) += '"';
    if (step.op == Op::kConstant) {
      text += ", ";
      AppendConstant(step.constant, &text);
    }
    for (int k = 0; k < NumOperands(step.op); ++k) {
      text += ", ";
      text += std::to_string(step.operand[static_cast<std::size_t>(k)]);
    }
    text += ']';
  }
  text += "], \"outputs\": [";
  before = "";
  for (const Place place : tape.outputs()) {
    text += std::exchange(before, ", ");
    text += std::to_string(place);
  }
  text += ']';
}

bool ReadConvex(const JsonFields& fields) {
  const auto convex = fields.Find("convex");
  return convex && convex->Bool();
}

void AppendConvex(bool is_convex, EntrySink* sink) {
  *sink->text += is_convex ? ", \"convex\": true" : ", \"convex\": false";
}

}  // namespace

const Function* FunctionOf(const EvaluatorBase& term) {
  if (const auto* cost = dynamic_cast<const FunctionCost*>(&term)) return cost->function().get();
  const auto* rows = dynamic_cast<const FunctionConstraint*>(&term);
  return rows != nullptr ? rows->function().get() : nullptr;
}

std::shared_ptr<Cost> ReadFunctionCost(JsonValue entry, EntrySource* source) {
  const JsonFields fields(
      entry, {"type", "description", "arguments", "expressions", "steps", "outputs", "convex"});
  auto function = ReadTape(entry, fields, source);
  if (function->num_outputs() != 1) {
    const auto expressions = fields.Find("expressions");
    (expressions ? *expressions : fields["outputs"]).Fail("a list of 1, the value of a cost");
  }
  return std::make_shared<FunctionCost>(std::move(function), ReadConvex(fields));
}

void WriteFunctionCost(const Cost& cost, EntrySink* sink) {
  const auto& term = static_cast<const FunctionCost&>(cost);
  AppendTape(*TapeOf(*term.function()), sink);
  AppendConvex(term.is_convex(), sink);
}

std::shared_ptr<Constraint> ReadFunctionRows(JsonValue entry, EntrySource* source) {
  const JsonFields fields(entry, {"type", "description", "row_names", "arguments", "expressions",
                                  "steps", "outputs", "convex", "lb", "ub"});
  auto function = ReadTape(entry, fields, source);
  CheckEntries(fields["lb"], function->num_outputs(), "value of the function");
  const JsonSides sides = ReadSides(fields["lb"], fields["ub"]);
  return std::make_shared<FunctionConstraint>(std::move(function), sides.lower, sides.upper,
                                              ReadConvex(fields));
}

void WriteFunctionRows(const Constraint& constraint, EntrySink* sink) {
  const auto& term = static_cast<const FunctionConstraint&>(constraint);
  AppendTape(*TapeOf(*term.function()), sink);
  *sink->text += ", \"lb\": ";
  AppendJson(term.lower_bound(), sink->text);
  *sink->text += ", \"ub\": ";
  AppendJson(term.upper_bound(), sink->text);
  AppendConvex(term.is_convex(), sink);
}

}  // namespace switchyard::io
