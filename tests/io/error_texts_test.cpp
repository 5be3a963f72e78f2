// What readers say of files that are none, word for word.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "switchyard/io/read.hpp"

namespace switchyard::io {
namespace {

struct Case {
  std::string text;
  std::string said;
};

void ExpectSaid(const std::string& name, const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    try {
      ReadProgramText(c.text, name);
      ADD_FAILURE() << "was read, where this was to be said: " << c.said;
    } catch (const FileError& error) {
      EXPECT_EQ(error.what(), c.said);
      EXPECT_EQ(error.what(), Text(error.file(), ":", error.line(), ":", error.column(),
                                   ": expected ", error.expected(), ", got ", error.found()));
    }
  }
}

// A file of MPS with rows o (the objective), r, e and columns x, y, and these lines behind COLUMNS.
std::string Mps(const std::string& behind) {
  return "NAME\nROWS\n N o\n L r\n E e\nCOLUMNS\n x r 1\n y r 2\n" + behind;
}

TEST(ErrorTexts, OfMpsSections) {
  ExpectSaid(
      "a.mps",
      {
          {"", "a.mps:1:1: expected ENDATA, got the end of the file"},
          {Mps(""), "a.mps:9:1: expected ENDATA, got the end of the file"},
          {"hello\n",
           "a.mps:1:1: expected a section that is read here (NAME, OBJSENSE, OBJNAME, "
           "OBJECTIVE, ROWS, COLUMNS, RHS, RANGES, BOUNDS, QUADOBJ, QSECTION, QMATRIX, "
           "ENDATA), got \"hello\""},
          {Mps("ROWS\n"), "a.mps:9:1: expected one section ROWS, got another"},
          {"COLUMNS\n", "a.mps:1:1: expected the section ROWS before COLUMNS, got \"COLUMNS\""},
          {"ROWS\nBOUNDS\n",
           "a.mps:2:1: expected the section COLUMNS before BOUNDS, got \"BOUNDS\""},
          {" x r 1\n", "a.mps:1:2: expected the header of a section, got \"x r 1\""},
          {"OBJSENSE\n UP\n", "a.mps:2:2: expected MIN or MAX, got \"UP\""},
          {"OBJNAME c\nROWS\n N o\nCOLUMNS\n",
           "a.mps:1:9: expected the name of an N row, got \"c\""},
      });
}

TEST(ErrorTexts, OfMpsRowsAndColumns) {
  ExpectSaid(
      "a.mps",
      {
          {"ROWS\n X r\n", "a.mps:2:2: expected a type of row: N, L, G or E, got \"X\""},
          {"ROWS\n L\n", "a.mps:2:2: expected a type of row (N, L, G, E) and a name, got \"L\""},
          {"ROWS\n L r\n G r\n", "a.mps:3:4: expected a row that is new, got \"r\""},
          {Mps(" y q 3\n"), "a.mps:9:4: expected the name of a row, got \"q\""},
          {Mps(" y e 3x\n"), "a.mps:9:6: expected a number, got \"3x\""},
          {Mps(" y e nan\n"), "a.mps:9:6: expected a number, got \"nan\""},
          {Mps(" y e 1e999\n"),
           "a.mps:9:6: expected a number that a double can hold, got \"1e999\""},
          {Mps(" y r 3\n"), "a.mps:9:4: expected each row once in a column, got \"r\" again"},
          {Mps(" x e 3\n"),
           "a.mps:9:2: expected a column that is new, as its lines stand together, got \"x\""},
          {Mps(" y e\n"),
           "a.mps:9:2: expected a column, then one or two pairs of a row and a number, got \"y "
           "e\""},
          {Mps(" m 'MARKER' 'SOSORG'\n"),
           "a.mps:9:13: expected 'INTORG' or 'INTEND', got \"'SOSORG'\""},
      });
}

TEST(ErrorTexts, OfMpsSidesAndBounds) {
  ExpectSaid(
      "a.mps",
      {
          {Mps("RHS\n b q 1\n"), "a.mps:10:4: expected the name of a row, got \"q\""},
          {Mps("RHS\n b r 1 e\n"), "a.mps:10:2: expected the name of a row, got \"b\""},
          {Mps("RHS\n b r\n"), "a.mps:10:2: expected the name of a row, got \"b\""},
          {Mps("RHS\n b r 1\n b r 2\n"),
           "a.mps:11:4: expected one right-hand side for a row, got another for \"r\""},
          {Mps("RHS\n b e inf\n"),
           "a.mps:10:6: expected a finite right-hand side for a row of type E, got \"inf\""},
          {Mps("RANGES\n b r 1\n b r 2\n"),
           "a.mps:11:4: expected one range for a row, got another for \"r\""},
          {Mps("BOUNDS\n XX b x 1\n"),
           "a.mps:10:2: expected a type of bound: UP, LO, FX, FR, MI, PL, "
           "BV, LI, UI, SC or SI, got \"XX\""},
          {Mps("BOUNDS\n UP b z 1\n"), "a.mps:10:7: expected the name of a column, got \"z\""},
          {Mps("BOUNDS\n UP x\n"),
           "a.mps:10:2: expected a type of bound, a set, a column and a number, got \"UP x\""},
          {Mps("BOUNDS\n LO b x inf\n"),
           "a.mps:10:9: expected a lower bound below, an upper bound "
           "above infinity, got \"inf\""},
          {Mps("BOUNDS\n LO b x 1\n SC b x inf\nENDATA\n"),
           "a.mps:7:2: expected finite bounds of a semicontinuous column, got [1, inf] of \"x\""},
      });
}

TEST(ErrorTexts, OfMpsQuadratics) {
  ExpectSaid(
      "a.mps",
      {
          {Mps("QUADOBJ\n x y 1\n y x 1\nENDATA\n"),
           "a.mps:11:2: expected each pair of columns once, got another \"y x 1\""},
          {Mps("QMATRIX\n x y 1\n y x 2\nENDATA\n"),
           "a.mps:11:2: expected the same number at both places of a symmetric QMATRIX, got \"y x "
           "2\""},
          {Mps("QUADOBJ\n x 1\n"), "a.mps:10:2: expected two columns and a number, got \"x 1\""},
          {Mps("QUADOBJ\nQMATRIX\n"),
           "a.mps:10:1: expected the quadratic objective once, got QMATRIX behind QUADOBJ"},
          {Mps("QSECTION r\n"),
           "a.mps:9:10: expected the objective behind QSECTION (a quadratic row "
           "cannot be held), got \"r\""},
      });
}

TEST(ErrorTexts, OfBytesThatAreNoText) {
  ExpectSaid("a.mps",
             {
                 {std::string("NAME\n a\0b", 9), "a.mps:2:3: expected text, got \"\\x00\""},
                 {"NAME\n" + std::string(70000, 'x'),
                  "a.mps:2:1: expected a line of at most 65536 bytes, got one of 70000"},
                 {"ROWS\n \x01\xFF r\n",
                  "a.mps:2:2: expected a type of row: N, L, G or E, got \"\\x01\\xFF\""},
             });
}

// A file of CBF with two variables and three rows, and these lines behind.
std::string Cbf(const std::string& behind) {
  return "VER\n1\nOBJSENSE\nMIN\nVAR\n2 1\nF 2\nCON\n3 1\nL= 3\n" + behind;
}

TEST(ErrorTexts, OfCbfStructure) {
  ExpectSaid(
      "a.cbf",
      {
          {"", "a.cbf:1:1: expected VER, got the end of the file"},
          {"VER\n1\n", "a.cbf:3:1: expected OBJSENSE, got the end of the file"},
          {"OBJSENSE\nMIN\n", "a.cbf:1:1: expected VER first, got \"OBJSENSE\""},
          {"VER\n9\n", "a.cbf:2:1: expected a version from 1 to 4, got \"9\""},
          {"VER\n1\nOBJSENSE\nUP\n", "a.cbf:4:1: expected MIN or MAX, got \"UP\""},
          {Cbf("VAR\n"), "a.cbf:11:1: expected one block VAR, got another"},
          {Cbf("CHANGE\n"),
           "a.cbf:11:1: expected one problem in a file (a sequence of changes is not "
           "read), got \"CHANGE\""},
          {"VER\n1\nVAR\n3 1\nF 2\n",
           "a.cbf:4:1: expected the sum of the sizes of the cones, 2, got \"3\""},
          {"VER\n1\nVAR\n3 1\nQ 4\n",
           "a.cbf:5:3: expected the size of a cone from 1 to 3, got \"4\""},
          {"VER\n1\nVAR\n2 1\nEXP 3\n",
           "a.cbf:5:1: expected a cone of at most 2 entries, as so many are left, got \"EXP\""},
          {"VER\n1\nVAR\n3 1\nCONE 3\n",
           "a.cbf:5:1: expected a cone (F, L+, L-, L=, Q, QR, EXP, EXP*, "
           "@k:POW or @k:POW*), got \"CONE\""},
          {"VER\n1\nVAR\n3 1\n@0:POW 3\n",
           "a.cbf:5:2: expected a cone of POWCONES (there is none), got \"0\""},
          {"VER\n1\nVAR\n2000000000 1\n",
           "a.cbf:4:1: expected sizes that go with the size of the file "
           "(100000 and 64 a byte), got \"2000000000\""},
          {"VER\n1\nPSDVAR\n1\n40000\n",
           "a.cbf:5:1: expected sizes that go with the size of the file "
           "(100000 and 64 a byte), got \"40000\""},
          {"VER\n3\nPOWCONES\n1 3\n3\n1\n1\n1\n",
           "a.cbf:5:1: expected 2 weights (a power cone that a program holds has three entries), "
           "got "
           "\"3\""},
          {"VER\n3\nPOWCONES\n1 2\n2\n1\n-1\n",
           "a.cbf:7:1: expected a positive weight, got \"-1\""},
      });
}

TEST(ErrorTexts, OfCbfEntries) {
  ExpectSaid(
      "a.cbf",
      {
          {Cbf("ACOORD\n1\n3 0 1\n"), "a.cbf:13:1: expected a row from 0 to 2, got \"3\""},
          {Cbf("ACOORD\n1\n0 -1 1\n"), "a.cbf:13:3: expected a variable from 0 to 1, got \"-1\""},
          {Cbf("ACOORD\n1\n0 0 x\n"), "a.cbf:13:5: expected a number, got \"x\""},
          {Cbf("ACOORD\n1\n0 0\n"),
           "a.cbf:13:1: expected a row, a variable and a number, got \"0 0\""},
          {Cbf("ACOORD\n1\n0 0 1 1\n"),
           "a.cbf:13:7: expected nothing behind a row, a variable and a number, got \"1\""},
          {Cbf("ACOORD\n1\n"),
           "a.cbf:13:1: expected a row, a variable and a number, got the end of the file"},
          {Cbf("ACOORD\n999\n0 0 1\n"), "a.cbf:12:1: expected a count from 0 to 4, got \"999\""},
          {Cbf("ACOORD\n2\n0 0 1\n0 0 1\n"),
           "a.cbf:11:1: expected each row and variable once in ACOORD, got one twice"},
          {Cbf("BCOORD\n2\n1 1\n1 2\n"),
           "a.cbf:11:1: expected each row once in BCOORD, got one twice"},
          {Cbf("FCOORD\n1\n0 0 0 0 1\n"),
           "a.cbf:13:3: expected a matrix of PSDVAR (there is none), got \"0\""},
          {Cbf("PSDCON\n1\n2\nHCOORD\n1\n0 0 2 0 1\n"),
           "a.cbf:16:5: expected a row of the matrix from 0 to 1, got \"2\""},
          {Cbf("INT\n1\n5\n"), "a.cbf:13:1: expected a variable from 0 to 1, got \"5\""},
          {Cbf("OBJBCOORD\nx\n"), "a.cbf:12:1: expected a number, got \"x\""},
      });
}

TEST(ErrorTexts, OfFilesOfNoFormat) {
  for (const char* name : {"a.txt", "-"}) {
    try {
      ReadProgramText("hello\n", name);
      ADD_FAILURE();
    } catch (const InvalidArgument& error) {
      EXPECT_EQ(error.what(), Text(name,
                                   ": a format to read is named, or told by an ending (.mps, "
                                   ".qps, .cbf, .json; each with .gz too) or by the first line; "
                                   "here none tells"));
    }
  }
  EXPECT_EQ(ReadProgramText("* c\nROWS\nCOLUMNS\nENDATA\n", "-")->num_vars(), 0);
  EXPECT_EQ(ReadProgramText("# c\nVER\n1\nOBJSENSE\nMIN\n", "-")->num_vars(), 0);
  EXPECT_THROW(FileFormatByName("lp"), InvalidArgument);
  EXPECT_EQ(FileFormatByName("cbf"), FileFormat::kCbf);
}

}  // namespace
}  // namespace switchyard::io
