// Random convex programs around a known answer, with much that can be reduced: solved in their
// reduced form, the answer of the whole is one.
#include <algorithm>

#include "tests/presolve/programs.hpp"
#include "tests/presolve/solved.hpp"
#include "tests/support/known_answers.hpp"

namespace switchyard::presolve {
namespace {

using testing::KnownAnswer;
using testing::Random;

/// Adds to a problem what a presolve should take away again, and keeps an answer that it has true.
class Growing {
 public:
  Growing(KnownAnswer core, Random& random)
      : d_(std::move(core.problem)), at_(std::move(core.at)), random_(random) {
    at_.x.resize(d_.q.size(), 0.5);
    at_.x_dual.resize(d_.q.size(), 0.0);
    at_.row_dual.resize(d_.row_lower.size(), 0.0);
    at_.cone_dual.resize(d_.g.size(), 0.0);
    for (std::size_t i = 0; i < d_.row_lower.size(); ++i) {  // of a row of nothing, two drawn ones
      if (d_.row_lower[i] > d_.row_upper[i]) std::swap(d_.row_lower[i], d_.row_upper[i]);
    }
    TakeRows(d_.A, a_);
    TakeRows(d_.F, f_);
    d_.x_lower.resize(at_.x.size(), -kInfinity);
    d_.x_upper.resize(at_.x.size(), kInfinity);
  }

  void Grow(int steps) {
    for (int k = 0; k < steps; ++k) {
      switch (random_.Below(9)) {
        case 0:
          AddRow({}, 1, 2, 0);
          break;
        case 1:
          AddSingletonRow();
          break;
        case 2:
          AddParallelRow();
          break;
        case 3:
          AddImpliedRow();
          break;
        case 4:
          AddFixedVariable();
          break;
        case 5:
          AddFreeColumn();
          break;
        case 6:
          AddEquation();
          break;
        case 7:
          AddForcingRow();
          break;
        default:
          AddSmallCone();
      }
    }
  }

  /// With the costs that make the answer one.
  KnownAnswer WithAnswer() {
    ProblemData d = WithCosts();
    d.q = testing::Combined(d, at_);
    SymmetricMultiplyAdd(d.P.View(), -1, at_.x.data(), d.q.data());
    return {d, at_};
  }

  /// With the costs that there were, and some for what was added.
  ProblemData WithCosts() {
    const auto n = static_cast<Index>(at_.x.size());
    d_.num_vars = n;
    d_.A = Dense(Padded(a_), n);
    d_.F = Dense(Padded(f_), n);
    d_.P.rows = d_.P.cols = n;
    d_.P.start.resize(static_cast<std::size_t>(n) + 1, d_.P.start.back());
    while (d_.q.size() < at_.x.size()) d_.q.push_back(random_.Chance(0.5) ? random_.Normal() : 0);
    return d_;
  }

 private:
  using Terms = std::vector<Entry>;

  static void TakeRows(const Csc& m, Rows& rows) {
    rows.assign(static_cast<std::size_t>(m.rows), Vector(static_cast<std::size_t>(m.cols), 0.0));
    for (Index j = 0; j < m.cols; ++j) {
      for (Index k = m.start[j]; k < m.start[j + 1]; ++k) rows[m.row[k]][j] = m.value[k];
    }
  }
  [[nodiscard]] Rows Padded(Rows rows) const {
    for (Vector& row : rows) row.resize(at_.x.size(), 0.0);
    return rows;
  }
  [[nodiscard]] Vector RowOf(const Terms& terms) const {
    Vector row(at_.x.size(), 0.0);
    for (const Entry& e : terms) row[e.column] += e.value;
    return row;
  }
  [[nodiscard]] double ValueOf(const Vector& row) const {
    double sum = 0;
    for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] * at_.x[j];
    return sum;
  }
  Index AnyVariable() { return random_.Below(static_cast<Index>(at_.x.size())); }
  double Coefficient() { return random_.Uniform(0.3, 2) * (random_.Chance(0.5) ? 1 : -1); }

