#include "solvers/rounding/restriction.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/cones.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kRounding = 1e-9;  // of a side, in a row without variables

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Rows of A or F of which some are kept, with what the fixed variables put into them.
class KeptRows {
 public:
  explicit KeptRows(std::int32_t rows) : place_(At(rows), -1), fixed_(At(rows), 0.0) {}

  void Fix(std::int32_t row, double value) { fixed_[At(row)] += value; }
  void Keep(std::int32_t row) {
    if (place_[At(row)] >= 0) return;
    place_[At(row)] = 0;
    rows_.push_back(row);
  }
  /// Numbers what is kept, in its order.
  void Number() {
    std::sort(rows_.begin(), rows_.end());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      place_[At(rows_[k])] = static_cast<std::int32_t>(k);
    }
  }
  [[nodiscard]] bool Has(std::int32_t row) const { return place_[At(row)] >= 0; }
  [[nodiscard]] double fixed(std::int32_t row) const { return fixed_[At(row)]; }
  [[nodiscard]] const std::vector<std::int32_t>& rows() const { return rows_; }
  /// Columns `variables` of `m`, in rows that are kept; an entry of another is of a block that is
  /// off, where it meets a coupling variable.
  [[nodiscard]] Csc Columns(const sy_csc* m, const std::vector<std::int32_t>& variables) const {
    Csc kept(static_cast<std::int32_t>(rows_.size()), static_cast<std::int32_t>(variables.size()));
    for (std::size_t c = 0; m != nullptr && c < variables.size(); ++c) {
      for (std::int32_t k = m->start[variables[c]]; k < m->start[variables[c] + 1]; ++k) {
        const std::int32_t at = place_[At(m->row[k])];
        if (at < 0) continue;
        kept.row.push_back(at);
        kept.value.push_back(m->value[k]);
      }
      kept.start[c + 1] = static_cast<std::int32_t>(kept.row.size());
    }
    return kept;
  }

 private:
  std::vector<std::int32_t> place_;  // of each row among those kept; -1: it goes
  std::vector<double> fixed_;
  std::vector<std::int32_t> rows_;
};

class Restricting {
 public:
  Restricting(const PathProblem& whole, std::span<const std::int32_t> path)
      : whole_(whole),
        p_(whole.problem()),
        on_(At(whole.blocks().num_blocks), 0),
        fixed_(At(p_.num_vars), 0),
        a_(p_.num_rows),
        f_(p_.num_cone_rows) {
    SwitchOn(path);
    FixScales(path);
    KeepVariables();
  }

  Restriction Run() {
    KeepRowsAndCones();
    if (found_.contradiction.empty()) TakeSides();
    if (found_.contradiction.empty()) TakeCones();
    if (found_.contradiction.empty()) TakeObjective();
    return std::move(found_);
  }

 private:
  void SwitchOn(std::span<const std::int32_t> path) {
    std::vector<std::uint8_t> on_path(At(whole_.paths().num_arcs), 0);
    for (const std::int32_t a : path) on_path[At(a)] = 1;
    for (const std::int32_t b : whole_.always_on()) Switch(b);
    for (const std::int32_t a : path) {
      for (const std::int32_t b : whole_.blocks_of_arc().Of(a)) {
        if (on_path[At(whole_.paths().arc_out[b])] != 0) Switch(b);
      }
    }
  }

  void Switch(std::int32_t block) {
    on_[At(block)] = 1;
    blocks_.push_back(block);
  }

  void FixScales(std::span<const std::int32_t> path) {
    for (std::int32_t a = 0; a < whole_.paths().num_arcs; ++a) {
      fixed_[At(whole_.paths().flow[a])] = 1;
    }
    const auto one = [&](std::int32_t j) { found_.ones.push_back(j); };
    for (const std::int32_t a : path) one(whole_.paths().flow[a]);
    for (const std::int32_t b : blocks_) {
      const std::int32_t scale = whole_.paths().scale[b];
      if (scale < 0 || fixed_[At(scale)] != 0) continue;
      fixed_[At(scale)] = 1;
      one(scale);
    }
    std::sort(found_.ones.begin(), found_.ones.end());
    NeedBoundsToAllow();
  }

