// Continuous convex problems by several backends, side by side in one run: times of the backends
// alone, answers judged here.
//
//   side_by_side INSTANCES SET[,SET] BACKEND[,BACKEND] [--repeat N] [--only TEXT[,TEXT]]
//                [--skip TEXT[,TEXT]] [--tolerance T] [--time-limit S] [--threads N] [--memory]
//                [--csv FILE]
//
// SET is a class of reference.csv (lp, qp, socp); or gcs: then the problem is the convex relaxation
// that relax-and-round gives to the backend underneath it; or known: semidefinite, exponential and
// power programs made around a known optimum. BACKEND is a name, or NAME/no-hints:
// then the problem comes without its hints. The first backend is the peer that ratios are of.
//
// The backends take turns, and each time is the least of N; a time is that of load and solve within
// the backend, without the host's bridges. Residuals are recomputed on the problem as it stood
// before the bridges, each relative to 1 + the largest term that meets in it. An answer counts as
// solved where all three are at most ten times the tolerance, or its certificate holds.
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "benchmarks/runner/judge.hpp"
#include "core/gcs/pruning.hpp"
#include "core/gcs/transcription.hpp"
#include "core/host/facade.hpp"
#include "core/lower/lowering.hpp"
#include "core/solve/check.hpp"
#include "core/solve/recovery.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/io/graph.hpp"
#include "switchyard/io/read.hpp"
#include "tests/support/known_answers.hpp"

