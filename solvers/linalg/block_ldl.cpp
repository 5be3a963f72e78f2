#include "solvers/linalg/block_ldl.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solvers/linalg/lane_kernels.hpp"

namespace switchyard::linalg {
namespace {

/// Rows and columns of `lists` (count of `each` numbers) become lane after lane.
std::vector<Index> SideBySide(const std::vector<Index>& lists, std::size_t each, std::size_t first,
                              std::size_t lanes) {
  std::vector<Index> woven(each * lanes);
  for (std::size_t l = 0; l < lanes; ++l) {
    for (std::size_t k = 0; k < each; ++k) woven[k * lanes + l] = lists[(first + l) * each + k];
  }
  return woven;
}

}  // namespace

BlockPlan::BlockPlan(const SymmetricPattern& pattern, const std::vector<Index>& block, Index count,
                     const std::vector<std::int8_t>& sign)
    : columns(pattern.n) {
  std::vector<Index> rest_number(pattern.n, -1);
  for (Index j = 0; j < pattern.n; ++j) {
    if (block[j] >= 0) continue;
    rest_number[j] = static_cast<Index>(rest_column.size());
    rest_column.push_back(j);
  }
  MakeBatches(ClassifyBlocks(pattern, sign, block, count), rest_number);
  PlanRest(pattern, rest_number);
}

void BlockPlan::MakeBatches(const std::vector<BlockClass>& classes,
                            const std::vector<Index>& rest_number) {
  for (const BlockClass& c : classes) {
    const BlockShape& s = c.shape;
    const auto own = static_cast<std::size_t>(s.columns);
    const auto border = static_cast<std::size_t>(s.border);
    std::vector<Index> in_rest;
    for (const Index j : c.border) in_rest.push_back(rest_number[j]);
    for (Index first = 0; first < c.count;) {
      Batch& b = batches.emplace_back();
      b.shape = static_cast<Index>(shapes.size());
      b.lanes = c.count - first >= kLanes ? kLanes : 1;
      const auto lanes = static_cast<std::size_t>(b.lanes);
      b.column = SideBySide(c.column, own, first, lanes);
      b.border = SideBySide(in_rest, border, first, lanes);
      b.entry = SideBySide(c.entry, s.entry_position.size(), first, lanes);
      b.l = l;
      b.pivots = pivots;
      b.x = x;
      // A batch begins on a cache line.
      l += RoundUp(static_cast<std::size_t>(s.positions()) * lanes);
      pivots += RoundUp(own * lanes);
      x += RoundUp((own + border) * lanes);
      const std::size_t pairs = RoundUp(static_cast<std::size_t>(s.border_pairs()) * lanes);
      b.triangle = triangles;
      triangles += pairs;
      triangle = std::max(triangle, pairs);
      first += b.lanes;
    }
    work += static_cast<double>(s.target.size()) * c.count;
    factor_size += static_cast<double>(s.positions() - s.columns) * c.count;
    shapes.push_back(s);
  }
}

// The rest's own entries, and one for every two rows of a border.
void BlockPlan::PlanRest(const SymmetricPattern& pattern, const std::vector<Index>& rest_number) {
  const auto n = static_cast<Index>(rest_column.size());
  // Calls back with the row and column, row <= column, of each wanted entry of the rest, and who
  // wants it: an entry of the matrix, or (~) one of all batches' pairs.
  std::vector<Index> pairs;
  const auto each = [&](auto&& take) {
    for (Index j = 0; j < pattern.n; ++j) {
      if (rest_number[j] < 0) continue;
      for (Index e = pattern.start[j]; e < pattern.start[j + 1]; ++e) {
        const Index a = rest_number[pattern.row[e]], b = rest_number[j];
        if (a >= 0) take(std::min(a, b), std::max(a, b), e);
      }
    }
    Index pair = 0;
    for (const Batch& batch : batches) {
      const auto border = static_cast<std::size_t>(shapes[batch.shape].border);
      const auto lanes = static_cast<std::size_t>(batch.lanes);
      for (std::size_t a = 0; a < border; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Index i = batch.border[a * lanes + lane], j = batch.border[b * lanes + lane];
            take(std::min(i, j), std::max(i, j), ~pair++);
          }
        }
      }
    }
    pairs.resize(static_cast<std::size_t>(pair));
  };
  // By column, in the order of the calls.
  std::vector<std::size_t> next(static_cast<std::size_t>(n) + 1, 0);
  each([&](Index, Index column, Index) { ++next[column + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Index> row(next.back()), who(next.back());
  each([&](Index i, Index column, Index wants) {
    row[next[column]] = i;
    who[next[column]++] = wants;
  });
  rest_pattern.n = n;
  std::vector<Index> place(n, -1);
  std::size_t k = 0;
  for (Index j = 0; j < n; ++j) {
    const Index begin = rest_pattern.nonzeros();
    for (; k < next[j]; ++k) {  // by now where the column ends
      if (place[row[k]] < begin) {
        place[row[k]] = static_cast<Index>(rest_pattern.row.size());
        rest_pattern.row.push_back(row[k]);
        rest_entry.push_back(-1);
      }
      if (who[k] < 0) {
        pairs[~who[k]] = place[row[k]];
      } else {
        rest_entry[place[row[k]]] = who[k];
      }
    }
    rest_pattern.start.push_back(static_cast<Index>(rest_pattern.row.size()));
  }
  GivePairs(pairs);
}

void BlockPlan::GivePairs(const std::vector<Index>& pairs) {
  auto from = pairs.begin();
  for (Batch& batch : batches) {
    const auto until = from + std::ptrdiff_t{shapes[batch.shape].border_pairs()} * batch.lanes;
    batch.pair.assign(from, until);
    from = until;
  }
}

namespace {

/// The members of a list that are of the rest.
template <class T>
std::vector<T> OfRest(const std::vector<T>& all, const std::vector<Index>& rest_column) {
  std::vector<T> some;
  for (const Index j : rest_column) {
    if (!all.empty()) some.push_back(all[j]);
  }
  return some;
}

}  // namespace

BlockLdl::BlockLdl(const SymmetricPattern& pattern, const std::vector<std::int8_t>& sign,
                   const EliminationWish& wish, const std::vector<Index>& block, Index count)
    : plan_(std::make_shared<const BlockPlan>(pattern, block, count, sign)),
      rest_(plan_->rest_pattern, OfRest(sign, plan_->rest_column),
            {OfRest(wish.group, plan_->rest_column), wish.factorizations}) {}

BlockLdl::BlockLdl(const BlockLdl& other) : plan_(other.plan_), rest_(other.rest_) {}

void BlockLdl::MakeRoom(Digits digits, Made& made) const {
  const auto parts = static_cast<std::size_t>(PartsOf(digits));
  made.l.resize(plan_->l * parts);
  made.inverse_pivot.resize(plan_->pivots * parts);
  made.triangle.resize(std::max(made.triangle.size(), plan_->triangle * parts));
  made.x.resize(plan_->x * parts);
  made.rest_high.resize(plan_->rest_entry.size());
  made.right_high.resize(plan_->rest_column.size());
  if (digits == Digits::kPlain) return;
  made.rest_low.resize(plan_->rest_entry.size());
  made.right_low.resize(plan_->rest_column.size());
}

int BlockLdl::Factor(const Numbers& values, const PivotRule& rule, Workers* workers) {
  digits_ = values.digits();
  const bool twofold = digits_ == Digits::kTwofold;
  Made& to = twofold ? twofold_ : plain_;
  (twofold ? plain_ : twofold_) = Made();  // not both
  MakeRoom(digits_, to);
  for (std::size_t e = 0; e < plan_->rest_entry.size(); ++e) {
    const Index entry = plan_->rest_entry[e];
    to.rest_high[e] = entry >= 0 ? values.high[entry] : 0;
    if (twofold) to.rest_low[e] = entry >= 0 ? values.low[entry] : 0;
  }
  constexpr double kWorthSharing = 1e5;  // multiplications
  const bool share = workers != nullptr && workers->threads() > 1 && plan_->work > kWorthSharing;
  const int raised =
      share ? FactorBatches(values, rule, *workers, to) : FactorBatches(values, rule, to);
  if (twofold) KeepInfinite(values, to);
  return raised +
         rest_.Factor({to.rest_high.data(), twofold ? to.rest_low.data() : nullptr}, rule, workers);
}

// A twofold number that is infinite becomes NaN when something is added.
void BlockLdl::KeepInfinite(const Numbers& values, Made& to) const {
  for (std::size_t e = 0; e < plan_->rest_entry.size(); ++e) {
    const Index entry = plan_->rest_entry[e];
    if (entry >= 0 && std::isinf(values.high[entry])) {
      to.rest_high[e] = values.high[entry];
      to.rest_low[e] = 0;
    }
  }
}

int BlockLdl::FactorBatches(const Numbers& values, const PivotRule& rule, Made& to) const {
  int raised = 0;
  for (const Batch& batch : plan_->batches) {
    raised += FactorBatch(batch, values, rule, to, to.triangle.data());
    AddScattered(ShapeOf(batch, values.digits()), to.triangle.data(), batch.pair,
                 {to.rest_high.data(), to.rest_low.data()});
  }
  return raised;
}

// What the batches leave is added up in their order: so are sums the same with any number of
// threads.
int BlockLdl::FactorBatches(const Numbers& values, const PivotRule& rule, Workers& workers,
                            Made& to) const {
  const std::vector<Batch>& batches = plan_->batches;
  const auto parts = static_cast<std::size_t>(PartsOf(values.digits()));
  to.triangle.resize(std::max(to.triangle.size(), plan_->triangles * parts));
  std::vector<int> raised(batches.size(), 0);
  workers.Each(batches.size(), [&](std::size_t b) {
    raised[b] =
        FactorBatch(batches[b], values, rule, to, to.triangle.data() + batches[b].triangle * parts);
  });
  for (const Batch& batch : batches) {
    AddScattered(ShapeOf(batch, values.digits()), to.triangle.data() + batch.triangle * parts,
                 batch.pair, {to.rest_high.data(), to.rest_low.data()});
  }
  return std::accumulate(raised.begin(), raised.end(), 0);
}

int BlockLdl::FactorBatch(const Batch& batch, const Numbers& values, const PivotRule& rule,
                          Made& to, double* triangle) const {
  const LaneShape shape = ShapeOf(batch, values.digits());
  const BlockShape& s = shape.block;
  const auto lanes = static_cast<std::size_t>(batch.lanes);
  const std::size_t stride = lanes * PartsOf(shape.digits);
  double* l = to.l.data() + batch.l * PartsOf(shape.digits);
  std::fill_n(l, static_cast<std::size_t>(s.positions()) * stride, 0.0);
  const Index* entry = batch.entry.data();
  for (const Index position : s.entry_position) {
    double* at = l + static_cast<std::size_t>(position) * stride;
    for (std::size_t lane = 0; lane < lanes; ++lane) at[lane] = values.high[entry[lane]];
    for (std::size_t lane = lanes; lane < stride; ++lane) {
      at[lane] = values.low[entry[lane - lanes]];
    }
    entry += lanes;
  }
  std::fill_n(triangle, static_cast<std::size_t>(s.border_pairs()) * stride, 0.0);
  return FactorLanes(shape, rule, l, to.inverse_pivot.data() + batch.pivots * PartsOf(shape.digits),
                     triangle);
}

void BlockLdl::Solve(const NumbersOf<double>& given, Workers* workers) const {
  const bool twofold = digits_ == Digits::kTwofold;
  const Made& by = twofold ? twofold_ : plain_;
  NumbersOf<double> b{given.high, twofold ? given.low : nullptr};
  if (twofold && b.low == nullptr) {
    by.low.assign(plan_->columns, 0.0);
    b.low = by.low.data();
  }
  constexpr double kWorthSharing = 3e4;  // entries of L
  if (plan_->factor_size < kWorthSharing) workers = nullptr;
  constexpr std::size_t kBatches = 4;  // at a time
  const auto each_batch = [&](auto&& body) {
    EachPart(workers, plan_->batches.size(), kBatches, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) body(plan_->batches[k]);
    });
  };
  each_batch([&](const Batch& batch) { ForwardBatch(batch, b, by); });
  SolveRest(b, by, workers);
  each_batch([&](const Batch& batch) { BackwardBatch(batch, by, b); });
}