  Index AddVariable(double x, double lower, double upper, double dual) {
    at_.x.push_back(x);
    at_.x_dual.push_back(dual);
    d_.x_lower.push_back(lower);
    d_.x_upper.push_back(upper);
    return static_cast<Index>(at_.x.size()) - 1;
  }
  /// Sides that are so far below and above the value of the row.
  void AddRow(const Terms& terms, double below, double above, double dual) {
    a_.push_back(RowOf(terms));
    const double value = ValueOf(a_.back());
    d_.row_lower.push_back(value - below);
    d_.row_upper.push_back(value + above);
    at_.row_dual.push_back(dual);
  }
  /// In an equation, or in a row of which one side, or none, is tight.
  void AddRowOfAnySort(const Terms& terms) {
    const bool tight = random_.Chance(0.7);
    const double size = random_.Uniform(0.1, 2), far = random_.Chance(0.5) ? kInfinity : 5;
    switch (random_.Below(3)) {
      case 0:
        return AddRow(terms, 0, 0, random_.Normal());
      case 1:
        return AddRow(terms, tight ? 0 : 1, far, tight ? size : 0);
      default:
        return AddRow(terms, far, tight ? 0 : 1, tight ? -size : 0);
    }
  }
  /// Into some of the rows, whose sides and constants follow.
  void Enter(Index j, double chance) {
    const auto enter = [&](Vector& row) {
      const double a = random_.Chance(chance) ? Coefficient() : 0;
      row.resize(at_.x.size(), 0.0);
      row[j] += a;
      return a * at_.x[j];
    };
    for (std::size_t i = 0; i < a_.size(); ++i) {
      const double term = enter(a_[i]);
      d_.row_lower[i] += term;
      d_.row_upper[i] += term;
    }
    for (std::size_t i = 0; i < f_.size(); ++i) d_.g[i] -= enter(f_[i]);
  }

  void AddSingletonRow() { AddRowOfAnySort({{AnyVariable(), Coefficient()}}); }

  // The multiplier is shared out; a side that only one of them has may be tight for it alone.
  void AddParallelRow() {
    if (a_.empty()) return;
    const auto i = static_cast<std::size_t>(random_.Below(static_cast<Index>(a_.size())));
    const double factor = Coefficient();
    Vector row = a_[i];
    for (double& v : row) v *= factor;
    double lower = d_.row_lower[i] * factor, upper = d_.row_upper[i] * factor;
    if (factor < 0) std::swap(lower, upper);
    a_.push_back(row);
    d_.row_lower.push_back(lower);
    d_.row_upper.push_back(upper);
    const double share = random_.Uniform(0, 1), dual = at_.row_dual[i];
    at_.row_dual[i] = (1 - share) * dual;
    at_.row_dual.push_back(share * dual / factor);
    if (random_.Chance(0.5)) return;
    // The old one steps back from its tight side, the new one has it all.
    const double back = random_.Uniform(0.5, 2);
    d_.row_lower[i] -= back;
    d_.row_upper[i] += back;
    at_.row_dual.back() = dual / factor;
    at_.row_dual[i] = 0;
  }

  void AddImpliedRow() {
    const Index j = AddVariable(random_.Uniform(-1, 1), -1, 1, 0);
    const Index k = AddVariable(1, -1, 1, -random_.Uniform(0, 1));
    Enter(j, 0.2);
    AddRow({{j, Coefficient()}, {k, Coefficient()}}, 10, random_.Chance(0.5) ? 10 : kInfinity, 0);
  }

  void AddFixedVariable() {
    const double value = random_.Normal();
    Enter(AddVariable(value, value, value, random_.Normal()), 0.3);
  }

