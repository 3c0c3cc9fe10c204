// Errors shown to the user: one line with the place, the fault, the expectation and the nearest valid name.
#pragma once

#include <stdexcept>
#include <string>

namespace muster {

// The program's exit codes (docs/reference/errors.md).
enum class Exit {
  done = 0,
  check_failed = 1,
  invalid_input = 2,
  plugin_fault = 3,
  internal = 70,
  io = 74,
  interrupted = 130
};

// A place in a file; lines and columns count from 1; 0 means unknown and is not printed.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;

  // "file:line:column"
  std::string text() const {
    std::string result = file;
    if (line > 0) result += ':' + std::to_string(line);
    if (line > 0 && column > 0) result += ':' + std::to_string(column);
    return result;
  }
};

class Error : public std::runtime_error {
 public:
  Error(Exit code, const std::string& message) : std::runtime_error(message), exit_(code), message_(message) {}
  Error(Exit code, const Place& place, const std::string& message)
      : std::runtime_error(place.text() + ": " + message), exit_(code), place_(place), message_(message) {}

  Exit exit() const { return exit_; }
  const Place& place() const { return place_; }
  const std::string& message() const { return message_; }  // without the place

 private:
  Exit exit_;
  Place place_;
  std::string message_;
};

// Bad input, the most frequent error by far.
inline Error invalid(const Place& place, const std::string& message) { return {Exit::invalid_input, place, message}; }

}  // namespace muster
