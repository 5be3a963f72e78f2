// switchyard/sos1_groups.hpp - the groups of "sy.sos1/1", checked and by value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/hints.h"
#include "switchyard/plugin.hpp"

namespace switchyard {

/// At most one variable of each group is not 0.
class Sos1Groups {
 public:
  /// None where the problem has no such hint. Throws plugin::Failure (SY_E_ARGUMENT): it does not
  /// fit the problem.
  explicit Sos1Groups(const sy_problem& problem) {
    for (const sy_hint* hint = problem.hints; hint != nullptr && hint->id != nullptr; ++hint) {
      if (std::strcmp(hint->id, "sy.sos1/1") != 0) continue;
      Take(plugin::Whole(*static_cast<const sy_sos1*>(hint->data)), problem.num_vars);
    }
  }

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(start_.size()) - 1; }
  /// The variables of a group, in the order in which to split.
  [[nodiscard]] std::span<const std::int32_t> Of(std::int32_t group) const {
    const auto g = static_cast<std::size_t>(group);
    return std::span(x_).subspan(static_cast<std::size_t>(start_[g]),
                                 static_cast<std::size_t>(start_[g + 1] - start_[g]));
  }

 private:
  void Take(const sy_sos1& groups, std::int32_t num_vars) {
    const auto need = [](bool holds, const std::string& what, std::int32_t value) {
      if (holds) return;
      throw plugin::Failure(SY_E_ARGUMENT, "sy.sos1/1: " + what + std::to_string(value));
    };
    for (std::int32_t g = 0; g < groups.num_groups; ++g) {
      need(groups.start[g] >= 0 && groups.start[g] <= groups.start[g + 1],
           "start must ascend from 0, and start[" + std::to_string(g) + "] is ", groups.start[g]);
    }
    if (groups.num_groups == 0) return;
    start_.assign(groups.start, groups.start + groups.num_groups + 1);
    x_.assign(groups.x, groups.x + start_.back());
    for (std::size_t k = 0; k < x_.size(); ++k) {
      need(x_[k] >= 0 && x_[k] < num_vars,
           "x[" + std::to_string(k) + "] must be in [0, " + std::to_string(num_vars) + "), and is ",
           x_[k]);
    }
  }

  std::vector<std::int32_t> start_ = {0};
  std::vector<std::int32_t> x_;
};

}  // namespace switchyard
