// tests/conic/evolving.hpp - a random program in boxes around a point that stays feasible whatever
// is changed, the changes as sy_update, and what an instance should answer after them.
#pragma once

#include <deque>
#include <set>
#include <vector>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {

class Evolving {
 public:
  explicit Evolving(unsigned seed) : random_(seed) {
    testing::Shape shape{14,
                         6,
                         {SecondOrder(4),
                          Exponential(),
                          Rotated(3),
                          Semidefinite(2),
                          {SY_CONE_NONNEGATIVE, 3, 0},
                          SecondOrder(3)}};
    shape.quadratic = seed % 2 == 0;
    shape.density = 0.4;
    ProblemData d = testing::RandomFrame(shape, random_);
    x_ = random_.Normals(shape.vars);
    d.x_lower = d.x_upper = x_;
    for (double& l : d.x_lower) l -= random_.Uniform(0.3, 3);
    for (double& u : d.x_upper) u += random_.Uniform(0.3, 3);
    d.q = random_.Normals(shape.vars);
    PutAround(d);
    program_ = Problem(d);
  }

  /// After the changes that were sent.
  [[nodiscard]] const ProblemData& data() const { return program_.data(); }
  /// After all changes.
  const ProblemData& Now() {
    while (applied_ < pending_.size()) program_.Apply(pending_[applied_++]);
    return data();
  }

  // Changes, one update each.

  void MoveAllBounds() {
    ProblemData d = Now();
    for (std::size_t j = 0; j < x_.size(); ++j) Around(x_[j], d.x_lower[j], d.x_upper[j], true);
    PutRowsAround(d);
    TakeWhole(d, SY_UPDATES_BOUNDS);
  }
  /// What is finite stays so, what is not as well.
  void MoveFiniteBounds() {
    ProblemData d = Now();
    const auto move = [&](Values& lower, Values& upper) {
      for (std::size_t i = 0; i < lower.size(); ++i) {
        if (lower[i] == upper[i]) continue;
        lower[i] -= random_.Uniform(0, 1);
        upper[i] += random_.Uniform(0, 1);
      }
    };
    move(d.x_lower, d.x_upper);
    move(d.row_lower, d.row_upper);
    TakeWhole(d, SY_UPDATES_BOUNDS);
  }
  void MoveSingleBounds(int count) {
    sy_update& update = New();
    Single one;
    for (const std::int32_t j : Some(count, data().num_vars)) {
      one.index.push_back(j);
      Around(x_[j], one.lower.emplace_back(), one.upper.emplace_back(), true);
    }
    const Single& x = singles_.emplace_back(one);
    update.num_x = count;
    update.x = x.index.data();
    update.x_lower = x.lower.data();
    update.x_upper = x.upper.data();
    const Values Ax = testing::Product(data().A, x_);
    one = {};
    for (const std::int32_t i : Some(std::min(2, data().num_rows()), data().num_rows())) {
      one.index.push_back(i);
      Around(Ax[i], one.lower.emplace_back(), one.upper.emplace_back(), false);
    }
    const Single& row = singles_.emplace_back(one);
    update.num_rows = static_cast<std::int32_t>(row.index.size());
    update.row = row.index.data();
    update.row_lower = row.lower.data();
    update.row_upper = row.upper.data();
  }
  void FixVariables(int count) {
    sy_update& update = New();
    Single one;
    for (const std::int32_t j : Some(count, data().num_vars)) {
      one.index.push_back(j);
      one.lower.push_back(x_[j]);
      one.upper.push_back(x_[j]);
    }
    const Single& x = singles_.emplace_back(one);
    update.num_x = count;
    update.x = x.index.data();
    update.x_lower = x.lower.data();
    update.x_upper = x.upper.data();
  }
  void ChangeCosts() {
    ProblemData d = Now();
    d.q = random_.Normals(d.num_vars);
    d.offset = random_.Normal();
    PutConesAround(d);
    TakeWhole(d, SY_UPDATES_VECTORS);
  }
  /// Values, and the sides and vectors that keep the point feasible.
  void ChangeValues() {
    ProblemData d = Now();
    for (Csc* m : {&d.A, &d.F}) {
      for (double& v : m->value) v = random_.Normal();
    }
    for (double& v : d.P.value) v *= 1.5;
    PutAround(d);
    TakeWhole(d, SY_UPDATES_VALUES | SY_UPDATES_VECTORS | SY_UPDATES_BOUNDS);
  }
  /// Values alone: a multiple of P, which asks nothing of the point.
  void ScaleValues() {
    ProblemData d = Now();
    const double factor = random_.Uniform(0.8, 1.2);
    for (double& v : d.P.value) v *= factor;
    TakeWhole(d, SY_UPDATES_VALUES);
  }
  void SwitchCones(int count) {
    sy_update& update = New();
    Single one;
    for (const std::int32_t c : Some(count, data().num_cones())) {
      one.index.push_back(c);
      one.on.push_back(!data().cone_on.empty() && data().cone_on[c] == 0 ? 1 : 0);
    }
    const Single& cones = singles_.emplace_back(one);
    update.num_cones = count;
    update.cone = cones.index.data();
    update.cone_on = cones.on.data();
  }
  void RemoveRows(int count) {
    sy_update& update = New();
    Single one;
    one.index = Some(std::min(count, data().num_rows()), data().num_rows());
    const Single& rows = singles_.emplace_back(one);
    update.num_gone_rows = static_cast<std::int32_t>(rows.index.size());
    update.gone_row = rows.index.data();
  }
  void RemoveCones(int count) {
    sy_update& update = New();
    Single one;
    one.index = Some(std::min(count, data().num_cones()), data().num_cones());
    const Single& cones = singles_.emplace_back(one);
    update.num_gone_cones = static_cast<std::int32_t>(cones.index.size());
    update.gone_cone = cones.index.data();
  }
  /// Two variables, two rows and a cone or two over all.
  void Append() {
    Now();
    More& m = more_.emplace_back();
    const std::int32_t vars = program_.data().num_vars + 2;
    for (int k = 0; k < 2; ++k) {
      x_.push_back(random_.Normal());
      m.q.push_back(random_.Normal());
      m.x_lower.push_back(x_.back() - random_.Uniform(0.3, 2));
      m.x_upper.push_back(x_.back() + random_.Uniform(0.3, 2));
    }
    m.cones = {SecondOrder(3), random_.Chance(0.5) ? Exponential() : Power(0.4)};
    const Csc rows = random_.Sparse(2, vars, 0.5), cone_rows = random_.Sparse(6, vars, 0.5);
    for (const double v : testing::Product(rows, x_)) {
      Around(v, m.row_lower.emplace_back(), m.row_upper.emplace_back(), false);
    }
    m.g = Shifts(cone_rows, m.cones);
    m.at = Transpose(rows.View());
    m.ft = Transpose(cone_rows.View());
    m.at_view = m.at.View();
    m.ft_view = m.ft.View();
    m.more = {sizeof(sy_more),
              2,
              2,
              2,
              6,
              0,
              m.q.data(),
              m.x_lower.data(),
              m.x_upper.data(),
              nullptr,
              &m.at_view,
              m.row_lower.data(),
              m.row_upper.data(),
              &m.ft_view,
              m.g.data(),
              m.cones.data()};
    New().more = &m.more;
  }

