// Packs a recorded table for the page: rows grouped by robot or radio, columns coded, long tables thinned evenly in
// time.
#pragma once

#include <cstdint>
#include <string>

#include "record_folder.hpp"
#include "text/text_table.hpp"

namespace muster::viewer {

class TableToPack {
 public:
  // Reads the file. Throws Error where it is missing or is not what run.json declares.
  TableToPack(const RecordFolder& record, const RecordedTable& table);

  // Numbers that the page would hold, all rows kept.
  std::uint64_t numbers() const { return numbers_; }
  // Of every so many recorded times one is kept; the description counts them. The first is always kept.
  Json packed(std::uint64_t keep_every, std::string& bytes) const;

 private:
  std::vector<std::size_t> kept_rows(std::uint64_t keep_every) const;
  Factor keys() const;
  Json packed_column(std::size_t column, const std::vector<std::size_t>& rows, std::string& bytes) const;
  bool holds_names(std::size_t column) const;

  const RecordedTable& declared_;
  TextTable text_;
  double tick_;
  std::vector<double> time_;
  std::uint64_t times_ = 0, numbers_ = 0;
  std::vector<bool> is_bytes_;  // a column
};

}  // namespace muster::viewer
