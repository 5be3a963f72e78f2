// core/io/gcs_sets.hpp - the sets of gcs/1, there and back.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/io/program_json.hpp"
#include "switchyard/sets/convex_set.hpp"

namespace switchyard::io {

/// The constraint that a name of the file stands for.
using ConstraintOf = std::function<std::shared_ptr<Constraint>(JsonValue name)>;
std::shared_ptr<const ConvexSet> ReadSet(JsonValue entry, EntrySource* source,
                                         const ConstraintOf& constraint_of);

/// The name that a constraint has in the file.
using NameOf = std::function<std::string(const std::shared_ptr<const Constraint>& constraint)>;
void AppendSet(const ConvexSet& set, const NameOf& name_of, EntrySink* sink);
/// Why no file holds it, as what it or one of its elements is; empty where files do.
std::string WhyNoEntry(const ConvexSet& set);

}  // namespace switchyard::io
