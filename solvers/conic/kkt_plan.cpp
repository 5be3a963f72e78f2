#include "solvers/conic/kkt_plan.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "solvers/cones/kinds.hpp"
#include "solvers/linalg/ordering.hpp"

namespace switchyard::conic {
namespace {

constexpr Index kShortRow = 4;     // condensed without a look
constexpr Index kSmallCone = 5;    // rows
constexpr Index kFewColumns = 12;  // of a cone that is condensed without a look

enum class Fate : std::uint8_t {
  kCondensed,
  kKept,
  kNone,  // of a row whose cone has no diagonal part: its combinations say all
};

/// What becomes of conic rows and of cones.
struct Decision {
  std::vector<Fate> row, cone;
};

/// Writes the plan that follows from a decision, column by column: column j of a variable has an
/// entry for every variable before it that meets it in P or in what is condensed.
class Planner {
 public:
  Planner(const Form& form, const Decision& keep, KktPlan& plan)
      : f_(form), keep_(keep), p_(plan), place_(form.shape.vars, -1) {}

  void Write() {
    ListCones();
    ListCliques();
    CollectMembers();
    for (Index j = 0; j < f_.shape.vars; ++j) VariableColumn(j);
    for (Index i = 0; i < f_.shape.equations; ++i) {
      p_.diagonal.push_back(RowColumn(f_.shape.conic_rows() + i));
    }
    p_.kept_column = p_.pattern.n;
    for (Index r = 0; r < f_.shape.conic_rows(); ++r) {
      if (keep_.row[r] != Fate::kKept) continue;
      p_.kept_row.push_back(r);
      p_.kept_pivot.push_back(RowColumn(r));
    }
    for (KktPlan::Cone& cone : p_.cones) ConeColumns(cone);
  }

 private:
  struct Clique {
    const Index* column;
    Index size;
    std::int64_t target;
  };
  struct Member {
    std::size_t clique;
    Index place;
  };

  void ListCones() {
    const linalg::SparseMatrix& a = f_.A;
    std::vector<Index> seen(f_.shape.vars, -1);
    for (std::size_t part = 0; part < f_.cones.size(); ++part) {
      const ConeGroup& g = f_.cones[part];
      for (Index c = 0; c < g.layout.count; ++c) {
        const auto number = static_cast<Index>(p_.cones.size());
        const auto each_entry = [&](auto&& take) {
          for (Index i = 0; i < g.layout.dim; ++i) {
            const Index r = g.first + g.layout.Row(c, i);
            for (Index e = a.row_start[r]; e < a.row_start[r + 1]; ++e) take(a.column[e]);
          }
        };
        const auto first = static_cast<std::ptrdiff_t>(p_.cone_column.size());
        each_entry([&](Index j) {
          if (seen[j] != number) p_.cone_column.push_back(j);
          seen[j] = number;
        });
        const auto begin = p_.cone_column.begin() + first, end = p_.cone_column.end();
        std::sort(begin, end);
        p_.cones.push_back({part, c, static_cast<Index>(first), static_cast<Index>(end - begin),
                            static_cast<std::int64_t>(p_.local_place.size()), 0});
        each_entry([&](Index j) {
          p_.local_place.push_back(static_cast<Index>(std::lower_bound(begin, end, j) - begin));
        });
      }
    }
  }

  [[nodiscard]] std::span<const Index> ColumnsOf(Index r) const {
    const linalg::SparseMatrix& a = f_.A;
    return {a.column.data() + a.row_start[r], a.column.data() + a.row_start[r + 1]};
  }

