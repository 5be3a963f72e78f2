#include <algorithm>
#include <deque>

#include "core/lower/nonlinear.hpp"

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

// Room for the numbers of one term, of this thread: a program of many small terms allocates nothing
// while it is evaluated. A function that evaluates another program within has a frame of its own.
class Frame {
 public:
  Frame() : room_(Rooms()[depth_]) { ++depth_; }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  ~Frame() { --depth_; }

  const double* Point(const std::vector<int>& index, const double* x) {
    double* point = Grown(room_.point, index.size());
    for (std::size_t k = 0; k < index.size(); ++k) point[k] = x[index[k]];
    return point;
  }
  double* Values(int count) { return Grown(room_.values, At(count)); }

 private:
  struct Room {
    std::vector<double> point, values;
  };
  static std::deque<Room>& Rooms() {
    thread_local std::deque<Room> rooms;
    if (rooms.size() <= depth_) rooms.resize(depth_ + 1);
    return rooms;
  }
  static double* Grown(std::vector<double>& room, std::size_t count) {
    if (room.size() < count) room.resize(2 * count);
    return room.data();
  }

  static thread_local std::size_t depth_;
  Room& room_;
};
thread_local std::size_t Frame::depth_ = 0;

}  // namespace

bool NeedsNonlinearPart(const MathematicalProgram& program) {
  const auto& quadratic = program.quadratic_constraints();
  return !program.generic_costs().empty() || !program.generic_constraints().empty() ||
         std::any_of(quadratic.begin(), quadratic.end(),
                     [](const auto& binding) { return !binding.evaluator()->is_convex(); });
}

NonlinearTerms::NonlinearTerms(const MathematicalProgram& program, std::int32_t num_vars)
    : sign_(program.objective_sense() == ObjectiveSense::kMaximize ? -1 : 1) {
  for (const auto& binding : program.generic_costs()) Add(program, binding, true);
  for (const auto& binding : program.quadratic_constraints()) Add(program, binding, false);
  for (const auto& binding : program.generic_constraints()) Add(program, binding, false);
  Places jacobian;
  Places hessian;
  for (Term& term : costs_) AddHessianPlaces(term, hessian);
  for (Term& term : rows_) {
    term.first_jacobian = jacobian.row.size();
    for (int k = 0; k < term.jacobian.size(); ++k) {
      jacobian.row.push_back(term.first_row + term.jacobian.row[At(k)]);
      jacobian.col.push_back(term.index[At(term.jacobian.col[At(k)])]);
    }
    AddHessianPlaces(term, hessian);
  }
  jacobian_ = Scatter(num_rows_, num_vars, jacobian.row, jacobian.col);
  hessian_ = Scatter(num_vars, num_vars, hessian.row, hessian.col);
}

template <class C>
void NonlinearTerms::Add(const MathematicalProgram& program, const Binding<C>& binding,
                         bool is_cost) {
  Term term;
  term.evaluator = binding.evaluator();
  term.index = program.FindDecisionVariableIndices(binding.variables());
  LookAtDerivatives(*term.evaluator);
  if (term.evaluator->has_jacobian()) term.jacobian = term.evaluator->JacobianPattern();
  if (term.evaluator->has_hessian()) term.hessian = term.evaluator->HessianPattern();
  thread_safe_ = thread_safe_ && term.evaluator->is_thread_safe();
  if (!is_cost) {
    term.first_row = num_rows_;
    num_rows_ += term.evaluator->num_outputs();
  }
  (is_cost ? costs_ : rows_).push_back(std::move(term));
}

void NonlinearTerms::LookAtDerivatives(const EvaluatorBase& evaluator) {
  if (!evaluator.has_jacobian()) {
    provides_ &= ~std::uint32_t{SY_GRADIENT | SY_JACOBIAN | SY_HESSIAN};
  }
  if (!evaluator.has_hessian()) provides_ &= ~std::uint32_t{SY_HESSIAN};
}

void NonlinearTerms::AddHessianPlaces(Term& term, Places& places) {
  term.first_hessian = places.row.size();
  const SparsityPattern& pattern = term.hessian;
  term.folded.resize(At(pattern.size()), 0);
  for (std::size_t k = 0; k < At(pattern.size()); ++k) {
    const int a = term.index[At(pattern.row[k])];
    const int b = term.index[At(pattern.col[k])];
    places.row.push_back(std::min(a, b));
    places.col.push_back(std::max(a, b));
    if (pattern.row[k] != pattern.col[k] && a == b) term.folded[k] = 1;
  }
}

bool NonlinearTerms::SamePatterns() const {
  const auto same = [](const Term& term) {
    return (!term.evaluator->has_jacobian() ||
            term.evaluator->JacobianPattern() == term.jacobian) &&
           (!term.evaluator->has_hessian() || term.evaluator->HessianPattern() == term.hessian);
  };
  return std::all_of(costs_.begin(), costs_.end(), same) &&
         std::all_of(rows_.begin(), rows_.end(), same);
}

double NonlinearTerms::Objective(const double* x) const {
  Frame frame;
  double sum = 0;
  for (const Term& term : costs_) {
    double value = 0;
    term.evaluator->Evaluate({.x = frame.Point(term.index, x), .values = &value});
    sum += value;
  }
  return sign_ * sum;
}

void NonlinearTerms::Gradient(const double* x, double* gradient) const {
  Frame frame;
  std::fill_n(gradient, jacobian_.pattern.cols, 0.0);
  for (const Term& term : costs_) {
    double* own = frame.Values(term.jacobian.size());
    term.evaluator->Evaluate({.x = frame.Point(term.index, x), .jacobian = own});
    for (std::size_t k = 0; k < At(term.jacobian.size()); ++k) {
      gradient[term.index[At(term.jacobian.col[k])]] += sign_ * own[k];
    }
  }
}

void NonlinearTerms::Constraints(const double* x, double* values) const {
  Frame frame;
  for (const Term& term : rows_) {
    term.evaluator->Evaluate({.x = frame.Point(term.index, x), .values = values + term.first_row});
  }
}

void NonlinearTerms::Jacobian(const double* x, double* values) const {
  Frame frame;
  std::fill_n(values, jacobian_.pattern.nonzeros(), 0.0);
  for (const Term& term : rows_) {
    double* own = frame.Values(term.jacobian.size());
    term.evaluator->Evaluate({.x = frame.Point(term.index, x), .jacobian = own});
    const std::int32_t* slot = jacobian_.slot.data() + term.first_jacobian;
    for (std::size_t k = 0; k < At(term.jacobian.size()); ++k) values[slot[k]] += own[k];
  }
}

void NonlinearTerms::Hessian(const double* x, double weight, const double* multipliers,
                             double* values) const {
  Frame frame;
  std::fill_n(values, hessian_.pattern.nonzeros(), 0.0);
  const auto add = [&](const Term& term, const double* weights) {
    if (term.hessian.size() == 0) return;
    double* own = frame.Values(term.hessian.size());
    term.evaluator->Evaluate({.x = frame.Point(term.index, x), .weights = weights, .hessian = own});
    const std::int32_t* slot = hessian_.slot.data() + term.first_hessian;
    for (std::size_t k = 0; k < At(term.hessian.size()); ++k) {
      values[slot[k]] += (term.folded[k] != 0 ? 2 : 1) * own[k];
    }
  };
  const double of_costs = sign_ * weight;
  for (const Term& term : costs_) add(term, &of_costs);
  for (const Term& term : rows_) add(term, multipliers + term.first_row);
}

}  // namespace switchyard
