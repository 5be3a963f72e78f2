#include "solvers/mip/propagation.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace switchyard::mip {
namespace {

using namespace boxes_detail;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Is a cone of this kind a product of half-lines or points, each a matter of one row?
bool IsLinear(sy_cone_kind kind) { return kind == SY_CONE_ZERO || kind == SY_CONE_NONNEGATIVE; }

/// visit(column) for each entry of a row by rows.
template <class Visit>
void EachColumn(const Csc& by_rows, std::int32_t i, Visit&& visit) {
  const Row row = RowOf(by_rows, i);
  for (std::int32_t k = 0; k < row.count; ++k) visit(row.column[k]);
}

}  // namespace

/// One call of Propagate: boxes in the sense of box_narrowing.hpp, which queue what a narrowing
/// concerns.
class Narrowing {
 public:
  Narrowing(const Propagator& propagator, NodeBoxes& boxes, Workspace& work, double cutoff)
      : p_(propagator), boxes_(boxes), work_(work), cutoff_(p_.use_cutoff_ ? cutoff : kInfinity) {}

  bool Run() {
    const std::int64_t limit = work_.work_ + Propagator::kPasses * p_.num_entries_;
    QueueWhatIsNew();
    while (!empty_ && work_.work_ <= limit && Next()) Look();
    EmptyQueues();
    if (empty_) return false;
    NodeBoxes::Mark& now = boxes_.now_;
    now.num_propagated = now.num_changes;
    now.cutoff = cutoff_;
    now.fresh = false;
    return true;
  }

  [[nodiscard]] double lower(std::int32_t j) const { return boxes_.lower(j); }
  [[nodiscard]] double upper(std::int32_t j) const { return boxes_.upper(j); }
  [[nodiscard]] bool infeasible() const { return empty_; }
  void Demand(double lhs, double side) {
    if (IsWrong(lhs, side)) SayEmpty();
  }
  void Cut(std::int32_t j, double v) {
    if (v < upper(j)) Took(j, boxes_.Cut(j, v), false);
  }
  void Raise(std::int32_t j, double v) {
    if (v > lower(j)) Took(j, boxes_.Raise(j, v), true);
  }

 private:
  void SayEmpty() {
    empty_ = true;
    boxes_.SayEmpty(p_.Of(at_));
  }

  void Took(std::int32_t j, NodeBoxes::Narrowed narrowed, bool raised) {
    if (narrowed == NodeBoxes::Narrowed::kEmpty) SayEmpty();
    if (narrowed == NodeBoxes::Narrowed::kRelevantly) QueueAround(j, raised, !raised);
  }

  void QueueWhatIsNew() {
    const NodeBoxes::Mark& now = boxes_.now_;
    at_ = -1;
    if (now.fresh) {
      for (std::int32_t c = 0; c <= p_.objective(); ++c) Queue(c);
      return;
    }
    for (std::size_t k = now.num_propagated; k < now.num_changes; ++k) {
      const VariableBox& old = boxes_.trail_[k];
      const std::int32_t j = old.variable;
      QueueAround(j, old.lower != lower(j), old.upper != upper(j));
    }
    if (cutoff_ < now.cutoff) Queue(p_.objective());
  }

  /// Queues the constraints that moved ends of x_j concern. A row of continuous variables leaves of
  /// a box its exact hull: it has nothing more to say after its own narrowing.
  void QueueAround(std::int32_t j, bool raised, bool cut) {
    const std::int32_t but = boxes_.IsInteger(j) || at_ >= p_.first_cone() ? -1 : at_;
    const auto end = At(p_.watch_start_[At(j) + 1]);
    for (auto k = At(p_.watch_start_[At(j)]); k < end; ++k) {
      const Propagator::Watch& watch = p_.watch_[k];
      if (!(raised && watch.on_raise) && !(cut && watch.on_cut)) continue;
      if (watch.constraint != but) Queue(watch.constraint);
    }
  }

  void Queue(std::int32_t constraint) {
    std::uint8_t& queued = work_.is_queued_[At(constraint)];
    if (queued != 0) return;
    queued = 1;
    if (constraint == p_.objective()) return;
    const bool is_cone = constraint >= p_.first_cone() && constraint < p_.first_group();
    (is_cone ? work_.cones_ : work_.cheap_).Push(constraint);
  }

  /// Takes the next constraint from the queues; false: there is none.
  bool Next() {
    if (!work_.cheap_.empty()) {
      at_ = work_.cheap_.Pop();
    } else if (!work_.cones_.empty()) {
      at_ = work_.cones_.Pop();
    } else {
      at_ = p_.objective();
    }
    return std::exchange(work_.is_queued_[At(at_)], std::uint8_t{0}) != 0;
  }

