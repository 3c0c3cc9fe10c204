// What is done with the words of a fault before a user reads them: names for numbers of rows, places, what is declared.
#pragma once

#include <muster/plugin.h>

#include <string>
#include <string_view>

#include "blackboard.hpp"
#include "loader/library.hpp"
#include "world_file/world.hpp"

namespace muster {

// A plugin's words may have several lines, or codes that a terminal obeys, and no end; a message is one line, cut after
// 2,000 bytes.
std::string in_one_line(std::string words);

// True where a message begins with a place of its own: "diffbot.urdf:6: ...", "routes.csv:3:1: ...".
bool has_place(std::string_view words);

// Scenes count rows of tables: "floor row 0: ..." and "wall row 2" become `world.xml:3:3: floor "slab": ...` and
// `wall "south"`.
std::string with_names(std::string words, const Blackboard& board, const World& world);

// The attribute that words such as `attribute "peers": no radio is ...` are about, where the element has it; else null.
const XmlAttribute* attribute_of(std::string_view words, const InstanceDeclaration& declared);

// The number of the row that words about a file's attribute are of, `attribute "file": row 3 is ...`; 0: of none.
std::size_t row_in_file(std::string_view words);

// A file in the world's folder by the path that the user knows it by: as the world's own was given.
std::string as_given(const std::string& words, const World& world, const Library::SearchPath& folders);

// A plugin that asks for a parameter by a name that it has not declared is told which it has.
std::string with_declared(const std::string& words, const muster_plugin& plugin);

// Of a plugin that asks for the text of a parameter that has none: what it is, and the call that gives it.
std::string no_text(const muster_param& declared);

}  // namespace muster
