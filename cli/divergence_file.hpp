// How runs diverge over time, as a table: `t[s],run,table,row,quantity,unit,difference`, one line a number that has
// begun to differ.
#pragma once

#include "divergence.hpp"
#include "text/text_table_writer.hpp"

namespace muster {

class DivergenceFile {
 public:
  explicit DivergenceFile(const std::filesystem::path& path)
      : writer_(
            path,
            {{"t", "s"}, {"run", ""}, {"table", ""}, {"row", ""}, {"quantity", ""}, {"unit", ""}, {"difference", ""}}) {
  }

  void write(const std::string& run, double time, const Divergence& divergence) {
    for (const auto& [name, table] : divergence.tables()) {
      for (const auto& [row, courses] : table.rows) {
        for (std::size_t m = 0; m < courses.size(); ++m) {
          if (courses[m].first == Course::never) continue;
          writer_.real(time);
          for (const std::string& text : {run, name, row, table.measures[m].name, table.measures[m].unit})
            writer_.text(text);
          writer_.real(courses[m].at(divergence.tick()));
          writer_.end_row();
        }
      }
    }
  }
  void close() { writer_.close(); }

 private:
  TextTableWriter writer_;
};

}  // namespace muster
