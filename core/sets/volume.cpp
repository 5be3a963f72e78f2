// Volumes: in closed form where a class has one, and by counting.
#include <cmath>

#include "switchyard/error.hpp"
#include "switchyard/sets/convex_set.hpp"

namespace switchyard {
namespace {

/// The standard deviation of a count of `hits` in `samples`, over the count.
double RelativeAccuracy(int hits, int samples) {
  if (hits == 0) return kInfinity;
  return std::sqrt(static_cast<double>(samples - hits) / (static_cast<double>(hits) * samples));
}

constexpr int kFewestSamples = 100;  // before that the accuracy is no estimate

}  // namespace

double ConvexSet::CalcVolume() const {
  const std::optional<double> volume = has_exact_volume() ? DoCalcVolume() : std::nullopt;
  Require(volume.has_value(), "CalcVolume needs a set with an exact volume, got a ", Kind(),
          IsBounded() ? " without: use CalcVolumeViaSampling" : " that is not bounded");
  return *volume;
}

SampledVolume ConvexSet::CalcVolumeViaSampling(RandomGenerator* generator,
                                               double desired_rel_accuracy,
                                               int max_num_samples) const {
  Require(generator != nullptr, "CalcVolumeViaSampling needs a generator, got a null pointer");
  Require(desired_rel_accuracy > 0, "CalcVolumeViaSampling needs an accuracy above 0, got ",
          desired_rel_accuracy);
  Require(max_num_samples > 0, "CalcVolumeViaSampling needs one sample or more, got ",
          max_num_samples);
  const SetBox& box = bounding_box();
  if (box.empty) return {0, 0, 0};
  Require(box.is_finite(), "CalcVolumeViaSampling needs a bounded set, got a ", Kind(),
          " without a finite box");
  const Eigen::VectorXd sides = box.upper - box.lower;
  std::uniform_real_distribution<double> part(0, 1);
  Eigen::VectorXd x(sides.size());
  int hits = 0;
  int samples = 0;
  while (samples < max_num_samples) {
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = box.lower[i] + part(*generator) * sides[i];
    hits += PointInSet(x) ? 1 : 0;
    ++samples;
    const bool enough = samples >= kFewestSamples || samples == max_num_samples;
    if (enough && RelativeAccuracy(hits, samples) <= desired_rel_accuracy) break;
  }
  return {sides.prod() * hits / samples, RelativeAccuracy(hits, samples), samples};
}

}  // namespace switchyard
