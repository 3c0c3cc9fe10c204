#include "text/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <limits>
#include <random>

#include "error_of.hpp"
#include "text/text_table_writer.hpp"

namespace muster {
namespace {

using ::testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();

class Table : public test::FolderTest {
 protected:
  TextTable read(std::string_view bytes) { return TextTable::read(write("d.csv", bytes)); }
  template <class Call>
  std::string error(Call call) {
    return test::error_of(call, folder);
  }
  std::string error_in(std::string_view bytes) {
    return error([&] { read(bytes); });
  }
  std::string error_in_reals(std::string_view bytes, std::size_t column) {
    return error([&] { read(bytes).reals(column); });
  }
  std::string bytes_of(const std::string& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

constexpr std::string_view radio = "t[s],tx,rx,rssi[dBm]\n0,base,r1,-61.5\n0.1,base,r2,\n0.2,r1,base,-7e1\n";

TEST_F(Table, ReadsNumbersNamesAndUnits) {
  const TextTable table = read(radio);
  ASSERT_EQ(table.columns().size(), 4u);
  EXPECT_EQ(table.columns()[3].name, "rssi");
  EXPECT_EQ(table.columns()[3].unit, "dBm");
  EXPECT_EQ(table.columns()[1].label(), "tx");
  EXPECT_EQ(table.columns()[3].label(), "rssi[dBm]");
  EXPECT_EQ(table.rows(), 3u);
  EXPECT_THAT(table.reals(table.require("t", "s")), ElementsAre(0, 0.1, 0.2));
  const std::vector<double> rssi = table.reals(table.require("rssi", "dBm"), {.empty = true});
  EXPECT_THAT(rssi, ElementsAre(-61.5, ::testing::IsNan(), -70));
  const Factor tx = table.texts(table.require("tx", ""));
  EXPECT_THAT(tx.levels, ElementsAre("base", "r1"));
  EXPECT_THAT(tx.level, ElementsAre(0u, 0u, 1u));
  EXPECT_EQ(table.text(1, 2), "r2");
  EXPECT_EQ(table.place(2, 3).line, 4);
  EXPECT_EQ(table.place(2, 3).column, 13);
  EXPECT_EQ(table.find("rx"), 2u);
  EXPECT_EQ(table.find("x"), std::nullopt);
}

TEST_F(Table, TakesCrlfByteOrderMarkAndAMissingLastLineEnd) {
  for (const std::string_view bytes : {"a[m],b\r\n1,x\r\n2,y\r\n",
                                       "\xEF\xBB\xBF"
                                       "a[m],b\n1,x\n2,y",
                                       "a[m],b\r\n1,x\r\n2,y"}) {
    const TextTable table = read(bytes);
    ASSERT_EQ(table.rows(), 2u);
    EXPECT_THAT(table.reals(0), ElementsAre(1, 2));
    EXPECT_THAT(table.texts(1).levels, ElementsAre("x", "y"));
  }
  EXPECT_EQ(read("a,b\n").rows(), 0u);
  EXPECT_EQ(read("a,b").rows(), 0u);
  EXPECT_THAT(read("a\n\n1\n").reals(0, {.empty = true}), ElementsAre(::testing::IsNan(), 1));
  EXPECT_THAT(read("a,b\n1,").reals(1, {.empty = true}), ElementsAre(::testing::IsNan()));
}

TEST_F(Table, TakesQuotedCells) {
  const TextTable table = read("\"name\",n\n\"a,b\",1\n\"say \"\"x\"\"\",2\n\"\",3\n\"a,b\",4\r\n\" s \",5");
  const Factor name = table.texts(0);
  EXPECT_THAT(name.levels, ElementsAre("a,b", "say \"x\"", "", " s "));
  EXPECT_THAT(name.level, ElementsAre(0u, 1u, 2u, 0u, 3u));
  EXPECT_THAT(table.reals(1), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(table.text(1, 0), "say \"x\"");
}

TEST_F(Table, KeepsSomeOfItsRows) {
  for (const char* end : {"\n", "\r\n", ""}) {
    const TextTable table = read("a[m],b,c[s]\r\n1,x,7\r\n2,\"y,\"\"z\",8\r\n,\"3\",9" + std::string(end));
    const TextTable some = table.with_column(2, {"c", "min"}, {70, 80, 90}).with_rows({2, 1});
    ASSERT_EQ(some.rows(), 2u);
    EXPECT_THAT(some.reals(0, {.empty = true}), ElementsAre(::testing::IsNan(), 2));
    EXPECT_THAT(some.texts(1).levels, ElementsAre("3", "y,\"z"));
    EXPECT_THAT(some.reals(2), ElementsAre(90, 80));
    EXPECT_EQ(some.columns()[2].label(), "c[min]");
    EXPECT_EQ(some.file(), table.file());
    EXPECT_EQ(table.with_rows({}).rows(), 0u);
  }
}

TEST_F(Table, KnowsNumbersFromNames) {
  const TextTable table = read("a,b,c[V],d,e\n,x,,\"7\",\n1,2,x,8,\n");
  EXPECT_TRUE(table.is_numeric(0));  // its first cell that is not empty is a number
  EXPECT_FALSE(table.is_numeric(1));
  EXPECT_TRUE(table.is_numeric(2));   // it has a unit
  EXPECT_FALSE(table.is_numeric(3));  // quoted
  EXPECT_FALSE(table.is_numeric(4));  // nothing in it
}

TEST_F(Table, RefusesFilesThatAreNoTable) {
  EXPECT_EQ(error_in(""), "d.csv: is empty; expected a header such as t[s],tx,rx,rssi[dBm]");
  EXPECT_EQ(error_in("\x1F\x8B\x08"), "d.csv: is compressed by gzip; expected plain text");
  EXPECT_EQ(
      error_in("a,b\n1,\xE9\n"),
      "d.csv:2:3: byte 7 of the file, 0xe9, is not valid UTF-8; is it Latin-1, as editors of Windows write? expected "
      "UTF-8: iconv -f ISO-8859-1 -t UTF-8 d.csv > NEW");
  EXPECT_EQ(error([&] { TextTable::read(folder / "absent.csv"); }), "absent.csv: no such file");
  EXPECT_EQ(error([&] { TextTable::read("/dev/zero"); }), "/dev/zero: is not a regular file");
}

TEST_F(Table, RefusesBadHeaders) {
  EXPECT_EQ(error_in("t[s];tx\n"),
            "d.csv:1:1: cells stand between ';'; expected ',' between cells and '.' in numbers: sed 's/;/,/g' FILE "
            "makes them so "
            "(readings: muster import FILE --map MAP --out FILE)");
  EXPECT_EQ(
      error_in("x[m];y[m]\n1,5;2,25\n"),
      "d.csv:1:1: cells stand between ';', and numbers have decimal commas; expected ',' between cells and '.' in "
      "numbers: sed 's/,/./g; s/;/,/g' FILE makes them so (readings: muster import FILE --map MAP --out FILE, with "
      "decimal = comma in the map)");
  EXPECT_EQ(error_in("[[1, 2], [3, 4]]\n"),
            "d.csv:1:1: begins as JSON does; expected a table: a header of names, and ',' between cells");
  EXPECT_EQ(error_in("0\nSECTION\n2\nENTITIES\n"),
            "d.csv:1:1: begins as a DXF drawing does; expected a table: a header of names, and ',' between cells");
  EXPECT_EQ(error_in("QGC WPL 110\n0\t1\t0\t16\n"),
            "d.csv:1:1: begins as a flight plan of QGroundControl does; expected a table: a header of names, and ',' "
            "between cells, such as x[m],y[m],z[m], in metres from an origin of your own (a degree of latitude is some "
            "111200 m, one of longitude that times cos(latitude))");
  EXPECT_EQ(error_in("t[s],tx,t\n"),
            "d.csv:1:9: column \"t\" stands twice; the first is column 1 of the header; expected one of the two, or "
            "another name for it");
  const std::string expected = " is not a column; expected name or name[unit], without spaces around it";
  EXPECT_EQ(error_in("b [m],c\n"), "d.csv:1:1: \"b [m]\"" + expected + "; did you mean \"b[m]\"?");
  for (const std::string label : {"[m]", "b[", "b[]", "b]", "b[m", "b[m]x", "b[[m]]", " b", "b ", "b[m]]"}) {
    EXPECT_EQ(error_in("a," + label + ",c\n"), "d.csv:1:3: \"" + label + "\"" + expected);
  }
}

TEST_F(Table, RefusesRaggedRows) {
  EXPECT_EQ(error_in("a,b,c\n1,2,3\n1,2\n"),
            "d.csv:3:1: the row has 2 cells; expected 3, with ',' between them and '.' in numbers");
  EXPECT_EQ(error_in("a,b\n1,5,2,0\n"),
            "d.csv:2:1: the row has 3 or more cells; expected 2, with ',' between them and '.' in numbers");
  EXPECT_EQ(error_in("a,b\n1,2\n3,4,\n"),
            "d.csv:3:4: a comma stands at the end of the row, and makes an empty cell beyond the 2 of the header; "
            "expected none there");
  EXPECT_EQ(error_in("a,b\n1\n"),
            "d.csv:2:1: the row has 1 cell; expected 2, with ',' between them and '.' in numbers");
  EXPECT_EQ(error_in("image: map.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\n"),
            "d.csv:1:1: the first line is \"image: map.pgm\", as of a YAML file, and no header; expected a table: a "
            "header of names, and ',' between cells");
  EXPECT_EQ(error_in("sep=,\na,b\n1,2\n"),
            "d.csv:1:1: \"sep=\" is a spreadsheet's line, and no header: delete this line");
  EXPECT_EQ(error_in("a,b\n1,2\n\n"), "d.csv:3:1: the file ends in an empty line; expected none below the last row");
  EXPECT_EQ(error_in("a,b\r\n\r\n1,2\r\n"), "d.csv:2:1: the line is empty; expected a row");
  EXPECT_EQ(error_in("a,b\n" + std::string(70'000, 'x') + ",1\n"),
            "d.csv:2:1: the row is too long; expected at most 65535 bytes");
}

TEST_F(Table, RefusesBrokenCells) {
  EXPECT_EQ(error_in("a,b\n1,\"x\n2,y\n"), "d.csv:2:3: a quoted cell is not closed; expected '\"' in its line");
  EXPECT_EQ(error_in("a,b\n1,\"x"), "d.csv:2:3: a quoted cell is not closed; expected '\"' in its line");
  EXPECT_EQ(error_in("a,b\n1,\"x\"y\n"), "d.csv:2:6: \"y\" after a quoted cell; expected ',' or the end of the line");
  EXPECT_EQ(error_in("a,b\n1,x\"y\n"),
            "d.csv:2:4: a quote inside a cell; expected the whole cell in quotes, its own quotes doubled");
  EXPECT_EQ(
      error_in(std::string_view("a,b\n1,\0\n", 8)),
      R"(d.csv:2:3: the control character "\x00" is not allowed: the file is damaged, or no text; expected CSV in UTF-8)");
  EXPECT_EQ(error_in("my log\na,b\n1,2\n"),
            R"(d.csv:1:1: the first line is "my log" and no header; expected one there, such as t[s],tx,rx,rssi[dBm])");
  EXPECT_EQ(error_in("\na,b\n1,2\n"),
            "d.csv:1:1: the first line is empty and no header; expected one there, such as t[s],tx,rx,rssi[dBm]");
  EXPECT_EQ(error_in("1,2\n3,4\n"),
            "d.csv:1:1: the first line has numbers and no names; expected a header above it, such as x[m],y[m]");
  EXPECT_EQ(error_in("PK\x03\x04"),
            "d.csv: is a ZIP archive, as .xlsx and .ods are; expected plain text, such as CSV in UTF-8");
  EXPECT_EQ(error_in("a,b\r1,2\r"), "d.csv:1:4: the line ends in CR alone; expected LF or CRLF");
}

TEST_F(Table, RefusesWhatIsNoNumber) {
  const auto in_rssi = [&](const std::string& cell) {
    return error_in_reals("tx,rssi[dBm]\né,1\nbase," + cell + "\n", 1);
  };
  const std::string place = "d.csv:3:6: column \"rssi[dBm]\": ";
  EXPECT_EQ(in_rssi("\"1,5\""), place + "\"1,5\" is not a number; a decimal point is written '.'");
  EXPECT_EQ(in_rssi("\u221237.59"),
            place + "\"\u221237.59\" is not a number; its minus is the sign U+2212; expected '-'");
  EXPECT_EQ(
      in_rssi("2024-05-03T12:00:00"),
      place + "\"2024-05-03T12:00:00\" is not a number, but a date; expected seconds (muster import reads dates)");
  EXPECT_EQ(in_rssi("nan"), place + "\"nan\" is not a number; expected one, or the table without this row");
  EXPECT_EQ(in_rssi("inf"), place + "\"inf\" is not a number; it must be finite");
  EXPECT_EQ(in_rssi(" 1"), place + "\" 1\" is not a number; it has spaces in it or around it");
  EXPECT_EQ(in_rssi("1e400"), place + "\"1e400\" is out of range");
  EXPECT_EQ(in_rssi(""), place + "the cell is empty; expected a number");
  EXPECT_EQ(error_in_reals("é,b\né,x\n", 1), "d.csv:2:3: column \"b\": \"x\" is not a number");
  EXPECT_EQ(error([&] { read("a,b\n1,\n").texts(1); }), "d.csv:2:3: column \"b\": the cell is empty; expected a name");
  EXPECT_EQ(error([&] { read("a,b\n1, x\n").texts(1); }),
            "d.csv:2:3: column \"b\": \" x\" has spaces around it; expected none, or the cell in quotes");
}

// A quoted number is a name to is_numeric, yet it is never read as a number by mistake: the message must not be empty.
TEST_F(Table, RefusesAQuotedNumberWithAReason) {
  EXPECT_EQ(error_in_reals("a,b\n1,\"7\"\n", 1),
            "d.csv:2:3: column \"b\": \"7\" is in quotes, so it is a name; expected a number");
}

TEST_F(Table, HeadersInOtherNotationsAreToldAsTheyAreWritten) {
  EXPECT_EQ(error([&] { read("x (m),y\n1,2\n").require("x", "m"); }),
            "d.csv:1:1: column \"x (m)\" is called otherwise here; expected \"x[m]\"");
  EXPECT_EQ(error([&] { read("t,RSSI_dbm\n1,2\n").require("rssi", "dBm"); }),
            "d.csv:1:3: column \"RSSI_dbm\" is called otherwise here; expected \"rssi[dBm]\"");
  EXPECT_EQ(error([&] { read("x_ft,y\n1,2\n").require("x", "m"); }),
            "d.csv:1:1: column \"x_ft\" is called otherwise here; expected \"x[m]\": 1 ft is 0.3048 m");
  EXPECT_EQ(error([&] { read("x[ft],y\n1,2\n").require("x", "m"); }),
            "d.csv:1:1: column \"x[ft]\" has the wrong unit; expected \"x[m]\": 1 ft is 0.3048 m");
}

TEST_F(Table, LinesThatAreNoRowsAreToldForWhatTheyAre) {
  EXPECT_EQ(error([&] { read("# way points\na,b\n1,2\n"); }),
            "d.csv:1:1: the line is a comment, and tables have none; expected the header: grep -v '^[#%]' FILE leaves "
            "comments out");
  EXPECT_EQ(error([&] { read("# walk 3, November\na,b,c\n1,2,3\n"); }),
            "d.csv:1:1: the line is a comment, and tables have none; expected the header: grep -v '^[#%]' FILE leaves "
            "comments out");
  EXPECT_EQ(error([&] { read("a,b\n1,2\n% more\n3,4\n"); }),
            "d.csv:3:1: the line is a comment, and tables have none; expected a row: grep -v '^[#%]' FILE leaves "
            "comments out");
  EXPECT_EQ(error([&] { read("a,b\n1,2\n\n\n"); }),
            "d.csv:3:1: the file ends in an empty line; expected none below the last row");
  EXPECT_EQ(error([&] { read("a,b\n\n1,2\n"); }), "d.csv:2:1: the line is empty; expected a row");
  const std::string sum = "; a last row of sums or means? expected the table without it";
  EXPECT_EQ(error_in_reals("a,b\n1,2\nTotal,2\n", 0), "d.csv:3:1: column \"a\": \"Total\" is not a number" + sum);
  EXPECT_EQ(error_in_reals("a,b\nmean,2\n1,2\n", 0), "d.csv:2:1: column \"a\": \"mean\" is not a number");
  EXPECT_EQ(error([&] { read("a,b,c\n1,2,3\nSum,6\n"); }),
            "d.csv:3:1: the row has 2 cells; expected 3, with ',' between them and '.' in numbers" + sum);
  EXPECT_EQ(error_in_reals("a,b\n1,nan\n", 1),
            "d.csv:2:3: column \"b\": \"nan\" is not a number; expected one, or the table without this row");
}

TEST_F(Table, OfAnotherTableTheWholeHeaderIsNamed) {
  const TextTable walls = read("name,x1,y1,x2,y2\nw,0,0,1,1\n");
  EXPECT_EQ(error([&] {
              walls.require_most({{"name", ""}, {"x0", "m"}, {"y0", "m"}, {"x1", "m"}, {"y1", "m"}});
            }),
            "d.csv:1:1: no columns \"x0[m]\", \"y0[m]\" in the table, which has name, x1, y1, x2, y2; expected "
            "name,x0[m],y0[m],x1[m],y1[m]");
  walls.require_most({{"name", ""}, {"x0", "m"}, {"x1", "m"}});  // one alone has its own message
}

TEST_F(Table, RequiresColumnsByNameAndUnit) {
  const TextTable table = read(radio);
  EXPECT_EQ(error([&] { table.require("rsi", "dBm"); }),
            "d.csv:1:1: no column \"rsi[dBm]\" in the table, which has t, tx, rx, rssi; did you mean \"rssi\"?");
  EXPECT_EQ(error([&] { table.require("rssi", "dB"); }),
            "d.csv:1:12: column \"rssi[dBm]\" has the wrong unit; expected \"rssi[dB]\"");
  EXPECT_EQ(error([&] { table.require("t", ""); }), "d.csv:1:1: column \"t[s]\" has the wrong unit; expected \"t\"");
  EXPECT_EQ(error([&] { table.require("tx", "m"); }), "d.csv:1:6: column \"tx\" has no unit; expected \"tx[m]\"");
}

TEST_F(Table, UnitsBelowTheHeaderAreToldAsSuch) {
  const TextTable table = read("t,tx,rx_x,rssi\ns,,m,dBm\n0.5,base,1,-40\n");
  const std::string expected =
      " has no unit, and line 2 holds units; expected them in the header, t[s],tx,rx_x[m],rssi[dBm], and no line of "
      "units";
  EXPECT_EQ(error([&] { table.require("t", "s"); }), "d.csv:1:1: column \"t\"" + expected);
  EXPECT_EQ(error([&] { table.require("rssi", "dBm"); }), "d.csv:1:11: column \"rssi\"" + expected);
  EXPECT_EQ(error([&] { table.require("rx_x", "rad"); }),
            "d.csv:1:6: column \"rx_x\" has no unit; expected \"rx_x[rad]\"");
  const TextTable both = read("t[s],rssi[dBm]\ns,dBm\n0.5,-40\n");
  EXPECT_EQ(error([&] { both.reals(0); }),
            "d.csv:2:1: the line holds units, which the header has; expected rows of numbers below it");
}

TEST_F(Table, ColumnsWithoutANameAreToldByWhereTheyStand) {
  EXPECT_EQ(error_in("t[s],tx,\n1,base,\n"),
            "d.csv:1:9: the header ends in a comma, so that a last column has no name; expected no comma there, nor at "
            "the end of the rows: sed 's/,\\r*$//' FILE takes them away");
  EXPECT_EQ(error_in(",t[s],tx\n0,1,base\n"),
            "d.csv:1:1: the header begins with a comma, so that the first column has no name, as the index that pandas "
            "writes; expected to_csv(..., index=False): cut -d, -f2- FILE takes it away");
  EXPECT_EQ(error_in("t[s],,tx\n1,,base\n"),
            "d.csv:1:6: two commas stand side by side in the header, so that column 2 has no name; expected name or "
            "name[unit]");
}

TEST_F(Table, WritesWhatItReads) {
  const std::vector<std::string> names = {"base", "a,b", "say \"x\"", " s", "1.5", "é", "x\ty", "nan"};
  std::vector<double> values;
  std::mt19937_64 draw(5);
  for (std::size_t i = 0; i < 20'000; ++i) {
    const double value = std::bit_cast<double>(draw());
    values.push_back(i % 7 == 0 ? infinity : std::isfinite(value) ? value : -infinity);
  }
  TextTableWriter writer(folder / "o.csv", {{"n", ""}, {"range", "m"}, {"none", "s"}, {"nothing", ""}});
  for (std::size_t i = 0; i < values.size(); ++i) {
    writer.text(names[i % names.size()]);
    writer.real(values[i]);
    writer.real(std::numeric_limits<double>::quiet_NaN());
    writer.empty();
    writer.end_row();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "o.csv"));
  writer.close();
  EXPECT_FALSE(std::filesystem::exists(folder / "o.csv.part"));
  const TextTable table = TextTable::read(folder / "o.csv");
  EXPECT_EQ(table.reals(table.require("range", "m"), {.infinite = true}), values);
  EXPECT_THAT(table.reals(2, {.empty = true}), ::testing::Each(::testing::IsNan()));
  EXPECT_EQ(table.texts(0).levels, names);
  EXPECT_EQ(table.texts(3, {.empty = true}).levels, std::vector<std::string>{""});
}

TEST_F(Table, WritesPlainText) {
  TextTableWriter writer(folder / "o.csv", {{"name", ""}, {"x", "m"}});
  writer.text("7");
  writer.real(1234.5);
  writer.end_row();
  writer.text("a b");
  writer.empty();
  writer.end_row();
  writer.close();
  EXPECT_EQ(bytes_of("o.csv"), "name,x[m]\n\"7\",1234.5\na b,\n");
}

TEST_F(Table, AnUnfinishedTableLeavesTheOldOne) {
  write("o.csv", "old");
  {
    TextTableWriter writer(folder / "o.csv", {{"x", "m"}});
    writer.real(1);
    writer.end_row();
  }
  EXPECT_EQ(bytes_of("o.csv"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "o.csv.part"));
}

TEST_F(Table, WriterReportsWhatItCannotDo) {
  EXPECT_EQ(error([&] {
              TextTableWriter(folder / "no" / "o.csv", {{"x", ""}});
            }),
            "74 no/o.csv: cannot be written: No such file or directory");
  EXPECT_EQ(error([&] {
              TextTableWriter writer(folder / "o.csv", {{"x", ""}, {"y", ""}});
              writer.real(1);
              writer.end_row();
            }),
            "70 o.csv: a row with 1 cells was written; expected 2");
  EXPECT_EQ(error([&] {
              TextTableWriter(folder / "o.csv", {{"x", ""}}).text("a\nb");
            }),
            R"(74 o.csv: cannot be written: the name "a\x0ab" has a control character)");
  std::filesystem::create_directory(folder / "d.csv");
  EXPECT_EQ(error([&] {
              TextTableWriter(folder / "d.csv", {{"x", ""}}).close();
            }),
            "74 d.csv: cannot be written: Is a directory");
  EXPECT_FALSE(std::filesystem::exists(folder / "d.csv.part"));
}

// A limit on file sizes simulates a full disk.
TEST_F(Table, AFullDiskIsAnErrorAndLeavesNothing) {
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const struct rlimit small { 4096, before.rlim_max };
  const auto old_action = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = error([&] {
    TextTableWriter writer(folder / "o.csv", {{"x", "m"}});
    for (int i = 0; i < 10'000; ++i) {
      writer.real(i);
      writer.end_row();
    }
    writer.close();
  });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_action);
  EXPECT_EQ(message, "74 o.csv: cannot be written: File too large");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace muster
