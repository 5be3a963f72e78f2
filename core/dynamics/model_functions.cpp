#include "switchyard/dynamics/model_functions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dynamics/loaded_model.hpp"

namespace switchyard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using Model = std::shared_ptr<const LoadedModel>;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

/// tau is linear in a, and its part of a does not see v: of the second derivatives those by (v, a)
/// and (a, a) are 0.
SparsityPattern CurvaturePattern(int n) {
  SparsityPattern pattern{3 * n, 3 * n, {}, {}};
  for (int j = 0; j < 3 * n; ++j) {
    for (int i = 0; i <= j && i < (j < 2 * n ? j + 1 : n); ++i) pattern.Add(i, j);
  }
  return pattern;
}

class Efforts final : public Function {
 public:
  Efforts(Model model, std::vector<int> joints)
      : Function(3 * model->num_positions(), static_cast<int>(joints.size())),
        model_(std::move(model)),
        joints_(std::move(joints)) {
    SetJacobian(SparsityPattern::Dense(num_outputs(), num_vars()));
    SetHessian(CurvaturePattern(model_->num_positions()));
  }

  void Evaluate(const Evaluation& wanted) const override {
    const int n = model_->num_positions();
    const double *q = wanted.x, *v = q + n, *a = v + n;
    if (wanted.values != nullptr || wanted.jacobian != nullptr) {
      std::vector<double> tau(At(n)), slopes(wanted.jacobian != nullptr ? At(3 * n * n) : 0);
      double* const d = wanted.jacobian != nullptr ? slopes.data() : nullptr;
      model_->InverseDynamics(q, v, a, tau.data(), d, d != nullptr ? d + n * n : nullptr,
                              d != nullptr ? d + 2 * n * n : nullptr);
      if (wanted.values != nullptr) PickRows(tau, wanted.values);
      if (wanted.jacobian != nullptr) PickRows(slopes, wanted.jacobian);
    }
    if (wanted.hessian != nullptr) {
      std::vector<double> w(At(n), 0.0), whole(At(9 * n * n));
      for (std::size_t i = 0; i < joints_.size(); ++i) w[At(joints_[i])] += wanted.weights[i];
      model_->Hessian(q, v, a, w.data(), whole.data());
      for (int k = 0; k < hessian().size(); ++k) {
        wanted.hessian[k] = whole[At(hessian().row[At(k)] + 3 * n * hessian().col[At(k)])];
      }
    }
  }

 private:
  /// Of columns of n entries those of the joints.
  void PickRows(const std::vector<double>& columns, double* to) const {
    for (std::size_t begin = 0; begin < columns.size(); begin += At(model_->num_positions())) {
      for (const int joint : joints_) *to++ = columns[begin + At(joint)];
    }
  }

  Model model_;
  std::vector<int> joints_;
};

using Twists = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Does each coordinate move one joint of the way to the frame, in their order? Where one moves
/// several (a joint that mimics another) second derivatives are not those of the twists. Asked of
/// the model by differences of the twists at a point where nothing is special.
bool IsChain(const LoadedModel& model, int frame) {
  const int n = model.num_positions();
  Eigen::VectorXd q(n);
  for (int i = 0; i < n; ++i) q[i] = 0.3 + 0.1 * std::sin(1.0 + i);
  const auto twists = [&](int moved, double by) {
    Eigen::VectorXd x = q;
    x[moved] += by;
    Vector3d o;
    Matrix3d R;
    Twists J(6, n);
    model.Frame(frame, x.data(), o.data(), R.data(), J.data());
    return J;
  };
  constexpr double kStep = 1e-5, kSame = 1e-6;
  const Twists J = n > 0 ? twists(0, 0) : Twists(6, 0);
  for (int i = 0; i < n; ++i) {
    const Twists slopes = (twists(i, kStep) - twists(i, -kStep)) / (2 * kStep);
    for (int j = 0; j < n; ++j) {
      const Vector3d before = J.col(std::min(i, j)).tail<3>();
      Eigen::Vector<double, 6> expected = Eigen::Vector<double, 6>::Zero();
      expected.head<3>() = before.cross(J.col(std::max(i, j)).head<3>());
      if (i < j) expected.tail<3>() = before.cross(J.col(j).tail<3>());
      if ((slopes.col(j) - expected).norm() > kSame * (1 + J.norm())) return false;
    }
  }
  return true;
}

