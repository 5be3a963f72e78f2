// Pictures for the examples of trajectories: panels of lines and boxes, in a file of their own.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// One color for each of some lines.
inline std::string ColorOf(int line) {
  static const std::vector<std::string> colors = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728",
                                                  "#9467bd", "#8c564b", "#e377c2"};
  return colors[static_cast<std::size_t>(line) % colors.size()];
}

/// A range of x and y, drawn into a part of the picture. Lengths on paper are in pixels.
class Panel {
 public:
  /// `equal`: are x and y drawn to the same scale?
  Panel(std::string title, Eigen::Vector2d low, Eigen::Vector2d high, bool equal)
      : title_(std::move(title)), low_(low), high_(high), equal_(equal) {}

  /// Points by columns.
  void Line(const Eigen::Matrix2Xd& points, const std::string& color, double width = 2,
            const std::string& more = "") {
    body_ << "<polyline fill='none' stroke='" << color << "' stroke-width='" << width
          << "' stroke-linejoin='round' " << more << " points='";
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector2d at = OnPaper(points.col(i));
      body_ << at.x() << "," << at.y() << " ";
    }
    body_ << "'/>\n";
  }
  void Box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const std::string& fill,
           const std::string& stroke) {
    const Eigen::Vector2d a = OnPaper(low), b = OnPaper(high);
    body_ << "<rect x='" << a.x() << "' y='" << b.y() << "' width='" << b.x() - a.x()
          << "' height='" << a.y() - b.y() << "' fill='" << fill << "' stroke='" << stroke
          << "'/>\n";
  }
  void Dot(const Eigen::Vector2d& at, const std::string& color, double radius = 4) {
    const Eigen::Vector2d p = OnPaper(at);
    body_ << "<circle cx='" << p.x() << "' cy='" << p.y() << "' r='" << radius << "' fill='"
          << color << "'/>\n";
  }

  static constexpr double kWidth = 640, kMargin = 44;
  [[nodiscard]] double Height() const {
    if (!equal_) return 230;
    const Eigen::Vector2d size = high_ - low_;
    return (kWidth - 2 * kMargin) * size.y() / size.x() + 2 * kMargin;
  }
  [[nodiscard]] std::string Text() const {
    const Eigen::Vector2d a = OnPaper(low_), b = OnPaper(high_);
    std::ostringstream text;
    text << "<rect x='" << a.x() << "' y='" << b.y() << "' width='" << b.x() - a.x() << "' height='"
         << a.y() - b.y() << "' fill='none' stroke='#888'/>\n"
         << Label(a.x(), b.y() - 8, "start", title_) << Label(a.x(), a.y() + 16, "middle", low_.x())
         << Label(b.x(), a.y() + 16, "middle", high_.x())
         << Label(a.x() - 6, a.y(), "end", low_.y())
         << Label(a.x() - 6, b.y() + 10, "end", high_.y());
    return text.str() + body_.str();
  }

 private:
  template <class What>
  static std::string Label(double x, double y, const char* anchor, const What& what) {
    std::ostringstream text;
    text.precision(3);
    text << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor
         << "' font-family='sans-serif' font-size='12' fill='#333'>" << what << "</text>\n";
    return text.str();
  }
  [[nodiscard]] Eigen::Vector2d OnPaper(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d part = (p - low_).cwiseQuotient(high_ - low_);
    return {kMargin + part.x() * (kWidth - 2 * kMargin),
            Height() - kMargin - part.y() * (Height() - 2 * kMargin)};
  }

  std::string title_;
  Eigen::Vector2d low_, high_;
  bool equal_;
  std::ostringstream body_;
};

/// One panel above the other.
inline void WritePicture(const std::string& path, const std::vector<const Panel*>& panels) {
  double height = 0;
  for (const Panel* panel : panels) height += panel->Height();
  std::ofstream file(path);
  file << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << Panel::kWidth << " " << height
       << "' width='" << Panel::kWidth << "'>\n<rect width='100%' height='100%' fill='white'/>\n";
  double top = 0;
  for (const Panel* panel : panels) {
    file << "<g transform='translate(0 " << top << ")'>\n" << panel->Text() << "</g>\n";
    top += panel->Height();
  }
  file << "</svg>\n";
  if (!file.flush()) throw std::runtime_error("the picture could not be written to " + path);
}

/// Small plots over time side by side: a row for each of some things, a column for what is plotted
/// of them. Ranges are those of the curves and of the limits that they come near to.
class PlotGrid {
 public:
  PlotGrid(std::vector<std::string> rows, std::vector<std::string> columns)
      : rows_(std::move(rows)),
        columns_(std::move(columns)),
        cells_(rows_.size() * columns_.size()) {}

