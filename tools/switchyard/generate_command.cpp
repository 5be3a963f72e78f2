#include <iostream>
#include <map>

#include <fmt/format.h>

#include "commands.hpp"
#include "generate.hpp"

namespace switchyard::cli {
namespace {

struct Family {
  GraphProblem (*make)(int size, std::uint64_t seed, StepCost cost);
  int size;  // unless given
  int least;
  int most;
  const char* of;
};

// The limits keep the numbers of vertices and edges within 32 bits, with room to spare.
const std::map<std::string, Family>& Families() {
  static const std::map<std::string, Family> families = {
      {"maze", {GenerateMaze, 20, 2, 5000, "cells along each side"}},
      {"building", {GenerateBuilding, 60, 2, 1000000, "rooms"}}};
  return families;
}

struct GenerateOptions {
  std::string family;
  std::uint64_t seed = 0;
  int size = 0;
  std::string cost = "length";
  std::string out;
};

void Generate(const GenerateOptions& options) {
  const Family& family = Families().at(options.family);
  const int size = options.size == 0 ? family.size : options.size;
  Require(size >= family.least && size <= family.most, "generate ", options.family,
          ": --size needs ", family.least, " to ", family.most, " ", family.of, ", got ", size);
  const StepCost cost = options.cost == "length" ? StepCost::kLength : StepCost::kLinear;
  const GraphProblem problem = family.make(size, options.seed, cost);
  WriteGraph(problem, options.out);
  std::cerr << fmt::format("{}: {} vertices, {} edges\n", problem.name,
                           problem.graph->num_vertices(), problem.graph->num_edges());
}

}  // namespace

void AddGenerateCommand(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("generate", "Make a graph of convex sets from a seed (gcs/1)");
  command->footer("Example: switchyard generate building --size 80 --seed 7 -o building.json");
  auto options = std::make_shared<GenerateOptions>();
  command->add_option("FAMILY", options->family, "maze or building")
      ->required()
      ->check(CLI::IsMember({"maze", "building"}));
  command->add_option("--seed", options->seed,
                      "The same seed makes the same file on every machine (default 0)");
  command
      ->add_option("--size", options->size,
                   "Cells along each side of a maze (default 20), rooms of a building (60)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--cost", options->cost,
                   "length: Euclidean (default); linear: the sum of steps along the axes, which "
                   "linear programs hold")
      ->check(CLI::IsMember({"length", "linear"}));
  command->add_option("-o,--output", options->out, "The file to write; - is standard output")
      ->required();
  command->callback([options, &code] {
    Generate(*options);
    code = kAnswered;
  });
}

}  // namespace switchyard::cli
