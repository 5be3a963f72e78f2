#include "solvers/mip/perspectives.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "solvers/mip/affine_columns.hpp"

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

using Binaries = std::vector<std::int32_t>;  // ascending

/// Of each variable the binaries z with which it is 0: x <= b z and x >= a z for numbers a, b.
class Switches {
 public:
  Switches(const sy_problem& p, const NodeBoxes& boxes)
      : boxes_(boxes), below_(At(p.num_vars)), above_(At(p.num_vars)) {
    if (p.A == nullptr) return;
    const Csc rows = Transpose(*p.A);
    for (std::int32_t i = 0; i < p.num_rows; ++i) {
      const auto k = At(rows.start[At(i)]);
      if (At(rows.start[At(i) + 1]) != k + 2) continue;
      const bool upper = p.row_upper != nullptr && p.row_upper[i] == 0;
      const bool lower = p.row_lower != nullptr && p.row_lower[i] == 0;
      for (const std::size_t of : {k, k + 1}) {
        const std::size_t z = of == k ? k + 1 : k;
        if (rows.value[of] == 0 || !IsBinary(rows.row[z])) continue;
        const bool up = rows.value[of] > 0;
        if (up ? upper : lower) below_[At(rows.row[of])].push_back(rows.row[z]);
        if (up ? lower : upper) above_[At(rows.row[of])].push_back(rows.row[z]);
      }
    }
    for (auto* side : {&below_, &above_}) {
      for (Binaries& b : *side) std::sort(b.begin(), b.end());
    }
  }

  [[nodiscard]] Binaries Of(std::int32_t x) const {
    if (IsBinary(x)) return {x};
    Binaries both;
    const Binaries &below = below_[At(x)], &above = above_[At(x)];
    if (boxes_.lower(x) >= 0) return below;
    if (boxes_.upper(x) <= 0) return above;
    std::set_intersection(below.begin(), below.end(), above.begin(), above.end(),
                          std::back_inserter(both));
    return both;
  }

 private:
  [[nodiscard]] bool IsBinary(std::int32_t j) const {
    return boxes_.IsInteger(j) && boxes_.lower(j) == 0 && boxes_.upper(j) == 1;
  }

  const NodeBoxes& boxes_;
  std::vector<Binaries> below_, above_;  // z = 0 says x <= 0, and x >= 0
};

/// A head that becomes `value` z.
struct Switched {
  std::int32_t row;
  std::int32_t z;
  double value;
};

class Finder {
 public:
  Finder(const sy_problem& problem, const NodeBoxes& boxes)
      : p_(problem),
        switches_(problem, boxes),
        columns_(AffineColumns(problem, boxes)),
        rows_(Transpose(*problem.F)) {}

  [[nodiscard]] std::vector<Switched> Run() const {
    std::vector<Switched> all;
    std::int32_t first = 0;
    for (std::int32_t c = 0; c < p_.num_cones; first += p_.cones[c++].dim) {
      if (p_.cones[c].kind != SY_CONE_ROTATED) continue;
      for (const std::int32_t head : {first, first + 1}) {
        const std::optional<Affine> r = AffineRow(rows_, head, Constant(head), columns_);
        if (!r || r->variable >= 0 || !(r->constant.lower > 0)) continue;
        const std::optional<std::int32_t> z = SwitchOf(first + 2, first + p_.cones[c].dim);
        if (z) all.push_back({head, *z, r->constant.upper});
        break;
      }
    }
    return all;
  }

 private:
  [[nodiscard]] double Constant(std::int32_t row) const {
    return p_.g != nullptr ? p_.g[row] : 0.0;
  }

  /// A binary with which all entries of these rows are 0.
  [[nodiscard]] std::optional<std::int32_t> SwitchOf(std::int32_t begin, std::int32_t end) const {
    std::optional<Binaries> all;
    for (std::int32_t row = begin; row < end; ++row) {
      if (Constant(row) != 0) return std::nullopt;
      for (auto k = At(rows_.start[At(row)]); k < At(rows_.start[At(row) + 1]); ++k) {
        const Affine& x = columns_[At(rows_.row[k])];
        if (x.variable < 0 && IsExactly(x.constant, 0)) continue;
        Binaries own = switches_.Of(rows_.row[k]), both;
        if (own.empty() && x.variable >= 0 && IsExactly(x.constant, 0)) {
          own = switches_.Of(x.variable);
        }
        if (all) {
          std::set_intersection(all->begin(), all->end(), own.begin(), own.end(),
                                std::back_inserter(both));
        }
        all = all ? both : own;
        if (all->empty()) return std::nullopt;
      }
    }
    if (!all) return std::nullopt;
    return all->front();
  }

  const sy_problem& p_;
  Switches switches_;
  std::vector<Affine> columns_;
  Csc rows_;  // of F
};

}  // namespace

std::int32_t TakePerspectives(Problem& problem, const NodeBoxes& boxes) {
  if (problem.view().F == nullptr) return 0;
  const std::vector<Switched> all = Finder(problem.view(), boxes).Run();
  if (all.empty()) return 0;
  problem.Change([&](ProblemData& d) {
    const Csc old = Transpose(d.F.View());
    Csc rows(d.F.cols, d.F.rows);
    auto next = all.begin();  // heads ascend
    for (std::int32_t i = 0; i < d.F.rows; ++i) {
      if (next != all.end() && next->row == i) {
        rows.row.push_back(next->z);
        rows.value.push_back(next->value);
        d.g[At(i)] = 0;
        ++next;
      } else {
        for (auto k = At(old.start[At(i)]); k < At(old.start[At(i) + 1]); ++k) {
          rows.row.push_back(old.row[k]);
          rows.value.push_back(old.value[k]);
        }
      }
      rows.start[At(i) + 1] = static_cast<std::int32_t>(rows.row.size());
    }
    d.F = Transpose(rows.View());
  });
  return static_cast<std::int32_t>(all.size());
}

}  // namespace switchyard::mip
