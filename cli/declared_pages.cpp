#include "declared_pages.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace muster::cli {
namespace {

// Text that roff prints as it is: . and ' command at the beginning of a line, a bare - is no hyphen of an option.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

// Lines as they stand.
std::string verbatim(const std::string& text) {
  std::string result = ".nf\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) result += roff(line) + '\n';
  return result + ".fi\n";
}

// Help is prose up to its examples.
std::string described(const std::string& help) {
  const auto examples = help.find("Example:");
  std::string prose = help.substr(0, examples);
  while (!prose.empty() && prose.back() == '\n') prose.pop_back();
  std::string result = prose.empty() ? "" : roff(prose) + '\n';
  if (examples != help.npos) result += ".PP\n" + verbatim(help.substr(examples));
  return result;
}

std::string manual_entry(const DeclaredOption& option) {
  std::string names;
  for (const auto& name : option.names) names += (names.empty() ? "" : ", ") + roff(name);
  return fmt::format(".TP\n\\fB{}\\fR{}{}\n{}\n", names,
                     option.value.empty() ? "" : " \\fI" + roff(option.value) + "\\fR",
                     option.is_required ? " (required)" : "", roff(option.help));
}

// Every option of a verb, and no word that stands alone.
std::vector<std::string> options_of(const DeclaredVerb& verb) {
  std::vector<std::string> result;
  for (const auto& option : verb.options) {
    if (!option.is_alone) result.insert(result.end(), option.names.begin(), option.names.end());
  }
  return result;
}

// Values behind an option, and for the first word after the verb.
std::string completed_choices(const DeclaredVerb& verb) {
  std::string result;
  bool is_first = true;
  for (const auto& option : verb.options) {
    const bool is_first_word = option.is_alone && is_first;
    if (option.is_alone) is_first = false;
    if (option.choices.empty()) continue;
    if (!option.is_alone)
      result += fmt::format("      case $before in {}) choices=\"{}\" ;; esac\n", fmt::join(option.names, "|"),
                            fmt::join(option.choices, " "));
    else if (is_first_word)
      result += fmt::format("      ((COMP_CWORD == 2)) && choices=\"{}\"\n", fmt::join(option.choices, " "));
  }
  return result;
}

}  // namespace

std::string manual_page(const std::vector<DeclaredVerb>& verbs, const std::string& summary,
                        const std::string& version) {
  std::string page = fmt::format(
      ".TH MUSTER 1 \"\" \"muster {}\" \"User Commands\"\n.SH NAME\nmuster \\- {}\n.SH SYNOPSIS\n"
      ".B muster\n.I VERB\n.RI [ OPTIONS ]\n.SH VERBS\n",
      roff(version), roff(summary));
  for (const auto& verb : verbs) page += fmt::format(".TP\n.B {}\n{}\n", roff(verb.name), roff(verb.summary));
  for (const auto& verb : verbs) {
    page += fmt::format(".SH MUSTER {}\n", roff(verb.name));
    if (verb.usage.empty()) {
      page += verbatim(verb.help);
      continue;
    }
    page += fmt::format(".B muster {}\n{}\n.PP\n{}", roff(verb.name), roff(verb.usage), described(verb.help));
    for (const auto& option : verb.options) page += manual_entry(option);
  }
  return page +
         ".SH ENVIRONMENT\n.TP\n.B MUSTER_PLUGIN_PATH\n"
         "Folders of plugins, separated by colons, looked in before the program's own.\n"
         ".SH FILES\n.TP\n.I lib/muster/plugins\nBelow the prefix of the installation: its plugins and models of "
         "robots.\n"
         ".TP\n.I share/muster/worlds\nWorlds to begin with.\n"
         ".TP\n.I share/muster/templates\nWhat muster new makes projects of.\n";
}

std::string bash_completion(const std::vector<DeclaredVerb>& verbs) {
  std::string names, cases;
  for (const auto& verb : verbs) {
    names += verb.name + ' ';
    cases += fmt::format("    {})\n      options=\"{}\"\n{}      ;;\n", verb.name, fmt::join(options_of(verb), " "),
                         completed_choices(verb));
  }
  return "# Completion of bash for muster, as `muster --completion bash` prints it.\n"
         "_muster() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options='' choices=''\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"" +
         names +
         "--help --version --man --completion\" -- \"$current\")\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "    --completion) choices=bash ;;\n"
         "  esac\n"
         "  if [[ $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "  elif [[ -n $choices ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$choices\" -- \"$current\")\n"
         "  else\n"
         "    compopt -o filenames 2>/dev/null\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  fi\n"
         "}\n"
         "complete -F _muster muster\n";
}

DeclaredVerb declared_by_help(const std::string& name, const std::string& program, const std::string& help) {
  DeclaredVerb verb{name, {}, help, {}, {}};
  DeclaredOption sub{{"verb"}, "TEXT", "", {}, true, true};
  std::istringstream words(help);
  std::string before;
  for (std::string next; words >> next; before = next) {
    std::string word = next;
    std::erase_if(word, [](char c) { return c == '[' || c == ']'; });
    const auto add = [](std::vector<std::string>& list, const std::string& one) {
      if (std::find(list.begin(), list.end(), one) == list.end()) list.push_back(one);
    };
    if (before == program) add(sub.choices, word);
    const auto end = std::find_if(word.begin() + (word.starts_with("--") ? 2 : 0), word.end(),
                                  [](char c) { return c != '-' && (c < 'a' || c > 'z'); });
    word.erase(end, word.end());
    if (!word.starts_with("--") || word.size() < 3) continue;
    const bool is_known = std::any_of(verb.options.begin(), verb.options.end(),
                                      [&](const DeclaredOption& option) { return option.names[0] == word; });
    if (!is_known) verb.options.push_back({{word}, "TEXT", "", {}, false, false});
  }
  verb.options.push_back(std::move(sub));
  return verb;
}

}  // namespace muster::cli
