// One front of every size: its elimination, what it leaves, and its part of a solve.
#include "solvers/linalg/dense_kernels.hpp"

#include <gtest/gtest.h>

#include "solvers/linalg/simd.hpp"
#include "tests/linalg/twofold_matrices.hpp"

namespace switchyard::linalg {
namespace {

/// [A B'; B C], A of the pivots, in a front's layout and in a dense one.
class OneFront {
 public:
  OneFront(Random& random, Index pivots, Index rows, Digits digits)
      : parts_(PartsOf(digits)),
        dense_(pivots + rows),
        sign_(RandomSigns(random, pivots + rows)),
        top_(pivots * RoundUp(pivots) * parts_),
        below_(pivots * RoundUp(rows) * parts_),
        update_(rows * RoundUp(rows) * parts_),
        work_(kWorkPerPivot * pivots),
        pivot_(pivots * parts_),
        inverse_(pivots * parts_),
        size_(pivots) {
    const Index n = pivots + rows;
    dense_ = SquareOf<Quad>(Quasidefinite(random, sign_, SparsePairs(random, n, 1)));
    front_ = {digits, pivots, rows, RoundUp(pivots), RoundUp(rows), top_.data(), below_.data()};
    for (Index j = 0; j < n; ++j) {
      for (Index i = j; i < n; ++i) {
        if (digits == Digits::kTwofold) dense_(i, j) *= 1 + Quad{1e-17} * random.Normal();
        dense_(i, j) = dense_(j, i) = Rounded(dense_(i, j));
        if (i < pivots) {
          Set(top_.data() + j * front_.top_stride * parts_, i, dense_(i, j));
        } else if (j < pivots) {
          Set(below_.data() + j * front_.below_stride * parts_, i - pivots, dense_(i, j));
        } else {
          Set(update_.data() + (j - pivots) * front_.below_stride * parts_, i - pivots,
              dense_(i, j));
        }
      }
      if (j < pivots) size_[j] = static_cast<double>(Abs(dense_(j, j)));
    }
  }

  int Eliminate() {
    const int raised = FactorFront(
        front_, {sign_.data(), size_.data(), pivot_.data(), inverse_.data()}, {}, work_.data());
    SubtractSquare(front_, pivot_.data(), update_.data(), work_.data());
    return raised;
  }

  /// A number's part of a front's digits.
  [[nodiscard]] Quad Rounded(Quad q) const {
    return parts_ == 2 ? Value(Split(q)) : Quad{static_cast<double>(q)};
  }
  [[nodiscard]] double rounding() const { return parts_ == 2 ? 1e-28 : 1e-12; }

  void Set(double* column, Index row, Quad q) const {
    const Twofold<double> v = Split(q);
    if (parts_ == 1) {
      column[row] = v.high;
    } else {
      column[row / kLanes * 2 * kLanes + row % kLanes] = v.high;
      column[row / kLanes * 2 * kLanes + row % kLanes + kLanes] = v.low;
    }
  }
  [[nodiscard]] Quad Get(const double* column, Index row) const {
    if (parts_ == 1) return column[row];
    const double* at = column + row / kLanes * 2 * kLanes + row % kLanes;
    return Quad{at[0]} + at[kLanes];
  }
  [[nodiscard]] Vector Column(const std::vector<Quad>& v) const {
    Vector column(RoundUp(v.size()) * static_cast<std::size_t>(parts_), 0.0);
    for (std::size_t i = 0; i < v.size(); ++i) Set(column.data(), static_cast<Index>(i), v[i]);
    return column;
  }
  [[nodiscard]] Quad Left(Index i, Index j) const {
    return Get(update_.data() + j * front_.below_stride * parts_, i);
  }
  [[nodiscard]] const Front& front() const { return front_; }
  [[nodiscard]] const Square<Quad>& dense() const { return dense_; }
  [[nodiscard]] const Signs& sign() const { return sign_; }
  [[nodiscard]] const double* pivot() const { return pivot_.data(); }
  [[nodiscard]] const double* inverse() const { return inverse_.data(); }
  [[nodiscard]] const std::vector<double>& size() const { return size_; }

