#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <unordered_map>

#include <fmt/format.h>

#include "outline.hpp"
#include "switchyard/error.hpp"

namespace switchyard::cli {
namespace {

using Eigen::Vector2d;
using Edge = GraphOfConvexSets::Edge;
using Vertex = GraphOfConvexSets::Vertex;

// Pixels.
constexpr double kMargin = 24;
constexpr double kWidth = 912;   // of the drawing, at most
constexpr double kHeight = 760;  // likewise
constexpr double kLegendWidth = 560;
constexpr double kLine = 20;          // from line to line of the legend
constexpr double kFlowWidth = 7;      // of a flow of 1, at most
constexpr double kPathWidth = 3;      // at most
constexpr double kDot = 3.5;          // radius of a point of the path, at most
constexpr double kLeastFlow = 1e-3;   // less is no line
constexpr std::size_t kNamed = 1000;  // sets at most whose names show under the pointer

// Colours that readers who confuse red and green tell apart; shapes and widths differ too.
constexpr const char* kStyle =
    ".s{fill:#dfe7ef;fill-opacity:.6;stroke:#9fadba;stroke-width:.7}"
    ".f{fill:none;stroke:#56b4e9;stroke-opacity:.75;stroke-linecap:round}"
    ".p{fill:none;stroke:#d55e00;stroke-linejoin:round;stroke-linecap:round}"
    ".d{fill:#d55e00;stroke:#fff;stroke-width:.8}.e{fill:#d55e00}"
    ".a{fill:#009e73;stroke:#fff;stroke-width:1.5}"
    ".b{fill:#222;stroke:#fff;stroke-width:1.5}"
    "text{font:13px sans-serif;fill:#222}.t{font-weight:bold}";

std::string Escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (static_cast<unsigned char>(c) < ' ') {
      out += ' ';
    } else {
      out += c;
    }
  }
  return out;
}

