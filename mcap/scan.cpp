#include "scan.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <set>

#include "text/error.hpp"
#include "text/file_kind.hpp"
#include "text/names.hpp"
#include "text/text_file.hpp"
#include "zstandard.hpp"

namespace muster::mcap {
namespace {

// A chunk, or another record, larger than this is refused: memory is bounded, whatever a file declares.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;

// Of a folder, such as ros2 bag makes: the MCAP files in it.
std::string file_in(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  std::error_code none;
  bool has_sqlite = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path().string());
    has_sqlite = has_sqlite || entry.path().extension() == ".db3";
  }
  std::sort(files.begin(), files.end());
  if (files.empty() && has_sqlite)
    return "; expected an MCAP file, and it has none: its .db3 is a bag in SQLite, which ros2 bag convert writes anew "
           "with storage_id: mcap";
  if (files.empty()) return "; expected an MCAP file, and it has none (muster run WORLD --mcap FILE writes one)";
  return files.size() == 1 ? "; expected the MCAP file in it, " + files[0]
                           : "; expected one of its MCAP files, such as " + files[0];
}

class File {
 public:
  explicit File(const std::filesystem::path& path) : path_(path), fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat about {};
    if (fd_ < 0 || ::fstat(fd_, &about) != 0) fail();
    if (S_ISDIR(about.st_mode)) throw invalid({path.string()}, "is a folder" + file_in(path));
    if (!S_ISREG(about.st_mode)) throw invalid({path.string()}, "is no file; expected an MCAP file");
    size_ = static_cast<std::uint64_t>(about.st_size);
  }
  ~File() {
    if (fd_ >= 0) ::close(fd_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  std::uint64_t size() const { return size_; }
  // What lies within the file.
  void read(std::uint64_t at, std::size_t count, std::string& to) const {
    to.resize(count);
    for (std::size_t done = 0; done < count;) {
      const ::ssize_t got = ::pread(fd_, to.data() + done, count - done, static_cast<::off_t>(at + done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail();
      if (got == 0) throw Error(Exit::io, {path_.string()}, "became shorter while it was read");
      done += static_cast<std::size_t>(got);
    }
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(Exit::io, {path_.string()}, "cannot be read: " + system_message(errno));
  }
  std::filesystem::path path_;
  int fd_;
  std::uint64_t size_ = 0;
};

// A fault, and the byte of the file that it is at.
struct Fault {
  std::uint64_t at;
  std::string what;
  std::string text() const { return "byte " + std::to_string(at) + ": " + what; }
};

struct Framing : Fault {};  // of a record's head: nothing behind it can be told

class Scanner {
 public:
  Scanner(const std::filesystem::path& path, Visitor& visitor, Damage damage)
      : path_(path), file_(path), visitor_(visitor), damage_(damage) {}

  Scan run() {
    result_.bytes = file_.size();
    check_magic();
    try {
      std::uint64_t at = magic.size();
      while (!at_end_) at = record(at);
      check_end(at);
    } catch (const Framing& fault) {
      take(fault);
    }
    return result_;
  }

 private:
  void take(const Fault& fault) {
    if (damage_ == Damage::refused)
      throw invalid({path_.string()},
                    fault.text() + "; `muster log recover " + path_.string() + "` saves what is whole");
    result_.damages.push_back(fault.text());
  }

  void check_magic() {
    file_.read(0, std::min<std::uint64_t>(file_.size(), magic.size()), body_);
    if (body_ == magic) return;
    const bool is_cut = body_.size() < magic.size() && magic.starts_with(body_);
    const std::string kind = file_kind_of(path_.string());
    if (!is_cut && kind == "a bag of ROS 2 in SQLite")
      throw invalid({path_.string()}, "is " + kind + "; expected MCAP, which ros2 bag convert makes of it");
    if (!is_cut && kind == "a bag of ROS 1")
      throw invalid({path_.string()}, "is " + kind + "; expected MCAP: mcap convert " + path_.string() + " OUT.mcap");
    if (!is_cut && path_.extension() == ".csv")
      throw invalid({path_.string()}, "is a table already; expected an MCAP file, as muster run --mcap writes");
    throw invalid(
        {path_.string()},
        std::string("byte 0: ") + (is_cut ? "the file ends before its first record"
                                          : "is no MCAP file; one begins with the bytes 89 4d 43 41 50 30 0d 0a"));
  }

  // Reads the record at this byte and returns the byte behind it.
  std::uint64_t record(std::uint64_t at) {
    const std::uint64_t left = file_.size() - at;
    if (left < head_bytes)
      throw Framing{{at, left == 0 ? "the file ends without its footer" : "the file ends within a record"}};
    file_.read(at, head_bytes, body_);
    Cursor head(body_);
    const auto opcode = static_cast<Opcode>(head.byte("opcode"));
    const std::uint64_t length = head.large("length");
    if (opcode < Opcode::header) throw Framing{{at, "a record of the kind 0; expected 1 to 255"}};
    if (length > left - head_bytes)
      throw Framing{{at, "a record of " + std::to_string(length) + " bytes, of which the file has " +
                             std::to_string(left - head_bytes)}};
    const std::uint64_t begin = at + head_bytes;
    try {
      if (is_needed(opcode)) {
        if (length > most_bytes)
          throw Fault{at, "a record of " + std::to_string(length) + " bytes; at most " + std::to_string(most_bytes)};
        file_.read(begin, static_cast<std::size_t>(length), body_);
        hand_on(opcode, body_, begin);
      }
    } catch (const Framing&) {
      throw;
    } catch (const Fault& fault) {
      take(fault);
    } catch (const Malformed& fault) {
      take({begin + fault.at, fault.what()});
    }
    if (opcode == Opcode::attachment) ++result_.attachments;
    at_end_ = opcode == Opcode::data_end || opcode == Opcode::footer;
    return begin + length;
  }

  // Indices and summary repeat what the data have.
  static bool is_needed(Opcode opcode) {
    switch (opcode) {
      case Opcode::header:
      case Opcode::schema:
      case Opcode::channel:
      case Opcode::message:
      case Opcode::chunk:
      case Opcode::metadata:
        return true;
      default:
        return false;
    }
  }

  void hand_on(Opcode opcode, std::string_view body, std::uint64_t begin) {
    if (opcode == Opcode::header) {
      const Header header = read_header(body);
      result_.profile = header.profile;
      result_.library = header.library;
      visitor_.header(header);
    } else if (opcode == Opcode::metadata) {
      visitor_.metadata(read_metadata(body));
    } else if (opcode == Opcode::chunk) {
      chunk(body, begin);
    } else {
      datum(opcode, body, "byte " + std::to_string(begin));
    }
  }

  void datum(Opcode opcode, std::string_view body, const std::string& where) {
    if (opcode == Opcode::schema) {
      visitor_.schema(read_schema(body));
    } else if (opcode == Opcode::channel) {
      const Channel channel = read_channel(body);
      channels_.insert(channel.id);
      visitor_.channel(channel);
    } else if (opcode == Opcode::message) {
      const Message message = read_message(body);
      if (!channels_.count(message.channel))
        throw Malformed(0,
                        "a message on channel " + std::to_string(message.channel) + ", which was not declared before");
      visitor_.message(message, where);
    }
  }

  void chunk(std::string_view body, std::uint64_t begin) {
    const Chunk chunk = read_chunk(body);
    const auto refuse = [&](const std::string& what) { throw Fault{begin, "a chunk " + what}; };
    if (chunk.size > most_bytes)
      refuse("of " + std::to_string(chunk.size) + " bytes; at most " + std::to_string(most_bytes));
    std::string_view records = chunk.records;
    if (chunk.compression == "zstd") {
      if (const std::string fault = decompress(chunk.records, chunk.size, unpacked_); !fault.empty())
        refuse("that " + fault);
      records = unpacked_;
    } else if (!chunk.compression.empty()) {
      refuse("compressed by " + quote(chunk.compression) + "; expected zstd or none");
    } else if (records.size() != chunk.size) {
      refuse("with " + std::to_string(records.size()) + " bytes; " + std::to_string(chunk.size) + " were declared");
    }
    if (chunk.crc != 0 && crc32(0, records) != chunk.crc) refuse("whose checksum is another than the declared one");
    records_of(records, begin);
    ++result_.chunks;
    result_.packed += chunk.records.size();
    result_.unpacked += records.size();
  }

  void records_of(std::string_view records, std::uint64_t chunk) {
    Cursor from(records);
    const std::string in_chunk = " of the chunk at byte " + std::to_string(chunk);
    while (from.left() > 0) {
      const std::size_t at = from.at();
      try {
        const auto opcode = static_cast<Opcode>(from.byte("a record's kind"));
        const std::string_view body = from.bytes(from.large("a record's length"), "a record");
        datum(opcode, body, "byte " + std::to_string(at) + in_chunk);
      } catch (const Malformed& fault) {
        throw Fault{chunk, "at byte " + std::to_string(at) + " of the chunk here: " + fault.what()};
      }
    }
  }

  // Behind the data: the summary, whose records are framed alike, the footer and the magic bytes.
  void check_end(std::uint64_t at) {
    at_end_ = false;
    bool has_footer = file_.size() - at == magic.size();
    while (!has_footer) {
      const std::uint64_t left = file_.size() - at;
      if (left < head_bytes) throw Framing{{at, "the file ends without its footer"}};
      file_.read(at, head_bytes, body_);
      Cursor head(body_);
      has_footer = static_cast<Opcode>(head.byte("opcode")) == Opcode::footer;
      const std::uint64_t length = head.large("length");
      if (length > left - head_bytes)
        throw Framing{{at, "a record of " + std::to_string(length) + " bytes, of which the file has " +
                               std::to_string(left - head_bytes)}};
      at += head_bytes + length;
    }
    file_.read(at, static_cast<std::size_t>(std::min<std::uint64_t>(file_.size() - at, magic.size())), body_);
    if (body_ != magic) throw Framing{{at, "the file does not end as an MCAP file does"}};
    result_.is_whole = true;
  }

  std::filesystem::path path_;
  File file_;
  Visitor& visitor_;
  Damage damage_;
  Scan result_;
  std::string body_, unpacked_;
  std::set<std::uint16_t> channels_;
  bool at_end_ = false;
};

}  // namespace

Scan scan(const std::filesystem::path& path, Visitor& visitor, Damage damage) {
  return Scanner(path, visitor, damage).run();
}

}  // namespace muster::mcap
