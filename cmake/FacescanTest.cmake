# facescan_test(NAME SOURCES ... LIBS ...)
#
# A GoogleTest program of the build folder's bin/, its cases known to CTest one by one.
# TEST_DATA_DIR names the checked-in tests/data, SHARED_DATA_DIR a folder of larger recordings that
# may be absent: a test that wants it skips, and says so.
include(GoogleTest)
function(facescan_test name)
    cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBS} facescan_warnings GTest::gmock GTest::gtest_main)
    target_compile_definitions(${name} PRIVATE
        TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
        SHARED_DATA_DIR="${FACESCAN_SHARED_DATA}")
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST)
endfunction()
