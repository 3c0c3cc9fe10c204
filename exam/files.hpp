// Reads and writes whole files.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace muster::exam {

// Throws std::runtime_error, as write_file does.
inline std::string read_file(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("cannot read " + file.string() + ": no file");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return text.str();
}

// Under its name when it is whole; until then one that was there stays. A link is followed, and a pipe written to.
inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::error_code failed;
  const bool is_pipe = std::filesystem::exists(file, failed) && !std::filesystem::is_regular_file(file, failed);
  const auto whole = std::filesystem::is_symlink(file, failed) ? std::filesystem::weakly_canonical(file, failed) : file;
  const std::filesystem::path part = is_pipe ? file : std::filesystem::path(whole.string() + ".part");
  std::ofstream out(part, std::ios::binary);
  out << text;
  out.close();
  failed.clear();
  if (out && !is_pipe) std::filesystem::rename(part, whole, failed);
  if (out && !failed) return;
  if (!is_pipe) std::filesystem::remove(part, failed);
  throw std::runtime_error("cannot write " + file.string());
}

}  // namespace muster::exam
