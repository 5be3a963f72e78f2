#include "solvers/mip/path_pricing.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "solvers/mip/reduced_problem.hpp"
#include "solvers/rounding/backend.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::mip {
namespace {

constexpr double kAccuracy = 1e-7;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

class Pricing {
 public:
  Pricing(const rounding::PathProblem& paths, const rounding::Duals& duals, const NodeBoxes& boxes)
      : paths_(paths), p_(paths.problem()) {
    PriceBlocksOf(boxes);
    KeepRowsAndCones();
    TakeCosts(duals);
    TakeBounds();
  }

  [[nodiscard]] const ProblemData& data() const { return d_; }

  void Replace(const rounding::Answer& priced, rounding::Duals& duals) const {
    Scatter(priced.row_dual, row_kept_, duals.row);
    Scatter(priced.cone_dual, cone_row_kept_, duals.cone);
  }

 private:
  [[nodiscard]] bool IsPriced(std::int32_t block) const { return block >= 0 && priced_[At(block)]; }

  void PriceBlocksOf(const NodeBoxes& boxes) {
    const sy_paths& of = paths_.paths();
    const auto open = [&](std::int32_t arc) { return boxes.upper(of.flow[arc]) >= 1; };
    priced_.assign(At(paths_.blocks().num_blocks), false);
    for (std::int32_t b = 0; b < paths_.blocks().num_blocks; ++b) {
      priced_[At(b)] = of.scale[b] >= 0 && open(of.arc_in[b]) && open(of.arc_out[b]);
    }
  }

  // Their sides are 0 or infinite, and there is no g.
  void KeepRowsAndCones() {
    for (std::int32_t i = 0; i < p_.num_rows; ++i) {
      row_kept_.push_back(IsPriced(paths_.blocks().row[i]) ? 1 : 0);
      if (row_kept_.back() == 0) continue;
      d_.row_lower.push_back(p_.row_lower != nullptr ? p_.row_lower[i] : -kInfinity);
      d_.row_upper.push_back(p_.row_upper != nullptr ? p_.row_upper[i] : kInfinity);
    }
    for (std::int32_t c = 0; c < p_.num_cones; ++c) {
      const bool kept = IsPriced(paths_.blocks().cone[c]);
      cone_row_kept_.insert(cone_row_kept_.end(), At(p_.cones[c].dim), kept ? 1 : 0);
      if (kept) d_.cones.push_back(p_.cones[c]);
    }
    const auto rows_of = [&](const sy_csc* m, const std::vector<std::uint8_t>& kept) {
      return m != nullptr ? KeepRows(Csc(*m), kept) : Csc(0, p_.num_vars);
    };
    d_.A = rows_of(p_.A, row_kept_);
    d_.F = rows_of(p_.F, cone_row_kept_);
    d_.g.assign(At(d_.F.rows), 0.0);
  }

  void TakeCosts(const rounding::Duals& duals) {
    d_.num_vars = p_.num_vars;
    d_.flags = p_.flags;
    d_.P = Csc(p_.num_vars, p_.num_vars);
    d_.q.assign(At(p_.num_vars), 0.0);
    for (std::int32_t j = 0; j < p_.num_vars; ++j) {
      if (!IsPriced(paths_.blocks().x[j])) continue;
      double cost = p_.q != nullptr ? p_.q[j] : 0;
      cost -= Coupling(p_.A, j, duals.row, row_kept_);
      cost -= Coupling(p_.F, j, duals.cone, cone_row_kept_);
      d_.q[At(j)] = cost;
    }
  }

  void TakeBounds() {
    const sy_problem& relaxation = paths_.relaxation();
    d_.x_lower.assign(At(p_.num_vars), 0.0);
    d_.x_upper.assign(At(p_.num_vars), 0.0);
    for (std::int32_t j = 0; j < p_.num_vars; ++j) {
      if (!IsPriced(paths_.blocks().x[j])) continue;
      d_.x_lower[At(j)] = relaxation.x_lower[j];
      d_.x_upper[At(j)] = relaxation.x_upper[j];
    }
    const sy_paths& of = paths_.paths();
    for (std::int32_t b = 0; b < paths_.blocks().num_blocks; ++b) {
      if (!priced_[At(b)]) continue;
      for (const std::int32_t j : {of.scale[b], of.flow[of.arc_in[b]], of.flow[of.arc_out[b]]}) {
        d_.x_lower[At(j)] = d_.x_upper[At(j)] = 1;
      }
    }
  }

  /// Column j of m with duals of rows that are not kept.
  static double Coupling(const sy_csc* m, std::int32_t j, const std::vector<double>& dual,
                         const std::vector<std::uint8_t>& kept) {
    double sum = 0;
    for (std::int32_t k = m != nullptr ? m->start[j] : 0; m != nullptr && k < m->start[j + 1];
         ++k) {
      if (kept[At(m->row[k])] == 0) sum += m->value[k] * dual[At(m->row[k])];
    }
    return sum;
  }

  static void Scatter(const std::vector<double>& from, const std::vector<std::uint8_t>& kept,
                      std::vector<double>& to) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i] != 0) to[i] = from[next++];
    }
  }

  const rounding::PathProblem& paths_;
  const sy_problem& p_;
  std::vector<bool> priced_;  // of each block
  std::vector<std::uint8_t> row_kept_, cone_row_kept_;
  ProblemData d_;
};

}  // namespace

rounding::Duals WithPricedBlocks(const rounding::PathProblem& paths, rounding::Duals duals,
                                 const NodeBoxes& boxes, const sy_solver& solver,
                                 const sy_host& host, rounding::Budget& budget) {
  const Pricing pricing(paths, duals, boxes);
  const Problem problem(pricing.data());
  const ProblemData& d = pricing.data();
  const ReducedProblem reduced(problem.view(), d.x_lower, d.x_upper);
  if (reduced.num_vars() == 0) return duals;
  sy_control control = budget.Part(1);
  control.feasibility = control.optimality = kAccuracy;
  const rounding::Answer priced = rounding::SolveBy(solver, host, reduced.view(), control);
  if (priced.termination == SY_OPTIMAL) pricing.Replace(reduced.Back(priced), duals);
  return duals;
}

}  // namespace switchyard::mip
