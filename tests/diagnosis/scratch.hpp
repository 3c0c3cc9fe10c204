// Small files for tests, gone at the end, and errors as text.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

namespace muster::diagnosis {

class Scratch {
 public:
  Scratch() {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("muster_diagnosis_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_;
};

inline std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// What went wrong, without the folder before the file's name; "" if nothing did.
inline std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& e) {
    std::string text = e.what();
    const std::size_t slash = text.substr(0, text.find(": ")).rfind('/');
    return text[0] != '/' || slash == text.npos ? text : text.substr(slash + 1);
  }
  return "";
}

}  // namespace muster::diagnosis
