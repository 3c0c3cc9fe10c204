// A parsed map file: one rule a line.
//
//   # comment
//   t[s]       = 1e-9*ts - 1.627997452227e9     a number: SCALE*COLUMN + OFFSET; scale and offset may be left out
//   t[s]       = time date clock since 2024-05-03   dates, clock times or counts since 1970, of one or two columns
//   rssi[dBm]  = 10*log10(power)                milliwatts
//   rssi[dBm]  = rssi_{i}                       {i} runs over `for`: a row of the result for each
//   tx         = "robot"                        a name for all rows; {i} may be part of it
//   rx         = "anchor{i}"
//   rx_x[m]    = anchors.x                      a column of a second table, in the row with the matching key
//   tx_x[m]    = east lat lon                   metres from the origin; also north, and up with an altitude
//   origin     = 47.3769 8.5417 408             latitude, longitude, altitude; without it the first point
//   for i      = 1 2 3
//   table anchors = anchors.csv id {i}          its file, beside the map; its key column; the key's value
//   none rssi  = 0 -128                         values that mean: nothing was received
//   file name  = run_{distance}m_ch{channel}.csv    parts of the file's name, used as {distance}; {file} is the name
//   header     = none                           columns are column1, column2, ...; or: line 3
//   comment    = # %                            beginnings of lines that are left out
//   end        = Total                          beginning of the line that ends the table
//   cells      = space                          or comma, semicolon, tab: what separates cells
//   decimal    = comma
#pragma once

#include <map>
#include <optional>

#include "diagnosis/data/file_name_pattern.hpp"
#include "diagnosis/data/foreign_table.hpp"
#include "diagnosis/data/globe.hpp"
#include "diagnosis/data/time_stamp.hpp"
#include "text/text_table.hpp"

namespace muster::diagnosis {

struct ColumnReference {
  std::string table, column;  // empty table: the imported one
};

struct NumberRule {
  double scale = 1, offset = 0;
  ColumnReference from;    // empty column: offset alone
  bool logarithm = false;  // of base 10, of the column
};

struct TimeRule {
  std::string words;  // a column, or two with a blank between
  std::optional<Stamp> since;
};

struct GlobeRule {
  std::size_t axis = 0;  // east, north, up
  ColumnReference latitude, longitude;
  std::optional<ColumnReference> altitude;
};

struct ColumnRule {
  TextColumn column;
  bool is_name = false;
  std::string name;         // a fixed name, or
  std::string name_column;  // a column of names
  std::optional<NumberRule> number;
  std::optional<TimeRule> time;
  std::optional<GlobeRule> globe;
  std::string text;  // right of '='
  Place place;
};

struct SideTable {
  std::filesystem::path file;
  std::string key, value;  // a column, and its required value
  Place place;             // of its line in the map
};

struct ImportMap {
  std::string file;
  std::string variable;             // "i"; empty: one row of the result for each row
  std::vector<std::string> values;  // its values
  std::vector<ColumnRule> columns;  // in the order of the result
  std::map<std::string, SideTable> tables;
  std::map<std::string, std::vector<double>> none;
  TableShape shape;
  FileNamePattern file_name;
  std::optional<GeodeticPoint> origin;
};

// Throws Error with the line of a malformed rule.
ImportMap read_import_map(const std::filesystem::path& file);

// The text with {variable} substituted.
std::string filled(std::string text, const std::string& variable, const std::string& value);

}  // namespace muster::diagnosis
