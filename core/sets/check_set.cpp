#include "switchyard/sets/check_set.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <exception>

#include "core/sets/set_program.hpp"
#include "switchyard/error.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr double kClearlyOutside = 1e-3;  // per unit of the set's size
constexpr double kTowardsCenter = 0.9;

std::string Shown(const Eigen::VectorXd& x) {
  std::string text = "(";
  for (Eigen::Index i = 0; i < x.size(); ++i) text += Text(i > 0 ? ", " : "", x[i]);
  return text + ")";
}

class Checker {
 public:
  Checker(const ConvexSet& set, const CheckSetOptions& options)
      : set_(set), n_(set.ambient_dimension()), options_(options), random_(options.seed) {}

  std::vector<std::string> Run() {
    Ask("emptiness", [this] { Emptiness(); });
    Ask("its clone", [this] { CloneIsEqual(); });
    if (n_ == 0 || set_.IsEmpty()) return std::move(found_);
    Ask("points of it", [this] { FindPoints(); });
    Ask("its box", [this] { InBox(); });
    Ask("the support function", [this] { Support(); });
    Ask("nearest points", [this] { NearestPoints(); });
    Ask("multiples", [this] { Multiples(); });
    Ask("sums of multiples", [this] { Sums(); });
    Ask("the multiple 0", [this] { Recession(); });
    Ask("the general scaling", [this] { GeneralScaling(); });
    return std::move(found_);
  }

 private:
  template <class Question>
  void Ask(const char* what, Question&& question) {
    try {
      question();
    } catch (const std::exception& e) {
      found_.push_back(Text(set_.Kind(), ": ", what, " could not be asked for: ", e.what()));
    }
  }
  template <class... Parts>
  void Expect(bool holds, const Parts&... parts) {
    if (!holds) found_.push_back(Text(set_.Kind(), ": ", parts...));
  }

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::VectorXd Vector(Eigen::Index size, double reach) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return Uniform(-reach, reach); });
  }
  [[nodiscard]] bool Inside(const Eigen::VectorXd& x, double scale = 1) const {
    return set_.PointInSet(x, options_.tolerance * size_ * scale);
  }
  [[nodiscard]] bool Outside(const Eigen::VectorXd& x) const {
    return !set_.PointInSet(x, kClearlyOutside * size_);
  }

  void Emptiness();
  void CloneIsEqual();
  void FindPoints();
  void InBox();
  void Support();
  void NearestPoints();
  void Multiples();
  void Sums();
  void Recession();
  void GeneralScaling();
  [[nodiscard]] double SupportByProgram(const Eigen::VectorXd& a) const;
  [[nodiscard]] bool Feasible(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                              const Eigen::VectorXd& c, double d, const Eigen::VectorXd& x,
                              const Eigen::VectorXd& t) const;
  [[nodiscard]] bool Feasible(const Eigen::VectorXd& x, double t) const {
    return Feasible(Eigen::MatrixXd::Identity(n_, n_), Eigen::VectorXd::Zero(n_),
                    Eigen::VectorXd::Ones(1), 0, x, Eigen::VectorXd::Constant(1, t));
  }

  const ConvexSet& set_;
  int n_;
  CheckSetOptions options_;
  RandomGenerator random_;
  double size_ = 1;
  Eigen::VectorXd center_;
  std::vector<Eigen::VectorXd> inside_;   // the center first
  std::vector<Eigen::VectorXd> outside_;  // clearly
  std::vector<std::string> found_;
};

