#include "tests/mip/random_mixed_problem.hpp"

#include <cmath>

#include "switchyard/cones.hpp"

namespace switchyard::testing {
namespace {

constexpr double kRoom = 1e-11;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

Vector Times(const Csc& a, const Vector& x) {
  Vector ax(At(a.rows), 0.0);
  if (a.nonzeros() > 0) MultiplyAdd(a.View(), 1, x.data(), ax.data());
  return ax;
}

const std::vector<sy_cone>& SmallCones() {
  static const std::vector<sy_cone> cones = {
      {SY_CONE_SECOND_ORDER, 3, 0}, {SY_CONE_ROTATED, 4, 0},     {SY_CONE_EXPONENTIAL, 3, 0},
      {SY_CONE_POWER, 3, 0.3},      {SY_CONE_PSD, 3, 0},         {SY_CONE_NONNEGATIVE, 2, 0},
      {SY_CONE_ZERO, 2, 0},         {SY_CONE_SECOND_ORDER, 1, 0}};
  return cones;
}

/// Coordinates along which points of the cone go further into it.
std::vector<std::size_t> Inward(const sy_cone& cone) {
  switch (cone.kind) {
    case SY_CONE_ZERO:
      return {};
    case SY_CONE_SECOND_ORDER:
      return {0};
    case SY_CONE_PSD:
      return {0, 2};
    case SY_CONE_EXPONENTIAL:
      return {2};
    default:
      return {0, 1};
  }
}

Vector PointInside(const sy_cone& cone, Random& random) {
  if (cone.kind == SY_CONE_PSD) {
    Vector s = RandomSemidefinite(random, 2, 2);
    s[0] += 0.1;
    s[2] += 0.1;
    return s;
  }
  return PointOf(cone, random, 0.1);
}

}  // namespace

RandomMixedProblem::RandomMixedProblem(unsigned seed, bool binaries_only) {
  Random random(seed);
  DrawBoxes(random, binaries_only);
  DrawRows(random);
  DrawCones(random);
  DrawObjective(random);
  if (random.Chance(0.4)) DrawGroup(random);
  problem_ = Problem(data_);
  if (random.Chance(0.6)) {
    cutoff_ = Objective(problem_.view(), center_.data()) + random.Uniform(-0.3, 2);
  }
}

void RandomMixedProblem::DrawBoxes(Random& random, bool binaries_only) {
  num_integers_ = 2 + random.Below(4);
  data_.num_vars = num_integers_ + random.Below(3);
  for (std::int32_t j = 0; j < data_.num_vars; ++j) {
    const bool integer = j < num_integers_;
    data_.integer.push_back(integer);
    if (!integer) {
      data_.x_lower.push_back(random.Chance(0.5) ? -kInfinity : random.Uniform(-4, -1));
      data_.x_upper.push_back(random.Chance(0.5) ? kInfinity : random.Uniform(1, 4));
      center_.push_back(random.Uniform(-1, 1));
      continue;
    }
    const bool binary = binaries_only || random.Chance(0.5);
    data_.x_lower.push_back(binary ? 0 : -random.Below(3));
    data_.x_upper.push_back(data_.x_lower.back() + 1 + (binary ? 0 : random.Below(3)));
    const auto width = static_cast<std::int32_t>(data_.x_upper.back() - data_.x_lower.back());
    center_.push_back(data_.x_lower.back() + random.Below(width + 1));
  }
}

/// Rows over integers alone, of whole numbers, some equalities; and mixed ones.
void RandomMixedProblem::DrawRows(Random& random) {
  const std::int32_t rows = random.Below(5);
  std::vector<bool> pure;
  for (std::int32_t i = 0; i < rows; ++i) pure.push_back(random.Chance(0.6));
  data_.A = Csc(rows, data_.num_vars);
  for (std::int32_t j = 0; j < data_.num_vars; ++j) {
    for (std::int32_t i = 0; i < rows; ++i) {
      const double v =
          pure[At(i)] ? (j < num_integers_ ? random.Below(7) - 3 : 0) : random.Normal();
      if (v == 0 || random.Chance(0.3)) continue;
      data_.A.row.push_back(i);
      data_.A.value.push_back(v);
    }
    data_.A.start[At(j) + 1] = static_cast<std::int32_t>(data_.A.row.size());
  }
  const Vector value = Times(data_.A, center_);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const double spoil = random.Chance(0.1) ? 1 : 0;
    if (pure[i]) {
      const bool equal = random.Chance(0.3);
      data_.row_lower.push_back(equal || random.Chance(0.5) ? value[i] + spoil : -kInfinity);
      data_.row_upper.push_back(equal ? data_.row_lower.back()
                                      : value[i] + random.Below(3) + spoil);
    } else {
      const double lower = value[i] - random.Uniform(0, 1) + spoil;
      data_.row_lower.push_back(random.Chance(0.4) ? -kInfinity : lower);
      data_.row_upper.push_back(random.Chance(0.4) ? kInfinity : lower + random.Uniform(0.2, 2));
    }
  }
}

