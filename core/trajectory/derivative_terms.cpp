// Rows for bounds of derivatives and for continuity in time: D x against powers of durations.
#include <cmath>
#include <functional>

#include "core/trajectory/segment_terms.hpp"
#include "switchyard/functions/make_function.hpp"

namespace switchyard {
namespace {

using Transcription = GraphOfConvexSets::Transcription;

/// slope h + intercept.
struct Line {
  double slope;
  double intercept;
};
/// What stands in for h^N beside a bound, one row for each: the bound, and is it an upper one?
using LinesFor = std::function<std::vector<Line>(double bound, bool upper)>;

constexpr int kTangents = 8;

double Power(double h, int N) { return std::pow(h, N); }

/// The line through (h_min, h_min^N) and (h_max, h_max^N).
Line Chord(const SegmentShape& shape, int N) {
  const double low = Power(shape.h_min, N), high = Power(shape.h_max, N);
  const double slope = shape.has_fixed_duration() ? 0 : (high - low) / (shape.h_max - shape.h_min);
  return {slope, low - slope * shape.h_min};
}

/// At durations of equal ratios from h_min to h_max, which is above 0.
std::vector<Line> Tangents(const SegmentShape& shape, int N) {
  std::vector<Line> lines;
  for (int k = 0; k < kTangents; ++k) {
    const double h = shape.h_min * std::pow(shape.h_max / shape.h_min, k / (kTangents - 1.0));
    lines.push_back({N * Power(h, N - 1), (1 - N) * Power(h, N)});
  }
  return lines;
}

/// Rows over the points' places and the duration, behind them.
class RowsOfPoints {
 public:
  explicit RowsOfPoints(const DerivativePoints& points) : points_(points), D_(points.D) {}

  [[nodiscard]] int count() const { return static_cast<int>(lower_.size()); }
  void Add(int row, double of_duration, double lower, double upper) {
    for (RowMajor::InnerIterator e(D_, row); e; ++e) {
      entries_.emplace_back(count(), e.col(), e.value());
    }
    if (of_duration != 0) entries_.emplace_back(count(), points_.D.cols(), of_duration);
    lower_.push_back(lower);
    upper_.push_back(upper);
  }
  [[nodiscard]] PlacedConstraint Finish(GraphOfConvexSets::TranscriptionSet in) const {
    SparseMatrix A(count(), points_.D.cols() + 1);
    A.setFromTriplets(entries_.begin(), entries_.end());
    PlacedConstraint term{nullptr, points_.places, in};
    term.places.push_back(points_.duration);
    term.evaluator = std::make_shared<LinearConstraint>(
        A, Eigen::Map<const Eigen::VectorXd>(lower_.data(), count()),
        Eigen::Map<const Eigen::VectorXd>(upper_.data(), count()));
    return term;
  }

 private:
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const DerivativePoints& points_;
  RowMajor D_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> lower_, upper_;
};

/// lower (slope h + intercept) <= D x <= upper (slope h + intercept) for all lines of each finite
/// side. Two sides that no duration is in are one row.
std::optional<PlacedConstraint> LinearRows(const DerivativePoints& points,
                                           const DerivativeBound& bound, const LinesFor& lines_for,
                                           GraphOfConvexSets::TranscriptionSet in) {
  RowsOfPoints rows(points);
  for (int row = 0; row < points.D.rows(); ++row) {
    const auto i = row % bound.lower.size();
    const double lower = bound.lower[i], upper = bound.upper[i];
    const auto lines = [&](double side, bool is_upper) {
      return std::isfinite(side) ? lines_for(side, is_upper) : std::vector<Line>();
    };
    const std::vector<Line> below = lines(lower, false), above = lines(upper, true);
    if (below.size() == 1 && above.size() == 1 && lower * below[0].slope == 0 &&
        upper * above[0].slope == 0) {
      rows.Add(row, 0, lower * below[0].intercept, upper * above[0].intercept);
      continue;
    }
    for (const Line& line : above) {
      rows.Add(row, -upper * line.slope, -kInfinity, upper * line.intercept);
    }
    for (const Line& line : below) {
      rows.Add(row, -lower * line.slope, lower * line.intercept, kInfinity);
    }
  }
  if (rows.count() == 0) return std::nullopt;
  return rows.Finish(in);
}

/// A row of D, and what it is compared with: weight h^N.
struct PowerRow {
  std::vector<std::pair<int, double>> entries;
  double weight = 0;
};

std::vector<std::pair<int, double>> RowOf(const SparseMatrix& D, int row) {
  std::vector<std::pair<int, double>> entries;
  for (int j = 0; j < D.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator e(D, j); e; ++e) {
      if (e.row() == row) entries.emplace_back(j, e.value());
    }
  }
  return entries;
}

Traced Sum(const std::vector<std::pair<int, double>>& entries, const Eigen::VectorX<Traced>& x,
           int first = 0) {
  Traced sum = 0;
  for (const auto& [place, value] : entries) sum += value * x[first + place];
  return sum;
}

Traced PowerOf(const Traced& h, int N) {
  Traced power = h;
  for (int k = 1; k < N; ++k) power *= h;
  return power;
}

/// D x - bound h^N against 0, for the sides that no line says.
std::optional<PlacedConstraint> PowerRows(const DerivativePoints& points,
                                          const DerivativeBound& bound) {
  std::vector<PowerRow> rows;
  std::vector<double> lower, upper;
  const auto add = [&](int row, double weight, double low, double high) {
    rows.push_back({RowOf(points.D, row), weight});
    lower.push_back(low);
    upper.push_back(high);
  };
  const auto counts = [](double side) { return std::isfinite(side) && side != 0; };
  for (int row = 0; row < points.D.rows(); ++row) {
    const auto i = row % bound.lower.size();
    if (bound.lower[i] == bound.upper[i] && counts(bound.lower[i])) {
      add(row, bound.lower[i], 0, 0);
      continue;
    }
    if (counts(bound.upper[i])) add(row, bound.upper[i], -kInfinity, 0);
    if (counts(bound.lower[i])) add(row, bound.lower[i], 0, kInfinity);
  }
  if (rows.empty()) return std::nullopt;
  const auto duration = static_cast<int>(points.places.size());
  const auto function = MakeFunction(
      duration + 1, [rows, duration, N = bound.order](const Eigen::VectorX<Traced>& x) {
        const Traced power = PowerOf(x[duration], N);
        std::vector<Traced> values;
        for (const PowerRow& row : rows) {
          values.push_back(Sum(row.entries, x) - row.weight * power);
        }
        return values;
      });
  const auto count = static_cast<Eigen::Index>(rows.size());
  PlacedConstraint term{std::make_shared<FunctionConstraint>(
                            function, Eigen::Map<const Eigen::VectorXd>(lower.data(), count),
                            Eigen::Map<const Eigen::VectorXd>(upper.data(), count)),
                        points.places,
                        {Transcription::kMIP, Transcription::kRestriction}};
  term.places.push_back(points.duration);
  return term;
}

}  // namespace

