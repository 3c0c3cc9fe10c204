// Field logs in odd shapes: without header, with comments and trailers, several files, values in a file's name, dates,
// places on the globe, and milliwatts.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/data/globe.hpp"
#include "diagnosis/data/table_import.hpp"
#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

const std::string ends = "tx = \"a\"\nrx = \"b\"\ntx_x[m] = 0\ntx_y[m] = 0\nrx_y[m] = 1\n";

class Import {
 public:
  void file(const std::string& name, const std::string& text) { files_.push_back(scratch_.write(name, text)); }
  // The table written, or the error.
  std::string with(const std::string& map) {
    const auto rules = scratch_.write("m.map", map);
    const std::string error = complaint([&] { result = import_table(files_, rules, scratch_ / "out.csv"); });
    return error.empty() ? contents(scratch_ / "out.csv") : error;
  }
  bool assumed(const std::string& words) const {
    return std::any_of(result.assumed.begin(), result.assumed.end(),
                       [&](const std::string& line) { return line.find(words) != line.npos; });
  }
  Imported result;

 private:
  Scratch scratch_;
  std::vector<std::filesystem::path> files_;
};

TEST(ForeignShapes, ATableWithoutHeaderHasColumnsByNumber) {
  Import import;
  import.file("log.csv", "0,1.5,-50\n1,2.5,-51\n");
  EXPECT_EQ(
      import.with(ends + "t[s] = column1\nrx_x[m] = column2\nrssi[dBm] = column3\n"),
      "log.csv:1: the first line holds numbers and no names; expected a header, or header = none in the map, where "
      "columns are called column1, column2, ...");
  EXPECT_EQ(import.with("header = none\n" + ends + "t[s] = column1\nrx_x[m] = column2\nrssi[dBm] = column3\n"),
            "tx,rx,tx_x[m],tx_y[m],rx_y[m],t[s],rx_x[m],rssi[dBm]\n"
            "a,b,0,0,1,0,1.5,-50\na,b,0,0,1,1,2.5,-51\n");
  const std::string error = import.with("header = none\n" + ends + "t[s] = column4\nrx_x[m] = column2\n");
  EXPECT_EQ(error.substr(0, 9), "m.map:7: ");
  EXPECT_NE(error.find("log.csv has no column \"column4\"; expected one of column1, column2, column3"), error.npos)
      << error;
}

TEST(ForeignShapes, CommentsAPreambleAndATrailer) {
  Import import;
  import.file("log.txt",
              "Logger 7, firmware 2\n\n# battery full\ntime x rssi\n0 1.5 -50\n% moved\n1   2.5 -51\n"
              "Total: 2 records\nbye\n");
  const std::string map =
      "header = line 4\ncomment = # %\nend = Total\n" + ends + "t[s] = time\nrx_x[m] = x\nrssi[dBm] = rssi\n";
  EXPECT_EQ(import.with(map),
            "tx,rx,tx_x[m],tx_y[m],rx_y[m],t[s],rx_x[m],rssi[dBm]\na,b,0,0,1,0,1.5,-50\na,b,0,0,1,1,2.5,-51\n");
  EXPECT_TRUE(import.assumed("cells are separated by blanks"));
  EXPECT_TRUE(import.assumed("comment lines that are left out: 1"));
  EXPECT_TRUE(import.assumed("the table ends above line 8"));
  EXPECT_EQ(import.with("header = line 4\ncomment = # %\n" + ends + "t[s] = time\nrx_x[m] = x\nrssi[dBm] = rssi\n"),
            "log.txt:9: the row has 1 cell; expected 3 (a line that is no row: comment = WORD or end = WORD in the map "
            "leaves it out)");
}

TEST(ForeignShapes, AHeaderInAComment) {
  Import import;
  import.file("log.csv", "# field log\n# t,x,rssi\n0,1.5,-50\n1,2.5,-51\n");
  EXPECT_EQ(import.with(ends + "t[s] = t\nrx_x[m] = x\nrssi[dBm] = rssi\n"),
            "tx,rx,tx_x[m],tx_y[m],rx_y[m],t[s],rx_x[m],rssi[dBm]\na,b,0,0,1,0,1.5,-50\na,b,0,0,1,1,2.5,-51\n");
  EXPECT_TRUE(import.assumed("the names of columns are those of the comment in line 2"));
}

TEST(ForeignShapes, CommasInNumbersAndDoubledQuotes) {
  Import import;
  import.file("log.csv", "x;rssi;who\n1,5;-50,25;\"the \"\"old\"\" phone\"\n2,5;-51,5;\"new\"\n");
  EXPECT_EQ(import.with("decimal = comma\n" + ends + "rx_x[m] = x\nrssi[dBm] = rssi\nphone = name who\n"),
            "tx,rx,tx_x[m],tx_y[m],rx_y[m],rx_x[m],rssi[dBm],phone\n"
            "a,b,0,0,1,1.5,-50.25,\"the \"\"old\"\" phone\"\na,b,0,0,1,2.5,-51.5,new\n");
  Import broken;
  broken.file("log.csv", "x,who\n1,\"old\" phone\n");
  EXPECT_EQ(broken.with(ends + "rx_x[m] = x\n"),
            "log.csv:2:8: text after a quoted cell; expected ',' or the end of the line");
}

