#include "solvers/presolve/undo.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard::presolve {
namespace {

struct PointsBack {
  Meaning meaning;
  const std::vector<Entry>& pool;
  std::vector<double>& x;

  // A direction has no constants.
  [[nodiscard]] double Constant(double v) const {
    return meaning == Meaning::kRay && std::isfinite(v) ? 0 : v;
  }
  void operator()(const FixedColumn& f) const { x[f.gone.column] = Constant(f.value); }
  void operator()(const FreeColumn& f) const {
    double rest = 0;
    for (std::size_t k = 0; k < f.others.count; ++k) {
      const Entry& e = pool[f.others.first + k];
      rest += e.value * x[e.column];
    }
    const double side = std::clamp(rest, Constant(f.lower), Constant(f.upper));
    x[f.gone.column] = (side - rest) / f.coefficient;
  }
  template <class Other>
  void operator()(const Other&) const {}
};

struct DualsBack {
  Meaning meaning;
  const std::vector<Entry>& pool;
  const std::vector<double>& curved;
  const std::vector<double>& z;
  std::vector<double>& y;
  std::vector<double>& x_dual;

  /// What is left of stationarity in a column.
  [[nodiscard]] double Left(const GoneColumn& gone) const {
    double left = meaning == Meaning::kContradiction ? 0 : gone.cost + curved[gone.column];
    for (std::size_t k = 0; k < gone.entries.count; ++k) {
      const Entry& e = pool[gone.entries.first + k];
      left -= e.value * (e.column >= 0 ? y[e.column] : z[~e.column]);
    }
    return left;
  }
  void operator()(const FixedColumn& f) const { x_dual[f.gone.column] = Left(f.gone); }
  void operator()(const SingletonRow& s) const {
    double& d = x_dual[s.column];
    if ((d > 0 && s.lower) || (d < 0 && s.upper)) {
      y[s.row] = d / s.coefficient;
      d = 0;
    }
  }
  void operator()(const FreeColumn& f) const {
    y[f.row] = Left(f.gone) / f.coefficient;
    x_dual[f.gone.column] = 0;
  }
  void operator()(const ParallelRow& p) const {
    double& kept = y[p.kept];
    if ((kept > 0 && p.lower) || (kept < 0 && p.upper)) {
      y[p.row] = kept / p.factor;
      kept = 0;
    }
  }
  // The least multiplier under which every variable of the row has a dual of the right sign.
  void operator()(const ForcingRow& f) const {
    double multiplier = 0;
    for (std::size_t k = 0; k < f.entries.count; ++k) {
      const Entry& e = pool[f.entries.first + k];
      const double ratio = x_dual[e.column] / e.value;
      multiplier = f.at_upper ? std::min(multiplier, ratio) : std::max(multiplier, ratio);
    }
    y[f.row] = multiplier;
    for (std::size_t k = 0; k < f.entries.count; ++k) {
      const Entry& e = pool[f.entries.first + k];
      double& d = x_dual[e.column];
      d -= e.value * multiplier;
      // But for rounding the sign is right: the other side may be infinite.
      d = f.at_upper == (e.value > 0) ? std::max(d, 0.0) : std::min(d, 0.0);
    }
  }
};

}  // namespace

void UndoList::Points(Meaning meaning, std::vector<double>& x) const {
  const PointsBack back{meaning, pool_, x};
  for (std::size_t k = steps_.size(); k-- > 0;) std::visit(back, steps_[k]);
}

void UndoList::Duals(Meaning meaning, const std::vector<double>& curved,
                     const std::vector<double>& z, std::vector<double>& y,
                     std::vector<double>& x_dual) const {
  const DualsBack back{meaning, pool_, curved, z, y, x_dual};
  for (std::size_t k = steps_.size(); k-- > 0;) std::visit(back, steps_[k]);
}

}  // namespace switchyard::presolve