namespace {

using namespace switchyard;
using benchmark::Judge;
using benchmark::Residuals;

struct Settings {
  std::filesystem::path instances;
  std::vector<std::string> sets, backends, only, skip;
  int repeat = 1;
  int threads = 1;
  double tolerance = 1e-8;
  double time_limit = 300;
  bool memory = false;
  std::string csv;
};

/// A problem, and what keeps it in place.
struct Loaded {
  std::unique_ptr<MathematicalProgram> program;
  std::unique_ptr<Lowering> lowering;
  GraphProblem graph;
  PrunedGraph pruned;
  std::unique_ptr<GcsTranscription> transcription;
  std::unique_ptr<rounding::PathProblem> paths;
  std::unique_ptr<Problem> known;
  sy_problem view{};
};

struct KnownShape {
  const char* name;
  sy_cone cone;
  int count, vars, rows;
  double density;
};
constexpr KnownShape kKnown[] = {
    {"psd_order_8", {SY_CONE_PSD, 36, 0}, 4, 40, 20, 0.2},
    {"psd_order_10_many", {SY_CONE_PSD, 55, 0}, 20, 300, 100, 0.03},
    {"psd_order_20", {SY_CONE_PSD, 210, 0}, 2, 100, 40, 0.1},
    {"psd_order_30", {SY_CONE_PSD, 465, 0}, 1, 200, 80, 0.05},
    {"exponential_20", {SY_CONE_EXPONENTIAL, 3, 0}, 20, 40, 20, 0.2},
    {"exponential_200", {SY_CONE_EXPONENTIAL, 3, 0}, 200, 300, 100, 0.02},
    {"exponential_2000", {SY_CONE_EXPONENTIAL, 3, 0}, 2000, 3000, 1000, 0.001},
    {"exponential_dense", {SY_CONE_EXPONENTIAL, 3, 0}, 300, 40, 10, 0.5},
    {"power_20", {SY_CONE_POWER, 3, 0.3}, 20, 40, 20, 0.2},
    {"power_200", {SY_CONE_POWER, 3, 0.6}, 200, 300, 100, 0.02},
    {"power_2000", {SY_CONE_POWER, 3, 0.5}, 2000, 3000, 1000, 0.001},
};

std::unique_ptr<Problem> MakeKnown(const std::string& name) {
  for (const KnownShape& k : kKnown) {
    if (name != k.name) continue;
    testing::Random random(17);
    testing::Shape shape;
    shape.vars = k.vars;
    shape.rows = k.rows;
    shape.cones.assign(static_cast<std::size_t>(k.count), k.cone);
    shape.density = k.density;
    return std::make_unique<Problem>(testing::KnownOptimum(shape, random).problem);
  }
  return nullptr;
}

std::unique_ptr<Loaded> Load(const std::string& set, const std::string& file) {
  auto loaded = std::make_unique<Loaded>();
  if (set == "known") {
    loaded->known = MakeKnown(file);
    loaded->view = loaded->known->view();
    return loaded;
  }
  if (set == "gcs") {
    loaded->graph = ReadGraph(file);
    const GraphProblem& g = loaded->graph;
    loaded->pruned = Prune(*g.graph, *g.source, *g.target, true);
    loaded->transcription = std::make_unique<GcsTranscription>(
        loaded->pruned, GraphOfConvexSets::Transcription::kRelaxation);
    loaded->paths =
        std::make_unique<rounding::PathProblem>(loaded->transcription->problem().view());
    loaded->view = loaded->paths->relaxation();
  } else {
    loaded->program = ReadProgram(file);
    loaded->lowering = std::make_unique<Lowering>(*loaded->program);
    loaded->view = loaded->lowering->problem().view();
  }
  return loaded;
}

struct Answer {
  sy_termination termination = SY_NOT_SOLVED;
  Residuals residuals;
  bool certified = false;
  double load = 0, solve = 0;
  std::int64_t iterations = 0;
  std::string text;
  long kilobytes = 0;
  [[nodiscard]] bool Solved(double tolerance) const {
    if (termination == SY_INFEASIBLE || termination == SY_UNBOUNDED) return certified;
    return termination == SY_OPTIMAL && residuals.Worst() <= 10 * tolerance;
  }
  [[nodiscard]] double seconds() const { return load + solve; }
};

Answer SolveOnce(Host& host, const std::string& backend, const Loaded& loaded,
                 const Settings& settings) {
  const std::size_t slash = backend.find('/');
  const Backend* found = host.Find(backend.substr(0, slash));
  if (found == nullptr) throw InvalidArgument("no backend " + backend);
  sy_problem problem = loaded.view;
  if (slash != std::string::npos) problem.hints = nullptr;
  Answer answer;
  AnswerBuffers buffers{ProblemData(problem)};
  try {
    Instance instance(*host.Facade(*found), *host.table());
    instance.Load(problem, 0);
    answer.load = ServiceOf(instance).backend_seconds(instance.get());
    sy_control control{};
    control.size = sizeof control;
    control.threads = settings.threads;
    control.seconds = settings.time_limit;
    control.iterations = control.nodes = std::numeric_limits<std::int64_t>::max();
    control.cutoff = kInfinity;
    control.target = -kInfinity;
    control.feasibility = control.optimality = settings.tolerance;
    control.integrality = control.absolute_gap = control.relative_gap = std::nan("");
    instance.Solve(control, buffers.raw);
    answer.solve = ServiceOf(instance).backend_seconds(instance.get()) - answer.load;
  } catch (const BackendError& e) {
    answer.text = e.what();
    answer.residuals.primal = kInfinity;
    return answer;
  }
  answer.termination = buffers.raw.termination;
  answer.iterations = buffers.raw.iterations;
  answer.text = buffers.text.data();
  answer.residuals = Judge(problem, buffers.vectors);
  if (answer.termination == SY_INFEASIBLE) {
    answer.certified = ProvesInfeasible(problem, buffers.vectors);
  } else if (answer.termination == SY_UNBOUNDED) {
    answer.certified = IsUnboundedRay(problem, buffers.vectors);
  }
  return answer;
}

/// What a solve adds to the memory of a process of its own.
long MemoryOf(Host& host, const std::string& backend, const Loaded& loaded,
              const Settings& settings) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  malloc_trim(0);  // what is free here would be had without asking
  const pid_t child = fork();
  if (child == 0) {
    const auto high_water = [] {
      std::ifstream status("/proc/self/status");
      for (std::string word; status >> word;) {
        long kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) return kilobytes;
      }
      return 0L;
    };
    std::ofstream("/proc/self/clear_refs") << 5;
    const long before = high_water();
    SolveOnce(host, backend, loaded, settings);
    const long added = high_water() - before;
    const auto written = write(ends[1], &added, sizeof added);
    _exit(written == sizeof added ? 0 : 1);
  }
  close(ends[1]);
  long added = 0;
  if (read(ends[0], &added, sizeof added) != sizeof added) added = 0;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return added;
}

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

