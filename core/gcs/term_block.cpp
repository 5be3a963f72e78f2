#include "core/gcs/term_block.hpp"

#include <algorithm>
#include <numeric>

#include "core/gcs/fixed_ends.hpp"
#include "switchyard/boxes.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Where a variable stands among consecutive ones; -1: it does not.
std::int32_t Among(Variable variable, const VectorXDecisionVariable& x) {
  const Variable::Id offset = x.size() > 0 ? variable.get_id() - x[0].get_id() : -1;
  return offset >= 0 && offset < x.size() ? static_cast<std::int32_t>(offset) : -1;
}

constexpr std::uint64_t kBegin = 1469598103934665603ULL;

void Mix(std::uint64_t part, std::uint64_t& hash) {
  hash = (hash ^ part) * 1099511628211ULL;
  hash ^= hash >> 29;
}

// The own variables' boxes at scale 1, hulled with 0.
void BoxOwn(const ScaledSet& set, TermBlock& block) {
  if (set.num_aux == 0) return;
  const Problem at_one(AtScaleOne(set));
  const Boxes boxes = ProvenBoxes(at_one.view());
  for (std::int32_t k = 0; k < set.num_aux; ++k) {
    block.own_lower[At(k)] = std::min(0.0, boxes.lower[At(set.dim + k)]);
    block.own_upper[At(k)] = std::max(0.0, boxes.upper[At(set.dim + k)]);
  }
}

/// Numbers the groups of coordinates that stand together in a row or in a cone.
std::vector<std::int32_t> GroupsOf(const TermBlock& set) {
  std::vector<std::int32_t> parent(At(set.num_places));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while (parent[At(i)] != i) i = parent[At(i)] = parent[At(parent[At(i)])];
    return i;
  };
  const auto join = [&](const PlacedRows& rows, std::int32_t begin, std::int32_t end) {
    std::int32_t first = 0;  // place 0 is the scale, which is in all of them
    for (auto k = At(rows.start[At(begin)]); k < At(rows.start[At(end)]); ++k) {
      const std::int32_t place = rows.place[k];
      if (place == 0 || place >= set.num_places) continue;
      if (first == 0) first = place;
      parent[At(root(place))] = root(first);
    }
  };
  for (std::int32_t i = 0; i < set.rows.count(); ++i) join(set.rows, i, i + 1);
  std::int32_t row = 0;
  for (const sy_cone& cone : set.cones) {
    join(set.cone_rows, row, row + cone.dim);
    row += cone.dim;
  }
  std::vector<std::int32_t> group, number(parent.size(), -1);
  std::int32_t count = 0;
  for (std::int32_t i = 1; i < set.num_places; ++i) {
    std::int32_t& n = number[At(root(i))];
    if (n < 0) n = count++;
    group.push_back(n);
  }
  return group;
}

void AppendRow(const PlacedRows& from, std::int32_t row, PlacedRows& to) {
  for (auto k = At(from.start[At(row)]); k < At(from.start[At(row + 1)]); ++k) {
    to.place.push_back(from.place[k]);
    to.value.push_back(from.value[k]);
  }
  to.start.push_back(static_cast<std::int32_t>(to.place.size()));
}

/// Rows and cones of the scale alone stay with those that are kept.
SplitBlock SplitBy(const TermBlock& set, const std::vector<std::uint8_t>& idle) {
  SplitBlock split;
  split.kept.num_places = split.idle.num_places = set.num_places;
  const auto part_of = [&](const PlacedRows& rows, std::int32_t begin,
                           std::int32_t end) -> TermBlock& {
    for (auto k = At(rows.start[At(begin)]); k < At(rows.start[At(end)]); ++k) {
      if (rows.place[k] > 0) return idle[At(rows.place[k] - 1)] != 0 ? split.idle : split.kept;
    }
    return split.kept;
  };
  for (std::int32_t i = 0; i < set.rows.count(); ++i) {
    TermBlock& part = part_of(set.rows, i, i + 1);
    AppendRow(set.rows, i, part.rows);
    part.lower.push_back(set.lower[At(i)]);
    part.upper.push_back(set.upper[At(i)]);
  }
  std::int32_t row = 0;
  for (const sy_cone& cone : set.cones) {
    TermBlock& part = part_of(set.cone_rows, row, row + cone.dim);
    for (const std::int32_t end = row + cone.dim; row < end; ++row) {
      AppendRow(set.cone_rows, row, part.cone_rows);
    }
    part.cones.push_back(cone);
  }
  split.kept.Finish();
  split.idle.Finish();
  return split;
}

}  // namespace

void PlacedRows::Append(const Csc& by_columns, const std::vector<std::int32_t>& place_of_column) {
  const Csc by_rows = Transpose(by_columns.View());
  for (std::size_t i = 0; i < At(by_rows.cols); ++i) {
    for (auto k = At(by_rows.start[i]); k < At(by_rows.start[i + 1]); ++k) {
      if (by_rows.value[k] == 0) continue;
      place.push_back(place_of_column[At(by_rows.row[k])]);
      value.push_back(by_rows.value[k]);
    }
    start.push_back(static_cast<std::int32_t>(place.size()));
  }
}

