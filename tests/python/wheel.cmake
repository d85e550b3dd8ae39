# Builds a wheel from a copy of SOURCE, without a network, and runs TEST against what is in it.
cmake_minimum_required(VERSION 3.25)
find_program(python python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(python)
    execute_process(COMMAND "${python}" -c "import pybind11.setup_helpers, setuptools, wheel"
        RESULT_VARIABLE lacks_packages ERROR_QUIET)
endif()
if(NOT python OR lacks_packages)
    message("Skipped: there is no /usr/bin/python3 with setuptools, wheel and pybind11")
    return()
endif()

file(REMOVE_RECURSE "${WORK}")
file(COPY "${SOURCE}/python" DESTINATION "${WORK}")
file(COPY "${SOURCE}/protocol/include" "${SOURCE}/protocol/authentication"
    DESTINATION "${WORK}/protocol")
execute_process(COMMAND_ERROR_IS_FATAL ANY WORKING_DIRECTORY "${WORK}/python" COMMAND
    "${python}" -c "from setuptools import build_meta; build_meta.build_wheel('${WORK}/wheels')")
file(GLOB wheel "${WORK}/wheels/gene_clocks-*.whl")
if(NOT wheel)
    message(FATAL_ERROR "No wheel of gene-clocks was made")
endif()
file(ARCHIVE_EXTRACT INPUT "${wheel}" DESTINATION "${WORK}/site")
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND
    ${CMAKE_COMMAND} -E env "PYTHONPATH=${WORK}/site" "${python}" -B "${TEST}")
# The wheel is of the version that it says it is.
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND
    ${CMAKE_COMMAND} -E env "PYTHONPATH=${WORK}/site" "${python}" -B -c
    "import gene_clocks, importlib.metadata as m; assert m.version('gene-clocks') == gene_clocks.__version__")
