#include "diagnosis/prediction/free_parameters.hpp"

#include <algorithm>
#include <utility>

#include "text/comma_list.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/params.hpp"

namespace muster::diagnosis {
namespace {

bool contains(const std::vector<std::string>& list, const std::string& path) {
  return std::find(list.begin(), list.end(), path) != list.end();
}

// Sets the parameters that came with a value; returns the paths to hold.
std::vector<std::string> held_paths(MeasuredWorld& model, const std::vector<std::string>& fix) {
  std::vector<std::string> paths;
  for (const std::string& word : fix) {
    const std::size_t equals = word.find('=');
    const std::string path = word.substr(0, equals);
    model.parameter(path);  // throws with the nearest path
    if (equals != word.npos) {
      const std::string text = word.substr(equals + 1);
      const auto value = parse_real(text);
      if (!value) throw Error(Exit::invalid_input, "--fix " + path + ": " + why_not_real(text));
      model.set(path, *value);
    }
    paths.push_back(path);
  }
  return paths;
}

bool may_be_fitted(const ParameterInfo& info) {
  return info.declared->kind == MUSTER_REAL && info.declared->max > info.declared->min;
}

void refuse_unfit(const ParameterInfo& info, const MeasuredWorld& model) {
  if (may_be_fitted(info)) return;
  const uint32_t kind = info.declared->kind;
  const std::string what = kind == MUSTER_CHOICE    ? "a choice of " + expectation(*info.declared).substr(7)
                           : kind == MUSTER_FLAG    ? "a flag, true or false"
                           : kind == MUSTER_INTEGER ? "an integer"
                                                    : "a number with one value alone";
  std::vector<std::string> valid;
  for (const ParameterInfo& each : model.parameters())
    if (may_be_fitted(each) && (each.declared->flags & MUSTER_FREE)) valid.push_back(each.path);
  throw Error(Exit::invalid_input, "--free " + info.path + ": it is " + what + ", which no fit moves; " +
                                       (valid.empty() ? "expected a real number" : expected_one_of(valid)) +
                                       " (--fix " + info.path + "=VALUE holds it)");
}

}  // namespace

std::vector<FitParameter> free_parameters(MeasuredWorld& model, const FitOptions& options) {
  for (const auto& [option, paths] : {std::pair("--free", options.free), {"--fix", options.fix}}) {
    for (const std::string& path : paths)
      if (const std::string each = once_each(option, path); !each.empty())
        throw Error(Exit::invalid_input, std::string(option) + " takes one parameter each time; expected " + each);
  }
  const std::vector<std::string> held = held_paths(model, options.fix);
  for (const std::string& path : options.free) {
    refuse_unfit(model.parameter(path), model);
    if (contains(held, path))
      throw Error(Exit::invalid_input, quote(path) + " is both free and fixed; expected one of them");
  }
  std::vector<FitParameter> result;
  for (const ParameterInfo& info : model.parameters()) {
    const bool declared = (info.declared->flags & MUSTER_FREE) && info.declared->kind == MUSTER_REAL;
    if ((!declared && !contains(options.free, info.path)) || contains(held, info.path)) continue;
    FitParameter p{.path = info.path, .unit = info.declared->unit};
    p.start = info.value;
    p.lower = info.declared->min;
    p.upper = info.declared->max;
    result.push_back(p);
  }
  if (result.empty() && held.empty() && options.free.empty())
    throw Error(Exit::invalid_input,
                "no parameter is free: no part of the world's radio channel has one; expected one that does, such as "
                "<radio.multiwall/>, or --free PATH");
  if (result.empty()) throw Error(Exit::invalid_input, "no parameter is free; expected one, such as by --free PATH");
  return result;
}

}  // namespace muster::diagnosis
