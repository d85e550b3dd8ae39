# Compiles SNIPPET with MENDED defined, which must succeed, and without, which must fail on the line
# that is marked "must not compile". So neither a typing mistake nor a missing header passes for the
# error that is meant.
cmake_minimum_required(VERSION 3.25)
set(compile ${COMPILER} -std=c++20 -fsyntax-only -Werror=unused-result "-I${INCLUDE}")

execute_process(COMMAND ${compile} -DMENDED "${SNIPPET}" RESULT_VARIABLE status ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "${SNIPPET}, mended, must compile, but:\n${errors}")
endif()

set(number 0)
set(marked 0)
file(READ "${SNIPPET}" text)
string(REPLACE ";" "," text "${text}")
string(REPLACE "\n" ";" text "${text}")
foreach(line IN LISTS text)
    math(EXPR number "${number} + 1")
    if(line MATCHES "// must not compile")
        set(marked ${number})
    endif()
endforeach()

execute_process(COMMAND ${compile} "${SNIPPET}" RESULT_VARIABLE status ERROR_VARIABLE errors)
if(status EQUAL 0)
    message(FATAL_ERROR "${SNIPPET} compiles, and must not")
endif()
get_filename_component(name "${SNIPPET}" NAME)
if(NOT errors MATCHES "${name}:${marked}:[0-9]+: error")
    message(FATAL_ERROR "${SNIPPET} must fail on line ${marked}, but fails elsewhere:\n${errors}")
endif()
