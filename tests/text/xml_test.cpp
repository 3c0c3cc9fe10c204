#include "text/xml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "error_of.hpp"
#include "large_xml.hpp"

namespace muster {
namespace {

std::string places(const XmlElement& element) {
  const auto text = [](const Place& place) { return std::to_string(place.line) + ":" + std::to_string(place.column); };
  std::string result = element.name + "@" + text(element.place);
  for (const XmlAttribute& a : element.attributes) {
    result += " " + a.name + "@" + text(a.place) + "=" + a.value + "@" + text(a.value_place);
  }
  for (const XmlElement& child : element.children) result += " (" + places(child) + ")";
  return result;
}

class Xml : public test::FolderTest {
 protected:
  XmlElement read(std::string_view bytes) { return read_xml(write("w.xml", bytes)); }
  std::string error(std::string_view bytes) {
    return test::error_of([&] { read(bytes); }, folder);
  }
  std::string error_of_path(const std::filesystem::path& path) {
    return test::error_of([&] { read_xml(path); }, folder);
  }
};

TEST_F(Xml, ReadsATreeWithPlaces) {
  EXPECT_EQ(places(read("<world dt=\"0.01\">\n  <!-- <robot> -->\n  <wall name = 'w1'\n        from=\"0 0\"/>\n"
                        "  <a><b c='1'/></a>\n</world>\n")),
            "world@1:1 dt@1:8=0.01@1:12 (wall@3:3 name@3:9=w1@3:17 from@4:9=0 0@4:15) (a@5:3 (b@5:6 c@5:9=1@5:12))");
}

TEST_F(Xml, CountsColumnsInCharacters) {
  EXPECT_EQ(places(read("<ä é=\"日本\" b='2'/>")), "ä@1:1 é@1:4=日本@1:7 b@1:11=2@1:14");
}

TEST_F(Xml, TakesByteOrderMarkDeclarationAndCrlf) {
  EXPECT_EQ(places(read("\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"UTF-8\"?>\r\n<!-- x -->\r\n<w a='1'/>\r\n")),
            "w@3:1 a@3:4=1@3:7");
}

TEST_F(Xml, ReplacesReferences) {
  const XmlElement w = read("<w a='&lt;&gt;&amp;&quot;&apos;&#65;&#x42;&#xe9;' b='>'/>");
  ASSERT_NE(w.attribute("a"), nullptr);
  EXPECT_EQ(w.attribute("a")->value, "<>&\"'ABé");
  EXPECT_EQ(w.attribute("b")->value, ">");
  EXPECT_EQ(w.attribute("c"), nullptr);
}

TEST_F(Xml, ErrorNamesFileLineAndColumn) {
  EXPECT_EQ(test::error_of([&] { read("<w>\n <a b='1' b='2'/></w>"); }),
            (folder / "w.xml").string() + ":2:11: attribute \"b\" stands twice in the tag \"a\"; expected one");
}

TEST_F(Xml, RefusesWhatIsNoTextFile) {
  EXPECT_EQ(error_of_path(folder / "absent.xml"), "absent.xml: no such file");
  EXPECT_EQ(error_of_path(folder / "w.xml" / "x"), "w.xml/x: no such file");
  std::filesystem::create_directory(folder / "d");
  EXPECT_EQ(error_of_path(folder / "d"), "d: is a directory; expected a file");
  EXPECT_EQ(error_of_path("/dev/zero"), "/dev/zero: is not a regular file");
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(error_of_path(folder / "fifo"), "fifo: is not a regular file");
  write("big", "<w/>");
  std::filesystem::resize_file(folder / "big", 5'000'000'000);  // sparse
  EXPECT_EQ(error_of_path(folder / "big"), "big: has 5000000000 bytes; expected at most 16777216");
}

TEST_F(Xml, RefusesWrongEncodings) {
  const std::string latin =
      "; is it Latin-1, as editors of Windows write? expected UTF-8: iconv -f ISO-8859-1 -t UTF-8 w.xml > NEW";
  EXPECT_EQ(error(""), "w.xml: is empty; expected an XML element");
  EXPECT_EQ(error("\xEF\xBB\xBF"), "w.xml: is empty; expected an XML element");
  EXPECT_EQ(error(std::string_view("\xFF\xFE<\0w\0", 6)),
            "w.xml: is UTF-16; expected UTF-8: iconv -f UTF-16 -t UTF-8 w.xml > NEW");
  EXPECT_EQ(error(std::string_view("\xFE\xFF\0<", 4)),
            "w.xml: is UTF-16; expected UTF-8: iconv -f UTF-16 -t UTF-8 w.xml > NEW");
  EXPECT_EQ(error(std::string_view("<\0w\0", 4)), R"(w.xml:1:2: the control character "\x00" is not allowed)");
  EXPECT_EQ(error("<w a='\x01'/>"), R"(w.xml:1:7: the control character "\x01" is not allowed)");
  EXPECT_EQ(error("\x1F\x8B\x08"), "w.xml: is compressed by gzip; expected plain text");
  EXPECT_EQ(error("<w>\n  <é a=\"\xE9\"/>\n</w>"), "w.xml:2:9: byte 14 of the file, 0xe9, is not valid UTF-8" + latin);
  EXPECT_EQ(error("\xEF\xBB\xBF<w\xC0\x80/>"), "w.xml:1:3: byte 6 of the file, 0xc0, is not valid UTF-8" + latin);
  EXPECT_EQ(error("<?xml version='1.0' encoding='ISO-8859-1'?>\n<w a='B\xFCro'/>"),
            "w.xml:2:8: byte 52 of the file, 0xfc, is not valid UTF-8; the file says encoding=\"ISO-8859-1\", expected "
            "UTF-8: iconv -f ISO-8859-1 -t UTF-8 w.xml > NEW, and encoding=\"UTF-8\" in its first line");
  for (const char* bad :
       {"\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF0\x80\x80\x80", "\xE0\x80\x80", "\xC3", "\x80", "\xF8"}) {
    EXPECT_THAT(error(std::string("<w a='") + bad + "'/>"), ::testing::HasSubstr("w.xml:1:7: byte 7 of the file"))
        << bad;
  }
  EXPECT_EQ(error("<?xml version='1.0' encoding='ISO-8859-1'?><w/>"),
            "w.xml:1:21: the declared encoding is not supported; expected encoding=\"UTF-8\"");
}

TEST_F(Xml, RefusesWhatIsNotWellFormed) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"<!-- only -->\n", "w.xml:2:1: no element in the file; expected an XML element"},
      {"<w>\n <a>\n", "w.xml:2:2: <a> is not closed; expected </a> before the end of the file"},
      {"<w>\n <a b='1'", "w.xml:2:2: the tag \"a\" is cut off; expected '>'"},
      {"<w>\n <a b=\"1", "w.xml:2:8: the value of \"b\" is cut off; expected a closing \""},
      {"<w a=\"1>\n<b/></w>", "w.xml:2:1: '<' in the value of \"a\"; expected a closing \" or &lt;"},
      {"<w></w", "w.xml:1:4: the tag </w> is cut off; expected '>'"},
      {"<w><!-- x", "w.xml:1:4: the comment is not closed; expected -->"},
      {"<?xml ", "w.xml:1:1: the declaration is not closed; expected ?>"},
      {"<w/>\n<?xml version='1.0'?>", "w.xml:2:1: a declaration <? ?> is allowed only at the start of the file"},
      {"<w/>\n<v/>", "w.xml:2:1: <v> is a second root element; expected one"},
      {"<w>\n<a></b></w>", "w.xml:2:4: </b> does not match <a> of line 2; expected </a>"},
      {"<w/></w>", "w.xml:1:5: </w> closes nothing"},
      {"<w a='1' b='2' a='3'/>", "w.xml:1:16: attribute \"a\" stands twice in the tag \"w\"; expected one"},
      {"<w a/>", "w.xml:1:4: attribute \"a\" has no value; expected a=\"...\""},
      {"<w a=1/>", "w.xml:1:6: the value of \"a\" is not in quotes; expected a=\"1\""},
      {"<w a=\u201Coffice\u201D/>",
       "w.xml:1:6: the value of \"a\" stands in typographic quotes, \u201C, as word processors and web pages have "
       "them; "
       "expected straight ones: a=\"office\""},
      {"<w>\n <a b='1'>\n <a/>\n</w>",
       "w.xml:2:2: <a> is not closed where </w> comes, at 4:1; expected \"/>\" at the end of the tag <a ...>, or </a>"},
      {"<w a='1'b='2'/>", "w.xml:1:9: a space is missing in the tag \"w\"; expected one before an attribute"},
      {"<w 1='1'/>", "w.xml:1:4: \"1\" in the tag \"w\"; expected an attribute's name"},
      {"<w>< a/></w>", "w.xml:1:4: '<' without a name; expected an element"},
  };
  for (const auto& [bytes, message] : cases) EXPECT_EQ(error(bytes), message);
}

