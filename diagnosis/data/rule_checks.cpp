#include "diagnosis/data/rule_checks.hpp"

#include <algorithm>

#include "diagnosis/data/dataset.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/unit_words.hpp"

namespace muster::diagnosis {

void refuse_quoted_column(const ColumnRule& rule, const std::vector<ForeignTable>& files) {
  if (!rule.is_name || rule.name.empty()) return;
  for (const ForeignTable& table : files) {
    if (!table.has(rule.name)) continue;
    const std::size_t column = table.require(rule.name, rule.place);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.text(row, column).empty() || parse_real(table.text(row, column))) continue;
      throw invalid(rule.place, quote(rule.name) + " in quotes is the same name in all rows, and " + table.file() +
                                    " has a column " + rule.name + ", with names such as " +
                                    quote(table.text(row, column)) + "; expected " + rule.column.name + " = name " +
                                    rule.name + ", or another name");
    }
  }
}

void refuse_exchanged(const ColumnRule& rule, const std::vector<ForeignTable>& files) {
  const std::string& right = rule.text;
  const auto ours = reading_columns().find(right.substr(0, right.find('[')));
  const auto has = [&](const std::string& column) {
    return std::any_of(files.begin(), files.end(), [&](const auto& table) { return table.has(column); });
  };
  if (ours == reading_columns().end() || ours->second.empty() || has(right) || !has(rule.column.label()) ||
      right != TextColumn{ours->first, ours->second}.label())
    return;
  throw invalid(rule.place, "the rule is the wrong way round: a column of the result stands on the left, and one of " +
                                files[0].file() + " on the right; expected " + right + " = " + rule.column.label());
}

std::string in_our_unit(const ColumnRule& rule, const std::string& unit) {
  const double factor = rule.column.unit.empty() ? 1 : in_unit(unit, "1" + rule.column.unit).value_or(1);
  const bool is_plain = rule.number && rule.number->offset == 0 && !rule.number->logarithm;
  if (factor == 1 || !is_plain || rule.number->from.column.empty()) return ", and SCALE*COLUMN where that differs";
  const ColumnReference& from = rule.number->from;
  return ": " + TextColumn{rule.column.name, unit}.label() + " = " + print_real(factor * rule.number->scale) + '*' +
         (from.table.empty() ? "" : from.table + '.') + from.column;
}

}  // namespace muster::diagnosis