  /// Sends all changes since the last time.
  void Send(Solver& solver) {
    Now();
    for (const sy_update& update : pending_) solver.Update(update);
    pending_.clear();
    applied_ = 0;
  }

  /// The instance answers as a fresh one that gets the program as it is now.
  void ExpectAsFresh(Solver& solver) {
    ASSERT_EQ(solver.data().num_vars, data().num_vars);
    ProblemData d = data();
    Vectors nothing;
    DropConesThatAreOff(d, nothing);
    const Found expected = Solver(d).Solve();
    ExpectOptimal(d, expected);
    const double optimum = expected.result.objective;
    for (const std::uint32_t flags : {std::uint32_t{0}, std::uint32_t{SY_CONTINUE}}) {
      SCOPED_TRACE(flags == 0 ? "from the beginning" : "from where the last solve ended");
      sy_control control = Freely();
      control.flags = flags;
      const Found found = solver.Solve(control);
      ExpectOptimal(data(), found);
      ExpectSameOptimum(data(), found, optimum);
    }
  }

  Random& random() { return random_; }

 private:
  struct Single {
    std::vector<std::int32_t> index;
    Values lower, upper;
    std::vector<std::uint8_t> on;
  };
  struct More {
    Values q, x_lower, x_upper, row_lower, row_upper, g;
    std::vector<sy_cone> cones;
    Csc at, ft;
    sy_csc at_view, ft_view;
    sy_more more;
  };

  /// The next update; what it will point to stays in place. Earlier ones are applied first: indices
  /// are those of the program as it then is.
  sy_update& New() {
    Now();
    return pending_.emplace_back(Nothing());
  }
  void TakeWhole(const ProblemData& d, std::uint32_t kinds) {
    New() = Whole(kinds, whole_.emplace_back(d));
  }

  void Around(double value, double& lower, double& upper, bool finite) {
    lower = value - random_.Uniform(0.2, 2);
    upper = value + random_.Uniform(0.2, 2);
    if (finite || random_.Chance(0.4)) return;
    (random_.Chance(0.5) ? lower : upper) = random_.Chance(0.5) ? -kInfinity : kInfinity;
    if (lower == kInfinity) lower = -kInfinity;
    if (upper == -kInfinity) upper = kInfinity;
  }
  Values Shifts(const Csc& f, const std::vector<sy_cone>& cones) {
    Values g = testing::Product(f, x_);
    std::size_t row = 0;
    for (const sy_cone& cone : cones) {
      const Values s = cone.kind == SY_CONE_PSD
                           ? Values{1 + random_.Uniform(0, 1), random_.Uniform(-0.5, 0.5), 1}
                           : testing::PointOf(cone, random_, 0.3);
      for (const double v : s) {
        g[row] = v - g[row];
        ++row;
      }
    }
    return g;
  }
  void PutConesAround(ProblemData& d) { d.g = Shifts(d.F, d.cones); }
  void PutRowsAround(ProblemData& d) {
    const Values Ax = testing::Product(d.A, x_);
    for (std::size_t i = 0; i < Ax.size(); ++i) {
      Around(Ax[i], d.row_lower[i], d.row_upper[i], false);
      if (random_.Chance(0.2)) d.row_lower[i] = d.row_upper[i] = Ax[i];
    }
  }
  void PutAround(ProblemData& d) {
    PutRowsAround(d);
    PutConesAround(d);
  }
  /// Some of the first `below` numbers, ascending.
  std::vector<std::int32_t> Some(int count, std::int32_t below) {
    std::set<std::int32_t> some;
    while (static_cast<int>(some.size()) < count) some.insert(random_.Below(below));
    return {some.begin(), some.end()};
  }

  Random random_;
  Values x_;
  Problem program_;
  std::deque<sy_update> pending_;
  std::size_t applied_ = 0;
  std::deque<Problem> whole_;
  std::deque<Single> singles_;
  std::deque<More> more_;
};

}  // namespace switchyard::conic
