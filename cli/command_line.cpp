#include "command_line.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/synonyms.hpp"

namespace muster::cli {

using Option = CommandLine::Option;

namespace {

DeclaredVerb* declare_to = nullptr;  // while declared() runs

// Refuses with the nearest valid value.
CLI::Validator one_of_these(const std::vector<std::string>& values) {
  const auto check = [values](const std::string& given) {
    const bool is_there = std::find(values.begin(), values.end(), given) != values.end();
    return is_there ? std::string() : "there is no " + quote(given) + "; " + suggest(given, values);
  };
  return CLI::Validator(check, "{" + CLI::detail::join(values, ",") + "}");
}

// Refuses with the bounds, and keeps CLI11's words for them in --help.
CLI::Validator between(double lowest, double highest, bool is_integer, const std::string& words) {
  const auto check = [=](const std::string& given) -> std::string {
    const auto whole = parse_integer(given);
    const auto value =
        is_integer ? (whole ? std::optional(static_cast<double>(*whole)) : std::nullopt) : parse_real(given);
    if (value && *value >= lowest && *value <= highest) return "";
    const std::string what = value        ? given + " is out of bounds"
                             : is_integer ? why_not_integer(given)
                                          : why_not_real(given);
    const std::string end = std::isinf(highest) ? "" : " to " + print_real(highest);
    return what + "; expected " + (is_integer ? "an integer" : "a number") + " from " + print_real(lowest) + end;
  };
  return CLI::Validator(check, words);
}

// Of "TEXT:{a,b}".
std::vector<std::string> choices_of(const std::string& type) {
  const auto open = type.find(":{");
  if (open == type.npos || type.back() != '}') return {};
  return CLI::detail::split(type.substr(open + 2, type.size() - open - 3), ',');
}

DeclaredOption data_of(const CLI::Option& option) {
  DeclaredOption result;
  result.is_alone = option.get_positional();
  for (const auto& name : option.get_snames()) result.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) result.names.push_back("--" + name);
  if (result.names.empty()) result.names.push_back(option.get_name(true));
  if (option.get_items_expected_max() > 0) result.value = option.get_type_name();
  result.help = option.get_description();
  result.choices = choices_of(option.get_type_name());
  result.is_required = option.get_required();
  return result;
}

// "--port, --address and --token"
std::string all_of(const std::vector<std::string>& options) {
  std::string result;
  for (std::size_t i = 0; i < options.size(); ++i)
    result += (i == 0 ? "" : i + 1 == options.size() ? " and " : ", ") + options[i];
  return result;
}

// `[OPTIONS] world`
std::string usage_of(const std::vector<DeclaredOption>& options) {
  std::string result = "[OPTIONS]";
  for (const auto& option : options) {
    if (option.is_alone) result += option.is_required ? " " + option.names[0] : " [" + option.names[0] + "]";
  }
  return result;
}

// "until=5" for --until 5, as is ROS's "until:=5"; "--set steer/speed 0.1" for steer/speed=0.1.
std::string too_many(const CLI::App& app, const std::string& word) {
  std::string hint;
  const auto equals = word.find('='), ros = word.find(":=");
  const bool is_ros = ros != word.npos;
  const std::string name = "--" + word.substr(0, is_ros ? ros : equals);
  if (is_ros) {
    std::vector<std::string> options;
    for (const CLI::Option* each : app.get_options())
      for (const auto& long_name : each->get_lnames()) options.push_back("--" + long_name);
    const std::string key = word.substr(0, ros), value = word.substr(ros + 2);
    const bool is_there = std::find(options.begin(), options.end(), name) != options.end();
    const std::string near = did_you_mean(name, options);
    const bool may_set = std::find(options.begin(), options.end(), "--set") != options.end();
    return quote(word) + " is an argument of ROS, which muster has not" +
           (is_there        ? "; did you mean " + name + ' ' + value + "?"
            : !near.empty() ? near + " (" + name.substr(2) + " is no option)"
            : may_set       ? "; expected options, and parameters of plugins as --set PATH=VALUE, such as --set " +
                            (key.find('/') == key.npos ? "INSTANCE/" + key : key) + '=' + value
                      : "; expected options such as --help");
  }
  for (const CLI::Option* each : app.get_options()) {
    if (each->check_name("--set") && each->count() > 0 && each->results().back().find('=') == std::string::npos)
      hint = "; did you mean --set " + each->results().back() + "=" + word + "?";
    if (word.find('=') != std::string::npos && each->check_name(name))
      hint = "; did you mean " + name + " " + word.substr(word.find('=') + 1) + "?";
  }
  if (hint.empty() && app.get_name() == "run" && word.ends_with(".xml"))
    hint = ": run takes one world; muster compare A B runs two";
  return quote(word) + " is one word too many" + hint;
}

// Behind the refusal of a number with a fraction where things are counted: what is counted.
std::string counted(CLI::App& app, const std::string& refusal) {
  if (refusal.find("is not an integer; ") == refusal.npos || refusal.find("follows the number") == refusal.npos)
    return "";
  const CLI::Option* option = app.get_option_no_throw(refusal.substr(0, refusal.find(':')));
  return option && !option->get_description().empty() ? ": " + option->get_description() : "";
}

// The option that is meant: by a word of others, or by its letters without the dashes, which all options share.
std::string meant_option(const std::string& given, const std::vector<std::string>& valid) {
  if (const std::string same = synonym(given, valid); !same.empty()) return "; did you mean " + quote(same) + "?";
  std::vector<std::string> names;
  for (const std::string& each : valid) names.push_back(each.substr(2));
  const std::string near = did_you_mean(given.substr(std::min(given.find_first_not_of('-'), given.size())), names);
  const auto open = near.find('"');
  return open == near.npos ? "" : near.substr(0, open + 1) + "--" + near.substr(open + 1);
}

// Of an option such as --step 0.002 or --step=0.002: it may be meant as an attribute of a plugin.
std::string as_attribute(const CLI::App& app, const std::vector<std::string>& words, const std::string& option) {
  const auto equals = option.find('=');
  std::string name = option.substr(0, equals), value = equals == option.npos ? "" : option.substr(equals + 1);
  name = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::replace(name.begin(), name.end(), '-', '_');
  const CLI::Option* attributes = app.get_option_no_throw("attributes");
  if (name.size() < 2 || (!attributes && !app.get_option_no_throw("--set"))) return "";
  std::vector<std::string> values(std::find(words.begin(), words.end(), option), words.end());
  if (!values.empty()) values.erase(values.begin());
  if (attributes) values.insert(values.end(), attributes->results().begin(), attributes->results().end());
  const auto given = std::find_if(values.begin(), values.end(), [](const std::string& word) {
    return !word.starts_with("--") && word.find('=') == word.npos;
  });
  if (value.empty()) value = given == values.end() ? "VALUE" : *given;
  const CLI::Option* world = name == "world" ? app.get_option_no_throw("world") : nullptr;
  if (world && !world->results().empty()) value = world->results()[0];  // what stands behind the option, taken as it
  if (world) return "the world stands without an option: muster " + app.get_name() + ' ' + value;
  return (attributes ? "attributes of the new plugin are words without dashes: "
                     : "a parameter of a plugin or of the world is --set INSTANCE/") +
         name + '=' + value;
}

// What is wrong with words that no option takes.
std::string unexpected(const CLI::App& app) {
  const auto words = app.remaining();
  const auto option = std::find_if(words.begin(), words.end(), [](const std::string& w) { return w.starts_with("-"); });
  if (option == words.end()) return too_many(app, words.empty() ? "" : words.back());
  std::vector<std::string> valid;
  for (const CLI::Option* each : app.get_options()) {
    for (const auto& name : each->get_lnames()) valid.push_back("--" + name);
  }
  const std::string given = option->substr(0, option->find('='));
  const std::string all = expected_one_of(valid), meant = meant_option(given, valid);
  if (!meant.empty()) throw UnknownOption(app.get_name(), given, meant.substr(2) + ' ' + all, false, all);
  const std::string attribute = as_attribute(app, words, *option);
  throw UnknownOption(app.get_name(), given, attribute.empty() ? all : attribute,
                      app.get_option_no_throw("attributes") == nullptr, all);
}

// "; did you mean --from 3 2?" of --from 3,2: numbers of one option that are parted by other signs than blanks. `words`
// begins with their number.
std::string parted_by_commas(const Arguments& arguments, const std::string& option, const std::string& words) {
  const auto given = std::find(arguments.begin(), arguments.end(), option);
  if (given == arguments.end() || std::next(given) == arguments.end()) return "";
  std::string meant, word;
  std::int64_t count = 0;
  for (const char c : *std::next(given) + ' ') {
    const bool parts = std::string_view(" ,;:").find(c) != std::string_view::npos;
    if (!parts) word += c;
    if (!parts || word.empty()) continue;
    meant += ' ' + std::exchange(word, "");
    ++count;
  }
  return parse_integer(words.substr(0, words.find(' '))) == count ? "; did you mean " + option + meant + "?" : "";
}

// `; --wide takes "hall.xml"; expected hall.xml --wide TEXT` where an option took the missing world for its value.
std::string taken_by_an_option(const CLI::App& app) {
  for (const CLI::Option* each : app.get_options()) {
    if (each->get_positional() || each->count() == 0 || !each->results().back().ends_with(".xml")) continue;
    const std::string name = each->get_name(), word = each->results().back();
    return "; " + name + " takes " + quote(word) + "; expected " + word + ' ' + name + ' ' + each->get_type_name();
  }
  return "";
}

}  // namespace

