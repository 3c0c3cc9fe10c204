// A record's values stand in the payload, each once, under their names; long tables are thinned evenly, and the payload
// tells.
#include "viewer/payload.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "decoded.hpp"
#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* run_json = R"({"format": "muster.run/1",
  "run": {"world": "w", "dt": 0.5, "time": 2, "events": []}, "scene": {"walls": [{"name": "w1"}]},
  "tables": [
    {"table": "robot/*/pose", "file": "robot_pose.csv", "kind": "live", "columns": "x[m] y[m]", "every": 1},
    {"table": "inbox/*/message", "file": "inbox_message.csv", "kind": "queue",
     "columns": "radio:radio from:radio rssi[dBm] lqi? payload{}", "every": 1},
    {"table": "link/*/rssi", "file": "link_rssi.csv", "kind": "listed", "columns": "rssi[dBm]?", "every": 1},
    {"table": "scan/*/message", "file": "scan_message.csv", "kind": "queue", "columns": "robot:robot ranges{}", "every": 1}]})";

struct Record : Folder {
  Record() {
    Folder& folder = *this;
    folder.write("run.json", run_json);
    folder.write("robot_pose.csv",
                 "t[s],robot,x[m],y[m]\n0,b,0.1,1e-9\n0,a,1,0.3333333333333333\n0.5,b,0.2,2\n0.5,a,1.5,4\n1,b,0.3,5\n");
    folder.write(
        "inbox_message.csv",
        "t[s],inbox,radio,from,rssi[dBm],lqi,payload\n0.5,0,b,a,-60.25,,626561\n0.5,1,\"1\",a,-61,255,\n1,2,b,a,"
        "-62,,00\n");
    folder.write("link_rssi.csv", "t[s],link,rssi[dBm]\n0,0,-50\n0,1,\n0.5,0,-51\n0.5,1,-70.125\n");
    folder.write("scan_message.csv",
                 "t[s],scan,robot,ranges\n0.5,0,a,000000000000f83f000000000000f07f\n1,1,a,0000000000000040\n");
  }
};

Opened opened_payload(const Folder& folder, std::uint64_t most = 1000) {
  return opened(viewer::payload_of(viewer::read_record_folder(folder.path()), most).container);
}

TEST(Payload, RowsAreGroupedByRobotInTheOrderOfTime) {
  const auto payload = opened_payload(Record());
  const Read& poses = payload.head["tables"][0];
  EXPECT_EQ(poses["table"], "robot/*/pose");
  EXPECT_EQ(poses["rows"], 5);
  EXPECT_EQ(poses["key"], Read::parse(R"({"column": "robot", "values": ["b", "a"], "starts": [0, 3, 5]})"));
  EXPECT_THAT(numbers(column(poses, "t"), payload.bytes), ElementsAre(0, 0.5, 1, 0, 0.5));
  EXPECT_THAT(names(column(poses, "robot"), payload.bytes), ElementsAre("b", "b", "b", "a", "a"));
  EXPECT_THAT(numbers(column(poses, "x"), payload.bytes), ElementsAre(0.1, 0.2, 0.3, 1, 1.5));
  EXPECT_THAT(numbers(column(poses, "y"), payload.bytes), ElementsAre(1e-9, 2, 5, 0.3333333333333333, 4));
}

TEST(Payload, MessagesAreGroupedByTheirReceiverAndBytesAreCounted) {
  const auto payload = opened_payload(Record());
  const Read& messages = payload.head["tables"][1];
  EXPECT_EQ(messages["key"], Read::parse(R"({"column": "radio", "values": ["b", "1"], "starts": [0, 2, 3]})"));
  EXPECT_THAT(numbers(column(messages, "rssi"), payload.bytes), ElementsAre(-60.25, -62, -61));
  EXPECT_THAT(numbers(column(messages, "lqi"), payload.bytes), ElementsAre(testing::IsNan(), testing::IsNan(), 255));
  EXPECT_THAT(numbers(column(messages, "payload"), payload.bytes), ElementsAre(3, 1, 0));
  EXPECT_EQ(messages["columns"][6]["unit"], "bytes");
}

TEST(Payload, LinksAreGroupedByNumberAndScansKeepTheirRanges) {
  const auto payload = opened_payload(Record());
  const Read& links = payload.head["tables"][2];
  EXPECT_EQ(links["key"], Read::parse(R"({"column": "link", "values": ["0", "1"], "starts": [0, 2, 4]})"));
  EXPECT_THAT(numbers(column(links, "rssi"), payload.bytes), ElementsAre(-50, -51, testing::IsNan(), -70.125));
  const Read& ranges = column(payload.head["tables"][3], "ranges");
  EXPECT_THAT(numbers(ranges["lengths"], payload.bytes), ElementsAre(2, 1));
  EXPECT_THAT(numbers(ranges["values"], payload.bytes), ElementsAre(1.5, std::numeric_limits<double>::infinity(), 2));
}