  // Its bounds, where it has some, are far from what the row allows.
  void AddFreeColumn() {
    const Index other = AnyVariable();
    const Index j = AddVariable(random_.Normal(), -kInfinity, kInfinity, 0);
    if (random_.Chance(0.3)) d_.x_lower[j] = -1000;
    AddRowOfAnySort({{j, Coefficient()}, {other, Coefficient()}, {AnyVariable(), Coefficient()}});
  }

  // All of its variables meet in an inequality too.
  void AddEquation() {
    const Index one = AnyVariable(), other = AnyVariable();
    const Index j = AddVariable(random_.Normal(), -kInfinity, kInfinity, 0);
    AddRow({{j, Coefficient()}, {one, Coefficient()}, {other, Coefficient()}}, 0, 0,
           random_.Normal());
    AddRow({{j, Coefficient()}, {one, Coefficient()}, {other, Coefficient()}}, 0, kInfinity,
           random_.Uniform(0, 1));
    Enter(j, 0.1);
  }

  void AddForcingRow() {
    const bool at_upper = random_.Chance(0.5);
    Terms terms;
    for (int k = 0; k < 3; ++k) {
      const double value = random_.Normal(), size = random_.Uniform(0, 2);
      const double a = Coefficient();
      const bool at_lower = at_upper == (a > 0);
      const double far = random_.Chance(0.5) ? kInfinity : 3;
      terms.push_back({AddVariable(value, at_lower ? value : value - far,
                                   at_lower ? value + far : value, at_lower ? size : -size),
                       a});
      Enter(terms.back().column, 0.2);
    }
    const double size = random_.Uniform(0, 2);
    AddRow(terms, at_upper ? kInfinity : 0, at_upper ? 0 : kInfinity, at_upper ? -size : size);
  }

  void AddSmallCone() {
    static const sy_cone kSmall[] = {{SY_CONE_ZERO, 2, 0},         {SY_CONE_NONNEGATIVE, 3, 0},
                                     {SY_CONE_SECOND_ORDER, 1, 0}, {SY_CONE_SECOND_ORDER, 2, 0},
                                     {SY_CONE_PSD, 1, 0},          {SY_CONE_PSD, 3, 0},
                                     {SY_CONE_ROTATED, 2, 0}};
    const sy_cone cone = kSmall[random_.Below(std::size(kSmall))];
    const auto pair = PairOf(cone);
    for (std::size_t i = 0; i < pair.s.size(); ++i) {
      f_.push_back(RowOf({{AnyVariable(), Coefficient()}, {AnyVariable(), Coefficient()}}));
      d_.g.push_back(pair.s[i] - ValueOf(f_.back()));
      at_.cone_dual.push_back(pair.z[i]);
    }
    d_.cones.push_back(cone);
  }
  testing::Pair PairOf(const sy_cone& cone) {
    const double size = random_.Uniform(0.2, 2);
    if (cone.kind == SY_CONE_PSD && cone.dim == 1) return {{0}, {size}};
    if (cone.kind == SY_CONE_PSD) {  // v v' and w w' with v'w = 0
      const double a = random_.Normal(), b = random_.Normal(), root = std::sqrt(2.0);
      return {{a * a, root * a * b, b * b}, {size * b * b, -root * size * a * b, size * a * a}};
    }
    if (cone.kind == SY_CONE_ROTATED) return {{size, 0}, {0, size}};
    return testing::ComplementaryPair(cone, random_);
  }

  ProblemData d_;
  Vectors at_;
  Rows a_, f_;
  Random& random_;
};

struct Kind {
  const char* name;
  bool quadratic;
  std::vector<sy_cone> cones;
};
std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {"linear", false, {}},
      {"quadratic", true, {}},
      {"conic", false, {{SY_CONE_SECOND_ORDER, 4, 0}, {SY_CONE_ROTATED, 3, 0}}},
      {"quadratic_and_conic",
       true,
       {{SY_CONE_PSD, 6, 0}, {SY_CONE_SECOND_ORDER, 3, 0}, {SY_CONE_NONNEGATIVE, 2, 0}}},
      {"exponential", true, {{SY_CONE_EXPONENTIAL, 3, 0}, {SY_CONE_POWER, 3, 0.4}}},
  };
  return kinds;
}