  void ListCliques() {
    std::int64_t targets = 0;
    const auto add = [&](const Index* column, Index size) {
      cliques_.push_back({column, size, targets});
      targets += std::int64_t{size} * (size + 1) / 2;
      return cliques_.back().target;
    };
    p_.row_target.assign(f_.shape.conic_rows(), -1);
    Index before = -1;  // the condensed row before
    for (Index r = 0; r < f_.shape.conic_rows(); ++r) {
      if (keep_.row[r] != Fate::kCondensed) continue;
      const std::span<const Index> columns = ColumnsOf(r);
      if (columns.empty()) continue;
      const bool same = before >= 0 && std::ranges::equal(columns, ColumnsOf(before));
      p_.row_target[r] =
          same ? p_.row_target[before] : add(columns.data(), static_cast<Index>(columns.size()));
      before = r;
    }
    for (std::size_t c = 0; c < p_.cones.size(); ++c) {
      KktPlan::Cone& cone = p_.cones[c];
      if (keep_.cone[c] == Fate::kKept) continue;
      cone.target = add(p_.cone_column.data() + cone.first_column, cone.num_columns);
    }
    p_.target.resize(targets);
  }

  void CollectMembers() {
    member_start_.assign(f_.shape.vars + 1, 0);
    for (const Clique& c : cliques_) {
      for (Index k = 0; k < c.size; ++k) ++member_start_[c.column[k] + 1];
    }
    for (Index j = 0; j < f_.shape.vars; ++j) member_start_[j + 1] += member_start_[j];
    members_.resize(member_start_.back());
    std::vector<std::int64_t> next(member_start_.begin(), member_start_.end() - 1);
    for (std::size_t c = 0; c < cliques_.size(); ++c) {
      for (Index k = 0; k < cliques_[c].size; ++k) {
        members_[next[cliques_[c].column[k]]++] = {c, k};
      }
    }
  }

  void VariableColumn(Index j) {
    std::vector<Index>& row = p_.pattern.row;
    const auto begin = static_cast<Index>(row.size());
    const auto entry = [&](Index i) {
      if (place_[i] < begin) {
        place_[i] = static_cast<Index>(row.size());
        row.push_back(i);
      }
      return place_[i];
    };
    p_.diagonal.push_back(entry(j));
    bool curved = j < f_.shape.bounded || member_start_[j] < member_start_[j + 1];
    for (Index e = f_.P.pattern.start[j]; e < f_.P.pattern.start[j + 1]; ++e) {
      const Index i = f_.P.pattern.row[e];
      p_.p_entry.push_back(entry(i));
      curved = curved || (i == j && f_.P.value[e] > 0);
    }
    for (std::int64_t m = member_start_[j]; m < member_start_[j + 1]; ++m) {
      const Clique& c = cliques_[members_[m].clique];
      const std::int64_t b = members_[m].place;
      Index* target = p_.target.data() + c.target + b * (b + 1) / 2;
      for (Index a = 0; a <= b; ++a) target[a] = entry(c.column[a]);
    }
    EndColumn(1, curved ? 0 : 1);
  }

  /// The entry of its pivot.
  Index RowColumn(Index r) {
    for (Index e = f_.A.row_start[r]; e < f_.A.row_start[r + 1]; ++e) {
      p_.pattern.row.push_back(f_.A.column[e]);
    }
    return Pivot(-1);
  }

  void ConeColumns(KktPlan::Cone& cone) {
    if (keep_.cone[&cone - p_.cones.data()] != Fate::kKept) return;
    cone.kept_entry = p_.pattern.nonzeros();
    cone.kept_column = p_.pattern.n;
    const ConeGroup& group = f_.cones[cone.part];
    const cones::Kind& kind = *cones::FindKind(group.kind);
    for (Index term = 0; term < kind.rank(group.layout.dim); ++term) {
      for (Index k = 0; k < cone.num_columns; ++k) {
        p_.pattern.row.push_back(p_.cone_column[cone.first_column + k]);
      }
      Pivot(kind.diagonal_but_for_two && term == 0 ? 1 : -1);
    }
  }

  Index Pivot(std::int8_t sign) {
    p_.pattern.row.push_back(p_.pattern.n);
    EndColumn(sign, 1);
    return p_.pattern.nonzeros() - 1;
  }

