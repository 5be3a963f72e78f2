#include "solvers/linalg/multifrontal_ldl.hpp"

#include <algorithm>
#include <cmath>

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
    : tree_(FindSupernodes(elimination)), digits_(digits), parts_(PartsOf(digits)) {
  const std::size_t n = elimination.order.size();
  sign_.reserve(n);
  for (const Index j : elimination.order) sign_.push_back(sign[j]);
  pivot_.resize(n * parts_);
  inverse_pivot_.resize(n * parts_);
  size_.resize(n);
  PlanStorage();
}

// The stack holds what the children left, and above it what their parent is about to leave.
void MultifrontalLdl::PlanStorage() {
  std::int64_t size = 0, top = 0, peak = 0;
  Index most_rows = 0, most_pivots = 0;
  std::vector<std::int64_t> stack;
  for (std::size_t s = 0; s < tree_.nodes.size(); ++s) {
    const Supernode& node = tree_.nodes[s];
    front_start_.push_back(size * parts_);
    size += FrontSize(node);
    peak = std::max(peak, top + UpdateSize(node));
    for (Index c = 0; c < tree_.num_children[s]; ++c) {
      top -= stack.back();
      stack.pop_back();
    }
    stack.push_back(UpdateSize(node));
    top += UpdateSize(node);
    most_rows = std::max(most_rows, node.rows);
    most_pivots = std::max(most_pivots, node.pivots);
  }
  fronts_.resize(size * parts_);
  stack_.resize(peak * parts_);
  work_.resize(kWorkPerPivot * most_pivots);
  column_.resize(RoundUp(most_rows) * parts_);
  own_.resize(RoundUp(most_pivots) * parts_);
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

int MultifrontalLdl::Factor(const Numbers& values, const PivotRule& rule) {
  int raised = 0;
  std::fill(size_.begin(), size_.end(), 0.0);
  std::int64_t top = 0;
  left_.clear();
  for (std::size_t s = 0; s < tree_.nodes.size(); ++s) {
    const Supernode& node = tree_.nodes[s];
    const std::int64_t update_size = UpdateSize(node) * parts_;
    const Front front = FrontOf(s);
    Gather(s, front, values);
    double* update = stack_.data() + top;
    std::fill_n(update, update_size, 0.0);
    std::int64_t base = top;
    for (Index c = 0; c < tree_.num_children[s]; ++c) {
      base = left_.back().begin;
      AddChild(tree_.nodes[left_.back().node], stack_.data() + base, front, update);
      left_.pop_back();
    }
    double* pivot = pivot_.data() + node.first * parts_;
    for (Index k = 0; k < node.pivots; ++k) {
      const double* column = front.top + k * front.top_stride * parts_;
      size_[node.first + k] += std::abs(column[k + (parts_ - 1) * (k / kLanes * kLanes)]);
    }
    raised += FactorFront(front,
                          {sign_.data() + node.first, size_.data() + node.first, pivot,
                           inverse_pivot_.data() + node.first * parts_},
                          rule, work_.data());
    if (node.rows > 0) {
      SizesBelow(front, pivot, column_.data());
      const Index* row = tree_.row.data() + node.row_start;
      for (Index i = 0; i < node.rows; ++i) size_[row[i]] += column_[i];
      SubtractSquare(front, pivot, update, work_.data());
      if (base < top) std::copy_n(update, update_size, stack_.data() + base);
    }
    left_.push_back({s, base});
    top = base + update_size;
  }
  return raised;
}

/// A front's part of a right side, as its kernels want it, and back.
double* MultifrontalLdl::Load(const Supernode& node, const NumbersOf<double>& b) const {
  if (digits_ == Digits::kPlain) return b.high + node.first;
  std::fill(own_.begin(), own_.end(), 0.0);
  for (Index k = 0; k < node.pivots; ++k) {
    double* at = own_.data() + k / kLanes * 2 * kLanes + k % kLanes;
    at[0] = b.high[node.first + k];
    at[kLanes] = b.low[node.first + k];
  }
  return own_.data();
}
void MultifrontalLdl::Store(const Supernode& node, const NumbersOf<double>& b) const {
  if (digits_ == Digits::kPlain) return;
  for (Index k = 0; k < node.pivots; ++k) {
    const double* at = own_.data() + k / kLanes * 2 * kLanes + k % kLanes;
    b.high[node.first + k] = at[0];
    b.low[node.first + k] = at[kLanes];
  }
}

void MultifrontalLdl::Solve(const NumbersOf<double>& b) const {
  double* y = column_.data();
  for (std::size_t s = 0; s < tree_.nodes.size(); ++s) {
    const Supernode& node = tree_.nodes[s];
    ForwardFront(FrontOf(s), Load(node, b), y);
    Store(node, b);
    SubtractRows(y, node.rows, tree_.row.data() + node.row_start, b);
  }
  for (std::size_t s = tree_.nodes.size(); s-- > 0;) {
    const Supernode& node = tree_.nodes[s];
    TakeRows(b, node.rows, tree_.row.data() + node.row_start, y);
    const double* inverse = inverse_pivot_.data() + node.first * parts_;
    BackwardFront(FrontOf(s), inverse, Load(node, b), y);
    Store(node, b);
  }
}

}  // namespace switchyard::linalg
