// muster schema: an XML schema of world files for editors, from the declarations that muster check goes by.
#include <fmt/core.h>

#include "schema_text.hpp"
#include "text/whole_file.hpp"
#include "verbs.hpp"
#include "written_files.hpp"

namespace muster::cli {

int run_schema(const Arguments& arguments) {
  CommandLine line("schema",
                   "Writes an XML schema (XSD) of world files, from what elements and plugins declare: an editor that "
                   "has it completes\n"
                   "and explains elements, attributes and choices, and marks what muster check would refuse.\n"
                   "Example: muster schema -o muster.xsd");
  std::string out;
  std::vector<std::string> folders;
  line.option("-o,--out", out, "the file to write; standard output if not given");
  line.option("--plugins", folders, "a folder of plugins, looked in first");
  line.parse(arguments);
  WrittenFiles().writes(out, "--out");
  std::vector<std::shared_ptr<Library>> libraries;
  std::set<std::string> known;
  for (const auto& listed : list_plugins(plugin_path(folders))) {
    if (!listed.library)
      fmt::print(stderr, "muster: note: not in the schema: {}: {}\n", listed.file.string(), listed.reason);
    else if (known.insert(std::string(listed.library->id())).second)
      libraries.push_back(listed.library);
  }
  const std::string schema = schema_text(standard(), libraries);
  if (out.empty()) return fmt::print("{}", schema), 0;
  write_whole(out, schema);
  fmt::print("wrote {}, {} elements and {} plugins\n", out, standard().elements.size(), libraries.size());
  return 0;
}

}  // namespace muster::cli
