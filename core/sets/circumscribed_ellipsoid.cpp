// The ellipsoid of least volume about points, by its dual: weights u that maximize
//   log det X(u), X = sum_i u_i q_i q_i', q_i = (y_i, 1), u >= 0, sum u = 1.
//
// At the optimum M_i = q_i' X^-1 q_i <= r + 1 with equality where u_i > 0. Each step moves weight
// to the point with the largest M or from the one with the smallest, by the exact maximum along
// that line (Khachiyan 1996, with the away steps of Todd and Yildirim, 2007, which make it linear).
#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>

#include "switchyard/error.hpp"
#include "switchyard/sets/affine_ball.hpp"

namespace switchyard {
namespace {

constexpr double kOptimal = 1e-7;  // relative, of M
constexpr int kMostSteps = 200'000;

/// The weights for points that span R^r.
Eigen::VectorXd Weights(const Eigen::MatrixXd& y) {
  const Eigen::Index count = y.cols();
  const auto size = static_cast<double>(y.rows() + 1);
  Eigen::MatrixXd q(y.rows() + 1, count);
  q << y, Eigen::RowVectorXd::Ones(count);
  Eigen::VectorXd u = Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count));
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd X = q * u.asDiagonal() * q.transpose();
    const Eigen::VectorXd M = q.cwiseProduct(X.ldlt().solve(q)).colwise().sum();
    Eigen::Index most = 0;
    Eigen::Index least = 0;
    const double above = M.maxCoeff(&most) / size - 1;
    const double below = 1 - (u.array() > 0).select(M.array(), kInfinity).minCoeff(&least) / size;
    if (above <= kOptimal && below <= kOptimal) return u;
    const Eigen::Index at = above >= below ? most : least;
    const double along = (M[at] - size) / (size * (M[at] - 1));
    const bool emptied = u[at] < 1 && along <= -u[at] / (1 - u[at]);
    const double move = emptied ? -u[at] / (1 - u[at]) : along;
    u *= 1 - move;
    u[at] = emptied ? 0 : u[at] + move;
  }
  throw std::runtime_error(Text("the ellipsoid of least volume about ", count, " points in R^",
                                y.rows(), " was not found in ", kMostSteps, " steps"));
}

}  // namespace

AffineBall AffineBall::MinimumVolumeCircumscribedEllipsoid(
    const Eigen::Ref<const Eigen::MatrixXd>& points, double rank_tol) {
  Require(points.cols() > 0, "an ellipsoid about points needs one or more, got none");
  Require(points.allFinite(), "an ellipsoid about points: an entry of them is not a finite number");
  const Eigen::VectorXd mean = points.rowwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(points.colwise() - mean, Eigen::ComputeThinU);
  const Eigen::VectorXd& sigma = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < sigma.size() && sigma[rank] > rank_tol * sigma[0]) ++rank;
  if (rank == 0) return {Eigen::MatrixXd::Zero(points.rows(), points.rows()), mean};
  const Eigen::MatrixXd axes = svd.matrixU().leftCols(rank) * sigma.head(rank).asDiagonal();
  const Eigen::MatrixXd y = sigma.head(rank).cwiseInverse().asDiagonal() *
                            (svd.matrixU().leftCols(rank).transpose() * (points.colwise() - mean));
  const Eigen::VectorXd u = Weights(y);
  const Eigen::VectorXd center = y * u;
  const Eigen::MatrixXd from_center = y.colwise() - center;
  const Eigen::LLT<Eigen::MatrixXd> spread(from_center * u.asDiagonal() * from_center.transpose());
  const double reach = spread.matrixL().solve(from_center).colwise().norm().maxCoeff();
  const Eigen::MatrixXd shape = spread.matrixL();
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(points.rows(), points.rows());
  B.leftCols(rank) = reach * axes * shape;
  return {B, mean + axes * center};
}

}  // namespace switchyard
