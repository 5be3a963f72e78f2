// Random points of a polyhedron: hit and run (Smith, 1984), whose limit is the even distribution.
#include <cmath>

#include "switchyard/error.hpp"
#include "switchyard/sets/hpolyhedron.hpp"

namespace switchyard {
namespace {

/// The range of s for which every row holds at x + s d.
struct Chord {
  double low = -kInfinity;
  double high = kInfinity;
};

Chord ChordOf(const Eigen::VectorXd& slack, const Eigen::VectorXd& rise) {
  Chord chord;
  for (Eigen::Index i = 0; i < slack.size(); ++i) {
    const double reach = std::max(0.0, slack[i]) / rise[i];
    if (rise[i] > 0) chord.high = std::min(chord.high, reach);
    if (rise[i] < 0) chord.low = std::max(chord.low, reach);
  }
  return chord;
}

}  // namespace

Eigen::VectorXd HPolyhedron::UniformSample(RandomGenerator* generator,
                                           const VectorRef& previous_sample, int mixing_steps,
                                           const std::optional<Eigen::MatrixXd>& subspace,
                                           double tol) const {
  const int n = ambient_dimension();
  Require(generator != nullptr, "UniformSample needs a generator, got a null pointer");
  Require(mixing_steps > 0, "UniformSample needs one step or more, got ", mixing_steps);
  Require(!subspace || subspace->rows() == n, "UniformSample in R^", n, " needs a subspace with ",
          n, " rows, got ", subspace ? subspace->rows() : 0);
  Require(PointInSet(previous_sample, tol), "UniformSample needs a start in the set, got one that ",
          "is ", Violation(previous_sample), " outside");
  Eigen::VectorXd x = previous_sample;
  std::normal_distribution<double> normal;
  const Eigen::Index directions = subspace ? subspace->cols() : n;
  for (int step = 0; step < mixing_steps && directions > 0; ++step) {
    const auto draw = [&] { return normal(*generator); };
    const Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(directions, draw);
    const Eigen::VectorXd d = subspace ? Eigen::VectorXd(*subspace * z) : z;
    const Chord chord = ChordOf(b_ - A_ * x, A_ * d);
    Require(std::isfinite(chord.low) && std::isfinite(chord.high),
            "UniformSample needs a polyhedron that is bounded along every line, got one in R^", n,
            " that is not");
    x += std::uniform_real_distribution<double>(chord.low, chord.high)(*generator) * d;
  }
  return x;
}

Eigen::VectorXd HPolyhedron::UniformSample(RandomGenerator* generator, int mixing_steps,
                                           const std::optional<Eigen::MatrixXd>& subspace,
                                           double tol) const {
  return UniformSample(generator, ChebyshevCenter(), mixing_steps, subspace, tol);
}

}  // namespace switchyard
