// Checks a library before any of its code runs: dlopen() dies of SIGBUS or SIGSEGV on truncated and corrupted files,
// and reports a library of another machine as "No such file or directory".
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace muster {

// Reason for not loading a library: words that follow its file's name, such as "is built for AArch64; expected x86-64".
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The names of the sections of a shared object, in the file's order, from the file's bytes. Throws Refusal unless the
// bytes are a whole shared object for this machine.
std::vector<std::string> elf_sections(std::string_view bytes);

}  // namespace muster
