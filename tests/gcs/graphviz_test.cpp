// The drawing is a sentence of the DOT language, whatever things are called.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

/// What stands in "digraph id { id [a="...", b=c]; id -> id [...]; }".
struct Drawing {
  using Attributes = std::map<std::string, std::string>;
  std::map<std::string, Attributes> nodes;
  struct Arrow {
    std::string tail, head;
    Attributes attributes;
  };
  std::vector<Arrow> arrows;
};

class DotParser {
 public:
  explicit DotParser(const std::string& text) : text_(text) {}

  /// None where the text is not of the language.
  std::optional<Drawing> Parse() {
    Drawing drawing;
    if (Word() != "digraph" || Word().empty() || !Take("{")) return std::nullopt;
    while (!Take("}")) {
      const std::string tail = Word();
      const bool arrow = Take("->");
      const std::string head = arrow ? Word() : "";
      Drawing::Attributes attributes;
      if (tail.empty() || (arrow && head.empty()) || !List(attributes) || !Take(";")) {
        return std::nullopt;
      }
      if (arrow) {
        drawing.arrows.push_back({tail, head, attributes});
      } else {
        drawing.nodes[tail] = attributes;
      }
    }
    Skip();
    return at_ == text_.size() ? std::optional(drawing) : std::nullopt;
  }

 private:
  void Skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool Take(const std::string& token) {
    Skip();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  /// A name, a number, or a text in quotes with the label's escapes undone; "" is none.
  std::string Word() {
    Skip();
    std::string word;
    if (at_ < text_.size() && text_[at_] == '"') {
      for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
        if (text_[at_] == '\\') {
          ++at_;
          word += text_[at_] == 'n' ? '\n' : text_[at_];
        } else if (text_.compare(at_, 5, "&amp;") == 0) {
          word += '&';
          at_ += 4;
        } else {
          word += text_[at_];
        }
      }
      if (at_ >= text_.size()) return "";
      ++at_;
      return word;
    }
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) {
      word += text_[at_++];
    }
    return word;
  }
  bool List(Drawing::Attributes& attributes) {
    if (!Take("[")) return false;
    do {
      const std::string name = Word();
      if (name.empty() || !Take("=")) return false;
      attributes[name] = Word();
    } while (Take(","));
    return Take("]");
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

Drawing Parsed(const std::string& text) {
  auto drawing = DotParser(text).Parse();
  EXPECT_TRUE(drawing.has_value()) << text;
  return drawing.value_or(Drawing());
}

struct Two {
  explicit Two(const std::string& tail = "u", const std::string& edge = "")
      : u(graph.AddVertex(Point(Eigen::Vector2d(1, 2)), tail)),
        v(graph.AddVertex(Point(Eigen::Vector2d(3, 4)), "v")),
        e(graph.AddEdge(u, v, edge)) {}
  GraphOfConvexSets graph;
  Vertex* u;
  Vertex* v;
  Edge* e;

  [[nodiscard]] MathematicalProgramResult Half() const {
    std::vector<Variable> variables(u->x().begin(), u->x().end());
    variables.insert(variables.end(), v->x().begin(), v->x().end());
    for (int i = 0; i < 5; ++i) variables.emplace_back(e->phi().get_id() + i);
    variables.insert(variables.end(), e->slacks().begin(), e->slacks().end());
    Eigen::VectorXd x(static_cast<Eigen::Index>(variables.size()));
    x.setConstant(0.125);
    x.head(9) << 1, 2, 3, 4, 0.5, 0.5, 1, 1.5, 2;
    MathematicalProgramResult result;
    result.SetPoint(variables, x);
    return result;
  }
};

TEST(Graphviz, DrawsEachVertexAndEdge) {
  Grid grid(3, EdgeCost::kL2, 1);
  Edge* parallel = grid.graph.AddEdge(grid.vertices[0], grid.vertices[1], "parallel");
  grid.graph.AddEdge(grid.vertices[2], grid.vertices[2], "loop");
  grid.graph.RemoveVertex(grid.vertices[4]);
  const Drawing drawing = Parsed(grid.graph.GetGraphvizString());
  EXPECT_EQ(drawing.nodes.size(), 8u);
  ASSERT_EQ(drawing.arrows.size(), static_cast<std::size_t>(grid.graph.num_edges()));
  const auto edges = grid.graph.Edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    EXPECT_EQ(drawing.arrows[k].attributes.at("label"), edges[k]->name());
    EXPECT_EQ(drawing.nodes.at(drawing.arrows[k].tail).at("label"), edges[k]->u().name());
    EXPECT_EQ(drawing.nodes.at(drawing.arrows[k].head).at("label"), edges[k]->v().name());
  }
  EXPECT_EQ(drawing.arrows[edges.size() - 2].attributes.at("label"), parallel->name());
}