TEST(Payload, RunAndSceneAreThoseOfTheRecord) {
  const auto payload = opened_payload(Record());
  EXPECT_EQ(payload.head["run"], Read::parse(run_json)["run"]);
  EXPECT_EQ(payload.head["scene"], Read::parse(run_json)["scene"]);
  EXPECT_THAT(payload.head["notes"], IsEmpty());
}

TEST(Payload, LongTablesAreThinnedEvenlyAndSaid) {
  const Record folder;
  std::string rows = "t[s],robot,x[m],y[m]\n";
  for (int tick = 0; tick < 100; ++tick) {
    for (const char* robot : {"a", "b"})
      rows += std::to_string(tick / 2.0) + "," + robot + "," + std::to_string(tick) + ",0\n";
  }
  folder.write("robot_pose.csv", rows);
  const auto payload = opened_payload(folder, 300);
  const Read& poses = payload.head["tables"][0];
  EXPECT_EQ(poses["kept_every"], 4);
  EXPECT_EQ(poses["rows"], 50);
  EXPECT_EQ(poses["times_in_record"], 100);
  EXPECT_EQ(numbers(column(poses, "x"), payload.bytes)[1], 4);
  EXPECT_EQ(payload.head["tables"][1]["kept_every"], 1);
  EXPECT_THAT(payload.head["notes"],
              ElementsAre("robot/*/pose: of every 4 recorded times one is in the page; robot_pose.csv has all"));
}

TEST(Payload, OnlyWhatExceedsItsShareIsThinned) {
  EXPECT_THAT(viewer::thinning({}, 10), IsEmpty());
  EXPECT_THAT(viewer::thinning({10, 20, 30}, 60), ElementsAre(1, 1, 1));
  EXPECT_THAT(viewer::thinning({10, 20, 31}, 60), ElementsAre(1, 1, 2));
  EXPECT_THAT(viewer::thinning({1000, 10, 1000}, 110), ElementsAre(20, 1, 20));
  EXPECT_THAT(viewer::thinning({5, 5}, 1), ElementsAre(5, 5));
}

TEST(Payload, GzipAndBase64AreTheUsualOnes) {
  EXPECT_EQ(viewer::base64(""), "");
  EXPECT_EQ(viewer::base64("f"), "Zg==");
  EXPECT_EQ(viewer::base64("fo"), "Zm8=");
  EXPECT_EQ(viewer::base64("foo"), "Zm9v");
  EXPECT_EQ(viewer::base64(std::string("\xff\0\x80\xfe", 4)), "/wCA/g==");
  const std::string text(100'000, 'x');
  const std::string packed = viewer::gzipped(text);
  EXPECT_LT(packed.size(), 200u);
  std::string unpacked(text.size() + 1, '\0');
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
  stream.avail_out = static_cast<uInt>(unpacked.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  unpacked.resize(stream.total_out);
  inflateEnd(&stream);
  EXPECT_EQ(unpacked, text);
}

std::string failure(const Folder& folder) {
  try {
    viewer::payload_of(viewer::read_record_folder(folder.path()), 1000);
  } catch (const Error& e) {
    return folder.inside(e.what());
  }
  return "";
}

TEST(Payload, ARecordThatContradictsItselfIsRefused) {
  const Record folder;
  std::filesystem::remove(folder / "link_rssi.csv");
  EXPECT_EQ(failure(folder), "link_rssi.csv: no such file; run.json lists this table, run the world again");
  folder.write("link_rssi.csv", "t[s],link\n0,0\n");
  EXPECT_EQ(failure(folder),
            "link_rssi.csv: has other columns than run.json declares for link/*/rssi; run the world again");
  folder.write("run.json", "{\"format\": \"muster.run/1\", \"run\": {\"world\": 3}}");
  EXPECT_EQ(failure(folder), "run.json: lacks what a run's record has; run the world again");
  folder.write("run.json", "{\"format\": \"muster.run/2\"}");
  EXPECT_EQ(failure(folder), "run.json: has the format \"muster.run/2\"; expected \"muster.run/1\"");
  folder.write("run.json", "{\"format\":\n oops}");
  EXPECT_EQ(failure(folder), "run.json:2:2: is not the JSON of a run; run the world again");
}

}  // namespace
}  // namespace muster::test