  void EmptyQueues() {
    while (Next()) continue;
  }

  void Look() {
    if (at_ < p_.first_cone()) {
      LookAtRow();
    } else if (at_ < p_.first_group()) {
      LookAtCone(p_.cones_[At(at_ - p_.first_cone())]);
    } else if (at_ < p_.objective()) {
      LookAtGroup(p_.groups_.Of(at_ - p_.first_group()));
    } else if (cutoff_ < kInfinity) {
      work_.work_ += static_cast<std::int64_t>(p_.terms_.size());
      NarrowByTerms(p_.terms_, p_.offset_, cutoff_, work_.least_, *this);
    }
  }

  void LookAtRow() {
    const Row row = RowOf(p_.linear_, at_);
    work_.work_ += row.count;
    NarrowByRow(row, 1, p_.side_upper_[At(at_)], *this);
    if (!empty_) NarrowByRow(row, -1, -p_.side_lower_[At(at_)], *this);
  }

  void LookAtCone(const Propagator::ConeRows& rows) {
    const auto first = At(rows.first_row);
    work_.work_ += p_.f_.start[first + At(rows.cone.dim)] - p_.f_.start[first];
    NarrowByCone(rows.cone, p_.f_, p_.g_.data(), rows.first_row, work_.ranges_, *this);
  }

  /// Where one of the group is not 0, by more than rounding, all others are.
  void LookAtGroup(std::span<const std::int32_t> group) {
    work_.work_ += static_cast<std::int64_t>(group.size());
    std::int32_t chosen = -1;
    for (const std::int32_t j : group) {
      if (j == chosen || (lower(j) <= kCrossing && upper(j) >= -kCrossing)) continue;
      if (chosen >= 0) return SayEmpty();
      chosen = j;
    }
    if (chosen < 0) return;
    for (const std::int32_t j : group) {
      if (j == chosen) continue;
      Cut(j, 0);
      Raise(j, 0);
    }
  }

  const Propagator& p_;
  NodeBoxes& boxes_;
  Workspace& work_;
  const double cutoff_;
  std::int32_t at_ = -1;  // the constraint at hand
  bool empty_ = false;
};

Workspace::Workspace(const Propagator& propagator)
    : is_queued_(At(propagator.objective()) + 1),
      cheap_(At(propagator.first_cone() + propagator.groups_.size())),
      cones_(propagator.cones_.size()) {}

Propagator::Propagator(const sy_problem& problem, std::span<const std::int32_t> also_integer)
    : num_vars_(problem.num_vars),
      num_rows_(problem.num_rows),
      groups_(problem),
      terms_(NonzeroTerms(Underestimate(problem))),
      offset_(problem.offset),
      use_cutoff_(problem.nlp == nullptr) {
  TakeBounds(problem);
  for (const std::int32_t j : also_integer) integer_[At(j)] = 1;
  TakeLinear(problem);
  std::int32_t first = 0;
  for (std::int32_t c = 0; c < problem.num_cones; first += problem.cones[c++].dim) {
    if (!IsLinear(problem.cones[c].kind)) cones_.push_back({problem.cones[c], c, first});
  }
  WatchAll();
}

void Propagator::TakeBounds(const sy_problem& problem) {
  const auto take = [](const double* from, std::int32_t count, double none) {
    return from != nullptr ? std::vector<double>(from, from + count)
                           : std::vector<double>(At(count), none);
  };
  x_lower_ = take(problem.x_lower, num_vars_, -kInfinity);
  x_upper_ = take(problem.x_upper, num_vars_, kInfinity);
  side_lower_ = take(problem.row_lower, num_rows_, -kInfinity);
  side_upper_ = take(problem.row_upper, num_rows_, kInfinity);
  g_ = take(problem.g, problem.num_cone_rows, 0.0);
  integer_.assign(At(num_vars_), 0);
  if (problem.integer != nullptr) {
    integer_.assign(problem.integer, problem.integer + num_vars_);
  }
}

