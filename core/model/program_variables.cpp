#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

#include "switchyard/model/new_ids.hpp"
#include "switchyard/model/program_variables.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

// The next id of the process; 0 is the dummy's.
std::atomic<Variable::Id> next_id{1};

// Throws InvalidArgument where a size is negative.
void CheckDimension(const char* what, int size) {
  Require(size >= 0, "new variables: ", what, " needs to be 0 or more, got ", size);
}

// The block becomes the names of these new variables: in their program and in texts about them.
void AddNames(const VectorXDecisionVariable& added, NameBlock block, NameTable* names) {
  if (added.size() == 0) return;
  const auto shared = std::make_shared<const NameBlock>(std::move(block));
  names->Add(shared);
  RegisterNames(added[0].get_id(), shared);
}

std::size_t At(int i) { return static_cast<std::size_t>(i); }

}  // namespace

Variable::Id NewVariableIds(std::int64_t count) { return next_id.fetch_add(count); }

VectorXDecisionVariable ProgramVariables::AddBlock(std::int64_t count, VariableType type) {
  ++structure_version_;
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  Require(count <= kMost - num_vars(), "new variables: a program holds at most ", kMost,
          ", this one has ", num_vars(), " and got ", count);
  VectorXDecisionVariable added(count);
  if (count == 0) return added;
  const Variable::Id first = NewVariableIds(count);
  if (!blocks_.empty() && blocks_.back().first_id + blocks_.back().count == first &&
      blocks_.back().first_index + blocks_.back().count == num_vars()) {
    blocks_.back().count += static_cast<int>(count);
  } else {  // ids only grow: the new block is the last by first_id too
    blocks_.push_back({first, num_vars(), static_cast<int>(count)});
  }
  for (std::int64_t k = 0; k < count; ++k) added[k] = Variable(first + k);
  variables_.insert(variables_.end(), added.begin(), added.end());
  types_.insert(types_.end(), static_cast<std::size_t>(count), type);
  return added;
}

VectorXDecisionVariable ProgramVariables::NewVector(int rows, VariableType type,
                                                    const std::string& name) {
  CheckDimension("rows", rows);
  VectorXDecisionVariable added = AddBlock(rows, type);
  AddNames(added, NameBlock::Shaped(name, rows, 0), &names_);
  return added;
}

MatrixXDecisionVariable ProgramVariables::NewMatrix(int rows, int cols, VariableType type,
                                                    const std::string& name) {
  CheckDimension("rows", rows);
  CheckDimension("cols", cols);
  const VectorXDecisionVariable added = AddBlock(std::int64_t{rows} * cols, type);
  AddNames(added, NameBlock::Shaped(name, rows, cols), &names_);
  return added.reshaped(rows, cols);
}

VectorXDecisionVariable ProgramVariables::NewContinuousVariables(int rows,
                                                                 const std::string& name) {
  return NewVector(rows, VariableType::kContinuous, name);
}

VectorXDecisionVariable ProgramVariables::NewBinaryVariables(int rows, const std::string& name) {
  return NewVector(rows, VariableType::kBinary, name);
}

VectorXDecisionVariable ProgramVariables::NewIntegerVariables(int rows, const std::string& name) {
  return NewVector(rows, VariableType::kInteger, name);
}

MatrixXDecisionVariable ProgramVariables::NewContinuousVariables(int rows, int cols,
                                                                 const std::string& name) {
  return NewMatrix(rows, cols, VariableType::kContinuous, name);
}

MatrixXDecisionVariable ProgramVariables::NewBinaryVariables(int rows, int cols,
                                                             const std::string& name) {
  return NewMatrix(rows, cols, VariableType::kBinary, name);
}

