#include "pivoted_ldl.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace switchyard::ipopt {
namespace {

using linalg::Index;

linalg::Elimination Planned(const linalg::SymmetricPattern& pattern, std::vector<Index> last) {
  linalg::EliminationWish wish;
  if (std::find(last.begin(), last.end(), 1) != last.end()) wish.group = std::move(last);
  return linalg::LeastWork(pattern, wish).elimination;
}

}  // namespace

PivotedLdl::PivotedLdl(linalg::SymmetricPattern pattern, std::vector<Index> last)
    : pattern_(std::move(pattern)),
      elimination_(Planned(pattern_, std::move(last))),
      tree_(linalg::FindSupernodes(elimination_)),
      scale_(static_cast<std::size_t>(pattern_.n)),
      scaled_(pattern_.row.size()),
      fronts_(tree_.nodes.size()),
      index_(tree_.nodes.size()),
      place_(scale_.size()),
      b_(scale_.size()) {}

void PivotedLdl::Scale(const double* values) {
  constexpr int kRounds = 5;
  std::fill(scale_.begin(), scale_.end(), 1.0);
  std::vector<double> largest(scale_.size());
  for (int round = 0; round < kRounds; ++round) {
    std::fill(largest.begin(), largest.end(), 0.0);
    for (Index j = 0; j < pattern_.n; ++j) {
      for (Index k = pattern_.start[j]; k < pattern_.start[j + 1]; ++k) {
        const Index i = pattern_.row[k];
        const double size = std::abs(values[k]) * scale_[i] * scale_[j];
        largest[i] = std::max(largest[i], size);
        largest[j] = std::max(largest[j], size);
      }
    }
    for (std::size_t j = 0; j < scale_.size(); ++j) {
      if (largest[j] > 0) scale_[j] /= std::sqrt(largest[j]);
    }
  }
  for (Index j = 0; j < pattern_.n; ++j) {
    for (Index k = pattern_.start[j]; k < pattern_.start[j + 1]; ++k) {
      scaled_[k] = values[k] * scale_[pattern_.row[k]] * scale_[j];
    }
  }
}

// Its own columns, those its children delayed, and the rows below.
void PivotedLdl::Begin(std::size_t s, std::size_t children) {
  const linalg::Supernode& node = tree_.nodes[s];
  std::vector<Index>& index = index_[s];
  index.clear();
  for (Index k = 0; k < node.pivots; ++k) index.push_back(node.first + k);
  for (std::size_t c = top_ - children; c < top_; ++c) {
    const Left& child = stack_[c];
    index.insert(index.end(), child.index.begin(), child.index.begin() + child.delayed);
  }
  const auto candidates = static_cast<Index>(index.size());
  const Index* row = tree_.row.data() + node.row_start;
  index.insert(index.end(), row, row + node.rows);
  for (std::size_t k = 0; k < index.size(); ++k) place_[index[k]] = static_cast<Index>(k);
  fronts_[s].Reset(candidates, node.rows);
}

void PivotedLdl::Gather(std::size_t s) {
  const linalg::Supernode& node = tree_.nodes[s];
  const std::int64_t end = s + 1 < tree_.nodes.size()
                               ? tree_.nodes[s + 1].entry_start
                               : static_cast<std::int64_t>(tree_.entry.size());
  for (std::int64_t e = node.entry_start; e < end; ++e) {
    const linalg::FrontEntry& at = tree_.entry[e];
    const double value = scaled_[at.entry];
    if (at.row == at.column) fronts_[s].AddSize(at.row, std::abs(value));
    if (at.row < node.pivots) {
      fronts_[s].Add(at.row, at.column, value);
    } else {
      fronts_[s].AddBelow(at.row - node.pivots, at.column, value);
    }
  }
}

void PivotedLdl::AddChild(const Left& child, std::size_t s) {
  DenseFront& front = fronts_[s];
  const Index candidates = front.candidates();
  const std::size_t order = child.index.size(), stride = linalg::RoundUp(order);
  const std::size_t to_stride = linalg::RoundUp(static_cast<std::size_t>(front.rows()));
  for (std::size_t j = 0; j < order; ++j) {
    const double* column = child.value.data() + j * stride;
    const Index to = place_[child.index[j]];
    front.AddSize(to, child.size[j]);
    for (std::size_t i = j; i < order; ++i) {
      const auto [low, high] = std::minmax(to, place_[child.index[i]]);
      if (high < candidates) {
        front.Add(high, low, column[i]);
      } else if (low < candidates) {
        front.AddBelow(high - candidates, low, column[i]);
      } else {
        update_[static_cast<std::size_t>(low - candidates) * to_stride +
                static_cast<std::size_t>(high - candidates)] += column[i];
      }
    }
  }
}

