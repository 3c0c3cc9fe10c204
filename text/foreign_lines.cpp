#include "foreign_lines.hpp"

#include <regex>

namespace muster {

void refuse_foreign(const std::string& first, const std::string& second, const Place& place) {
  const std::size_t mark = first.find_first_of(";\t");
  if (mark == first.npos) return;
  const bool is_tab = first[mark] == '\t';
  static const std::regex decimal_comma("(^|[;\t])[+-]?[0-9]+,[0-9]+");
  const bool has_decimal_comma = std::regex_search(second, decimal_comma);
  const std::string separator = is_tab ? "tabs" : "';'", word = is_tab ? "s/\\t/,/g" : "s/;/,/g";
  throw invalid(place,
                "cells stand between " + separator + (has_decimal_comma ? ", and numbers have decimal commas" : "") +
                    "; expected ',' between cells and '.' in numbers: sed '" + (has_decimal_comma ? "s/,/./g; " : "") +
                    word + "' FILE makes them so (readings: muster import FILE --map MAP --out FILE" +
                    (has_decimal_comma ? ", with decimal = comma in the map)" : ")"));
}

bool is_comment(std::string_view text) {
  return text.starts_with('#') || text.starts_with('%') || text.starts_with("//");
}

}  // namespace muster