MatrixXDecisionVariable ProgramVariables::NewSymmetricContinuousVariables(int rows,
                                                                          const std::string& name) {
  CheckDimension("rows", rows);
  const VectorXDecisionVariable added =
      AddBlock(std::int64_t{rows} * (std::int64_t{rows} + 1) / 2, VariableType::kContinuous);
  AddNames(added, NameBlock::Symmetric(name, rows), &names_);
  MatrixXDecisionVariable X(rows, rows);
  for (Eigen::Index j = 0, k = 0; j < rows; ++j) {
    for (Eigen::Index i = j; i < rows; ++i) X(i, j) = X(j, i) = added[k++];
  }
  return X;
}

VectorXDecisionVariable ProgramVariables::NewVariables(std::vector<std::string> names,
                                                       const std::vector<VariableType>& types) {
  Require(names.size() == types.size(), "new variables: one type for each name, got ", names.size(),
          " names and ", types.size(), " types");
  const int first = num_vars();
  VectorXDecisionVariable added =
      AddBlock(static_cast<std::int64_t>(names.size()), VariableType::kContinuous);
  std::copy(types.begin(), types.end(), types_.begin() + first);
  AddNames(added, NameBlock::Listed(std::move(names)), &names_);
  return added;
}

void ProgramVariables::AddDecisionVariables(const VariableList& variables) {
  ++structure_version_;
  std::vector<Variable> added;
  std::vector<std::string> names;
  std::unordered_set<Variable> seen;
  for (Eigen::Index i = 0; i < variables.vector().size(); ++i) {
    const Variable v = variables.vector()[i];
    Require(!v.is_dummy(), "AddDecisionVariables: variable ", i, " of ", variables.vector().size(),
            " is a dummy, it belongs to no program");
    if (Contains(v) || !seen.insert(v).second) continue;
    added.push_back(v);
    names.push_back(Text("v", v.get_id()));
  }
  Require(added.size() <= At(std::numeric_limits<int>::max() - num_vars()),
          "AddDecisionVariables: too many variables, got ", added.size());
  for (std::size_t k = 0; k < added.size(); ++k) {
    const int index = num_vars() + static_cast<int>(k);
    const bool continues = k > 0 && added[k].get_id() == added[k - 1].get_id() + 1;
    if (continues) {
      ++blocks_.back().count;
    } else {
      blocks_.push_back({added[k].get_id(), index, 1});
    }
  }
  std::sort(blocks_.begin(), blocks_.end(),
            [](const Block& a, const Block& b) { return a.first_id < b.first_id; });
  variables_.insert(variables_.end(), added.begin(), added.end());
  types_.insert(types_.end(), added.size(), VariableType::kContinuous);
  names_.Add(std::make_shared<const NameBlock>(NameBlock::Listed(std::move(names))));
}

Variable ProgramVariables::decision_variable(int i) const {
  Require(i >= 0 && i < num_vars(), "decision variable ", i, ": there are ", num_vars());
  return variables_[At(i)];
}

VectorXDecisionVariable ProgramVariables::decision_variables() const {
  return Eigen::Map<const VectorXDecisionVariable>(variables_.data(), num_vars());
}

bool ProgramVariables::has_integers() const {
  return std::any_of(types_.begin(), types_.end(),
                     [](VariableType t) { return t != VariableType::kContinuous; });
}

// The last block that starts at or before the id. Halving without a branch on the comparison: with
// variables in random order a branch would be guessed wrong every second time.
int ProgramVariables::FindIndex(Variable variable) const {
  if (blocks_.empty()) return -1;
  const Block* block = blocks_.data();
  for (std::size_t left = blocks_.size(); left > 1;) {
    const std::size_t half = left / 2;
    block += block[half].first_id <= variable.get_id() ? half : 0;
    left -= half;
  }
  const Variable::Id offset = variable.get_id() - block->first_id;
  return offset >= 0 && offset < block->count ? block->first_index + static_cast<int>(offset) : -1;
}

int ProgramVariables::FindDecisionVariableIndex(Variable variable) const {
  const int index = FindIndex(variable);
  if (index < 0) [[unlikely]] {
    Require(!variable.is_dummy(), "a dummy variable belongs to no program");
    Refuse("the variable with id ", variable.get_id(), " is not of this program");
  }
  return index;
}

