#include "solvers/rounding/vertex_hull.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/rounding/backend.hpp"
#include "switchyard/boxes.hpp"
#include "switchyard/problem.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kFlow = 1e-4;                // that makes an arc one that is used
constexpr std::size_t kMostVariables = 4000;  // of the program that finds a cut

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The points of a set as a problem over (x, its own variables), without an objective.
Problem PointsOf(const sy_set& set) {
  ProblemData d;
  d.num_vars = set.dim + set.num_aux;
  d.flags = SY_PROBLEM_CONVEX;
  d.q.assign(At(d.num_vars), 0.0);
  d.P = Csc(d.num_vars, d.num_vars);
  const auto section = [&](const sy_csc& by_rows, std::int32_t row, double& constant) {
    std::vector<Entry> entries;
    for (std::int32_t k = by_rows.start[row]; k < by_rows.start[row + 1]; ++k) {
      if (by_rows.row[k] == 0) {
        constant = by_rows.value[k];
      } else {
        entries.push_back({by_rows.row[k] - 1, by_rows.value[k]});
      }
    }
    return entries;
  };
  Rows rows, cone_rows;
  for (std::int32_t i = 0; i < set.num_rows; ++i) {
    double constant = 0;
    rows.push_back(section(*set.At, i, constant));
    d.row_lower.push_back(set.row_lower[i] - constant);
    d.row_upper.push_back(set.row_upper[i] - constant);
  }
  for (std::int32_t i = 0; i < set.num_cone_rows; ++i) {
    double constant = 0;
    cone_rows.push_back(section(*set.Ft, i, constant));
    d.g.push_back(constant);
  }
  d.A = ByColumns(rows, d.num_vars);
  d.F = ByColumns(cone_rows, d.num_vars);
  d.cones.assign(set.cones, set.cones + set.num_cones);
  return Problem(std::move(d));
}

}  // namespace

VertexHull::VertexHull(const PathProblem& whole, const sy_host& host, const Options& options,
                       Budget& budget)
    : whole_(whole),
      host_(host),
      options_(options),
      budget_(budget),
      in_(Reversed(whole.arcs())),
      tail_first_(FirstPoints(whole.paths(), whole.paths().tail)),
      head_first_(FirstPoints(whole.paths(), whole.paths().head)) {}

bool VertexHull::Asks(std::int32_t v, std::span<const double> x) const {
  const sy_paths& paths = whole_.paths();
  if (v == paths.source || v == paths.target || paths.set[v] == nullptr) return false;
  const auto used = [&](std::span<const std::int32_t> arcs) {
    return std::count_if(arcs.begin(), arcs.end(),
                         [&](std::int32_t a) { return x[At(paths.flow[a])] > kFlow; });
  };
  const auto is_known = [&](std::int32_t a) {  // is no column empty?
    const std::int32_t* start = paths.head_point.start + head_first_[At(a)];
    return std::adjacent_find(start, start + paths.dim[v] + 1) == start + paths.dim[v] + 1;
  };
  const auto in = in_.Of(v);
  return used(in) > 1 && used(whole_.out().Of(v)) > 1 &&
         std::all_of(in.begin(), in.end(), is_known);
}

/// One vertex: the elastic program over the arcs that are used, and the row that it gives.
class VertexHull::Separation {
 public:
  Separation(const VertexHull& hull, std::int32_t v, std::span<const double> x)
      : hull_(hull),
        paths_(hull.whole_.paths()),
        set_(*paths_.set[v]),
        x_(x),
        dim_(At(set_.dim)),
        points_(PointsOf(set_)),
        boxes_(ProvenBoxes(points_.view())) {
    const auto list = [&](std::span<const std::int32_t> arcs, const sy_csc& points,
                          const std::vector<std::int32_t>& first, std::vector<Side>& sides) {
      for (const std::int32_t a : arcs) {
        Side side{a, first[At(a)], &points, x_[At(paths_.flow[a])] > kFlow, -1, {}};
        side.multiplier.assign(1 + dim_, 0.0);
        sides.push_back(std::move(side));
      }
    };
    list(hull.in_.Of(v), paths_.head_point, hull.head_first_, in_);
    list(hull.whole_.out().Of(v), paths_.tail_point, hull.tail_first_, out_);
  }

  std::vector<Entry> Run(double tolerance) {
    for (std::size_t j = 0; j < dim_; ++j) {
      CloseBox(j);
      if (!std::isfinite(boxes_.lower[j]) || !std::isfinite(boxes_.upper[j])) return {};
    }
    if (!Solve()) return {};
    Raise();
    return Row(tolerance);
  }

 private:
  /// An arc at this side of the vertex.
  struct Side {
    std::int32_t arc;
    std::int32_t first;  // column of its point
    const sy_csc* points;
    bool used;
    std::int32_t row;                // of its equations in the elastic program
    std::vector<double> multiplier;  // of flow and point
  };
  struct Pair {
    std::size_t in, out;
    std::int32_t first_row, first_cone_row;  // of its copy of the set
  };

