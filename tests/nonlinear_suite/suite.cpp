#include "tests/nonlinear_suite/suite.hpp"

#include <set>

#include "switchyard/error.hpp"

namespace switchyard::testing {
namespace {

std::vector<KnownProgram> Joined() {
  std::vector<KnownProgram> all;
  std::set<std::string> names;
  for (auto part : {HockSchittkowskiOfFewVariables, HockSchittkowskiOfManyVariables, Classics,
                    AwkwardPrograms}) {
    for (KnownProgram& row : part()) {
      Require(names.insert(row.name).second, "two programs are called ", row.name);
      all.push_back(std::move(row));
    }
  }
  return all;
}

}  // namespace

const std::vector<KnownProgram>& Suite() {
  static const std::vector<KnownProgram> all = Joined();
  return all;
}

std::unique_ptr<MathematicalProgram> Make(const KnownProgram& row) {
  auto program = row.terms();
  program->set_name(row.name);
  program->SetInitialGuessForAllVariables(Eigen::Map<const Eigen::VectorXd>(
      row.start.data(), static_cast<Eigen::Index>(row.start.size())));
  return program;
}

}  // namespace switchyard::testing
