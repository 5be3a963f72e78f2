// trajectory/1: trajectories, read and written.
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/io/bytes.hpp"
#include "core/io/json.hpp"
#include "core/io/json_numbers.hpp"
#include "core/trajectory/joins.hpp"
#include "switchyard/io/trajectory.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/bspline_trajectory.hpp"
#include "switchyard/trajectory/composite_trajectory.hpp"
#include "switchyard/trajectory/path_parameterized_trajectory.hpp"

namespace switchyard {
namespace io {
namespace {

using Curve = Trajectory<double>;
using CurvePointer = std::unique_ptr<Curve>;

constexpr double kShortest = PiecewiseTrajectory<double>::kEpsilonTime;
constexpr int kIntLimit = std::numeric_limits<int>::max();
constexpr int kDeepest = 20;  // trajectories within one another; a file may nest 64 levels

// Where an entry's text goes, and what it cannot say.
struct Sink {
  std::string* text;
  std::vector<std::string>* reasons;
  std::string pointer = {};
  int depth = 1;

  [[nodiscard]] Sink Within(const std::string& part) const {
    return {text, reasons, Text(pointer, "/", part), depth + 1};
  }
  void Numbers(const VectorRef& numbers) const {
    if (!numbers.allFinite()) Add("numbers that are not finite");
    AppendJson(numbers, text);
  }
  void Add(const std::string& reason) const {
    std::string full = pointer.empty() ? reason : Text(pointer, ": ", reason);
    if (reasons->empty() || reasons->back() != full) reasons->push_back(std::move(full));
  }
};

// One row for each class.
struct TypeFacts {
  std::string_view name;
  CurvePointer (*read)(JsonValue entry, int depth);
  bool (*append)(const Curve& curve, const Sink& sink);  // false: it is of another class
};

CurvePointer ReadEntry(JsonValue entry, int depth);
void AppendEntry(const Curve& curve, const Sink& sink);

// ---- Read ----

// A matrix whose columns are the lists, each of `size` numbers.
Eigen::MatrixXd ReadColumns(JsonValue list, Eigen::Index size) {
  list.ForEach([&](JsonValue column) { CheckEntries(column, size, "entry of a value"); });
  Eigen::MatrixXd columns(size, list.Size());
  Eigen::Index j = 0;
  list.ForEach([&](JsonValue column) { columns.col(j++) = ReadVector(column); });
  return columns;
}

CurvePointer ReadBezier(JsonValue entry, int /*depth*/) {
  const JsonFields fields(entry, {"format", "type", "start", "end", "control_points"});
  const double start = fields["start"].Number();
  const double end = fields["end"].Number();
  if (!(start < end)) fields["end"].Fail(Text("a time after ", start, ", the start"));
  const JsonValue points = fields["control_points"];
  if (points.Size() == 0) points.Fail("a list of one point or more");
  const Eigen::Index rows = points.Elements()[0].Size();
  return std::make_unique<BezierCurve<double>>(start, end, ReadColumns(points, rows));
}

struct Shape {
  int rows;
  int cols;
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(rows) * cols; }
};

Shape ReadShape(const JsonFields& fields) {
  return {fields["rows"].Integer(0, kIntLimit, "a number of rows"),
          fields["cols"].Integer(0, kIntLimit, "a number of columns")};
}

BsplineBasis<double> ReadBasis(const JsonFields& fields) {
  const int order = fields["order"].Integer(1, kIntLimit, "an order");
  const JsonValue list = fields["knots"];
  const auto least = 2 * static_cast<std::int64_t>(order);
  if (list.Size() < least) list.Fail(Text("a list of ", least, " or more, twice the order"));
  std::vector<double> knots;
  knots.reserve(static_cast<std::size_t>(list.Size()));
  list.ForEach([&](JsonValue knot) {
    const double number = knot.Number();
    if (!knots.empty() && number < knots.back()) {
      knot.Fail(Text("a knot of ", knots.back(), ", the one before, or more"));
    }
    knots.push_back(number);
  });
  const auto first = static_cast<std::size_t>(order) - 1;
  const std::size_t last = knots.size() - static_cast<std::size_t>(order);
  if (!(knots[first] < knots[last])) {
    list.Fail(Text("knot ", last, " above knot ", first), Text(knots[first], " for both"));
  }
  return {order, std::move(knots)};
}

CurvePointer ReadBspline(JsonValue entry, int /*depth*/) {
  const JsonFields fields(entry,
                          {"format", "type", "rows", "cols", "order", "knots", "control_points"});
  const Shape shape = ReadShape(fields);
  BsplineBasis<double> basis = ReadBasis(fields);
  const JsonValue list = fields["control_points"];
  CheckEntries(list, basis.num_basis_functions(), "basis function");
  const Eigen::MatrixXd columns = ReadColumns(list, shape.size());
  std::vector<Eigen::MatrixXd> points;
  points.reserve(static_cast<std::size_t>(columns.cols()));
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    points.emplace_back(columns.col(j).reshaped(shape.rows, shape.cols));
  }
  return std::make_unique<BsplineTrajectory<double>>(std::move(basis), std::move(points));
}

std::vector<double> ReadBreaks(JsonValue list) {
  std::vector<double> breaks;
  breaks.reserve(static_cast<std::size_t>(list.Size()));
  list.ForEach([&](JsonValue one) {
    const double number = one.NumberOrInfinity();
    if (!breaks.empty() && !(number - breaks.back() >= kShortest)) {
      one.Fail(Text("a break above ", breaks.back(), ", the one before"));
    }
    breaks.push_back(number);
  });
  if (breaks.size() == 1) list.Fail("no breaks, or two or more");
  return breaks;
}

CurvePointer ReadPolynomials(JsonValue entry, int /*depth*/) {
  const JsonFields fields(entry, {"format", "type", "rows", "cols", "breaks", "segments"});
  const Shape shape = ReadShape(fields);
  std::vector<double> breaks = ReadBreaks(fields["breaks"]);
  const JsonValue list = fields["segments"];
  if (breaks.empty()) {
    CheckEntries(list, 0, "segment between breaks");
    return std::make_unique<PiecewisePolynomial<double>>();
  }
  CheckEntries(list, static_cast<Eigen::Index>(breaks.size()) - 1, "segment between breaks");
  std::vector<Eigen::MatrixXd> coefficients;
  coefficients.reserve(breaks.size() - 1);
  list.ForEach([&](JsonValue segment) {
    if (segment.Size() == 0) segment.Fail("a list of one coefficient or more");
    if (segment.Size() > 1 && std::isinf(breaks[coefficients.size()])) {
      segment.Fail("a list of one coefficient where a segment starts at -inf");
    }
    coefficients.push_back(ReadColumns(segment, shape.size()));
  });
  return std::make_unique<PiecewisePolynomial<double>>(
      PiecewisePolynomial<double>::FromCoefficients(shape.rows, shape.cols, std::move(coefficients),
                                                    std::move(breaks)));
}

// A part of another trajectory.
CurvePointer ReadPart(JsonValue entry, int depth) {
  CurvePointer part = ReadEntry(entry, depth + 1);
  const auto* pieces = dynamic_cast<const PiecewiseTrajectory<double>*>(part.get());
  if (pieces != nullptr && pieces->get_number_of_segments() == 0) {
    entry.Fail("a trajectory with segments", "one without");
  }
  return part;
}

void CheckFollows(JsonValue entry, const Curve& segment, const Curve& before) {
  if (segment.rows() != before.rows() || segment.cols() != before.cols()) {
    entry.Fail(Text("values of ", before.rows(), " x ", before.cols(), ", as the segment before"),
               Text(segment.rows(), " x ", segment.cols()));
  }
  if (!Joins(before.end_time(), segment.start_time())) {
    entry.Fail(Text("a segment that starts at ", before.end_time(), ", where the one before ends"),
               Text("one that starts at ", segment.start_time()));
  }
  if (!(segment.start_time() - before.start_time() >= kShortest)) {
    entry.Fail(
        Text("a segment that starts after ", before.start_time(), ", as the one before does"),
        Text("one that starts at ", segment.start_time()));
  }
}

CurvePointer ReadComposite(JsonValue entry, int depth) {
  const JsonFields fields(entry, {"format", "type", "segments"});
  std::vector<TrajectoryPointer<double>> segments;
  fields["segments"].ForEach([&](JsonValue one) {
    CurvePointer segment = ReadPart(one, depth);
    if (!(segment->end_time() - segment->start_time() >= kShortest)) {
      one.Fail(Text("a segment of ", kShortest, " s or longer"),
               Text(segment->end_time() - segment->start_time(), " s"));
    }
    if (!segments.empty()) CheckFollows(one, *segment, *segments.back());
    segments.emplace_back(std::move(segment));
  });
  return std::make_unique<CompositeTrajectory<double>>(std::move(segments));
}

CurvePointer ReadPathParameterized(JsonValue entry, int depth) {
  const JsonFields fields(entry, {"format", "type", "path", "time_scaling"});
  const CurvePointer path = ReadPart(fields["path"], depth);
  const CurvePointer scaling = ReadPart(fields["time_scaling"], depth);
  if (scaling->rows() != 1 || scaling->cols() != 1) {
    fields["time_scaling"].Fail("values of 1 x 1", Text(scaling->rows(), " x ", scaling->cols()));
  }
  return std::make_unique<PathParameterizedTrajectory<double>>(*path, *scaling);
}

// ---- Write ----

template <class Column>
void AppendColumns(Eigen::Index count, const Sink& sink, Column column) {
  *sink.text += '[';
  for (Eigen::Index j = 0; j < count; ++j) {
    if (j > 0) *sink.text += ", ";
    sink.Numbers(column(j));
  }
  *sink.text += ']';
}

bool AppendBezier(const Curve& curve, const Sink& sink) {
  const auto* bezier = dynamic_cast<const BezierCurve<double>*>(&curve);
  if (bezier == nullptr) return false;
  *sink.text += ", \"start\": ";
  AppendJson(bezier->start_time(), sink.text);
  *sink.text += ", \"end\": ";
  AppendJson(bezier->end_time(), sink.text);
  *sink.text += ",\n \"control_points\": ";
  const Eigen::MatrixXd& points = bezier->control_points();
  AppendColumns(points.cols(), sink, [&](Eigen::Index j) { return points.col(j); });
  return true;
}

void AppendShape(Eigen::Index rows, Eigen::Index cols, std::string* text) {
  *text += Text(", \"rows\": ", rows, ", \"cols\": ", cols);
}

void AppendTimes(const std::vector<double>& times, std::string* text) {
  AppendJson(
      Eigen::Map<const Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size())),
      text);
}