// `update_` has what the children left for the rows.
void PivotedLdl::Leave(std::size_t s, Left& to) {
  const DenseFront& front = fronts_[s];
  std::vector<Index>& index = index_[s];
  const Index pivots = front.pivots(), candidates = front.candidates();
  const std::vector<Index> before(index.begin(), index.begin() + candidates);
  for (Index k = 0; k < candidates; ++k) index[k] = before[front.candidate(k)];
  to.index.assign(index.begin() + pivots, index.end());
  to.delayed = candidates - pivots;
  to.size.clear();
  for (Index k = pivots; k < candidates + front.rows(); ++k) to.size.push_back(front.size(k));
  front.SubtractFrom(update_.data(), work_);
  if (to.delayed == 0) return std::swap(to.value, update_);
  const std::size_t stride = linalg::RoundUp(to.index.size());
  const auto delayed = static_cast<std::size_t>(to.delayed);
  const auto rows = static_cast<std::size_t>(front.rows());
  to.value.assign(stride * to.index.size(), 0.0);
  for (Index j = 0; j < to.delayed; ++j) {
    double* column = to.value.data() + static_cast<std::size_t>(j) * stride;
    for (Index i = j; i < to.delayed; ++i) column[i] = front.Left(pivots + i, pivots + j);
    for (Index i = 0; i < front.rows(); ++i) {
      column[to.delayed + i] = front.LeftBelow(i, pivots + j);
    }
  }
  for (std::size_t j = 0; j < rows; ++j) {
    const double* from = update_.data() + j * linalg::RoundUp(rows);
    std::copy(from + j, from + rows, to.value.data() + (delayed + j) * stride + delayed + j);
  }
}

Inertia PivotedLdl::Factor(const double* values, double u) {
  Inertia inertia;
  Scale(values);
  top_ = 0;
  for (std::size_t s = 0; s < tree_.nodes.size(); ++s) {
    const auto children = static_cast<std::size_t>(tree_.num_children[s]);
    const bool is_root = tree_.nodes[s].parent < 0;
    Begin(s, children);
    Gather(s);
    const auto rows = static_cast<std::size_t>(fronts_[s].rows());
    update_.assign(rows * linalg::RoundUp(rows), 0.0);
    for (std::size_t c = top_ - children; c < top_; ++c) AddChild(stack_[c], s);
    top_ -= children;
    fronts_[s].Eliminate(u, is_root, inertia);
    if (top_ == stack_.size()) stack_.emplace_back();
    Leave(s, stack_[top_++]);
  }
  return inertia;
}

void PivotedLdl::Load(std::size_t s) const {
  const std::vector<Index>& index = index_[s];
  const auto candidates = static_cast<std::size_t>(fronts_[s].candidates());
  const std::size_t shift = linalg::RoundUp(candidates) - candidates;
  x_.assign(linalg::RoundUp(index.size() + shift), 0.0);
  for (std::size_t k = 0; k < candidates; ++k) x_[k] = b_[index[k]];
  for (std::size_t k = candidates; k < index.size(); ++k) x_[k + shift] = b_[index[k]];
}

/// The first `count` entries of a front's part.
void PivotedLdl::Store(std::size_t s, Index count) const {
  const std::vector<Index>& index = index_[s];
  const Index candidates = fronts_[s].candidates();
  const Index shift = linalg::RoundUp(candidates) - candidates;
  for (Index k = 0; k < std::min(count, candidates); ++k) b_[index[k]] = x_[k];
  for (Index k = candidates; k < count; ++k) b_[index[k]] = x_[k + shift];
}

void PivotedLdl::Solve(double* b) const {
  const std::vector<Index>& order = elimination_.order;
  for (std::size_t k = 0; k < order.size(); ++k) b_[k] = b[order[k]] * scale_[order[k]];
  for (std::size_t s = 0; s < fronts_.size(); ++s) {
    Load(s);
    fronts_[s].Forward(x_.data());
    Store(s, static_cast<Index>(index_[s].size()));
  }
  for (std::size_t s = fronts_.size(); s-- > 0;) {
    Load(s);
    fronts_[s].Backward(x_.data());
    Store(s, fronts_[s].pivots());
  }
  for (std::size_t k = 0; k < order.size(); ++k) b[order[k]] = b_[k] * scale_[order[k]];
}

}  // namespace switchyard::ipopt
