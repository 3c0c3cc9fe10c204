// Options of the program's command line.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace muster::exam {

using Arguments = std::map<std::string, std::vector<std::string>>;

// Parses options among the known ones, each with its values; "" holds the words outside any option. All of these
// functions throw std::invalid_argument.
Arguments parsed(int argc, char** argv, const Arguments& known);
// Parts between commas.
std::vector<std::string> listed(const std::string& text);
// The known words, and the one that was meant.
std::string expected(const std::string& given, const std::vector<std::string>& known);
void one_of(const std::string& what, const std::string& given, const std::vector<std::string>& known);
const std::string& required(const Arguments& arguments, const std::string& option);

// The value of an option, which messages name.
template <class Number>
Number number(const std::string& option, const std::string& text, Number least, Number most) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most))
    throw std::invalid_argument(fmt::format("{}: \"{}\" is not {} from {} to {}", option, text,
                                            std::is_integral_v<Number> ? "an integer" : "a number", least, most));
  return value;
}

}  // namespace muster::exam
