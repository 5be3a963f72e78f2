// switchyard/sets/check_set.hpp - whether a class of sets is one: for whoever writes his own.
#pragma once

#include <string>
#include <vector>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

struct CheckSetOptions {
  unsigned seed = 1;
  int num_points = 12;      // of each kind that is drawn
  double tolerance = 1e-6;  // absolute, per unit of the set's size
};

/// One sentence for every property that does not hold; none where all do. S is the set, x drawn
/// around it. Checked are
///   - its clone: the same dimension, class and answers;
///   - emptiness, and that its feasible point is a point of it;
///   - membership against its scaled form: x in S exactly where tx in tS is feasible, t > 0;
///   - convexity of the cone: points of t1 S and t2 S add up to one of (t1 + t2) S;
///   - scale 0: what 0 S holds are directions of recession, none but 0 where IsBounded();
///   - A, b, c, d of the general scaling against membership of (Ax + b) / (c't + d);
///   - the box, and the support function against it, against points of S, and against its maximum
///     by a program;
///   - nearest points: in S, at distance 0 for points of S, and with every point of S behind the
///     plane through them.
/// What a question throws is a sentence too. Asks backends; tells apart what differs by more than
/// the tolerance.
[[nodiscard]] SWITCHYARD_EXPORT std::vector<std::string> CheckConvexSet(
    const ConvexSet& set, const CheckSetOptions& options = {});

}  // namespace switchyard
