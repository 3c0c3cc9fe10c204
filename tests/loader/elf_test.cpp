// Files that no dlopen() should ever see, each with its line.
#include "loader/elf.hpp"

#include <elf.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstring>

#define BOOST_DLL_USE_STD_FS
#include <boost/dll/library_info.hpp>

#include "zoo.hpp"

namespace muster {
namespace {

std::string refusal(const std::string& bytes) {
  try {
    elf_sections(bytes);
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

const std::string& good() {
  static const std::string bytes = test::contents(zoo / "zoo_good.so");
  return bytes;
}

// The good library with its ELF header changed.
std::string with_header(const std::function<void(Elf64_Ehdr&)>& change) {
  std::string bytes = good();
  Elf64_Ehdr header;
  std::memcpy(&header, bytes.data(), sizeof header);
  change(header);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

TEST(Elf, FindsTheSectionsOfAWholeLibrary) {
  EXPECT_THAT(elf_sections(good()), testing::IsSupersetOf({".text", ".dynsym", "muster.abi.1"}));
}

TEST(Elf, AgreesWithBoost) {
  const std::vector<std::string> theirs = boost::dll::library_info(zoo / "zoo_good.so").sections();
  EXPECT_THAT(theirs, testing::Contains("muster.abi.1"));
  EXPECT_THAT(elf_sections(good()), testing::IsSupersetOf(theirs));
}

TEST(Elf, SaysWhatElseAFileIs) {
  EXPECT_EQ(refusal(""), "is empty; expected a shared library");
  EXPECT_EQ(refusal("this is not a library\n"),
            "is not a shared library: it starts with \"this is not a librar\"; expected \"\\x7fELF\"");
  EXPECT_EQ(refusal("\x01\"\xff\nmore"),
            "is not a shared library: it starts with \"\\x01\\x22\\xff\"; expected \"\\x7fELF\"");
  EXPECT_EQ(refusal("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"),
            "is a Git LFS pointer, not the library itself; run git lfs pull");
}

TEST(Elf, NamesTheMachineThatALibraryIsFor) {
  const auto machine = [](int m) {
    return refusal(with_header([m](auto& h) { h.e_machine = static_cast<Elf64_Half>(m); }));
  };
  const std::string rest = "; expected x86-64; rebuild it for this machine";
  EXPECT_EQ(machine(EM_AARCH64), "is built for AArch64" + rest);
  EXPECT_EQ(machine(EM_ARM), "is built for 32-bit ARM" + rest);
  EXPECT_EQ(machine(EM_RISCV), "is built for RISC-V" + rest);
  EXPECT_EQ(machine(EM_PPC64), "is built for 64-bit PowerPC" + rest);
  EXPECT_EQ(machine(999), "is built for machine number 999" + rest);
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_ident[EI_CLASS] = ELFCLASS32; })),
            "is a 32-bit library; expected 64-bit x86-64; rebuild it for this machine");
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_ident[EI_DATA] = ELFDATA2MSB; })), "is big-endian" + rest);
}

TEST(Elf, TellsLibrariesFromOtherElfFiles) {
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_type = ET_REL; })),
            "is an object file; expected a shared library; link it with -shared");
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_type = ET_EXEC; })),
            "is a program; expected a shared library; link it with -shared");
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_type = ET_CORE; })), "is not a shared library: its ELF type is 4");
}

TEST(Elf, FindsTruncationAtEveryLength) {
  for (std::size_t size = 4; size < good().size(); size += 1 + size / 16)
    EXPECT_THAT(refusal(good().substr(0, size)),
                testing::StartsWith("is truncated: it has " + std::to_string(size) + " bytes"));
  // The section table is the last thing in a linked file.
  EXPECT_NE(refusal(good().substr(0, good().size() - 1)), "");
}

TEST(Elf, FindsCorruptedTables) {
  const std::string again = "; copy or build it again";
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_version = 7; })), "is corrupted: its ELF version is 7" + again);
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_shstrndx = 1; })),
            "is corrupted: its section names are no text" + again);
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_shstrndx = 999; })),
            "is corrupted: its sections have no names" + again);
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_shentsize = 1; })),
            "is corrupted: its section table has entries of a wrong size" + again);
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_phnum = 0; })), "is corrupted: it has no dynamic section" + again);
  EXPECT_EQ(refusal(with_header([](auto& h) { h.e_shnum = 0; })),
            "has no section table, from which its ABI could be read; do not use sstrip on it");
  EXPECT_THAT(refusal(with_header([](auto& h) { h.e_shoff = ~0ull - 8; })), testing::StartsWith("is truncated"));
  EXPECT_THAT(refusal(with_header([](auto& h) { h.e_phoff = ~0ull - 8; })), testing::StartsWith("is truncated"));
}

// Every header byte, inverted: a refusal or sections, never a crash (the sanitizers watch).
TEST(Elf, SurvivesEveryHeaderByte) {
  for (std::size_t i = 0; i < sizeof(Elf64_Ehdr); ++i) {
    std::string bytes = good();
    bytes[i] = static_cast<char>(~bytes[i]);
    refusal(bytes);
  }
}

using ElfFile = ZooTest;

TEST_F(ElfFile, SaysWhyItCannotBeRead) {
  const std::string at = "world.xml:5:3: plugin \"zoo.x\": ";
  const std::filesystem::path file = folder / "zoo_x.so";
  EXPECT_EQ(load_error("zoo.x", file), at + file.string() + " cannot be read: No such file or directory");
  EXPECT_EQ(load_error("zoo.x", folder), at + folder.string() + " is a directory; expected a shared library");
  EXPECT_EQ(load_error("zoo.x", "/dev/zero"), at + "/dev/zero is a device or a pipe; expected a shared library");
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(load_error("zoo.x", file), at + file.string() + " is a device or a pipe; expected a shared library");
  std::filesystem::remove(file);
  write_bytes(file, "");
  EXPECT_EQ(load_error("zoo.x", file), at + file.string() + " is empty; expected a shared library");
  std::filesystem::resize_file(file, 5'000'000'000);  // sparse: it takes no room
  EXPECT_EQ(load_error("zoo.x", file),
            at + file.string() + " has 5000000000 bytes; a library may have at most 1073741824");
}

TEST_F(ElfFile, SaysThatPermissionIsMissing) {
  const std::filesystem::path file = folder / "zoo_x.so";
  write_bytes(file, good());
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const uid_t tester = ::geteuid(), nobody = 65534;
  ASSERT_EQ(::seteuid(tester == 0 ? nobody : tester), 0);  // root may read everything
  const std::string error = load_error("zoo.x", file);
  ASSERT_EQ(::seteuid(tester), 0);
  EXPECT_THAT(error, testing::EndsWith(" cannot be read: Permission denied"));
}

}  // namespace
}  // namespace muster