bool AppendBspline(const Curve& curve, const Sink& sink) {
  const auto* bspline = dynamic_cast<const BsplineTrajectory<double>*>(&curve);
  if (bspline == nullptr) return false;
  AppendShape(bspline->rows(), bspline->cols(), sink.text);
  *sink.text += Text(", \"order\": ", bspline->basis().order(), ",\n \"knots\": ");
  AppendTimes(bspline->basis().knots(), sink.text);
  *sink.text += ",\n \"control_points\": ";
  AppendColumns(bspline->num_control_points(), sink, [&](Eigen::Index j) {
    return bspline->control_points()[static_cast<std::size_t>(j)].reshaped().eval();
  });
  return true;
}

bool AppendPolynomials(const Curve& curve, const Sink& sink) {
  const auto* polynomials = dynamic_cast<const PiecewisePolynomial<double>*>(&curve);
  if (polynomials == nullptr) return false;
  const int segments = polynomials->get_number_of_segments();
  AppendShape(segments == 0 ? 0 : curve.rows(), segments == 0 ? 0 : curve.cols(), sink.text);
  *sink.text += ",\n \"breaks\": ";
  AppendTimes(polynomials->get_segment_times(), sink.text);
  *sink.text += ",\n \"segments\": [";
  for (int i = 0; i < segments; ++i) {
    *sink.text += i == 0 ? "\n  " : ",\n  ";
    const Eigen::MatrixXd& coefficients = polynomials->coefficients(i);
    AppendColumns(coefficients.cols(), sink, [&](Eigen::Index j) { return coefficients.col(j); });
  }
  *sink.text += ']';
  return true;
}

