# facescan_python_test(NAME SCRIPT file [ARGS ...] [LABELS ...])
#
# A Python program as one CTest, which finds the programs of the build folder in $SCANEVAL_BIN. It
# starts them itself, without an emulator: in a build for another processor there is no such test.
#
# Python is the system's, the one that Debian's NumPy and SciPy are for, even where another stands
# before it in the PATH.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

function(facescan_python_test name)
    if(CMAKE_CROSSCOMPILING)
        return()
    endif()
    cmake_parse_arguments(arg "" "SCRIPT" "ARGS;LABELS" ${ARGN})
    add_test(NAME ${name}
        COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/${arg_SCRIPT} ${arg_ARGS})
    # With Mesa's threads about, the leak checker's own thread crashes now and then when a program
    # ends. tests/cli/program.py lets it look where none are.
    set_tests_properties(${name} PROPERTIES
        LABELS "${arg_LABELS}"
        ENVIRONMENT "SCANEVAL_BIN=${CMAKE_RUNTIME_OUTPUT_DIRECTORY};ASAN_OPTIONS=detect_leaks=0")
endfunction()
