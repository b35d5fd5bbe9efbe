# Finds what the library stands on, then the library. Three of Debian 12's own configs are broken: ours lie beside this file.
include(CMakeFindDependencyMacro)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
foreach(package Threads fmt Imath OpenEXR TBB embree nlohmann_json OpenColorIO OpenSubdiv)
  find_dependency(${package})
endforeach()
list(POP_FRONT CMAKE_MODULE_PATH)
include(${CMAKE_CURRENT_LIST_DIR}/sateen-targets.cmake)
