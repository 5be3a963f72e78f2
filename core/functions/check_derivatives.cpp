#include "switchyard/functions/check_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

using Eigen::VectorXd;
using Kind = DerivativeMismatch::Kind;
using Map = std::function<VectorXd(const VectorXd&)>;

constexpr int kLevels = 9;

// Of each entry the best extrapolation so far, and how far it is from its neighbours.
struct Extrapolated {
  VectorXd value;
  VectorXd error;

  void Consider(const VectorXd& now, const VectorXd& left, const VectorXd& above) {
    for (Eigen::Index i = 0; i < now.size(); ++i) {
      const double e = std::max(std::abs(now[i] - left[i]), std::abs(now[i] - above[i]));
      if (!(e < error[i])) continue;  // a NaN is not better
      error[i] = e;
      value[i] = now[i];
    }
  }
};

// The central differences D(h) have an expansion in h^2, so with h halved
//   D_0k = D(h_k),  D_mk = (4^m D_{m-1,k} - D_{m-1,k-1}) / (4^m - 1)
// removes one power after the other.
VectorXd Derivative(const Map& g, const VectorXd& x, int j) {
  double h = 0.01 * std::max(1.0, std::abs(x[j]));
  std::vector<VectorXd> last;
  Extrapolated best;
  for (int k = 0; k < kLevels; ++k, h /= 2) {
    VectorXd up = x;
    VectorXd down = x;
    up[j] += h;
    down[j] -= h;
    std::vector<VectorXd> now = {(g(up) - g(down)) / (up[j] - down[j])};
    if (k == 0) {
      best.value = VectorXd::Constant(now[0].size(), std::numeric_limits<double>::quiet_NaN());
      best.error = VectorXd::Constant(now[0].size(), std::numeric_limits<double>::infinity());
    }
    double power = 1;
    for (int m = 1; m <= k; ++m) {
      power *= 4;
      now.push_back((power * now[m - 1] - last[m - 1]) / (power - 1));
      best.Consider(now[m], now[m - 1], last[m - 1]);
    }
    last = std::move(now);
  }
  return best.value;
}

// A matrix by columns, as the entries of one of them are compared.
class Comparison {
 public:
  Comparison(Kind kind, const SparsityPattern& pattern, const std::vector<double>& entries,
             double tolerance, DerivativeReport* report)
      : kind_(kind),
        columns_(pattern.cols),
        largest_(VectorXd::Zero(pattern.rows)),
        tolerance_(tolerance),
        report_(*report) {
    for (int k = 0; k < pattern.size(); ++k) Add(pattern.row[k], pattern.col[k], entries[k]);
  }

  // The other triangle of a Hessian.
  void Mirror(const SparsityPattern& pattern, const std::vector<double>& entries) {
    for (int k = 0; k < pattern.size(); ++k) {
      if (pattern.row[k] != pattern.col[k]) Add(pattern.col[k], pattern.row[k], entries[k]);
    }
  }

  void Compare(int j, const VectorXd& by_differences) {
    VectorXd ours = VectorXd::Zero(by_differences.size());
    std::vector<bool> in_pattern(by_differences.size(), false);
    for (const auto& [i, value] : columns_[j]) {
      ours[i] = value;
      in_pattern[i] = true;
    }
    const int rows = static_cast<int>(kind_ == Kind::kHessian ? j + 1 : ours.size());
    for (int i = 0; i < rows; ++i) {
      const double scale = std::max({1.0, std::abs(by_differences[i]), largest_[i]});
      const double error = std::abs(ours[i] - by_differences[i]) / scale;
      if (!std::isnan(error)) report_.worst_error = std::max(report_.worst_error, error);
      if (error <= tolerance_) continue;
      auto& list = in_pattern[i] ? report_.disagreeing : report_.missing;
      list.push_back({kind_, i, j, ours[i], by_differences[i], error});
    }
  }

 private:
  void Add(int i, int j, double value) {
    columns_[j].emplace_back(i, value);
    if (std::isfinite(value)) largest_[i] = std::max(largest_[i], std::abs(value));
  }

  Kind kind_;
  std::vector<std::vector<std::pair<int, double>>> columns_;
  VectorXd largest_;  // of each row
  double tolerance_;
  DerivativeReport& report_;
};

void CheckJacobian(const Function& f, const VectorXd& x, double tolerance,
                   DerivativeReport* report) {
  std::vector<double> J(f.jacobian().size());
  f.Evaluate({.x = x.data(), .jacobian = J.data()});
  const Map values = [&](const VectorXd& at) {
    VectorXd y(f.num_outputs());
    f.Evaluate({.x = at.data(), .values = y.data()});
    return y;
  };
  Comparison comparison(Kind::kJacobian, f.jacobian(), J, tolerance, report);
  for (int j = 0; j < f.num_vars(); ++j) comparison.Compare(j, Derivative(values, x, j));
}

void CheckHessian(const Function& f, const VectorXd& x, const VectorXd& w, double tolerance,
                  DerivativeReport* report) {
  std::vector<double> H(f.hessian().size());
  f.Evaluate({.x = x.data(), .weights = w.data(), .hessian = H.data()});
  const Map gradient = [&](const VectorXd& at) {
    std::vector<double> J(f.jacobian().size());
    f.Evaluate({.x = at.data(), .jacobian = J.data()});
    VectorXd g = VectorXd::Zero(f.num_vars());
    for (int k = 0; k < f.jacobian().size(); ++k) {
      g[f.jacobian().col[k]] += w[f.jacobian().row[k]] * J[k];
    }
    return g;
  };
  Comparison comparison(Kind::kHessian, f.hessian(), H, tolerance, report);
  comparison.Mirror(f.hessian(), H);
  for (int j = 0; j < f.num_vars(); ++j) comparison.Compare(j, Derivative(gradient, x, j));
}

void Write(std::ostream& out, const std::vector<DerivativeMismatch>& list, const char* remark) {
  for (const DerivativeMismatch& m : list) {
    out << (m.kind == Kind::kJacobian ? "Jacobian" : "Hessian") << ": row " << m.row
        << " and column " << m.col << remark << " " << m.ours << ", by differences "
        << m.by_differences << ", relative error " << m.relative_error << "\n";
  }
}

}  // namespace

DerivativeReport CheckDerivatives(const Function& f, const VectorXd& x, VectorXd weights,
                                  double tolerance) {
  Require(f.has_jacobian(), "check of derivatives: the function has none");
  Require(x.size() == f.num_vars(), "check of derivatives: x needs ", f.num_vars(),
          " entries, got ", x.size());
  if (weights.size() == 0) weights = VectorXd::Ones(f.num_outputs());
  Require(weights.size() == f.num_outputs(), "check of derivatives: the weights need ",
          f.num_outputs(), " entries, got ", weights.size());
  DerivativeReport report;
  CheckJacobian(f, x, tolerance, &report);
  if (f.has_hessian()) CheckHessian(f, x, weights, tolerance, &report);
  return report;
}

std::string to_string(const DerivativeReport& report) {
  std::ostringstream out;
  out.precision(12);
  Write(out, report.disagreeing, " is");
  Write(out, report.missing, " has no place in the pattern, so is");
  if (report.agrees()) {
    out << "the derivatives agree with differences to " << report.worst_error << "\n";
  }
  return out.str();
}

}  // namespace switchyard