  // A flow that the problem fixes must agree with the path.
  void NeedBoundsToAllow() {
    const auto say = [&](std::int32_t j, const char* what) {
      found_.contradiction = "x[" + std::to_string(j) + what;
    };
    for (const std::int32_t j : found_.ones) {
      if (p_.x_upper != nullptr && p_.x_upper[j] < 1) say(j, "] may not be 1, and is on the path");
    }
    for (std::int32_t a = 0; p_.x_lower != nullptr && a < whole_.paths().num_arcs; ++a) {
      const std::int32_t j = whole_.paths().flow[a];
      if (!(p_.x_lower[j] > 0)) continue;
      if (!std::binary_search(found_.ones.begin(), found_.ones.end(), j)) {
        say(j, "] must be on the path, and is not");
      }
    }
  }

  void KeepVariables() {
    const auto keep = [&](std::int32_t j) {
      if (fixed_[At(j)] == 0) found_.variables.push_back(j);
    };
    for (const std::int32_t j : whole_.coupling_variables()) keep(j);
    for (const std::int32_t b : blocks_) {
      for (const std::int32_t j : whole_.variables().Of(b)) keep(j);
    }
    std::sort(found_.variables.begin(), found_.variables.end());
  }

  [[nodiscard]] bool IsOn(std::int32_t block) const { return block < 0 || on_[At(block)] != 0; }
  [[nodiscard]] bool RowIsOn(std::int32_t i) const { return IsOn(whole_.blocks().row[i]); }
  [[nodiscard]] bool ConeIsOn(std::int32_t c) const { return IsOn(whole_.blocks().cone[c]); }
  [[nodiscard]] std::int32_t ConeOf(std::int32_t row) const {
    return whole_.cone_of_row()[At(row)];
  }

  /// Calls back with the row and value of each entry of column j.
  template <class Take>
  static void EachOf(const sy_csc* m, std::int32_t j, Take&& take) {
    for (std::int32_t k = m != nullptr ? m->start[j] : 0; m != nullptr && k < m->start[j + 1];
         ++k) {
      take(m->row[k], m->value[k]);
    }
  }

  void KeepRowsAndCones() {
    std::vector<std::int32_t> bare_rows = whole_.needy_rows(), bare_cones = whole_.needy_cones();
    for (const std::int32_t j : found_.ones) {
      EachOf(p_.A, j, [&](std::int32_t i, double value) {
        a_.Fix(i, value);
        bare_rows.push_back(i);
      });
      EachOf(p_.F, j, [&](std::int32_t i, double value) {
        f_.Fix(i, value);
        bare_cones.push_back(ConeOf(i));
      });
    }
    for (const std::int32_t j : found_.variables) {
      EachOf(p_.A, j, [&](std::int32_t i, double) {
        if (RowIsOn(i)) a_.Keep(i);
      });
      EachOf(p_.F, j, [&](std::int32_t i, double) {
        if (ConeIsOn(ConeOf(i))) KeepCone(ConeOf(i));
      });
    }
    a_.Number();
    f_.Number();
    for (const std::int32_t i : bare_rows) CheckBareRow(i);
    for (const std::int32_t c : bare_cones) CheckBareCone(c);
  }

  void KeepCone(std::int32_t c) {
    const std::int32_t begin = whole_.cone_begin()[At(c)];
    if (f_.Has(begin)) return;
    cones_.push_back(c);
    for (std::int32_t i = begin; i < begin + p_.cones[c].dim; ++i) f_.Keep(i);
  }

  void CheckBareRow(std::int32_t i) {
    if (a_.Has(i) || !RowIsOn(i)) return;
    const double value = a_.fixed(i);
    const double size = kRounding * (1 + std::abs(value));
    if (value >= Lower(i) - size && value <= Upper(i) + size) return;
    found_.contradiction = "row[" + std::to_string(i) + "] has no variable left and is violated";
  }

  void CheckBareCone(std::int32_t c) {
    const std::int32_t begin = whole_.cone_begin()[At(c)];
    const sy_cone& cone = p_.cones[c];
    if (cone.dim == 0 || f_.Has(begin) || !ConeIsOn(c)) return;
    std::vector<double> s;
    double size = 1;
    for (std::int32_t i = begin; i < begin + cone.dim; ++i) {
      s.push_back(Constant(i));
      size = std::max(size, std::abs(s.back()));
    }
    const double violation = FactsOf(cone.kind).violation(s.data(), cone.dim, cone.parameter);
    if (violation <= kRounding * size) return;
    found_.contradiction = "cone[" + std::to_string(c) + "] has no variable left and is violated";
  }

