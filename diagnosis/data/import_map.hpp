// A parsed map file: one rule a line.
//
//   # comment
//   t[s]       = 1e-9*ts - 1.627997452227e9     a number: SCALE*COLUMN + OFFSET; scale and offset may be left out
//   rssi[dBm]  = rssi_{i}                       {i} runs over `for`: a row of the result for each
//   tx         = "robot"                        a name for all rows; {i} may be part of it
//   rx         = "anchor{i}"
//   rx_x[m]    = anchors.x                      a column of a second table, in the row with the matching key
//   for i      = 1 2 3
//   table anchors = anchors.csv id {i}          its file, beside the map; its key column; the key's value
//   none rssi  = 0 -128                         values that mean: nothing was received
#pragma once

#include <map>
#include <optional>

#include "text/text_table.hpp"

namespace muster::diagnosis {

struct NumberRule {
  double scale = 1, offset = 0;
  std::string table, column;  // empty table: the imported one; empty column: offset alone
};

struct ColumnRule {
  TextColumn column;
  bool is_name = false;
  std::string name;         // a fixed name, or
  std::string name_column;  // a column of names
  std::optional<NumberRule> number;
  Place place;
};

struct SideTable {
  std::filesystem::path file;
  std::string key, value;  // a column, and its required value
};

struct ImportMap {
  std::string file;
  std::string variable;             // "i"; empty: one row of the result for each row
  std::vector<std::string> values;  // its values
  std::vector<ColumnRule> columns;  // in the order of the result
  std::map<std::string, SideTable> tables;
  std::map<std::string, std::vector<double>> none;
};

// Throws Error with the line of a malformed rule.
ImportMap read_import_map(const std::filesystem::path& file);

// The text with {variable} substituted.
std::string filled(std::string text, const std::string& variable, const std::string& value);

}  // namespace muster::diagnosis
