#include "exam/arguments.hpp"

#include <algorithm>

namespace muster::exam {

Arguments parsed(int argc, char** argv, const Arguments& known) {
  Arguments result;
  for (int i = 2; i < argc; ++i) {
    const std::string option = argv[i];
    if (option[0] != '-' && known.contains("")) {
      result[""].push_back(option);
      continue;
    }
    const auto spec = known.find(option);
    if (spec == known.end()) throw std::invalid_argument("no option is called " + option);
    auto& values = result[option];
    for (std::size_t k = 0; k < spec->second.size(); ++k) {
      if (++i >= argc) throw std::invalid_argument(option + " needs " + spec->second[k]);
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

void one_of(const std::string& what, const std::string& given, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), given) == known.end())
    throw std::invalid_argument(fmt::format("a {} is {}, not \"{}\"", what, fmt::join(known, ", "), given));
}

const std::string& required(const Arguments& arguments, const std::string& option) {
  const auto at = arguments.find(option);
  if (at == arguments.end()) throw std::invalid_argument(option + " is missing");
  return at->second[0];
}

}  // namespace muster::exam
