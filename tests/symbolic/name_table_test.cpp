#include "switchyard/symbolic/name_table.hpp"

#include "switchyard/symbolic/variable_names.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

void Add(NameBlock block, NameTable* names) {
  names->Add(std::make_shared<const NameBlock>(std::move(block)));
}

TEST(NameTable, NamesAVectorByItsIndexAndASingleThingByItsBase) {
  NameTable names;
  Add(NameBlock::Shaped("x", 3, 0), &names);
  Add(NameBlock::Shaped("t", 1, 0), &names);
  EXPECT_EQ(names.size(), 4);
  EXPECT_EQ(names.Name(2), "x(2)");
  EXPECT_EQ(names.Name(3), "t");
}

TEST(NameTable, NamesAMatrixColumnByColumn) {
  NameTable names;
  Add(NameBlock::Shaped("X", 2, 3), &names);
  EXPECT_EQ(names.Name(1), "X(1,0)");
  EXPECT_EQ(names.Name(4), "X(0,2)");
}

TEST(NameTable, NamesTheLowerTriangleOfASymmetricMatrixColumnByColumn) {
  for (const int n : {1, 2, 3, 7, 50}) {
    NameTable names;
    Add(NameBlock::Shaped("before", 5, 0), &names);
    Add(NameBlock::Symmetric("S", n), &names);
    int place = 5;
    for (int j = 0; j < n; ++j) {
      for (int i = j; i < n; ++i) EXPECT_EQ(names.Name(place++), Text("S(", i, ",", j, ")"));
    }
    EXPECT_EQ(names.size(), place);
  }
}

TEST(NameTable, FindsTheEndsOfAVeryLargeTriangle) {
  NameTable names;
  Add(NameBlock::Symmetric("S", 60000), &names);
  EXPECT_EQ(names.Name(0), "S(0,0)");
  EXPECT_EQ(names.Name(59999), "S(59999,0)");
  EXPECT_EQ(names.Name(60000), "S(1,1)");
  EXPECT_EQ(names.Name(names.size() - 1), "S(59999,59999)");
}

TEST(NameTable, GivesListedNamesAsTheyCame) {
  NameTable names;
  Add(NameBlock::Listed({}), &names);
  Add(NameBlock::Listed({"COL 1", "", "x"}), &names);
  EXPECT_EQ(names.Name(0), "COL 1");
  EXPECT_EQ(names.Name(2), "x");
}

TEST(NameTable, SaysWhichNameItDoesNotHave) {
  NameTable names;
  Add(NameBlock::Shaped("x", 3, 0), &names);
  EXPECT_EQ(Said([&] { (void)names.Name(3); }), "name 3: there are 3");
  EXPECT_EQ(Said([&] { (void)names.Name(-1); }), "name -1: there are 3");
}

}  // namespace
}  // namespace switchyard
