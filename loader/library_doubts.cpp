#include "library_doubts.hpp"

#include <elf.h>

#include <algorithm>
#include <boost/core/demangle.hpp>
#include <cstring>

#include "text/names.hpp"

namespace muster {
namespace {

enum class Matter { random, clock, wait };

struct Call {
  std::string_view symbol;
  Matter matter;
  std::string_view word;
};

constexpr Call calls[] = {
    {"rand", Matter::random, "rand()"},
    {"random", Matter::random, "random()"},
    {"drand48", Matter::random, "drand48()"},
    {"lrand48", Matter::random, "lrand48()"},
    {"_ZNSt13random_device9_M_getvalEv", Matter::random, "std::random_device"},
    {"time", Matter::clock, "time()"},
    {"clock", Matter::clock, "clock()"},
    {"gettimeofday", Matter::clock, "gettimeofday()"},
    {"clock_gettime", Matter::clock, "clock_gettime()"},
    {"_ZNSt6chrono3_V212system_clock3nowEv", Matter::clock, "std::chrono::system_clock::now()"},
    {"_ZNSt6chrono3_V212steady_clock3nowEv", Matter::clock, "std::chrono::steady_clock::now()"},
    {"sleep", Matter::wait, "sleep()"},
    {"usleep", Matter::wait, "usleep()"},
    {"nanosleep", Matter::wait, "nanosleep(), as std::this_thread::sleep_for() does"},
    {"clock_nanosleep", Matter::wait, "clock_nanosleep()"},
};

struct Symbol {
  std::string_view name;
  unsigned type = STT_NOTYPE;
  bool is_elsewhere = false;  // in another library
  bool is_variable = false;   // in a section that is written, and not by the loader alone
};

template <class T>
T part(std::string_view bytes, Elf64_Off offset) {
  T result{};
  if (offset <= bytes.size() && sizeof(T) <= bytes.size() - offset)
    std::memcpy(&result, bytes.data() + offset, sizeof(T));
  return result;
}

std::string_view name_at(std::string_view bytes, const Elf64_Shdr& names, Elf64_Word at) {
  if (names.sh_offset > bytes.size() || at >= bytes.size() - names.sh_offset) return {};
  const std::string_view rest = bytes.substr(names.sh_offset + at);
  return rest.substr(0, rest.find('\0'));
}

// Of the dynamic table, and of the other one where the library is not stripped.
std::vector<Symbol> symbols_of(std::string_view bytes) {
  const auto header = part<Elf64_Ehdr>(bytes, 0);
  std::vector<Elf64_Shdr> sections;
  for (unsigned i = 0; i < header.e_shnum; ++i)
    sections.push_back(part<Elf64_Shdr>(bytes, header.e_shoff + i * sizeof(Elf64_Shdr)));
  if (header.e_shstrndx >= sections.size()) return {};
  std::vector<Symbol> result;
  for (const Elf64_Shdr& table : sections) {
    if ((table.sh_type != SHT_DYNSYM && table.sh_type != SHT_SYMTAB) || table.sh_link >= sections.size()) continue;
    if (table.sh_offset > bytes.size() || table.sh_size > bytes.size() - table.sh_offset) continue;
    for (Elf64_Xword at = 0; at + sizeof(Elf64_Sym) <= table.sh_size; at += sizeof(Elf64_Sym)) {
      const auto entry = part<Elf64_Sym>(bytes, table.sh_offset + at);
      Symbol symbol{name_at(bytes, sections[table.sh_link], entry.st_name),
                    static_cast<unsigned>(ELF64_ST_TYPE(entry.st_info)), entry.st_shndx == SHN_UNDEF};
      if (entry.st_shndx < sections.size() && !symbol.is_elsewhere) {
        const Elf64_Shdr& place = sections[entry.st_shndx];
        // Constants with addresses in them are in .data.rel.ro, which the loader alone writes.
        symbol.is_variable = (place.sh_flags & SHF_WRITE) &&
                             !name_at(bytes, sections[header.e_shstrndx], place.sh_name).starts_with(".data.rel.ro");
      }
      result.push_back(symbol);
    }
  }
  return result;
}

// `count` of a static variable in a plugin's step() that needs no code to begin with: a constant would be elsewhere.
// One that needs code has a guard beside it, and may be a constant.
std::string variable_of_step(const Symbol& symbol, const std::vector<Symbol>& all) {
  if (!symbol.is_variable || (symbol.type != STT_OBJECT && symbol.type != STT_TLS) || !symbol.name.starts_with("_ZZ"))
    return "";
  const std::string guard = "_ZGV" + std::string(symbol.name.substr(2));
  if (std::any_of(all.begin(), all.end(), [&](const Symbol& each) { return each.name == guard; })) return "";
  const std::string words = boost::core::demangle(std::string(symbol.name).c_str());
  const bool is_of_step = words.find("::step(muster::Step const&)") != words.npos;
  return is_of_step ? words.substr(words.rfind("::") + 2) : "";
}

std::string expected(Matter matter) {
  switch (matter) {
    case Matter::random:
      return ", whose numbers do not follow the world's seed, so that no run repeats another; expected a stream: "
             "noise(s.stream(\"noise\")) in the constructor, noise.normal(k.tick()) in step()";
    case Matter::clock:
      return ", the clock of the computer, so that no run repeats another; expected the time of the run, k.time(), and "
             "k.dt() for a step";
    default:
      return ", which holds up the whole run, whose time goes on by ticks; expected no wait, every=\"N\" on the "
             "element "
             "for a lower rate, and muster run --real-time for a run as slow as the clock";
  }
}

}  // namespace

std::vector<std::string> library_doubts(std::string_view bytes, std::string_view id) {
  std::vector<std::string> result;
  for (const std::string_view role : {"bridge.", "device.", "host.", "physics."})
    if (id.starts_with(role)) return result;
  const std::vector<Symbol> symbols = symbols_of(bytes);
  for (const Matter matter : {Matter::random, Matter::clock, Matter::wait}) {
    const auto called = std::find_if(std::begin(calls), std::end(calls), [&](const Call& call) {
      return call.matter == matter && std::any_of(symbols.begin(), symbols.end(), [&](const Symbol& symbol) {
               return symbol.is_elsewhere && symbol.name == call.symbol;
             });
    });
    if (called != std::end(calls)) result.push_back("it calls " + std::string(called->word) + expected(matter));
  }
  for (const Symbol& symbol : symbols) {
    const std::string name = variable_of_step(symbol, symbols);
    if (name.empty()) continue;
    std::string doubt =
        "its step() keeps " + quote(name) +
        " in a static variable, which all instances share, and which is lost where a run is restored or "
        "a plugin swapped; expected state in a table, s.write<State>(\"self/state\") and k.last(state)";
    const bool is_known = std::find(result.begin(), result.end(), doubt) != result.end();  // both tables may have it
    if (!is_known) result.push_back(std::move(doubt));
  }
  return result;
}

}  // namespace muster