// What the batches leave is added up in their order.
void BlockLdl::SolveRest(const NumbersOf<double>& b, const Made& by, Workers* workers) const {
  const std::vector<Index>& column = plan_->rest_column;
  const NumbersOf<double> rest{by.right_high.data(),
                               b.low != nullptr ? by.right_low.data() : nullptr};
  for (std::size_t k = 0; k < column.size(); ++k) rest.high[k] = b.high[column[k]];
  for (std::size_t k = 0; rest.low != nullptr && k < column.size(); ++k) {
    rest.low[k] = b.low[column[k]];
  }
  for (const Batch& batch : plan_->batches) AddBorder(batch, by);
  rest_.Solve(rest.high, rest.low, workers);
  for (std::size_t k = 0; k < column.size(); ++k) b.high[column[k]] = rest.high[k];
  for (std::size_t k = 0; rest.low != nullptr && k < column.size(); ++k) {
    b.low[column[k]] = rest.low[k];
  }
}

namespace {

/// Numbers of a vector, lane after lane, and back.
void TakeLanes(const NumbersOf<double>& from, const std::vector<Index>& place, std::size_t lanes,
               double* to) {
  for (std::size_t k = 0; k < place.size(); k += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) *to++ = from.high[place[k + l]];
    if (from.low == nullptr) continue;
    for (std::size_t l = 0; l < lanes; ++l) *to++ = from.low[place[k + l]];
  }
}
void GiveLanes(const double* from, const std::vector<Index>& place, std::size_t lanes,
               const NumbersOf<double>& to) {
  for (std::size_t k = 0; k < place.size(); k += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) to.high[place[k + l]] = *from++;
    if (to.low == nullptr) continue;
    for (std::size_t l = 0; l < lanes; ++l) to.low[place[k + l]] = *from++;
  }
}

}  // namespace

