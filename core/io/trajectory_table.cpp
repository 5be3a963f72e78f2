// Trajectories as tables of comma-separated values, written and read.
#include <algorithm>
#include <cmath>

#include "core/io/bytes.hpp"
#include "core/io/flat.hpp"
#include "core/io/text.hpp"
#include "switchyard/io/trajectory.hpp"

namespace switchyard {
namespace io {
namespace {

constexpr std::size_t kMostRows = std::size_t{1} << 22;

// "q3", "qd3", "qdd3", ...
std::string ColumnName(std::size_t derivative, std::size_t entry) {
  return Text('q', std::string(derivative, 'd'), entry);
}

// ---- Write ----

std::vector<double> EvenTimes(double start, double end, double rate) {
  const double count = std::ceil((end - start) * rate - 1e-6);  // no row just before the last one
  Require(count < static_cast<double>(kMostRows), "a table of at most ", kMostRows,
          " rows is written, got ", end - start, " s at ", rate, " rows a second");
  std::vector<double> times;
  for (double i = 0; i < count; ++i) times.push_back(start + i / rate);
  if (times.empty()) times.push_back(start);
  times.push_back(end);
  return times;
}

std::vector<double> ChosenTimes(const std::vector<double>& chosen, double start, double end) {
  Require(chosen.size() <= kMostRows - 2, "a table of at most ", kMostRows,
          " rows is written, got ", chosen.size(), " times");
  Require(chosen.front() >= start && chosen.back() <= end, "times: from ", start, " to ", end,
          ", the trajectory's, are needed, got ", chosen.front(), " to ", chosen.back());
  std::vector<double> times = chosen;
  if (times.front() != start) times.insert(times.begin(), start);
  if (times.back() != end) times.push_back(end);
  return times;
}

std::string Table(const Trajectory<double>& trajectory, const TrajectoryTableOptions& options) {
  options.Check();
  Require(trajectory.cols() == 1, "a table needs values of one column, this ", trajectory.Kind(),
          " has values of ", trajectory.rows(), " x ", trajectory.cols());
  const double start = trajectory.start_time();
  const double end = trajectory.end_time();
  Require(std::isfinite(start) && std::isfinite(end), "a table needs finite times, this ",
          trajectory.Kind(), " is from ", start, " to ", end);
  const auto rows = static_cast<std::size_t>(trajectory.rows());
  std::string text = "t";
  for (int k = 0; k <= options.derivatives; ++k) {
    for (std::size_t i = 0; i < rows; ++i) {
      text += Text(',', ColumnName(static_cast<std::size_t>(k), i));
    }
  }
  const std::vector<double> times = options.times.empty() ? EvenTimes(start, end, options.rate)
                                                          : ChosenTimes(options.times, start, end);
  for (const double t : times) {
    text += '\n';
    AppendNumber(t, &text);
    for (int k = 0; k <= options.derivatives; ++k) {
      const Eigen::VectorXd value = trajectory.EvalDerivative(t, k);
      Require(value.allFinite(), "a table needs finite values, derivative ", k, " at t = ", t,
              " is not");
      for (const double number : value) {
        text += ',';
        AppendNumber(number, &text);
      }
    }
  }
  return text + "\n";
}

// ---- Read ----

class TableReader {
 public:
  TableReader(const FileText& text, Notes* notes) : text_(text), lines_(text), notes_(*notes) {}

  PiecewisePolynomial<double> Read() {
    if (!lines_.Next()) Fail(lines_.rest(), "the header t,q0,q1,...");
    ReadHeader();
    std::vector<double> times;
    std::vector<Eigen::MatrixXd> samples;
    while (lines_.Next()) {
      if (lines_.line().empty()) continue;
      if (times.size() == kMostRows) {
        Fail(lines_.line(), Text("at most ", kMostRows, " rows"), "one more");
      }
      ReadRow(&times, &samples);
    }
    if (times.size() < 2) Fail(lines_.rest(), "two rows or more");
    return PiecewisePolynomial<double>::FirstOrderHold(times, samples);
  }

