# Every header under PREFIX compiles by itself, with a user's strict warnings.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE headers RELATIVE "${PREFIX}/include" "${PREFIX}/include/*")
if(NOT headers)
    message(FATAL_ERROR "No headers are installed under ${PREFIX}/include")
endif()
foreach(header IN LISTS headers)
    file(WRITE "${WORK}/alone.cpp" "#include <${header}>\n")
    execute_process(
        COMMAND "${CXX_COMPILER}" -std=c++20 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
            "-I${PREFIX}/include" -fsyntax-only "${WORK}/alone.cpp"
        RESULT_VARIABLE failed ERROR_VARIABLE errors)
    if(failed)
        message(SEND_ERROR "<${header}> does not compile by itself:\n${errors}")
    endif()
endforeach()
