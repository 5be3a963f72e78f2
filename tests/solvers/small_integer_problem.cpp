#include "tests/solvers/small_integer_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace switchyard::test {
namespace {

constexpr double kExact = 1e-9;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

double Dot(const std::vector<double>& a, const std::vector<double>& x) {
  return std::inner_product(x.begin(), x.end(), a.begin(), 0.0);
}

/// The rows of a dense matrix, as columns.
Csc ByColumns(const std::vector<std::vector<double>>& rows, std::int32_t cols) {
  Csc m(static_cast<std::int32_t>(rows.size()), cols);
  for (std::int32_t j = 0; j < cols; ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i][At(j)] == 0) continue;
      m.row.push_back(static_cast<std::int32_t>(i));
      m.value.push_back(rows[i][At(j)]);
    }
    m.start[At(j) + 1] = static_cast<std::int32_t>(m.row.size());
  }
  return m;
}

}  // namespace

SmallIntegerProblem::SmallIntegerProblem(IntegerKind kind, std::uint64_t seed) : random_(seed) {
  num_integers_ = 2 + static_cast<std::int32_t>(random_.Uniform() * 7);
  num_continuous_ = static_cast<std::int32_t>(random_.Uniform() * 3);
  DrawBoxes();
  DrawObjective(kind);
  if (kind == IntegerKind::kConic) DrawCone();
  DrawRows();
  Seal();
}

double SmallIntegerProblem::Whole(int size) {
  return std::floor(random_.Uniform() * (2 * size + 1)) - size;
}

void SmallIntegerProblem::DrawBoxes() {
  const int widest = num_integers_ <= 4 ? 6 : num_integers_ <= 6 ? 3 : 1;
  for (std::int32_t j = 0; j < num_integers_ + num_continuous_; ++j) {
    const bool integer = j < num_integers_;
    const double width = integer ? 1 + std::floor(random_.Uniform() * widest) : 10;
    lower_.push_back(widest == 1 ? 0 : Whole(3));
    upper_.push_back(lower_.back() + width);
    point_.push_back(lower_.back() + std::floor(random_.Uniform() * (width + 1)));
  }
}

void SmallIntegerProblem::DrawObjective(IntegerKind kind) {
  for (std::size_t j = 0; j < lower_.size(); ++j) q_.push_back(Whole(9));
  curvature_.assign(lower_.size(), 0.0);
  if (kind != IntegerKind::kQuadratic) return;
  for (int i = 0; i < 3; ++i) {
    auto& row = g_.emplace_back(lower_.size(), 0.0);
    for (std::int32_t j = 0; j < num_integers_; ++j) row[At(j)] = Whole(2);
  }
  for (std::int32_t j = num_integers_; j < num_integers_ + num_continuous_; ++j) {
    curvature_[At(j)] = std::floor(random_.Uniform() * 3);
  }
}

void SmallIntegerProblem::DrawRows() {
  const int count = 1 + static_cast<int>(random_.Uniform() * 4);
  for (int i = 0; i < count; ++i) {
    Row row{std::vector<double>(lower_.size(), 0.0), -kInfinity, kInfinity};
    for (std::int32_t j = 0; j < num_integers_; ++j) {
      if (random_.Uniform() < 0.7) row.a[At(j)] = Whole(5);
    }
    if (num_continuous_ > 0 && random_.Uniform() < 0.5) {
      const auto t = static_cast<std::int32_t>(random_.Uniform() * num_continuous_);
      row.a[At(num_integers_ + t)] = Whole(3);
    }
    const double at = Dot(row.a, point_) + (random_.Uniform() < 0.1 ? Whole(4) : 0);
    const double kind = random_.Uniform();
    if (kind < 0.6) row.upper = at + std::floor(random_.Uniform() * 3);
    if (kind > 0.4) row.lower = at - (kind < 0.6 ? 0 : std::floor(random_.Uniform() * 3));
    if (kind > 0.85) row.lower = row.upper = at;
    rows_.push_back(row);
  }
  boxed_by_row_.assign(lower_.size(), 0);
  for (std::int32_t j = 0; j < num_integers_; ++j) {
    if (random_.Uniform() > 0.15) continue;
    Row box{std::vector<double>(lower_.size(), 0.0), lower_[At(j)], upper_[At(j)]};
    box.a[At(j)] = 1;
    rows_.push_back(box);
    boxed_by_row_[At(j)] = 1;
  }
}

