#include "solvers/linalg/multifrontal_ldl.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace switchyard::linalg {
namespace {

std::int64_t UpdateSize(const Supernode& node) {
  return std::int64_t{node.rows} * RoundUp(node.rows);
}

std::int64_t FrontSize(const Supernode& node) {
  return std::int64_t{node.pivots} * (RoundUp(node.pivots) + RoundUp(node.rows));
}

}  // namespace

MultifrontalLdl::MultifrontalLdl(const Elimination& elimination,
                                 const std::vector<std::int8_t>& sign, Digits digits)
    : tree_(FindSupernodes(elimination)),
      subtrees_(FindSubtrees(tree_, static_cast<Index>(elimination.order.size()))),
      digits_(digits),
      parts_(PartsOf(digits)) {
  const std::size_t n = elimination.order.size();
  sign_.reserve(n);
  for (const Index j : elimination.order) sign_.push_back(sign[j]);
  pivot_.resize(n * parts_);
  inverse_pivot_.resize(n * parts_);
  size_.resize(static_cast<std::size_t>(subtrees_.room));
  PlanStorage();
}

void MultifrontalLdl::PlanStorage() {
  std::int64_t size = 0;
  for (const Supernode& node : tree_.nodes) {
    front_start_.push_back(size * parts_);
    size += FrontSize(node);
  }
  fronts_.resize(size * parts_);
  rooms_.resize(subtrees_.parts.size() + 1);
  for (std::size_t p = 0; p < subtrees_.parts.size(); ++p) {
    std::vector<std::size_t> nodes(subtrees_.parts[p].end - subtrees_.parts[p].begin);
    std::iota(nodes.begin(), nodes.end(), subtrees_.parts[p].begin);
    PlanRoom(nodes, rooms_[p]);
  }
  PlanRoom(subtrees_.top, rooms_.back());
}

// The stack holds what the children left, and above it what their parent is about to leave.
void MultifrontalLdl::PlanRoom(const std::vector<std::size_t>& nodes, Room& room) const {
  std::int64_t top = 0, peak = 0;
  Index most_rows = 0, most_pivots = 0;
  std::vector<std::size_t> stack;
  for (const std::size_t s : nodes) {
    const Supernode& node = tree_.nodes[s];
    peak = std::max(peak, top + UpdateSize(node));
    while (!stack.empty() && tree_.nodes[stack.back()].parent == static_cast<Index>(s)) {
      top -= UpdateSize(tree_.nodes[stack.back()]);
      stack.pop_back();
    }
    stack.push_back(s);
    top += UpdateSize(node);
    most_rows = std::max(most_rows, node.rows);
    most_pivots = std::max(most_pivots, node.pivots);
  }
  room.stack.resize(peak * parts_);
  room.work.resize(kWorkPerPivot * most_pivots);
  room.column.resize(RoundUp(most_rows) * parts_);
  room.own.resize(RoundUp(most_pivots) * parts_);
}

Front MultifrontalLdl::FrontOf(std::size_t s) const {
  const Supernode& node = tree_.nodes[s];
  Front front;
  front.digits = digits_;
  front.pivots = node.pivots;
  front.rows = node.rows;
  front.top_stride = RoundUp(node.pivots);
  front.below_stride = RoundUp(node.rows);
  front.top = const_cast<double*>(fronts_.data()) + front_start_[s];
  front.below = front.top + front.pivots * front.top_stride * parts_;
  return front;
}

