// Pictures for the examples of trajectories: panels of lines and boxes, in a file of their own.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

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

/// One color for each of some lines.
inline std::string ColorOf(int line) {
  static const std::vector<std::string> colors = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728",
                                                  "#9467bd", "#8c564b", "#e377c2"};
  return colors[static_cast<std::size_t>(line) % colors.size()];
}
