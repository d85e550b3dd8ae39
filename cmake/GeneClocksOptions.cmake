# Without a build type CMake would leave out the optimiser and say nothing.
get_property(gene_clocks_is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT CMAKE_BUILD_TYPE AND NOT gene_clocks_is_multi_config
   AND CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
    message(STATUS "Gene Clocks: no CMAKE_BUILD_TYPE was given; building Release")
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

# What every target of our own is compiled with. Nothing here is exported to users.
#
# -ffp-contract=off: a fused multiply-add rounds once where two operations round twice, so a
# trajectory would depend on the compiler and the processor.
add_library(gene_clocks_options INTERFACE)
add_library(GeneClocks::options ALIAS gene_clocks_options)
target_compile_features(gene_clocks_options INTERFACE cxx_std_20 c_std_99)
target_compile_options(gene_clocks_options INTERFACE -ffp-contract=off)
# Private headers are included by their path from here, so that each include names its layer.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH gene_clocks_root)
target_include_directories(gene_clocks_options INTERFACE $<BUILD_INTERFACE:${gene_clocks_root}>)

# Libraries that users link. A static library that is not position-independent cannot become part of
# a plugin (an ARGoS controller, a Python module); without semantic interposition that costs nothing.
add_library(gene_clocks_shipped INTERFACE)
set_target_properties(gene_clocks_shipped PROPERTIES INTERFACE_POSITION_INDEPENDENT_CODE ON)
target_compile_options(gene_clocks_shipped INTERFACE -fno-semantic-interposition)

# The folder `include` beside the caller's CMakeLists.txt holds a library's public headers.
function(gene_clocks_public_headers target)
    get_target_property(type ${target} TYPE)
    set(scope PUBLIC)
    if(type STREQUAL "INTERFACE_LIBRARY")
        set(scope INTERFACE)
    endif()
    # For users these are system headers: their own warnings are about their own code.
    target_include_directories(${target} ${scope}
        "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>"
        "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
    string(REPLACE "gene_clocks_" "" component ${target})
    if(GENE_CLOCKS_INSTALL)
        install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/include/"
            DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT ${component})
    endif()
endfunction()

option(GENE_CLOCKS_WARNINGS_AS_ERRORS "Compile our own code with -Werror" ${PROJECT_IS_TOP_LEVEL})
set(GENE_CLOCKS_SANITIZERS "" CACHE STRING "Comma-separated -fsanitize= list, e.g. address,undefined")

add_library(gene_clocks_warnings INTERFACE)
target_compile_options(gene_clocks_warnings INTERFACE -Wall -Wextra -Wconversion
    $<$<BOOL:${GENE_CLOCKS_WARNINGS_AS_ERRORS}>:-Werror>
    # The stable_sort of g++ 12's library calls what that library calls deprecated; only clang tells.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>)

if(GENE_CLOCKS_SANITIZERS)
    target_compile_options(gene_clocks_options INTERFACE
        -fsanitize=${GENE_CLOCKS_SANITIZERS} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(gene_clocks_options INTERFACE -fsanitize=${GENE_CLOCKS_SANITIZERS})
    target_compile_definitions(gene_clocks_options INTERFACE GENE_CLOCKS_SANITIZED)
endif()