class RowsOfPose final : public Function {
 public:
  RowsOfPose(Model model, int frame, std::vector<PoseRow> rows)
      : Function(model->num_positions(), static_cast<int>(rows.size())),
        model_(std::move(model)),
        frame_(frame),
        rows_(std::move(rows)) {
    SetJacobian(SparsityPattern::Dense(num_outputs(), num_vars()));
    if (IsChain(*model_, frame_)) SetHessian(SparsityPattern::DenseUpperTriangle(num_vars()));
  }

  void Evaluate(const Evaluation& wanted) const override {
    Vector3d o;
    Matrix3d R;
    Twists J(6, num_vars());
    const bool slopes = wanted.jacobian != nullptr || wanted.hessian != nullptr;
    model_->Frame(frame_, wanted.x, o.data(), R.data(), slopes ? J.data() : nullptr);
    for (int k = 0; k < num_outputs(); ++k) {
      const PoseRow& row = rows_[At(k)];
      if (wanted.values != nullptr) {
        wanted.values[k] = row.of_position.dot(o) + Product(row.of_rotation, R) + row.constant;
      }
      if (wanted.jacobian == nullptr) continue;
      const Vector3d turning = Turning(row.of_rotation, R);
      for (int i = 0; i < num_vars(); ++i) {
        wanted.jacobian[i * num_outputs() + k] =
            row.of_position.dot(J.col(i).head<3>()) + turning.dot(J.col(i).tail<3>());
      }
    }
    if (wanted.hessian != nullptr) WriteHessian(R, J, wanted.weights, wanted.hessian);
  }

 private:
  static double Product(const Matrix3d& A, const Matrix3d& B) { return A.cwiseProduct(B).sum(); }

  /// g with tr(A' [w] R) = g'w: the sum over columns of r x a.
  static Vector3d Turning(const Matrix3d& A, const Matrix3d& R) {
    Vector3d g = Vector3d::Zero();
    for (int c = 0; c < 3; ++c) g += R.col(c).cross(A.col(c));
    return g;
  }

  /// Of the weighted rows c'o + tr(A' R): c'(w_i x v_j) + tr(A' [w_i] [w_j] R), and with M = R A'
  /// and [u] [w] = w u' - (u'w) I the latter is w_i' M w_j - (w_i'w_j) tr M.
  void WriteHessian(const Matrix3d& R, const Twists& J, const double* weights, double* to) const {
    Vector3d c = Vector3d::Zero();
    Matrix3d A = Matrix3d::Zero();
    for (int k = 0; k < num_outputs(); ++k) {
      c += weights[k] * rows_[At(k)].of_position;
      A += weights[k] * rows_[At(k)].of_rotation;
    }
    Matrix3d M = R * A.transpose();
    M.diagonal().array() -= M.trace();
    for (int j = 0; j < num_vars(); ++j) {
      const Vector3d v = J.col(j).head<3>(), w = J.col(j).tail<3>();
      for (int i = 0; i <= j; ++i) {
        const Vector3d before = J.col(i).tail<3>();
        *to++ = c.dot(before.cross(v)) + before.dot(M * w);
      }
    }
  }

  Model model_;
  int frame_;
  std::vector<PoseRow> rows_;
};

