# Installation, and what find_package(GeneClocks COMPONENTS ...) and pkg-config read.
#
# Every component is installed by itself: `cmake --install build/release --component protocol`.
include(CMakePackageConfigHelpers)

set(gene_clocks_package_directory "${CMAKE_INSTALL_LIBDIR}/cmake/GeneClocks")

foreach(component protocol storage authentication neat sim)
    if(TARGET gene_clocks_${component})
        install(TARGETS gene_clocks_${component} EXPORT GeneClocks-${component}
            COMPONENT ${component}
            FILE_SET HEADERS COMPONENT ${component})
        install(EXPORT GeneClocks-${component} COMPONENT ${component}
            NAMESPACE GeneClocks:: DESTINATION "${gene_clocks_package_directory}")
    endif()
endforeach()

configure_package_config_file(
    "${CMAKE_CURRENT_LIST_DIR}/GeneClocksConfig.cmake.in" GeneClocksConfig.cmake
    INSTALL_DESTINATION "${gene_clocks_package_directory}"
    NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(GeneClocksConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    "${CMAKE_CURRENT_BINARY_DIR}/GeneClocksConfig.cmake"
    "${CMAKE_CURRENT_BINARY_DIR}/GeneClocksConfigVersion.cmake"
    DESTINATION "${gene_clocks_package_directory}" COMPONENT protocol)

configure_file("${CMAKE_CURRENT_LIST_DIR}/gene-clocks-protocol.pc.in" gene-clocks-protocol.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/gene-clocks-protocol.pc"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/pkgconfig" COMPONENT protocol)

install(FILES "${CMAKE_CURRENT_LIST_DIR}/../LICENSE"
    DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT protocol)
