# RAILWAVE_VERSION, from the tag where the checkout has one: 0.1.0 at the tag v0.1.0 itself, 0.1.0+5.g1a2b3c4 five commits
# after it. Without a tag, or without git, it is the version of project(). It is asked for when CMake configures.
set(RAILWAVE_VERSION "${PROJECT_VERSION}")
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS "${CMAKE_SOURCE_DIR}/.git")
  execute_process(COMMAND "${GIT_EXECUTABLE}" describe --tags --match "v[0-9]*"
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}" OUTPUT_VARIABLE described RESULT_VARIABLE failed
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed AND described MATCHES "^v([0-9]+\\.[0-9]+\\.[0-9]+)(-([0-9]+)-(g[0-9a-f]+))?$")
    set(RAILWAVE_VERSION "${CMAKE_MATCH_1}")
    if(CMAKE_MATCH_2)
      string(APPEND RAILWAVE_VERSION "+${CMAKE_MATCH_3}.${CMAKE_MATCH_4}")
    endif()
    if(NOT CMAKE_MATCH_1 VERSION_EQUAL PROJECT_VERSION)
      message(WARNING "The tag ${described} and project() in CMakeLists.txt (${PROJECT_VERSION}) differ: the tag counts.")
    endif()
  endif()
endif()
message(STATUS "Railwave ${RAILWAVE_VERSION}")
