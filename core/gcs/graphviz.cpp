// The graph in the DOT language.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <unordered_set>

#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

constexpr int kMostDigits = 17;

/// As a part of a label: a backslash and an ampersand would begin a name of something else there.
std::string Escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '\n') {
      out += "\\n";
    } else {
      out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

/// Labels, line by line, of what the options show.
class Labels {
 public:
  Labels(const MathematicalProgramResult* result, const GcsGraphvizOptions& options)
      : result_(result), options_(options) {}

  [[nodiscard]] std::string Of(const Vertex& v) const {
    std::string label = Escaped(v.name());
    if (result_ == nullptr) return label;
    const auto x = v.GetSolution(*result_);
    if (options_.show_vars && x.has_value()) label += Line("x", *x);
    const auto cost = v.GetSolutionCost(*result_);
    if (options_.show_costs && cost.has_value() && !v.costs().empty()) label += Line("cost", *cost);
    return label;
  }

  [[nodiscard]] std::string Of(const Edge& e) const {
    std::string label = Escaped(e.name());
    if (result_ == nullptr || !result_->Knows(e.phi())) return label;
    if (options_.show_flows) label += Line("phi", result_->GetSolution(e.phi()));
    if (options_.show_vars) {
      if (const auto y = e.GetSolutionPhiXu(*result_)) label += Line("phi xu", *y);
      if (const auto z = e.GetSolutionPhiXv(*result_)) label += Line("phi xv", *z);
    }
    if (options_.show_slacks && e.slacks().size() > 0 && result_->Knows(e.slacks()[0])) {
      label += Line("phi s", result_->GetSolution(e.slacks()));
    }
    const auto cost = e.GetSolutionCost(*result_);
    if (options_.show_costs && cost.has_value() && !e.costs().empty()) label += Line("cost", *cost);
    return label;
  }

 private:
  [[nodiscard]] std::string Number(double value) const {
    std::array<char, 512> text{};  // the largest number has 309 digits before the point
    std::snprintf(text.data(), text.size(), options_.scientific ? "%.*e" : "%.*f",
                  options_.precision, value);
    return text.data();
  }
  [[nodiscard]] std::string Line(const char* what, double value) const {
    return std::string("\\n") + what + " = " + Number(value);
  }
  [[nodiscard]] std::string Line(const char* what, const Eigen::VectorXd& values) const {
    std::string numbers;
    for (const double value : values) numbers += (numbers.empty() ? "" : ", ") + Number(value);
    return std::string("\\n") + what + " = [" + numbers + "]";
  }

  const MathematicalProgramResult* result_;
  const GcsGraphvizOptions& options_;
};

/// Black, the more transparent the less flows; never invisible.
std::string Shade(double phi) {
  constexpr double kFaintest = 0.1;
  const double opacity = kFaintest + (1 - kFaintest) * (phi > 0 ? std::min(phi, 1.0) : 0);
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "#000000%02x",
                static_cast<unsigned>(std::lround(255 * opacity)));
  return text.data();
}

}  // namespace

std::string GraphOfConvexSets::GetGraphvizString(
    const MathematicalProgramResult* result, const GcsGraphvizOptions& options,
    const std::vector<const Edge*>* active_path) const {
  Require(options.precision >= 0 && options.precision <= kMostDigits,
          "GetGraphvizString needs a precision in [0, ", kMostDigits, "], got ", options.precision);
  std::unordered_set<const Edge*> active;
  if (active_path != nullptr) active.insert(active_path->begin(), active_path->end());
  for (const Edge* edge : active) {
    Require(edge != nullptr, "GetGraphvizString needs edges of a path, got a null pointer");
    RequireValid(*edge, "GetGraphvizString");
  }
  const Labels labels(result, options);
  const auto node = [](const Vertex& v) { return "v" + std::to_string(v.id().value); };
  std::string text = "digraph GraphOfConvexSets {\n";
  for (const Vertex* v : Vertices()) {
    text += node(*v) + " [label=\"" + labels.Of(*v) + "\"];\n";
  }
  for (const Edge* e : Edges()) {
    text += node(e->u()) + " -> " + node(e->v()) + " [label=\"" + labels.Of(*e) + "\"";
    if (active.contains(e)) {
      text += ", color=\"red\", penwidth=2";
    } else if (options.show_flows && result != nullptr && result->Knows(e->phi())) {
      text += ", color=\"" + Shade(result->GetSolution(e->phi())) + "\"";
    }
    text += "];\n";
  }
  return text + "}\n";
}

}  // namespace switchyard
