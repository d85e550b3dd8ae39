# Configures, builds and installs the project from SOURCE into an empty PREFIX, with a user's strict
# warnings.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND
    ${CMAKE_COMMAND} -S "${SOURCE}" -B "${BUILD}" -G "${GENERATOR}" ${OPTIONS}
        -DGENE_CLOCKS_BUILD_TESTS=OFF -DGENE_CLOCKS_BUILD_BENCH=OFF
        "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror")
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND
    ${CMAKE_COMMAND} --build "${BUILD}")
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND
    ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${PREFIX}")
