#include "core/trajectory/kinematic_point.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace switchyard {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

/// Numbers places as they come, each once.
class Places {
 public:
  Places(int rows, int cols) : pattern_{rows, cols, {}, {}} {}
  int Of(int i, int j) {
    const auto [place, is_new] = index_.try_emplace({i, j}, pattern_.size());
    if (is_new) pattern_.Add(i, j);
    return place->second;
  }
  [[nodiscard]] const SparsityPattern& pattern() const { return pattern_; }

 private:
  SparsityPattern pattern_;
  std::map<std::pair<int, int>, int> index_;
};

/// F(x) = c T^e f(w(x)), e = 0 or 1, J and H those of f, w' and w'' those of w:
///
///   F'  = c T^e J w' + c e f
///   F'' = c T^e (w'^T H w' + sum_m g_m w''_m) + c e (e_T (w'^T g)^T + (w'^T g) e_T^T), g = J^T l
///
/// for multipliers l. A value w_m of derivative d has the slopes T^-d a to its control points and
/// -d w_m / T to T, and the curvatures -d T^-d-1 a between both and d (d + 1) w_m / T^2 at T.
class FunctionAtPoint final : public Function {
 public:
  FunctionAtPoint(std::shared_ptr<const EvaluatorBase> f, const CurvePoint& point, double weight,
                  bool timed)
      : Function(point.num_point_vars() + (point.moves() || timed ? 1 : 0), f->num_outputs()),
        f_(std::move(f)),
        point_(point),
        weight_(weight),
        timed_(timed),
        T_(point.num_point_vars()) {
    set_is_thread_safe(f_->is_thread_safe());
    for (int m = 0; m < point_.num_values(); ++m) slopes_.push_back(SlopesOf(m));
    if (!f_->has_jacobian()) return;
    inner_jacobian_ = f_->JacobianPattern();
    PlanJacobian();
    if (!f_->has_hessian()) return;
    inner_hessian_ = f_->HessianPattern();
    PlanHessian();
  }

  void Evaluate(const Evaluation& wanted) const override {
    const State at = StateAt(wanted.x);
    const bool needs_slopes = wanted.jacobian != nullptr || wanted.hessian != nullptr;
    std::vector<double> f(At(num_outputs())), J(At(inner_jacobian_.size()));
    std::vector<double> H(wanted.hessian != nullptr ? At(inner_hessian_.size()) : 0);
    f_->Evaluate({.x = at.w.data(),
                  .values = wanted.values != nullptr || timed_ ? f.data() : nullptr,
                  .jacobian = needs_slopes ? J.data() : nullptr,
                  .weights = wanted.weights,
                  .hessian = wanted.hessian != nullptr ? H.data() : nullptr});
    if (wanted.values != nullptr) {
      for (std::size_t i = 0; i < f.size(); ++i) wanted.values[i] = at.factor * f[i];
    }
    if (wanted.jacobian != nullptr) WriteJacobian(at, f, J, wanted.jacobian);
    if (wanted.hessian != nullptr) WriteHessian(at, J, H, wanted.weights, wanted.hessian);
  }

 private:
  /// Where a value's slopes stand: variables, and by which column's weight; T, where it is one of
  /// them, last with column -1.
  struct Slope {
    int var;
    int column;
  };
  /// What one entry of an inner derivative adds to: places in the order of the slopes.
  using Slots = std::vector<int>;
  struct State {
    double T = 1;
    double factor = 1;  // weight T^e
    Eigen::VectorXd w;
    std::vector<std::vector<double>> slopes;  // of each value
  };

  [[nodiscard]] std::vector<Slope> SlopesOf(int m) const {
    const int d = point_.values()[At(m)].derivative;
    std::vector<Slope> slopes;
    for (int c = 0; c < point_.columns(); ++c) {
      if (point_.weights(d)[c] != 0) slopes.push_back({point_.FirstVar(m) + c, c});
    }
    if (d > 0) slopes.push_back({T_, -1});
    return slopes;
  }

  [[nodiscard]] State StateAt(const double* x) const {
    State at;
    if (num_vars() > T_) at.T = x[T_];
    at.factor = timed_ ? weight_ * at.T : weight_;
    at.w.resize(point_.num_values());
    at.slopes.resize(slopes_.size());
    for (int m = 0; m < point_.num_values(); ++m) {
      const int d = point_.values()[At(m)].derivative;
      const double power = std::pow(at.T, -d);
      double value = 0;
      std::vector<double>& own = at.slopes[At(m)];
      own.reserve(slopes_[At(m)].size());
      for (const Slope& slope : slopes_[At(m)]) {
        own.push_back(slope.column < 0 ? -d * value / at.T
                                       : power * point_.weights(d)[slope.column]);
        if (slope.column >= 0) value += own.back() * x[slope.var];
      }
      at.w[m] = value;
    }
    return at;
  }

  void PlanJacobian() {
    Places places(num_outputs(), num_vars());
    for (int k = 0; k < inner_jacobian_.size(); ++k) {
      for (const Slope& slope : slopes_[At(inner_jacobian_.col[At(k)])]) {
        jacobian_slots_.push_back(places.Of(inner_jacobian_.row[At(k)], slope.var));
      }
    }
    for (int i = 0; timed_ && i < num_outputs(); ++i) timed_slots_.push_back(places.Of(i, T_));
    SetJacobian(places.pattern());
  }

  void WriteJacobian(const State& at, const std::vector<double>& f, const std::vector<double>& J,
                     double* to) const {
    std::fill_n(to, jacobian().size(), 0.0);
    const int* slot = jacobian_slots_.data();
    for (std::size_t k = 0; k < J.size(); ++k) {
      for (const double slope : at.slopes[At(inner_jacobian_.col[k])]) {
        to[*slot++] += at.factor * J[k] * slope;
      }
    }
    for (std::size_t i = 0; i < timed_slots_.size(); ++i) to[timed_slots_[i]] += weight_ * f[i];
  }