  void Curve(std::size_t row, std::size_t column, const Eigen::VectorXd& times,
             const Eigen::VectorXd& values) {
    At(row, column).times = times;
    At(row, column).values = values;
  }
  /// Dashed; infinite ones are not drawn.
  void Limits(std::size_t row, std::size_t column, double lower, double upper) {
    At(row, column).limits = {lower, upper};
  }
  /// A time that is marked in all plots.
  void Mark(double time) { marks_.push_back(time); }
  /// A line at the top.
  void Write(const std::string& path, const std::string& title) const {
    const double width = kLeft + kWidth * static_cast<double>(columns_.size());
    const double height = kTop + kHeight * static_cast<double>(rows_.size()) + 16;
    std::ofstream file(path);
    file.precision(6);
    file << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << " " << height
         << "' width='" << width << "' font-family='sans-serif' font-size='11' fill='#333'>\n"
         << "<rect width='100%' height='100%' fill='white'/>\n"
         << "<text x='8' y='18' font-size='13'>" << title << "</text>\n";
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      file << "<text x='" << LeftOf(j) << "' y='" << kTop - 6 << "'>" << columns_[j] << "</text>\n";
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      file << "<text x='8' y='" << TopOf(i) + kHeight / 2 << "'>" << rows_[i] << "</text>\n";
      for (std::size_t j = 0; j < columns_.size(); ++j) {
        WriteCell(file, cells_[i * columns_.size() + j], LeftOf(j), TopOf(i), i);
      }
    }
    file << "</svg>\n";
    if (!file.flush()) throw std::runtime_error("the picture could not be written to " + path);
  }

 private:
  struct Cell {
    Eigen::VectorXd times, values;
    Eigen::Vector2d limits{-std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::infinity()};
  };
  static constexpr double kLeft = 78, kTop = 44, kWidth = 290, kHeight = 84, kGap = 44;

  Cell& At(std::size_t row, std::size_t column) {
    return cells_.at(row * columns_.size() + column);
  }
  static double LeftOf(std::size_t j) { return kLeft + kWidth * static_cast<double>(j); }
  static double TopOf(std::size_t i) { return kTop + kHeight * static_cast<double>(i); }
  static std::string Number(double x) {
    std::ostringstream text;
    text.precision(3);
    text << (std::abs(x) < 1e-12 ? 0 : x);
    return text.str();
  }

  void WriteCell(std::ofstream& file, const Cell& cell, double left, double top,
                 std::size_t row) const {
    const double w = kWidth - kGap, h = kHeight - 14;
    double low = cell.values.minCoeff(), high = cell.values.maxCoeff();
    const double room = std::max(high - low, 1e-6);
    for (const double limit : cell.limits) {  // one that is far away would flatten the curve
      if (limit > low - room && limit < high + room) {
        low = std::min(low, limit);
        high = std::max(high, limit);
      }
    }
    const double margin = std::max(0.06 * (high - low), 1e-6);
    low -= margin;
    high += margin;
    const double begin = cell.times[0], end = cell.times[cell.times.size() - 1];
    const auto x = [&](double t) { return left + (t - begin) / (end - begin) * w; };
    const auto y = [&](double value) { return top + h - (value - low) / (high - low) * h; };
    file << "<rect x='" << left << "' y='" << top << "' width='" << w << "' height='" << h
         << "' fill='none' stroke='#bbb'/>\n";
    for (const double mark : marks_) {
      file << "<path d='M" << x(mark) << " " << top << "v" << h << "' stroke='#ddd'/>\n";
    }
    for (const double limit : cell.limits) {
      if (limit < low || limit > high) continue;
      file << "<path d='M" << left << " " << y(limit) << "h" << w
           << "' stroke='#c33' stroke-dasharray='4 3'/>\n";
    }
    file << "<polyline fill='none' stroke='" << ColorOf(static_cast<int>(row))
         << "' stroke-width='1.6' points='";
    for (Eigen::Index k = 0; k < cell.times.size(); ++k) {
      file << x(cell.times[k]) << "," << y(cell.values[k]) << " ";
    }
    file << "'/>\n";
    if (cell.limits.allFinite() && cell.limits[0] < low && cell.limits[1] > high) {
      file << "<text x='" << left + w << "' y='" << top + h + 10
           << "' text-anchor='end' font-size='9' fill='#c33'>limits " << Number(cell.limits[0])
           << ", " << Number(cell.limits[1]) << "</text>\n";
    }
    file << "<text x='" << left - 4 << "' y='" << top + 9 << "' text-anchor='end'>" << Number(high)
         << "</text>\n<text x='" << left - 4 << "' y='" << top + h << "' text-anchor='end'>"
         << Number(low) << "</text>\n";
  }

  std::vector<std::string> rows_, columns_;
  std::vector<Cell> cells_;
  std::vector<double> marks_;
};
