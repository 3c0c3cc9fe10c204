# muster_world_test(NAME WORLD file [PLUGINS targets...] [LAST table column low high]...): a test that runs a world with these plugins.
# It fails where the run does, and where a column's last cell lies outside of low to high, which are included:
#   muster_world_test(arrives WORLD world.xml PLUGINS control_mine LAST robot/rover/pose x 1.9 2.1)
function(muster_world_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "WORLD" "PLUGINS;LAST" )
  if(NOT arg_WORLD OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "muster_world_test(${name}): expected WORLD file, and no more than PLUGINS and LAST beside it: \"${ARGN}\"")
  endif()
  list(LENGTH arg_LAST count)
  math(EXPR left "${count} % 4")
  if(left)
    message(FATAL_ERROR "muster_world_test(${name}): LAST takes a table, a column, the lowest and the highest value, each time")
  endif()
  set(folders)
  foreach(plugin IN LISTS arg_PLUGINS)
    list(APPEND folders $<TARGET_FILE_DIR:${plugin}>)
  endforeach()
  cmake_path(ABSOLUTE_PATH arg_WORLD BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  # Words of a list would be words of the command: commas are no part of names of tables.
  string(REPLACE ";" "," last "${arg_LAST}")
  list(JOIN folders "," folders)
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:muster::muster> -D WORLD=${arg_WORLD}
    -D FOLDERS=${folders} -D LAST=${last} -D OUT=${CMAKE_CURRENT_BINARY_DIR}/${name}.out
    -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/MusterWorldTestRun.cmake)
endfunction()
