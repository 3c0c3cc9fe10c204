// A file that ends anywhere, or has other bytes anywhere, is told with its byte, and the rest is recovered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "collected.hpp"
#include "mcap/rewrite.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

using mcap::Damage;
using testing::ContainsRegex;
using testing::HasSubstr;

std::string refusal(const std::filesystem::path& file) {
  try {
    Collected read;
    mcap::scan(file, read, Damage::refused);
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::invalid_input);
    return e.message();
  }
  return "";
}

TEST(McapDamage, EveryPrefixIsRecoveredUpToItsLastChunk) {
  const Folder folder;
  const auto written = write_log(folder / "a.mcap", 120);
  const std::string whole = folder.read("a.mcap");
  std::size_t recovered = 0;
  for (std::size_t size = mcap::magic.size(); size < whole.size(); size += size < 600 ? 19 : 1 + size / 40) {
    folder.write("torn.mcap.part", whole.substr(0, size));
    EXPECT_THAT(refusal(folder / "torn.mcap.part"), ContainsRegex("^byte [0-9]+: .*muster log recover")) << size;
    const auto done = mcap::rewrite(folder / "torn.mcap.part", folder / "torn.mcap", Damage::skipped);
    EXPECT_EQ(done.scan.damages.size(), 1u) << size;
    Collected read;
    EXPECT_TRUE(mcap::scan(folder / "torn.mcap", read, Damage::refused).is_whole) << size;
    ASSERT_LE(read.messages.size(), written.size());
    EXPECT_TRUE(std::equal(read.messages.begin(), read.messages.end(), written.begin())) << size;
    EXPECT_GE(read.messages.size(), recovered) << "a longer file has more, " << size;
    recovered = read.messages.size();
  }
  EXPECT_EQ(recovered, written.size()) << "without its footer alone, all is there";
}

// By the lengths of the records before it.
std::size_t start_of_chunk(const std::string& bytes, int number) {
  for (std::size_t at = mcap::magic.size();;) {
    mcap::Cursor head(std::string_view(bytes).substr(at));
    if (head.byte("opcode") == static_cast<std::uint8_t>(mcap::Opcode::chunk) && --number == 0) return at;
    at += mcap::head_bytes + head.large("length");
  }
}

TEST(McapDamage, ADamagedChunkTakesNoOtherWithIt) {
  const Folder folder;
  const auto written = write_log(folder / "a.mcap", 500);  // 10 chunks
  std::string bytes = folder.read("a.mcap");
  const std::size_t third = start_of_chunk(bytes, 3);
  bytes[third + 200] ^= 0x10;
  folder.write("a.mcap", bytes);
  const auto done = mcap::rewrite(folder / "a.mcap", folder / "b.mcap", Damage::skipped);
  ASSERT_EQ(done.scan.damages.size(), 1u);
  EXPECT_THAT(done.scan.damages[0], HasSubstr("byte " + std::to_string(third + mcap::head_bytes) + ": a chunk "));
  EXPECT_EQ(done.messages, written.size() - 2 * 51);
}

// Whatever the bytes, a scan ends, and what it refuses is told by a byte of the file.
TEST(McapDamage, NoBytesBringTheReaderDown) {
  const Folder folder;
  write_log(folder / "a.mcap", 60, 20);
  const std::string whole = folder.read("a.mcap");
  std::mt19937 random(7);
  for (int trial = 0; trial < 1000; ++trial) {
    std::string bytes = whole;
    for (int flips = 1 + trial % 4; flips > 0; --flips) {
      // Half of the flips among the first bytes, where heads, schemas and channels are.
      const std::size_t range = flips % 2 ? bytes.size() : 600;
      bytes[random() % range] = static_cast<char>(random());
    }
    folder.write("b.mcap", bytes);
    if (const std::string message = refusal(folder / "b.mcap"); !message.empty()) {
      EXPECT_THAT(message, ContainsRegex("^byte [0-9]+: ")) << trial;
    }
    if (trial % 20 != 0 || bytes.substr(0, 8) != whole.substr(0, 8)) continue;
    mcap::rewrite(folder / "b.mcap", folder / "c.mcap", Damage::skipped);
    EXPECT_EQ(refusal(folder / "c.mcap"), "") << trial;
  }
}

std::string with_chunk(const std::string& compression, std::uint64_t size, const std::string& records) {
  std::string bytes(mcap::magic);
  mcap::put_record(bytes, mcap::Header{});
  const auto begun = mcap::begin_record(bytes, mcap::Opcode::chunk);
  for (int i = 0; i < 2; ++i) mcap::put(bytes, std::uint64_t{0});
  mcap::put(bytes, size);
  mcap::put(bytes, std::uint32_t{0});
  mcap::put(bytes, std::string_view(compression));
  mcap::put(bytes, std::uint64_t{records.size()});
  bytes += records;
  mcap::end_record(bytes, begun);
  return bytes;
}

TEST(McapDamage, IsToldWithItsByte) {
  const Folder folder;
  const auto told = [&](const std::string& bytes) { return refusal(folder.write("x.mcap", bytes)); };
  const std::string advice = "; `muster log recover " + folder.at("x.mcap") + "` saves what is whole";
  EXPECT_EQ(told(""), "byte 0: the file ends before its first record");
  EXPECT_EQ(told("t[s],x[m]\n"), "byte 0: is no MCAP file; one begins with the bytes 89 4d 43 41 50 30 0d 0a");
  EXPECT_EQ(told(std::string(mcap::magic)), "byte 8: the file ends without its footer" + advice);
  EXPECT_EQ(told(std::string(mcap::magic) + "\1\1"), "byte 8: the file ends within a record" + advice);
  EXPECT_EQ(told(std::string(mcap::magic) + "\1" + std::string(8, '\x7f')),
            "byte 8: a record of 9187201950435737471 bytes, of which the file has 0" + advice);
  EXPECT_EQ(told(with_chunk("zstd", 1ull << 40, "")),
            "byte 34: a chunk of 1099511627776 bytes; at most 268435456" + advice);
  EXPECT_EQ(told(with_chunk("lz4", 5, "12345")),
            "byte 34: a chunk compressed by \"lz4\"; expected zstd or none" + advice);
  EXPECT_EQ(told(with_chunk("", 7, "12345")), "byte 34: a chunk with 5 bytes; 7 were declared" + advice);
  std::string message;
  mcap::put_record(message, mcap::Message{3, 0, 0, 0, "?"});
  EXPECT_EQ(told(with_chunk("", message.size(), message)),
            "byte 34: at byte 0 of the chunk here: a message on channel 3, which was not declared before" + advice);
}

}  // namespace
}  // namespace muster::test