/// Second derivatives by differences of gradients over kStep radians or metres; where those to both
/// sides of q are not one, a kink, the smaller.
class Clearances final : public Function {
 public:
  Clearances(Model model, std::vector<int> pairs)
      : Function(model->num_positions(), static_cast<int>(pairs.size())),
        model_(std::move(model)),
        pairs_(std::move(pairs)) {
    SparsityPattern rows{num_outputs(), num_vars(), {}, {}};
    for (int i = 0; i < num_outputs(); ++i) {
      for (int j = 0; j < num_vars(); ++j) rows.Add(i, j);
    }
    SetJacobian(std::move(rows));
    SetHessian(SparsityPattern::DenseUpperTriangle(num_vars()));
  }

  void Evaluate(const Evaluation& wanted) const override {
    if (wanted.values != nullptr || wanted.jacobian != nullptr) {
      std::vector<double> unwanted(wanted.values == nullptr ? pairs_.size() : 0);
      model_->Distances(wanted.x, pairs_,
                        wanted.values != nullptr ? wanted.values : unwanted.data(),
                        wanted.jacobian);
    }
    if (wanted.hessian != nullptr) WriteHessian(wanted);
  }

 private:
  static constexpr double kStep = 1e-4;
  static constexpr double kKink = 0.1;

  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  static double Slope(double back, double ahead) {
    const double least = std::abs(back) < std::abs(ahead) ? back : ahead;
    return std::abs(back - ahead) <= kKink * (1 + std::abs(least)) ? (back + ahead) / 2 : least;
  }

  void WriteHessian(const Evaluation& wanted) const {
    const int n = num_vars();
    std::vector<int> weighted;  // pairs
    std::vector<double> weights;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (wanted.weights[k] == 0) continue;
      weighted.push_back(pairs_[k]);
      weights.push_back(wanted.weights[k]);
    }
    Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(wanted.x, n);
    const auto gradients = [&](int moved, double by) {
      Eigen::VectorXd x = q, d(std::ssize(weighted));
      x[moved] += by;
      Rows rows(std::ssize(weighted), n);
      model_->Distances(x.data(), weighted, d.data(), rows.data());
      return rows;
    };
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
    const Rows here = n > 0 ? gradients(0, 0) : Rows(0, 0);
    for (int j = 0; j < n && !weighted.empty(); ++j) {
      const Rows back = (here - gradients(j, -kStep)) / kStep;
      const Rows ahead = (gradients(j, kStep) - here) / kStep;
      for (Eigen::Index k = 0; k < here.rows(); ++k) {
        for (int i = 0; i < n; ++i)
          H(i, j) += weights[At(static_cast<int>(k))] * Slope(back(k, i), ahead(k, i));
      }
    }
    double* to = wanted.hessian;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i <= j; ++i) *to++ = (H(i, j) + H(j, i)) / 2;
    }
  }

  Model model_;
  std::vector<int> pairs_;
};

}  // namespace

std::shared_ptr<const Function> InverseDynamicsFunction(const RigidBodyModel& model,
                                                        std::vector<int> joints) {
  for (const int joint : joints) {
    Require(joint >= 0 && joint < model.num_positions(), "InverseDynamicsFunction: a joint of \"",
            model.name(), "\" needs an index from 0 to below ", model.num_positions(), ", got ",
            joint);
  }
  return std::make_shared<Efforts>(model.loaded(), std::move(joints));
}

std::shared_ptr<const Function> FrameFunction(const RigidBodyModel& model, int frame,
                                              std::vector<PoseRow> rows) {
  Require(frame >= 0 && frame < std::ssize(model.frames()), "FrameFunction: a frame of \"",
          model.name(), "\" needs an index from 0 to below ", model.frames().size(), ", got ",
          frame);
  return std::make_shared<RowsOfPose>(model.loaded(), frame, std::move(rows));
}

std::shared_ptr<const Function> DistanceFunction(const RigidBodyModel& model,
                                                 std::vector<int> pairs) {
  model.loaded()->CheckPairs("DistanceFunction", pairs);
  return std::make_shared<Clearances>(model.loaded(), std::move(pairs));
}

}  // namespace switchyard
