// Problem::Apply against a model that is changed plainly and built anew.
#include <gtest/gtest.h>

#include <map>

#include "switchyard/problem.hpp"
#include "switchyard/problem_update.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

using SparseRow = std::map<std::int32_t, double>;

struct Row {
  SparseRow entries;
  double lower = 0, upper = 0;
};
struct ConeRow {
  SparseRow entries;
  double g = 0;
};
struct Cone {
  sy_cone cone{};
  std::vector<ConeRow> rows;
  std::uint8_t on = 1;
};
struct Variable {
  double q = 0, lower = 0, upper = 0;
  std::uint8_t integer = 0;
};

Csc Columns(const std::vector<const SparseRow*>& rows, std::int32_t cols) {
  Csc by_rows(cols, static_cast<std::int32_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const auto& [j, value] : *rows[i]) {
      by_rows.row.push_back(j);
      by_rows.value.push_back(value);
    }
    by_rows.start[i + 1] = static_cast<std::int32_t>(by_rows.row.size());
  }
  return by_rows;
}

/// The problem as lists of things, which an update changes in the obvious way.
struct Model {
  std::vector<Variable> variables;
  std::vector<Row> rows;
  std::vector<Cone> cones;
  std::vector<SparseRow> hessian;  // rows of P: entries at and right of the diagonal
  double offset = 0;

  [[nodiscard]] std::int32_t num_vars() const {
    return static_cast<std::int32_t>(variables.size());
  }
  [[nodiscard]] std::vector<const SparseRow*> RowEntries() const {
    std::vector<const SparseRow*> all;
    for (const Row& row : rows) all.push_back(&row.entries);
    return all;
  }
  [[nodiscard]] std::vector<const SparseRow*> ConeEntries() const {
    std::vector<const SparseRow*> all;
    for (const Cone& cone : cones) {
      for (const ConeRow& row : cone.rows) all.push_back(&row.entries);
    }
    return all;
  }
  [[nodiscard]] ProblemData Build() const {
    ProblemData d;
    d.num_vars = num_vars();
    d.offset = offset;
    for (const Variable& v : variables) {
      d.q.push_back(v.q);
      d.x_lower.push_back(v.lower);
      d.x_upper.push_back(v.upper);
      d.integer.push_back(v.integer);
    }
    for (const Row& row : rows) {
      d.row_lower.push_back(row.lower);
      d.row_upper.push_back(row.upper);
    }
    for (const Cone& cone : cones) {
      d.cones.push_back(cone.cone);
      d.cone_on.push_back(cone.on);
      for (const ConeRow& row : cone.rows) d.g.push_back(row.g);
    }
    std::vector<const SparseRow*> p;
    for (const SparseRow& row : hessian) p.push_back(&row);
    d.P = Transpose(Columns(p, num_vars()).View());
    d.A = Transpose(Columns(RowEntries(), num_vars()).View());
    d.F = Transpose(Columns(ConeEntries(), num_vars()).View());
    return d;
  }
};

SparseRow RandomEntries(Random& random, std::int32_t from, std::int32_t to) {
  SparseRow entries;
  for (std::int32_t j = from; j < to; ++j) {
    if (random.Chance(0.4)) entries[j] = random.Normal();
  }
  return entries;
}

Variable RandomVariable(Random& random) {
  const double lower = random.Normal();
  return {random.Normal(), random.Chance(0.3) ? -kInfinity : lower,
          random.Chance(0.3) ? kInfinity : lower + 1, random.Chance(0.3)};
}

Row RandomRow(Random& random, std::int32_t vars) {
  const double lower = random.Normal();
  return {RandomEntries(random, 0, vars), lower, random.Chance(0.5) ? kInfinity : lower};
}

Cone RandomCone(Random& random, std::int32_t vars) {
  Cone cone;
  cone.cone = AllCones()[static_cast<std::size_t>(random.Below(10))];
  for (int i = 0; i < cone.cone.dim; ++i) {
    cone.rows.push_back({RandomEntries(random, 0, vars), random.Normal()});
  }
  return cone;
}

