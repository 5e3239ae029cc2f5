# CTest sees one test for each unit test (label unit) and one for each case (labels: its tier and its family).
include(Catch)
catch_discover_tests(furrow-tests PROPERTIES LABELS unit)

# The cases are asked for when CTest starts, so that a new block in a cases.toml is a test at once.
file(WRITE ${CMAKE_BINARY_DIR}/cases.cmake
"execute_process(COMMAND \"${CMAKE_BINARY_DIR}/furrow-program\" list --ctest OUTPUT_VARIABLE cases RESULT_VARIABLE failed)
if(failed)
  add_test(cases.toml \"${CMAKE_BINARY_DIR}/furrow-program\" list)
else()
  file(WRITE \"${CMAKE_BINARY_DIR}/case_tests.cmake\" \"\${cases}\")
  include(\"${CMAKE_BINARY_DIR}/case_tests.cmake\")
endif()
")
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_BINARY_DIR}/cases.cmake)
