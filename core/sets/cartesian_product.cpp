#include "switchyard/sets/cartesian_product.hpp"

#include <algorithm>

#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

int SumOfDimensions(const ConvexSets& sets) {
  int sum = 0;
  for (const ConvexSetPointer& set : sets) sum += set->ambient_dimension();
  return sum;
}

/// visit(set, first): each factor and the place of its first coordinate.
template <class Visit>
void ForEachFactor(const ConvexSets& sets, Visit&& visit) {
  Eigen::Index first = 0;
  for (const ConvexSetPointer& set : sets) {
    visit(*set, first);
    first += set->ambient_dimension();
  }
}

}  // namespace

CartesianProduct::CartesianProduct(ConvexSets sets)
    : ConvexSet(SumOfDimensions(sets)), sets_(std::move(sets)) {}

CartesianProduct::CartesianProduct(ConvexSets sets, const Eigen::Ref<const Eigen::MatrixXd>& A,
                                   const VectorRef& b)
    : ConvexSet(static_cast<int>(A.cols())), sets_(std::move(sets)), A_(A), b_(b) {
  const int rows = SumOfDimensions(sets_);
  Require(A.rows() == rows && b.size() == rows, "cartesian product: A and b of factors with ", rows,
          " dimensions together need ", rows, " rows, got ", A.rows(), " and ", b.size());
  Require(A.allFinite(), "cartesian product: an entry of A is not a finite number");
  Require(b.allFinite(), "cartesian product: an entry of b is not a finite number");
}

std::unique_ptr<ConvexSet> CartesianProduct::DoClone() const {
  return std::make_unique<CartesianProduct>(*this);
}

ScaledSet CartesianProduct::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    std::vector<ScaledRows::Combination> columns = {{{0, 1.0}}};
    for (Eigen::Index i = first; i < first + set.ambient_dimension(); ++i) {
      if (!A_) {
        columns.push_back({{1 + static_cast<int>(i), 1.0}});
        continue;
      }
      ScaledRows::Combination row = {{0, (*b_)[i]}};
      for (int j = 0; j < ambient_dimension(); ++j) row.emplace_back(1 + j, (*A_)(i, j));
      columns.push_back(std::move(row));
    }
    rows.AddSet(set.scaled(), columns);
  });
  return rows.Finish();
}

std::optional<SetBox> CartesianProduct::DoBoundingBox() const {
  if (A_) return std::nullopt;
  SetBox box{Eigen::VectorXd(ambient_dimension()), Eigen::VectorXd(ambient_dimension()), false};
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    box.lower.segment(first, set.ambient_dimension()) = set.bounding_box().lower;
    box.upper.segment(first, set.ambient_dimension()) = set.bounding_box().upper;
    box.empty = box.empty || set.bounding_box().empty;
  });
  return box;
}

std::optional<Eigen::VectorXd> CartesianProduct::DoMaybeGetPoint() const {
  if (A_) return std::nullopt;
  std::optional<Eigen::VectorXd> x = Eigen::VectorXd(ambient_dimension());
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    const std::optional<Eigen::VectorXd> part = x ? set.MaybeGetPoint() : std::nullopt;
    if (part) x->segment(first, part->size()) = *part;
    if (!part) x.reset();
  });
  return x;
}

std::optional<Eigen::VectorXd> CartesianProduct::DoMaybeGetFeasiblePoint() const {
  if (A_) return ConvexSet::DoMaybeGetFeasiblePoint();
  std::optional<Eigen::VectorXd> x = Eigen::VectorXd(ambient_dimension());
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    const std::optional<Eigen::VectorXd> part = x ? set.MaybeGetFeasiblePoint() : std::nullopt;
    if (part) x->segment(first, part->size()) = *part;
    if (!part) x.reset();
  });
  return x;
}

bool CartesianProduct::DoIsBounded(Parallelism parallelism) const {
  if (A_) return ConvexSet::DoIsBounded(parallelism);
  const bool bounded = std::all_of(sets_.begin(), sets_.end(), [&](const ConvexSetPointer& set) {
    return set->IsBounded(parallelism);
  });
  return bounded || IsEmpty();
}

double CartesianProduct::DoViolation(const Eigen::VectorXd& x) const {
  if (A_) return ConvexSet::DoViolation(x);
  double worst = 0;
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    const double violation = set.Violation(x.segment(first, set.ambient_dimension()));
    if (!(violation <= worst)) worst = violation;  // NaN stays
  });
  return worst;
}

double CartesianProduct::DoSupport(const Eigen::VectorXd& direction) const {
  if (A_) return ConvexSet::DoSupport(direction);
  if (IsEmpty()) return -kInfinity;
  double sum = 0;
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    sum += set.SupportFunction(direction.segment(first, set.ambient_dimension()));
  });
  return sum;
}

Eigen::VectorXd CartesianProduct::DoNearestPoint(const Eigen::VectorXd& x) const {
  if (A_) return ConvexSet::DoNearestPoint(x);
  Eigen::VectorXd nearest(x.size());
  ForEachFactor(sets_, [&](const ConvexSet& set, Eigen::Index first) {
    const int n = set.ambient_dimension();
    nearest.segment(first, n) = set.Projection(x.segment(first, n))->second;
  });
  return nearest;
}

bool CartesianProduct::DoHasExactVolume() const {
  return !A_ && std::all_of(sets_.begin(), sets_.end(),
                            [](const ConvexSetPointer& set) { return set->has_exact_volume(); });
}

std::optional<double> CartesianProduct::DoCalcVolume() const {
  double product = 1;
  for (const ConvexSetPointer& set : sets_) {
    const double volume = set->CalcVolume();
    if (volume == 0) return 0.0;  // times infinity as well
    product *= volume;
  }
  return product;
}

}  // namespace switchyard