Model RandomModel(Random& random) {
  Model m;
  m.offset = random.Normal();
  const std::int32_t vars = 1 + random.Below(6);
  for (std::int32_t j = 0; j < vars; ++j) m.variables.push_back(RandomVariable(random));
  for (std::int32_t j = 0; j < vars; ++j) m.hessian.push_back(RandomEntries(random, j, vars));
  for (std::int32_t i = random.Below(5); i > 0; --i) m.rows.push_back(RandomRow(random, vars));
  for (std::int32_t i = random.Below(4); i > 0; --i) m.cones.push_back(RandomCone(random, vars));
  return m;
}

/// An update and what it points to.
struct OwnedUpdate {
  sy_update update{};
  Problem whole;
  std::vector<std::int32_t> x, row, cone, gone_row, gone_cone;
  Vector x_lower, x_upper, row_lower, row_upper;
  std::vector<std::uint8_t> cone_on;
  sy_more more{};
  ProblemData appended;  // its A and F are transposed, as sy_more has them
  sy_csc at{}, ft{};

  const sy_update& Sealed() {
    const auto count = [](const auto& v) { return static_cast<std::int32_t>(v.size()); };
    update.size = sizeof update;
    update.problem = update.whole != 0 ? &whole.view() : nullptr;
    update.num_x = count(x);
    update.num_rows = count(row);
    update.num_cones = count(cone);
    update.num_gone_rows = count(gone_row);
    update.num_gone_cones = count(gone_cone);
    update.x = x.data();
    update.x_lower = x_lower.data();
    update.x_upper = x_upper.data();
    update.row = row.data();
    update.row_lower = row_lower.data();
    update.row_upper = row_upper.data();
    update.cone = cone.data();
    update.cone_on = cone_on.data();
    update.gone_row = gone_row.data();
    update.gone_cone = gone_cone.data();
    return update;
  }
};

void ChangeWhole(Random& random, Model& m, OwnedUpdate& u) {
  const std::uint32_t kinds[] = {SY_UPDATES_BOUNDS, SY_UPDATES_VECTORS, SY_UPDATES_VALUES};
  for (const std::uint32_t kind : kinds) {
    if (random.Chance(0.5)) u.update.whole |= kind;
  }
  Model other = m;  // same patterns, all numbers new; what is taken of it goes to m too
  other.offset = random.Normal();
  for (std::size_t j = 0; j < m.variables.size(); ++j) {
    const Variable fresh = RandomVariable(random);
    other.variables[j] = {fresh.q, fresh.lower, fresh.upper, m.variables[j].integer};
    for (auto& [i, value] : other.hessian[j]) value = random.Normal();
  }
  for (Row& row : other.rows) {
    for (auto& [j, value] : row.entries) value = random.Normal();
    row.lower = random.Normal();
    row.upper = row.lower + 1;
  }
  for (Cone& cone : other.cones) {
    for (ConeRow& row : cone.rows) {
      for (auto& [j, value] : row.entries) value = random.Normal();
      row.g = random.Normal();
    }
  }
  u.whole = Problem(other.Build());
  const bool bounds = (u.update.whole & SY_UPDATES_BOUNDS) != 0;
  const bool vectors = (u.update.whole & SY_UPDATES_VECTORS) != 0;
  const bool values = (u.update.whole & SY_UPDATES_VALUES) != 0;
  if (vectors) m.offset = other.offset;
  if (values) m.hessian = other.hessian;
  for (std::size_t j = 0; j < m.variables.size(); ++j) {
    if (bounds) m.variables[j].lower = other.variables[j].lower;
    if (bounds) m.variables[j].upper = other.variables[j].upper;
    if (vectors) m.variables[j].q = other.variables[j].q;
  }
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    if (values) m.rows[i].entries = other.rows[i].entries;
    if (bounds) m.rows[i].lower = other.rows[i].lower;
    if (bounds) m.rows[i].upper = other.rows[i].upper;
  }
  for (std::size_t c = 0; c < m.cones.size(); ++c) {
    for (std::size_t i = 0; i < m.cones[c].rows.size(); ++i) {
      if (values) m.cones[c].rows[i].entries = other.cones[c].rows[i].entries;
      if (vectors) m.cones[c].rows[i].g = other.cones[c].rows[i].g;
    }
  }
}

