// The words after a verb. A verb declares the options it takes; messages and --help follow from that. The parser's own
// header costs seconds in each file that includes it: command_line.cpp alone does.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "text/error.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace muster::cli {

using Arguments = std::vector<std::string>;

class CommandLine {
 public:
  CommandLine(const std::string& verb, const std::string& help);
  ~CommandLine();

  class Option {
   public:
    explicit Option(CLI::Option* option) : option_(option) {}
    Option& required();
    Option& shows_default();  // in --help: the value of the variable as it is now
    Option& within(int lowest, int highest);
    Option& within(double lowest, double highest);
    Option& at_least(int lowest);  // an integer
    Option& one_of(const std::vector<std::string>& values);
    Option& takes(int words);
    Option& one_word_each();  // may be given several times; the words of a verb may follow it
    Option& excludes(const std::string& other);

   private:
    CLI::Option* option_;
  };

  // "--data", or "world" where the word stands alone. parse() fills the variable if the option is given.
  Option option(const std::string& name, std::string& variable, const std::string& help);
  Option option(const std::string& name, std::optional<std::string>& variable, const std::string& help);
  Option option(const std::string& name, std::vector<std::string>& variable, const std::string& help);
  Option option(const std::string& name, int& variable, const std::string& help);
  Option option(const std::string& name, std::vector<int>& variable, const std::string& help);
  Option option(const std::string& name, uint64_t& variable, const std::string& help);
  Option option(const std::string& name, double& variable, const std::string& help);
  Option flag(const std::string& name, bool& variable, const std::string& help);

  // Refuses `option` where `other` is not given, or has another value: it would do nothing.
  void only_with(const std::string& option, const std::string& other, const std::string& value = "");
  // Refuses each of `options` where the flag or option `other` is given, which makes it void: "runs no tick".
  void void_beside(const std::string& other, const std::vector<std::string>& options, const std::string& why);

  // Throws Error where the words are off, Helped where only help was asked for.
  void parse(const Arguments& arguments);

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  void check_effects() const;

  // An option that has no effect beside another, or without it.
  struct Effect {
    std::string option, other, value, why;
    bool needs_other;
  };
  std::vector<Effect> effects_;

  std::unique_ptr<CLI::App> app_;
};

struct Helped {};

// An option that the verb has not. Another verb may have it, which only the program knows.
class UnknownOption : public Error {
 public:
  // `remedy`: what the verb knows itself, the option that is meant or those that it has. `is_guess`: which gives way to
  // another verb that has the option.
  UnknownOption(std::string of_verb, std::string name, const std::string& remedy, bool is_guess, std::string valid);
  // The same of an option that these other verbs have.
  Error of_others(const std::string& verbs) const;

  const std::string verb, option;
  const bool is_guess;

 private:
  const std::string valid_;
};

// What a verb declares, as data: for the manual page, and for what a shell completes.
struct DeclaredOption {
  std::vector<std::string> names;  // "-o", "--out"; a word such as "world" for one that stands alone
  std::string value;               // "TEXT", "INT:INT in [1 - 256]"; empty for a flag
  std::string help;
  std::vector<std::string> choices;  // empty: any
  bool is_alone = false, is_required = false;
};

struct DeclaredVerb {
  std::string name, summary, help, usage;
  std::vector<DeclaredOption> options;
};

// Runs a verb up to its parse(), which then declares instead.
DeclaredVerb declared(int (*verb)(const Arguments&));

}  // namespace muster::cli
