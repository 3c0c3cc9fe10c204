#include "text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

#include "file_kind.hpp"
#include "near_file.hpp"

namespace muster {
namespace {

class Descriptor {
 public:
  // Not blocking, so that a fifo without a writer is opened (and then refused) at once.
  explicit Descriptor(const std::filesystem::path& path)
      : fd_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail_system(const Place& place, int error_number) {
  if (error_number == ENOENT || error_number == ENOTDIR) throw invalid(place, "no such file" + near_file(place.file));
  throw Error(Exit::io, place, "cannot be read: " + system_message(error_number));
}

std::string read_bytes(const std::filesystem::path& path, std::uint64_t most_bytes) {
  const Place place{path.string()};
  const Descriptor file(path);
  struct stat status {};
  if (file.fd() < 0 || ::fstat(file.fd(), &status) != 0) fail_system(place, errno);
  if (S_ISDIR(status.st_mode)) throw invalid(place, "is a directory; expected a file");
  if (!S_ISREG(status.st_mode)) throw invalid(place, "is not a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > most_bytes) {
    throw invalid(place, "has " + std::to_string(size) + " bytes; expected at most " + std::to_string(most_bytes));
  }
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const ::ssize_t got = ::read(file.fd(), bytes.data() + have, size - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_system(place, errno);
    if (got == 0) break;  // the file has shrunk since
    have += static_cast<std::size_t>(got);
  }
  bytes.resize(have);
  return bytes;
}

// Bytes of the well-formed UTF-8 character at the start of the text (Unicode Standard, table 3-7), or 0.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0), second = byte(1);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool surrogate = lead == 0xED && second > 0x9F;
  const bool too_large = lead == 0xF4 && second > 0x8F;
  return overlong || surrogate || too_large ? 0 : length;
}

// Offset of the first byte that is not UTF-8, or the size; eight plain ASCII bytes at a time.
std::size_t first_not_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    std::uint64_t word = 0;
    if (at + sizeof word <= text.size()) {
      std::memcpy(&word, text.data() + at, sizeof word);
      if ((word & 0x8080808080808080u) == 0) {
        at += sizeof word;
        continue;
      }
    }
    const std::size_t length = character_length(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return at;
}

std::string hexadecimal(char c) {
  constexpr char digits[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return {'0', 'x', digits[byte >> 4], digits[byte & 15]};
}

// How a file of another encoding becomes UTF-8: of XML by the one that it declares, else by the likeliest.
std::string conversion_of(std::string_view text, const std::string& name) {
  const std::string_view first = text.substr(0, text.find('>'));
  const std::string_view mark = "encoding=";
  const auto at = first.starts_with("<?xml") ? first.find(mark) : first.npos;
  std::string declared;
  if (at != first.npos && at + mark.size() + 1 < first.size()) {
    const auto from = at + mark.size() + 1;
    declared = first.substr(from, first.find(first[from - 1], from) - from);
  }
  const auto is_plain = [](char c) { return c == '-' || c == '_' || (c >= '0' && c <= '9') || (c | 32) >= 'a'; };
  const bool is_other = !declared.empty() && declared.size() < 20 && declared != "UTF-8" && declared != "utf-8" &&
                        std::all_of(declared.begin(), declared.end(), is_plain);
  const std::string from = is_other ? declared : "ISO-8859-1";
  return (is_other ? "the file says encoding=\"" + declared + "\", expected UTF-8: "
                   : std::string("is it Latin-1, as editors of Windows write? expected UTF-8: ")) +
         "iconv -f " + from + " -t UTF-8 " + name + " > NEW" +
         (is_other ? ", and encoding=\"UTF-8\" in its first line" : "");
}

}  // namespace

Place TextFile::place(std::size_t offset) const {
  const std::string_view before = std::string_view(text).substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto is_first_byte = [](char c) { return (c & 0xC0) != 0x80; };
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const auto characters = std::count_if(before.begin() + line_start, before.end(), is_first_byte);
  return {file, static_cast<int>(lines) + 1, static_cast<int>(characters) + 1};
}

TextFile read_text_file(const std::filesystem::path& path, std::uint64_t most_bytes) {
  TextFile result{path.string(), read_bytes(path, most_bytes)};
  std::string& text = result.text;
  const Place place{result.file};
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw invalid(place, "is UTF-16; expected UTF-8: iconv -f UTF-16 -t UTF-8 " + path.filename().string() + " > NEW");
  if (text.starts_with("\x1F\x8B")) throw invalid(place, "is compressed by gzip; expected plain text");
  if (const std::string kind = file_kind(text.substr(0, 256));
      !kind.empty() && kind != "XML" && kind != "JSON" && kind != "a DXF drawing" && kind != "a snapshot of muster" &&
      kind != "a flight plan of QGroundControl")
    throw invalid(place, "is " + kind + "; expected plain text" +
                             (kind == "compressed by zstd"
                                  ? ", or of a bundle of muster: muster bundle check " + path.filename().string()
                                  : ""));
  if (text.starts_with("PK\x03"))
    throw invalid(place, "is a ZIP archive, as .xlsx and .ods are; expected plain text, such as CSV in UTF-8");
  std::size_t skipped = 0;
  if (text.starts_with("\xEF\xBB\xBF")) {
    skipped = 3;
    text.erase(0, skipped);
  }
  const std::size_t wrong = first_not_utf8(text);
  if (wrong < text.size()) {
    throw invalid(result.place(wrong), "byte " + std::to_string(wrong + skipped + 1) + " of the file, " +
                                           hexadecimal(text[wrong]) + ", is not valid UTF-8; " +
                                           conversion_of(text, path.filename().string()));
  }
  return result;
}

std::string system_message(int error_number) { return std::generic_category().message(error_number); }

}  // namespace muster
