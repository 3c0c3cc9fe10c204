#include "fault_words.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr std::size_t most_words = 2'000;  // [bytes] of a message

// `; did you mean "size"? declared are size, colour`.
std::string among(const std::string& name, const std::vector<std::string>& declared) {
  const std::string near = did_you_mean(name, declared);
  if (declared.empty()) return "; it declares none";
  return near + (near.empty() ? "; " : " ") + "declared are " + listed(declared);
}

}  // namespace

std::string in_one_line(std::string words) {
  if (words.size() > most_words) {
    auto end = most_words;
    while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xc0) == 0x80) --end;  // whole characters
    words = words.substr(0, end) + "... (" + std::to_string(words.size() - end) + " bytes more)";
  }
  std::replace_if(
      words.begin(), words.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return words;
}

bool has_place(std::string_view words) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string_view place = words.substr(0, words.find(": "));
  if (place.size() == words.size() || place.find('"') != place.npos) return false;
  bool is_there = false;
  for (int numbers = 0; numbers < 2; ++numbers) {
    const auto colon = place.rfind(':');
    if (colon == place.npos || colon + 1 == place.size() ||
        !std::all_of(place.begin() + static_cast<std::ptrdiff_t>(colon) + 1, place.end(), is_digit))
      break;
    place = place.substr(0, colon);
    is_there = !place.empty();
  }
  return is_there;
}

const XmlAttribute* attribute_of(std::string_view words, const InstanceDeclaration& declared) {
  constexpr std::string_view begin = "attribute \"";
  const auto end = words.find("\": ");
  if (!words.starts_with(begin) || end == words.npos || end < begin.size()) return nullptr;
  return declared.attribute(words.substr(begin.size(), end - begin.size()));
}

std::size_t row_in_file(std::string_view words) {
  constexpr std::string_view mark = "\": row ";
  const auto at = words.find(mark);
  if (!words.starts_with("attribute \"") || at == words.npos || words.find("\": ") != at) return 0;
  const std::string_view rest = words.substr(at + mark.size());
  const auto row = parse_integer(rest.substr(0, rest.find_first_not_of("0123456789")));
  return row && *row > 0 ? static_cast<std::size_t>(*row) : 0;
}

std::string with_names(std::string words, const Blackboard& board, const World& world) {
  const std::string mark = " row ";
  std::string place;
  for (auto at = words.find(mark); at != words.npos; at = words.find(mark, at + 1)) {
    const auto space = words.find_last_of(" (", at - 1);
    const auto begin = at == 0 || space == words.npos ? 0 : space + 1;
    const auto first = at + mark.size();
    const auto end = std::min(words.find_first_not_of("0123456789", first), words.size());
    const Set* set = board.find_set(words.substr(begin, at - begin));
    const auto row = parse_integer(words.substr(first, end - first));
    if (!set || !set->is_named() || !row || static_cast<std::size_t>(*row) >= set->names.size()) continue;
    const std::string& name = set->names[static_cast<std::size_t>(*row)];
    if (begin == 0 && end < words.size() && words[end] == ':') {
      const auto declared = std::find_if(world.rows.begin(), world.rows.end(), [&](const RowDeclaration& each) {
        return each.name == name && std::find(each.sets.begin(), each.sets.end(), set->name) != each.sets.end();
      });
      if (declared != world.rows.end()) place = declared->place.text() + ": ";
    }
    words.replace(begin, end - begin, set->name + ' ' + quote(name));
  }
  return place + words;
}

std::string as_given(const std::string& words, const World& world, const Library::SearchPath& folders) {
  const std::string folder = folders.empty() ? "" : folders.back().string() + '/';
  const std::string given = world.file.parent_path().string();
  if (folder.empty() || !words.starts_with(folder)) return words;
  return (given.empty() ? "" : given + '/') + words.substr(folder.size());
}

std::string with_declared(const std::string& words, const muster_plugin& plugin) {
  const std::string begin = "threw std::logic_error: parameter \"", middle = "\" is used but not declared";
  const auto end = words.find(middle);
  if (!words.starts_with(begin) || end == words.npos) return words;
  const std::string name = words.substr(begin.size(), end - begin.size());
  std::vector<std::string> declared;
  for (uint32_t i = 0; i < plugin.param_count; ++i) declared.emplace_back(plugin.params[i].name);
  return "parameter " + quote(name) + " is used but not declared in params" + among(name, declared);
}

std::string no_text(const muster_param& declared) {
  const std::string name = quote(declared.name), text = declared.text ? declared.text : "";
  const std::string what = declared.kind == MUSTER_CHOICE      ? "a choice"
                           : declared.kind == MUSTER_FLAG      ? "a flag"
                           : declared.kind == MUSTER_REFERENCE ? "a reference"
                                                               : "a number";
  const std::string is = declared.kind == MUSTER_CHOICE      ? ", its place from 0 on in " + quote(text)
                         : declared.kind == MUSTER_FLAG      ? ", 0 or 1"
                         : declared.kind == MUSTER_REFERENCE ? ", the number of its row in the set " + quote(text)
                                                             : "";
  return "asks for the text of the parameter " + name + ", which is " + what + " and has none; expected s.param(" +
         name + ")" + is;
}

}  // namespace muster
