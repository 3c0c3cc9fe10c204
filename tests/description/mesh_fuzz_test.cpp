// Meshes damaged at random: the host survives, leaves nothing behind, and gets a sound mesh or a known reason. Reasons
// steer the search: files with a new one are damaged further. With MUSTER_FUZZ_SECONDS (tier long) each format takes so
// long, and the smallest file of each kind goes to MUSTER_FUZZ_FOLDER.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "description/mesh.hpp"
#include "files.hpp"
#include "mesh_files.hpp"

namespace muster::description {
namespace {

constexpr int few = 120;  // files of a format in the fast tier

// Damages bytes in one to four places.
class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string bytes, const std::string& other) {
    for (std::size_t k = 1 + below(4); k > 0; --k) once(bytes, other);
    return bytes.substr(0, 1 << 16);
  }

  std::size_t below(std::size_t bound) { return random_() % std::max<std::size_t>(bound, 1); }

 private:
  void once(std::string& bytes, const std::string& other) {
    const std::size_t at = below(bytes.size()), length = 1 + below(below(2) ? 8 : bytes.size());
    switch (below(8)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = "\0\xff\x7f\x80 \n<>/\"&#-e."[below(15)];
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), length));
        break;
      case 4:
        bytes.insert(at, other.substr(below(other.size()), length));
        break;
      case 5:
        bytes.resize(at);
        break;
      case 6:
        number(bytes);
        break;
      default:
        repeat(bytes, at, length);
    }
  }

  // Replaces a number by another one.
  void number(std::string& bytes) {
    static const char* const numbers[] = {"-1",    "0",   "4294967295", "4294967296", "2147483648",
                                          "1e400", "nan", "-inf",       "1e-400",     "99999999999999999999",
                                          "3",     "",    "0x10",       "1,5",        "65536"};
    const std::size_t from = bytes.find_first_of("0123456789", below(bytes.size()));
    if (from == std::string::npos) return;
    const std::size_t to = std::min(bytes.find_first_not_of("0123456789.", from), bytes.size());
    bytes.replace(from, to - from, numbers[below(std::size(numbers))]);
  }

  void repeat(std::string& bytes, std::size_t at, std::size_t length) {
    const std::string part = bytes.substr(at, length);
    for (std::size_t k = below(200); k > 0 && bytes.size() < 1 << 16; --k) bytes.insert(at, part);
  }

  std::mt19937_64 random_;
};

// Kind of a refusal's reason; "" for an unknown one.
std::string kind_of(const std::string& reason) {
  static const std::vector<std::pair<std::string, std::string>> kinds = {
      {"is not a mesh that can be imported: the importer crashed on it", "crash"},
      {"took longer than ", "slow"},
      {"cannot be imported: std::bad_alloc", "memory"},
      {"cannot be imported: ", "refused"},
      {"has no triangles", "nothing"},
      {"has a vertex that is not finite or farther than 1e6 m", "far"},
      {"has a face without its vertices", "faces"},
      {"is too large; expected at most ", "large"},
      {"is empty", "empty"},
  };
  for (const auto& [begin, kind] : kinds) {
    if (reason.compare(0, begin.size(), begin) == 0) return kind;
  }
  return "";
}

class Fuzz {
 public:
  explicit Fuzz(const std::string& extension) : name_("mesh" + extension) {}

