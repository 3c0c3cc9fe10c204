// Cases made by the exam, each in a folder of its own.
#pragma once

#include <cstdlib>
#include <stdexcept>

#include "diagnosis/pipeline/diagnose.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {

inline std::filesystem::path made_case(const Scratch& scratch, const std::string& wanted, int number) {
  const std::string name = std::to_string(number);
  const std::string command = std::string(EXAM) + " make --cases 1 --first " + name + ' ' + wanted + " --out " +
                              (scratch / "").string() + " > /dev/null";
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command);
  return scratch / ("case_" + std::string(4 - name.size(), '0') + name);
}

inline std::filesystem::path sealed_case(const Scratch& scratch, const std::string& wanted, int number) {
  return made_case(scratch, "--seed 31 --rows 3000 4000 " + wanted, number);
}

}  // namespace muster::diagnosis
