// core/io/program_json.hpp - programs as program/1, which holds every program exactly; the format
// is described in docs/program-format.md.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/io/json_numbers.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

std::unique_ptr<MathematicalProgram> ReadProgramJson(const FileText& text, Notes* notes);
std::vector<std::string> ProgramJsonCannotHold(const MathematicalProgram& program);
std::string WriteProgramJson(const MathematicalProgram& program, Notes* notes);

/// What the reading of entries needs beside them: a table of matrices that they may name, and how
/// much the text may ask for by its dimensions alone.
struct EntrySource {
  explicit EntrySource(const FileText& text);
  /// A matrix that stands in place, or the one that a name stands for.
  [[nodiscard]] SparseMatrix Matrix(JsonValue value);

  const JsonTable* matrices = nullptr;
  std::vector<std::optional<SparseMatrix>> read;  // of them
  JsonRoom numbers;                               // rows, columns and entries of sparse matrices
  JsonRoom dense;       // entries of the matrices behind a linear matrix inequality
  JsonRoom operations;  // of functions, counted for each output that needs them
};

/// Matrices that entries name, each once.
struct MatrixNames {
  std::unordered_map<std::string, int> numbers;  // by their texts
  std::string entries;                           // of the table
};

/// Where an entry is written to, and its matrices: in place where there is no table of them.
struct EntrySink {
  void Append(const char* member, const SparseMatrix& matrix);

  std::string* text;
  Notes* notes;
  MatrixNames* matrices = nullptr;
};

/// One kind of evaluator: its name in files, and how its members are read and written. "type",
/// "description" and "row_names" are those of every kind.
template <class Base>
struct EvaluatorFacts {
  std::string_view type;
  bool (*is)(const Base& evaluator);  // the kind that is written so
  std::shared_ptr<Base> (*read)(JsonValue entry, EntrySource* source);
  void (*write)(const Base& evaluator, EntrySink* sink);
};

std::shared_ptr<Cost> ReadFunction(JsonValue entry, EntrySource* source);
std::shared_ptr<Constraint> ReadConstraint(JsonValue entry, EntrySource* source);
/// The whole entry. Throws InvalidArgument where no kind of the tables fits.
void AppendEntry(const Cost& function, EntrySink* sink);
void AppendEntry(const Constraint& constraint, EntrySink* sink);
/// Why no kind fits, as what is said of the term: "is of a class ..."; empty where one does.
std::string WhyNoEntry(const Cost& function);
std::string WhyNoEntry(const Constraint& constraint);

/// The function that a term is; null where it is none.
const Function* FunctionOf(const EvaluatorBase& term);
// Rows of the tables.
std::shared_ptr<Cost> ReadFunctionCost(JsonValue entry, EntrySource* source);
void WriteFunctionCost(const Cost& cost, EntrySink* sink);
std::shared_ptr<Constraint> ReadFunctionRows(JsonValue entry, EntrySource* source);
void WriteFunctionRows(const Constraint& constraint, EntrySink* sink);

}  // namespace switchyard::io