void MultifrontalLdl::Gather(std::size_t s, const Front& front, const Numbers& values) {
  const Supernode& node = tree_.nodes[s];
  std::fill_n(front.top, FrontSize(node) * parts_, 0.0);
  const std::int64_t end = s + 1 < tree_.nodes.size()
                               ? tree_.nodes[s + 1].entry_start
                               : static_cast<std::int64_t>(tree_.entry.size());
  for (std::int64_t e = node.entry_start; e < end; ++e) {
    const FrontEntry& at = tree_.entry[e];
    const bool of_top = at.row < front.pivots;
    double* column = of_top ? front.top + at.column * front.top_stride * parts_
                            : front.below + at.column * front.below_stride * parts_;
    const Index row = of_top ? at.row : at.row - front.pivots;
    if (digits_ == Digits::kPlain) {
      column[row] = values.high[at.entry];
    } else if (at.row == at.column && std::isinf(values.high[at.entry])) {
      size_[node.first + at.column] = HUGE_VAL;  // see PivotRule::AcceptTwofold
    } else {
      double* place = column + row / kLanes * 2 * kLanes + row % kLanes;
      place[0] = values.high[at.entry];
      place[kLanes] = values.low[at.entry];
    }
  }
}

/// Adds what a child left to the front and to what the front will leave.
void MultifrontalLdl::AddChild(const Supernode& child, const double* left, const Front& front,
                               double* update) const {
  const Index* place = tree_.in_parent.data() + child.row_start;
  Index of_pivots = 0;  // the child's rows that are pivots here
  while (of_pivots < child.rows && place[of_pivots] < front.pivots) ++of_pivots;
  const Index stride = RoundUp(child.rows);
  for (Index j = 0; j < child.rows; ++j, left += stride * parts_) {
    if (j < of_pivots) {
      AddColumn(digits_, left, {j, of_pivots}, place, 0,
                front.top + place[j] * front.top_stride * parts_);
      AddColumn(digits_, left, {of_pivots, child.rows}, place, front.pivots,
                front.below + place[j] * front.below_stride * parts_);
    } else {
      AddColumn(digits_, left, {j, child.rows}, place, front.pivots,
                update + (place[j] - front.pivots) * front.below_stride * parts_);
    }
  }
}

int MultifrontalLdl::Factor(const Numbers& values, const PivotRule& rule, Workers* workers) {
  std::fill(size_.begin(), size_.end(), 0.0);
  std::vector<int> raised(subtrees_.parts.size(), 0);
  EachPart(workers, subtrees_.parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      Room& room = rooms_[p];
      room.top = 0;
      room.left.clear();
      for (std::size_t s = subtrees_.parts[p].begin; s < subtrees_.parts[p].end; ++s) {
        raised[p] += Eliminate(s, values, rule, room);
      }
    }
  });
  AddPlaces({size_.data(), nullptr});
  return std::accumulate(raised.begin(), raised.end(), EliminateTop(values, rule));
}

int MultifrontalLdl::EliminateTop(const Numbers& values, const PivotRule& rule) {
  Room& room = rooms_.back();
  room.top = 0;
  room.left.clear();
  int raised = 0;
  std::size_t part = 0;
  for (const std::size_t s : subtrees_.top) {
    for (; part < subtrees_.parts.size() && subtrees_.parts[part].end <= s; ++part) {
      for (const Left& left : rooms_[part].left) room.left.push_back({left.node, left.numbers, -1});
    }
    raised += Eliminate(s, values, rule, room);
  }
  return raised;
}

int MultifrontalLdl::Eliminate(std::size_t s, const Numbers& values, const PivotRule& rule,
                               Room& room) {
  const Supernode& node = tree_.nodes[s];
  const std::int64_t update_size = UpdateSize(node) * parts_;
  const Front front = FrontOf(s);
  Gather(s, front, values);
  double* update = room.stack.data() + room.top;
  std::fill_n(update, update_size, 0.0);
  std::int64_t base = room.top;
  for (Index c = 0; c < tree_.num_children[s]; ++c) {
    const Left& left = room.left.back();
    if (left.begin >= 0) base = left.begin;
    AddChild(tree_.nodes[left.node], left.numbers, front, update);
    room.left.pop_back();
  }
  double* pivot = pivot_.data() + node.first * parts_;
  for (Index k = 0; k < node.pivots; ++k) {
    const double* column = front.top + k * front.top_stride * parts_;
    size_[node.first + k] += std::abs(column[k + (parts_ - 1) * (k / kLanes * kLanes)]);
  }
  const int raised = FactorFront(front,
                                 {sign_.data() + node.first, size_.data() + node.first, pivot,
                                  inverse_pivot_.data() + node.first * parts_},
                                 rule, room.work.data());
  if (node.rows > 0) {
    SizesBelow(front, pivot, room.column.data());
    const Index* row = subtrees_.row.data() + node.row_start;
    for (Index i = 0; i < node.rows; ++i) size_[row[i]] += room.column[i];
    SubtractSquare(front, pivot, update, room.work.data());
    if (base < room.top) std::copy_n(update, update_size, room.stack.data() + base);
  }
  room.left.push_back({s, room.stack.data() + base, base});
  room.top = base + update_size;
  return raised;
}