/// A row r of a zero or nonnegative cone is -g <= r'x, and an equality in the former.
void Propagator::TakeLinear(const sy_problem& problem) {
  const Csc a = problem.A != nullptr ? Csc(*problem.A) : Csc(num_rows_, num_vars_);
  const Csc f = problem.F != nullptr ? Csc(*problem.F) : Csc(problem.num_cone_rows, num_vars_);
  std::vector<std::uint8_t> is_linear(At(problem.num_cone_rows), 0);
  std::int32_t row = 0;
  for (std::int32_t c = 0; c < problem.num_cones; ++c) {
    const sy_cone& cone = problem.cones[c];
    for (const std::int32_t end = row + cone.dim; row < end; ++row) {
      if (!IsLinear(cone.kind)) continue;
      is_linear[At(row)] = 1;
      side_lower_.push_back(-g_[At(row)]);
      side_upper_.push_back(cone.kind == SY_CONE_ZERO ? -g_[At(row)] : kInfinity);
      cone_of_row_.push_back(c);
    }
  }
  linear_ = Transpose(StackRows(a, KeepRows(f, is_linear)).View());
  f_ = Transpose(f.View());
}

/// visit(variable, watch) in the order of the constraints, none twice.
template <class Visit>
void Propagator::EachWatch(Visit&& visit) const {
  for (std::int32_t i = 0; i < linear_.cols; ++i) {
    const Row row = RowOf(linear_, i);
    const bool above = std::isfinite(side_upper_[At(i)]), below = std::isfinite(side_lower_[At(i)]);
    for (std::int32_t k = 0; k < row.count; ++k) {
      const double a = row.value[k];
      const Watch watch{i, (a > 0 && above) || (a < 0 && below),
                        (a > 0 && below) || (a < 0 && above)};
      if (watch.on_raise || watch.on_cut) visit(row.column[k], watch);
    }
  }
  std::vector<std::int32_t> last(At(num_vars_), -1);  // constraint of each variable
  const auto visit_once = [&](std::int32_t j, std::int32_t constraint) {
    if (std::exchange(last[At(j)], constraint) != constraint)
      visit(j, Watch{constraint, true, true});
  };
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    const std::int32_t first = cones_[c].first_row;
    for (std::int32_t i = first; i < first + cones_[c].cone.dim; ++i) {
      EachColumn(f_, i, [&](std::int32_t j) {
        visit_once(j, first_cone() + static_cast<std::int32_t>(c));
      });
    }
  }
  for (std::int32_t g = 0; g < groups_.size(); ++g) {
    for (const std::int32_t j : groups_.Of(g)) visit_once(j, first_group() + g);
  }
  for (const Term& term : terms_) {
    const Parabola& of = term.of;
    visit(term.variable, Watch{objective(), of.d != 0 || of.c > 0, of.d != 0 || of.c < 0});
  }
}

void Propagator::WatchAll() {
  watch_start_.assign(At(num_vars_) + 1, 0);
  EachWatch([this](std::int32_t j, const Watch&) { ++watch_start_[At(j) + 1]; });
  std::partial_sum(watch_start_.begin(), watch_start_.end(), watch_start_.begin());
  watch_.resize(At(watch_start_.back()));
  std::vector<std::int32_t> next(watch_start_.begin(), watch_start_.end() - 1);
  EachWatch([&](std::int32_t j, const Watch& watch) { watch_[At(next[At(j)]++)] = watch; });
  num_entries_ = linear_.nonzeros() + f_.nonzeros() + static_cast<std::int64_t>(terms_.size());
  for (std::int32_t g = 0; g < groups_.size(); ++g) {
    num_entries_ += static_cast<std::int64_t>(groups_.Of(g).size());
  }
}

Contradiction Propagator::Of(std::int32_t constraint) const {
  using Source = Contradiction::Source;
  if (constraint < num_rows_) return {Source::kRow, constraint};
  if (constraint < first_cone()) return {Source::kCone, cone_of_row_[At(constraint - num_rows_)]};
  if (constraint < first_group()) {
    return {Source::kCone, cones_[At(constraint - first_cone())].index};
  }
  if (constraint < objective()) return {Source::kGroup, constraint - first_group()};
  return {Source::kCutoff, -1};
}

NodeBoxes Propagator::Bounds() const {
  NodeBoxes boxes(std::vector<double>(At(num_vars_), -kInfinity),
                  std::vector<double>(At(num_vars_), kInfinity), integer_.data());
  for (std::int32_t j = 0; j < num_vars_; ++j) boxes.Impose(j, x_lower_[At(j)], x_upper_[At(j)]);
  boxes.Commit();
  return boxes;
}

bool Propagator::Propagate(NodeBoxes& boxes, Workspace& workspace, double cutoff) const {
  return !boxes.contradiction() && Narrowing(*this, boxes, workspace, cutoff).Run();
}

std::int32_t Propagator::NumConstraintsOf(std::int32_t j) const {
  return watch_start_[At(j) + 1] - watch_start_[At(j)];
}

}  // namespace switchyard::mip
