# Finds what the library stands on, then the library. What Debian 12 has no sound config for lies beside this file.
include(CMakeFindDependencyMacro)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
foreach(package Threads fmt Imath OpenEXR TBB embree nlohmann_json Cairo OpenColorIO OpenSubdiv)
  find_dependency(${package})
endforeach()
list(POP_FRONT CMAKE_MODULE_PATH)
include(${CMAKE_CURRENT_LIST_DIR}/sateen-targets.cmake)