std::vector<int> ProgramVariables::FindDecisionVariableIndices(
    const VariableList& variables) const {
  std::vector<int> indices;
  indices.reserve(static_cast<std::size_t>(variables.vector().size()));
  for (const Variable v : variables.vector()) indices.push_back(FindDecisionVariableIndex(v));
  return indices;
}

void ProgramVariables::SetInitialGuess(Variable variable, double value) {
  SetInitialGuess(VariableList(variable), Eigen::VectorXd::Constant(1, value));
}

void ProgramVariables::SetInitialGuess(const VariableList& variables, const VectorRef& values) {
  const std::vector<int> indices = FindDecisionVariableIndices(variables);
  Require(values.size() == variables.vector().size(), "initial guess: ", indices.size(),
          " variables need as many values, got ", values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    Require(!std::isinf(values[i]), "initial guess: value ", i,
            " needs to be finite, or NaN for none, got ", values[i]);
  }
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const int index = indices[static_cast<std::size_t>(i)];
    if (std::isnan(values[i])) {
      guess_.erase(index);
    } else {
      guess_[index] = values[i];
    }
  }
}

void ProgramVariables::SetInitialGuessForAllVariables(const VectorRef& values) {
  SetInitialGuess(decision_variables(), values);
}

Eigen::VectorXd ProgramVariables::ValuesOf(const VectorXDecisionVariable& variables,
                                           const VectorRef& x) const {
  Require(x.size() == num_vars(), "evaluation: x needs ", num_vars(), " entries, got ", x.size());
  Eigen::VectorXd values(variables.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = x[FindDecisionVariableIndex(variables[i])];
  }
  return values;
}

void ProgramVariables::CheckVariables(const EvaluatorBase& evaluator,
                                      const VectorXDecisionVariable& vars) const {
  for (Eigen::Index i = 0; i < vars.size(); ++i) {
    if (FindIndex(vars[i]) >= 0) [[likely]]
      continue;
    Refuse(evaluator.Name(), ": variable ", i, " of ", vars.size(), " is ",
           vars[i].is_dummy() ? "a dummy, it belongs to no program" : "not of this program");
  }
}

void ProgramVariables::SetDecisionVariableValueInVector(const VariableList& variables,
                                                        const VectorRef& new_values,
                                                        Eigen::Ref<Eigen::VectorXd> values) const {
  const std::vector<int> indices = FindDecisionVariableIndices(variables);
  Require(values.size() == num_vars(), "values in a vector: it needs ", num_vars(),
          " entries, got ", values.size());
  Require(new_values.size() == variables.vector().size(), "values in a vector: ", indices.size(),
          " variables need as many values, got ", new_values.size());
  for (std::size_t k = 0; k < indices.size(); ++k) {
    values[indices[k]] = new_values[static_cast<Eigen::Index>(k)];
  }
}

void ProgramVariables::SetDecisionVariableValueInVector(Variable variable, double new_value,
                                                        Eigen::Ref<Eigen::VectorXd> values) const {
  SetDecisionVariableValueInVector(VariableList(variable), Eigen::VectorXd::Constant(1, new_value),
                                   values);
}

double ProgramVariables::GetInitialGuess(Variable variable) const {
  const auto at = guess_.find(FindDecisionVariableIndex(variable));
  return at == guess_.end() ? std::numeric_limits<double>::quiet_NaN() : at->second;
}

Eigen::VectorXd ProgramVariables::GetInitialGuess(const VariableList& variables) const {
  return variables.vector().unaryExpr([this](Variable v) { return GetInitialGuess(v); });
}

Eigen::VectorXd ProgramVariables::initial_guess() const {
  Eigen::VectorXd guess =
      Eigen::VectorXd::Constant(num_vars(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& [index, value] : guess_) guess[index] = value;
  return guess;
}

}  // namespace switchyard
