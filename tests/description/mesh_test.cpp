// Meshes of any kind, hostile ones too, leave the host running and are refused with a reason.
#include "description/mesh.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "files.hpp"
#include "mesh_files.hpp"

namespace muster::description {
namespace {

const Eigen::Vector3d one = Eigen::Vector3d::Ones();

std::string refusal(const Files& files, const std::string& name, const std::string& bytes) {
  files.write(name, bytes);
  return message_of([&] { read_mesh(files.at(""), name, one); });
}

TEST(Mesh, StlObjAndDaeAreRead) {
  Files files;
  files.write("t.stl", triangle("0 1 0"));
  files.write("t.obj", obj);
  files.write("t.dae", collada);
  for (const char* name : {"t.stl", "t.obj", "t.dae"}) {
    const Mesh mesh = read_mesh(files.at(""), name, one);
    ASSERT_EQ(mesh.faces.size(), 1u) << name;
    Eigen::AlignedBox3d bounds;
    for (const auto& vertex : mesh.vertices) bounds.extend(vertex);
    EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3d(1, 1, 0), 1e-6)) << name << bounds.max().transpose();
  }
}

TEST(Mesh, MirroredScaleKeepsFacesOutward) {
  Files files;
  files.write("t.stl", triangle("0 1 0"));
  const Mesh mesh = read_mesh(files.at(""), "t.stl", {1, 1, -2});
  const auto& f = mesh.faces.at(0);
  const Eigen::Vector3d normal =
      (mesh.vertices[f[1]] - mesh.vertices[f[0]]).cross(mesh.vertices[f[2]] - mesh.vertices[f[0]]);
  EXPECT_LT(normal.z(), 0);
}

TEST(Mesh, PathsOutsideTheFolderAreRefused) {
  Files files;
  files.write("secret.stl", triangle("0 1 0"));
  files.write("in/t.stl", triangle("0 1 0"));
  std::filesystem::create_symlink(files.at("secret.stl"), files.at("in/link.stl"));
  std::filesystem::create_symlink("t.stl", files.at("in/inner.stl"));
  const std::string outside = "is outside the allowed folder";
  for (const std::string& path :
       {std::string("../secret.stl"), std::string("link.stl"), files.at("in/t.stl"), std::string("file://host/t.stl"),
        std::string("http://host/t.stl"), std::string("package://in/t.stl")}) {
    EXPECT_EQ(message_of([&] { read_mesh(files.at("in"), path, one); }).compare(0, outside.size(), outside), 0) << path;
  }
  EXPECT_EQ(read_mesh(files.at("in"), "../in/inner.stl", one).faces.size(), 1u);
}

TEST(Mesh, WhatIsNotAMeshIsNamed) {
  Files files;
  EXPECT_EQ(refusal(files, "lfs.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"),
            "is a Git LFS pointer; run git lfs pull");
  EXPECT_EQ(refusal(files, "404.obj", "<!DOCTYPE html><html>404</html>"), "is an HTML page, not a mesh");
  EXPECT_EQ(refusal(files, "a.fbx", "x"), "is of a kind that is not read; expected .stl, .obj or .dae");
  EXPECT_EQ(refusal(files, "empty.stl", ""), "is empty");
  EXPECT_EQ(message_of([&] { read_mesh(files.at(""), "absent.stl", one); }),
            "cannot be opened: No such file or directory");
}

TEST(Mesh, VerticesThatAreNoNumbersAreRefused) {
  Files files;
  const std::string bad = "has a vertex that is not finite or farther than 1e6 m";
  EXPECT_EQ(refusal(files, "nan.stl", triangle("0 nan 0")), bad);
  EXPECT_EQ(refusal(files, "far.stl", triangle("0 3e38 0")), bad);
}

// Each of these crashed, hung or misread in Debian's assimp; the host must only get a message.
TEST(Mesh, HostileFilesLeaveTheHostAlive) {
  Files files;
  std::string counted(84, '\0');  // a binary STL of 4e9 triangles without any
  std::memset(counted.data() + 80, 0xee, 4);
  std::string nested;
  for (int i = 0; i < 100000; ++i) nested += "<node>";
  const std::string head = "<?xml version='1.0'?><COLLADA version='1.4.1'><library_visual_scenes><visual_scene id='s'>";
  const std::string tail =
      "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
  const std::pair<const char*, std::string> hostile[] = {
      {"eight.stl", std::string("solid \x01\xff", 8)},
      {"counted.stl", counted},
      {"self.dae", head + "<node id='n'><instance_node url='#n'/></node>" + tail},
      {"nested.dae", head + nested + tail},
      {"mtl.obj", "mtllib mtl.obj\nmap_Kd x.png\nusemtl a\nv 0 0 0\nf 1 1 9\n"},
      {"index.obj", "v 0 0 0\nf 0 -7 4000000000\n"},
  };
  for (const auto& [name, bytes] : hostile) EXPECT_NE(refusal(files, name, bytes), "") << name;
}

// The child inherits none of our limits and leaves none of its own.
TEST(Mesh, HostKeepsItsLimits) {
  Files files;
  files.write("t.stl", triangle("0 1 0"));
  rlimit before, after;
  getrlimit(RLIMIT_AS, &before);
  read_mesh(files.at(""), "t.stl", one);
  getrlimit(RLIMIT_AS, &after);
  EXPECT_EQ(before.rlim_cur, after.rlim_cur);
}

}  // namespace
}  // namespace muster::description