void ChangeSingles(Random& random, Model& m, OwnedUpdate& u) {
  for (std::size_t j = 0; j < m.variables.size(); ++j) {
    if (!random.Chance(0.3)) continue;
    m.variables[j].lower = random.Normal();
    m.variables[j].upper = kInfinity;
    u.x.push_back(static_cast<std::int32_t>(j));
    u.x_lower.push_back(m.variables[j].lower);
    u.x_upper.push_back(kInfinity);
  }
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    if (!random.Chance(0.3)) continue;
    m.rows[i].lower = -kInfinity;
    m.rows[i].upper = random.Normal();
    u.row.push_back(static_cast<std::int32_t>(i));
    u.row_lower.push_back(-kInfinity);
    u.row_upper.push_back(m.rows[i].upper);
  }
  for (std::size_t c = 0; c < m.cones.size(); ++c) {
    if (!random.Chance(0.3)) continue;
    m.cones[c].on = random.Chance(0.5) ? 1 : 0;
    u.cone.push_back(static_cast<std::int32_t>(c));
    u.cone_on.push_back(m.cones[c].on);
  }
}

template <class Thing>
void RemoveSome(Random& random, std::vector<Thing>& things, std::vector<std::int32_t>& gone) {
  std::vector<Thing> kept;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (random.Chance(0.3)) {
      gone.push_back(static_cast<std::int32_t>(i));
    } else {
      kept.push_back(things[i]);
    }
  }
  things = kept;
}

void AppendSome(Random& random, Model& m, OwnedUpdate& u) {
  Model added;
  for (std::int32_t k = random.Below(3); k > 0; --k) {
    added.variables.push_back(RandomVariable(random));
  }
  const std::int32_t vars = m.num_vars() + added.num_vars();
  for (std::int32_t k = random.Below(3); k > 0; --k) added.rows.push_back(RandomRow(random, vars));
  for (std::int32_t k = random.Below(3); k > 0; --k) {
    added.cones.push_back(RandomCone(random, vars));
  }
  Model narrow = added;  // for its vectors alone
  for (Row& row : narrow.rows) row.entries.clear();
  for (Cone& cone : narrow.cones) {
    for (ConeRow& row : cone.rows) row.entries.clear();
  }
  u.appended = narrow.Build();
  u.appended.A = Columns(added.RowEntries(), vars);
  u.appended.F = Columns(added.ConeEntries(), vars);
  u.at = u.appended.A.View();
  u.ft = u.appended.F.View();
  const ProblemData& d = u.appended;
  u.more = {sizeof u.more,
            added.num_vars(),
            d.num_rows(),
            d.num_cones(),
            d.num_cone_rows(),
            0,
            d.q.data(),
            d.x_lower.data(),
            d.x_upper.data(),
            d.integer.data(),
            &u.at,
            d.row_lower.data(),
            d.row_upper.data(),
            &u.ft,
            d.g.data(),
            d.cones.data()};
  u.update.more = &u.more;
  for (const Variable& v : added.variables) m.variables.push_back(v);
  m.hessian.resize(m.variables.size());
  for (const Row& row : added.rows) m.rows.push_back(row);
  for (const Cone& cone : added.cones) m.cones.push_back(cone);
}

template <class T>
std::vector<T> Or(const std::vector<T>& v, std::size_t count, T otherwise) {
  return v.empty() ? std::vector<T>(count, otherwise) : v;
}

void ExpectSame(const Csc& a, const Csc& b) {
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.cols, b.cols);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.value, b.value);
}