TEST_F(Xml, IgnoresNothing) {
  EXPECT_EQ(error("<w>\n  hello <a/></w>"),
            "w.xml:2:3: the text \"hello \" stands between elements; expected elements and comments only");
  EXPECT_EQ(error("world:\n  name: lab\n"),
            "w.xml:1:1: the file begins with \"world:\"; expected XML, which begins with <");
  EXPECT_EQ(error("<w/>\nbye"),
            "w.xml:2:1: the text \"bye\" stands between elements; expected elements and comments only");
  EXPECT_EQ(error("<w><![CDATA[x]]></w>"), "w.xml:1:4: CDATA is text; expected elements and comments only");
  EXPECT_EQ(error("<w><?php x ?></w>"), "w.xml:1:4: a declaration <? ?> is allowed only at the start of the file");
}

TEST_F(Xml, RefusesEntities) {
  const std::string dtd = "entities are not supported; expected no <!DOCTYPE> and no <!ENTITY>";
  EXPECT_EQ(error("<?xml version='1.0'?>\n<!DOCTYPE w [<!ENTITY a 'ha'><!ENTITY b '&a;&a;'>]>\n<w>&b;</w>"),
            "w.xml:2:1: " + dtd);
  EXPECT_EQ(error("<!DOCTYPE w SYSTEM \"file:///etc/passwd\"><w/>"), "w.xml:1:1: " + dtd);
  EXPECT_EQ(error("<w a='1&x;'/>"),
            "w.xml:1:8: entities are not supported: \"x\"; expected &lt; &gt; &amp; &quot; or &apos;");
  EXPECT_EQ(error("<w a='this & that'/>"), "w.xml:1:12: '&' in a value; expected &amp;");
  for (const char* number :
       {"&#0;", "&#x0;", "&#x110000;", "&#xD800;", "&#x;", "&#;", "&#99999999999;", "&#-1;", "&#8;"}) {
    EXPECT_EQ(error(std::string("<w a='") + number + "'/>"),
              "w.xml:1:7: \"" + std::string(number) + "\" is not a character of XML");
  }
}

TEST_F(Xml, LimitsAreExact) {
  EXPECT_EQ(places(read(test::repeat("<a>", 64) + test::repeat("</a>", 64))).substr(0, 5), "a@1:1");
  EXPECT_EQ(error(test::repeat("<a>", 65) + test::repeat("</a>", 65)),
            "w.xml:1:193: \"a\" is nested too deep; expected at most 64 elements in each other");
  EXPECT_EQ(read(test::attributes(256)).attributes.size(), 256u);
  EXPECT_EQ(error(test::attributes(257)), "w.xml:1:1: the tag \"w\" has too many attributes; expected at most 256");
  EXPECT_EQ(read("<w a='" + std::string(65000, 'x') + "'/>").attributes[0].value.size(), 65000u);
  EXPECT_EQ(error("<w a='" + std::string(66000, 'x') + "'/>"),
            "w.xml:1:1: the tag \"w\" is too long; expected at most 65536 bytes");
  EXPECT_EQ(error("<w>" + test::repeat("<a/>", 1'000'000) + "</w>"),
            "w.xml:1:4000000: too many elements and attributes; expected at most 1000000");
}

}  // namespace
}  // namespace muster