struct Instances {
  std::string set, name, file;
};

std::vector<Instances> Listed(const Settings& settings) {
  std::vector<Instances> list;
  for (const std::string& set : settings.sets) {
    std::set<std::filesystem::path> files;
    for (const KnownShape& k : kKnown) {
      if (set == "known") files.insert(k.name);
    }
    if (set != "known")
      for (const auto& entry : std::filesystem::directory_iterator(settings.instances / set)) {
        files.insert(entry.path());
      }
    for (const auto& path : files) {
      std::string name = path.filename().string();
      name = name.substr(0, name.find('.'));
      const auto in = [&](const std::vector<std::string>& texts) {
        return std::any_of(texts.begin(), texts.end(), [&](const std::string& t) {
          return t.back() == '$' ? name == t.substr(0, t.size() - 1)
                                 : name.find(t) != std::string::npos;
        });
      };
      if ((settings.only.empty() || in(settings.only)) && !in(settings.skip)) {
        list.push_back({set, name, path.string()});
      }
    }
  }
  return list;
}

const char* Word(sy_termination t) {
  constexpr std::array kWords = {"not solved", "optimal", "locally",   "infeasible",
                                 "unbounded",  "inf/unb", "local inf", "iterations",
                                 "time",       "nodes",   "cancelled", "trouble"};
  return t >= 0 && static_cast<std::size_t>(t) < kWords.size() ? kWords[std::size_t(t)] : "?";
}

/// exp(mean(log(t + shift))) - shift.
double ShiftedGeometricMean(const std::vector<double>& times, double shift) {
  double sum = 0;
  for (const double t : times) sum += std::log(t + shift);
  return std::exp(sum / static_cast<double>(times.size())) - shift;
}

class Table {
 public:
  explicit Table(const Settings& settings) : settings_(settings) {
    fmt::print("{:<26}{:<20}{:<11}{:>5}{:>9}{:>9}{:>9}{:>18}{:>10}{:>10}{:>8}\n", "instance",
               "backend", "ended", "iter", "primal", "dual", "gap", "objective", "load ms",
               "solve ms", "ratio");
    if (!settings.csv.empty()) {
      csv_.open(settings.csv);
      csv_ << "set,instance,backend,ended,solved,iterations,primal,dual,gap,objective,load_seconds,"
              "solve_seconds,kilobytes\n";
    }
  }

  void Add(const Instances& of, const std::vector<Answer>& answers) {
    for (std::size_t b = 0; b < answers.size(); ++b) {
      const Answer& a = answers[b];
      const bool solved = a.Solved(settings_.tolerance);
      const double ratio = a.seconds() / answers[0].seconds();
      fmt::print(
          "{:<26}{:<20}{:<11}{:>5}{:>9.1e}{:>9.1e}{:>9.1e}{:>18.10g}{:>10.2f}{:>10.2f}"
          "{:>8.2f}{}{}\n",
          of.name, settings_.backends[b], Word(a.termination), a.iterations, a.residuals.primal,
          a.residuals.dual, a.residuals.gap, a.residuals.objective, 1e3 * a.load, 1e3 * a.solve,
          ratio, settings_.memory ? fmt::format("{:>9} kB", a.kilobytes) : "",
          solved ? "" : "  NOT SOLVED " + a.text);
      Group& group = groups_[of.set];
      group.times.resize(answers.size());
      group.solved.resize(answers.size());
      group.memory.resize(answers.size());
      group.times[b].push_back(a.seconds());
      group.memory[b].push_back(static_cast<double>(a.kilobytes));
      group.solved[b] += solved ? 1 : 0;
      if (csv_.is_open()) {
        csv_ << fmt::format("{},{},{},{},{},{},{},{},{},{:.12g},{},{},{}\n", of.set, of.name,
                            settings_.backends[b], Word(a.termination), solved ? 1 : 0,
                            a.iterations, a.residuals.primal, a.residuals.dual, a.residuals.gap,
                            a.residuals.objective, a.load, a.solve, a.kilobytes);
        csv_.flush();
      }
    }
    std::fflush(stdout);
  }