bool AppendComposite(const Curve& curve, const Sink& sink) {
  const auto* composite = dynamic_cast<const CompositeTrajectory<double>*>(&curve);
  if (composite == nullptr) return false;
  *sink.text += ",\n\"segments\": [";
  for (int i = 0; i < composite->get_number_of_segments(); ++i) {
    *sink.text += i == 0 ? "\n" : ",\n";
    AppendEntry(composite->segment(i), sink.Within(Text("segments/", i)));
  }
  *sink.text += ']';
  return true;
}

bool AppendPathParameterized(const Curve& curve, const Sink& sink) {
  const auto* along = dynamic_cast<const PathParameterizedTrajectory<double>*>(&curve);
  if (along == nullptr) return false;
  *sink.text += ",\n\"path\": ";
  AppendEntry(along->path(), sink.Within("path"));
  *sink.text += ",\n\"time_scaling\": ";
  AppendEntry(along->time_scaling(), sink.Within("time_scaling"));
  return true;
}

constexpr std::array<TypeFacts, 5> kTypes = {{
    {"bezier", ReadBezier, AppendBezier},
    {"bspline", ReadBspline, AppendBspline},
    {"piecewise_polynomial", ReadPolynomials, AppendPolynomials},
    {"composite", ReadComposite, AppendComposite},
    {"path_parameterized", ReadPathParameterized, AppendPathParameterized},
}};

