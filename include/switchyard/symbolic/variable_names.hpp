// switchyard/symbolic/variable_names.hpp - what texts call a variable.
#pragma once

#include <memory>
#include <string>

#include "switchyard/export.hpp"
#include "switchyard/symbolic/name_table.hpp"
#include "switchyard/symbolic/variable.hpp"

namespace switchyard {

/// The name that the variable has in the program that made it, as long as that program or a clone
/// of it lives; else "v17", by its id. Any thread.
SWITCHYARD_EXPORT std::string NameOf(Variable variable);

/// Makes the names of a block known as those of the variables with the ids first, first + 1, ...,
/// that no block has named yet. Keeps no block alive. Any thread.
SWITCHYARD_EXPORT void RegisterNames(Variable::Id first,
                                     const std::shared_ptr<const NameBlock>& names);

}  // namespace switchyard
