// linear/start.hpp - the warm start of an instance, kept in step with the problem it is for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "linear/answer.hpp"
#include "switchyard/abi.h"

namespace switchyard::linear {

struct Start {
  std::vector<double> x;              // empty, or NaN where unknown
  std::vector<std::uint8_t> x_basis;  // both empty, or both complete
  std::vector<std::uint8_t> row_basis;

  Start() = default;
  /// An entry of the basis that is unknown is nonbasic for a variable and basic for a row, which
  /// for a whole basis is the slack basis.
  Start(const sy_start& given, std::int32_t num_vars, std::int32_t num_rows) {
    if (given.x != nullptr) x.assign(given.x, given.x + num_vars);
    if (given.x_basis == nullptr || (given.row_basis == nullptr && num_rows > 0)) return;
    x_basis.assign(given.x_basis, given.x_basis + num_vars);
    if (num_rows > 0) row_basis.assign(given.row_basis, given.row_basis + num_rows);
    for (auto& b : x_basis) b = b == SY_BASIS_UNKNOWN ? std::uint8_t{SY_BASIS_LOWER} : b;
    for (auto& b : row_basis) b = b == SY_BASIS_UNKNOWN ? std::uint8_t{SY_BASIS_BASIC} : b;
  }

  [[nodiscard]] bool has_basis() const { return !x_basis.empty(); }

  /// Follows an update: rows that went, then variables and rows that came.
  void Follow(const sy_update& update) {
    if (has_basis()) {
      for (std::int32_t k = update.num_gone_rows; k-- > 0;) {
        row_basis.erase(row_basis.begin() + update.gone_row[k]);
      }
    }
    if (update.more == nullptr) return;
    const auto vars = static_cast<std::size_t>(update.more->num_vars);
    if (!x.empty()) x.insert(x.end(), vars, kNaN);
    if (!has_basis()) return;
    x_basis.insert(x_basis.end(), vars, std::uint8_t{SY_BASIS_LOWER});
    row_basis.insert(row_basis.end(), static_cast<std::size_t>(update.more->num_rows),
                     std::uint8_t{SY_BASIS_BASIC});
  }
};

}  // namespace switchyard::linear
