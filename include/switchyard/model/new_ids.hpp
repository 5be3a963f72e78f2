// switchyard/model/new_ids.hpp - ids for variables that live outside a program.
#pragma once

#include "switchyard/export.hpp"
#include "switchyard/symbolic/variable.hpp"

namespace switchyard {

/// The first of `count` consecutive ids that no variable has. Any thread.
SWITCHYARD_EXPORT Variable::Id NewVariableIds(std::int64_t count);

}  // namespace switchyard