void BlockLdl::ForwardBatch(const Batch& batch, const NumbersOf<double>& b, const Made& by) const {
  const std::size_t parts = PartsOf(digits_);
  double* x = by.x.data() + batch.x * parts;
  double* border = x + batch.column.size() * parts;
  TakeLanes(b, batch.column, batch.lanes, x);
  std::fill_n(border, batch.border.size() * parts, 0.0);
  const LaneShape shape = ShapeOf(batch, digits_);
  ForwardLanes(shape, by.l.data() + batch.l * parts, x);
}

void BlockLdl::AddBorder(const Batch& batch, const Made& by) const {
  const std::size_t parts = PartsOf(digits_);
  const double* border = by.x.data() + (batch.x + batch.column.size()) * parts;
  AddScattered(ShapeOf(batch, digits_), border, batch.border,
               {by.right_high.data(), by.right_low.data()});
}

void BlockLdl::BackwardBatch(const Batch& batch, const Made& by, const NumbersOf<double>& b) const {
  const std::size_t parts = PartsOf(digits_);
  double* x = by.x.data() + batch.x * parts;
  double* low = digits_ == Digits::kTwofold ? by.right_low.data() : nullptr;
  TakeLanes({by.right_high.data(), low}, batch.border, batch.lanes,
            x + batch.column.size() * parts);
  BackwardLanes(ShapeOf(batch, digits_), by.l.data() + batch.l * parts,
                by.inverse_pivot.data() + batch.pivots * parts, x);
  GiveLanes(x, batch.column, batch.lanes, b);
}

}  // namespace switchyard::linalg
