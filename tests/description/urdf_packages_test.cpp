// Meshes of ROS packages: found in the folder that the world declares, and nowhere else.
#include <gtest/gtest.h>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

const std::string triangle =
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid t\n";
// A link whose shape is this file of the package robot_description.
std::string part(const std::string& file) {
  return "<link name='a'><collision><geometry><mesh filename='package://robot_description/" + file +
         "'/></geometry></collision></link>\n";
}

TEST(UrdfPackages, AreFoundInTheDeclaredFolder) {
  Files files;
  const std::string path = files.write("r.urdf", "<robot name='r'>\n" + part("meshes/a.stl") + "</robot>");
  files.write("ros/robot_description/meshes/a.stl", triangle);
  const auto shapes = [&](const std::string& packages) {
    return read_robot(path, Meshes::import, {packages, ""}).links[0].shapes.size();
  };
  EXPECT_EQ(shapes(files.at("ros")), 1u);
  EXPECT_EQ(shapes(files.at("ros/")), 1u);
  EXPECT_EQ(shapes(files.at("ros/robot_description")), 1u) << "the package itself";
  EXPECT_EQ(message_of([&] { read_robot(path); }),
            path +
                ":2: link 'a': mesh 'package://robot_description/meshes/a.stl' is in a ROS package; expected "
                "packages=\"DIR\" of the <robot> in the world, where DIR holds the folder 'robot_description'");
  EXPECT_EQ(message_of([&] { shapes(files.at("")); }),
            path +
                ":2: link 'a': mesh 'package://robot_description/meshes/a.stl' is in the ROS package "
                "'robot_description', of which there is no folder in packages=\"" +
                files.at("") + "\"");
}

TEST(UrdfPackages, DoNotReachBeyondTheirFolder) {
  Files files;
  files.write("ros/robot_description/package.xml", "");
  files.write("secret.stl", triangle);
  const std::string path = files.write("r.urdf", "<robot name='r'>\n" + part("../../secret.stl") + "</robot>");
  EXPECT_NE(message_of([&] {
              read_robot(path, Meshes::import, {files.at("ros"), ""});
            }).find("is outside the allowed"),
            std::string::npos);
}

}  // namespace
}  // namespace muster::description
