#include "solvers/conic/form.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "solvers/cones/kinds.hpp"

namespace switchyard::conic {
namespace {

constexpr double kEighth = 0.70710678118654752440;  // cos of an eighth of a turn
constexpr double kLeast = 1e-4, kMost = 1e4;        // norms that are scaled away at once

double LowerOf(const ProblemData& d, Index j) {
  return d.x_lower.empty() ? -kInfinity : d.x_lower[j];
}
double UpperOf(const ProblemData& d, Index j) {
  return d.x_upper.empty() ? kInfinity : d.x_upper[j];
}

/// Members in the order of their class, the given order within each.
template <class ClassOf>
std::vector<Index> SortedBy(Index count, int classes, ClassOf&& class_of) {
  std::vector<std::vector<Index>> members(classes);
  for (Index i = 0; i < count; ++i) {
    if (const int c = class_of(i); c >= 0) members[c].push_back(i);
  }
  std::vector<Index> all;
  for (const auto& m : members) all.insert(all.end(), m.begin(), m.end());
  return all;
}

}  // namespace

Form::Form(const ProblemData& d) : offset(d.offset) {
  SortVariables(d);
  SortCones(d);
  SortRows(d);
  std::vector<Index> place(d.num_vars);
  for (Index k = 0; k < d.num_vars; ++k) place[variable[k]] = k;
  TakeP(d, place);
  TakeA(d, place);
  TakeSides(d);
  Equilibrate();
}

void Form::SortVariables(const ProblemData& d) {
  enum { kBoxed, kBelow, kFree, kClasses };
  const auto class_of = [&](Index j) -> int {
    const bool below = std::isfinite(LowerOf(d, j)), above = std::isfinite(UpperOf(d, j));
    return below && above ? kBoxed : below || above ? kBelow : kFree;
  };
  variable = SortedBy(d.num_vars, kClasses, class_of);
  shape.vars = d.num_vars;
  column_scale.resize(d.num_vars);
  for (Index k = 0; k < d.num_vars; ++k) {
    const Index j = variable[k];
    const int sort = class_of(j);
    shape.boxed += sort == kBoxed ? 1 : 0;
    shape.bounded += sort != kFree ? 1 : 0;
    column_scale[k] = sort == kBelow && !std::isfinite(LowerOf(d, j)) ? -1 : 1;
  }
}

// Equal cones side by side, as many as their kind takes; what is left over one by one. Groups are
// what threads share.
void Form::SortCones(const ProblemData& d) {
  using Key = std::tuple<sy_cone_kind, Index, double>;
  std::map<Key, std::vector<Index>> alike;  // their first rows
  Index row = 0;
  for (const sy_cone& cone : d.cones) {
    const Index first = row;
    row += cone.dim;
    if (cone.kind == SY_CONE_ZERO || cone.kind == SY_CONE_NONNEGATIVE || cone.dim == 0) continue;
    const bool is_rotated = cone.kind == SY_CONE_ROTATED;
    if (is_rotated) rotated.push_back(first);
    alike[{is_rotated ? SY_CONE_SECOND_ORDER : cone.kind, cone.dim, cone.parameter}].push_back(
        first);
  }
  constexpr std::size_t kTogether = 512;  // cones of a group, at most
  const auto add = [&](const Key& key, const std::vector<Index>& firsts, std::size_t begin,
                       std::size_t end, Index lanes) {
    const auto [kind, dim, parameter] = key;
    ConeGroup group{
        kind, parameter, {static_cast<Index>(end - begin), dim, lanes}, shape.cone_rows};
    source.resize(shape.cone_rows + group.layout.rows());
    for (Index c = 0; c < group.layout.count; ++c) {
      for (Index i = 0; i < dim; ++i) {
        source[group.first + group.layout.Row(c, i)] = ~(firsts[begin + c] + i);
      }
    }
    shape.cone_rows += group.layout.rows();
    cones.push_back(group);
  };
  const auto each_group = [&](const Key& key, const std::vector<Index>& firsts, std::size_t begin,
                              std::size_t end, Index lanes) {
    for (; begin < end; begin += kTogether) {
      add(key, firsts, begin, std::min(end, begin + kTogether), lanes);
    }
  };
  for (const bool side_by_side : {true, false}) {  // those on cache lines first
    for (const auto& [key, firsts] : alike) {
      const auto lanes = static_cast<std::size_t>(cones::FindKind(std::get<0>(key))->lanes);
      const std::size_t whole = lanes > 1 ? firsts.size() / lanes * lanes : 0;
      if (side_by_side) {
        each_group(key, firsts, 0, whole, static_cast<Index>(lanes));
      } else {
        each_group(key, firsts, whole, firsts.size(), 1);
      }
    }
  }
}

void Form::SortRows(const ProblemData& d) {
  enum { kRange, kInequality, kEquation, kClasses };
  std::vector<Index> linear_cone_rows;  // of cones that are rows
  std::vector<sy_cone_kind> kind;
  Index row = 0;
  for (const sy_cone& cone : d.cones) {
    for (Index i = 0; i < cone.dim; ++i, ++row) {
      if (cone.kind != SY_CONE_ZERO && cone.kind != SY_CONE_NONNEGATIVE) continue;
      linear_cone_rows.push_back(row);
      kind.push_back(cone.kind);
    }
  }
  const Index count = d.num_rows();
  const auto class_of = [&](Index i) -> int {
    if (i >= count) return kind[i - count] == SY_CONE_ZERO ? kEquation : kInequality;
    const bool below = std::isfinite(d.row_lower[i]), above = std::isfinite(d.row_upper[i]);
    if (below && above) return d.row_lower[i] == d.row_upper[i] ? kEquation : kRange;
    return below || above ? kInequality : -1;
  };
  const auto all = static_cast<Index>(count + linear_cone_rows.size());
  row_scale.assign(source.size(), 1.0);
  for (const Index i : SortedBy(all, kClasses, class_of)) {
    const int sort = class_of(i);
    shape.ranges += sort == kRange ? 1 : 0;
    shape.inequalities += sort != kEquation ? 1 : 0;
    shape.equations += sort == kEquation ? 1 : 0;
    source.push_back(i < count ? i : ~linear_cone_rows[i - count]);
    const bool from_above = i < count && sort == kInequality && !std::isfinite(d.row_lower[i]);
    row_scale.push_back(from_above ? -1 : 1);
  }
}

void Form::TakeP(const ProblemData& d, const std::vector<Index>& place) {
  P.pattern.n = d.num_vars;
  P.pattern.start = {0};
  std::vector<std::vector<std::pair<Index, double>>> columns(d.num_vars);
  for (Index j = 0; j < d.num_vars; ++j) {
    for (Index k = d.P.start[j]; k < d.P.start[j + 1]; ++k) {
      const Index a = place[d.P.row[k]], c = place[j];
      const double sign = column_scale[a] * column_scale[c];
      columns[std::max(a, c)].emplace_back(std::min(a, c), sign * d.P.value[k]);
    }
  }
  for (auto& column : columns) {
    std::sort(column.begin(), column.end());
    for (const auto& [i, value] : column) {
      P.pattern.row.push_back(i);
      P.value.push_back(value);
    }
    P.pattern.start.push_back(static_cast<Index>(P.value.size()));
  }
}

void Form::TakeA(const ProblemData& d, const std::vector<Index>& place) {
  const Csc at = Transpose(d.A.View()), ft = Transpose(d.F.View());
  std::vector<double> turn(d.num_cone_rows(),
                           0.0);  // of rows of rotated cones: what the partner is
  for (const Index first : rotated) {
    turn[first] = 1;       // the next row is added
    turn[first + 1] = -1;  // this row is taken from the one before
  }
  std::vector<std::pair<Index, double>> entries;
  const auto take = [&](const Csc& t, Index i, double factor) {
    for (Index k = t.start[i]; k < t.start[i + 1]; ++k) {
      const Index j = place[t.row[k]];
      entries.emplace_back(j, factor * column_scale[j] * t.value[k]);
    }
  };
  A.rows = shape.rows();
  A.cols = d.num_vars;
  for (Index r = 0; r < A.rows; ++r) {
    entries.clear();
    const Index from = source[r];
    if (from >= 0) {
      take(at, from, row_scale[r]);
    } else if (turn[~from] == 0) {
      take(ft, ~from, 1);
    } else {
      take(ft, turn[~from] > 0 ? ~from : ~from - 1, kEighth);
      take(ft, turn[~from] > 0 ? ~from + 1 : ~from, turn[~from] * kEighth);
    }
    std::sort(entries.begin(), entries.end(),
              [](const auto& a, const auto& c) { return a.first < c.first; });
    const std::size_t row_begin = A.column.size();
    for (const auto& [j, value] : entries) {
      if (A.column.size() > row_begin && A.column.back() == j) {
        A.by_row.back() += value;
      } else {
        A.column.push_back(j);
        A.by_row.push_back(value);
      }
    }
    A.row_start.push_back(static_cast<Index>(A.column.size()));
  }
}

void Form::TakeSides(const ProblemData& d) {
  q.resize(shape.vars);
  lower.resize(shape.bounded);
  upper.resize(shape.boxed);
  for (Index k = 0; k < shape.vars; ++k) {
    const Index j = variable[k];
    q[k] = column_scale[k] * d.q[j];
    if (k < shape.bounded) lower[k] = column_scale[k] > 0 ? LowerOf(d, j) : -UpperOf(d, j);
    if (k < shape.boxed) upper[k] = UpperOf(d, j);
  }
  b.resize(shape.rows());
  range_top.resize(shape.ranges);
  for (Index r = 0; r < shape.rows(); ++r) {
    const Index from = source[r];
    if (from < 0) {
      b[r] = -d.g[~from];
    } else {
      b[r] = row_scale[r] > 0 ? d.row_lower[from] : -d.row_upper[from];
      const Index range = r - shape.cone_rows;
      if (range >= 0 && range < shape.ranges) range_top[range] = d.row_upper[from];
    }
  }
  std::vector<Index> place(d.g.size(), -1);
  for (Index r = 0; r < shape.cone_rows; ++r) place[~source[r]] = r;
  for (const Index first : rotated) {
    double& b0 = b[place[first]];
    double& b1 = b[place[first + 1]];
    const double sum = kEighth * (b0 + b1), difference = kEighth * (b0 - b1);
    b0 = sum;
    b1 = difference;
  }
}

namespace {

/// The largest entries of rows and columns of [P A'; A 0] with rows and columns scaled; rows of a
/// cone have that of the cone.
struct Norms {
  Vector row, column;
  [[nodiscard]] bool AreEven() const {
    const auto is_even = [](double norm) { return norm == 0 || std::abs(std::log2(norm)) < 0.5; };
    return std::ranges::all_of(row, is_even) && std::ranges::all_of(column, is_even);
  }
  void Measure(const Form& f, const Vector& rows, const Vector& columns) {
    column.assign(f.shape.vars, 0.0);
    row.assign(f.shape.rows(), 0.0);
    for (Index i = 0; i < f.A.rows; ++i) {
      for (Index k = f.A.row_start[i]; k < f.A.row_start[i + 1]; ++k) {
        const Index j = f.A.column[k];
        const double size = std::abs(f.A.by_row[k]) * rows[i] * columns[j];
        row[i] = std::max(row[i], size);
        column[j] = std::max(column[j], size);
      }
    }
    for (Index j = 0; j < f.shape.vars; ++j) {
      for (Index k = f.P.pattern.start[j]; k < f.P.pattern.start[j + 1]; ++k) {
        const Index i = f.P.pattern.row[k];
        const double size = std::abs(f.P.value[k]) * columns[i] * columns[j];
        column[i] = std::max(column[i], size);
        column[j] = std::max(column[j], size);
      }
    }
    for (const ConeGroup& group : f.cones) {
      for (Index c = 0; c < group.layout.count; ++c) {
        double largest = 0;
        for (Index i = 0; i < group.layout.dim; ++i) {
          largest = std::max(largest, row[group.first + group.layout.Row(c, i)]);
        }
        for (Index i = 0; i < group.layout.dim; ++i) {
          row[group.first + group.layout.Row(c, i)] = largest;
        }
      }
    }
  }
};

}  // namespace

// Rows and columns brought to a largest entry of about 1 (Ruiz, A scaling algorithm to equilibrate
// both rows and columns norms in matrices, 2001); rows of a cone together.
void Form::Equilibrate() {
  constexpr int kPasses = 10;
  Vector columns(shape.vars, 1.0), rows(shape.rows(), 1.0);
  const auto factor = [](double norm) {
    return norm > 0 ? 1 / std::sqrt(std::clamp(norm, kLeast, kMost)) : 1.0;
  };
  Norms norms;
  for (int pass = 0; pass < kPasses; ++pass) {
    norms.Measure(*this, rows, columns);
    if (norms.AreEven()) break;
    for (Index i = 0; i < shape.rows(); ++i) rows[i] *= factor(norms.row[i]);
    for (Index j = 0; j < shape.vars; ++j) columns[j] *= factor(norms.column[j]);
  }
  Scale(rows, columns);
}

void Form::Scale(const Vector& rows, const Vector& columns) {
  for (Index i = 0; i < A.rows; ++i) {
    for (Index k = A.row_start[i]; k < A.row_start[i + 1]; ++k) {
      A.by_row[k] *= rows[i] * columns[A.column[k]];
    }
    b[i] *= rows[i];
    row_scale[i] *= rows[i];
  }
  for (Index k = 0; k < shape.ranges; ++k) range_top[k] *= rows[shape.cone_rows + k];
  double largest_q = 0, largest_p = 0;
  for (Index j = 0; j < shape.vars; ++j) {
    q[j] *= columns[j];
    largest_q = std::max(largest_q, std::abs(q[j]));
    column_scale[j] *= columns[j];
    if (j < shape.bounded) lower[j] /= columns[j];
    if (j < shape.boxed) upper[j] /= columns[j];
    for (Index k = P.pattern.start[j]; k < P.pattern.start[j + 1]; ++k) {
      P.value[k] *= columns[P.pattern.row[k]] * columns[j];
      largest_p = std::max(largest_p, std::abs(P.value[k]));
    }
  }
  const double largest = std::max(largest_q, largest_p);
  if (largest > 0) objective_scale = 1 / std::clamp(largest, kLeast, kMost);
  for (double& v : q) v *= objective_scale;
  for (double& v : P.value) v *= objective_scale;
  A.IndexColumns();
}

bool Form::SamePattern(const Form& other) const {
  return shape == other.shape && cones == other.cones && P.pattern.start == other.P.pattern.start &&
         P.pattern.row == other.P.pattern.row && A.row_start == other.A.row_start &&
         A.column == other.A.column;
}

void Form::PointBack(const Vector& x, double* original) const {
  for (Index k = 0; k < shape.vars; ++k) original[variable[k]] = column_scale[k] * x[k];
}

Vector Form::PointForth(const double* original) const {
  Vector x(shape.vars);
  for (Index k = 0; k < shape.vars; ++k) x[k] = original[variable[k]] / column_scale[k];
  return x;
}

Vector Form::RowDualsForth(const double* row_dual, const double* cone_dual) const {
  Vector y(shape.rows());
  std::vector<Index> place;  // of the first two rows of rotated cones
  for (Index r = 0; r < shape.rows(); ++r) {
    const Index from = source[r];
    y[r] = (from >= 0 ? row_dual[from] : cone_dual[~from]) * objective_scale / row_scale[r];
  }
  place.assign(rotated.empty() ? 0 : *std::ranges::max_element(rotated) + 2, -1);
  for (Index r = 0; r < shape.cone_rows; ++r) {
    if (static_cast<std::size_t>(~source[r]) < place.size()) place[~source[r]] = r;
  }
  for (const Index first : rotated) {
    double& y0 = y[place[first]];
    double& y1 = y[place[first + 1]];
    const double sum = kEighth * (y0 + y1);
    y1 = kEighth * (y0 - y1);
    y0 = sum;
  }
  return y;
}

void Form::DualsBack(const Vector& y, const Vector& bounds, double* x_dual, double* row_dual,
                     double* cone_dual, Index num_vars, Index num_rows, Index num_cone_rows) const {
  std::fill_n(x_dual, num_vars, 0.0);
  std::fill_n(row_dual, num_rows, 0.0);
  std::fill_n(cone_dual, num_cone_rows, 0.0);
  for (Index k = 0; k < shape.vars; ++k) {
    x_dual[variable[k]] = bounds[k] / (column_scale[k] * objective_scale);
  }
  for (Index r = 0; r < shape.rows(); ++r) {
    const double dual = y[r] * row_scale[r] / objective_scale;
    if (source[r] >= 0) {
      row_dual[source[r]] = dual;
    } else {
      cone_dual[~source[r]] = dual;
    }
  }
  for (const Index first : rotated) {
    const double sum = kEighth * (cone_dual[first] + cone_dual[first + 1]);
    cone_dual[first + 1] = kEighth * (cone_dual[first] - cone_dual[first + 1]);
    cone_dual[first] = sum;
  }
}

}  // namespace switchyard::conic
