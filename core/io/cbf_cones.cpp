#include "core/io/cbf_cones.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace switchyard::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kAnySize = std::numeric_limits<int>::max();

std::vector<CbfLink> Same(int size, double /*alpha*/) {
  std::vector<CbfLink> links(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) links[static_cast<std::size_t>(i)] = {i, i, 1};
  return links;
}

// CBF has 2 x_0 x_1 >= |x_2..|^2, the program z_0 z_1 >= |z_2..|^2: z_0 = 2 x_0, exactly.
std::vector<CbfLink> Rotated(int size, double alpha) {
  std::vector<CbfLink> links = Same(size, alpha);
  links[0].factor = 2;
  return links;
}

// The dual of x_0 >= x_1 exp(x_2 / x_1) is s_0 >= -s_2 exp(s_1 / s_2 - 1), s_2 <= 0: the cone
// itself at z = (s_0, -s_2, s_2 - s_1), as z_2 / z_1 = s_1 / s_2 - 1.
std::vector<CbfLink> DualExponential(int /*size*/, double /*alpha*/) {
  return {{0, 0, 1}, {1, 2, -1}, {2, 2, 1}, {2, 1, -1}};
}

// The dual of x_0^a x_1^(1-a) >= |x_2| is (s_0 / a)^a (s_1 / (1-a))^(1-a) >= |s_2|.
std::vector<CbfLink> DualPower(int /*size*/, double alpha) {
  return {{0, 0, 1 / alpha}, {1, 1, 1 / (1 - alpha)}, {2, 2, 1}};
}

using Variables = VectorXDecisionVariable;

void AddLorentz(MathematicalProgram* program, SparseMatrix A, const Eigen::VectorXd& b,
                double /*alpha*/, const Variables& x) {
  program->AddLorentzConeConstraint(std::move(A), b, x);
}
void AddRotated(MathematicalProgram* program, SparseMatrix A, const Eigen::VectorXd& b,
                double /*alpha*/, const Variables& x) {
  program->AddRotatedLorentzConeConstraint(std::move(A), b, x);
}
void AddExponential(MathematicalProgram* program, SparseMatrix A, const Eigen::VectorXd& b,
                    double /*alpha*/, const Variables& x) {
  program->AddExponentialConeConstraint(std::move(A), b, x);
}
void AddPower(MathematicalProgram* program, SparseMatrix A, const Eigen::VectorXd& b, double alpha,
              const Variables& x) {
  program->AddPowerConeConstraint(std::move(A), b, alpha, x);
}

}  // namespace

const std::array<CbfConeFacts, 10> kCbfCones = {{
    {"F", true, -kInfinity, kInfinity, 0, kAnySize, false, nullptr, nullptr},
    {"L+", true, 0, kInfinity, 0, kAnySize, false, nullptr, nullptr},
    {"L-", true, -kInfinity, 0, 0, kAnySize, false, nullptr, nullptr},
    {"L=", true, 0, 0, 0, kAnySize, false, nullptr, nullptr},
    {"Q", false, 0, 0, 1, kAnySize, false, Same, AddLorentz},
    {"QR", false, 0, 0, 2, kAnySize, false, Rotated, AddRotated},
    {"EXP", false, 0, 0, 3, 3, false, Same, AddExponential},
    {"EXP*", false, 0, 0, 3, 3, false, DualExponential, AddExponential},
    {"POW", false, 0, 0, 3, 3, true, Same, AddPower},
    {"POW*", false, 0, 0, 3, 3, true, DualPower, AddPower},
}};

const CbfConeFacts* FindCbfCone(std::string_view name) {
  const auto found = std::find_if(kCbfCones.begin(), kCbfCones.end(),
                                  [&](const CbfConeFacts& facts) { return facts.name == name; });
  return found == kCbfCones.end() ? nullptr : &*found;
}

}  // namespace switchyard::io