void TermBlock::Add(const Perspective& term, const std::vector<std::int32_t>& places) {
  const ScaledSet& cone = term.cone;
  std::vector<std::int32_t> place_of = {0};
  place_of.insert(place_of.end(), places.begin(), places.end());
  if (term.S.rows > 0) squares.Append(term.S, places);
  for (std::int32_t k = 0; k < cone.num_aux; ++k) place_of.push_back(num_places + num_own++);
  own_lower.resize(At(num_own), -kInfinity);
  own_upper.resize(At(num_own), kInfinity);
  if (cone.A.rows > 0) {
    rows.Append(cone.A, place_of);
    lower.insert(lower.end(), cone.lower.begin(), cone.lower.end());
    upper.insert(upper.end(), cone.upper.begin(), cone.upper.end());
  }
  if (!cone.cones.empty()) {
    cone_rows.Append(cone.F, place_of);
    cones.insert(cones.end(), cone.cones.begin(), cone.cones.end());
  }
  for (std::size_t j = 0; j < term.cost.size(); ++j) {
    if (term.cost[j] == 0) continue;
    cost.resize(At(num_places + num_own), 0.0);
    cost[At(place_of[j])] += term.cost[j];
  }
}

void TermBlock::Finish() {
  uses.assign(At(num_places + num_own), 0);
  for (const PlacedRows* part : {&rows, &cone_rows, &squares}) {
    for (const std::int32_t place : part->place) uses[At(place)] = 1;
  }
  for (std::size_t j = 0; j < cost.size(); ++j) {
    if (cost[j] != 0) uses[j] = 1;
  }
}

std::size_t TermBlocks::Hash::operator()(const Key& key) const {
  std::uint64_t hash = kBegin;
  for (const std::uint64_t part : key) Mix(part, hash);
  return hash;
}

const TermBlocks::OfSet& TermBlocks::Membership(const Vertex& v) {
  const auto [place, fresh] = of_set_.try_emplace(&v.set());
  TermBlock& block = place->second.block;
  if (!fresh) return place->second;
  place->second.set = v.shared_set();
  const ScaledSet& scaled = v.set().scaled();
  std::vector<std::int32_t> places;
  for (std::int32_t i = 0; i < scaled.dim; ++i) places.push_back(1 + i);
  block.num_places = 1 + scaled.dim;
  block.Add({scaled, {}, {}}, places);
  BoxOwn(scaled, block);
  block.Finish();
  place->second.group = GroupsOf(block);
  return place->second;
}

const SplitBlock& TermBlocks::Split(const Vertex& v, const std::vector<std::uint8_t>& idle) {
  const auto [place, fresh] = split_.try_emplace({&v.set(), idle});
  if (fresh) place->second = SplitBy(Membership(v).block, idle);
  return place->second;
}

// The key says all that the block follows from: evaluators, at their version, and places.
template <class List, class PlaceOf>
void TermBlocks::ReadTerms(const List& terms, PlaceOf&& place_of) {
  for (const auto& term : terms) {
    if (!term.in.contains(as_)) continue;
    const auto& evaluator = term.binding.evaluator();
    key_.push_back(reinterpret_cast<std::uintptr_t>(evaluator.get()));
    key_.push_back(evaluator->version());
    for (const Variable v : term.binding.variables()) {
      key_.push_back(static_cast<std::uint64_t>(place_of(v)));
    }
  }
}

const Perspective& TermBlocks::PerspectiveOf(const std::string& owner, const auto& binding) {
  try {
    return perspectives_.Of(binding.evaluator());
  } catch (const InvalidArgument& why) {
    Refuse("at ", owner, ": ", why.what(), "; a term for the restriction alone may be any");
  }
}

template <class Owner, class PlaceOf>
const TermBlock& TermBlocks::Find(const Owner& owner, bool costs, std::int32_t num_places,
                                  PlaceOf&& place_of) {
  key_.assign(1, static_cast<std::uint64_t>(num_places));
  if (costs) ReadTerms(owner.costs(), place_of);
  ReadTerms(owner.constraints(), place_of);
  const auto found = of_terms_.find(key_);
  if (found != of_terms_.end()) return *found->second;
  auto block = std::make_unique<TermBlock>();
  block->num_places = num_places;
  const auto add = [&](const auto& terms) {
    for (const auto& term : terms) {
      if (!term.in.contains(as_)) continue;
      std::vector<std::int32_t> places;
      for (const Variable v : term.binding.variables()) places.push_back(place_of(v));
      block->Add(PerspectiveOf(owner.name(), term.binding), places);
    }
  };
  if (costs) add(owner.costs());
  add(owner.constraints());
  block->Finish();
  return *of_terms_.emplace(key_, std::move(block)).first->second;
}