TEST(Graphviz, IsValidForAnyNames) {
  for (const std::string name :
       {"\"", "\\", "\\\"", "a\nb", "]; x -> y [", "&lt;", "\\N", "<b>", "ü → β", "//", "end\\"}) {
    const Two two(name, name);
    const Drawing drawing = Parsed(two.graph.GetGraphvizString());
    ASSERT_EQ(drawing.nodes.size(), 2u) << name;
    EXPECT_EQ(drawing.nodes.at("v0").at("label"), name);
    EXPECT_EQ(drawing.arrows.at(0).attributes.at("label"), name);
  }
  const Two control("a\tb\x01");
  EXPECT_EQ(Parsed(control.graph.GetGraphvizString()).nodes.at("v0").at("label"), "a b ");
}

TEST(Graphviz, ShowsWhatTheOptionsSay) {
  Two two;
  two.e->NewSlackVariables(1);
  two.e->AddCost(3);
  two.u->AddCost(two.u->x()[1]);
  const MathematicalProgramResult half = two.Half();
  const auto label = [&](const GcsGraphvizOptions& options) {
    const Drawing drawing = Parsed(two.graph.GetGraphvizString(&half, options));
    return std::pair(drawing.nodes.at("v0").at("label"),
                     drawing.arrows.at(0).attributes.at("label"));
  };
  const auto all = label({});
  EXPECT_EQ(all.first, "u\nx = [1.000, 2.000]\ncost = 1.000");
  EXPECT_EQ(all.second,
            "(u, v)\nphi = 0.500\nphi xu = [0.500, 1.000]\nphi xv = [1.500, 2.000]\n"
            "phi s = [0.125]\ncost = 1.500");
  const auto none = label({false, false, false, false});
  EXPECT_EQ(none.first, "u");
  EXPECT_EQ(none.second, "(u, v)");
  EXPECT_EQ(label({false, false, true, false, true, 1}).second, "(u, v)\nphi = 5.0e-01");
  EXPECT_EQ(label({false, true, false, false, false, 0}).first, "u\nx = [1, 2]");
  EXPECT_EQ(label({true, false, false, false}).second, "(u, v)\nphi s = [0.125]");
}

TEST(Graphviz, ShadesFlowsAndMarksThePath) {
  Two two;
  const MathematicalProgramResult half = two.Half();
  EXPECT_EQ(Parsed(two.graph.GetGraphvizString()).arrows[0].attributes.count("color"), 0u);
  EXPECT_EQ(Parsed(two.graph.GetGraphvizString(&half)).arrows[0].attributes.at("color"),
            "#0000008c");  // 0.1 + 0.9 / 2 of 255
  const std::vector<const Edge*> path = {two.e};
  EXPECT_EQ(
      Parsed(two.graph.GetGraphvizString(nullptr, {}, &path)).arrows[0].attributes.at("color"),
      "red");
}

TEST(Graphviz, RefusesWhatItCannotDraw) {
  Two two;
  const Two other;
  const std::vector<const Edge*> path = {other.e};
  GcsGraphvizOptions options;
  options.precision = 18;
  EXPECT_THROW((void)two.graph.GetGraphvizString(nullptr, {}, &path), InvalidArgument);
  EXPECT_THROW((void)two.graph.GetGraphvizString(nullptr, options), InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