// Is (Ax + b) in (c't + d) S for these x and t, by the constraints that the set adds?
bool Checker::Feasible(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& c,
                       double d, const Eigen::VectorXd& x, const Eigen::VectorXd& t) const {
  MathematicalProgram program;
  const auto xs = program.NewContinuousVariables(static_cast<int>(x.size()), "x");
  const auto ts = program.NewContinuousVariables(static_cast<int>(t.size()), "t");
  set_.AddPointInNonnegativeScalingConstraints(&program, A, b, c, d, xs, ts);
  if (program.num_vars() == x.size() + t.size()) {
    Eigen::VectorXd all(x.size() + t.size());
    all << x, t;
    return program.CheckSatisfied(program.GetAllConstraints(), all, options_.tolerance * size_);
  }
  program.AddBoundingBoxConstraint(x, x, xs);
  program.AddBoundingBoxConstraint(t, t, ts);
  const MathematicalProgramResult result = Solve(program);
  if (result.termination == Termination::kInfeasible) return false;
  if (result.primal == PointKind::kFeasible) return true;
  CouldNotTell(set_.Kind(), "whether a point is in a multiple", result);
}

double Checker::SupportByProgram(const Eigen::VectorXd& a) const {
  SetProgram maximize(set_);
  maximize.program.AddLinearCost(a, maximize.x);
  maximize.program.set_objective_sense(ObjectiveSense::kMaximize);
  const MathematicalProgramResult result = Solve(maximize.program);
  if (result.is_success()) return result.objective;
  if (result.termination == Termination::kUnbounded) return kInfinity;
  const RecessionProgram away(set_, a);
  if (away.Value(Solve(away.program)) > options_.tolerance) return kInfinity;
  CouldNotTell(set_.Kind(), "the maximum of a linear function", result);
}

void Checker::Emptiness() {
  const auto point = set_.MaybeGetFeasiblePoint();
  Expect(point.has_value() == !set_.IsEmpty(), "IsEmpty() is ", set_.IsEmpty(),
         ", but MaybeGetFeasiblePoint() has ", point.has_value() ? "a point" : "none");
  const auto only = set_.MaybeGetPoint();
  Expect(!only || (only->size() == n_ && set_.PointInSet(*only, options_.tolerance)),
         "MaybeGetPoint() is not in the set");
  if (point) {
    size_ = 1 + point->lpNorm<Eigen::Infinity>();
    Expect(point->size() == n_ && Inside(*point), "the feasible point ", Shown(*point), " is ",
           set_.Violation(*point), " outside");
    return;
  }
  const bool projects = set_.Projection(Eigen::MatrixXd::Zero(n_, 1)).has_value();
  Expect(!projects, "is empty, but has nearest points");
  const double support = set_.SupportFunction(Eigen::VectorXd::Zero(n_));
  Expect(support == -kInfinity, "is empty, but its support function is ", support);
  Expect(set_.IsBounded(), "is empty, but not bounded");
}

void Checker::CloneIsEqual() {
  const std::unique_ptr<ConvexSet> clone = set_.Clone();
  Expect(clone->Kind() == set_.Kind(), "its clone is a ", clone->Kind());
  Expect(clone->ambient_dimension() == n_, "its clone is in R^", clone->ambient_dimension(),
         ", it in R^", n_);
  Expect(clone->IsEmpty() == set_.IsEmpty(), "its clone differs in IsEmpty()");
  if (clone->ambient_dimension() != n_ || set_.IsEmpty()) return;
  for (int k = 0; k < options_.num_points; ++k) {
    const Eigen::VectorXd x = Vector(n_, 2 * size_);
    const double own = set_.Violation(x);
    const double others = clone->Violation(x);
    Expect(std::abs(own - others) <= options_.tolerance * size_, "its clone has the violation ",
           others, " at ", Shown(x), ", it has ", own);
  }
}

// Nearest points of S are on its boundary; drawn towards their mean they are not, unless S is flat.
void Checker::FindPoints() {
  const Eigen::VectorXd start = *set_.MaybeGetFeasiblePoint();
  const SetBox& box = set_.bounding_box();
  const Eigen::ArrayXd sides = (box.upper - box.lower).array();
  const double reach = 2 * sides.isFinite().select(sides, 2.0).maxCoeff() + 1e-3;
  Eigen::MatrixXd drawn(n_, options_.num_points);
  for (int k = 0; k < options_.num_points; ++k) drawn.col(k) = start + Vector(n_, reach);
  const Eigen::MatrixXd nearest = set_.Projection(drawn)->second;
  center_ = 0.5 * (start + nearest.rowwise().mean());
  size_ = 1 + std::max(nearest.cwiseAbs().maxCoeff(), center_.lpNorm<Eigen::Infinity>());
  inside_.push_back(center_);
  for (int k = 0; k < options_.num_points; ++k) {
    inside_.emplace_back(center_ + kTowardsCenter * (nearest.col(k) - center_));
    if (Outside(drawn.col(k))) outside_.emplace_back(drawn.col(k));
    if (set_.PointInSet(drawn.col(k))) inside_.emplace_back(drawn.col(k));
  }
  for (const Eigen::VectorXd& x : inside_) {
    Expect(Inside(x), "the point ", Shown(x), " between points of it is ", set_.Violation(x),
           " outside");
  }
}