  // The reason for refusing it, or "sound".
  std::string reason(const std::string& bytes) {
    files_.write(name_, bytes);
    try {
      const Mesh mesh = read_mesh(files_.at(""), name_, Eigen::Vector3d::Ones());
      for (const auto& face : mesh.faces) {
        for (const std::uint32_t vertex : face) EXPECT_LT(vertex, mesh.vertices.size());
      }
      for (const auto& vertex : mesh.vertices) EXPECT_TRUE(vertex.allFinite());
      return "sound";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  // Damages the seeds, and every other time their descendants, while go_on().
  template <class GoOn>
  void run(const std::vector<std::string>& seeds, GoOn go_on) {
    Damage damage(1);
    std::vector<std::string> pool = seeds;
    std::set<std::string> reasons;
    for (long k = 0; go_on(k); ++k) {
      const std::vector<std::string>& from = k % 2 == 0 ? seeds : pool;
      const std::string bytes = damage(from[damage.below(from.size())], pool[damage.below(pool.size())]);
      const std::string why = reason(bytes), kind = why == "sound" ? why : kind_of(why);
      ASSERT_NE(kind, "") << why;
      if (reasons.insert(why).second && pool.size() < 1000) pool.push_back(bytes);
      auto& smallest = smallest_[kind];
      if (seen_[kind]++ == 0 || bytes.size() < smallest.size()) smallest = bytes;
    }
  }

  // Removes parts as long as the kind stays.
  void shrink() {
    for (auto& [kind, bytes] : smallest_) {
      int tries = kind == "slow" ? 20 : kind == "memory" ? 200 : 2000;
      for (std::size_t part = bytes.size() / 2; part > 0; part /= 2) {
        for (std::size_t at = 0; at < bytes.size() && tries-- > 0;) {
          std::string less = bytes;
          less.erase(at, part);
          const std::string why = reason(less);
          if ((why == "sound" ? why : kind_of(why)) == kind) {
            bytes = less;
          } else {
            at += part;
          }
        }
      }
    }
  }

  const std::map<std::string, std::string>& smallest() const { return smallest_; }
  const std::map<std::string, long>& seen() const { return seen_; }

 private:
  Files files_;
  std::string name_;
  std::map<std::string, std::string> smallest_;  // by kind
  std::map<std::string, long> seen_;
};

#ifndef MUSTER_FUZZ_SECONDS
// Findings of the long run, minimised, each named by its outcome. Files that crash assimp or exhaust memory today may
// pass tomorrow.
TEST(MeshFuzzCorpus, EachKindIsStillRefused) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MUSTER_SOURCE_DIR "/tests/description/meshes")) {
    const std::string kind = entry.path().stem().string();
    const bool may_improve = kind == "crash" || kind == "memory" || kind == "slow";
    const std::string found = kind_of(Fuzz(entry.path().extension().string()).reason(test::contents(entry.path())));
    EXPECT_TRUE(found == kind || (may_improve && found == "refused")) << entry.path() << ": " << found;
    ++count;
  }
  EXPECT_GE(count, 5);
}
#endif

struct Format {
  const char* extension;
  std::vector<std::string> seeds;
};
void PrintTo(const Format& format, std::ostream* out) { *out << format.extension; }

class MeshFuzz : public testing::TestWithParam<Format> {};

TEST_P(MeshFuzz, LeavesTheHostAlive) {
  Fuzz fuzz(GetParam().extension);
  for (const std::string& seed : GetParam().seeds) EXPECT_EQ(fuzz.reason(seed), "sound");
#ifdef MUSTER_FUZZ_SECONDS
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(MUSTER_FUZZ_SECONDS);
  fuzz.run(GetParam().seeds, [&](long) { return std::chrono::steady_clock::now() < end; });
  fuzz.shrink();
  std::filesystem::create_directories(MUSTER_FUZZ_FOLDER);
  for (const auto& [kind, count] : fuzz.seen()) {
    const std::string& bytes = fuzz.smallest().at(kind);
    std::printf("%s %s: %ld files, the smallest of %zu bytes\n", GetParam().extension, kind.c_str(), count,
                bytes.size());
    std::ofstream(std::string(MUSTER_FUZZ_FOLDER "/") + kind + GetParam().extension, std::ios::binary) << bytes;
  }
#else
  fuzz.run(GetParam().seeds, [](long k) { return k < few; });
  EXPECT_GT(fuzz.seen().size(), 1u);  // some were damaged beyond reading
#endif
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left
  EXPECT_EQ(errno, ECHILD);
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFuzz,
                         testing::Values(Format{".stl", {triangle("0 1 0"), binary_triangle()}},
                                         Format{".obj", {obj, rich_obj}}, Format{".dae", {collada}}),
                         [](const auto& made) { return std::string(made.param.extension).substr(1); });

}  // namespace
}  // namespace muster::description
