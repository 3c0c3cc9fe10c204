#include "exam/arguments.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace muster::exam {

namespace {

// A word that no option takes: it may be the value of the first option that is missing, "exam" of --answers exam.
std::string one_word_too_many(const std::string& word, const Arguments& known, const Arguments& given) {
  const auto missing = std::find_if(known.begin(), known.end(), [&](const auto& option) {
    return option.second.size() == 1 && !given.contains(option.first);
  });
  return "\"" + word + "\" is one word too many" +
         (missing == known.end() ? "; expected options alone" : "; did you mean " + missing->first + ' ' + word + "?");
}

// Of an option of several values that has some: " behind the least: --rows 2000 2000".
std::string too_few(const std::string& option, std::size_t given, const std::vector<std::string>& names,
                    const std::vector<std::string>& values) {
  if (given == 0) return "";
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i) words += ' ' + values[std::min(i, given - 1)];
  return " behind " + names[given - 1] + ": " + option + words;
}

}  // namespace

Arguments parsed(int argc, char** argv, const Arguments& known) {
  Arguments result;
  for (int i = 2; i < argc; ++i) {
    const std::string option = argv[i];
    if (option[0] != '-' && known.contains("")) {
      result[""].push_back(option);
      continue;
    }
    const auto spec = known.find(option);
    if (spec == known.end()) {
      std::vector<std::string> names;
      for (const auto& [name, values] : known)
        if (!name.empty()) names.push_back(name);
      if (option[0] != '-') throw std::invalid_argument(one_word_too_many(option, known, result));
      throw std::invalid_argument("there is no option " + option + "; " + expected(option, names));
    }
    if (result.contains(option)) throw std::invalid_argument(option + " is given more than once; expected it once");
    auto& values = result[option];
    for (std::size_t k = 0; k < spec->second.size(); ++k) {
      if (++i >= argc || (k > 0 && known.contains(argv[i]) && *argv[i]))
        throw std::invalid_argument(option + " needs " + spec->second[k] + too_few(option, k, spec->second, values));
      values.push_back(argv[i]);
    }
  }
  return result;
}

std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> result(1);
  for (const char c : text) {
    if (c == ',')
      result.emplace_back();
    else
      result.back() += c;
  }
  return result;
}

std::string expected(const std::string& given, const std::vector<std::string>& known) {
  // Typing errors between both: letters lost, added or changed.
  const auto errors = [&](const std::string& word) {
    std::vector<std::size_t> row(word.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < given.size(); ++i) {
      std::size_t before = row[0]++;
      for (std::size_t k = 0; k < word.size(); ++k)
        before = std::exchange(row[k + 1], std::min({row[k] + 1, row[k + 1] + 1, before + (given[i] != word[k])}));
    }
    return row.back();
  };
  std::string result = fmt::format("expected one of {}", fmt::join(known, ", "));
  const auto near =
      std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) { return errors(a) < errors(b); });
  if (near != known.end() && 3 * errors(*near) <= given.size()) result += "; did you mean \"" + *near + "\"?";
  return result;
}

void one_of(const std::string& what, const std::string& given, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), given) == known.end())
    throw std::invalid_argument(fmt::format("{} is {}, not \"{}\"", what, fmt::join(known, ", "), given));
}

const std::string& required(const Arguments& arguments, const std::string& option) {
  const auto at = arguments.find(option);
  if (at == arguments.end()) throw std::invalid_argument(option + " is missing");
  return at->second[0];
}

}  // namespace muster::exam
