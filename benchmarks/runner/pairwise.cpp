// How long it takes to find which of many polytopes meet.
//
//   pairwise [SETS [FACES [SIZE [SEED]]]]
//
// SETS polytopes {x : a_i'(x - center) <= r_i} in R^3 with 4 to FACES faces, i.e. a simplex around
// the center and cuts, r_i in [SIZE / 2, SIZE], centers uniform in the unit cube; 1120 sets of at
// most 12 faces and size 0.03 unless said. Seconds from the sets to the answer, bounding boxes
// included, with one thread and with all; then where they go, by one thread: boxes, the sweep over
// them, and the linear programs of the pairs that it leaves.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cstdlib>
#include <random>
#include <string>

#include "core/sets/box_sweep.hpp"
#include "core/sets/meeting.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/pairwise_intersections.hpp"

namespace {

using namespace switchyard;

class Generator {
 public:
  explicit Generator(unsigned seed) : engine_(seed) {}

  /// New each time: a set remembers what was found of it.
  ConvexSets Polytopes(int count, int faces, double size) {
    ConvexSets sets;
    for (int k = 0; k < count; ++k) sets.emplace_back(Polytope(faces, size));
    return sets;
  }

 private:
  double Uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  Eigen::Vector3d Normal() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  HPolyhedron Polytope(int faces, double size) {
    const Eigen::Vector3d center(Uniform(0, 1), Uniform(0, 1), Uniform(0, 1));
    const int m = std::uniform_int_distribution<int>(4, faces)(engine_);
    Eigen::MatrixXd A(m, 3);
    A.topRows(4) << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;  // the simplex bounds it
    A.topRows(4) /= std::sqrt(3.0);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(Uniform(0, 2 * std::acos(-1.0)), Normal()));
    A.topRows(4) = A.topRows(4) * turn.toRotationMatrix();
    for (int i = 4; i < m; ++i) A.row(i) = Normal().transpose();
    Eigen::VectorXd b = A * center;
    for (int i = 0; i < m; ++i) b[i] += Uniform(size / 2, size);
    return {A, b};
  }
  std::mt19937_64 engine_;
};

class Clock {
 public:
  double Seconds() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return passed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void ShowParts(const ConvexSets& sets) {
  Clock clock;
  for (const ConvexSetPointer& set : sets) (void)set->bounding_box();
  fmt::print("boxes                {:8.3f} s\n", clock.Seconds());
  BoxColumns boxes(3, sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k) boxes.Set(k, sets[k]->bounding_box());
  const std::vector<IndexPair> pairs = OverlappingPairs(boxes, boxes, BoxOverlap(3, {}), true);
  fmt::print("sweep                {:8.3f} s, {} of {} pairs of boxes overlap\n", clock.Seconds(),
             pairs.size(), sets.size() * (sets.size() - 1) / 2);
  std::vector<MeetingSet> known;
  known.reserve(sets.size());
  for (const ConvexSetPointer& set : sets) known.emplace_back(*set);
  MeetingJudge judge;
  int programs = 0;
  int meet = 0;
  const Eigen::Vector3d tau = Eigen::Vector3d::Zero();
  for (const auto& [i, j] : pairs) {
    const SetBox& a = sets[std::size_t(i)]->bounding_box();
    const SetBox& b = sets[std::size_t(j)]->bounding_box();
    meet += judge.Meet(known[std::size_t(i)], known[std::size_t(j)], tau,
                       {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)})
                ? 1
                : 0;
    programs += judge.proof() == MeetingProof::kLinearProgram ? 1 : 0;
  }
  fmt::print("meetings             {:8.3f} s, {} linear programs, {} pairs meet\n", clock.Seconds(),
             programs, meet);
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int k, double otherwise) {
    return argc > k ? std::atof(argv[k]) : otherwise;
  };
  const int count = int(argument(1, 1120));
  const int faces = int(argument(2, 12));
  const double size = argument(3, 0.03);
  const auto seed = unsigned(argument(4, 1));
  if (count < 1 || faces < 4 || !(size > 0)) {
    fmt::print(stderr, "usage: pairwise [SETS [FACES [SIZE [SEED]]]], FACES at least 4\n");
    return 2;
  }
  for (const Parallelism threads : {Parallelism::None(), Parallelism::Max()}) {
    const ConvexSets sets = Generator(seed).Polytopes(count, faces, size);
    Clock clock;
    const auto found = ComputePairwiseIntersections(sets, {}, true, threads);
    fmt::print("{} thread(s)          {:8.3f} s, {} edges among {} sets\n", threads.num_threads(),
               clock.Seconds(), found.first.size(), sets.size());
  }
  ShowParts(Generator(seed).Polytopes(count, faces, size));
  return 0;
}