void Checker::InBox() {
  const SetBox& box = set_.bounding_box();
  Expect(!box.empty, "its box says that it is empty");
  Expect(!box.is_finite() || set_.IsBounded(), "its box is finite, but IsBounded() is false");
  const double margin = options_.tolerance * size_;
  for (const Eigen::VectorXd& x : inside_) {
    const bool in = (x.array() >= box.lower.array() - margin).all() &&
                    (x.array() <= box.upper.array() + margin).all();
    Expect(in, "its box does not hold its point ", Shown(x));
  }
}

void Checker::Support() {
  const SetBox& box = set_.bounding_box();
  for (int k = 0; k < options_.num_points; ++k) {
    const Eigen::VectorXd a =
        k < n_ ? Eigen::VectorXd(Eigen::VectorXd::Unit(n_, k)) : Vector(n_, 1);
    const double margin = options_.tolerance * size_ * (1 + a.lpNorm<1>());
    const double support = set_.SupportFunction(a);
    for (const Eigen::VectorXd& x : inside_) {
      Expect(a.dot(x) <= support + margin, "the support function along ", Shown(a), " is ", support,
             ", below ", a.dot(x), " at its point ", Shown(x));
    }
    double largest = 0;
    for (int i = 0; i < n_; ++i) {
      if (a[i] != 0) largest += a[i] * (a[i] > 0 ? box.upper[i] : box.lower[i]);
    }
    Expect(support <= largest + margin, "the support function along ", Shown(a), " is ", support,
           ", above ", largest, " of its box");
    const double maximum = SupportByProgram(a);
    const bool same =
        std::isinf(maximum) ? support == maximum : std::abs(support - maximum) <= 10 * margin;
    Expect(same, "the support function along ", Shown(a), " is ", support, ", the maximum ",
           maximum);
  }
}

void Checker::NearestPoints() {
  std::vector<Eigen::VectorXd> all = inside_;
  all.insert(all.end(), outside_.begin(), outside_.end());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Eigen::VectorXd& x = all[k];
    const auto [distances, points] = *set_.Projection(x);
    const Eigen::VectorXd nearest = points;
    Expect(Inside(nearest, 10), "the point nearest to ", Shown(x), " is ", set_.Violation(nearest),
           " outside");
    Expect(std::abs(distances[0] - (nearest - x).norm()) <= options_.tolerance * size_,
           "the distance ", distances[0], " of ", Shown(x), " is not that to its nearest point");
    const bool is_inside = k < inside_.size();
    Expect(!is_inside || distances[0] <= 100 * options_.tolerance * size_, "its point ", Shown(x),
           " has the distance ", distances[0]);
    Expect(is_inside || distances[0] > 0, "the point ", Shown(x), " outside has the distance 0");
    for (const Eigen::VectorXd& y : inside_) {
      const double ahead = (x - nearest).dot(y - nearest);
      Expect(ahead <= 100 * options_.tolerance * size_ * size_, "its point ", Shown(y),
             " is nearer to ", Shown(x), " than the nearest, ", Shown(nearest));
    }
  }
}