  void EndColumn(std::int8_t sign, Index group) {
    ++p_.pattern.n;
    p_.pattern.start.push_back(static_cast<Index>(p_.pattern.row.size()));
    p_.sign.push_back(sign);
    p_.group.push_back(group);
  }

  const Form& f_;
  const Decision& keep_;
  KktPlan& p_;
  std::vector<Clique> cliques_;
  std::vector<std::int64_t> member_start_;  // of each variable
  std::vector<Member> members_;
  std::vector<Index> place_;  // entry of each variable in the column at hand
};

Index RowSize(const Form& form, Index r) { return form.A.row_start[r + 1] - form.A.row_start[r]; }

/// What a cone's rows become with it.
void SetRows(const Form& form, const ConeGroup& g, Index cone, Fate fate, Decision& d) {
  const bool diagonal = cones::FindKind(g.kind)->diagonal_but_for_two;
  for (Index i = 0; i < g.layout.dim; ++i) {
    const Index r = g.first + g.layout.Row(cone, i);
    const bool kept = fate == Fate::kKept && RowSize(form, r) > kShortRow;
    d.row[r] = !diagonal ? Fate::kNone : kept ? Fate::kKept : Fate::kCondensed;
  }
}

/// Is a cone to be kept, as far as its size goes? A semidefinite one has too many terms.
bool IsLarge(const Form& form, const ConeGroup& g, Index cone) {
  if (g.kind == SY_CONE_PSD) return false;
  Index entries = 0;
  for (Index i = 0; i < g.layout.dim; ++i) {
    entries += RowSize(form, g.first + g.layout.Row(cone, i));
  }
  return g.layout.dim > kSmallCone || entries > kFewColumns;
}

/// Everything that is not short or small, kept.
Decision KeepAllLarge(const Form& form) {
  Decision d;
  d.row.resize(form.shape.conic_rows());
  for (Index r = form.shape.cone_rows; r < form.shape.conic_rows(); ++r) {
    d.row[r] = RowSize(form, r) > kShortRow ? Fate::kKept : Fate::kCondensed;
  }
  for (const ConeGroup& g : form.cones) {
    for (Index c = 0; c < g.layout.count; ++c) {
      d.cone.push_back(IsLarge(form, g, c) ? Fate::kKept : Fate::kCondensed);
      SetRows(form, g, c, d.cone.back(), d);
    }
  }
  return d;
}

/// The rows and cones that are not within a block.
Decision KeepWhatJoins(const Form& form, const Blocks& blocks) {
  Decision d;
  d.row.resize(form.shape.conic_rows());
  for (Index r = form.shape.cone_rows; r < form.shape.conic_rows(); ++r) {
    const bool joins = RowSize(form, r) > 1 && blocks.of_row[r] < 0;
    d.row[r] = joins ? Fate::kKept : Fate::kCondensed;
  }
  for (const ConeGroup& g : form.cones) {
    for (Index c = 0; c < g.layout.count; ++c) {
      // All of a cone's variables are in one block, or in one that is too large to be one.
      bool within = true;
      for (Index i = 0; i < g.layout.dim; ++i) {
        const Index r = g.first + g.layout.Row(c, i);
        within = within && (RowSize(form, r) == 0 || blocks.of_row[r] >= 0);
      }
      d.cone.push_back(!within && IsLarge(form, g, c) ? Fate::kKept : Fate::kCondensed);
      SetRows(form, g, c, d.cone.back(), d);
    }
  }
  return d;
}

/// Of what `trial` keeps, what an elimination would not begin with.
Decision WhatStays(const Form& form, const Decision& keep, const KktPlan& trial) {
  const std::vector<Index> place = linalg::Inverse(linalg::MinimumDegreeOrder(trial.pattern));
  const auto is_leaf = [&](Index column) {
    for (Index k = trial.pattern.start[column]; k < trial.pattern.start[column + 1]; ++k) {
      if (place[trial.pattern.row[k]] < place[column]) return false;
    }
    return true;
  };
  Decision stays = keep;
  Index column = trial.kept_column;
  for (const Index r : trial.kept_row) {
    stays.row[r] = is_leaf(column++) ? Fate::kCondensed : Fate::kKept;
  }
  for (std::size_t c = 0; c < trial.cones.size(); ++c) {
    if (!trial.cones[c].kept()) continue;
    const ConeGroup& g = form.cones[trial.cones[c].part];
    // The columns of a cone are alike: who comes first is chance.
    bool leaf = false;
    const Index rank = cones::FindKind(g.kind)->rank(g.layout.dim);
    for (Index k = 0; k < rank; ++k) leaf = leaf || is_leaf(column + k);
    column += rank;
    if (!leaf) continue;
    stays.cone[c] = Fate::kCondensed;
    SetRows(form, g, trial.cones[c].cone, Fate::kCondensed, stays);
  }
  return stays;
}

}  // namespace

KktPlan::KktPlan(const Form& form, const Blocks& blocks) : num_blocks(blocks.count) {
  Decision keep = blocks.empty() ? KeepAllLarge(form) : KeepWhatJoins(form, blocks);
  const auto any = [](const std::vector<Fate>& fates) {
    return std::ranges::find(fates, Fate::kKept) != fates.end();
  };
  if (blocks.empty() && (any(keep.row) || any(keep.cone))) {
    KktPlan trial = *this;
    Planner(form, keep, trial).Write();
    keep = WhatStays(form, keep, trial);
  }
  Planner(form, keep, *this).Write();
  block.assign(pattern.n, -1);
  if (!blocks.empty()) {
    std::copy(blocks.of_variable.begin(), blocks.of_variable.end(), block.begin());
    std::copy_n(blocks.of_row.begin() + form.shape.conic_rows(), form.shape.equations,
                block.begin() + form.shape.vars);
  }
}

Vector KktPlan::Constant(const Form& form) const {
  Vector constant(pattern.nonzeros(), 0.0);
  for (std::size_t e = 0; e < p_entry.size(); ++e) constant[p_entry[e]] += form.P.value[e];
  const auto put_row = [&](Index r, Index pivot) {  // its entries stand before its pivot
    const Index size = RowSize(form, r);
    std::copy_n(form.A.by_row.begin() + form.A.row_start[r], size, constant.begin() + pivot - size);
  };
  for (Index i = 0; i < form.shape.equations; ++i) {
    put_row(form.shape.conic_rows() + i, diagonal[form.shape.vars + i]);
  }
  for (std::size_t k = 0; k < kept_row.size(); ++k) put_row(kept_row[k], kept_pivot[k]);
  return constant;
}

// By diagonal dominance: P_jj less the other entries of column j, over the variables that share a
// condensed row or cone with another.
double KktPlan::LeastCurvature(const Form& form) const {
  Vector dominance(form.shape.vars, 0.0);
  for (Index j = 0; j < form.shape.vars; ++j) {
    for (Index e = form.P.pattern.start[j]; e < form.P.pattern.start[j + 1]; ++e) {
      const Index i = form.P.pattern.row[e];
      if (i == j) {
        dominance[j] += form.P.value[e];
      } else {
        dominance[i] -= std::abs(form.P.value[e]);
        dominance[j] -= std::abs(form.P.value[e]);
      }
    }
  }
  double least = kInfinity;
  const auto see = [&](const Index* column, Index size) {
    for (Index k = 0; size > 1 && k < size; ++k) least = std::min(least, dominance[column[k]]);
  };
  for (Index r = 0; r < form.shape.conic_rows(); ++r) {
    const Index begin = form.A.row_start[r], size = form.A.row_start[r + 1] - begin;
    if (row_target[r] >= 0) see(form.A.column.data() + begin, size);
  }
  for (const Cone& cone : cones) {
    if (!cone.kept()) see(cone_column.data() + cone.first_column, cone.num_columns);
  }
  return std::max(0.0, least);
}

}  // namespace switchyard::conic
