# muster_plugin(NAME source...): one shared object beside the others, exporting muster_register and nothing else.
#   -fno-gnu-unique   else dlclose() never unloads a C++ library of g++, and a reload silently runs the old code
#   -ffp-contract=off the same source gives the same bits at every optimisation level
#   -Wl,-z,defs       a symbol that nobody defines is an error of the build, not of the run
#   exports.map       inline functions of visible classes (std::, Assimp::) would be exported too: a library that stays loaded
#                     would bind to them, and hold the plugin
function(muster_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE muster::plugin_api)
  target_compile_options(${name} PRIVATE -ffp-contract=off)
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON
    C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/plugins)
  target_link_options(${name} PRIVATE -Wl,--version-script=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exports.map)
  set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exports.map)
  if(NOT MUSTER_SANITIZE)  # the sanitizers' runtime stays undefined in a library
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fno-gnu-unique>)
  endif()
endfunction()
