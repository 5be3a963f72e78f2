// core/symbolic/columns.hpp - the columns that variables get, in the order in which they come.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "switchyard/symbolic/expression.hpp"

namespace switchyard {

/// The variables under some expressions, numbered 0, 1, ... as they are first asked for.
///
/// The ids of one program lie close together: a table over their range serves where it is not much
/// longer than the number of terms, and else a hash map.
class Columns {
 public:
  explicit Columns(std::span<const Expression> expressions);

  [[nodiscard]] int Of(Variable variable) {
    int& column = table_.empty() ? far_.try_emplace(variable, -1).first->second
                                 : table_[static_cast<std::size_t>(variable.get_id() - low_)];
    if (column < 0) {
      column = size();
      variables_.push_back(variable);
    }
    return column;
  }
  [[nodiscard]] int size() const { return static_cast<int>(variables_.size()); }
  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }

 private:
  std::vector<Variable> variables_;
  Variable::Id low_ = 0;
  std::vector<int> table_;  // of the id low_ + k; -1: none yet. Empty: far_ serves
  std::unordered_map<Variable, int> far_;
};

}  // namespace switchyard
