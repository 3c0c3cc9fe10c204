// Records are read back as they were written; chunks stay within their bounds; cuts hold what lies in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "collected.hpp"
#include "mcap/rewrite.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

using mcap::Damage;
using testing::HasSubstr;

TEST(Mcap, IsReadBackAsWritten) {
  const Folder folder;
  const auto written = write_log(folder / "a.mcap", 500);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap.part"));
  Collected read;
  const auto scan = mcap::scan(folder / "a.mcap", read, Damage::refused);
  EXPECT_TRUE(read.messages == written);
  EXPECT_TRUE(scan.is_whole);
  EXPECT_EQ(scan.profile, "test");
  EXPECT_EQ(scan.bytes, std::filesystem::file_size(folder / "a.mcap"));
  ASSERT_EQ(read.all_metadata.size(), 1u);
  EXPECT_EQ(read.all_metadata[0].values.at("world"), "hall");
  EXPECT_EQ(read.channels.at(0).metadata.at("a"), "b");
  EXPECT_EQ(read.schemas.at(1).data, "string text\n");
}

// 5 s in chunks of at most half a second: each holds 51 of the times 0, 0.01, ... 4.99 s.
TEST(Mcap, AChunkSpansHalfASecondAtMost) {
  const Folder folder;
  write_log(folder / "a.mcap", 500);
  Collected read;
  EXPECT_EQ(mcap::scan(folder / "a.mcap", read, Damage::refused).chunks, 10u);  // 9 of 51, one of 41
}

TEST(Mcap, AChunkHoldsSoManyBytesAtMost) {
  const Folder folder;
  write_log(folder / "a.mcap", 40, 100'000);  // 0.4 s in 8 MB: two messages a chunk
  Collected read;
  EXPECT_EQ(mcap::scan(folder / "a.mcap", read, Damage::refused).chunks, 40u);
}

TEST(Mcap, ACutHoldsWhatLiesInIt) {
  const Folder folder;
  auto expected = write_log(folder / "a.mcap", 300);
  const mcap::Span span{1'000'000'000, 2'000'000'000};
  const auto done = mcap::rewrite(folder / "a.mcap", folder / "b.mcap", Damage::refused, span);
  std::erase_if(expected, [&](const auto& m) { return m.time < span.first || m.time >= span.end; });
  Collected read;
  mcap::scan(folder / "b.mcap", read, Damage::refused);
  EXPECT_EQ(read.messages.size(), 200u);
  EXPECT_TRUE(read.messages == expected);
  EXPECT_EQ(done.messages, 200u);
  EXPECT_EQ(done.first_time, 1'000'000'000u);
  EXPECT_EQ(done.last_time, 1'990'000'000u);
  EXPECT_EQ(read.all_metadata.size(), 1u);
}

TEST(Mcap, WhatStandsIsInEveryCut) {
  const Folder folder;
  {
    mcap::Writer writer(folder / "a.mcap", {});
    const auto walls = writer.channel({0, 0, "/walls", "", {{mcap::still, "true"}}});
    const auto moving = writer.channel({0, 0, "/moving", "", {}});
    writer.message({walls, 0, 0, 0, "walls"});
    for (std::uint32_t i = 0; i < 10; ++i) writer.message({moving, i, i * 1'000'000'000ull, 0, "here"});
    writer.close();
  }
  mcap::rewrite(folder / "a.mcap", folder / "b.mcap", Damage::refused, {4'000'000'000, 6'000'000'000});
  Collected read;
  mcap::scan(folder / "b.mcap", read, Damage::refused);
  ASSERT_EQ(read.messages.size(), 3u);
  EXPECT_EQ(read.messages[0], (Collected::Kept{"/walls", 0, 4'000'000'000, "walls"}));
  EXPECT_EQ(read.messages[1].sequence, 4u);
}

// Two runs into one file: the second is refused before its first record, and the first is whole.
TEST(Mcap, OneAtATimeWritesAFile) {
  const Folder folder;
  const auto file = folder / "a.mcap";
  mcap::Writer first(file, {"test", "first"});
  const auto channel = first.channel({0, 0, "/here", "", {}});
  first.message({channel, 0, 0, 0, "before"});
  first.flush();
  try {
    mcap::Writer second(file, {"test", "second"});
    ADD_FAILURE() << "it was not refused";
  } catch (const Error& refused) {
    EXPECT_EQ(refused.exit(), Exit::io);
    EXPECT_EQ(folder.inside(refused.what()), "a.mcap: is written by another run at this time; expected another file");
  }
  first.message({channel, 1, 1, 1, "after"});
  first.close();
  Collected read;
  EXPECT_TRUE(mcap::scan(file, read, Damage::refused).is_whole);
  EXPECT_EQ(read.messages.size(), 2u);
  EXPECT_NO_THROW(mcap::Writer(file, {"test", "third"}).close());
}

TEST(Mcap, AFileIsRewrittenOntoItself) {
  const Folder folder;
  const auto written = write_log(folder / "a.mcap", 100);
  mcap::rewrite(folder / "a.mcap", folder / "a.mcap", Damage::refused);
  Collected read;
  mcap::scan(folder / "a.mcap", read, Damage::refused);
  EXPECT_TRUE(read.messages == written);
}

TEST(Mcap, AFolderThatIsNotThereIsAnErrorOfWriting) {
  const Folder folder;
  try {
    mcap::Writer writer(folder / "none/a.mcap", {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::io);
    EXPECT_THAT(e.what(), HasSubstr("none/a.mcap: cannot be written: No such file or directory"));
  }
}

}  // namespace
}  // namespace muster::test
