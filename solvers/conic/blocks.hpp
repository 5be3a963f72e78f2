// solvers/conic/blocks.hpp - variables that meet each other and, but for equations and a few long
// rows, nobody else.
#pragma once

#include <vector>

#include "solvers/conic/form.hpp"

namespace switchyard::conic {

/// A bordered block-diagonal shape of P and of what is condensed: a block's variables are first
/// eliminated by themselves, then the rows that join blocks.
struct Blocks {
  Index count = 0;
  std::vector<Index> of_variable;  // -1: of none
  std::vector<Index> of_row;       // of A; -1: it joins blocks, or has a variable of none
  [[nodiscard]] bool empty() const { return count == 0; }
};

/// As the caller says (a block for each of the form's variables, -1: couples), but that what meets
/// in P or in a cone is one block.
Blocks GivenBlocks(const Form& form, const std::vector<Index>& of_variable);

/// Variables belong together that meet in P, in a cone, in inequalities over the very same
/// variables, and in short ones as long as that makes small blocks. None where much of the problem
/// is in none.
Blocks FindBlocks(const Form& form);

}  // namespace switchyard::conic
