#include "diagnosis/data/file_name_pattern.hpp"

#include <algorithm>

#include "text/names.hpp"

namespace muster::diagnosis {

FileNamePattern::FileNamePattern(const std::string& text, const Place& place) : text_(text), place_(place) {
  std::size_t at = 0;
  for (std::size_t open = text.find('{'); open != text.npos; open = text.find('{', at)) {
    const std::size_t close = text.find('}', open);
    if (close == text.npos) throw invalid(place, quote(text) + " has a '{' without a '}'");
    const std::string name = text.substr(open + 1, close - open - 1);
    if (!is_name(name))
      throw invalid(place, quote(name) + " is no name of a part; expected letters and digits, as in {channel}");
    if (name == "file" || has(name)) throw invalid(place, "the part {" + name + "} stands for something else already");
    if (!names_.empty() && open == at)
      throw invalid(place, "{" + names_.back() + "}{" + name + "} cannot be told apart; expected a text between them");
    literals_.push_back(text.substr(at, open - at));
    names_.push_back(name);
    at = close + 1;
  }
  if (names_.empty()) throw invalid(place, quote(text) + " has no parts; expected such as run_{distance}m.csv");
  literals_.push_back(text.substr(at));
}

bool FileNamePattern::has(const std::string& part) const {
  return std::find(names_.begin(), names_.end(), part) != names_.end();
}

std::map<std::string, std::string> FileNamePattern::parts_of(const std::string& name) const {
  std::map<std::string, std::string> parts;
  if (names_.empty()) return parts;
  const auto misfit = [&] { return invalid(place_, "the file " + quote(name) + " does not fit " + quote(text_)); };
  if (name.compare(0, literals_[0].size(), literals_[0]) != 0) throw misfit();
  std::size_t at = literals_[0].size();
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const std::string& after = literals_[k + 1];
    const bool is_last = k + 1 == names_.size();
    std::size_t end = is_last ? name.size() - std::min(after.size(), name.size()) : name.find(after, at + 1);
    if (end == name.npos || end <= at || name.compare(end, after.size(), after) != 0) throw misfit();
    parts[names_[k]] = name.substr(at, end - at);
    at = end + after.size();
  }
  return parts;
}

}  // namespace muster::diagnosis
