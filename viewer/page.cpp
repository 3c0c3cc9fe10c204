#include "page.hpp"

#include <cerrno>
#include <fstream>

#include "payload.hpp"
#include "text/error.hpp"
#include "text/text_file.hpp"
#include "text/whole_file.hpp"

namespace muster::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_page_bytes = 64u << 20;

fs::path shell_of(const fs::path& program_folder) { return program_folder / "viewer" / "page.html"; }

std::string html_text(const std::string& plain) {
  std::string result;
  for (const char c : plain) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else
      result += c;
  }
  return result;
}

void replace_all(std::string& text, const std::string& mark, const std::string& by) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

std::string page_text(const RecordFolder& record, const Payload& payload, const fs::path& program_folder) {
  std::string page = read_text_file(shell_of(program_folder), most_page_bytes).text;
  replace_all(page, "@TITLE@", html_text(record.world));
  replace_all(page, "@PAYLOAD@", base64(gzipped(payload.container)));
  return page;
}

}  // namespace

std::string why_no_page(const fs::path& program_folder) {
  const fs::path shell = shell_of(program_folder);
  std::error_code ignored;
  if (fs::is_regular_file(shell, ignored)) return "";
  std::string reason;
  std::getline(std::ifstream(shell.parent_path() / "page.missing"), reason);
  return shell.string() + ": is missing" + (reason.empty() ? "" : ", as the build had no page (" + reason + ")") +
         "; `scripts/setup --page` installs nodejs and npm, `scripts/viewer` then makes it, with the npm registry in "
         "reach";
}

WrittenPage write_page(const fs::path& record, const fs::path& out, const fs::path& program_folder,
                       std::uint64_t most) {
  const RecordFolder folder = read_record_folder(record);
  if (const std::string reason = why_no_page(program_folder); !reason.empty()) throw Error(Exit::io, reason);
  const Payload payload = payload_of(folder, most);
  const std::string page = page_text(folder, payload, program_folder);
  write_whole(out, page);
  return {page.size(), payload.notes};
}

std::string live_page(const RecordFolder& record, const fs::path& program_folder, std::uint64_t most) {
  std::string page = page_text(record, payload_of(record, most), program_folder);
  const std::string mark = "<html lang=\"en\"";
  if (const auto at = page.find(mark); at != page.npos) page.insert(at + mark.size(), " data-live=\"yes\"");
  return page;
}

}  // namespace muster::viewer
