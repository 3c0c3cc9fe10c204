// Takes a case from anybody's generator: a command that writes world.xml, measured.csv and answer.json into a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace muster::exam {

struct ForeignOrder {
  std::string command;  // for the shell; called with seed, number and folder behind it
  std::uint64_t seed = 1;
  int number = 1;
  std::filesystem::path exam;
};

// Runs the command, checks what it wrote, and puts the answer apart from the case. Throws std::runtime_error that names
// the file and the key at fault.
void make_foreign_case(const ForeignOrder& order);

// The answer in the exam's full form, from the short one of docs/how-to/bring_your_own_exam.md. `file` is named in
// errors.
std::string full_answer(const std::string& text, const std::string& case_name, const std::string& file);

}  // namespace muster::exam
