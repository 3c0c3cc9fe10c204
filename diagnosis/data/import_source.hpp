// The tables that an import reads: one or more files of readings, the parts of their names, and second tables.
// Evaluates the map's references to their columns.
#pragma once

#include <set>
#include <utility>

#include "diagnosis/data/foreign_table.hpp"
#include "diagnosis/data/import_map.hpp"

namespace muster::diagnosis {

// A row of one of the files.
struct SourceRow {
  std::size_t file = 0, row = 0;
};

class ImportSource {
 public:
  // Throws Error for a file that cannot be read or whose name does not fit the map's pattern.
  ImportSource(const std::vector<std::filesystem::path>& files, const ImportMap& map);

  const std::vector<ForeignTable>& files() const { return files_; }
  const ForeignTable& file(const SourceRow& at) const { return files_[at.file]; }
  Place place(const SourceRow& at) const { return file(at).place(at.row); }
  // A text with {variable}, {file} and parts of the file's name filled in.
  std::string filled(std::string text, const SourceRow& at, const std::string& value) const;

  // The number of a cell, or a part of the file's name if the reference is {part}. Empty for a cell without one.
  // `advice` ends the message for a cell that is none.
  std::optional<double> number(const ColumnReference& from, const SourceRow& at, const std::string& value,
                               const Place& rule, const std::string& advice = "");
  // A cell of the files.
  std::string_view text(const std::string& column, const SourceRow& at, const std::string& value, const Place& rule);
  // One or two cells, joined by a blank; empty if one of them is.
  StampCell stamp(const std::string& words, const SourceRow& at, const Place& rule);
  std::vector<std::string> unused_columns() const;

 private:
  std::optional<std::string> part_in_braces(const std::string& text, const SourceRow& at) const;
  std::string column_among(const SourceRow& at, const std::vector<std::string>& these) const;
  std::size_t side_row(const std::string& name, const SourceRow& at, const std::string& value, const Place& rule);
  std::size_t column_of(const ForeignTable& table, const std::string& name, const Place& rule);

  const ImportMap& map_;
  std::vector<ForeignTable> files_;
  std::vector<std::map<std::string, std::string>> parts_;  // of each file's name
  std::map<std::string, ForeignTable> sides_;
  std::map<std::pair<std::string, std::string>, std::size_t> side_rows_;
  std::set<std::string> used_;  // columns of the files
};

}  // namespace muster::diagnosis
