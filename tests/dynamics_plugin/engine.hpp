// What the tests of the table "sy.dynamics/1" of the plugin pinocchio are written with: the table
// as a program finds it, models, and differences.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/dynamics.h"
#include "switchyard/host/host.hpp"

namespace switchyard::dynamics_plugin {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

inline const sy_dynamics& Table() {
  static const auto* const table = [] {
    HostOptions options;
    options.files = {SWITCHYARD_PLUGIN_FOLDER "/pinocchio.so"};
    options.folders = std::vector<std::string>();
    static Host host(std::move(options));
    const std::vector<PluginTable> found = host.Tables("sy.dynamics/1");
    if (found.size() != 1) throw std::runtime_error("pinocchio.so offers no table");
    return static_cast<const sy_dynamics*>(found[0].table);
  }();
  return *table;
}

struct Source {
  sy_model_format format = SY_MODEL_URDF;
  std::string path = {};
  std::string text = {};
  std::vector<std::string> packages = {};
  std::vector<std::pair<std::string, double>> locked = {};
  Vector3d gravity = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool geometry = false;
};

struct Failed {
  sy_status code;
  std::string text;
};

/// A model of the table, or why there is none.
class Model {
 public:
  explicit Model(const Source& source) {
    std::vector<const char*> packages, locked;
    std::vector<double> positions;
    for (const std::string& folder : source.packages) packages.push_back(folder.c_str());
    for (const auto& [name, position] : source.locked) {
      locked.push_back(name.c_str());
      positions.push_back(position);
    }
    sy_dynamics_source s{};
    s.size = sizeof s;
    s.format = source.format;
    s.path = source.path.empty() ? nullptr : source.path.c_str();
    s.text = source.path.empty() ? source.text.c_str() : nullptr;
    s.packages = packages.data();
    s.num_packages = static_cast<std::int32_t>(packages.size());
    s.num_locked = static_cast<std::int32_t>(locked.size());
    s.locked = locked.data();
    s.locked_position = positions.data();
    for (int i = 0; i < 3; ++i) s.gravity[i] = source.gravity[i];
    s.geometry = source.geometry ? 1 : 0;
    sy_error error{};
    const sy_status status = Table().load(&s, &model_, &error);
    if (status != SY_OK) throw Failed{status, error.text};
  }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model() { Table().destroy(model_); }

  [[nodiscard]] const sy_model_facts& facts() const { return *Table().facts(model_); }
  [[nodiscard]] int n() const { return facts().num_positions; }
  [[nodiscard]] const sy_joint& joint(int i) const { return *facts().joints[i]; }

  [[nodiscard]] int FrameNamed(const std::string& name) const {
    for (int i = 0; i < facts().num_frames; ++i) {
      if (facts().frames[i] == name) return i;
    }
    ADD_FAILURE() << "no frame " << name;
    return 0;
  }

  struct Efforts {
    VectorXd tau;
    MatrixXd d_q, d_v, d_a;
  };
  [[nodiscard]] Efforts Derivatives(const VectorXd& q, const VectorXd& v, const VectorXd& a) const {
    Efforts e{VectorXd(n()), MatrixXd(n(), n()), MatrixXd(n(), n()), MatrixXd(n(), n())};
    Check(Table().inverse_dynamics(model_, q.data(), v.data(), a.data(), e.tau.data(), e.d_q.data(),
                                   e.d_v.data(), e.d_a.data(), &error_));
    return e;
  }
  [[nodiscard]] VectorXd Tau(const VectorXd& q, const VectorXd& v, const VectorXd& a) const {
    VectorXd tau(n());
    sy_error error{};
    Check(Table().inverse_dynamics(model_, q.data(), v.data(), a.data(), tau.data(), nullptr,
                                   nullptr, nullptr, &error));
    return tau;
  }
  [[nodiscard]] MatrixXd Hessian(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                 const VectorXd& w) const {
    MatrixXd hessian(3 * n(), 3 * n());
    Check(Table().inverse_dynamics_hessian(model_, q.data(), v.data(), a.data(), w.data(),
                                           hessian.data(), &error_));
    return hessian;
  }
  struct Placed {
    Vector3d position;
    Matrix3d rotation;
    MatrixXd jacobian;
  };
  [[nodiscard]] Placed Frame(int frame, const VectorXd& q) const {
    Placed p{{}, {}, MatrixXd(6, n())};
    Check(Table().frame(model_, frame, q.data(), p.position.data(), p.rotation.data(),
                        p.jacobian.data(), &error_));
    return p;
  }
  struct Apart {
    VectorXd distances;
    MatrixXd gradients;  // a row for each pair
  };
  [[nodiscard]] Apart Distances(const VectorXd& q, const std::vector<std::int32_t>& pairs) const {
    const auto num = static_cast<std::int32_t>(pairs.size());
    Apart apart{VectorXd(num), MatrixXd(num, n())};
    MatrixXd by_rows(n(), num);
    Check(Table().distances(model_, q.data(), pairs.data(), num, apart.distances.data(),
                            by_rows.data(), &error_));
    apart.gradients = by_rows.transpose();
    return apart;
  }
  [[nodiscard]] const sy_dynamics_model* get() const { return model_; }

 private:
  void Check(sy_status status) const {
    if (status != SY_OK) throw Failed{status, error_.text};
  }

  sy_dynamics_model* model_ = nullptr;
  mutable sy_error error_{};
};

/// Why a source cannot be loaded; no code where it can.
inline Failed Refusal(const Source& source) {
  try {
    const Model model(source);
  } catch (const Failed& failed) {
    return failed;
  }
  return {SY_OK, "it was loaded"};
}

/// Derivatives of a vector function by differences of fourth order.
template <class F>
MatrixXd Differences(const F& f, const VectorXd& x, double h = 1e-3) {
  MatrixXd jacobian;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto at = [&](double step) {
      VectorXd moved = x;
      moved[i] += step;
      return VectorXd(f(moved));
    };
    const VectorXd column = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
    if (jacobian.size() == 0) jacobian.resize(column.size(), x.size());
    jacobian.col(i) = column;
  }
  return jacobian;
}

inline void ExpectNear(const MatrixXd& a, const MatrixXd& b, double tolerance, const char* what) {
  ASSERT_EQ(a.rows(), b.rows()) << what;
  ASSERT_EQ(a.cols(), b.cols()) << what;
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * (1.0 + b.cwiseAbs().maxCoeff()))
      << what << "\n"
      << a << "\nand\n"
      << b;
}

/// n numbers that follow from the seed, in [-1, 1].
inline VectorXd Numbers(int n, int seed) {
  return VectorXd::NullaryExpr(n, [seed](Eigen::Index i) {
    return std::sin(1.7 * static_cast<double>(i + 1) + 3.1 * seed);
  });
}

}  // namespace switchyard::dynamics_plugin