 private:
  int parts_;
  Square<Quad> dense_;
  Signs sign_;
  Vector top_, below_, update_, work_, pivot_, inverse_;
  std::vector<double> size_;
  Front front_;
};

class Kernels : public ::testing::TestWithParam<Digits> {
 protected:
  /// Sizes on both sides of a vector and of the columns that are taken together.
  template <class Check>
  void ForSizes(Check&& check) {
    for (const Index pivots : {1, 2, 4, 5, 6, 7, 8, 9, 12, 13, 16, 17, 30}) {
      for (const Index rows : {0, 1, 3, 7, 8, 9, 16, 23}) {
        OneFront f(random_, pivots, rows, GetParam());
        ASSERT_EQ(f.Eliminate(), 0);
        check(f, pivots, rows);
      }
    }
  }
  Random random_{24};
};

TEST_P(Kernels, LeaveWhatADenseEliminationLeaves) {
  ForSizes([](const OneFront& f, Index pivots, Index rows) {
    const DenseLdl<Quad> whole(f.dense(), f.sign(), {});
    for (Index j = 0; j < rows; ++j) {
      for (Index i = j; i < rows; ++i) {
        Quad left = f.dense()(pivots + i, pivots + j), size = Abs(left);
        for (Index p = 0; p < pivots; ++p) {
          const Quad term = whole.l(pivots + i, p) * whole.l(pivots + j, p) * whole.pivot[p];
          left -= term;
          size += Abs(term);
        }
        EXPECT_LE(static_cast<double>(Abs(f.Left(i, j) - left)),
                  f.rounding() * static_cast<double>(size));
      }
    }
  });
}

TEST_P(Kernels, AddUpTheSizesOfThePivotsTerms) {
  ForSizes([](const OneFront& f, Index pivots, Index rows) {
    const DenseLdl<Quad> whole(f.dense(), f.sign(), {});
    Vector y(f.front().below_stride);
    SizesBelow(f.front(), f.pivot(), y.data());
    for (Index i = 0; i < pivots + rows; ++i) {
      double size = i < pivots ? static_cast<double>(Abs(f.dense()(i, i))) : 0;
      for (Index p = 0; p < std::min(i, pivots); ++p) {
        size += static_cast<double>(Abs(whole.l(i, p) * whole.l(i, p) * whole.pivot[p]));
      }
      EXPECT_NEAR(i < pivots ? f.size()[i] : y[i - pivots], size, 1e-12 * size);
    }
  });
}

// Forward: y = B A^-1 b. Backward: A x = b - B'y for any y.
TEST_P(Kernels, SolveForTheirOwnRows) {
  ForSizes([&](const OneFront& f, Index pivots, Index rows) {
    std::vector<Quad> b, y;
    for (const Quad q : RandomQuads(random_, pivots)) b.push_back(f.Rounded(q));
    for (const Quad q : RandomQuads(random_, rows)) y.push_back(f.Rounded(q));
    Vector x = f.Column(b), below = f.Column(y), image = f.Column(y);
    Square<Quad> a(pivots);
    for (Index i = 0; i < pivots; ++i) {
      for (Index j = 0; j < pivots; ++j) a(i, j) = f.dense()(i, j);
    }
    const DenseLdl<Quad> own(a, f.sign(), {});
    ForwardFront(f.front(), x.data(), image.data());
    BackwardFront(f.front(), f.inverse(), x.data(), below.data());
    const std::vector<Quad> alone = own.Solve(b);
    for (Index i = 0; i < rows; ++i) {
      Quad expected = 0;
      for (Index p = 0; p < pivots; ++p) expected += f.dense()(pivots + i, p) * alone[p];
      EXPECT_LE(static_cast<double>(Abs(f.Get(image.data(), i) - expected)), 100 * f.rounding());
      for (Index p = 0; p < pivots; ++p) b[p] -= f.dense()(pivots + i, p) * y[i];
    }
    const std::vector<Quad> expected = own.Solve(b);
    for (Index p = 0; p < pivots; ++p) {
      EXPECT_LE(static_cast<double>(Abs(f.Get(x.data(), p) - expected[p])), 100 * f.rounding());
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Every, Kernels, ::testing::Values(Digits::kPlain, Digits::kTwofold),
                         [](const auto& test) {
                           return test.param == Digits::kPlain ? "plain" : "twofold";
                         });

}  // namespace
}  // namespace switchyard::linalg