testing::Shape ShapeOf(const Kind& kind, Random& random) {
  testing::Shape shape;
  shape.vars = 3 + random.Below(6);
  shape.rows = 1 + random.Below(5);
  shape.quadratic = kind.quadratic;
  shape.cones = kind.cones;
  return shape;
}

/// How far an answer is from what it says it is.
double ErrorOf(const ProblemData& d, const Answer& answer) {
  const Vectors at = VectorsOf(answer);
  switch (answer.meaning) {
    case Meaning::kRay:
      return testing::RayError(d, at.x);
    case Meaning::kContradiction:
      return testing::ContradictionError(d, at);
    default:
      return testing::OptimumError(d, at);
  }
}

class RandomPrograms : public ::testing::TestWithParam<Kind> {};

TEST_P(RandomPrograms, AnAnswerToTheReducedOneIsOneToTheWhole) {
  constexpr int kTrials = 150;
  int solved_ones = 0, smaller = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(trial);
    Random random(static_cast<unsigned>(trial));
    Growing growing(testing::KnownOptimum(ShapeOf(GetParam(), random), random), random);
    growing.Grow(5 + random.Below(25));
    const KnownAnswer known = growing.WithAnswer();
    ASSERT_LE(testing::OptimumError(known.problem, known.at), 1e-9) << "as it was made";
    const Presolve presolve(known.problem, {});
    smaller += presolve.reduced().num_vars < known.problem.num_vars ? 1 : 0;
    const Solved solved = Solve(presolve.reduced());
    if (solved.ending != conic::Ending::kOptimal) continue;  // the method's business
    ++solved_ones;
    const Answer whole = presolve.Back(solved.answer);
    const double best = ObjectiveOf(known.problem, known.at.x);
    EXPECT_LE(ErrorOf(known.problem, whole), 1e-6)
        << "that of the reduced one: " << ErrorOf(presolve.reduced(), solved.answer);
    EXPECT_NEAR(ObjectiveOf(known.problem, whole.x), best, 1e-6 * (1 + std::abs(best)));
  }
  EXPECT_GE(solved_ones, kTrials * 9 / 10);
  EXPECT_GE(smaller, kTrials * 9 / 10);
}

// Around contradictions and rays; what was added may have made them something else.
TEST_P(RandomPrograms, ACertificateOfTheReducedOneIsOneOfTheWhole) {
  constexpr int kTrials = 150;
  int contradictions = 0, rays = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(trial);
    Random random(static_cast<unsigned>(trial));
    const testing::Shape shape = ShapeOf(GetParam(), random);
    Growing growing(random.Chance(0.5) ? testing::KnownContradiction(shape, random)
                                       : testing::KnownRay(shape, random),
                    random);
    growing.Grow(5 + random.Below(15));
    const ProblemData d = growing.WithCosts();
    const Presolve presolve(d, {});
    const Solved solved = Solve(presolve.reduced());
    if (solved.ending > conic::Ending::kUnbounded) continue;
    contradictions += solved.answer.meaning == Meaning::kContradiction ? 1 : 0;
    rays += solved.answer.meaning == Meaning::kRay ? 1 : 0;
    const double of_reduced = ErrorOf(presolve.reduced(), solved.answer);
    EXPECT_LE(ErrorOf(d, presolve.Back(solved.answer)), 1e-6 + 10 * of_reduced);
  }
  EXPECT_GE(contradictions, kTrials / 20);
  EXPECT_GE(rays, kTrials / 20);
}

INSTANTIATE_TEST_SUITE_P(Presolve, RandomPrograms, ::testing::ValuesIn(Kinds()),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace switchyard::presolve
