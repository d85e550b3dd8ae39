# Installation, and what find_package(GeneClocks COMPONENTS ...) and pkg-config read.
#
# Every component is installed by itself: `cmake --install build/release --component protocol`.
include(CMakePackageConfigHelpers)

# All that `cmake --install` takes, and nothing else: no tests.
add_custom_target(installable)

set(gene_clocks_package_directory "${CMAKE_INSTALL_LIBDIR}/cmake/GeneClocks")

foreach(component protocol storage authentication neat sim)
    if(TARGET gene_clocks_${component})
        add_dependencies(installable gene_clocks_${component})
        install(TARGETS gene_clocks_${component} EXPORT GeneClocks-${component}
            COMPONENT ${component})
        install(EXPORT GeneClocks-${component} COMPONENT ${component}
            NAMESPACE GeneClocks:: DESTINATION "${gene_clocks_package_directory}")
    endif()
endforeach()

if(TARGET gene-clocks)
    add_dependencies(installable gene-clocks)
endif()

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

# The way from the .pc file to the headers, so that a prefix can be moved; where the headers were
# given a place of their own (Nix), that place.
set(gene_clocks_pc_directory "${CMAKE_INSTALL_DATADIR}/pkgconfig")
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}" OR IS_ABSOLUTE "${gene_clocks_pc_directory}")
    set(gene_clocks_pc_includedir "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
    file(RELATIVE_PATH gene_clocks_pc_includedir
        "/${gene_clocks_pc_directory}" "/${CMAKE_INSTALL_INCLUDEDIR}")
    string(PREPEND gene_clocks_pc_includedir "\${pcfiledir}/")
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/gene-clocks-protocol.pc.in" gene-clocks-protocol.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/gene-clocks-protocol.pc"
    DESTINATION "${gene_clocks_pc_directory}" COMPONENT protocol)

install(FILES "${CMAKE_CURRENT_LIST_DIR}/../LICENSE"
    DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT protocol)