UnknownOption::UnknownOption(std::string of_verb, std::string name, const std::string& remedy, bool is_guess_,
                             std::string valid)
    : Error(Exit::invalid_input, fmt::format("muster {}: there is no option {}; {}; see muster {} --help", of_verb,
                                             quote(name), remedy, of_verb)),
      verb(std::move(of_verb)),
      option(std::move(name)),
      is_guess(is_guess_),
      valid_(std::move(valid)) {}

Error UnknownOption::of_others(const std::string& verbs) const {
  return {exit(), fmt::format("muster {}: there is no option {} (an option of {}); {}; see muster {} --help", verb,
                              quote(option), verbs, valid_, verb)};
}

CommandLine::CommandLine(const std::string& verb, const std::string& help)
    : app_(std::make_unique<CLI::App>(help, verb)) {}
CommandLine::~CommandLine() = default;

Option& Option::required() { return option_->required(), *this; }
Option& Option::shows_default() { return option_->capture_default_str(), *this; }
Option& Option::within(int lowest, int highest) {
  return option_->check(between(lowest, highest, true, CLI::Range(lowest, highest).get_description())), *this;
}
Option& Option::within(double lowest, double highest) {
  return option_->check(between(lowest, highest, false, CLI::Range(lowest, highest).get_description())), *this;
}
Option& Option::at_least(int lowest) {
  return option_->check(between(lowest, std::numeric_limits<double>::infinity(), true, "")), *this;
}
Option& Option::one_of(const std::vector<std::string>& values) { return option_->check(one_of_these(values)), *this; }
Option& Option::takes(int words) { return option_->expected(words), *this; }
Option& Option::one_word_each() { return option_->allow_extra_args(false), *this; }
Option& Option::excludes(const std::string& other) { return option_->excludes(other), *this; }

