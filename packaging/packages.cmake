# cpack -G DEB in the build folder: muster (program, plugins, worlds), muster-dev (what is built against it), muster-ns3 and muster-mujoco where
# these simulators are, and python3-muster where Python's parts are.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME muster)
set(CPACK_PACKAGE_VENDOR "muster")
set(MUSTER_MAINTAINER "The authors of muster <muster@localhost>" CACHE STRING "maintainer of the packages, with an address that can be reached")
set(CPACK_PACKAGE_CONTACT "${MUSTER_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL muster dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(release ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

set(CPACK_DEBIAN_MUSTER_PACKAGE_NAME muster)
set(CPACK_DEBIAN_MUSTER_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_MUSTER_DESCRIPTION "simulator of robot teams that talk by radio
Robots move, sense and talk by radio in buildings whose walls shape the
channel; every part is a plugin. Measurements calibrate a world, and a
diagnosis names what the world gets wrong.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME muster-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "muster (= ${release}), libsleef-dev, cmake (>= 3.25), g++, make | ninja-build")
# Of those who link the kernel alone.
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libfmt-dev, libtbb-dev, libtinyxml2-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "files for plugins of muster, and for programs that embed its kernel
Headers of the plugin contract, functions for CMake, and the kernel as a
static library.")

if(TARGET network_ns3)
  list(APPEND CPACK_COMPONENTS_ALL ns3)
  set(CPACK_DEBIAN_NS3_PACKAGE_NAME muster-ns3)
  set(CPACK_DEBIAN_NS3_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_NS3_PACKAGE_DEPENDS "muster (= ${release})")
  set(CPACK_COMPONENT_NS3_DESCRIPTION "networks of ns-3 in worlds of muster
The plugin network.ns3.")
endif()

if(TARGET physics_mujoco)
  list(APPEND CPACK_COMPONENTS_ALL mujoco)
  set(CPACK_DEBIAN_MUJOCO_PACKAGE_NAME muster-mujoco)
  set(CPACK_DEBIAN_MUJOCO_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_MUJOCO_PACKAGE_DEPENDS "muster (= ${release})")
  set(CPACK_COMPONENT_MUJOCO_DESCRIPTION "robots of muster in MuJoCo
The plugin physics.mujoco.")
endif()

if(MUSTER_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-muster)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The extension is for one minor version of Python.
  string(REGEX REPLACE ".*[.]" "" minor ${MUSTER_PYTHON_VERSION})
  math(EXPR minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "muster (= ${release}), python3 (>= ${MUSTER_PYTHON_VERSION}~), python3 (<< 3.${minor}), python3-numpy")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "worlds of muster from Python
Loads and steps worlds, reads their tables as arrays of numpy without a copy,
and takes functions of Python in the place of plugins.")
endif()

# What every package of Debian has: its copyright, and a change log of the packaging, which leads to that of the project.
file(STRINGS ${PROJECT_SOURCE_DIR}/CHANGELOG.md released REGEX "^## ${PROJECT_VERSION} \\([0-9-]+\\)$")
string(REGEX REPLACE ".*\\((.*)\\)" "\\1" released "${released}")
execute_process(COMMAND date -u -R -d "${released}" OUTPUT_VARIABLE released OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(components muster dev)
if(TARGET network_ns3)
  list(APPEND components ns3)
endif()
if(TARGET physics_mujoco)
  list(APPEND components mujoco)
endif()
if(MUSTER_PYTHON)
  list(APPEND components python)
endif()
foreach(component IN LISTS components)
  string(TOUPPER ${component} capital)
  set(package ${CPACK_DEBIAN_${capital}_PACKAGE_NAME})
  set(log ${CMAKE_CURRENT_BINARY_DIR}/${package}/changelog.Debian)
  file(CONFIGURE OUTPUT ${log} @ONLY CONTENT "@package@ (@release@) unstable; urgency=medium

  * Release @PROJECT_VERSION@: /usr/share/doc/muster/CHANGELOG.md lists the changes.

 -- @CPACK_PACKAGE_CONTACT@  @released@
")
  execute_process(COMMAND gzip -9nkf ${log} COMMAND_ERROR_IS_FATAL ANY)
  # For packages alone: any other prefix has LICENSE.
  install(FILES ${log}.gz ${CMAKE_CURRENT_SOURCE_DIR}/copyright DESTINATION share/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
