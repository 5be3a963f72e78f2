#include <bit>
#include <cmath>
#include <utility>

#include "solvers/presolve/narrow.hpp"
#include "solvers/presolve/reductions.hpp"

namespace switchyard::presolve {
namespace {

constexpr std::uint64_t kEmpty = 1469598103934665603ULL;  // the hash of a row of nothing

/// Of the columns and, rounded, of the entries over the first one.
std::uint64_t HashOf(const Draft& d, Index i) {
  std::uint64_t hash = kEmpty;
  double unit = 0;
  const auto mix = [&](std::uint64_t v) {
    hash = (hash ^ v) * 1099511628211ULL;
    hash ^= hash >> 29;
  };
  d.EachIn(i, [&](const Entry& e) {
    if (unit == 0) unit = 1 / e.value;
    mix(static_cast<std::uint64_t>(e.column) << 32 ^
        std::bit_cast<std::uint32_t>(static_cast<float>(e.value * unit)));
  });
  return hash;
}

class Merging {
 public:
  explicit Merging(Draft& draft) : d_(draft) {}

  // A row is merged into the first one before it that it is a multiple of.
  int Run() {
    const auto count = static_cast<std::size_t>(d_.num_rows());
    const std::size_t mask = std::bit_ceil(count + 1) - 1;
    std::vector<Index> latest(mask + 1, -1), earlier(count, -1);  // rows of each remainder
    std::vector<std::uint64_t> hash(count);
    for (Index i = 0; i < d_.num_rows(); ++i) {
      if (d_.row_alive[i] == 0 || !d_.SidesStay(i)) continue;
      hash[i] = HashOf(d_, i);
      if (hash[i] == kEmpty) continue;
      Index& head = latest[hash[i] & mask];
      for (Index kept = head; kept >= 0; kept = earlier[kept]) {
        if (hash[kept] != hash[i]) continue;
        if (const double factor = Factor(kept, i); factor != 0) {
          Merge(kept, i, factor);
          break;
        }
      }
      if (d_.row_alive[i] == 0) continue;
      earlier[i] = head;
      head = i;
    }
    return removed_;
  }

 private:
  /// row = factor * kept; 0: it is not.
  double Factor(Index kept, Index row) {
    a_.clear();
    b_.clear();
    d_.EachIn(kept, [&](const Entry& e) { a_.push_back(e); });
    d_.EachIn(row, [&](const Entry& e) { b_.push_back(e); });
    if (a_.size() != b_.size() || a_.empty()) return 0;
    const double factor = b_[0].value / a_[0].value;
    for (std::size_t k = 0; k < a_.size(); ++k) {
      const double want = factor * a_[k].value;
      if (a_[k].column != b_[k].column || std::abs(want - b_[k].value) > 1e-14 * std::abs(want)) {
        return 0;
      }
    }
    return factor;
  }

  void Merge(Index kept, Index row, double factor) {
    double low = d_.row_lower[row] / factor, high = d_.row_upper[row] / factor;
    if (factor < 0) std::swap(low, high);
    const Narrowed moved = Narrow(low, high, d_.row_lower[kept], d_.row_upper[kept]);
    if (moved.apart) {
      d_.contradiction = true;
      return;
    }
    if (moved.lower || moved.upper) {
      d_.undo.Add(ParallelRow{row, kept, factor, moved.lower, moved.upper});
    }
    d_.DropRow(row);
    ++removed_;
  }

  Draft& d_;
  std::vector<Entry> a_, b_;
  int removed_ = 0;
};

}  // namespace

int MergeParallelRows(Draft& draft) {
  return draft.limits.bounds_stay && draft.limits.values_stay ? Merging(draft).Run() : 0;
}

}  // namespace switchyard::presolve