Option CommandLine::option(const std::string& name, std::string& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::option(const std::string& name, std::optional<std::string>& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::option(const std::string& name, std::vector<std::string>& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::option(const std::string& name, int& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::option(const std::string& name, std::vector<int>& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::option(const std::string& name, uint64_t& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::option(const std::string& name, double& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
Option CommandLine::flag(const std::string& name, bool& variable, const std::string& help) {
  return Option(app_->add_flag(name, variable, help));
}

void CommandLine::refuse(const std::string& what) const {
  throw Error(Exit::invalid_input,
              fmt::format("muster {}: {}; see muster {} --help", app_->get_name(), what, app_->get_name()));
}

void CommandLine::only_with(const std::string& option, const std::string& other, const std::string& value) {
  effects_.push_back({option, other, value, "", true});
}

void CommandLine::void_beside(const std::string& other, const std::vector<std::string>& options,
                              const std::string& why) {
  for (const std::string& option : options) effects_.push_back({option, other, "", why, false});
}

void CommandLine::check_effects() const {
  const auto is_void = [&](const Effect& effect) {
    if (app_->get_option(effect.option)->count() == 0) return false;
    const CLI::Option& other = *app_->get_option(effect.other);
    const bool is_there = other.count() > 0 && (effect.value.empty() || other.results().back() == effect.value);
    return is_there != effect.needs_other;
  };
  const auto first = std::find_if(effects_.begin(), effects_.end(), is_void);
  if (first == effects_.end()) return;
  std::vector<std::string> given;  // all that are void for the same reason, and no other
  for (const Effect& effect : effects_) {
    const bool is_alike = std::tie(effect.other, effect.value, effect.why, effect.needs_other) ==
                          std::tie(first->other, first->value, first->why, first->needs_other);
    if (is_alike && is_void(effect)) given.push_back(effect.option);
  }
  const std::string beside = first->other + (first->value.empty() ? "" : ' ' + first->value);
  const bool is_one = given.size() == 1;
  const std::string who = all_of(given) + (is_one ? " has" : " have");
  if (first->needs_other)
    refuse(who + " no effect without " + beside + "; expected " + beside + " beside " +
           (is_one ? "it, or no " + given[0] : "them, or none of them"));
  refuse(who + " no effect beside " + beside + ", which " + first->why + "; expected one of the two");
}

void CommandLine::parse(const Arguments& arguments) {
  if (declare_to) {
    declare_to->name = app_->get_name();
    declare_to->help = app_->get_description();
    for (const CLI::Option* option : app_->get_options()) declare_to->options.push_back(data_of(*option));
    declare_to->usage = usage_of(declare_to->options);
    throw Helped{};
  }
  try {
    Arguments reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
    app_->parse(reversed);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app_->help());
    throw Helped{};
  } catch (const CLI::ExtrasError&) {
    refuse(unexpected(*app_));
  } catch (const CLI::RequiredError& e) {
    const std::string what = e.what(), option = what.substr(0, what.find(' '));
    const auto words = app_->remaining();
    if (words.size() == 1 && option.starts_with("--") && !words[0].starts_with("-"))
      refuse(quote(words[0]) + " is one word too many, and " + option + " is missing; did you mean " + option + " " +
             words[0] + "?");
    const CLI::Option* missing = app_->get_option_no_throw(option);
    refuse(what + (missing && !missing->get_description().empty() ? ": " + missing->get_description() : "") +
           (option == "world" ? taken_by_an_option(*app_) : ""));
  } catch (const CLI::ArgumentMismatch& e) {
    const std::string what = e.what();
    const auto once = what.find(": At Most 1 required");
    if (const auto missing = what.find(": 1 required"); missing != what.npos)
      refuse(what.substr(0, missing) + " has no value; expected one behind it");
    if (const auto few = what.find(": At least "); few != what.npos) {
      const auto got = what.find(" required but received ");
      if (got != what.npos)
        refuse(what.substr(0, few) + ": expected " + what.substr(few + 11, got - few - 11) + " words, not " +
               what.substr(got + 23) + parted_by_commas(arguments, what.substr(0, few), what.substr(few + 11)));
    }
    refuse(once == what.npos ? what : what.substr(0, once) + " is given more than once; expected one value");
  } catch (const CLI::ParseError& e) {
    refuse(e.what() + counted(*app_, e.what()));
  }
  for (const CLI::Option* option : app_->get_options()) {
    const auto& given = option->results();
    if (std::any_of(given.begin(), given.end(), [](const std::string& word) { return word.empty(); }))
      refuse(option->get_name() + " has an empty value; expected one behind it");
  }
  check_effects();
}

DeclaredVerb declared(int (*verb)(const Arguments&)) {
  DeclaredVerb result;
  declare_to = &result;
  try {
    verb({});
  } catch (const Helped&) {
  }
  declare_to = nullptr;
  return result;
}

}  // namespace muster::cli
