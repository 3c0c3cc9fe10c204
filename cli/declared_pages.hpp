// The manual page and the completion of bash, made of what verbs declare: nothing of the help is written twice.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace muster::cli {

// muster(1), for man.
std::string manual_page(const std::vector<DeclaredVerb>& verbs, const std::string& summary, const std::string& version);

// A script that bash sources: verbs, their options, and values where there is a choice; else names of files.
std::string bash_completion(const std::vector<DeclaredVerb>& verbs);

// A verb that a program of its own runs: its help is all that is known, and names the options.
DeclaredVerb declared_by_help(const std::string& name, const std::string& program, const std::string& help);

}  // namespace muster::cli
