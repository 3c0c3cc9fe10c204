// Files that are no URDF at all are refused with line and reason, at once and on a small stack.
#include <gtest/gtest.h>
#include <pthread.h>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

TEST(UrdfFile, AbsentFolderEmptyAndDeviceAreRefused) {
  Files files;
  EXPECT_EQ(message_of([&] { read_robot(files.at("no.urdf")); }), files.at("no.urdf") + ": No such file or directory");
  EXPECT_EQ(message_of([&] { read_robot(files.at("")); }), files.at("") + ": is not a regular file");
  EXPECT_EQ(message_of([&] { read_robot("/dev/zero"); }), "/dev/zero: is not a regular file");
  const std::string empty = files.write("empty.urdf", "");
  EXPECT_EQ(message_of([&] { read_robot(empty); }), empty + ":1: is empty; expected <robot>");
}

TEST(UrdfFile, TooLargeIsRefusedUnread) {
  Files files;
  const std::string path = files.write("large.urdf", "<robot name='r'>");
  std::filesystem::resize_file(path, 5ull << 30);
  EXPECT_EQ(message_of([&] { read_robot(path); }), path + ": has 5368709120 bytes; expected at most 16777216");
}

TEST(UrdfFile, EntitiesAreRefused) {
  Files files;
  const std::string path = files.write(
      "e.urdf", "<?xml version='1.0'?>\n<!DOCTYPE r [<!ENTITY a SYSTEM 'file:///etc/passwd'>]>\n<robot name='r'/>");
  EXPECT_EQ(message_of([&] { read_robot(path); }),
            path + ":2: has a document type declaration; entities are not supported");
}

TEST(UrdfFile, TruncatedAndSecondRootAreRefused) {
  Files files;
  const std::string cut = files.write("cut.urdf", "<robot name='r'>\n<link name='a'>");
  EXPECT_EQ(message_of([&] { read_robot(cut); }),
            cut + ":2: is not XML: <link> is not closed; expected </link> before the end of the file");
  const std::string two = files.write("two.urdf", "<robot name='r'><link name='a'/></robot>\n<robot name='s'/>");
  EXPECT_EQ(message_of([&] { read_robot(two); }), two + ":2: has a second root element");
}

TEST(UrdfFile, WhatIsNotXmlIsSaidInWords) {
  Files files;
  const std::pair<const char*, const char*> texts[] = {
      {"<link name='a>b'>\n</lnk></robot>", "3: is not XML: </lnk> does not match <link> of line 2; expected </link>"},
      {"<link name='a'>\n<link name='b'/>\n</robot>",
       "2: is not XML: <link> is not closed where </robot> comes, in line 4; expected \"/>\" at the end of the tag "
       "<link ...>, or </link>"},
      {"<link name='a'/>", "1: is not XML: <robot> is not closed; expected </robot> before the end of the file"},
      {"</robot>\n</robot>", "3: is not XML: </robot> closes nothing"},
      {"<link name=a/></robot>", "2: is not XML: an attribute is wrong; expected NAME=\"VALUE\", each once in a tag"},
      {"<link name='a'",
       "2: is not XML: a tag is wrong or cut off; expected <NAME ATTRIBUTE=\"VALUE\"> or <NAME "
       "ATTRIBUTE=\"VALUE\"/>"},
      {"<!-- </robot>", "2: is not XML: a comment is not closed; expected -->"},
  };
  for (const auto& [text, message] : texts) {
    const std::string path = files.write("r.urdf", std::string("<robot name='r'>\n") + text);
    EXPECT_EQ(message_of([&] { read_robot(path); }), path + ":" + message);
  }
}

TEST(UrdfFile, ManyAttributesInOneTagAreRefusedAtOnce) {
  Files files;
  std::string text = "<robot name='r'>\n<link ";
  for (int i = 0; i < 40000; ++i) text.append("a").append(std::to_string(i)).append("='1' ");
  const std::string path = files.write("wide.urdf", text + "/></robot>");
  EXPECT_EQ(message_of([&] { read_robot(path); }), path + ":2: a tag is longer than 65536 bytes");
}

// On a thread with a stack of 1 MB, as a pool may have.
TEST(UrdfFile, DeepNestingIsRefusedOnASmallStack) {
  Files files;
  std::string text = "<robot name='r'>\n";
  for (int i = 0; i < 30000; ++i) text += "<link name='a'>";
  const std::string path = files.write("deep.urdf", text);
  struct Job {
    std::string path, message;
  } job{path, ""};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, 1u << 20);
  pthread_t thread;
  ASSERT_EQ(pthread_create(
                &thread, &attributes,
                [](void* argument) -> void* {
                  Job& here = *static_cast<Job*>(argument);
                  here.message = message_of([&] { read_robot(here.path); });
                  return nullptr;
                },
                &job),
            0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  EXPECT_EQ(job.message, path + ":2: elements are nested deeper than 100");
}

}  // namespace
}  // namespace muster::description