  void Summary() const {
    constexpr double kShift = 1e-3;  // seconds
    fmt::print("\n{:<8}{:<20}{:>8}{:>20}{:>8}{:>10}\n", "set", "backend", "solved",
               "mean ms (1 ms)", "ratio", "memory");
    for (const auto& [set, group] : groups_) {
      const double peer = ShiftedGeometricMean(group.times[0], kShift);
      for (std::size_t b = 0; b < group.times.size(); ++b) {
        const double mean = ShiftedGeometricMean(group.times[b], kShift);
        const double memory = ShiftedGeometricMean(group.memory[b], 1000) /
                              ShiftedGeometricMean(group.memory[0], 1000);
        fmt::print("{:<8}{:<20}{:>4}/{:<3}{:>20.2f}{:>8.2f}{:>10.2f}\n", set, settings_.backends[b],
                   group.solved[b], group.times[b].size(), 1e3 * mean, mean / peer, memory);
      }
    }
  }

 private:
  struct Group {
    std::vector<std::vector<double>> times, memory;
    std::vector<int> solved;
  };
  const Settings& settings_;
  std::ofstream csv_;
  std::map<std::string, Group> groups_;
};

Settings Parse(int argc, char** argv) {
  if (argc < 4) throw InvalidArgument("side_by_side INSTANCES SET[,SET] BACKEND[,BACKEND] ...");
  Settings s;
  s.instances = argv[1];
  s.sets = Split(argv[2]);
  s.backends = Split(argv[3]);
  for (int i = 4; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--memory") {
      s.memory = true;
      continue;
    }
    if (i + 1 >= argc) throw InvalidArgument(name + " needs a value");
    const std::string value = argv[++i];
    if (name == "--repeat")
      s.repeat = std::atoi(value.c_str());
    else if (name == "--threads")
      s.threads = std::atoi(value.c_str());
    else if (name == "--only")
      s.only = Split(value);
    else if (name == "--skip")
      s.skip = Split(value);
    else if (name == "--tolerance")
      s.tolerance = std::atof(value.c_str());
    else if (name == "--time-limit")
      s.time_limit = std::atof(value.c_str());
    else if (name == "--csv")
      s.csv = value;
    else
      throw InvalidArgument("there is no option " + name);
  }
  return s;
}

std::vector<Answer> Compare(Host& host, const Instances& of, const Settings& settings) {
  const auto loaded = Load(of.set, of.file);
  std::vector<Answer> best(settings.backends.size());
  for (int k = 0; k < settings.repeat; ++k) {
    for (std::size_t b = 0; b < best.size(); ++b) {
      const Answer answer = SolveOnce(host, settings.backends[b], *loaded, settings);
      if (k == 0 || answer.seconds() < best[b].seconds()) best[b] = answer;
    }
  }
  for (std::size_t b = 0; settings.memory && b < best.size(); ++b) {
    best[b].kilobytes = MemoryOf(host, settings.backends[b], *loaded, settings);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = Parse(argc, argv);
    HostOptions options;
    if (std::getenv("SWITCHYARD_PLUGIN_PATH") == nullptr) {
      options.folders = {std::string(SWITCHYARD_PLUGIN_FOLDER)};
    }
    Host host(options);
    Table table(settings);
    for (const Instances& of : Listed(settings)) {
      try {
        table.Add(of, Compare(host, of, settings));
      } catch (const InvalidArgument& e) {
        std::cerr << of.name << ": " << e.what() << "\n";
      }
    }
    table.Summary();
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 2;
  }
}
