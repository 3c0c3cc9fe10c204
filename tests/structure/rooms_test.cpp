// Rooms stay small, and the inference core knows no domain.
#include "rooms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../folder.hpp"
#include "lines.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::filesystem::path root = MUSTER_SOURCE_DIR;
constexpr std::size_t most_units = 26;       // that a reader finds at a glance
constexpr std::size_t most_loose_files = 6;  // at the top of diagnosis/, whose rooms hold the rest

TEST(Rooms, NoFolderIsCrowded) {
  for (const char* folder : {"diagnosis", "exam", "plotting"}) {
    EXPECT_TRUE(std::filesystem::is_directory(root / folder)) << folder;
    const auto crowded = crowded_folders(root, folder, most_units);
    EXPECT_TRUE(crowded.empty()) << lines(crowded);
  }
}

TEST(Rooms, FilesOfTheDiagnosisLieInItsRooms) {
  const auto files = files_in(root, "diagnosis");
  EXPECT_LE(files.size(), most_loose_files) << lines(files);
}

TEST(Rooms, TheInferenceCoreKnowsNoDomain) {
  EXPECT_TRUE(std::filesystem::is_directory(root / "diagnosis/inference"));
  const auto words = domain_words(root, "diagnosis/inference");
  EXPECT_TRUE(words.empty()) << lines(words);
}

TEST(Rooms, UnitsAreCountedByFolder) {
  Folder tree;
  for (const char* file : {"a.hpp", "a.cpp", "b.hpp", "README.md", "below/a.hpp", "below/b.hpp", "below/c.cpp"})
    tree.write(std::string("room/") + file, "");
  EXPECT_THAT(crowded_folders(tree.path(), "room", 2), ElementsAre("room/below: 3 units; at most 2"));
  EXPECT_THAT(crowded_folders(tree.path(), "room", 3), IsEmpty());
  EXPECT_THAT(files_in(tree.path(), "room"), ElementsAre("a.cpp", "a.hpp", "b.hpp"));
}

TEST(Rooms, WordsAreTakenApart) {
  EXPECT_THAT(parts_of("tx_at"), ElementsAre("tx", "at"));
  EXPECT_THAT(parts_of("LinkModel2rx"), ElementsAre("link", "model", "rx"));
  EXPECT_THAT(parts_of("RSSIFloor"), ElementsAre("rssi", "floor"));
  EXPECT_THAT(parts_of("level_dBm"), ElementsAre("level", "dbm"));
}

TEST(Rooms, WordsOfADomainAreFound) {
  Folder tree;
  tree.write("core/a.hpp",
             "double tx_at;  // at its robot\nvoid LinkModel();\n// 3 dBm, RSSI\n#include \"diagnosis/radio/x.hpp\"\n");
  tree.write("core/b.cpp", "int linked, context, blink, matrix_x; // Cholesky, max, robotic, linker\n");
  tree.write("core/README.md", "knows no radio\n");
  EXPECT_THAT(domain_words(tree.path(), "core"),
              ElementsAre("core/a.hpp:1: tx_at", "core/a.hpp:1: robot", "core/a.hpp:2: LinkModel", "core/a.hpp:3: dBm",
                          "core/a.hpp:3: RSSI", "core/a.hpp:4: radio"));
}

}  // namespace
}  // namespace muster::test
