# facescan_test(NAME SOURCES ... LIBS ...)
#
# A GoogleTest program of the build folder's bin/, its cases known to CTest one by one.
# TEST_DATA_DIR names the checked-in tests/data, SHARED_DATA_DIR a folder of larger recordings that
# may be absent: a test that wants it skips, and says so.
#
# In a build for another processor starting the program takes longer than most cases: there CTest
# knows it as a few parts, which can run side by side.
include(GoogleTest)
function(facescan_test name)
    cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBS} facescan_warnings GTest::gmock GTest::gtest_main)
    target_compile_definitions(${name} PRIVATE
        TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
        SHARED_DATA_DIR="${FACESCAN_SHARED_DATA}")
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    if(CMAKE_CROSSCOMPILING)
        facescan_test_in_parts(${name} 4)
    else()
        gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST)
    endif()
endfunction()

function(facescan_test_in_parts name parts)
    math(EXPR last "${parts} - 1")
    foreach(part RANGE ${last})
        add_test(NAME ${name}_${part} COMMAND ${name})
        set_tests_properties(${name}_${part} PROPERTIES
            ENVIRONMENT "GTEST_TOTAL_SHARDS=${parts};GTEST_SHARD_INDEX=${part}")
    endforeach()
endfunction()