  static bool Once(bool same, std::size_t a, std::size_t b) { return !same || a <= b; }

  void PlanHessian() {
    Places places(num_vars(), num_vars());
    const auto add = [&](int i, int j) {
      hessian_slots_.push_back(places.Of(std::min(i, j), std::max(i, j)));
    };
    for (int k = 0; k < inner_hessian_.size(); ++k) {
      const int m = inner_hessian_.row[At(k)], l = inner_hessian_.col[At(k)];
      const auto &left = slopes_[At(m)], &right = slopes_[At(l)];
      for (std::size_t a = 0; a < left.size(); ++a) {
        for (std::size_t b = 0; b < right.size(); ++b) {
          if (Once(m == l, a, b)) add(left[a].var, right[b].var);
        }
      }
    }
    for (int m = 0; m < point_.num_values(); ++m) {
      if (!timed_ && point_.values()[At(m)].derivative == 0) continue;
      for (const Slope& slope : slopes_[At(m)]) add(slope.var, T_);
    }
    SetHessian(places.pattern());
  }

  void WriteHessian(const State& at, const std::vector<double>& J, const std::vector<double>& H,
                    const double* multipliers, double* to) const {
    std::fill_n(to, hessian().size(), 0.0);
    const int* slot = hessian_slots_.data();
    for (std::size_t k = 0; k < H.size(); ++k) {
      const int m = inner_hessian_.row[k], l = inner_hessian_.col[k];
      const auto &left = slopes_[At(m)], &right = slopes_[At(l)];
      for (std::size_t a = 0; a < left.size(); ++a) {
        for (std::size_t b = 0; b < right.size(); ++b) {
          if (!Once(m == l, a, b)) continue;
          const bool doubled = m != l && left[a].var == right[b].var;
          to[*slot++] +=
              (doubled ? 2 : 1) * at.factor * H[k] * at.slopes[At(m)][a] * at.slopes[At(l)][b];
        }
      }
    }
    std::vector<double> g(At(point_.num_values()), 0.0);
    for (std::size_t k = 0; k < J.size(); ++k) {
      g[At(inner_jacobian_.col[k])] += J[k] * multipliers[inner_jacobian_.row[k]];
    }
    for (int m = 0; m < point_.num_values(); ++m) {
      const int d = point_.values()[At(m)].derivative;
      if (!timed_ && d == 0) continue;
      for (std::size_t a = 0; a < slopes_[At(m)].size(); ++a) {
        const double slope = at.slopes[At(m)][a];
        const bool is_T = slopes_[At(m)][a].column < 0;
        const double curvature = -(is_T ? d + 1 : d) * slope / at.T;
        const double of_time = timed_ ? (is_T ? 2 : 1) * weight_ * slope : 0;
        to[*slot++] += g[At(m)] * (at.factor * curvature + of_time);
      }
    }
  }

  std::shared_ptr<const EvaluatorBase> f_;
  CurvePoint point_;
  double weight_;
  bool timed_;
  int T_;                                   // its variable
  std::vector<std::vector<Slope>> slopes_;  // of each value
  SparsityPattern inner_jacobian_, inner_hessian_;
  Slots jacobian_slots_, timed_slots_, hessian_slots_;
};

}  // namespace

CurvePoint::CurvePoint(const BsplineBasis<double>& basis, double s, std::vector<Value> values)
    : values_(std::move(values)) {
  for (const Value& value : values_) {
    joints_.push_back(value.joint);
    highest_ = std::max(highest_, value.derivative);
  }
  lowest_ = highest_;
  for (const Value& value : values_) lowest_ = std::min(lowest_, value.derivative);
  std::sort(joints_.begin(), joints_.end());
  joints_.erase(std::unique(joints_.begin(), joints_.end()), joints_.end());
  Eigen::MatrixXd weights(basis.order(), 3);
  for (int d = 0; d < 3; ++d) {
    auto active = basis.ActiveAt(s, d);
    first_ = active.first;
    weights.col(d) = active.weights;
  }
  const auto unseen = [&](Eigen::Index c) {
    return weights.row(c).segment(lowest_, highest_ - lowest_ + 1).isZero(0);
  };
  Eigen::Index begin = 0, end = weights.rows();
  while (end > 1 && unseen(end - 1)) --end;
  while (begin < end - 1 && unseen(begin)) ++begin;
  first_ += static_cast<int>(begin);
  for (int d = 0; d < 3; ++d) weights_[At(d)] = weights.col(d).segment(begin, end - begin);
  for (const Value& value : values_) {
    const auto joint = std::lower_bound(joints_.begin(), joints_.end(), value.joint);
    first_var_.push_back(static_cast<int>(joint - joints_.begin()) * columns());
  }
}

SparseMatrix CurvePoint::Map() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (int m = 0; m < num_values(); ++m) {
    const Eigen::VectorXd& a = weights(values_[At(m)].derivative);
    for (int c = 0; c < columns(); ++c) {
      if (a[c] != 0) entries.emplace_back(m, FirstVar(m) + c, a[c]);
    }
  }
  SparseMatrix W(num_values(), num_point_vars());
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

std::shared_ptr<const Function> AtCurvePoint(std::shared_ptr<const EvaluatorBase> f,
                                             const CurvePoint& point, double weight, bool timed) {
  return std::make_shared<FunctionAtPoint>(std::move(f), point, weight, timed);
}

}  // namespace switchyard
