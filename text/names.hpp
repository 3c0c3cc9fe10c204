// Names in error messages: quoted so that they stay on one line, and the nearest valid one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace muster {

// The text in double quotes, cut after about 60 bytes, with control characters written as \xNN.
std::string quote(std::string_view text);

// True for names that fit paths: letters, digits, and _ - . only.
bool is_name(std::string_view text);

// The valid name that is fewest typing errors away (a letter lost, added, changed or exchanged with its neighbour; case
// does not count), the first of equals; empty if all are more than a third of their length away.
std::string nearest(std::string_view wrong, const std::vector<std::string>& valid);

// `a, b, c`, at most 30 of them.
std::string listed(const std::vector<std::string>& names);

// `expected one of a, b, c`, at most 30 of them.
std::string expected_one_of(const std::vector<std::string>& valid);

// `; did you mean "b"?`: what the word means elsewhere (text/synonyms.hpp), or the name that it is the beginning of, or
// the nearest name, or the one that ends in it after a slash or a dot, or that has or means a part of it between
// slashes; empty if there is none.
std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& valid);

// `expected one of a, b, c; did you mean "b"?`; without the question if nothing is near. Of a long list the question
// stands first: `did you mean "b"? expected one of a, b, c, ...`.
std::string suggest(std::string_view wrong, const std::vector<std::string>& valid);

}  // namespace muster