void ExpectSame(const ProblemData& a, const ProblemData& b) {
  const auto n = static_cast<std::size_t>(b.num_vars);
  EXPECT_EQ(a.num_vars, b.num_vars);
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(Or(a.x_lower, n, -kInfinity), b.x_lower);
  EXPECT_EQ(Or(a.x_upper, n, kInfinity), b.x_upper);
  EXPECT_EQ(Or(a.integer, n, std::uint8_t{0}), b.integer);
  EXPECT_EQ(a.row_lower, b.row_lower);
  EXPECT_EQ(a.row_upper, b.row_upper);
  EXPECT_EQ(a.g, b.g);
  EXPECT_EQ(Or(a.cone_on, b.cones.size(), std::uint8_t{1}), b.cone_on);
  ASSERT_EQ(a.cones.size(), b.cones.size());
  for (std::size_t c = 0; c < b.cones.size(); ++c) {
    EXPECT_EQ(a.cones[c].kind, b.cones[c].kind);
    EXPECT_EQ(a.cones[c].dim, b.cones[c].dim);
  }
  ExpectSame(a.P, b.P);
  ExpectSame(a.A, b.A);
  ExpectSame(a.F, b.F);
}

TEST(Update, MakesTheProblemThatIsBuiltFromTheChangedModel) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Model model = RandomModel(random);
    Problem problem(model.Build());
    for (int step = 0; step < 4; ++step) {
      OwnedUpdate u;
      if (random.Chance(0.5)) ChangeWhole(random, model, u);
      if (random.Chance(0.5)) ChangeSingles(random, model, u);
      if (random.Chance(0.5)) RemoveSome(random, model.rows, u.gone_row);
      if (random.Chance(0.5)) RemoveSome(random, model.cones, u.gone_cone);
      if (random.Chance(0.5)) AppendSome(random, model, u);
      problem.Apply(u.Sealed());
      ExpectSame(problem.data(), model.Build());
    }
  }
}

TEST(Update, TakesAnAbsentShiftForZero) {
  Random random(1);
  Model model;
  model.variables.resize(2);
  model.hessian.resize(2);
  model.cones.push_back(RandomCone(random, 2));
  Problem problem(model.Build());
  sy_problem without = problem.view();
  without.g = nullptr;
  sy_update update{};
  update.size = sizeof update;
  update.whole = SY_UPDATES_VECTORS;
  update.problem = &without;
  problem.Apply(update);
  EXPECT_EQ(problem.data().g, Vector(model.cones[0].rows.size(), 0.0));
}

TEST(Update, LeavesTheProblemAloneWhereItDoesNotFit) {
  Random random(2);
  Model model = RandomModel(random);
  model.rows.push_back(RandomRow(random, model.num_vars()));
  Problem problem(model.Build());
  const auto refused = [&](auto&& spoil) {
    OwnedUpdate u;
    u.x = {0};
    u.x_lower = {5};
    u.x_upper = {6};
    spoil(u);
    EXPECT_THROW(problem.Apply(u.Sealed()), std::invalid_argument);
    ExpectSame(problem.data(), model.Build());
  };
  refused([&](OwnedUpdate& u) { u.x = {model.num_vars()}; });
  refused([&](OwnedUpdate& u) { u.gone_row = {-1}; });
  refused([&](OwnedUpdate& u) { u.gone_row = {0, 0}; });
  refused([&](OwnedUpdate& u) { u.gone_cone = {static_cast<int>(model.cones.size())}; });
  refused([&](OwnedUpdate& u) { u.update.whole = SY_UPDATES_VALUES; });
  sy_update alone{};
  alone.size = sizeof alone;
  alone.whole = SY_UPDATES_VECTORS;
  EXPECT_THROW(problem.Apply(alone), std::invalid_argument);
  refused([&](OwnedUpdate& u) {
    Model changed = model;
    AppendSome(random, changed, u);
    u.more.num_rows += 1;
  });
}

}  // namespace
}  // namespace switchyard::testing
