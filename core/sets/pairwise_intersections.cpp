#include "switchyard/sets/pairwise_intersections.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <numbers>
#include <thread>

#include "core/sets/box_sweep.hpp"
#include "core/sets/meeting.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/geodesic_convexity.hpp"

namespace switchyard {
namespace {

/// work(judge, k) for k < count, each thread with a judge of its own; what the first of those that
/// throw has thrown is thrown when all have ended.
template <class Work>
void ForEach(std::size_t count, Parallelism parallelism, const Work& work) {
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<std::size_t> next{0};
  constexpr std::size_t kAtOnce = 64;
  const auto serve = [&] {
    MeetingJudge judge;
    for (std::size_t first; (first = next.fetch_add(kAtOnce)) < count;) {
      for (std::size_t k = first; k < std::min(count, first + kAtOnce); ++k) {
        try {
          work(judge, k);
        } catch (...) {
          thrown[k] = std::current_exception();
        }
      }
    }
  };
  const std::size_t threads =
      std::min(static_cast<std::size_t>(parallelism.num_threads()), count / kAtOnce + 1);
  std::vector<std::thread> helpers;
  for (std::size_t t = 1; t < threads; ++t) helpers.emplace_back(serve);
  serve();
  for (std::thread& helper : helpers) helper.join();
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

/// The sets of one side with their boxes.
struct Collection {
  std::vector<MeetingSet> sets;
  BoxColumns boxes;
};

using GivenBoxes = std::vector<Hyperrectangle>;

SetBox Everything(int n) {
  return {Eigen::VectorXd::Constant(n, -kInfinity), Eigen::VectorXd::Constant(n, kInfinity), false};
}

/// With the ends along the joints exact, so that widths and offsets are the set's.
void SeeJoints(const ConvexSet& set, std::size_t k, const std::vector<int>& joints, SetBox* box) {
  for (const int joint : joints) {
    const auto [lower, upper] = GetMinimumAndMaximumValueAlongDimension(set, joint);
    Require(upper - lower < std::numbers::pi, "set ", k, " (", set.Kind(), ") is ", upper - lower,
            " wide along the continuous revolute joint ", joint,
            ": it must be narrower than pi, see PartitionConvexSet");
    box->lower[joint] = lower;
    box->upper[joint] = upper;
  }
}

Collection Collect(const ConvexSets& sets, const BoxOverlap& overlap, int n, bool use_boxes,
                   const GivenBoxes* given, Parallelism parallelism) {
  Require(given == nullptr || given->size() == sets.size(), sets.size(),
          " sets need as many bounding boxes, got ", given == nullptr ? 0 : given->size());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    Require(sets[k]->ambient_dimension() == n, "sets in R^", n, " and in R^",
            sets[k]->ambient_dimension(), " have no intersections");
    Require(given == nullptr || (*given)[k].ambient_dimension() == n, "bounding box ", k,
            " of sets in R^", n, " is in R^",
            given == nullptr ? 0 : (*given)[k].ambient_dimension());
  }
  Collection all{{}, BoxColumns(n, sets.size())};
  std::vector<std::optional<MeetingSet>> known(sets.size());
  std::vector<SetBox> boxes(sets.size(), Everything(n));
  ForEach(sets.size(), parallelism, [&](MeetingJudge&, std::size_t k) {
    const ConvexSet& set = *sets[k];
    known[k].emplace(set);
    if (given != nullptr) {
      boxes[k] = {(*given)[k].lb(), (*given)[k].ub(), false};
    } else if (use_boxes) {
      boxes[k] = set.bounding_box();
    }
    const bool empty = boxes[k].empty || (!overlap.joints().empty() && set.IsEmpty());
    if (empty) {
      boxes[k].empty = true;
    } else {
      SeeJoints(set, k, overlap.joints(), &boxes[k]);
    }
  });
  all.sets.reserve(sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    all.sets.push_back(std::move(*known[k]));
    all.boxes.Set(k, boxes[k]);
  }
  return all;
}

/// One pair of each that meet.
std::vector<IndexPair> Meetings(const Collection& a, const Collection& b, const BoxOverlap& overlap,
                                bool within, Parallelism parallelism) {
  const std::vector<IndexPair> candidates = OverlappingPairs(a.boxes, b.boxes, overlap, within);
  std::vector<std::uint8_t> meets(candidates.size(), 0);
  ForEach(candidates.size(), parallelism, [&](MeetingJudge& judge, std::size_t k) {
    const auto i = static_cast<std::size_t>(candidates[k].first);
    const auto j = static_cast<std::size_t>(candidates[k].second);
    const Eigen::VectorXd tau = overlap.Offset(a.boxes, i, b.boxes, j);
    const auto col_i = static_cast<Eigen::Index>(i);
    const auto col_j = static_cast<Eigen::Index>(j);
    const MeetingRange range{a.boxes.lower.col(col_i).cwiseMax(b.boxes.lower.col(col_j) - tau),
                             a.boxes.upper.col(col_i).cwiseMin(b.boxes.upper.col(col_j) - tau)};
    meets[k] = judge.Meet(a.sets[i], b.sets[j], tau, range) ? 1 : 0;
  });
  std::vector<IndexPair> pairs;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (meets[k] != 0) pairs.push_back(candidates[k]);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

int DimensionOf(const ConvexSets& a, const ConvexSets& b) {
  return !a.empty()   ? a.front()->ambient_dimension()
         : !b.empty() ? b.front()->ambient_dimension()
                      : 0;
}

PairwiseIntersections Between(const ConvexSets& convex_sets_A, const ConvexSets& convex_sets_B,
                              const std::vector<int>& joints, bool use_boxes,
                              const GivenBoxes* given_A, const GivenBoxes* given_B,
                              Parallelism parallelism) {
  if (convex_sets_A.empty() && convex_sets_B.empty()) return {};
  const int n = DimensionOf(convex_sets_A, convex_sets_B);
  ThrowsForInvalidContinuousJointsList(n, joints);
  const BoxOverlap overlap(n, joints);
  const Collection a = Collect(convex_sets_A, overlap, n, use_boxes, given_A, parallelism);
  const Collection b = Collect(convex_sets_B, overlap, n, use_boxes, given_B, parallelism);
  PairwiseIntersections found;
  found.first = Meetings(a, b, overlap, false, parallelism);
  for (const auto& [i, j] : found.first) {
    found.second.push_back(
        overlap.Offset(a.boxes, static_cast<std::size_t>(i), b.boxes, static_cast<std::size_t>(j)));
  }
  return found;
}

PairwiseIntersections Within(const ConvexSets& convex_sets, const std::vector<int>& joints,
                             bool use_boxes, const GivenBoxes* given, Parallelism parallelism) {
  if (convex_sets.empty()) return {};
  const int n = DimensionOf(convex_sets, {});
  ThrowsForInvalidContinuousJointsList(n, joints);
  const BoxOverlap overlap(n, joints);
  const Collection all = Collect(convex_sets, overlap, n, use_boxes, given, parallelism);
  PairwiseIntersections found;
  found.first = Meetings(all, all, overlap, true, parallelism);
  const std::size_t once = found.first.size();
  for (std::size_t k = 0; k < once; ++k) {
    found.first.emplace_back(found.first[k].second, found.first[k].first);
  }
  std::sort(found.first.begin(), found.first.end());
  for (const auto& [i, j] : found.first) {
    const auto low = static_cast<std::size_t>(std::min(i, j));
    const auto high = static_cast<std::size_t>(std::max(i, j));
    const Eigen::VectorXd tau = overlap.Offset(all.boxes, low, all.boxes, high);
    found.second.emplace_back(i < j ? tau : Eigen::VectorXd::Zero(n) - tau);
  }
  return found;
}

}  // namespace

PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets_A, const ConvexSets& convex_sets_B,
    const std::vector<int>& continuous_revolute_joints, bool preprocess_bbox,
    Parallelism parallelism) {
  return Between(convex_sets_A, convex_sets_B, continuous_revolute_joints, preprocess_bbox, nullptr,
                 nullptr, parallelism);
}

PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets_A, const ConvexSets& convex_sets_B,
    const std::vector<int>& continuous_revolute_joints, const std::vector<Hyperrectangle>& bboxes_A,
    const std::vector<Hyperrectangle>& bboxes_B, Parallelism parallelism) {
  return Between(convex_sets_A, convex_sets_B, continuous_revolute_joints, true, &bboxes_A,
                 &bboxes_B, parallelism);
}

PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets, const std::vector<int>& continuous_revolute_joints,
    bool preprocess_bbox, Parallelism parallelism) {
  return Within(convex_sets, continuous_revolute_joints, preprocess_bbox, nullptr, parallelism);
}

PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets, const std::vector<int>& continuous_revolute_joints,
    const std::vector<Hyperrectangle>& bboxes, Parallelism parallelism) {
  return Within(convex_sets, continuous_revolute_joints, true, &bboxes, parallelism);
}

}  // namespace switchyard