/// Tenths of a pixel without a trailing zero.
std::string Tenths(double v) {
  constexpr double kTen = 10;
  const double rounded = std::round(v * kTen) / kTen;
  return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

/// From the plane, y up, to pixels, y down; the same scale on both axes.
class View {
 public:
  explicit View(Frame frame) {
    const Vector2d extent = frame.upper - frame.lower;
    const double largest = extent.maxCoeff() > 0 ? extent.maxCoeff() : 1;
    constexpr double kAir = 0.02;         // around the sets
    constexpr double kLeastExtent = 0.2;  // of a side, by the other: a flat drawing has room
    const Vector2d center = frame.Center();
    const Vector2d half = 0.5 * extent.cwiseMax(kLeastExtent * largest).array() + kAir * largest;
    lower_ = center - half;
    scale_ = std::min(kWidth / (2 * half[0]), kHeight / (2 * half[1]));
    size_ = 2 * half * scale_;
    left_ = kMargin + std::max(0.0, kLegendWidth - size_[0]) / 2;
  }
  [[nodiscard]] Vector2d operator()(const Vector2d& p) const {
    const Vector2d at = (p - lower_) * scale_;
    return {left_ + at[0], kMargin + size_[1] - at[1]};
  }
  /// To the data of a path: "M" moves there, "L" draws a line there.
  void Append(char command, const Vector2d& p, std::string& data) const {
    const Vector2d at = (*this)(p);
    data += fmt::format("{}{} {}", command, Tenths(at[0]), Tenths(at[1]));
  }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const Vector2d& size() const { return size_; }
  /// The share of `most` that fits where `count` sets share the drawing.
  [[nodiscard]] double Fitting(double most, int count) const {
    constexpr double kPlenty = 20;  // pixels of a set across
    const double across = std::sqrt(size_[0] * size_[1] / std::max(count, 1));
    return most * std::min(1.0, across / kPlenty);
  }

 private:
  Vector2d lower_;
  Vector2d size_;
  double left_ = kMargin;
  double scale_ = 1;
};

/// What is drawn of the vertices, and where.
struct Scene {
  Frame frame;
  std::unordered_map<const Vertex*, Outline> outlines;
  bool exact = true;
};

// Boxes and ends that are finite, and all that was found, make the frame; unbounded sets end there.
Scene Compose(const GraphOfConvexSets& graph, const ShortestPath& found) {
  Scene scene;
  for (const Vertex* v : graph.Vertices()) {
    const Frame box = FrameOf(v->set());
    if (box.empty()) continue;
    for (const Vector2d& corner : {box.lower, box.upper}) {
      if (corner.allFinite()) scene.frame.Add(corner);
    }
  }
  for (const Eigen::VectorXd& x : found.points) scene.frame.Add(Shadow(x));
  if (scene.frame.empty()) {
    scene.frame.Add(Vector2d::Constant(-1));
    scene.frame.Add(Vector2d::Constant(1));
  }
  for (const Vertex* v : graph.Vertices()) {
    Outline outline = OutlineOf(v->set(), scene.frame);
    scene.exact = scene.exact && outline.exact;
    scene.outlines.emplace(v, std::move(outline));
  }
  return scene;
}

std::string Shape(const Outline& outline, const View& view) {
  if (outline.ellipse.has_value()) {
    const Ellipse& e = *outline.ellipse;
    const Vector2d at = view(e.center);
    return fmt::format(
        R"s(<ellipse class="s" rx="{}" ry="{}" transform="translate({} {})rotate({})")s",
        Tenths(e.radii[0] * view.scale()), Tenths(e.radii[1] * view.scale()), Tenths(at[0]),
        Tenths(at[1]), Tenths(-e.angle));
  }
  std::string path;
  for (const Vector2d& p : outline.corners) view.Append(path.empty() ? 'M' : 'L', p, path);
  return fmt::format(R"(<path class="s" d="{}Z")", path);
}

std::string Sets(const GraphOfConvexSets& graph, const Scene& scene, const View& view) {
  std::string svg;
  const std::vector<const Vertex*> vertices = graph.Vertices();
  for (const Vertex* v : vertices) {
    const Outline& outline = scene.outlines.at(v);
    if (outline.corners.size() < 2 && !outline.ellipse.has_value()) continue;
    svg += Shape(outline, view);
    const bool named = vertices.size() <= kNamed && !v->name().empty();
    svg += named ? "><title>" + Escaped(v->name()) + "</title>" : "";
    svg += !named ? "/>\n" : outline.ellipse.has_value() ? "</ellipse>\n" : "</path>\n";
  }
  return svg;
}

/// Where an edge's line begins and ends: the points of its flow where the answer holds flows, else
/// the middles of its sets.
std::array<Vector2d, 2> Ends(const Edge& edge, double flow, const Scene& scene,
                             const ShortestPath& found) {
  if (found.points.empty()) {
    const auto u = edge.GetSolutionPhiXu(found.result);
    const auto v = edge.GetSolutionPhiXv(found.result);
    if (u.has_value() && v.has_value() && u->allFinite() && v->allFinite()) {
      return {Shadow(*u) / flow, Shadow(*v) / flow};
    }
  }
  return {scene.outlines.at(&edge.u()).Center(), scene.outlines.at(&edge.v()).Center()};
}

/// `most` is the width of a flow of 1. Lines of equal width stand in one path: a picture of many
/// thousand edges stays small.
std::string Flows(const GraphOfConvexSets& graph, const Scene& scene, const View& view,
                  const ShortestPath& found, double most) {
  constexpr int kWidths = 20;
  std::array<std::string, kWidths + 1> lines;
  const std::vector<const Edge*> edges = graph.Edges();
  for (std::size_t e = 0; e < found.relaxed_flow.size(); ++e) {
    const double flow = found.relaxed_flow[e];
    if (!(flow >= kLeastFlow)) continue;
    const auto [from, to] = Ends(*edges[e], flow, scene, found);
    if (!from.allFinite() || !to.allFinite()) continue;
    const double step = std::ceil(std::min(flow, 1.0) * kWidths - kLeastFlow);
    std::string& data = lines[static_cast<std::size_t>(std::max(step, 1.0))];
    view.Append('M', from, data);
    view.Append('L', to, data);
  }
  std::string svg;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    if (lines[k].empty()) continue;
    const double width = most * static_cast<double>(k) / kWidths;
    svg +=
        fmt::format("<path class=\"f\" stroke-width=\"{}\" d=\"{}\"/>\n", Tenths(width), lines[k]);
  }
  return svg;
}

std::string Path(const ShortestPath& found, int num_vertices, const View& view) {
  if (found.points.empty()) return "";
  const double radius = view.Fitting(kDot, num_vertices);
  const char* kind = radius < kDot ? "e" : "d";  // a small dot has no room for a ring
  std::string line;
  std::string dots;
  for (const Eigen::VectorXd& x : found.points) {
    const Vector2d p = Shadow(x);
    if (!p.allFinite()) continue;
    view.Append(line.empty() ? 'M' : 'L', p, line);
    const Vector2d at = view(p);
    dots += fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", kind, Tenths(at[0]),
                        Tenths(at[1]), Tenths(radius));
  }
  return fmt::format("<path class=\"p\" stroke-width=\"{}\" d=\"{}\"/>\n{}\n",
                     Tenths(view.Fitting(kPathWidth, num_vertices)), line, dots);
}

std::string Circle(const Vector2d& at) {
  return fmt::format("<circle class=\"a\" cx=\"{}\" cy=\"{}\" r=\"7\"/>", Tenths(at[0]),
                     Tenths(at[1]));
}

std::string Square(const Vector2d& at) {
  constexpr double kHalf = 6.5;
  return fmt::format("<rect class=\"b\" x=\"{}\" y=\"{}\" width=\"13\" height=\"13\"/>",
                     Tenths(at[0] - kHalf), Tenths(at[1] - kHalf));
}