/// Cones that hold the center, but for what is spoiled; a zero cone has whole numbers.
void RandomMixedProblem::DrawCones(Random& random) {
  for (std::int32_t c = random.Below(3); c > 0; --c) {
    const auto kind = random.Below(static_cast<std::int32_t>(SmallCones().size()));
    data_.cones.push_back(SmallCones()[At(kind)]);
  }
  std::vector<bool> whole;
  for (const sy_cone& cone : data_.cones) {
    whole.insert(whole.end(), At(cone.dim), cone.kind == SY_CONE_ZERO);
  }
  const auto rows = static_cast<std::int32_t>(whole.size());
  data_.F = Csc(rows, data_.num_vars);
  for (std::int32_t j = 0; j < data_.num_vars; ++j) {
    for (std::int32_t i = 0; i < rows; ++i) {
      const double v =
          whole[At(i)] ? (j < num_integers_ ? random.Below(3) - 1 : 0) : random.Normal();
      if (v == 0 || random.Chance(0.5)) continue;
      data_.F.row.push_back(i);
      data_.F.value.push_back(v);
    }
    data_.F.start[At(j) + 1] = static_cast<std::int32_t>(data_.F.row.size());
  }
  const Vector fx = Times(data_.F, center_);
  for (const sy_cone& cone : data_.cones) {
    const Vector s = PointInside(cone, random);
    const double spoil = random.Chance(0.1) ? 1 : 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      data_.g.push_back(s[i] - fx[data_.g.size()] - (i == 0 ? spoil : 0));
    }
  }
}

void RandomMixedProblem::DrawObjective(Random& random) {
  data_.q = random.Normals(data_.num_vars);
  for (double& q : data_.q) q = random.Chance(0.3) ? 0 : q;
  data_.offset = random.Normal();
  data_.P = Csc(data_.num_vars, data_.num_vars);
  if (random.Chance(0.6)) return;
  for (std::int32_t j = 0; j < data_.num_vars; ++j) {
    for (std::int32_t i = 0; i <= j; ++i) {
      if (i < j && random.Chance(0.7)) continue;
      data_.P.row.push_back(i);
      data_.P.value.push_back(i < j ? 0.2 * random.Normal() : random.Uniform(-0.3, 2));
    }
    data_.P.start[At(j) + 1] = static_cast<std::int32_t>(data_.P.row.size());
  }
}

void RandomMixedProblem::DrawGroup(Random& random) {
  bool has_nonzero = random.Chance(0.1);
  for (std::int32_t j = 0; j < data_.num_vars; ++j) {
    if (center_[At(j)] != 0 && has_nonzero) continue;
    if (random.Chance(0.3)) continue;
    group_.push_back(j);
    has_nonzero = has_nonzero || center_[At(j)] != 0;
  }
  group_start_ = {0, static_cast<std::int32_t>(group_.size())};
  groups_ = {sizeof groups_, 1, group_start_.data(), group_.data()};
  hints_ = {{"sy.sos1/1", &groups_}, {nullptr, nullptr}};
  data_.hints = hints_.data();
}

bool RandomMixedProblem::RowsHold(const Vector& x) const {
  const Vector value = Times(data_.A, x);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const bool whole = value[i] == std::round(value[i]);
    const double room = whole ? 0 : kRoom;
    if (value[i] < data_.row_lower[i] + room || value[i] > data_.row_upper[i] - room) return false;
  }
  return true;
}

bool RandomMixedProblem::ConesHold(const Vector& x) const {
  Vector s = Times(data_.F, x);
  for (std::size_t i = 0; i < s.size(); ++i) s[i] += data_.g[i];
  double* at = s.data();
  for (const sy_cone& cone : data_.cones) {
    for (const std::size_t i : Inward(cone)) at[i] -= kRoom;
    if (!(FactsOf(cone.kind).violation(at, cone.dim, cone.parameter) <= 0)) return false;
    at += cone.dim;
  }
  return true;
}

bool RandomMixedProblem::Holds(const Vector& x) const {
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (x[j] < data_.x_lower[j] || x[j] > data_.x_upper[j]) return false;
    if (data_.integer[j] != 0 && x[j] != std::round(x[j])) return false;
  }
  std::int32_t nonzeros = 0;
  for (const std::int32_t j : group_) nonzeros += x[At(j)] != 0 ? 1 : 0;
  return nonzeros <= 1 && RowsHold(x) && ConesHold(x) &&
         Objective(problem_.view(), x.data()) <= cutoff_ - kRoom;
}

void RandomMixedProblem::ExtremePoints(const Vector& x, std::vector<Vector>& points) const {
  for (auto j = At(num_integers_); j < x.size(); ++j) {
    for (const double far : {-1e3, 1e3}) {
      Vector inside = x;
      double outside = x[j] + far;
      for (int k = 0; k < 50; ++k) {
        Vector middle = inside;
        middle[j] = 0.5 * (inside[j] + outside);
        if (Holds(middle)) {
          inside = middle;
        } else {
          outside = middle[j];
        }
      }
      points.push_back(inside);
    }
  }
}

std::vector<Vector> RandomMixedProblem::Points(Random& random) const {
  std::vector<Vector> points;
  Vector x = center_;
  const std::function<void(std::int32_t)> assign = [&](std::int32_t j) {
    if (j < num_integers_) {
      for (double v = data_.x_lower[At(j)]; v <= data_.x_upper[At(j)]; ++v) {
        x[At(j)] = v;
        assign(j + 1);
      }
      return;
    }
    const int draws = num_integers_ < data_.num_vars ? 4 : 1;
    for (int draw = 0; draw < draws; ++draw) {
      for (auto k = At(num_integers_); k < x.size(); ++k) {
        x[k] = draw == 0 ? center_[k] : (draw == 1 ? 0 : random.Uniform(-3, 3));
      }
      if (!Holds(x)) continue;
      points.push_back(x);
      if (points.size() < 60) ExtremePoints(x, points);
    }
  };
  assign(0);
  return points;
}

}  // namespace switchyard::testing
