// switchyard/model/program_variables.hpp - the decision variables of a program: ids, types, names,
// initial guess.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/evaluator.hpp"
#include "switchyard/symbolic/name_table.hpp"
#include "switchyard/symbolic/variable.hpp"

namespace switchyard {

/// The part of MathematicalProgram that speaks of variables.
class SWITCHYARD_EXPORT ProgramVariables {
 public:
  ProgramVariables& operator=(const ProgramVariables&) = delete;

  /// Grows when variables, bindings or the sense are added, removed or changed; coefficients have
  /// versions of their own.
  [[nodiscard]] std::uint64_t structure_version() const { return structure_version_; }

  VectorXDecisionVariable NewContinuousVariables(int rows, const std::string& name = "x");
  VectorXDecisionVariable NewBinaryVariables(int rows, const std::string& name = "b");
  VectorXDecisionVariable NewIntegerVariables(int rows, const std::string& name = "z");
  MatrixXDecisionVariable NewContinuousVariables(int rows, int cols, const std::string& name = "X");
  MatrixXDecisionVariable NewBinaryVariables(int rows, int cols, const std::string& name = "B");
  template <int Rows, int Cols = 1>
  MatrixDecisionVariable<Rows, Cols> NewContinuousVariables(const std::string& name = "X") {
    if constexpr (Cols == 1) {
      return NewContinuousVariables(Rows, name);
    } else {
      return NewContinuousVariables(Rows, Cols, name);
    }
  }
  template <int Rows, int Cols = 1>
  MatrixDecisionVariable<Rows, Cols> NewBinaryVariables(const std::string& name = "b") {
    if constexpr (Cols == 1) {
      return NewBinaryVariables(Rows, name);
    } else {
      return NewBinaryVariables(Rows, Cols, name);
    }
  }
  /// rows x rows with X(i, j) and X(j, i) one variable: rows (rows + 1) / 2 new ones.
  MatrixXDecisionVariable NewSymmetricContinuousVariables(int rows, const std::string& name = "X");
  /// One variable for each name and type: what file readers use.
  VectorXDecisionVariable NewVariables(std::vector<std::string> names,
                                       const std::vector<VariableType>& types);
  /// Variables of another program, under their ids, with generic names and continuous; those that
  /// are here already stay as they are.
  void AddDecisionVariables(const VariableList& variables);

  [[nodiscard]] int num_vars() const { return static_cast<int>(types_.size()); }
  [[nodiscard]] Variable decision_variable(int i) const;
  [[nodiscard]] VectorXDecisionVariable decision_variables() const;
  [[nodiscard]] VariableType variable_type(int i) const {
    return types_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] bool has_integers() const;
  /// Throws InvalidArgument where the variable is not of this program.
  [[nodiscard]] int FindDecisionVariableIndex(Variable variable) const;
  [[nodiscard]] std::vector<int> FindDecisionVariableIndices(const VariableList& variables) const;
  [[nodiscard]] bool Contains(Variable variable) const { return FindIndex(variable) >= 0; }
  /// The name of variable i: "x", "x(3)" or "X(1,2)", or the one that a file gave.
  [[nodiscard]] std::string VariableName(int i) const { return names_.Name(i); }
  /// The entries of x that belong to `variables`.
  [[nodiscard]] Eigen::VectorXd ValuesOf(const VectorXDecisionVariable& variables,
                                         const VectorRef& x) const;

  // ---- Initial guess: NaN where unset, and NaN unsets ----

  void SetInitialGuess(Variable variable, double value);
  void SetInitialGuess(const VariableList& variables, const VectorRef& values);
  void SetInitialGuessForAllVariables(const VectorRef& values);
  [[nodiscard]] double GetInitialGuess(Variable variable) const;
  [[nodiscard]] Eigen::VectorXd GetInitialGuess(const VariableList& variables) const;
  [[nodiscard]] Eigen::VectorXd initial_guess() const;

  /// Writes the values into the entries of `values`, a vector of num_vars(), that belong to the
  /// variables.
  void SetDecisionVariableValueInVector(const VariableList& variables, const VectorRef& new_values,
                                        Eigen::Ref<Eigen::VectorXd> values) const;
  void SetDecisionVariableValueInVector(Variable variable, double new_value,
                                        Eigen::Ref<Eigen::VectorXd> values) const;

 protected:
  ProgramVariables() = default;
  ProgramVariables(const ProgramVariables&) = default;
  ~ProgramVariables() = default;
  /// Throws where a variable is not of this program, in the words of the evaluator.
  void CheckVariables(const EvaluatorBase& evaluator, const VectorXDecisionVariable& vars) const;
  void StructureChanged() { ++structure_version_; }

 private:
  struct Block {  // consecutive ids under consecutive indices
    Variable::Id first_id;
    int first_index;
    int count;
  };
  VectorXDecisionVariable AddBlock(std::int64_t count, VariableType type);
  VectorXDecisionVariable NewVector(int rows, VariableType type, const std::string& name);
  MatrixXDecisionVariable NewMatrix(int rows, int cols, VariableType type, const std::string& name);
  [[nodiscard]] int FindIndex(Variable variable) const;  // -1: not of this program

  std::uint64_t structure_version_ = 0;
  std::vector<Block> blocks_;        // by first_id
  std::vector<Variable> variables_;  // by index, as types_
  std::vector<VariableType> types_;
  NameTable names_;
  std::map<int, double> guess_;  // of those that have one
};

}  // namespace switchyard
