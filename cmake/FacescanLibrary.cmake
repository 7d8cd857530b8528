# facescan_library(NAME SOURCES ... [PUBLIC libs...] [PRIVATE libs...])
#
# One folder, one library. Its headers are reached as "NAME/header.h", and only by targets that link
# it: each library has an include root of its own that holds nothing but a link to its folder. So an
# include that goes against the architecture does not compile.
function(facescan_library name)
    cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    set(root ${PROJECT_BINARY_DIR}/include/${name})
    file(MAKE_DIRECTORY ${root})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${name} SYMBOLIC)

    add_library(facescan_${name} STATIC ${arg_SOURCES})
    add_library(facescan::${name} ALIAS facescan_${name})
    target_include_directories(facescan_${name} PUBLIC ${root})
    target_link_libraries(facescan_${name} PUBLIC ${arg_PUBLIC} PRIVATE facescan_warnings ${arg_PRIVATE})
endfunction()
