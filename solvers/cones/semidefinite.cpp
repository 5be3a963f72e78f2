// The cone of positive semidefinite matrices, as svec (upper triangle by columns, off-diagonals
// times sqrt 2), f(S) = -log det S.
//
// Nesterov-Todd scaling (Todd, Toh and Tutuncu, SIAM J. Optim. 8, 1998): with S = L L', Z = M M'
// and the singular value decomposition M'L = U diag(lambda) V',
//
//   R = L V diag(lambda)^-1/2,   R^-1 = diag(lambda)^-1/2 U'M',
//
// W V = R'V R takes Z, and W^-T V = R^-1 V R^-T takes S, to diag(lambda). H V = G V G with G = R R'
// = Q diag(g) Q', so that H + r has the eigenvalues g_i g_j + r, at sym(q_i q_j').
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solvers/cones/kinds.hpp"

namespace switchyard::cones {
namespace {

using Matrix = Eigen::MatrixXd;
using Array = Eigen::VectorXd;

class Semidefinite final : public Group {
 public:
  explicit Semidefinite(const Layout& layout)
      : Group(layout),
        order_(static_cast<Index>(std::lround((std::sqrt(8.0 * layout.dim + 1) - 1) / 2))),
        scaling_(static_cast<std::size_t>(layout.count)) {
    ScaleByIdentity();
  }

  [[nodiscard]] double degree() const override {
    return static_cast<double>(layout_.count) * order_;
  }
  [[nodiscard]] Index rank() const override { return layout_.dim; }

  void Center(double* s) const override {
    for (Index c = 0; c < layout_.count; ++c) Write(Matrix::Identity(order_, order_), s + At(c));
  }

  [[nodiscard]] double Depth(const double* v) const override {
    double least = HUGE_VAL;
    for (Index c = 0; c < layout_.count; ++c) least = std::min(least, Smallest(Read(v + At(c))));
    return least;
  }

  void ScaleByIdentity() override {
    for (Scaling& w : scaling_) {
      w.r = w.r_inverse = w.q = Matrix::Identity(order_, order_);
      w.lambda = w.g = Array::Ones(order_);
    }
  }

  bool Scale(const double* s, const double* z, double) override {
    for (Index c = 0; c < layout_.count; ++c) {
      Scaling& w = scaling_[c];
      w.of_s.compute(Read(s + At(c)));
      w.of_z.compute(Read(z + At(c)));
      if (w.of_s.info() != Eigen::Success || w.of_z.info() != Eigen::Success) return false;
      const Matrix l = w.of_s.matrixL(), m = w.of_z.matrixL();
      const Eigen::BDCSVD<Matrix> both(m.transpose() * l,
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
      w.lambda = both.singularValues();
      if (!(w.lambda.minCoeff() > 0)) return false;
      const Array root = w.lambda.cwiseSqrt().cwiseInverse();
      w.r = l * both.matrixV() * root.asDiagonal();
      w.r_inverse = root.asDiagonal() * both.matrixU().transpose() * m.transpose();
      const Eigen::BDCSVD<Matrix> of_r(w.r, Eigen::ComputeFullU);
      w.q = of_r.matrixU();
      w.g = of_r.singularValues().cwiseAbs2();
    }
    return true;
  }

  void Multiply(const double* v, double* out) const override {
    Weigh(v, out, [](double g) { return g; });
  }
  void Divide(const double* v, double r, double* out) const override {
    Weigh(v, out, [r](double g) { return 1 / (g + r); });
  }
  // Where H is larger than on average, by 1 - average / H.
  void Mend(const double* e, double* ds) const override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& w = scaling_[c];
      const double mean = std::exp(2 * w.g.array().log().mean());
      Matrix part = w.q.transpose() * Read(e + At(c)) * w.q;
      for (Index j = 0; j < order_; ++j) {
        for (Index i = 0; i < order_; ++i) {
          part(i, j) *= std::max(0.0, 1 - mean / (w.g[i] * w.g[j]));
        }
      }
      Add(w.q * part * w.q.transpose(), 1, ds + At(c));
    }
  }

