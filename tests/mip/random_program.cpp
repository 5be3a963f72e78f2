#include "tests/mip/random_program.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

using Rows = std::vector<Vector>;

constexpr double kMoved = 0.2;  // of the rows and cones, not held by the drawn point
constexpr std::int64_t kAssignments = 256;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

double Whole(Random& random, std::int32_t size) { return random.Below(2 * size + 1) - size; }
double Quarters(Random& random) { return std::round(4 * random.Normal()) / 4; }

Csc ByColumns(const Rows& rows, std::int32_t cols) {
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

class Draw {
 public:
  Draw(ProgramClass c, std::uint32_t seed) : class_(c), random_(seed * 16 + unsigned(c)) {
    DrawVariables();
    if (c == ProgramClass::kOnOff) {
      DrawSwitches();
    } else {
      for (const sy_cone& cone : Cones()) DrawCone(cone);
    }
    if (c == ProgramClass::kPotentials) DrawPotentials();
    DrawRows();
    if (c == ProgramClass::kQuadratic || (c == ProgramClass::kMixed && random_.Chance(0.5))) {
      DrawCurvature();
    }
  }
  ProblemData Take() {
    d_.num_vars = size();
    d_.flags = SY_PROBLEM_CONVEX;
    d_.A = ByColumns(Filled(a_), size());
    d_.F = ByColumns(Filled(f_), size());
    d_.P = ByColumns(p_, size());
    if (p_.empty()) d_.P = Csc(size(), size());
    d_.offset = Whole(random_, 5);
    return std::move(d_);
  }

 private:
  [[nodiscard]] std::int32_t size() const { return std::int32_t(d_.q.size()); }
  /// Rows that were drawn before the last variables.
  [[nodiscard]] Rows Filled(Rows rows) const {
    for (Vector& row : rows) row.resize(d_.q.size(), 0.0);
    return rows;
  }

  void AddVariable(double lower, double upper, double cost, bool integer) {
    d_.x_lower.push_back(lower);
    d_.x_upper.push_back(upper);
    d_.q.push_back(cost);
    d_.integer.push_back(integer ? 1 : 0);
    const double from = std::max(lower, -5.0), to = std::min(upper, 5.0);
    const double value = random_.Uniform(from, integer ? to + 1 : to);
    point_.push_back(integer ? std::min(std::floor(value), upper) : value);
  }

  void DrawVariables() {
    const std::int32_t integers = 2 + random_.Below(7);
    std::int64_t assignments = 1;
    for (std::int32_t j = 0; j < integers; ++j) {
      const std::int32_t rest = integers - j - 1;  // at least two values each
      const double lower = random_.Chance(0.6) ? 0 : -2 + random_.Below(3);
      double width = lower == 0 && random_.Chance(0.7) ? 1 : 1 + random_.Below(3 - int(lower));
      if ((assignments * (std::int64_t(width) + 1)) << rest > kAssignments) width = 1;
      assignments *= std::int64_t(width) + 1;
      AddVariable(lower, lower + width, Whole(random_, 9), true);
    }
    num_integers_ = integers;
    const std::int32_t continuous = random_.Below(6);
    for (std::int32_t j = 0; j < continuous; ++j) {
      const double width = 1 + random_.Below(5);
      AddVariable(-width, width, Quarters(random_), false);
    }
  }

  std::vector<sy_cone> Cones() {
    const std::int32_t count = 1 + random_.Below(2);
    std::vector<sy_cone> cones;
    const auto add = [&](ProgramClass c) {
      if (c == ProgramClass::kLorentz || c == ProgramClass::kPotentials)
        cones.push_back({SY_CONE_SECOND_ORDER, 2 + random_.Below(4), 0});
      if (c == ProgramClass::kRotated) cones.push_back({SY_CONE_ROTATED, 3 + random_.Below(3), 0});
      if (c == ProgramClass::kSemidefinite) {
        cones.push_back({SY_CONE_PSD, random_.Chance(0.5) ? 3 : 6, 0});
      }
      if (c == ProgramClass::kExponential) cones.push_back({SY_CONE_EXPONENTIAL, 3, 0});
      if (c == ProgramClass::kPower) cones.push_back({SY_CONE_POWER, 3, random_.Uniform(0.1, 0.9)});
    };
    const std::int32_t first = std::int32_t(ProgramClass::kLorentz);
    for (std::int32_t i = 0; i < count; ++i) add(class_);
    for (std::int32_t i = 0; class_ == ProgramClass::kMixed && i <= count; ++i) {
      add(ProgramClass(first + random_.Below(5)));
    }
    return cones;
  }

  /// In the cone, `slack` inside.
  Vector PointIn(const sy_cone& cone, double slack) {
    if (cone.kind != SY_CONE_PSD || cone.dim != 3) return PointOf(cone, random_, slack);
    Vector s = RandomSemidefinite(random_, 2, 1);
    s[0] += slack;
    s[2] += slack;
    return s;
  }

  /// The row of a cone's head, to which a variable without bounds may be added.
  static std::int32_t HeadOf(const sy_cone& cone) {
    return cone.kind == SY_CONE_EXPONENTIAL ? 2 : 0;
  }

  void DrawCone(const sy_cone& cone) {
    Vector s = PointIn(cone, random_.Uniform(0, 1));
    const bool head = random_.Chance(0.3);
    if (random_.Chance(kMoved)) s[At(HeadOf(cone))] -= random_.Uniform(1, 8);
    if (head) AddVariable(-kInfinity, kInfinity, random_.Uniform(0.3, 2), false);
    // Where entries are exponents, or multiply one another, integers move them by less.
    const double unit = cone.kind == SY_CONE_SECOND_ORDER || cone.kind == SY_CONE_PSD ? 1 : 0.25;
    const std::int32_t bounded = size() - (head ? 1 : 0);
    for (std::int32_t i = 0; i < cone.dim; ++i) {
      Vector row(d_.q.size(), 0.0);
      for (std::int32_t j = 0; j < bounded; ++j) {
        if (d_.x_lower[At(j)] == -kInfinity || !random_.Chance(0.5)) continue;
        row[At(j)] = j < num_integers_ ? unit * Whole(random_, 2) : unit * Quarters(random_);
      }
      if (head && i == HeadOf(cone)) row.back() = 1;
      d_.g.push_back(s[At(i)] - std::inner_product(row.begin(), row.end(), point_.begin(), 0.0));
      f_.push_back(row);
    }
    d_.cones.push_back(cone);
  }

  /// Of each of the first binaries z: (t, z, u, v) with 2 t z >= u^2 + v^2, |(u, v)| <= 3 z or
  /// z exp(u / z) <= t, where t has a cost; and a demand that the u share.
  void DrawSwitches() {
    Vector demand;
    for (std::int32_t z = 0; z < std::min(num_integers_, 3); ++z) {
      d_.x_lower[At(z)] = 0;
      d_.x_upper[At(z)] = 1;
      d_.q[At(z)] = random_.Below(5);
      point_[At(z)] = std::min(1.0, std::abs(point_[At(z)]));
      const std::int32_t t = size(), u = t + 1, kind = random_.Below(3);
      AddVariable(-kInfinity, kInfinity, random_.Uniform(0.3, 2), false);
      AddVariable(-3, 3, 0, false);
      const auto add = [&](sy_cone_kind cone,
                           const std::vector<std::pair<std::int32_t, double>>& s) {
        d_.cones.push_back({cone, std::int32_t(s.size()), 0});
        for (const auto& [j, value] : s) {
          f_.emplace_back(d_.q.size(), 0.0)[At(j)] = value;
          d_.g.push_back(0);
        }
      };
      if (kind == 0) add(SY_CONE_ROTATED, {{t, 1}, {z, 1}, {u, 1}});
      if (kind == 1) add(SY_CONE_EXPONENTIAL, {{u, 1}, {z, 1}, {t, 1}});
      if (kind == 2) {
        add(SY_CONE_SECOND_ORDER, {{t, 1}, {u, 1}});
        add(SY_CONE_SECOND_ORDER, {{z, 3}, {u, 1}});
      }
      demand.resize(d_.q.size(), 0.0);
      demand.back() = 1;
    }
    a_.push_back(demand);
    d_.row_lower.push_back(random_.Uniform(-1, 5));
    d_.row_upper.push_back(random_.Chance(0.5) ? kInfinity : d_.row_lower.back());
  }

  /// Of each entry s = f'x + g of a cone but for its head, v_i - v_k where v_i - v_k - f'x = g,
  /// over potentials v with a tree of such rows.
  void DrawPotentials() {
    const std::int32_t first = size();
    AddVariable(-kInfinity, kInfinity, 0, false);
    std::size_t row = 0;
    for (const sy_cone& cone : d_.cones) {
      for (std::int32_t i = 0; i < cone.dim; ++i, ++row) {
        if (i == 0) continue;
        const std::int32_t other = first + random_.Below(size() - first);
        const double cost = Quarters(random_);
        AddVariable(-kInfinity, kInfinity, cost, false);
        d_.q[At(other)] -= cost;
        Vector difference(d_.q.size(), 0.0);
        difference[At(other)] = -1;
        difference.back() = 1;
        Vector defined = std::exchange(f_[row], difference);
        defined.resize(d_.q.size(), 0.0);
        for (double& value : defined) value = -value;
        defined[At(other)] = -1;
        defined.back() = 1;
        a_.push_back(defined);
        const double side = std::exchange(d_.g[row], 0.0);
        d_.row_lower.push_back(side);
        d_.row_upper.push_back(side);
      }
    }
  }

  void DrawRows() {
    const std::int32_t count = random_.Below(class_ == ProgramClass::kLinear ? 5 : 3) + 1;
    for (std::int32_t i = 0; i < count; ++i) {
      Vector row(d_.q.size(), 0.0);
      for (std::int32_t j = 0; j < size(); ++j) {
        if (d_.x_lower[At(j)] == -kInfinity || !random_.Chance(0.6)) continue;
        row[At(j)] = j < num_integers_ ? Whole(random_, 5) : Quarters(random_);
      }
      double at = std::inner_product(row.begin(), row.end(), point_.begin(), 0.0);
      if (random_.Chance(kMoved)) at += 2 * Whole(random_, 4);
      const std::int32_t sides = random_.Below(8);
      const double slack = random_.Below(3);
      d_.row_lower.push_back(sides < 3 ? -kInfinity : at - (sides == 7 ? 0 : slack));
      d_.row_upper.push_back(sides >= 3 && sides < 6 ? kInfinity : at + (sides == 7 ? 0 : slack));
      a_.push_back(row);
    }
  }

  /// P = G'G, of a rank below its size.
  void DrawCurvature() {
    p_.assign(d_.q.size(), Vector(d_.q.size(), 0.0));
    for (std::int32_t k = 1 + random_.Below(3); k > 0; --k) {
      Vector g(d_.q.size(), 0.0);
      for (std::int32_t j = 0; j < size(); ++j) {
        if (d_.x_lower[At(j)] > -kInfinity && random_.Chance(0.6)) g[At(j)] = Whole(random_, 2);
      }
      for (std::size_t i = 0; i < g.size(); ++i) {
        for (std::size_t j = i; j < g.size(); ++j) p_[i][j] += g[i] * g[j];
      }
    }
  }

  ProgramClass class_;
  Random random_;
  ProblemData d_;
  std::int32_t num_integers_ = 0;
  Vector point_;
  Rows a_, f_, p_;
};

}  // namespace

const char* NameOf(ProgramClass c) {
  constexpr std::array names = {"Linear",      "Quadratic", "Lorentz", "Rotated", "Semidefinite",
                                "Exponential", "Power",     "Mixed",   "OnOff",   "Potentials"};
  static_assert(names.size() == kProgramClasses.size());
  return names[static_cast<std::size_t>(c)];
}

ProblemData RandomProgram(ProgramClass c, std::uint32_t seed) { return Draw(c, seed).Take(); }

}  // namespace switchyard::testing
