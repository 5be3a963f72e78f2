// tests/conic/blocky.hpp - programs of a bordered block-diagonal shape, and the hint that says so.
#pragma once

#include <vector>

#include "switchyard/hints.h"
#include "tests/conic/programs.hpp"

namespace switchyard::conic {

/// Blocks of variables, each with rows and a cone of its own that may hold coupling variables too;
/// rows over all.
struct Blocky {
  std::int32_t blocks = 10;
  std::int32_t vars = 5;  // of a block
  std::int32_t coupling = 2;
  std::int32_t rows = 3;       // of a block
  std::int32_t long_rows = 2;  // over all
  bool quadratic = false;
};

/// The hint's table, in place as long as this is.
class BlockHint {
 public:
  explicit BlockHint(const Blocky& b) {
    for (std::int32_t k = 0; k < b.blocks; ++k) {
      x_.insert(x_.end(), static_cast<std::size_t>(b.vars), k);
      row_.insert(row_.end(), static_cast<std::size_t>(b.rows), k);
      cone_.push_back(k);
    }
    x_.insert(x_.end(), static_cast<std::size_t>(b.coupling), -1);
    row_.insert(row_.end(), static_cast<std::size_t>(b.long_rows), -1);
    table_ = {sizeof table_, b.blocks, x_.data(), row_.data(), cone_.data(), nullptr};
  }
  BlockHint(const BlockHint&) = delete;
  BlockHint& operator=(const BlockHint&) = delete;

  std::vector<std::int32_t>& x() { return x_; }
  [[nodiscard]] ProblemData Given(ProblemData d) const {
    d.hints = hints_;
    return d;
  }

 private:
  std::vector<std::int32_t> x_, row_, cone_;
  sy_blocks table_{};
  sy_hint hints_[2] = {{"sy.blocks/1", &table_}, {nullptr, nullptr}};
};

inline KnownAnswer BlockyOptimum(const Blocky& b, Random& random) {
  const std::int32_t vars = b.blocks * b.vars + b.coupling;
  std::vector<sy_cone> cones;
  for (std::int32_t k = 0; k < b.blocks; ++k) {
    cones.push_back(k % 3 == 0 ? SecondOrder(4) : k % 3 == 1 ? Rotated(4) : Semidefinite(2));
  }
  const auto block_of = [&](std::int32_t j) { return j < b.blocks * b.vars ? j / b.vars : -1; };
  /// Entries of a row of a block stay where they are its own, or couple, one in three.
  const auto within = [&](std::int32_t rows, auto&& block_of_row) {
    Csc m(rows, vars);
    for (std::int32_t j = 0; j < vars; ++j) {
      for (std::int32_t i = 0; i < rows; ++i) {
        const std::int32_t block = block_of_row(i);
        const bool own = block >= 0 && block_of(j) == block && random.Chance(0.8);
        if (!own && !(block_of(j) < 0 && random.Chance(0.3)) && block >= 0) continue;
        if (block < 0 && !random.Chance(0.5)) continue;
        m.row.push_back(i);
        m.value.push_back(random.Normal());
      }
      m.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(m.row.size());
    }
    return m;
  };
  ProblemData d;
  d.num_vars = vars;
  d.flags = SY_PROBLEM_CONVEX;
  d.cones = cones;
  d.A = within(b.blocks * b.rows + b.long_rows,
               [&](std::int32_t i) { return i < b.blocks * b.rows ? i / b.rows : -1; });
  std::vector<std::int32_t> of_cone_row;
  for (std::int32_t k = 0; k < b.blocks; ++k) {
    of_cone_row.insert(of_cone_row.end(), static_cast<std::size_t>(cones[k].dim), k);
  }
  d.F = within(testing::ConeRows(cones), [&](std::int32_t i) { return of_cone_row[i]; });
  d.P = b.quadratic
            ? testing::GramMatrix(within(b.blocks * 2, [](std::int32_t i) { return i / 2; }))
            : Csc(vars, vars);
  return OptimumOver(std::move(d), random);
}

}  // namespace switchyard::conic
