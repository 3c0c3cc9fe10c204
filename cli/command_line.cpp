#include "command_line.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "text/error.hpp"

namespace muster::cli {

using Option = CommandLine::Option;

CommandLine::CommandLine(const std::string& verb, const std::string& help)
    : app_(std::make_unique<CLI::App>(help, verb)) {}
CommandLine::~CommandLine() = default;

Option& Option::required() { return option_->required(), *this; }
Option& Option::shows_default() { return option_->capture_default_str(), *this; }
Option& Option::within(int lowest, int highest) { return option_->check(CLI::Range(lowest, highest)), *this; }
Option& Option::within(double lowest, double highest) { return option_->check(CLI::Range(lowest, highest)), *this; }
Option& Option::one_of(const std::vector<std::string>& values) { return option_->check(CLI::IsMember(values)), *this; }
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

void CommandLine::parse(const Arguments& arguments) {
  try {
    Arguments reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
    app_->parse(reversed);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app_->help());
    throw Helped{};
  } catch (const CLI::ParseError& e) {
    throw Error(Exit::invalid_input,
                fmt::format("muster {}: {}; see muster {} --help", app_->get_name(), e.what(), app_->get_name()));
  }
}

}  // namespace muster::cli