std::optional<PlacedConstraint> VelocityRows(const DerivativePoints& points,
                                             const DerivativeBound& bound) {
  auto rows = LinearRows(points, bound, [](double, bool) { return std::vector<Line>{{1, 0}}; }, {});
  if (rows) rows->evaluator->set_description("velocity bounds");
  return rows;
}

std::vector<PlacedConstraint> DerivativeRows(const DerivativePoints& points,
                                             const DerivativeBound& bound,
                                             const SegmentShape& shape) {
  const int N = bound.order;
  const bool fixed = shape.has_fixed_duration();
  const LinesFor exact = [&](double side, bool) -> std::vector<Line> {
    if (side != 0 && !fixed) return {};
    return {{0, Power(shape.h_min, N)}};
  };
  const LinesFor relaxed = [&](double side, bool upper) -> std::vector<Line> {
    if (side == 0) return {};
    if ((side > 0) == upper) return {Chord(shape, N)};
    return Tangents(shape, N);
  };
  std::vector<PlacedConstraint> terms;
  const auto add = [&](std::optional<PlacedConstraint> term, const char* what) {
    if (!term) return;
    term->evaluator->set_description(Text(what, N));
    terms.push_back(*std::move(term));
  };
  add(LinearRows(points, bound, exact, {}), "bounds of derivative ");
  if (fixed) return terms;
  add(PowerRows(points, bound), "bounds of derivative ");
  add(LinearRows(points, bound, relaxed, {Transcription::kRelaxation, Transcription::kRestriction}),
      "relaxed bounds of derivative ");
  return terms;
}

std::optional<PlacedConstraint> SurrogateRows(const DerivativePoints& points,
                                              const DerivativeBound& bound, double h0) {
  auto rows = LinearRows(points, bound,
                         [&](double, bool) {
                           return std::vector<Line>{{Power(h0, bound.order - 1), 0}};
                         },
                         {Transcription::kRelaxation});
  if (rows) rows->evaluator->set_description(Text("surrogate bounds of derivative ", bound.order));
  return rows;
}

PlacedConstraint TimeContinuityRows(const JointShape& shape, int k) {
  const DerivativePoints last = LastDerivativePoint(shape.u, k);
  const DerivativePoints first = FirstDerivativePoint(shape.v, k, shape.first_of_v());
  const auto n = static_cast<int>(last.D.rows());
  const auto of_u = static_cast<int>(last.places.size());
  const auto of_v = static_cast<int>(first.places.size());
  std::vector<int> places = last.places;
  places.insert(places.end(), first.places.begin(), first.places.end());
  if (shape.u.has_fixed_duration() && shape.v.has_fixed_duration()) {
    SparseMatrix A(n, of_u + of_v);
    A.leftCols(of_u) = last.D * Power(shape.v.h_min, k);
    A.rightCols(of_v) = first.D * -Power(shape.u.h_min, k);
    return {std::make_shared<LinearEqualityConstraint>(A, Eigen::VectorXd::Zero(n)), places, {}};
  }
  places.push_back(last.duration);
  places.push_back(first.duration);
  std::vector<std::vector<std::pair<int, double>>> rows_u, rows_v;
  for (int i = 0; i < n; ++i) {
    rows_u.push_back(RowOf(last.D, i));
    rows_v.push_back(RowOf(first.D, i));
  }
  const auto function = MakeFunction(
      of_u + of_v + 2, [rows_u, rows_v, of_u, of_v, k](const Eigen::VectorX<Traced>& x) {
        const Traced power_u = PowerOf(x[of_u + of_v], k);
        const Traced power_v = PowerOf(x[of_u + of_v + 1], k);
        std::vector<Traced> values;
        for (std::size_t i = 0; i < rows_u.size(); ++i) {
          values.push_back(Sum(rows_u[i], x) * power_v - Sum(rows_v[i], x, of_u) * power_u);
        }
        return values;
      });
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  PlacedConstraint term{std::make_shared<FunctionConstraint>(function, zero, zero),
                        places,
                        {Transcription::kMIP, Transcription::kRestriction}};
  term.evaluator->set_description(Text("continuity of derivative ", k));
  return term;
}

}  // namespace switchyard