void MultifrontalLdl::AddPlaces(const NumbersOf<double>& v) const {
  for (const Subtrees::Part& part : subtrees_.parts) {
    AddToRows(v, part.first_place, part.above);
  }
}

/// A front's part of a right side, as its kernels want it, and back.
double* MultifrontalLdl::Load(const Supernode& node, const NumbersOf<double>& b, Room& room) const {
  if (digits_ == Digits::kPlain) return b.high + node.first;
  std::fill(room.own.begin(), room.own.end(), 0.0);
  for (Index k = 0; k < node.pivots; ++k) {
    double* at = room.own.data() + k / kLanes * 2 * kLanes + k % kLanes;
    at[0] = b.high[node.first + k];
    at[kLanes] = b.low[node.first + k];
  }
  return room.own.data();
}
void MultifrontalLdl::Store(const Supernode& node, const NumbersOf<double>& b,
                            const Room& room) const {
  if (digits_ == Digits::kPlain) return;
  for (Index k = 0; k < node.pivots; ++k) {
    const double* at = room.own.data() + k / kLanes * 2 * kLanes + k % kLanes;
    b.high[node.first + k] = at[0];
    b.low[node.first + k] = at[kLanes];
  }
}

void MultifrontalLdl::Forward(std::size_t s, const NumbersOf<double>& b, Room& room) const {
  const Supernode& node = tree_.nodes[s];
  ForwardFront(FrontOf(s), Load(node, b, room), room.column.data());
  Store(node, b, room);
  SubtractRows(room.column.data(), node.rows, subtrees_.row.data() + node.row_start, b);
}

void MultifrontalLdl::Backward(std::size_t s, const NumbersOf<double>& b, Room& room) const {
  const Supernode& node = tree_.nodes[s];
  TakeRows(b, node.rows, tree_.row.data() + node.row_start, room.column.data());
  const double* inverse = inverse_pivot_.data() + node.first * parts_;
  BackwardFront(FrontOf(s), inverse, Load(node, b, room), room.column.data());
  Store(node, b, room);
}

void MultifrontalLdl::Solve(const NumbersOf<double>& b, Workers* workers) const {
  const auto n = static_cast<Index>(sign_.size());
  std::fill(b.high + n, b.high + subtrees_.room, 0.0);
  if (digits_ == Digits::kTwofold) std::fill(b.low + n, b.low + subtrees_.room, 0.0);
  const auto each_part = [&](auto&& body) {
    EachPart(workers, subtrees_.parts.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) body(subtrees_.parts[p], rooms_[p]);
    });
  };
  each_part([&](const Subtrees::Part& part, Room& room) {
    for (std::size_t s = part.begin; s < part.end; ++s) Forward(s, b, room);
  });
  AddPlaces(digits_ == Digits::kPlain ? NumbersOf<double>{b.high, nullptr} : b);
  const std::vector<std::size_t>& top = subtrees_.top;
  for (const std::size_t s : top) Forward(s, b, rooms_.back());
  for (std::size_t k = top.size(); k-- > 0;) Backward(top[k], b, rooms_.back());
  each_part([&](const Subtrees::Part& part, Room& room) {
    for (std::size_t s = part.end; s-- > part.begin;) Backward(s, b, room);
  });
}

}  // namespace switchyard::linalg
