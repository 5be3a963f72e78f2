// core/gcs/term_tags.hpp - what a transcription says of paths, by the tags of terms.
#pragma once

#include "core/gcs/pruning.hpp"

namespace switchyard {

struct TermTags {
  /// Restrictions have the same terms.
  bool same = true;
  /// It has no term that restrictions lack: where it has no point, no path has one.
  bool relaxes = true;
  /// Nor do restrictions have costs that it lacks and that may be negative: what bounds it from
  /// below bounds paths.
  bool bounds = true;
};

TermTags TagsOf(const PrunedGraph& graph, GraphOfConvexSets::Transcription as);

}  // namespace switchyard
