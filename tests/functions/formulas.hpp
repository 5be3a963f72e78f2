// tests/functions/formulas.hpp - operations with their derivatives, written another way than core
// writes them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "switchyard/functions/tape.hpp"

namespace switchyard {

// value, first by a and b, second by aa, ab, bb
using Formula = std::array<double, 6> (*)(double a, double b);

struct OpFormula {
  const char* name;
  Op op;
  double lower;  // operands where it is smooth
  double upper;
  Formula formula;
};

inline const std::vector<OpFormula> kFormulas = {
    {"Add", Op::kAdd, -3, 3,
     [](double a, double b) { return std::array{a + b, 1.0, 1.0, 0.0, 0.0, 0.0}; }},
    {"Subtract", Op::kSubtract, -3, 3,
     [](double a, double b) { return std::array{a - b, 1.0, -1.0, 0.0, 0.0, 0.0}; }},
    {"Multiply", Op::kMultiply, -3, 3,
     [](double a, double b) { return std::array{a * b, b, a, 0.0, 1.0, 0.0}; }},
    {"Divide", Op::kDivide, 0.5, 3,
     [](double a, double b) {
       return std::array{a / b, 1 / b, -a / (b * b), 0.0, -1 / (b * b), 2 * a / (b * b * b)};
     }},
    {"Negate", Op::kNegate, -3, 3,
     [](double a, double) { return std::array{-a, -1.0, 0.0, 0.0, 0.0, 0.0}; }},
    {"Sqrt", Op::kSqrt, 0.1, 3,
     [](double a, double) {
       return std::array{std::sqrt(a), 0.5 * std::pow(a, -0.5), 0.0, -0.25 * std::pow(a, -1.5), 0.0,
                         0.0};
     }},
    {"Exp", Op::kExp, -3, 3,
     [](double a, double) {
       return std::array{std::exp(a), std::exp(a), 0.0, std::exp(a), 0.0, 0.0};
     }},
    {"Log", Op::kLog, 0.1, 3,
     [](double a, double) {
       return std::array{std::log(a), 1 / a, 0.0, -std::pow(a, -2), 0.0, 0.0};
     }},
    {"Sin", Op::kSin, -3, 3,
     [](double a, double) {
       return std::array{std::sin(a), std::cos(a), 0.0, -std::sin(a), 0.0, 0.0};
     }},
    {"Cos", Op::kCos, -3, 3,
     [](double a, double) {
       return std::array{std::cos(a), -std::sin(a), 0.0, -std::cos(a), 0.0, 0.0};
     }},
    {"Tan", Op::kTan, -1.2, 1.2,
     [](double a, double) {
       const double c = std::cos(a);
       return std::array{std::tan(a), 1 / (c * c), 0.0, 2 * std::sin(a) / (c * c * c), 0.0, 0.0};
     }},
    {"Asin", Op::kAsin, -0.9, 0.9,
     [](double a, double) {
       const double r = 1 - a * a;
       return std::array{std::asin(a), std::pow(r, -0.5), 0.0, a * std::pow(r, -1.5), 0.0, 0.0};
     }},
    {"Acos", Op::kAcos, -0.9, 0.9,
     [](double a, double) {
       const double r = 1 - a * a;
       return std::array{std::acos(a), -std::pow(r, -0.5), 0.0, -a * std::pow(r, -1.5), 0.0, 0.0};
     }},
    {"Atan", Op::kAtan, -3, 3,
     [](double a, double) {
       const double r = 1 + a * a;
       return std::array{std::atan(a), 1 / r, 0.0, -2 * a / (r * r), 0.0, 0.0};
     }},
    {"Sinh", Op::kSinh, -3, 3,
     [](double a, double) {
       return std::array{std::sinh(a), std::cosh(a), 0.0, std::sinh(a), 0.0, 0.0};
     }},
    {"Cosh", Op::kCosh, -3, 3,
     [](double a, double) {
       return std::array{std::cosh(a), std::sinh(a), 0.0, std::cosh(a), 0.0, 0.0};
     }},
    {"Tanh", Op::kTanh, -3, 3,
     [](double a, double) {
       const double t = std::tanh(a);
       return std::array{t, 1 - t * t, 0.0, -2 * t * (1 - t * t), 0.0, 0.0};
     }},
    {"Abs", Op::kAbs, -3, 3,
     [](double a, double) {
       return std::array{std::abs(a), std::copysign(1.0, a), 0.0, 0.0, 0.0, 0.0};
     }},
    {"Floor", Op::kFloor, 1.1, 1.9,
     [](double a, double) { return std::array{std::floor(a), 0.0, 0.0, 0.0, 0.0, 0.0}; }},
    {"Ceil", Op::kCeil, 1.1, 1.9,
     [](double a, double) { return std::array{std::ceil(a), 0.0, 0.0, 0.0, 0.0, 0.0}; }},
    {"Power", Op::kPower, 0.3, 3,
     [](double a, double b) {
       const double l = std::log(a);
       const double v = std::exp(b * l);
       return std::array{v,        v * b / a, v * l, v * b * (b - 1) / (a * a), v / a * (1 + b * l),
                         v * l * l};
     }},
    {"Atan2", Op::kAtan2, 0.3, 3,
     [](double a, double b) {
       const double r = a * a + b * b;
       return std::array{
           std::atan2(a, b),   b / r, -a / r, -2 * a * b / (r * r), (a * a - b * b) / (r * r),
           2 * a * b / (r * r)};
     }},
    {"Min", Op::kMin, -3, 3,
     [](double a, double b) {
       return std::array{std::min(a, b), a < b ? 1.0 : 0.0, a < b ? 0.0 : 1.0, 0.0, 0.0, 0.0};
     }},
    {"Max", Op::kMax, -3, 3,
     [](double a, double b) {
       return std::array{std::max(a, b), a > b ? 1.0 : 0.0, a > b ? 0.0 : 1.0, 0.0, 0.0, 0.0};
     }},
};

}  // namespace switchyard