TEST(ForeignShapes, TwoColumnsOfOneName) {
  Import import;
  import.file("log.csv", "x,rssi,rssi\n1,-50,-60\n2,-51,-61\n");
  EXPECT_EQ(import.with(ends + "rx_x[m] = x\nrssi[dBm] = column3\n"),
            "tx,rx,tx_x[m],tx_y[m],rx_y[m],rx_x[m],rssi[dBm]\na,b,0,0,1,1,-60\na,b,0,0,1,2,-61\n");
  const std::string error = import.with(ends + "rx_x[m] = x\nrssi[dBm] = rssi\n");
  EXPECT_NE(error.find("log.csv has two columns \"rssi\"; expected column2 or column3"), error.npos) << error;
}

TEST(ForeignShapes, SeveralFilesWithValuesInTheirNames) {
  Import import;
  import.file("run_2.5m_ch11.csv", "s,rssi\n5,-60\n15,-61\n");
  import.file("run_1.5m_ch3.csv", "s,rssi\n0,-50\n10,-51\n");
  const std::string map =
      "file name = run_{way}m_ch{channel}.csv\nt[s] = s\ntx = \"a\"\nrx = \"b\"\ndistance[m] = {way}\n"
      "channel = {channel}\nrun = \"{file}\"\nrssi[dBm] = rssi\n";
  EXPECT_EQ(
      import.with(map),
      "t[s],tx,rx,distance[m],channel,run,rssi[dBm]\n0,a,b,1.5,3,run_1.5m_ch3,-50\n5,a,b,2.5,11,run_2.5m_ch11,-60\n"
      "10,a,b,1.5,3,run_1.5m_ch3,-51\n15,a,b,2.5,11,run_2.5m_ch11,-61\n");
  EXPECT_TRUE(import.assumed("rows of all files are in the order of t"));
  import.file("notes.csv", "s,rssi\n20,-60\n");
  EXPECT_EQ(import.with(map), "m.map:1: the file \"notes.csv\" does not fit \"run_{way}m_ch{channel}.csv\"");
  EXPECT_EQ(import.with("file name = {a}{b}.csv\n"),
            "m.map:1: {a}{b} cannot be told apart; expected a text between them");
  EXPECT_EQ(import.with("file name = log.csv\n"),
            "m.map:1: \"log.csv\" has no parts; expected such as run_{distance}m.csv");
}

// The error names the file and line of both rows.
TEST(ForeignShapes, ARepeatedReadingInTwoFiles) {
  Import import;
  import.file("one.csv", "s,x,rssi\n0,1,-50\n1,2,-51\n");
  import.file("two.csv", "s,x,rssi\n1,2,-51\n2,3,-52\n");
  const std::string error = import.with(ends + "t[s] = s\nrx_x[m] = x\nrssi[dBm] = rssi\n");
  EXPECT_EQ(error.substr(0, 41), "two.csv:2: a -> b at t = 1 s repeats line");
  EXPECT_NE(error.find("one.csv; expected each (t, tx, rx) once"), error.npos) << error;
}

TEST(ForeignShapes, DatesAndClockTimes) {
  Import import;
  import.file("log.csv",
              "stamp,day,clock,x,rssi\n2024-05-03T12:34:56.5Z,2024-05-03,12:34:56.5,1,-50\n"
              "2024-05-03T14:34:58Z,2024-05-03,14:34:58,2,-51\n");
  const std::string rest = ends + "rx_x[m] = x\nrssi[dBm] = rssi\n";
  const auto times = [&](const std::string& rule) {
    const std::string table = import.with("t[s] = " + rule + "\n" + rest);
    const std::size_t first = table.find('\n') + 1, second = table.find('\n', first) + 1;
    return second == 0 ? table
                       : table.substr(first, table.find(',', first) - first) + ' ' +
                             table.substr(second, table.find(',', second) - second);
  };
  EXPECT_EQ(times("time stamp"), "0 7201.5");
  EXPECT_EQ(times("time day clock"), "0 7201.5");
  EXPECT_EQ(times("time clock"), "0 7201.5");
  EXPECT_EQ(times("time stamp since 2024-05-03T12:00:00Z"), "2096.5 9298");
  EXPECT_EQ(
      times("stamp"),
      "log.csv:2: column \"stamp\": \"2024-05-03T12:34:56.5Z\" is not a number, but a date; expected seconds (muster "
      "import reads dates); where these are dates or clock times, expected t[s] = time stamp");
  EXPECT_EQ(import.with("t[ms] = time stamp\n" + rest),
            "m.map:1: \"t[ms]\" is made of times, in seconds; expected \"t[s]\"");
}

