#include "solvers/presolve/split_cones.hpp"

#include <algorithm>
#include <utility>

namespace switchyard::presolve {
namespace {

using Index = std::int32_t;

enum class Fate { kRows, kSumAndDifference, kTurned, kStays, kGone };

Fate FateOf(const ProblemData& d, std::size_t number) {
  if (!d.cone_on.empty() && d.cone_on[number] == 0) return Fate::kGone;
  const sy_cone& cone = d.cones[number];
  switch (cone.kind) {
    case SY_CONE_ZERO:
    case SY_CONE_NONNEGATIVE:
      return Fate::kRows;
    case SY_CONE_SECOND_ORDER:
      return cone.dim == 1 ? Fate::kRows : cone.dim == 2 ? Fate::kSumAndDifference : Fate::kStays;
    case SY_CONE_ROTATED:
      return cone.dim == 2 ? Fate::kRows : Fate::kStays;
    case SY_CONE_PSD:
      return cone.dim == 1 ? Fate::kRows : cone.dim == 3 ? Fate::kTurned : Fate::kStays;
    default:
      return Fate::kStays;
  }
}

/// Rows of F put together: row r of the result is sum over terms (row of F, factor).
struct Combined {
  struct Term {
    Index row;
    double factor;
  };
  std::vector<Term> first, second;  // of each row; the second may have the factor 0

  void Add(Term a, Term b = {0, 0}) {
    first.push_back(a);
    second.push_back(b);
  }
  [[nodiscard]] double Of(const std::vector<double>& v, std::size_t r) const {
    return first[r].factor * v[first[r].row] +
           (second[r].factor != 0 ? second[r].factor * v[second[r].row] : 0);
  }
  [[nodiscard]] Csc Of(const Csc& F) const;
};

Csc Combined::Of(const Csc& F) const {
  // By rows of F: where each goes.
  std::vector<std::vector<Term>> to(F.rows);
  for (std::size_t r = 0; r < first.size(); ++r) {
    to[first[r].row].push_back({static_cast<Index>(r), first[r].factor});
    if (second[r].factor != 0) {
      to[second[r].row].push_back({static_cast<Index>(r), second[r].factor});
    }
  }
  Csc made(static_cast<Index>(first.size()), F.cols);
  std::vector<double> value(first.size(), 0.0);
  std::vector<Index> touched;
  std::vector<Index> touched_by(first.size(), -1);  // the last column
  for (Index j = 0; j < F.cols; ++j) {
    touched.clear();
    for (Index k = F.start[j]; k < F.start[j + 1]; ++k) {
      for (const Term& t : to[F.row[k]]) {
        if (touched_by[t.row] != j) touched.push_back(t.row);
        touched_by[t.row] = j;
        value[t.row] += t.factor * F.value[k];
      }
    }
    std::sort(touched.begin(), touched.end());
    for (const Index r : touched) {
      made.row.push_back(r);
      made.value.push_back(value[r]);
      value[r] = 0;
    }
    made.start[j + 1] = static_cast<Index>(made.row.size());
  }
  return made;
}

struct Parts {
  Combined linear, conic;
  std::vector<std::uint8_t> equation;  // of each linear row
  std::vector<sy_cone> cones;
};

Parts PartsOf(const ProblemData& d) {
  Parts parts;
  Index row = 0;
  for (std::size_t number = 0; number < d.cones.size(); ++number) {
    const sy_cone& cone = d.cones[number];
    switch (FateOf(d, number)) {
      case Fate::kRows:
        for (Index i = 0; i < cone.dim; ++i) parts.linear.Add({row + i, 1});
        break;
      case Fate::kSumAndDifference:
        parts.linear.Add({row, 1}, {row + 1, 1});
        parts.linear.Add({row, 1}, {row + 1, -1});
        break;
      case Fate::kTurned:
        parts.conic.Add({row, 1});
        parts.conic.Add({row + 2, 1});
        parts.conic.Add({row + 1, 1});
        parts.cones.push_back({SY_CONE_ROTATED, 3, 0});
        break;
      case Fate::kStays:
        for (Index i = 0; i < cone.dim; ++i) parts.conic.Add({row + i, 1});
        parts.cones.push_back(cone);
        break;
      case Fate::kGone:
        break;
    }
    parts.equation.resize(parts.linear.first.size(), cone.kind == SY_CONE_ZERO ? 1 : 0);
    row += cone.dim;
  }
  return parts;
}

}  // namespace

ConesSplit SplitCones(const ProblemData& d) {
  bool whole = true;
  for (std::size_t k = 0; k < d.cones.size(); ++k) whole = whole && FateOf(d, k) == Fate::kStays;
  if (whole) return {Csc(0, d.num_vars), {}, {}, {}, d.F, d.g, d.cones};
  Parts parts = PartsOf(d);
  ConesSplit made{parts.linear.Of(d.F),  {}, {}, {}, parts.conic.Of(d.F), {},
                  std::move(parts.cones)};
  for (std::size_t r = 0; r < parts.equation.size(); ++r) {
    made.source.push_back(parts.linear.first[r].row);
    made.lower.push_back(-parts.linear.Of(d.g, r));
    made.upper.push_back(parts.equation[r] != 0 ? made.lower.back() : kInfinity);
  }
  for (std::size_t r = 0; r < parts.conic.first.size(); ++r) {
    made.g.push_back(parts.conic.Of(d.g, r));
  }
  return made;
}

void ConeDualsBack(const ProblemData& d, const double* linear, const double* conic,
                   std::vector<double>& cone_dual) {
  const Parts parts = PartsOf(d);
  cone_dual.assign(d.g.size(), 0.0);
  const auto spread = [&](const Combined& combined, const double* dual) {
    for (std::size_t r = 0; r < combined.first.size(); ++r) {
      cone_dual[combined.first[r].row] += combined.first[r].factor * dual[r];
      if (combined.second[r].factor != 0) {
        cone_dual[combined.second[r].row] += combined.second[r].factor * dual[r];
      }
    }
  };
  spread(parts.linear, linear);
  spread(parts.conic, conic);
}

std::vector<double> ConicDuals(const ProblemData& d, const std::vector<double>& cone_dual) {
  const Parts parts = PartsOf(d);
  std::vector<double> duals;
  for (const auto& term : parts.conic.first) duals.push_back(term.factor * cone_dual[term.row]);
  return duals;
}

}  // namespace switchyard::presolve