/// At the ends of the path, in the middles of their sets where there is none.
std::string EndMarks(const GraphProblem& problem, const Scene& scene, const View& view,
                     const ShortestPath& found) {
  const bool path = !found.points.empty();
  const Vector2d from =
      path ? Shadow(found.points.front()) : scene.outlines.at(problem.source).Center();
  const Vector2d to =
      path ? Shadow(found.points.back()) : scene.outlines.at(problem.target).Center();
  std::string svg;
  if (from.allFinite()) svg += Circle(view(from));
  if (to.allFinite()) svg += Square(view(to));
  return svg + "\n";
}

std::string Numbers(const ShortestPath& found) {
  const MathematicalProgramResult& r = found.result;
  std::string text(to_string(r.termination));
  const auto add = [&](const char* name, double value, int digits = 6) {
    if (std::isfinite(value)) text += fmt::format("  ·  {} {:.{}g}", name, value, digits);
  };
  if (!found.points.empty()) add("cost", r.objective);
  add("bound", r.bound);
  if (!found.points.empty()) add("gap", r.gap(), 2);
  add("relaxation", found.relaxation_cost);
  return text;
}

/// Who answered, or why nobody was asked.
std::string Backend(const ShortestPath& found) {
  if (found.result.solver.empty()) return found.result.message;
  std::string text = "by " + found.result.solver;
  for (const std::string& one : found.subsolvers) text += ", " + one;
  return text;
}

/// Lines of text below the drawing, and a key to its marks.
std::string Legend(const GraphProblem& problem, const Scene& scene, const ShortestPath& found,
                   double flow_width, double top) {
  double y = top;
  std::string svg;
  const auto line = [&](const std::string& text, const char* kind = "") {
    svg += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", kMargin, Tenths(y), kind,
                       Escaped(text));
    y += kLine;
  };
  line(fmt::format("{}  ({} vertices, {} edges)", problem.name, problem.graph->num_vertices(),
                   problem.graph->num_edges()),
       " class=\"t\"");
  line(Numbers(found));
  line(Backend(found));
  double x = kMargin + 7;
  const auto key = [&](const std::string& mark, const char* text, double width) {
    svg += mark + fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x + 16, Tenths(y), text);
    x += width;
  };
  const Vector2d raise(0, -4.5);
  key(Circle(Vector2d(x, y) + raise), "source", 90);
  key(Square(Vector2d(x, y) + raise), "target", 90);
  const auto dash = [&](const char* style) {
    return fmt::format("<path {} d=\"M{} {}h18\"/>", style, x - 10, Tenths(y - 4.5));
  };
  if (!found.points.empty()) key(dash("class=\"p\" stroke-width=\"3\""), "path", 75);
  if (!found.relaxed_flow.empty()) {
    const std::string flow = fmt::format("class=\"f\" stroke-width=\"{}\"", Tenths(flow_width));
    const char* text = found.points.empty()
                           ? "relaxed flow, its points; so wide for 1"
                           : "relaxed flow, from middle to middle of the sets; so wide for 1";
    key(dash(flow.c_str()), text, 0);
  }
  y += kLine;
  const bool plane =
      std::max(problem.source->ambient_dimension(), problem.target->ambient_dimension()) <= 2;
  if (!plane) line("drawn: the first two coordinates");
  if (!scene.exact) line("sets are drawn by a box that holds their first two coordinates");
  return svg;
}

}  // namespace

std::string Picture(const GraphProblem& problem, const ShortestPath& found) {
  const Scene scene = Compose(*problem.graph, found);
  const View view(scene.frame);
  constexpr double kLegendLines = 6;
  const double width = std::max(view.size()[0], kLegendWidth) + 2 * kMargin;
  const double top = 2 * kMargin + view.size()[1] + kLine / 2;
  const double height = top + kLegendLines * kLine;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<style>{2}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height, kStyle);
  const double flow_width = view.Fitting(kFlowWidth, problem.graph->num_vertices());
  svg += Sets(*problem.graph, scene, view);
  svg += Flows(*problem.graph, scene, view, found, flow_width);
  svg += Path(found, problem.graph->num_vertices(), view);
  svg += EndMarks(problem, scene, view, found);
  return svg + "<g>\n" + Legend(problem, scene, found, flow_width, top) + "</g>\n</svg>\n";
}

void WritePicture(const GraphProblem& problem, const ShortestPath& found, const std::string& path) {
  const std::string svg = Picture(problem, found);
  if (path == "-") {
    std::cout << svg << std::flush;
    return;
  }
  std::ofstream out(path);
  out << svg;
  out.close();
  Require(!out.fail(), "--picture ", path, ": the file cannot be written");
}

}  // namespace switchyard::cli
