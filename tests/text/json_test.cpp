#include "text/json.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace muster {
namespace {

TEST(Json, PrintsNumbersWithAPointInEveryLocale) {
  const Json list{true, -3, std::uint64_t{18446744073709551615u}, 0.1, 2.0, 1e300, nullptr};
  EXPECT_EQ(list.dump(), "[true,-3,18446744073709551615,0.1,2.0,1e+300,null]");
}

TEST(Json, HasNoNumberThatIsNotFinite) {
  EXPECT_TRUE(Json(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).dump(), "null");
}

TEST(Json, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(Json(std::string("a\xff"
                             "b"))
                .dump(),
            "\"a\xef\xbf\xbd"
            "b\"");
}

TEST(Json, TakesAListOfNamedValuesForAnObject) {
  EXPECT_EQ((Json{{"b", 1}, {"a", "x"}}).dump(), R"({"b":1,"a":"x"})");
  EXPECT_EQ((Json{{"b", 1}, "a"}).dump(), R"([["b",1],"a"])");
  EXPECT_EQ((Json{{"ends", {"b", "a"}}}).dump(), R"({"ends":["b","a"]})");
  EXPECT_EQ(Json(std::vector<std::string>{"b", "a"}).dump(), R"(["b","a"])");
  EXPECT_EQ(Json(std::map<std::string, double>{{"b", 1}, {"a", 2.5}}).dump(), R"({"a":2.5,"b":1.0})");
}

TEST(Json, KeepsMembersInTheirOrder) {
  Json object = Json::object();
  object["late"]["x"] = 1;
  object["early"].push_back(nullptr);
  object["late"]["x"] = 2;
  object.update({{"early", Json::array()}, {"last", Json::object()}});
  EXPECT_EQ(object.dump(), R"({"late":{"x":2},"early":[],"last":{}})");
  EXPECT_EQ(object.dump(1), "{\n \"late\": {\n  \"x\": 2\n },\n \"early\": [],\n \"last\": {}\n}");
}

TEST(Json, EscapesText) { EXPECT_EQ(Json("a\"\\\n\x01\u00e9/").dump(), "\"a\\\"\\\\\\n\\u0001\u00e9/\""); }

TEST(Json, ThrowsWhereAValueIsOfAnotherKind) {
  const Json object{{"x", 1.5}};
  EXPECT_EQ(object["x"].real(), 1.5);
  EXPECT_THROW(object["y"], std::logic_error);
  EXPECT_THROW(object["x"].text(), std::logic_error);
  EXPECT_THROW(object.elements(), std::logic_error);
  EXPECT_THROW(Json(1).push_back(2), std::logic_error);
}

}  // namespace
}  // namespace muster