const TermBlock& TermBlocks::Terms(const Vertex& v, bool costs) {
  return Find(v, costs, 1 + v.ambient_dimension(), [&](Variable x) { return 1 + Among(x, v.x()); });
}

const TermBlock& TermBlocks::Terms(const Edge& e) {
  const std::int32_t of_u = e.u().ambient_dimension(), of_v = e.v().ambient_dimension();
  const auto place_of = [&](Variable x) -> std::int32_t {
    if (const std::int32_t i = Among(x, e.xu()); i >= 0) return 1 + i;
    if (const std::int32_t i = Among(x, e.xv()); i >= 0) return 1 + of_u + i;
    const auto slack = std::find(e.slacks().begin(), e.slacks().end(), x);
    return 1 + of_u + of_v + static_cast<std::int32_t>(slack - e.slacks().begin());
  };
  return Find(e, true, 1 + of_u + of_v + static_cast<std::int32_t>(e.slacks().size()), place_of);
}

const std::vector<FixedCoordinate>& TermBlocks::Fixed(const Edge& e, bool ends) {
  const std::int32_t of_u = e.u().ambient_dimension();
  const VertexBlocks u = Of(e.u()), v = Of(e.v());
  const TermBlock& terms = *of_edge_[At(e.id().value)].terms;
  std::vector<PlacedBlock> blocks = {{&terms, 0}, {u.terms, 0}, {u.set, 0}, {v.set, of_u}};
  if (ends) blocks.push_back({v.terms, of_u});
  key_.clear();
  for (const PlacedBlock& b : blocks) {
    key_.push_back(reinterpret_cast<std::uintptr_t>(b.block));
  }
  const auto [place, fresh] = fixed_.try_emplace(key_);
  if (fresh && terms.rows.count() + u.terms->rows.count() > 0) {
    place->second = FixedEnds(e.u().set().bounding_box(), e.v().set().bounding_box(), blocks);
  }
  return place->second;
}

template <class List>
bool TermBlocks::Stamp(const List& terms, std::uint64_t& stamp) const {
  bool same = true;
  for (const auto& term : terms) {
    const bool here = term.in.contains(as_);
    same &= here == term.in.contains(GraphOfConvexSets::Transcription::kRestriction);
    if (!here) continue;
    const auto& evaluator = term.binding.evaluator();
    Mix(reinterpret_cast<std::uintptr_t>(evaluator.get()), stamp);
    Mix(evaluator->version(), stamp);
  }
  return same;
}

const VertexBlocks& TermBlocks::Of(const Vertex& v) {
  const std::size_t at = At(v.id().value);
  if (at >= of_vertex_.size()) of_vertex_.resize(at + at / 2 + 1);
  std::uint64_t stamp = kBegin;
  const bool same_costs = Stamp(v.costs(), stamp), same_rows = Stamp(v.constraints(), stamp);
  VertexBlocks& blocks = of_vertex_[at];
  blocks.same = same_costs && same_rows;
  if (blocks.stamp == stamp) return blocks;
  const SetBox& box = v.set().bounding_box();
  const bool open = !box.empty && !box.is_finite() && !v.constraints().empty();
  const OfSet& of_set = Membership(v);
  const bool grouped = box.is_finite() && of_set.block.num_own == 0;
  return blocks = {&of_set.block,
                   &Terms(v, true),
                   open ? &Terms(v, false) : nullptr,
                   grouped ? &of_set.group : nullptr,
                   stamp,
                   blocks.same};
}

const EdgeBlocks& TermBlocks::Of(const Edge& e, bool ends) {
  const std::uint64_t of_u = Of(e.u()).stamp, of_v = Of(e.v()).stamp;
  return Of(e, ends, of_u, of_v);
}

const EdgeBlocks& TermBlocks::Of(const Edge& e, bool ends, std::uint64_t stamp_of_u,
                                 std::uint64_t stamp_of_v) {
  const std::size_t at = At(e.id().value);
  if (at >= of_edge_.size()) of_edge_.resize(at + at / 2 + 1);
  std::uint64_t stamp = kBegin;
  const bool same_costs = Stamp(e.costs(), stamp), same_rows = Stamp(e.constraints(), stamp);
  Mix(static_cast<std::uint64_t>(e.slacks().size()), stamp);
  Mix(stamp_of_u, stamp);
  Mix(stamp_of_v, stamp);
  if (of_edge_[at].stamp != stamp) of_edge_[at] = {&Terms(e), {nullptr, nullptr}, stamp, true};
  of_edge_[at].same = same_costs && same_rows;
  if (of_edge_[at].fixed[ends ? 1 : 0] == nullptr) {
    of_edge_[at].fixed[ends ? 1 : 0] = &Fixed(e, ends);
  }
  return of_edge_[at];
}

}  // namespace switchyard
