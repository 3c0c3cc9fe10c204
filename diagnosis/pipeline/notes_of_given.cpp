#include "diagnosis/pipeline/notes_of_given.hpp"

#include <algorithm>

namespace muster::diagnosis {

void keep_notes_of_given(const std::filesystem::path& world, const Diagnosis& found,
                         const std::filesystem::path& corrected, Diagnosis& out) {
  const auto speaks_of = [](const std::string& note, const std::filesystem::path& file) {
    return note.find(file.string()) != note.npos;
  };
  std::erase_if(out.notes, [&](const std::string& note) { return speaks_of(note, corrected); });
  for (const std::string& note : found.notes) {
    const bool is_new = std::find(out.notes.begin(), out.notes.end(), note) == out.notes.end();
    if (is_new && speaks_of(note, world)) out.notes.push_back(note);
  }
}

}  // namespace muster::diagnosis