void SmallIntegerProblem::DrawCone() {
  double tail = 0;
  for (int i = 0; i < 3; ++i) {
    Row row{std::vector<double>(lower_.size(), 0.0), 0, 0};
    for (std::int32_t j = 0; i > 0 && j < num_integers_; ++j) {
      row.a[At(j)] = 2 * random_.Uniform() - 1;
    }
    row.lower = 2 * random_.Uniform() - 1;
    if (i > 0) tail = std::hypot(tail, Dot(row.a, point_) + row.lower);
    cone_.push_back(row);
  }
  if (num_continuous_ > 0) {
    cone_[0].a[At(num_integers_)] = 1;
    cone_[0].lower = tail - point_[At(num_integers_)] + random_.Uniform();
  } else {
    cone_[0].lower = tail + random_.Uniform();
  }
}

void SmallIntegerProblem::Seal() {
  ProblemData d;
  const auto n = static_cast<std::int32_t>(lower_.size());
  d.num_vars = n;
  d.flags = SY_PROBLEM_CONVEX;
  d.q = q_;
  d.x_lower = lower_;
  d.x_upper = upper_;
  for (std::size_t j = 0; j < lower_.size(); ++j) {
    if (boxed_by_row_[j] == 0) continue;
    d.x_lower[j] = -kInfinity;
    d.x_upper[j] = kInfinity;
  }
  d.integer.assign(At(n), 0);
  std::fill_n(d.integer.begin(), num_integers_, std::uint8_t{1});
  std::vector<std::vector<double>> p(At(n), std::vector<double>(At(n), 0.0));
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i][i] = curvature_[i];
    for (std::size_t j = i; j < p.size(); ++j) {
      for (const auto& g : g_) p[i][j] += g[i] * g[j];
    }
  }
  d.P = ByColumns(p, n);
  std::vector<std::vector<double>> a, f;
  for (const Row& row : rows_) {
    a.push_back(row.a);
    d.row_lower.push_back(row.lower);
    d.row_upper.push_back(row.upper);
  }
  for (const Row& row : cone_) {
    f.push_back(row.a);
    d.g.push_back(row.lower);
  }
  d.A = ByColumns(a, n);
  d.F = ByColumns(f, n);
  if (!cone_.empty()) d.cones = {{SY_CONE_SECOND_ORDER, 3, 0}};
  problem_ = Problem(d);
}

bool SmallIntegerProblem::NarrowByRow(const Row& row, const std::vector<double>& x,
                                      std::vector<double>& lower,
                                      std::vector<double>& upper) const {
  const double fixed = Dot(row.a, x);  // x has zeros for what is continuous
  const auto t =
      std::find_if(row.a.begin() + num_integers_, row.a.end(), [](double v) { return v != 0; });
  if (t == row.a.end()) return fixed >= row.lower - kExact && fixed <= row.upper + kExact;
  const auto k = static_cast<std::size_t>(t - row.a.begin());
  const double one = (row.lower - fixed) / *t, other = (row.upper - fixed) / *t;
  lower[k] = std::max(lower[k], std::min(one, other));
  upper[k] = std::min(upper[k], std::max(one, other));
  return true;
}

double SmallIntegerProblem::OptimumOfRest(const std::vector<double>& x) const {
  std::vector<double> z = x, lower = lower_, upper = upper_;
  std::fill(z.begin() + num_integers_, z.end(), 0.0);
  for (std::size_t j = 0; j < At(num_integers_); ++j) {
    if (z[j] < lower[j] || z[j] > upper[j]) return kInfinity;
  }
  for (const Row& row : rows_) {
    if (!NarrowByRow(row, z, lower, upper)) return kInfinity;
  }
  if (!cone_.empty()) {
    Row head = cone_[0];
    head.lower =
        std::hypot(Dot(cone_[1].a, z) + cone_[1].lower, Dot(cone_[2].a, z) + cone_[2].lower) -
        cone_[0].lower;
    head.upper = kInfinity;
    if (!NarrowByRow(head, z, lower, upper)) return kInfinity;
  }
  double objective = Dot(q_, z);
  for (const auto& g : g_) objective += 0.5 * Dot(g, z) * Dot(g, z);
  for (std::size_t j = At(num_integers_); j < z.size(); ++j) {
    if (lower[j] > upper[j] + kExact) return kInfinity;
    const double d = curvature_[j];
    const double end = q_[j] > 0 ? lower[j] : upper[j];
    const double t = d > 0 ? std::min(std::max(-q_[j] / d, lower[j]), upper[j]) : end;
    objective += (0.5 * d * t + q_[j]) * t;
  }
  return objective;
}

double SmallIntegerProblem::Optimum() const {
  std::vector<double> x = lower_;
  double best = kInfinity;
  for (;;) {
    best = std::min(best, OptimumOfRest(x));
    std::size_t j = 0;
    while (j < At(num_integers_) && ++x[j] > upper_[j]) {
      x[j] = lower_[j];
      ++j;
    }
    if (j == At(num_integers_)) return best;
  }
}

}  // namespace switchyard::test