CurvePointer ReadEntry(JsonValue entry, int depth) {
  if (depth > kDeepest) {
    entry.Fail(Text("at most ", kDeepest, " trajectories within one another"), "one more");
  }
  if (const auto format = entry.Member("format")) {
    if (format->String() != "trajectory/1") format->Fail("\"trajectory/1\"");
  }
  const auto type = entry.Member("type");
  if (!type) entry.Fail("\"type\"", "an object without it");
  std::vector<std::string_view> names;
  std::string known;
  for (const TypeFacts& facts : kTypes) {
    if (facts.name == type->String()) return facts.read(entry, depth);
    names.push_back(facts.name);
    known += Text(known.empty() ? "" : ", ", facts.name);
  }
  type->Fail("a type of trajectory (" + known + ")", QuotedWithNearest(type->String(), names));
}

// The brackets of the root are not its own: "format" stands before.
void AppendMembers(const Curve& curve, const Sink& sink) {
  if (sink.depth > kDeepest) {
    sink.Add(Text("more than ", kDeepest, " trajectories within one another"));
    return;
  }
  for (const TypeFacts& facts : kTypes) {
    const std::size_t before = sink.text->size();
    *sink.text += Text("\"type\": \"", facts.name, "\"");
    if (facts.append(curve, sink)) return;
    sink.text->resize(before);
  }
  sink.Add(Text("a ", curve.Kind(), ", a class of trajectories that files do not hold"));
}

void AppendEntry(const Curve& curve, const Sink& sink) {
  *sink.text += '{';
  AppendMembers(curve, sink);
  *sink.text += '}';
}

std::string Written(const Curve& curve, std::vector<std::string>* reasons) {
  std::string text = "{\"format\": \"trajectory/1\", ";
  AppendMembers(curve, {&text, reasons});
  return text + "}\n";
}

CurvePointer ReadText(std::string_view bytes, const std::string& name) {
  const FileText text(bytes, name);
  const JsonDocument document(text);
  if (!document.root().Member("format")) {
    document.root().Fail("\"format\": \"trajectory/1\"", "an object without it");
  }
  return ReadEntry(document.root(), 1);
}

}  // namespace
}  // namespace io

std::unique_ptr<Trajectory<double>> ReadTrajectory(const std::string& path,
                                                   const ReadOptions& options) {
  std::string bytes = io::ReadBytes(path, options.byte_limit);
  if (io::IsGzip(bytes)) bytes = io::Unzipped(bytes, path, options.byte_limit);
  return io::ReadText(bytes, path);
}

std::unique_ptr<Trajectory<double>> ReadTrajectoryText(std::string_view text,
                                                       const std::string& name,
                                                       const ReadOptions& options) {
  Require(text.size() <= options.byte_limit, name, ": the limit is ", options.byte_limit,
          " bytes, this has ", text.size());
  return io::ReadText(text, name);
}

std::vector<std::string> CannotHold(const Trajectory<double>& trajectory) {
  std::vector<std::string> reasons;
  (void)io::Written(trajectory, &reasons);
  return reasons;
}

std::string TrajectoryText(const Trajectory<double>& trajectory) {
  std::vector<std::string> reasons;
  std::string text = io::Written(trajectory, &reasons);
  std::string all;
  for (const std::string& reason : reasons) all += "; " + reason;
  Require(all.empty(), "trajectory/1 cannot hold this trajectory", all);
  return text;
}

void WriteTrajectory(const Trajectory<double>& trajectory, const std::string& path) {
  const std::string text = TrajectoryText(trajectory);
  io::WriteBytes(path, path.ends_with(".gz") ? io::Zipped(text) : text);
}

}  // namespace switchyard
