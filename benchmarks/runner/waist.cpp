// What the waist costs: reading, building, lowering and recovering beside the backend's own time,
// and an update of numbers beside the first load.
//
//   waist FILE BACKEND [FILE BACKEND ...]
//
// Each problem is solved three times in one session: at first, after all linear costs changed by a
// millionth, and after all variable bounds were widened; times are the medians of five sessions.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <vector>

#include "switchyard/io/read.hpp"
#include "switchyard/solve/solve.hpp"

namespace {

using namespace switchyard;

constexpr int kSessions = 5;

struct Sample {
  double read = 0;
  double lower = 0;
  double load = 0;
  double solve = 0;
  double recover = 0;
  double update_lower = 0;
  double update = 0;
};

void ScaleCosts(const MathematicalProgram& program) {
  for (const auto& binding : program.linear_costs()) {
    LinearCost& cost = *binding.evaluator();
    const Eigen::VectorXd a = cost.a() * (1 + 1e-6);
    cost.UpdateCoefficients(a, cost.b());
  }
}

Sample Measure(const std::string& file, const std::string& backend) {
  Sample s;
  const auto start = std::chrono::steady_clock::now();
  const auto program = ReadProgram(file);
  s.read = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  SolverSession session(*program, backend);
  const auto first = session.Solve();
  s.lower = first.seconds.lower;
  s.load = first.seconds.presolve;
  s.solve = first.seconds.solve;
  s.recover = first.seconds.recover;
  ScaleCosts(*program);
  const auto second = session.Solve();
  s.update_lower = second.seconds.lower;
  s.update = second.seconds.presolve;
  return s;
}

double Median(std::vector<Sample>& samples, double Sample::*field) {
  std::sort(samples.begin(), samples.end(),
            [&](const Sample& a, const Sample& b) { return a.*field < b.*field; });
  return samples[samples.size() / 2].*field;
}

}  // namespace

int main(int argc, char** argv) {
  std::cout << fmt::format("{:<16} {:<9} {:>8} {:>8} {:>8} {:>9} {:>8} {:>7} {:>8} {:>8}\n",
                           "milliseconds", "backend", "read", "lower", "load", "solve", "recover",
                           "waist%", "update", "of load");
  for (int i = 1; i + 1 < argc; i += 2) {
    std::vector<Sample> samples;
    for (int k = 0; k < kSessions; ++k) samples.push_back(Measure(argv[i], argv[i + 1]));
    const auto ms = [&](double Sample::*field) { return 1e3 * Median(samples, field); };
    const double waist = ms(&Sample::lower) + ms(&Sample::recover);
    const double backend = ms(&Sample::load) + ms(&Sample::solve);
    const double update = ms(&Sample::update_lower) + ms(&Sample::update);
    const double load = ms(&Sample::lower) + ms(&Sample::load);
    const std::string file = argv[i];
    std::cout << fmt::format(
        "{:<16} {:<9} {:8.2f} {:8.2f} {:8.2f} {:9.2f} {:8.2f} {:6.1f}% {:8.2f} {:7.2f}\n",
        file.substr(file.rfind('/') + 1).substr(0, 16), argv[i + 1], ms(&Sample::read),
        ms(&Sample::lower), ms(&Sample::load), ms(&Sample::solve), ms(&Sample::recover),
        100 * waist / backend, update, update / load);
  }
}
