// core/gcs/term_block.hpp - what a vertex or an edge asks for, over places that are filled in
// later.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/gcs/perspective.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {

/// Rows whose entries are a place and a value.
struct PlacedRows {
  std::vector<std::int32_t> start = {0};
  std::vector<std::int32_t> place;
  std::vector<double> value;

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(start.size()) - 1; }
  /// The rows of a matrix, column j at place[j].
  void Append(const Csc& by_columns, const std::vector<std::int32_t>& place_of_column);
};

/// A coordinate of an edge's (x_u, x_v) that has but one value.
struct FixedCoordinate {
  std::int32_t place;  // from 0
  double value;
};

/// A cone of (t, x, w) and costs on it: place 0 is t, then come the coordinates of one or two
/// points and slacks, each times t, and from num_places on the block's own w.
///
///   rows and cones over (t, x, w);  cost'(t, x, w) + |squares (t, x)|^2 / (2 t)
struct TermBlock {
  std::int32_t num_places = 1;
  std::int32_t num_own = 0;
  PlacedRows rows;
  std::vector<double> lower, upper;  // 0 or infinite
  PlacedRows cone_rows;
  std::vector<sy_cone> cones;
  PlacedRows squares;
  std::vector<double> cost;                  // by place, own ones too; or empty
  std::vector<double> own_lower, own_upper;  // proven at scales in [0, 1]
  std::vector<std::uint8_t> uses;            // by place: does any of these hold it?

  /// Places the perspective's x at `places`, its t at 0, its w behind all others.
  void Add(const Perspective& term, const std::vector<std::int32_t>& places);
  /// All is added.
  void Finish();
};

/// A set's cone in two: over some coordinates, and over the others.
struct SplitBlock {
  TermBlock kept, idle;
};

/// What a vertex asks for: places t, x.
struct VertexBlocks {
  const TermBlock* set = nullptr;    // x in tX
  const TermBlock* terms = nullptr;  // costs and constraints
  /// The latter alone, where without them the set is not known to be bounded; else null.
  const TermBlock* constraints = nullptr;
  /// Of a set without variables of its own that is known to be bounded, by coordinate: those of one
  /// number, from 0 on, are not told apart by its rows and cones. Else null.
  const std::vector<std::int32_t>* group = nullptr;
  std::uint64_t stamp = 0;  // of all that these follow from
  bool same = true;         // are its terms those of the restriction?
};

/// What an edge asks for: places t, x_u, x_v, slacks.
struct EdgeBlocks {
  const TermBlock* terms = nullptr;
  /// Coordinates that its rows and its tail's leave one value, ascending; and with its head's rows,
  /// where the path ends there.
  const std::vector<FixedCoordinate>* fixed[2] = {nullptr, nullptr};
  std::uint64_t stamp = 0;
  bool same = true;
};

/// The blocks of one transcription of a graph: written once for all that have the same terms, and
/// found again by a stamp of evaluators and their versions.
class TermBlocks {
 public:
  using Vertex = GraphOfConvexSets::Vertex;
  using Edge = GraphOfConvexSets::Edge;

  explicit TermBlocks(GraphOfConvexSets::Transcription as) : as_(as) {}

  /// They throw InvalidArgument, naming it, for a term that has no perspective. What is returned
  /// stays in place until the next call.
  const VertexBlocks& Of(const Vertex& v);
  const EdgeBlocks& Of(const Edge& e, bool ends);
  /// Where its vertices' are known.
  const EdgeBlocks& Of(const Edge& e, bool ends, std::uint64_t stamp_of_u,
                       std::uint64_t stamp_of_v);
  /// The cone of a vertex's set by coordinates that are idle, of whole groups.
  const SplitBlock& Split(const Vertex& v, const std::vector<std::uint8_t>& idle);

 private:
  using Key = std::vector<std::uint64_t>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  /// A set's cone; kept as long as the set is, so that its address means it.
  struct OfSet {
    std::shared_ptr<const ConvexSet> set;
    TermBlock block;
    std::vector<std::int32_t> group;
  };

  const OfSet& Membership(const Vertex& v);
  const TermBlock& Terms(const Vertex& v, bool costs);
  const TermBlock& Terms(const Edge& e);
  const std::vector<FixedCoordinate>& Fixed(const Edge& e, bool ends);
  /// Says, too, whether each term is in this transcription and in the restriction, or in neither.
  template <class List>
  [[nodiscard]] bool Stamp(const List& terms, std::uint64_t& stamp) const;
  template <class Owner, class PlaceOf>
  const TermBlock& Find(const Owner& owner, bool costs, std::int32_t num_places,
                        PlaceOf&& place_of);
  template <class List, class PlaceOf>
  void ReadTerms(const List& terms, PlaceOf&& place_of);
  const Perspective& PerspectiveOf(const std::string& owner, const auto& binding);

  GraphOfConvexSets::Transcription as_;
  Perspectives perspectives_;
  std::unordered_map<const ConvexSet*, OfSet> of_set_;
  std::unordered_map<Key, std::unique_ptr<TermBlock>, Hash> of_terms_;
  std::unordered_map<Key, std::vector<FixedCoordinate>, Hash> fixed_;
  std::map<std::pair<const ConvexSet*, std::vector<std::uint8_t>>, SplitBlock> split_;
  Key key_;                              // of the owner at hand
  std::vector<VertexBlocks> of_vertex_;  // by id
  std::vector<EdgeBlocks> of_edge_;
};

}  // namespace switchyard
