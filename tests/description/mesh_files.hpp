// Small valid meshes of each format that is read: one triangle.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace muster::description {

inline std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
}

inline std::string triangle(const std::string& vertex) {
  return "solid t\n" + facet("0 0 0", "1 0 0", vertex) + "endsolid t\n";
}

inline std::string binary_triangle() {
  std::string bytes(84 + 50, '\0');
  const std::uint32_t count = 1;
  const float corner[] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};  // normal first
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  std::memcpy(bytes.data() + 84, corner, sizeof corner);
  return bytes;
}

inline const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

inline const std::string rich_obj =
    "# all that a face may name\nmtllib a.mtl\no part\ng group\nusemtl red\ns 1\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 1 1 0\n"
    "vt 0 0\nvt 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1\nf -3//1 -2//1 -1//1\nl 1 2\np 1\n";

inline const std::string collada =
    R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
    <asset><unit meter="0.1"/><up_axis>Y_UP</up_axis></asset>
    <library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 10 0 0 0 10 0</float_array>
    <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
    <param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
    </vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
    </library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
    </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

}  // namespace muster::description
