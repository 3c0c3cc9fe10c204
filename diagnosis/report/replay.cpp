#include "diagnosis/report/replay.hpp"

#include <tinyxml2.h>

#include <set>

#include "text/error.hpp"

namespace muster::report {

std::filesystem::path write_replay(const std::filesystem::path& world, const std::string& data,
                                   const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(world.string().c_str()) != tinyxml2::XML_SUCCESS)
    throw Error(Exit::io, world.string() + ": cannot be read");
  tinyxml2::XMLElement& root = *document.RootElement();
  static const std::set<std::string> replaced = {"radio.links", "data.links", "record", "swap"};
  bool receives = false;
  for (auto* e = root.FirstChildElement(); e;) {
    auto* next = e->NextSiblingElement();
    receives = receives || e->Name() == std::string("radio.receiver");
    if (replaced.count(e->Name())) root.DeleteChild(e);
    e = next;
  }
  auto* links = document.NewElement("data.links");
  links->SetAttribute("name", "data");
  links->SetAttribute("file", data.c_str());
  root.InsertFirstChild(links);
  if (!receives) root.InsertNewChildElement("radio.receiver");
  root.InsertNewChildElement("record")->SetAttribute("table", "link/*/rssi");
  if (document.SaveFile(file.string().c_str()) != tinyxml2::XML_SUCCESS)
    throw Error(Exit::io, file.string() + ": cannot be written");
  return file;
}

}  // namespace muster::report
