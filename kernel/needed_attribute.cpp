#include "needed_attribute.hpp"

#include <algorithm>
#include <sstream>

#include "text/number.hpp"
#include "world_file/params.hpp"

namespace muster {
namespace {

constexpr std::string_view only_clause = "; only ", with_clause = "with ", without_clause = "without ",
                           below_clause = " below ";

}  // namespace

int find_param(const muster_plugin& plugin, const std::string& name) {
  for (uint32_t i = 0; i < plugin.param_count; ++i) {
    if (name == plugin.params[i].name) return static_cast<int>(i);
  }
  return -1;
}

std::string condition_in(std::string_view help) {
  const auto at = help.rfind(only_clause);
  if (at == help.npos) return "";
  const std::string_view rest = help.substr(at + only_clause.size());
  return rest.substr(0, with_clause.size()) == with_clause || rest.substr(0, without_clause.size()) == without_clause
             ? std::string(rest)
             : "";
}

Needed::Needed(const std::string& condition, const muster_plugin& plugin) {
  is_with_ = condition.compare(0, with_clause.size(), with_clause) == 0;
  std::string rest = condition.substr(is_with_ ? with_clause.size() : without_clause.size());
  if (const auto at = rest.find(below_clause); at != rest.npos) {
    below_ = rest.substr(at + below_clause.size());
    rest.resize(at);
  } else if (const auto equals = rest.find("=\""); equals != rest.npos) {
    std::istringstream choices(rest.substr(equals + 2, rest.size() - equals - 3));
    for (std::string one; std::getline(choices, one, '|');) choices_.push_back(one);
    rest.resize(equals);
  }
  name_ = rest;
  const int number = find_param(plugin, name_);
  if (number < 0) return;
  is_flag_ = plugin.params[number].kind == MUSTER_FLAG;
  is_number_ = plugin.params[number].kind == MUSTER_REAL || plugin.params[number].kind == MUSTER_INTEGER;
}

bool Needed::holds(const muster_plugin& plugin, const std::vector<double>& values,
                   const InstanceDeclaration& declared) const {
  const int number = find_param(plugin, name_);
  if (number < 0) return true;
  const muster_param& param = plugin.params[number];
  const double value = values[static_cast<std::size_t>(number)];
  if (!below_.empty()) return value < parse_real(below_).value_or(0);
  if (!choices_.empty())
    return (std::find(choices_.begin(), choices_.end(), value_text(param, value)) != choices_.end()) == is_with_;
  if (param.kind == MUSTER_REFERENCE) return (value >= 0) == is_with_;
  if (param.kind != MUSTER_TEXT && param.kind != MUSTER_FILE) return (value != 0) == is_with_;
  const XmlAttribute* given = declared.attribute(param.name);
  const bool is_there = given ? !given->value.empty() : param.text && *param.text;
  return is_there == is_with_;
}

std::string Needed::value_wanted() const {
  if (!below_.empty()) return name_ + std::string(below_clause) + below_;
  std::string values;
  for (std::size_t i = 0; i < choices_.size(); ++i)
    values += (i == 0 ? name_ + '=' : i + 1 == choices_.size() ? " or " : ", ") + ('"' + choices_[i] + '"');
  if (!values.empty()) return values;
  return is_number_ ? name_ + " above 0" : name_ + (is_flag_ ? "=\"true\"" : "=\"...\"");
}

std::string Needed::where_not() const { return is_with_ ? "without " + value_wanted() : "beside " + name_; }

std::string Needed::wanted() const { return is_with_ ? value_wanted() + " beside it" : "one of the two: no " + name_; }

}  // namespace muster
