#include "archive.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/text_file.hpp"

namespace muster::bundle {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

struct FreeReader {
  void operator()(::archive* a) const { ::archive_read_free(a); }
};
struct FreeWriter {
  void operator()(::archive* a) const { ::archive_write_free(a); }
};
struct FreeEntry {
  void operator()(::archive_entry* e) const { ::archive_entry_free(e); }
};

// Its own words name the format's parts; they follow the file's name.
std::string words_of(::archive* a) {
  const char* words = ::archive_error_string(a);
  return words ? words : "no reason is given";
}

Error unwritable(const fs::path& file, const std::string& why) {
  return {Exit::io, file.string() + ": cannot be written: " + why};
}

std::string megabytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MB"; }

void write_all(int to, const char* bytes, std::size_t count, const fs::path& file) {
  while (count > 0) {
    const ssize_t written = ::write(to, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw unwritable(file, system_message(errno));
    bytes += written, count -= static_cast<std::size_t>(written);
  }
}

void pack_one(::archive* to, const fs::path& source, const std::string& name, const fs::path& file) {
  const Descriptor from(::open(source.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (from.number() < 0) throw Error(Exit::io, source.string() + ": " + system_message(errno));
  const std::unique_ptr<::archive_entry, FreeEntry> entry(::archive_entry_new());
  auto left = static_cast<std::int64_t>(fs::file_size(source));
  ::archive_entry_set_pathname(entry.get(), name.c_str());
  ::archive_entry_set_filetype(entry.get(), AE_IFREG);
  ::archive_entry_set_perm(entry.get(), 0644);
  ::archive_entry_set_size(entry.get(), left);
  ::archive_entry_set_mtime(entry.get(), 0, 0);  // its owner and time are nobody's concern
  if (::archive_write_header(to, entry.get()) != ARCHIVE_OK) throw unwritable(file, words_of(to));
  std::array<char, 1 << 16> bytes;
  while (left > 0) {
    const ssize_t count = ::read(from.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Error(Exit::io, source.string() + ": changed while it was packed");
    if (::archive_write_data(to, bytes.data(), static_cast<std::size_t>(count)) != count)
      throw unwritable(file, words_of(to));
    left -= count;
  }
}

class Unpacking {
 public:
  Unpacking(const fs::path& file, const fs::path& folder, const Limits& limits)
      : file_(file), folder_(folder), limits_(limits), from_(::archive_read_new()) {
    ::archive_read_support_filter_zstd(from_.get());
    ::archive_read_support_format_tar(from_.get());
  }

  void run() {
    if (::archive_read_open_filename(from_.get(), file_.c_str(), 1 << 16) != ARCHIVE_OK) fail();
    for (std::size_t entries = 0;; ++entries) {
      ::archive_entry* entry = nullptr;
      const int read = ::archive_read_next_header(from_.get(), &entry);
      if (read == ARCHIVE_EOF) break;
      if (read != ARCHIVE_OK) fail();
      // Folders count as well: an archive of nothing else would go on for ever.
      if (entries >= limits_.files)
        refuse("has more than " + std::to_string(limits_.files) + " entries, and a bundle has no more");
      one(entry);
    }
  }

 private:
  void one(::archive_entry* entry) {
    const char* given = ::archive_entry_pathname(entry);
    if (!given) refuse("has an entry without a name that can be read");
    std::string name = given;
    const auto type = ::archive_entry_filetype(entry);
    const bool is_link = ::archive_entry_hardlink(entry) || type == AE_IFLNK;
    if (type == AE_IFDIR && !is_link) {
      while (name.ends_with('/')) name.pop_back();
      if (name == "." || fault_of_name(name).empty()) return;  // made for the files in it
    }
    if (name.starts_with("./")) name.erase(0, 2);  // as tar writes what stands in a folder
    if (const std::string fault = fault_of_name(name); !fault.empty()) refuse("has " + quote(given) + ", " + fault);
    if (is_link) refuse("has " + quote(name) + ", which is a link; a bundle has plain files alone");
    if (type != AE_IFREG) refuse("has " + quote(name) + ", which is no plain file; a bundle has plain files alone");
    if (!::archive_entry_size_is_set(entry)) refuse("has " + quote(name) + ", whose size is not given");
    const auto size = ::archive_entry_size(entry);
    if (size < 0 || static_cast<std::uint64_t>(size) > limits_.bytes_of_one)
      refuse("has " + quote(name) + " of more than " + megabytes(limits_.bytes_of_one) +
             ", and a file of a bundle has no more");
    bytes_ += static_cast<std::uint64_t>(size);
    if (bytes_ > limits_.bytes)
      refuse("has more than " + megabytes(limits_.bytes) + " of files, and a bundle has no more");
    write(name, static_cast<std::uint64_t>(size));
  }

  void write(const std::string& name, std::uint64_t size) {
    const fs::path to = folder_ / name;
    std::error_code made;
    fs::create_directories(to.parent_path(), made);
    if (made) refuse("has " + quote(name) + ", below another file of it");
    Descriptor out(::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (out.number() < 0 && (errno == EEXIST || errno == EISDIR)) refuse("has " + quote(name) + " more than once");
    if (out.number() < 0) throw unwritable(to, system_message(errno));
    std::array<char, 1 << 16> bytes;
    std::uint64_t written = 0;
    while (true) {
      const la_ssize_t count = ::archive_read_data(from_.get(), bytes.data(), bytes.size());
      if (count < 0) fail();
      if (count == 0) break;
      written += static_cast<std::uint64_t>(count);
      if (written > size) refuse("has " + quote(name) + ", which is longer than it says");
      write_all(out.number(), bytes.data(), static_cast<std::size_t>(count), to);
    }
    if (written != size) refuse("ends within " + quote(name));
    if (!out.close()) throw unwritable(to, system_message(errno));
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(Exit::invalid_input, Place{file_.string()}, what);
  }
  [[noreturn]] void fail() const {
    refuse("is no whole bundle; expected a file that `muster bundle` wrote (" + words_of(from_.get()) + ")");
  }

  const fs::path& file_;
  const fs::path& folder_;
  const Limits& limits_;
  std::unique_ptr<::archive, FreeReader> from_;
  std::uint64_t bytes_ = 0;
};

}  // namespace

std::string fault_of_name(const std::string& name) {
  constexpr std::size_t most_of_name = 1024;
  if (name.empty()) return "which is no name";
  if (name.size() > most_of_name) return "which is too long";
  if (name.front() == '/') return "which is absolute; expected a path inside of the bundle";
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) return "which has a control character";
  for (std::string_view rest = name;;) {
    const auto slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    if (part == "..") return "which leaves the bundle; expected a path inside of it";
    if (part.empty() || part == ".") return "which is no plain path";
    if (slash == rest.npos) return "";
    rest.remove_prefix(slash + 1);
  }
}

void pack(const fs::path& folder, const std::vector<std::string>& names, const fs::path& file, const Limits& limits) {
  if (fs::exists(fs::symlink_status(file)))
    throw Error(Exit::invalid_input, file.string() + " is there already; expected a new file");
  if (names.size() > limits.files)
    throw Error(Exit::invalid_input, "a bundle has at most " + std::to_string(limits.files) + " files; these are " +
                                         std::to_string(names.size()));
  std::uint64_t bytes = 0;
  for (const std::string& name : names) {
    if (const std::string fault = fault_of_name(name); !fault.empty())
      throw Error(Exit::invalid_input, quote(name) + ", " + fault);
    const std::uint64_t size = fs::file_size(folder / name);
    bytes += size;
    if (size > limits.bytes_of_one || bytes > limits.bytes)
      throw Error(Exit::invalid_input, quote(name) + " makes the bundle too large; expected files of at most " +
                                           megabytes(limits.bytes_of_one) + ", and " + megabytes(limits.bytes) +
                                           " in all");
  }
  const fs::path part = file.string() + ".part";
  Descriptor out(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (out.number() < 0) throw unwritable(file, system_message(errno));
  try {
    const std::unique_ptr<::archive, FreeWriter> to(::archive_write_new());
    ::archive_write_add_filter_zstd(to.get());
    ::archive_write_set_format_gnutar(to.get());  // names as they are, of any length
    if (::archive_write_open_fd(to.get(), out.number()) != ARCHIVE_OK) throw unwritable(file, words_of(to.get()));
    for (const std::string& name : names) pack_one(to.get(), folder / name, name, file);
    if (::archive_write_close(to.get()) != ARCHIVE_OK) throw unwritable(file, words_of(to.get()));
    if (::fsync(out.number()) != 0 && errno != EINVAL) throw unwritable(file, system_message(errno));
    if (!out.close()) throw unwritable(file, system_message(errno));
    fs::rename(part, file);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

void unpack(const fs::path& file, const fs::path& folder, const Limits& limits) {
  Unpacking(file, folder, limits).run();
}

}  // namespace muster::bundle
