// core/gcs/set_records.hpp - sets as the paths hint says them.
#pragma once

#include <deque>
#include <unordered_map>

#include "switchyard/hints.h"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// One record for each set, which must outlive it.
class SetRecords {
 public:
  /// Stays in place as long as this.
  const sy_set* Of(const ConvexSet& set);

 private:
  struct Record {
    Csc At, Ft;
    sy_csc at, ft;
    sy_set record;
  };

  std::deque<Record> records_;
  std::unordered_map<const ConvexSet*, const sy_set*> of_;
};

}  // namespace switchyard
