#include "snapshot.hpp"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/text_file.hpp"
#include "text/whole_file.hpp"

namespace muster {
namespace {

constexpr std::string_view magic = "muster.snapshot.4\n";
constexpr std::string_view kind = "muster.snapshot.";  // of any version

// A hash over words; each word is mixed before the next is added.
class Hash {
 public:
  void add(uint64_t word) { state_ = mixed(state_ ^ word) + 0x9e3779b97f4a7c15u; }
  void add(double value) { add(std::bit_cast<uint64_t>(value)); }
  void add(std::string_view text) {
    add(text.size());
    add_bytes(text.data(), text.size());
  }
  void add_bytes(const void* data, std::size_t count) {
    const auto* from = static_cast<const char*>(data);
    for (; count >= 8; count -= 8, from += 8) {
      uint64_t word;
      std::memcpy(&word, from, 8);
      add(word);
    }
    if (count == 0) return;
    uint64_t rest = 0;
    std::memcpy(&rest, from, count);
    add(rest);
  }
  void add(const Cells& cells) {
    add(uint64_t{cells.rows});
    add_bytes(cells.data.data(), cells.data.size() * sizeof(double));
    for (const auto& blob : cells.blobs)
      add(std::string_view(reinterpret_cast<const char*>(blob->data()), blob->size()));
    for (const auto tick : cells.appended) add(tick);
  }
  uint64_t value() const { return state_; }

 private:
  uint64_t state_ = 0x6d7573746572u;
};

class Writer {
 public:
  void word(uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void text(std::string_view value) {
    word(value.size());
    bytes_ += value;
  }
  template <class Number>
  void numbers(const std::vector<Number>& values) {
    text({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number)});
  }
  // Appends a hash of all that was written, to detect damage, and returns the whole.
  const std::string& finish() {
    Hash hash;
    hash.add_bytes(bytes_.data(), bytes_.size());
    word(hash.value());
    return bytes_;
  }

 private:
  std::string bytes_;
};

// Every length is checked against the rest of the file.
class Reader {
 public:
  Reader(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}
  uint64_t word() {
    uint64_t value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view text() { return take(word()); }
  template <class Number>
  std::vector<Number> numbers() {
    const auto bytes = text();
    if (bytes.size() % sizeof(Number)) fail();
    std::vector<Number> values(bytes.size() / sizeof(Number));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  std::string_view take(uint64_t count) {
    if (count > text_.size() - at_) fail();
    at_ += count;
    return std::string_view(text_).substr(at_ - count, count);
  }
  void expect_check() {
    Hash hash;
    hash.add_bytes(text_.data() + magic.size(), at_ - magic.size());
    if (hash.value() != word() || at_ != text_.size()) fail();
  }
  void expect_magic() {
    const std::string_view all = text_;
    if (all.substr(0, magic.size()) == magic) return void(take(magic.size()));
    if (all.substr(0, 2) == "\x1f\x8b") refuse("is compressed by gzip; expected the file as it was before");
    if (all.substr(0, 5) == "\x89MCAP")
      refuse(
          "is a log of a run (MCAP), which has what was recorded and no state; expected a file that `muster run "
          "--save` wrote");
    const std::string_view version = all.substr(0, all.find('\n'));
    if (version.substr(0, kind.size()) == kind && version.size() < 2 * kind.size())
      refuse("is of version " + quote(version.substr(kind.size())) + " of the format, and this program reads version " +
             quote(magic.substr(kind.size(), magic.size() - kind.size() - 1)) +
             "; expected a snapshot that this version of muster saved");
    fail();
  }
  [[noreturn]] void refuse(const std::string& what) const { throw Error(Exit::invalid_input, Place{file_}, what); }
  [[noreturn]] void fail() const { refuse("is not a whole snapshot; expected a file that `muster run --save` wrote"); }

 private:
  std::string text_, file_;
  std::size_t at_ = 0;
};

}  // namespace

uint64_t Snapshot::digest() const {
  Hash hash;
  hash.add(tick);
  for (const auto& [name, set] : sets) {
    hash.add(name);
    for (const auto& row : set.names) hash.add(row);
    hash.add_bytes(set.alive.data(), set.alive.size());
    for (std::size_t r = 0; r < set.like.size(); ++r) {
      if (set.like[r] != r) hash.add(uint64_t{set.like[r]});
    }
    hash.add(set.listed);
  }
  for (const auto& [name, table] : tables) {
    hash.add(name);
    hash.add(table.columns);
    hash.add(table.cells);
  }
  return hash.value();
}

void Snapshot::save(const std::filesystem::path& file) const {
  Writer writer;
  writer.word(tick);
  writer.word(std::bit_cast<uint64_t>(dt));
  writer.word(sets.size());
  for (const auto& [name, set] : sets) {
    writer.text(name);
    writer.word(set.names.size());
    for (const auto& row : set.names) writer.text(row);
    writer.numbers(set.alive);
    writer.numbers(set.like);
    writer.word(set.listed);
  }
  writer.word(tables.size());
  for (const auto& [name, table] : tables) {
    writer.text(name);
    writer.text(table.columns);
    writer.word(table.cells.rows);
    writer.word(table.cells.tick);
    writer.numbers(table.cells.data);
    writer.numbers(table.cells.appended);
    writer.word(table.cells.blobs.size());
    for (const auto& blob : table.cells.blobs) writer.numbers(*blob);
  }
  writer.word(instances.size());
  for (const auto& [name, instance] : instances) {
    writer.text(name);
    writer.text(instance.plugin);
    writer.word(instance.line);
    writer.word(instance.column);
    writer.numbers(instance.params);
    writer.word(instance.given_up);
  }
  write_whole(file, std::string(magic) + writer.finish());
}

Snapshot Snapshot::load(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    throw Error(Exit::invalid_input, Place{file.string()}, "cannot be read: " + system_message(errno));
  Reader reader(std::string(std::istreambuf_iterator<char>(in), {}), file.string());
  reader.expect_magic();
  Snapshot result;
  result.tick = reader.word();
  result.dt = std::bit_cast<double>(reader.word());
  for (auto n = reader.word(); n > 0; --n) {
    auto& set = result.sets[std::string(reader.text())];
    for (auto rows = reader.word(); rows > 0; --rows) set.names.emplace_back(reader.text());
    set.alive = reader.numbers<uint8_t>();
    set.like = reader.numbers<uint32_t>();
    set.listed = reader.word();
  }
  for (auto n = reader.word(); n > 0; --n) {
    auto& table = result.tables[std::string(reader.text())];
    table.columns = reader.text();
    table.cells.rows = reader.word();
    table.cells.tick = reader.word();
    table.cells.data = reader.numbers<double>();
    table.cells.appended = reader.numbers<uint64_t>();
    for (auto blobs = reader.word(); blobs > 0; --blobs)
      table.cells.blobs.push_back(std::make_shared<const std::vector<uint8_t>>(reader.numbers<uint8_t>()));
  }
  for (auto n = reader.word(); n > 0; --n) {
    auto& instance = result.instances[std::string(reader.text())];
    instance.plugin = reader.text();
    instance.line = reader.word();
    instance.column = reader.word();
    instance.params = reader.numbers<double>();
    instance.given_up = reader.word() != 0;
  }
  reader.expect_check();
  return result;
}

}  // namespace muster