  void Correct(const double* s, const double*, const double* ds, const double* dz, double target,
               double* xi) const override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& w = scaling_[c];
      Matrix b = Product(w, Read(ds + At(c)), Read(dz + At(c)));
      b.diagonal().array() -= target;
      std::copy_n(s + At(c), layout_.dim, xi + At(c));
      Add(DivideByLambda(w, b), 1, xi + At(c));
    }
  }

  void Recenter(const double* s, const double* z, double low, double high,
                double* xi) const override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& w = scaling_[c];
      const Eigen::SelfAdjointEigenSolver<Matrix> eigen(
          Product(w, Read(s + At(c)), Read(z + At(c))));
      const Array lack =
          eigen.eigenvalues().unaryExpr([&](double v) { return IntoRange(v, low, high); });
      const Matrix b = eigen.eigenvectors() * lack.asDiagonal() * eigen.eigenvectors().transpose();
      Add(DivideByLambda(w, b), -1, xi + At(c));
    }
  }

  // S + a dS is inside as long as 1 + a eig(L^-1 dS L^-T) > 0.
  [[nodiscard]] double Step(const double* s, const double* z, const double* ds, const double* dz,
                            double most) const override {
    double rate = 1 / most;
    for (Index c = 0; c < layout_.count; ++c) {
      rate = std::max(rate, LeavingRate(s + At(c), ds + At(c)));
      rate = std::max(rate, LeavingRate(z + At(c), dz + At(c)));
    }
    return 1 / rate;
  }

  void Inverse(double r, double* d, double* v, double* w) const override {
    std::fill_n(d, layout_.rows(), 0.0);
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& scaling = scaling_[c];
      Index k = 0;
      for (Index j = 0; j < order_; ++j) {
        for (Index i = 0; i <= j; ++i, ++k) {
          const Matrix product = scaling.q.col(i) * scaling.q.col(j).transpose();
          const double length = i == j ? 1 : std::numbers::sqrt2;
          Write((product + product.transpose()) * (length / 2),
                v + std::ptrdiff_t{k} * layout_.rows() + At(c));
          w[std::ptrdiff_t{k} * layout_.count + c] = 1 / (scaling.g[i] * scaling.g[j] + r);
        }
      }
    }
  }

 private:
  struct Scaling {
    Eigen::LLT<Matrix> of_s, of_z;
    Matrix r, r_inverse, q;
    Array lambda, g;
  };

  [[nodiscard]] std::ptrdiff_t At(Index cone) const { return std::ptrdiff_t{cone} * layout_.dim; }

  [[nodiscard]] Matrix Read(const double* v) const {
    Matrix m(order_, order_);
    for (Index j = 0; j < order_; ++j) {
      for (Index i = 0; i < j; ++i) m(i, j) = m(j, i) = *v++ / std::numbers::sqrt2;
      m(j, j) = *v++;
    }
    return m;
  }
  void Write(const Matrix& m, double* v) const {
    for (Index j = 0; j < order_; ++j) {
      for (Index i = 0; i < j; ++i) *v++ = (m(i, j) + m(j, i)) / std::numbers::sqrt2;
      *v++ = m(j, j);
    }
  }
  void Add(const Matrix& m, double factor, double* v) const {
    for (Index j = 0; j < order_; ++j) {
      for (Index i = 0; i < j; ++i) *v++ += factor * (m(i, j) + m(j, i)) / std::numbers::sqrt2;
      *v++ += factor * m(j, j);
    }
  }

  [[nodiscard]] static double Smallest(const Matrix& m) {
    return Eigen::SelfAdjointEigenSolver<Matrix>(m, Eigen::EigenvaluesOnly).eigenvalues()[0];
  }

  /// out = Q (of(g_i g_j) (Q'v Q)_ij) Q'.
  template <class Of>
  void Weigh(const double* v, double* out, Of&& of) const {
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& w = scaling_[c];
      Matrix part = w.q.transpose() * Read(v + At(c)) * w.q;
      for (Index j = 0; j < order_; ++j) {
        for (Index i = 0; i < order_; ++i) part(i, j) *= of(w.g[i] * w.g[j]);
      }
      Write(w.q * part * w.q.transpose(), out + At(c));
    }
  }

  /// (W^-T s) o (W z) with A o B = (AB + BA) / 2.
  [[nodiscard]] static Matrix Product(const Scaling& w, const Matrix& s, const Matrix& z) {
    const Matrix a = w.r_inverse * s * w.r_inverse.transpose();
    const Matrix b = w.r.transpose() * z * w.r;
    const Matrix ab = a * b;
    return 0.5 * (ab + ab.transpose());
  }

  /// W'(lambda \ b).
  [[nodiscard]] static Matrix DivideByLambda(const Scaling& w, Matrix b) {
    for (Index j = 0; j < b.cols(); ++j) {
      for (Index i = 0; i < b.rows(); ++i) b(i, j) *= 2 / (w.lambda[i] + w.lambda[j]);
    }
    return w.r * b * w.r.transpose();
  }

  [[nodiscard]] double LeavingRate(const double* v, const double* d) const {
    const Eigen::LLT<Matrix> factor(Read(v));
    if (factor.info() != Eigen::Success) return HUGE_VAL;
    const Matrix half = factor.matrixL().solve(Read(d));
    return -Smallest(factor.matrixL().solve(half.transpose()));
  }

  Index order_;
  std::vector<Scaling> scaling_;
};

}  // namespace

std::unique_ptr<Group> MakeSemidefinite(const Layout& layout, double) {
  return std::make_unique<Semidefinite>(layout);
}

}  // namespace switchyard::cones