  [[nodiscard]] bool Allowed(const Side& in, const Side& out) const {
    return paths_.tail[in.arc] != paths_.head[out.arc];
  }

  // Where the set's rows and cones prove no end, the bounds of its arcs' points do: a path has a
  // point within those of the arcs that it goes by.
  void CloseBox(std::size_t j) {
    const sy_problem& p = hull_.whole_.problem();
    double lower = kInfinity, upper = -kInfinity;
    for (const std::vector<Side>* sides : {&in_, &out_}) {
      for (const Side& side : *sides) {
        double least = 0, most = 0;
        const auto column = At(side.first) + j;
        for (std::int32_t k = side.points->start[column]; k < side.points->start[column + 1]; ++k) {
          const std::int32_t i = side.points->row[k];
          const double one =
              side.points->value[k] * (p.x_lower != nullptr ? p.x_lower[i] : -kInfinity);
          const double other =
              side.points->value[k] * (p.x_upper != nullptr ? p.x_upper[i] : kInfinity);
          least += std::min(one, other);
          most += std::max(one, other);
        }
        lower = std::min(lower, least);
        upper = std::max(upper, most);
      }
    }
    if (!std::isfinite(boxes_.lower[j])) boxes_.lower[j] = lower;
    if (!std::isfinite(boxes_.upper[j])) boxes_.upper[j] = upper;
  }

  /// Flow and point of an arc in x.
  [[nodiscard]] std::vector<double> ValueOf(const Side& side) const {
    std::vector<double> value = {x_[At(paths_.flow[side.arc])]};
    for (std::size_t i = 0; i < dim_; ++i) {
      const auto column = At(side.first) + i;
      double sum = 0;
      for (std::int32_t k = side.points->start[column]; k < side.points->start[column + 1]; ++k) {
        sum += side.points->value[k] * x_[At(side.points->row[k])];
      }
      value.push_back(sum);
    }
    return value;
  }

  bool Solve() {
    AddCopies();
    if (pairs_.empty() || At(d_.num_vars) > kMostVariables) return false;
    AddSlacks();
    d_.q.resize(At(d_.num_vars), 1.0);
    d_.x_lower.resize(At(d_.num_vars), 0.0);
    d_.x_upper.resize(At(d_.num_vars), kInfinity);
    d_.flags = SY_PROBLEM_CONVEX;
    d_.P = Csc(d_.num_vars, d_.num_vars);
    d_.A = ByColumns(rows_, d_.num_vars);
    d_.F = ByColumns(cone_rows_, d_.num_vars);
    d_.g.assign(cone_rows_.size(), 0.0);
    const Problem problem(std::move(d_));
    const char* names = hull_.options_.solver.empty() ? nullptr : hull_.options_.solver.c_str();
    const sy_solver& solver = FindBackend(hull_.host_, problem.view(), names, 1);
    answer_ = SolveBy(solver, hull_.host_, problem.view(), hull_.budget_.Part(1));
    if (answer_.termination != SY_OPTIMAL) return false;
    const auto take = [&](std::vector<Side>& sides) {
      for (Side& side : sides) {  // the row is sum of dual times (value - copies) <= 0
        for (std::size_t i = 0; side.row >= 0 && i <= dim_; ++i) {
          side.multiplier[i] = -answer_.row_dual[At(side.row) + i];
        }
      }
    };
    take(in_);
    take(out_);
    return true;
  }