  [[nodiscard]] double Lower(std::int32_t i) const {
    return p_.row_lower != nullptr ? p_.row_lower[i] : -kInfinity;
  }
  [[nodiscard]] double Upper(std::int32_t i) const {
    return p_.row_upper != nullptr ? p_.row_upper[i] : kInfinity;
  }
  [[nodiscard]] double Constant(std::int32_t cone_row) const {
    return f_.fixed(cone_row) + (p_.g != nullptr ? p_.g[cone_row] : 0.0);
  }

  void TakeSides() {
    ProblemData& d = found_.problem;
    d.A = a_.Columns(p_.A, found_.variables);
    for (const std::int32_t i : a_.rows()) {
      d.row_lower.push_back(Lower(i) - a_.fixed(i));
      d.row_upper.push_back(Upper(i) - a_.fixed(i));
    }
  }

  void TakeCones() {
    ProblemData& d = found_.problem;
    d.F = f_.Columns(p_.F, found_.variables);
    for (const std::int32_t i : f_.rows()) d.g.push_back(Constant(i));
    std::sort(cones_.begin(), cones_.end());
    for (const std::int32_t c : cones_) d.cones.push_back(p_.cones[c]);
  }

  void TakeObjective() {
    ProblemData& d = found_.problem;
    const sy_problem& relaxed = whole_.relaxation();
    d.num_vars = static_cast<std::int32_t>(found_.variables.size());
    d.flags = p_.flags;
    d.offset = p_.offset;
    for (const std::int32_t j : found_.ones) d.offset += p_.q != nullptr ? p_.q[j] : 0.0;
    for (const std::int32_t j : found_.variables) {
      d.q.push_back(p_.q != nullptr ? p_.q[j] : 0.0);
      d.x_lower.push_back(relaxed.x_lower[j]);
      d.x_upper.push_back(relaxed.x_upper[j]);
      d.integer.push_back(p_.integer != nullptr ? p_.integer[j] : std::uint8_t{0});
    }
    d.P = Csc(d.num_vars, d.num_vars);
    if (p_.P != nullptr) TakeCurvature();
  }

  // x'Px/2 with x = (kept, ones): P of what is kept; its products with the ones go to q, theirs
  // with each other to the offset.
  void TakeCurvature() {
    ProblemData& d = found_.problem;
    std::vector<std::int32_t> place(At(p_.num_vars), -1);
    for (std::size_t k = 0; k < found_.variables.size(); ++k) {
      place[At(found_.variables[k])] = static_cast<std::int32_t>(k);
    }
    const auto is_one = [&](std::int32_t j) {
      return std::binary_search(found_.ones.begin(), found_.ones.end(), j);
    };
    std::size_t column = 0;
    for (std::int32_t j = 0; j < p_.num_vars; ++j) {
      const std::int32_t at = place[At(j)];
      EachOf(p_.P, j, [&](std::int32_t i, double value) {
        const std::int32_t row = place[At(i)];
        if (at >= 0 && row >= 0) {
          d.P.row.push_back(row);
          d.P.value.push_back(value);
        } else if (at >= 0 && is_one(i)) {
          d.q[At(at)] += value;
        } else if (row >= 0 && is_one(j)) {
          d.q[At(row)] += value;
        } else if (is_one(i) && is_one(j)) {
          d.offset += i == j ? value / 2 : value;
        }
      });
      if (at >= 0) d.P.start[++column] = static_cast<std::int32_t>(d.P.row.size());
    }
  }

  const PathProblem& whole_;
  const sy_problem& p_;
  std::vector<std::uint8_t> on_;      // of each block
  std::vector<std::uint8_t> fixed_;   // of each variable
  std::vector<std::int32_t> blocks_;  // that are on
  std::vector<std::int32_t> cones_;   // that are kept
  KeptRows a_, f_;
  Restriction found_;
};

}  // namespace

Restriction Restrict(const PathProblem& whole, std::span<const std::int32_t> path) {
  return Restricting(whole, path).Run();
}

std::vector<double> InWhole(const PathProblem& whole, const Restriction& restriction,
                            std::span<const double> x) {
  std::vector<double> point(At(whole.problem().num_vars), 0.0);
  for (const std::int32_t j : restriction.ones) point[At(j)] = 1;
  for (std::size_t k = 0; k < x.size(); ++k) point[At(restriction.variables[k])] = x[k];
  return point;
}

}  // namespace switchyard::rounding
