# facescan_test(NAME SOURCES ... LIBS ...)
#
# A GoogleTest program of the build folder's bin/, its cases known to CTest one by one, with the name
# of their folder as label.
# TEST_DATA_DIR names the checked-in tests/data, SHARED_DATA_DIR a folder of larger recordings that
# may be absent: a test that wants it skips, and says so.
#
# In a build for another processor starting the program takes longer than most cases: there CTest
# knows it as a few parts, which can run side by side.
#
# Reading GoogleTest's headers takes longer than compiling most tests: it is done once for all
# programs. A test's own code is optimised a little only; the libraries under test are as they ship.
include(GoogleTest)

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/test_headers.cpp CONTENT "")
add_library(facescan_test_headers OBJECT ${PROJECT_BINARY_DIR}/test_headers.cpp)
target_link_libraries(facescan_test_headers PUBLIC facescan_warnings GTest::gmock GTest::gtest_main)
target_compile_options(facescan_test_headers PUBLIC $<$<CONFIG:Release>:-O1>)
target_precompile_headers(facescan_test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h>)

function(facescan_test name)
    cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBS} facescan_test_headers)
    target_precompile_headers(${name} REUSE_FROM facescan_test_headers)
    target_compile_definitions(${name} PRIVATE
        TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
        SHARED_DATA_DIR="${FACESCAN_SHARED_DATA}")
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    get_filename_component(subject ${CMAKE_CURRENT_SOURCE_DIR} NAME)
    if(CMAKE_CROSSCOMPILING)
        facescan_test_in_parts(${name} 4 ${subject})
    else()
        gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES LABELS ${subject})
    endif()
endfunction()

function(facescan_test_in_parts name parts label)
    math(EXPR last "${parts} - 1")
    foreach(part RANGE ${last})
        add_test(NAME ${name}_${part} COMMAND ${name})
        set_tests_properties(${name}_${part} PROPERTIES
            LABELS ${label}
            ENVIRONMENT "GTEST_TOTAL_SHARDS=${parts};GTEST_SHARD_INDEX=${part}")
    endforeach()
endfunction()