 private:
  [[noreturn]] void Fail(std::string_view at, const std::string& expected) const {
    text_.Fail(at, expected);
  }
  [[noreturn]] void Fail(std::string_view at, const std::string& expected,
                         const std::string& found) const {
    text_.Fail(at, expected, found);
  }
  template <class Visit>
  void ForEachField(Visit visit) const {
    std::string_view rest = lines_.line();
    for (;;) {
      const std::size_t comma = rest.find(',');
      visit(rest.substr(0, comma));
      if (comma == std::string_view::npos) return;
      rest.remove_prefix(comma + 1);
    }
  }
  void CheckSlope(const Eigen::MatrixXd& change, const std::vector<double>& times) const {
    const double duration = times.back() - times[times.size() - 2];
    if (change.allFinite() && (change / duration).allFinite()) return;
    Fail(lines_.line(), "values that a line from the row before can reach in double numbers",
         "too large a change");
  }
  // t, the values, and for each derivative as many again.
  void ReadHeader() {
    std::size_t derivative = 0;
    std::size_t entry = 0;
    const auto is_complete = [&] { return derivative == 0 ? entry > 0 : entry == values_; };
    ForEachField([&](std::string_view field) {
      const std::string name = fields_ == 0 ? "t" : ColumnName(derivative, entry);
      if (fields_ > 0 && is_complete() && field == ColumnName(derivative + 1, 0)) {
        if (derivative == 0) values_ = entry;
        ++derivative;
        entry = 1;
      } else if (field == name) {
        if (fields_ > 0) ++entry;
      } else {
        Fail(field, name, field.empty() ? "an empty field" : Quoted(field));
      }
      ++fields_;
    });
    if (derivative == 0) {
      values_ = entry;
    } else {
      if (!is_complete()) Fail(lines_.line(), ColumnName(derivative, entry), "a header without it");
      notes_.Say("columns of derivatives are left out: a line joins the values of two rows");
    }
  }
  void ReadRow(std::vector<double>* times, std::vector<Eigen::MatrixXd>* samples) const {
    Eigen::MatrixXd sample(static_cast<Eigen::Index>(values_), 1);
    std::size_t count = 0;
    ForEachField([&](std::string_view field) {
      if (count == fields_) Fail(field, Text(fields_, " fields, as the header has"), "one more");
      if (field.empty()) Fail(field, "a number", "an empty field");
      const double number = text_.Number(field);
      if (count > 0 && count <= values_) sample(static_cast<Eigen::Index>(count) - 1) = number;
      if (count == 0) {
        if (!times->empty() && !(number - times->back() >= kShortest)) {
          Fail(field, Text("a time after ", times->back(), ", that of the row before"));
        }
        times->push_back(number);
      }
      ++count;
    });
    if (count < fields_) {
      Fail(lines_.line(), Text(fields_, " fields, as the header has"), Text(count));
    }
    if (!samples->empty()) CheckSlope(sample - samples->back(), *times);
    samples->push_back(std::move(sample));
  }

  static constexpr double kShortest = PiecewiseTrajectory<double>::kEpsilonTime;
  const FileText& text_;
  Lines lines_;
  Notes& notes_;
  std::size_t fields_ = 0;  // of the header, and so of each row
  std::size_t values_ = 0;  // entries of q
};

PiecewisePolynomial<double> ReadTable(std::string_view bytes, const std::string& name,
                                      const ReadOptions& options) {
  const FileText text(bytes, name);
  Notes notes(options.notes);
  PiecewisePolynomial<double> read = TableReader(text, &notes).Read();
  notes.Finish();
  return read;
}

}  // namespace
}  // namespace io

void TrajectoryTableOptions::Check() const {
  Require(std::isfinite(rate) && rate > 0,
          "rate: a positive number of rows a second is needed, got ", rate);
  Require(derivatives >= 0, "derivatives: an order of 0 or more is needed, got ", derivatives);
  for (std::size_t i = 0; i < times.size(); ++i) {
    Require(std::isfinite(times[i]), "times: times[", i, "] needs to be finite, got ", times[i]);
    Require(i == 0 || times[i - 1] < times[i], "times: times[", i, "] = ", times[i],
            " needs to be above times[", i - 1, "] = ", times[i - 1]);
  }
}

std::string TrajectoryTable(const Trajectory<double>& trajectory,
                            const TrajectoryTableOptions& options) {
  return io::Table(trajectory, options);
}

void WriteTrajectoryTable(const Trajectory<double>& trajectory, const std::string& path,
                          const TrajectoryTableOptions& options) {
  const std::string text = TrajectoryTable(trajectory, options);
  io::WriteBytes(path, path.ends_with(".gz") ? io::Zipped(text) : text);
}

PiecewisePolynomial<double> ReadTrajectoryTable(const std::string& path,
                                                const ReadOptions& options) {
  std::string bytes = io::ReadBytes(path, options.byte_limit);
  if (io::IsGzip(bytes)) bytes = io::Unzipped(bytes, path, options.byte_limit);
  return io::ReadTable(bytes, path, options);
}

PiecewisePolynomial<double> ReadTrajectoryTableText(std::string_view text, const std::string& name,
                                                    const ReadOptions& options) {
  Require(text.size() <= options.byte_limit, name, ": the limit is ", options.byte_limit,
          " bytes, this has ", text.size());
  return io::ReadTable(text, name, options);
}

}  // namespace switchyard
