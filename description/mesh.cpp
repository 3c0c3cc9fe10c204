#include "description/mesh.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "description/cage.hpp"
#include "description/file_text.hpp"

namespace muster::description {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t max_file = 32u << 20;  // bytes
constexpr std::uint32_t max_vertices = 1u << 20;
constexpr std::uint32_t max_faces = 1u << 21;
constexpr double max_coordinate = 1e6;  // [m]
constexpr CageLimits limits;

// The child's result, in shared memory. Untouched pages cost nothing.
struct Shared {
  bool done;
  char error[256];
  std::uint32_t vertex_count, face_count;
  double vertices[3 * max_vertices];
  std::uint32_t faces[3 * max_faces];
};

class SharedMap {
 public:
  SharedMap() {
    void* memory =
        ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory for a mesh importer");
    shared_ = static_cast<Shared*>(memory);
  }
  SharedMap(const SharedMap&) = delete;
  SharedMap& operator=(const SharedMap&) = delete;
  ~SharedMap() { ::munmap(shared_, sizeof(Shared)); }
  Shared* operator->() const { return shared_; }
  Shared& operator*() const { return *shared_; }

 private:
  Shared* shared_;
};

// A file system with a single file in it: no material library, no texture, no file of the host.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string name, const std::string& bytes) : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* file) const override { return name_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    if (!Exists(file)) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  const std::string& bytes_;
};

void fill(const aiScene& scene, Shared& out) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (mesh.mNumVertices > max_vertices - out.vertex_count || mesh.mNumFaces > max_faces - out.face_count) {
      throw std::runtime_error("is too large; expected at most 1048576 vertices and 2097152 triangles");
    }
    const std::uint32_t first = out.vertex_count;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;  // points and lines have no surface
      for (unsigned k = 0; k < 3; ++k) out.faces[3 * out.face_count + k] = first + mesh.mFaces[f].mIndices[k];
      ++out.face_count;
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      double* to = &out.vertices[3 * out.vertex_count++];
      to[0] = p.x, to[1] = p.y, to[2] = p.z;
    }
  }
}

// Runs in the child and never returns.
[[noreturn]] void import(const std::string& name, const std::string& bytes, Shared& out) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT})
    std::signal(signal, SIG_DFL);  // its end is told by the parent
  enter_cage(limits);
  try {
    Assimp::Importer importer;
    importer.SetIOHandler(new OneFile(name, bytes));                       // owned by the importer
    importer.SetPropertyBool("IMPORT_COLLADA_IGNORE_UP_DIRECTION", true);  // as ROS does: z is up
    const aiScene* scene = importer.ReadFile(
        name, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices);
    if (!scene) throw std::runtime_error(importer.GetErrorString());
    fill(*scene, out);
  } catch (const std::exception& error) {
    std::strncpy(out.error, error.what(), sizeof out.error - 1);
  }
  out.done = true;
  ::_exit(0);
}

void run_child(const std::string& name, const std::string& bytes, Shared& out) {
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a mesh importer: ") + std::strerror(errno));
  if (child == 0) import(name, bytes, out);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status) &&
      (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM || WTERMSIG(status) == SIGKILL)) {
    throw std::runtime_error("took longer than " + std::to_string(limits.cpu) + " s to import");
  }
  if (!out.done) throw std::runtime_error("is not a mesh that can be imported: the importer crashed on it");
  if (out.error[0]) throw std::runtime_error(std::string("cannot be imported: ") + out.error);
}

// Validates all of the child's output: a hostile file may have made it write anything.
Mesh checked(const Shared& shared, const Eigen::Vector3d& scale) {
  Mesh mesh;
  const std::uint32_t vertices = shared.vertex_count, faces = shared.face_count;
  if (vertices > max_vertices || faces > max_faces) throw std::runtime_error("is not a mesh that can be imported");
  if (faces == 0) throw std::runtime_error("has no triangles");
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(&shared.vertices[3 * v]).cwiseProduct(scale);
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > max_coordinate) {
      throw std::runtime_error("has a vertex that is not finite or farther than 1e6 m");
    }
    mesh.vertices.push_back(p);
  }
  const bool mirrored = scale.prod() < 0;
  for (std::uint32_t f = 0; f < faces; ++f) {
    std::array<std::uint32_t, 3> face;
    std::copy_n(&shared.faces[3 * f], 3, face.begin());
    if (*std::max_element(face.begin(), face.end()) >= vertices)
      throw std::runtime_error("has a face without its vertices");
    if (mirrored) std::swap(face[1], face[2]);
    mesh.faces.push_back(face);
  }
  return mesh;
}

// The resolved path of the file; throws unless it is inside the folder.
fs::path confined(const std::string& folder, const std::string& file) {
  if (file.find("://") != std::string::npos || fs::path(file).is_absolute()) {
    throw std::runtime_error("is outside the allowed folder; expected a path relative to " + folder);
  }
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  fs::path path = fs::canonical(root / file, error);
  if (error) throw std::runtime_error("cannot be opened: " + error.message());
  const auto [end, _] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  if (end != root.end()) throw std::runtime_error("is outside the allowed folder " + folder);
  return path;
}

bool begins(const std::string& bytes, const char* prefix) { return bytes.compare(0, std::strlen(prefix), prefix) == 0; }

}  // namespace

Mesh read_mesh(const std::string& folder, const std::string& file, const Eigen::Vector3d& scale) {
  const fs::path path = confined(folder, file);
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (extension != ".stl" && extension != ".obj" && extension != ".dae") {
    throw std::runtime_error("is of a kind that is not read; expected .stl, .obj or .dae");
  }
  const std::string bytes = read_file(path.string(), max_file);
  if (begins(bytes, "version https://git-lfs")) throw std::runtime_error("is a Git LFS pointer; run git lfs pull");
  if (begins(bytes, "<!DOCTYPE html") || begins(bytes, "<html"))
    throw std::runtime_error("is an HTML page, not a mesh");
  if (bytes.empty()) throw std::runtime_error("is empty");
  const SharedMap shared;
  run_child("mesh" + extension, bytes, *shared);
  return checked(*shared, scale);
}

}  // namespace muster::description
