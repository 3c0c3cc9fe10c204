#include "elf.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <array>
#include <cstring>

namespace muster {
namespace {

static_assert(sizeof(void*) == 8 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "elf.cpp reads 64-bit little-endian files");

#if defined(__x86_64__)
constexpr Elf64_Half this_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half this_machine = EM_AARCH64;
#else
#error "say here which e_machine this is"
#endif

std::string machine_name(Elf64_Half machine) {
  switch (machine) {
    case EM_X86_64:
      return "x86-64";
    case EM_AARCH64:
      return "AArch64";
    case EM_386:
      return "32-bit x86";
    case EM_ARM:
      return "32-bit ARM";
    case EM_RISCV:
      return "RISC-V";
    case EM_PPC:
      return "PowerPC";
    case EM_PPC64:
      return "64-bit PowerPC";
    case EM_S390:
      return "IBM S/390";
    case EM_MIPS:
      return "MIPS";
    case EM_SPARCV9:
      return "64-bit SPARC";
    case EM_LOONGARCH:
      return "LoongArch";
    default:
      return fmt::format("machine number {}", machine);
  }
}

// The first bytes of a file of another type, as text for a one-line message.
std::string beginning(std::string_view bytes) {
  std::string result;
  for (const char c : bytes.substr(0, 20)) {
    const auto code = static_cast<unsigned char>(c);
    if (code == '\n' || code == '\r') break;
    if (code < 0x20 || code > 0x7e || c == '"' || c == '\\')
      result += fmt::format("\\x{:02x}", code);
    else
      result += c;
  }
  return result;
}

// Reads a part of the file; throws Refusal if the file ends before it.
template <class T>
T part(std::string_view bytes, Elf64_Off offset, const std::string& what) {
  if (offset > bytes.size() || sizeof(T) > bytes.size() - offset)
    throw Refusal(fmt::format("is truncated: it has {} bytes, and its {} lies at byte {}; copy or build it again",
                              bytes.size(), what, offset));
  T result;
  std::memcpy(&result, bytes.data() + offset, sizeof(T));  // parts of the file need not be aligned
  return result;
}

void check_inside(std::string_view bytes, Elf64_Off offset, Elf64_Xword size, const std::string& what) {
  if (offset > bytes.size() || size > bytes.size() - offset)
    throw Refusal(
        fmt::format("is truncated: it has {} bytes, and its {} has {} from byte {} on; copy or build it again",
                    bytes.size(), what, size, offset));
}

[[noreturn]] void corrupted(const std::string& how) {
  throw Refusal(fmt::format("is corrupted: {}; copy or build it again", how));
}

void check_kind(std::string_view bytes) {
  if (bytes.empty()) throw Refusal("is empty; expected a shared library");
  if (bytes.starts_with("version https://git-lfs"))
    throw Refusal("is a Git LFS pointer, not the library itself; run git lfs pull");
  if (!bytes.starts_with(ELFMAG))
    throw Refusal(
        fmt::format("is not a shared library: it starts with \"{}\"; expected \"\\x7fELF\"", beginning(bytes)));
  const auto ident = part<std::array<unsigned char, EI_NIDENT>>(bytes, 0, "header");
  if (ident[EI_CLASS] == ELFCLASS32)
    throw Refusal(fmt::format("is a 32-bit library; expected 64-bit {}; rebuild it for this machine",
                              machine_name(this_machine)));
  if (ident[EI_CLASS] != ELFCLASS64) corrupted(fmt::format("its ELF class is {}", ident[EI_CLASS]));
  if (ident[EI_DATA] == ELFDATA2MSB)
    throw Refusal(fmt::format("is big-endian; expected {}; rebuild it for this machine", machine_name(this_machine)));
  if (ident[EI_DATA] != ELFDATA2LSB) corrupted(fmt::format("its byte order is {}", ident[EI_DATA]));
}

Elf64_Ehdr checked_header(std::string_view bytes) {
  check_kind(bytes);
  const auto header = part<Elf64_Ehdr>(bytes, 0, "header");
  if (header.e_machine != this_machine)
    throw Refusal(fmt::format("is built for {}; expected {}; rebuild it for this machine",
                              machine_name(header.e_machine), machine_name(this_machine)));
  if (header.e_type == ET_REL) throw Refusal("is an object file; expected a shared library; link it with -shared");
  if (header.e_type == ET_EXEC) throw Refusal("is a program; expected a shared library; link it with -shared");
  if (header.e_type != ET_DYN) throw Refusal(fmt::format("is not a shared library: its ELF type is {}", header.e_type));
  if (header.e_version != EV_CURRENT) corrupted(fmt::format("its ELF version is {}", header.e_version));
  return header;
}

void check_segments(std::string_view bytes, const Elf64_Ehdr& header) {
  if (header.e_phentsize != sizeof(Elf64_Phdr)) corrupted("its segment table has entries of a wrong size");
  bool dynamic = false;
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    const auto segment = part<Elf64_Phdr>(bytes, header.e_phoff + i * sizeof(Elf64_Phdr), "segment table");
    check_inside(bytes, segment.p_offset, segment.p_filesz, fmt::format("segment {}", i));
    if (segment.p_type == PT_LOAD && segment.p_memsz < segment.p_filesz)
      corrupted(fmt::format("segment {} has no room", i));
    dynamic |= segment.p_type == PT_DYNAMIC;
  }
  if (!dynamic) corrupted("it has no dynamic section");
}

// Reads a zero-terminated name, which must end inside the section of names.
std::string name_at(std::string_view names, Elf64_Word offset, unsigned section) {
  const std::size_t end = names.find('\0', offset);
  if (end == std::string_view::npos) corrupted(fmt::format("section {} has no name", section));
  return std::string(names.substr(offset, end - offset));
}

}  // namespace

std::vector<std::string> elf_sections(std::string_view bytes) {
  const Elf64_Ehdr header = checked_header(bytes);
  check_segments(bytes, header);
  if (header.e_shnum == 0)
    throw Refusal("has no section table, from which its ABI could be read; do not use sstrip on it");
  if (header.e_shentsize != sizeof(Elf64_Shdr)) corrupted("its section table has entries of a wrong size");
  if (header.e_shstrndx >= header.e_shnum) corrupted("its sections have no names");

  std::vector<Elf64_Shdr> sections;
  for (unsigned i = 0; i < header.e_shnum; ++i) {
    sections.push_back(part<Elf64_Shdr>(bytes, header.e_shoff + i * sizeof(Elf64_Shdr), "section table"));
    if (sections[i].sh_type != SHT_NOBITS)  // .bss takes no room in the file
      check_inside(bytes, sections[i].sh_offset, sections[i].sh_size, fmt::format("section {}", i));
  }
  const Elf64_Shdr& table = sections[header.e_shstrndx];
  if (table.sh_type != SHT_STRTAB) corrupted("its section names are no text");
  const std::string_view names = bytes.substr(table.sh_offset, table.sh_size);
  std::vector<std::string> result;
  for (unsigned i = 0; i < sections.size(); ++i) result.push_back(name_at(names, sections[i].sh_name, i));
  return result;
}

}  // namespace muster
