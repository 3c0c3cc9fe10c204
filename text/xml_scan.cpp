#include "xml_scan.hpp"

#include <algorithm>
#include <charconv>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "names.hpp"

namespace muster {
namespace {

constexpr std::size_t most_depth = 64;  // tinyxml2 stops at 98; a world needs five
constexpr std::size_t most_name_bytes = 256;
constexpr std::size_t most_tag_bytes = 64 << 10;
constexpr std::size_t most_attributes = 256;   // of one tag: tinyxml2 takes quadratic time in their number
constexpr std::size_t most_parts = 1'000'000;  // elements and attributes in all

constexpr std::string_view white_space = " \t\r\n";

// Characters that tinyxml2 accepts in names.
bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || (c & 0x80);
}
bool continues_name(char c) { return starts_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

// XML 1.0, production 2.
bool is_xml_character(std::uint32_t code) {
  return code == 0x9 || code == 0xA || code == 0xD || (code >= 0x20 && code <= 0xD7FF) ||
         (code >= 0xE000 && code <= 0xFFFD) || (code >= 0x10000 && code <= 0x10FFFF);
}

class Scan {
 public:
  Scan(const TextFile& file, CheckRoot check_root, const InPlaceOfText& in_place_of_text)
      : file_(file), text_(file.text), check_root_(check_root), in_place_of_text_(in_place_of_text) {}

  std::vector<XmlSpot> run() {
    check_characters();
    while (skip_to_markup()) scan_markup();
    if (!open_.empty()) {
      const std::string name(open_.back().name);
      fail(open_.back().at, "<" + name + "> is not closed; expected </" + name + "> before the end of the file");
    }
    if (!has_root_) fail(text_.size(), "no element in the file; expected an XML element");
    return std::move(spots_);
  }

 private:
  struct Name {
    std::string_view name;
    std::size_t at;
    auto operator<=>(const Name&) const = default;
  };

  [[noreturn]] void fail(std::size_t at, const std::string& what) const { throw invalid(file_.place(at), what); }

  bool next_is(std::string_view token) const { return text_.substr(at_).starts_with(token); }
  void skip_space() { at_ = std::min(text_.find_first_not_of(white_space, at_), text_.size()); }

  void check_characters() const {
    const auto is_control = [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; };
    const auto found = std::find_if(text_.begin(), text_.end(), is_control);
    if (found == text_.end()) return;
    fail(static_cast<std::size_t>(found - text_.begin()),
         "the control character " + quote({found, found + 1}) + " is not allowed");
  }

  // The text as an attribute of the element around its own, or, where only the root is around, of its own.
  std::string as_attribute(std::string_view words) const {
    const std::string own(open_.back().name);
    if (open_.size() < 3) return own + " NAME=\"VALUE\"";
    return std::string(open_[open_.size() - 2].name) + ' ' + own + "=\"" + std::string(words.substr(0, 40)) + '"';
  }

  // False at the end of the file.
  bool skip_to_markup() {
    skip_space();
    if (at_ == text_.size()) return false;
    if (text_[at_] == '<') return true;
    const std::string_view words = text_.substr(at_, text_.find_first_of("<\r\n", at_) - at_);
    if (text_.substr(0, at_).find('<') == text_.npos)
      fail(at_, "the file begins with " + quote(words) + "; expected XML, which begins with <");
    const std::string what = "the text " + quote(words) + " stands between elements; ";
    std::vector<std::string_view> tags;
    for (const Name& each : open_) tags.push_back(text_.substr(each.at + 1, text_.find('>', each.at) - each.at - 1));
    std::string instead;
    try {
      if (in_place_of_text_) instead = in_place_of_text_(tags, words);
    } catch (const FaultOfElement& fault) {
      throw invalid(file_.place(open_.at(fault.depth).at), fault.what);
    }
    if (!instead.empty()) fail(at_, what + instead);
    fail(at_, what + "expected elements and comments only" +
                  (open_.size() < 2 ? "" : ", and values as attributes: <" + as_attribute(words) + "/>"));
  }

  void scan_markup() {
    if (next_is("<!--")) return skip_past("<!--", "-->", "comment");
    if (next_is("<![CDATA[")) fail(at_, "CDATA is text; expected elements and comments only");
    if (next_is("<!")) fail(at_, "entities are not supported; expected no <!DOCTYPE> and no <!ENTITY>");
    if (next_is("<?")) return scan_declaration();
    if (next_is("</")) return scan_end_tag();
    scan_tag();
  }

  void skip_past(std::string_view start, std::string_view end, const std::string& what) {
    const std::size_t found = text_.find(end, at_ + start.size());
    if (found == text_.npos) fail(at_, "the " + what + " is not closed; expected " + std::string(end));
    at_ = found + end.size();
    only_declarations_ = only_declarations_ && start == "<?";
  }

  void scan_declaration() {
    const std::size_t start = at_;
    if (!only_declarations_) fail(start, "a declaration <? ?> is allowed only at the start of the file");
    skip_past("<?", "?>", "declaration");
    std::string declaration(text_.substr(start, at_ - start));
    const std::size_t encoding = declaration.find("encoding");
    if (!declaration.starts_with("<?xml ") || encoding == declaration.npos) return;
    for (char& c : declaration) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (declaration.find("utf-8", encoding) == declaration.npos &&
        declaration.find("us-ascii", encoding) == declaration.npos) {
      fail(start + encoding, "the declared encoding is not supported; expected encoding=\"UTF-8\"");
    }
  }

  std::string_view scan_name() {
    const std::size_t start = at_;
    if (at_ < text_.size() && starts_name(text_[at_])) {
      while (at_ < text_.size() && continues_name(text_[at_])) ++at_;
    }
    if (at_ - start > most_name_bytes) {
      fail(start, "a name is too long; expected at most " + std::to_string(most_name_bytes) + " bytes");
    }
    return text_.substr(start, at_ - start);
  }

  // An element inside which another one's end comes is itself not closed, as <wall ...> without "/"; of several the
  // first is told. Where nothing of the name is open, the end is misspelt.
  [[noreturn]] void fail_end(std::size_t at, const std::string& name) const {
    const auto same = std::find_if(open_.rbegin(), open_.rend(), [&](const Name& each) { return each.name == name; });
    const std::string end = "</" + name + ">";
    if (same == open_.rend()) {
      const std::string expected(open_.back().name);
      fail(at, end + " does not match <" + expected + "> of line " + std::to_string(file_.place(open_.back().at).line) +
                   "; expected </" + expected + ">");
    }
    const Name& first = *same.base();
    const Place there = file_.place(at);
    const std::string own(first.name);
    fail(first.at, "<" + own + "> is not closed where " + end + " comes, at " + std::to_string(there.line) + ":" +
                       std::to_string(there.column) + "; expected \"/>\" at the end of the tag <" + own +
                       " ...>, or </" + own + ">");
  }

  void scan_end_tag() {
    const std::size_t start = at_;
    at_ += 2;
    const std::string name(scan_name());
    skip_space();
    if (!next_is(">")) fail(start, "the tag </" + name + "> is cut off; expected '>'");
    ++at_;
    if (open_.empty()) fail(start, "</" + name + "> closes nothing");
    if (open_.back().name != name) fail_end(start, name);
    open_.pop_back();
  }

  void scan_tag() {
    only_declarations_ = false;
    tag_ = at_++;
    const std::string_view name = scan_name();
    if (name.empty()) fail(tag_, "'<' without a name; expected an element");
    if (has_root_ && open_.empty()) fail(tag_, "<" + std::string(name) + "> is a second root element; expected one");
    if (open_.size() == most_depth) {
      fail(tag_, quote(name) + " is nested too deep; expected at most " + std::to_string(most_depth) +
                     " elements in each other");
    }
    if (!has_root_ && check_root_) check_root_(std::string(name), file_.place(tag_));
    has_root_ = true;
    count_part(tag_);
    add_spot(tag_);
    scan_attributes(name);
    if (next_is("/>")) {
      at_ += 2;
    } else {
      at_ += 1;
      open_.push_back({name, tag_});
    }
  }

  // Ends at the tag's '>' or '/>'.
  void scan_attributes(std::string_view tag) {
    attributes_.clear();
    for (;;) {
      const std::size_t before = at_;
      skip_space();
      if (at_ - tag_ > most_tag_bytes) {
        fail(tag_,
             "the tag " + quote(tag) + " is too long; expected at most " + std::to_string(most_tag_bytes) + " bytes");
      }
      if (next_is(">") || next_is("/>")) break;
      if (at_ == text_.size()) fail(tag_, "the tag " + quote(tag) + " is cut off; expected '>'");
      if (at_ == before)
        fail(at_, "a space is missing in the tag " + quote(tag) + "; expected one before an attribute");
      if (attributes_.size() == most_attributes) {
        fail(tag_,
             "the tag " + quote(tag) + " has too many attributes; expected at most " + std::to_string(most_attributes));
      }
      scan_attribute(tag);
    }
    check_duplicates(tag);
  }

  // A value whose author sees quotes around it is in those of a word processor.
  [[noreturn]] void fail_quotes(std::string_view name) const {
    static constexpr std::string_view typographic[] = {"\u201C", "\u201D", "\u201E", "\u2018", "\u2019",
                                                       "\u00AB", "\u00BB", "\u2033", "\u00B4", "`"};
    const std::string own(name);
    for (const std::string_view opens : typographic) {
      if (!next_is(opens)) continue;
      const std::size_t from = at_ + opens.size();
      std::size_t to = text_.find_first_of("<>\r\n", from);
      for (const std::string_view closes : typographic) to = std::min(to, text_.find(closes, from));
      const std::string value(text_.substr(from, std::min(to, text_.size()) - from));
      fail(at_, "the value of " + quote(name) + " stands in typographic quotes, " + std::string(opens) +
                    ", as word processors and web pages have them; expected straight ones: " + own + "=" +
                    quote(value));
    }
    const std::size_t to = text_.find_first_of(" \t\r\n/>", at_);
    const std::string_view value = text_.substr(at_, std::min(to, text_.size()) - at_);
    fail(at_, "the value of " + quote(name) + " is not in quotes; expected " + own + "=" +
                  (value.empty() ? "\"...\"" : quote(value)));
  }

  void scan_attribute(std::string_view tag) {
    const std::size_t start = at_;
    const std::string_view name = scan_name();
    if (name.empty())
      fail(start, quote(text_.substr(start, 1)) + " in the tag " + quote(tag) + "; expected an attribute's name");
    count_part(start);
    attributes_.push_back({name, start});
    const std::string expected = "; expected " + std::string(name) + "=\"...\"";
    skip_space();
    if (!next_is("=")) fail(start, "attribute " + quote(name) + " has no value" + expected);
    ++at_;
    skip_space();
    if (!next_is("\"") && !next_is("'")) fail_quotes(name);
    const char stops[] = {text_[at_], '<', '\0'};
    const std::size_t value = at_ + 1;
    at_ = text_.find_first_of(stops, value);
    if (at_ == text_.npos) fail(value, "the value of " + quote(name) + " is cut off; expected a closing " + stops[0]);
    if (text_[at_] == '<')
      fail(at_, "'<' in the value of " + quote(name) + "; expected " +
                    (name == "when" ? "the word below: when=\"robot/rover/pose/x below 4\", or " : "") + "a closing " +
                    stops[0] + (name == "when" ? "" : " or &lt;"));
    check_references(value, text_.substr(value, at_ - value));
    ++at_;
    add_spot(start);
    add_spot(value);
  }

  // Accepts the five named characters and numbers of allowed characters. Searches the value only: otherwise the scan
  // would take quadratic time.
  void check_references(std::size_t place, std::string_view value) const {
    for (std::size_t from = value.find('&'); from != value.npos; from = value.find('&', from + 1)) {
      const std::size_t end = value.find(';', from);
      if (end == value.npos) fail(place + from, "'&' in a value; expected &amp;");
      const std::string_view name = value.substr(from + 1, end - from - 1);
      if (name.starts_with('#')) {
        check_character_reference(place + from, name.substr(1));
      } else if (name != "lt" && name != "gt" && name != "amp" && name != "quot" && name != "apos") {
        fail(place + from,
             "entities are not supported: " + quote(name) + "; expected &lt; &gt; &amp; &quot; or &apos;");
      }
    }
  }

  void check_character_reference(std::size_t at, std::string_view number) const {
    const int base = number.starts_with('x') ? 16 : 10;
    const std::string_view digits = number.substr(base == 16 ? 1 : 0);
    std::uint32_t code = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, base);
    const bool whole = error == std::errc{} && stop == digits.data() + digits.size();
    if (!whole || !is_xml_character(code))
      fail(at, quote("&#" + std::string(number) + ";") + " is not a character of XML");
  }

  void check_duplicates(std::string_view tag) {
    std::sort(attributes_.begin(), attributes_.end());
    const auto same = [](const Name& a, const Name& b) { return a.name == b.name; };
    const auto twice = std::adjacent_find(attributes_.begin(), attributes_.end(), same);
    if (twice == attributes_.end()) return;
    fail(std::next(twice)->at,
         "attribute " + quote(twice->name) + " stands twice in the tag " + quote(tag) + "; expected one");
  }

  void count_part(std::size_t at) {
    if (parts_++ < most_parts) return;
    fail(at, "too many elements and attributes; expected at most " + std::to_string(most_parts));
  }

  // Counts on from the last spot, so that all spots together cost one pass.
  void add_spot(std::size_t at) {
    for (; spot_at_ < at; ++spot_at_) {
      const char c = text_[spot_at_];
      if (c == '\n') {
        ++spot_.line;
        spot_.column = 1;
      } else if ((c & 0xC0) != 0x80) {
        ++spot_.column;
      }
    }
    spots_.push_back(spot_);
  }

  const TextFile& file_;
  const std::string_view text_;
  const CheckRoot check_root_;
  const InPlaceOfText& in_place_of_text_;
  std::size_t at_ = 0;
  std::size_t parts_ = 0;
  std::size_t tag_ = 0;  // start of the present tag
  bool only_declarations_ = true;
  bool has_root_ = false;
  std::vector<Name> open_;
  std::vector<Name> attributes_;  // of the present tag
  std::vector<XmlSpot> spots_;
  XmlSpot spot_{1, 1};
  std::size_t spot_at_ = 0;
};

}  // namespace

std::vector<XmlSpot> scan_xml(const TextFile& file, CheckRoot check_root, const InPlaceOfText& in_place_of_text) {
  return Scan(file, check_root, in_place_of_text).run();
}

}  // namespace muster