// Vincenty's distance from Greenwich to a point 0.01 degrees to the north and one to the east: 1112.6 m and 695.8 m.
TEST(Globe, DegreesAreMetresOfTheEllipsoid) {
  const TangentPlane plane({51.4779, -0.0015, 0});
  const auto north = plane.east_north_up({51.4879, -0.0015, 0}), east = plane.east_north_up({51.4779, 0.0085, 0});
  EXPECT_NEAR(north[1], 1112.6, 0.2);
  EXPECT_NEAR(north[0], 0, 1e-6);
  EXPECT_NEAR(east[0], 695.2, 1);
  EXPECT_NEAR(plane.east_north_up({51.4779, -0.0015, 100})[2], 100, 1e-6);
  const auto far = TangentPlane({0, 0, 0}).east_north_up({0, 0.898315, 0});  // 100 km along the equator
  EXPECT_NEAR(far[0], 99995.9, 1);
  EXPECT_NEAR(far[2], -784, 1);
}

TEST(ForeignShapes, LatitudesAndLongitudes) {
  Import import;
  import.file("log.csv", "lat,lon,alt,rssi\n47.0,8.0,400,-50\n0,0,0,-60\n47.001,8.0,410,-51\n47.0,8.001,400,-52\n");
  const std::string map =
      "tx = \"a\"\nrx = \"b\"\ntx_x[m] = 0\ntx_y[m] = 0\nrx_x[m] = east lat lon\nrx_y[m] = north lat lon\n"
      "rx_z[m] = up lat lon alt\nrssi[dBm] = rssi\n";
  ASSERT_NE(import.with(map).find("-50\n"), std::string::npos);
  EXPECT_EQ(import.result.rows, 3u);
  EXPECT_TRUE(import.assumed("latitude 47, longitude 8, altitude 400 m (WGS 84), the first point"));
  EXPECT_TRUE(import.assumed("left out: 1, first "));
  const Scratch scratch;
  const Dataset data = read_dataset(scratch.write("d.csv", import.with(map)));
  EXPECT_NEAR(data.rx_at[0][0], 0, 1e-9);
  EXPECT_NEAR(data.rx_at[1][1], 111.18, 0.05);
  EXPECT_NEAR(data.rx_at[1][2], 10, 0.01);
  EXPECT_NEAR(data.rx_at[2][0], 76.06, 0.05);
  EXPECT_EQ(import.with("origin = 147 8\n" + map),
            "m.map:1: 147 is no latitude; expected degrees from -90 to 90, before the longitude");
  EXPECT_EQ(import.with("rx_x[m] = east lat\n"),
            "m.map:1: expected east LATITUDE LONGITUDE, and perhaps ALTITUDE, the names of columns");
}

TEST(ForeignShapes, MilliwattsBecomeDecibels) {
  Import import;
  import.file("log.csv", "x,power\n1,1e-5\n2,2e-6\n3,0\n");
  const std::string map = ends + "rx_x[m] = x\nrssi[dBm] = 10*log10(power) + 1\n";
  EXPECT_EQ(import.with(map),
            "log.csv:4: column \"power\": 0 has no logarithm; expected a power above 0 (none rssi = 0 in the map makes "
            "such cells empty)");
  EXPECT_NE(import.with("none rssi = 0\n" + map).find(",-49\n"), std::string::npos);
  EXPECT_EQ(import.result.empty, 1u);
  EXPECT_TRUE(import.assumed("rssi[dBm] = 10 x log10 of \"power\" + 1"));
}

// Found by mutated tables and maps.
TEST(ForeignShapes, ControlCharacters) {
  Import import;
  import.file("log.csv", "x,rssi,who\n1,-50,p\x01q\n2,-51,r\n");
  const std::string map = ends + "rx_x[m] = x\nrssi[dBm] = rssi\nwho = name who\n";
  EXPECT_EQ(import.with(map), "log.csv:2:8: the control character \"\\x01\" is not allowed");
  EXPECT_EQ(import.with("dista\x06"
                        "ce[m] = x\n"),
            "m.map:1: the control character \"\\x06\" is not allowed");
}

TEST(ForeignShapes, LinesOfAMapThatMeanNothing) {
  Import import;
  import.file("log.csv", "x,rssi\n1,-50\n");
  EXPECT_EQ(import.with("header = 3\n"), "m.map:1: expected header = none, or header = line NUMBER");
  EXPECT_EQ(
      import.with("cells = tabs\n"),
      "m.map:1: \"tabs\" separates no cells; expected one of comma, semicolon, tab, space; did you mean \"tab\"?");
  EXPECT_EQ(import.with("decimal = ,\n"), "m.map:1: expected decimal = comma or decimal = point");
  EXPECT_EQ(import.with("t[s] = time since 2024-05-03\n"),
            "m.map:1: no column; expected time COLUMN, or time DATE_COLUMN CLOCK_COLUMN");
}

}  // namespace
}  // namespace muster::diagnosis