void Checker::Multiples() {
  for (const double t : {0.01, 0.5, 3.0}) {
    for (const Eigen::VectorXd& x : inside_) {
      Expect(Feasible(t * x, t), t, " times its point ", Shown(x), " is not in ", t, " S");
    }
    for (const Eigen::VectorXd& x : outside_) {
      if (t < 0.1) continue;  // then it is not clearly outside
      Expect(!Feasible(t * x, t), t, " times ", Shown(x), ", outside, is in ", t, " S");
    }
    if (!outside_.empty()) {
      Expect(!Feasible(-t * center_, -t), "the scale ", -t, " is not refused");
    }
  }
}

void Checker::Sums() {
  for (std::size_t k = 1; k < inside_.size(); ++k) {
    const double t1 = Uniform(0.1, 2);
    const double t2 = Uniform(0.1, 2);
    const Eigen::VectorXd sum = t1 * inside_[k - 1] + t2 * inside_[k];
    Expect(Inside(sum / (t1 + t2)), "between its points ", Shown(inside_[k - 1]), " and ",
           Shown(inside_[k]), " is one outside");
    Expect(Feasible(sum, t1 + t2), t1, " times its point ", Shown(inside_[k - 1]), " and ", t2,
           " times ", Shown(inside_[k]), " do not add up to a point of ", t1 + t2, " S");
  }
}

void Checker::Recession() {
  Expect(Feasible(Eigen::VectorXd::Zero(n_), 0), "0 is not in 0 S");
  bool bounded = true;
  for (int i = 0; i < n_; ++i) {
    for (const double sign : {1.0, -1.0}) {
      const RecessionProgram away(set_, sign * Eigen::VectorXd::Unit(n_, i));
      const MathematicalProgramResult result = Solve(away.program);
      if (away.Value(result) < 0.5) continue;
      bounded = false;
      const Eigen::VectorXd r = result.get_x_val().head(n_);
      for (const double far : {1.0, 10.0}) {
        Expect(Inside(center_ + far * r, 1 + far), Shown(r), " is in 0 S, but from its point ",
               Shown(center_), " leads outside");
      }
    }
  }
  Expect(bounded || !set_.IsBounded(), "IsBounded(), but 0 S holds more than 0");
  for (const Eigen::VectorXd& x : outside_) {
    if (set_.IsBounded()) {
      Expect(!Feasible(x - center_, 0), "is bounded, but 0 S holds ", Shown(x - center_));
    }
  }
}

// Points are aimed at: with A of full row rank, Ax + b is what is wanted.
void Checker::GeneralScaling() {
  std::vector<Eigen::VectorXd> all = inside_;
  all.insert(all.end(), outside_.begin(), outside_.end());
  for (std::size_t k = 0; k < all.size(); ++k) {
    Eigen::MatrixXd A(n_, n_ + 1);
    A << Eigen::MatrixXd::Identity(n_, n_), Vector(n_, 1);
    for (int i = 1; i < n_; ++i) A(i, i - 1) = Uniform(-1, 1);
    const Eigen::VectorXd b = Vector(n_, size_);
    const Eigen::VectorXd c = Vector(2, 1);
    const double d = Uniform(-1, 2);
    const Eigen::VectorXd t = Vector(2, 2);
    const double scale = c.dot(t) + d;
    const Eigen::VectorXd point = (std::abs(scale) > 0.1 ? scale : 0.1) * all[k];
    const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(point - b);
    const bool in = Feasible(A, b, c, d, x, t);
    if (scale > 0.1) {
      Expect(in == (k < inside_.size()), "with A, b, c, d and the scale ", scale, " the point ",
             Shown(all[k]), in ? ", outside, is inside" : ", inside, is outside");
    } else if (scale < -0.1) {
      Expect(!in, "with A, b, c, d the scale ", scale, " is not refused");
    }
  }
}

}  // namespace

std::vector<std::string> CheckConvexSet(const ConvexSet& set, const CheckSetOptions& options) {
  Require(options.num_points > 0, "CheckConvexSet needs num_points of 1 or more, got ",
          options.num_points);
  Require(options.tolerance > 0, "CheckConvexSet needs a tolerance above 0, got ",
          options.tolerance);
  return Checker(set, options).Run();
}

}  // namespace switchyard
