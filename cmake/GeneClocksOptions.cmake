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
