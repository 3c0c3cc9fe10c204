// The page is the built one with title and run in it; a folder that is no record is refused with the nearest that is
// one.
#include "viewer/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "decoded.hpp"
#include "tests/folder.hpp"
#include "text/error.hpp"
#include "viewer/payload.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

std::string failure(const std::filesystem::path& record, const Folder& folder) {
  try {
    viewer::write_page(record, folder / "run.html", folder.path());
  } catch (const Error& e) {
    return folder.inside(e.what());
  }
  return "";
}

std::string run_json(const std::string& world) {
  return R"({"format": "muster.run/1", "run": {"world": ")" + world + R"(", "dt": 1}, "scene": {}, "tables": []})";
}

TEST(Page, HasTitleAndRunAtTheirPlaces) {
  Folder folder;
  folder.write("viewer/page.html", "<title>@TITLE@</title><h1>@TITLE@</h1><script>@PAYLOAD@</script>");
  folder.write("out/run.json", run_json("a <b> & c"));
  const auto written = viewer::write_page(folder / "out", folder / "run.html", folder.path());
  const auto payload = viewer::payload_of(viewer::read_record_folder(folder / "out"), 1000);
  const std::string page = folder.read("run.html");
  EXPECT_EQ(written.bytes, page.size());
  EXPECT_EQ(page, "<title>a &lt;b> &amp; c</title><h1>a &lt;b> &amp; c</h1><script>" +
                      viewer::base64(viewer::gzipped(payload.container)) + "</script>");
}

TEST(Page, AFolderThatIsNoRecordIsRefusedWithTheNearestThatIsOne) {
  Folder folder;
  folder.write("viewer/page.html", "@PAYLOAD@");
  folder.write("out/run1/run.json", run_json("w"));
  folder.write("out/run2/notes.txt", "");
  folder.write("world/world.xml", "<world/>");
  const std::string expected = "; expected a folder that `muster run WORLD --out DIR` wrote, with its run.json";
  EXPECT_EQ(failure(folder / "out/run2", folder),
            "out/run2: is no record of a run" + expected + "; did you mean \"out/run1\"?");
  EXPECT_EQ(failure(folder / "out/run3", folder),
            "out/run3: there is no such folder" + expected + "; did you mean \"out/run1\"?");
  EXPECT_EQ(failure(folder / "out", folder), "out: is no record of a run" + expected + "; did you mean \"out/run1\"?");
  EXPECT_EQ(failure(folder / "out/run2/notes.txt", folder), "out/run2/notes.txt: is no folder" + expected);
  EXPECT_EQ(failure(folder / "world", folder),
            "world: is no record of a run" + expected + "; this is a world: run it first");
}

TEST(Page, WhereTheBuildHasNoPageTheReasonAndTheRemedyAreGiven) {
  Folder folder;
  folder.write("out/run.json", run_json("w"));
  const std::string remedy =
      "; `scripts/setup --page` installs nodejs and npm, `scripts/viewer` then makes it, with the npm registry in "
      "reach";
  EXPECT_EQ(failure(folder / "out", folder), "viewer/page.html: is missing" + remedy);
  folder.write("viewer/page.missing", "npm ci failed: ENOTFOUND\n");
  EXPECT_EQ(failure(folder / "out", folder),
            "viewer/page.html: is missing, as the build had no page (npm ci failed: ENOTFOUND)" + remedy);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.html"));
}

TEST(Page, APlaceThatCannotBeWrittenIsNamed) {
  Folder folder;
  folder.write("viewer/page.html", "@PAYLOAD@");
  folder.write("out/run.json", run_json("w"));
  try {
    viewer::write_page(folder / "out", folder / "gone" / "run.html", folder.path());
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::io);
    EXPECT_THAT(e.what(), HasSubstr("gone/run.html: cannot be written: No such file or directory"));
  }
}

}  // namespace
}  // namespace muster::test