  // For each allowed pair of used arcs (lambda, w, own) in the set's cone.
  void AddCopies() {
    const std::int32_t columns = 1 + set_.dim + set_.num_aux;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      for (std::size_t k = 0; k < out_.size(); ++k) {
        if (!in_[i].used || !out_[k].used || !Allowed(in_[i], out_[k])) continue;
        pairs_.push_back({i, k, static_cast<std::int32_t>(rows_.size()),
                          static_cast<std::int32_t>(cone_rows_.size())});
        const std::int32_t first = d_.num_vars;
        d_.num_vars += columns;
        d_.q.resize(At(d_.num_vars), 0.0);
        d_.x_lower.resize(At(d_.num_vars), -kInfinity);
        d_.x_upper.resize(At(d_.num_vars), kInfinity);
        d_.x_lower[At(first)] = 0;
        const auto copy = [&](const sy_csc& by_rows, std::int32_t row, Rows& to) {
          std::vector<Entry>& entries = to.emplace_back();
          for (std::int32_t e = by_rows.start[row]; e < by_rows.start[row + 1]; ++e) {
            entries.push_back({first + by_rows.row[e], by_rows.value[e]});
          }
        };
        for (std::int32_t r = 0; r < set_.num_rows; ++r) {
          copy(*set_.At, r, rows_);
          d_.row_lower.push_back(set_.row_lower[r]);
          d_.row_upper.push_back(set_.row_upper[r]);
        }
        for (std::int32_t r = 0; r < set_.num_cone_rows; ++r) copy(*set_.Ft, r, cone_rows_);
        d_.cones.insert(d_.cones.end(), set_.cones, set_.cones + set_.num_cones);
      }
    }
  }

  // sum of copies + up - down = value, for each used arc.
  void AddSlacks() {
    const std::int32_t columns = 1 + set_.dim + set_.num_aux;
    const auto add = [&](std::vector<Side>& sides, bool in) {
      for (std::size_t s = 0; s < sides.size(); ++s) {
        if (!sides[s].used) continue;
        sides[s].row = static_cast<std::int32_t>(rows_.size());
        const std::vector<double> value = ValueOf(sides[s]);
        for (std::size_t i = 0; i <= dim_; ++i) {
          std::vector<Entry>& entries = rows_.emplace_back();
          for (std::size_t p = 0; p < pairs_.size(); ++p) {
            if ((in ? pairs_[p].in : pairs_[p].out) != s) continue;
            entries.push_back(
                {static_cast<std::int32_t>(p) * columns + static_cast<std::int32_t>(i), 1});
          }
          entries.push_back({d_.num_vars++, 1});
          entries.push_back({d_.num_vars++, -1});
          d_.row_lower.push_back(value[i]);
          d_.row_upper.push_back(value[i]);
        }
      }
    };
    add(in_, true);
    add(out_, false);
  }

  /// A proven lower bound of the minimum of c'x over the set, by duals of any quality; none: zeros.
  [[nodiscard]] double LeastOver(const std::vector<double>& c, const double* row_dual,
                                 const double* cone_dual) const {
    std::vector<double> q(At(points_.view().num_vars), 0.0);
    std::copy(c.begin() + 1, c.end(), q.begin());
    sy_problem problem = points_.view();
    problem.q = q.data();
    const auto bound = [&](const double* rows, const double* cones) {
      return SafeDualBound(problem, nullptr, rows, cones, boxes_.lower.data(), boxes_.upper.data())
          .value;
    };
    const double by_box = bound(nullptr, nullptr);
    return row_dual == nullptr ? by_box : std::max(by_box, bound(row_dual, cone_dual));
  }

  void Raise() {
    std::size_t next = 0;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      double lack = 0;
      for (std::size_t k = 0; k < out_.size(); ++k) {
        if (!Allowed(in_[i], out_[k])) continue;
        const bool solved = next < pairs_.size() && pairs_[next].in == i && pairs_[next].out == k;
        std::vector<double> c = in_[i].multiplier;
        for (std::size_t j = 0; j <= dim_; ++j) c[j] += out_[k].multiplier[j];
        const double* rows = solved ? answer_.row_dual.data() + pairs_[next].first_row : nullptr;
        const double* cones =
            solved ? answer_.cone_dual.data() + pairs_[next].first_cone_row : nullptr;
        lack = std::max(lack, -(c[0] + LeastOver(c, rows, cones)));
        if (solved) ++next;
      }
      in_[i].multiplier[0] += lack;
    }
  }

  std::vector<Entry> Row(double tolerance) const {
    std::vector<Entry> row;
    double value = 0, largest = 0;
    for (const std::vector<Side>* sides : {&in_, &out_}) {
      for (const Side& side : *sides) {
        const std::vector<double> at = ValueOf(side);
        for (std::size_t i = 0; i <= dim_; ++i) {
          const double m = side.multiplier[i];
          value += m * at[i];
          largest = std::max(largest, std::abs(m));
          if (m == 0) continue;
          if (i == 0) {
            row.push_back({paths_.flow[side.arc], m});
            continue;
          }
          const auto column = At(side.first) + i - 1;
          for (std::int32_t k = side.points->start[column]; k < side.points->start[column + 1];
               ++k) {
            row.push_back({side.points->row[k], m * side.points->value[k]});
          }
        }
      }
    }
    if (!(value < -tolerance * std::max(largest, 1e-9))) return {};
    for (Entry& e : row) e.value /= largest;
    return row;
  }

  const VertexHull& hull_;
  const sy_paths& paths_;
  const sy_set& set_;
  std::span<const double> x_;
  const std::size_t dim_;
  const Problem points_;
  Boxes boxes_;
  std::vector<Side> in_, out_;
  std::vector<Pair> pairs_;
  ProblemData d_;
  Rows rows_, cone_rows_;
  Answer answer_;
};

std::vector<Entry> VertexHull::Cut(std::int32_t v, std::span<const double> x,
                                   double tolerance) const {
  return Separation(*this, v, x).Run(tolerance);
}

}  // namespace switchyard::rounding
