# What `cpack` makes: a Debian package whose dependencies are found in the programs themselves, and an archive that runs
# from wherever it is unpacked. `cpack --config build/release/CPackConfig.cmake -B out`.
set(CPACK_PACKAGE_NAME pneuma)
set(CPACK_PACKAGE_VENDOR "The Pneuma developers")
# No mail reaches this address: who publishes a package puts theirs here.
set(CPACK_PACKAGE_CONTACT "The Pneuma developers <maintainers@pneuma.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "lobes, airway trees and breathing from chest CT")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_GENERATOR "DEB;TGZ")
# One package of what people use; libraries and headers (component dev) are installed by `cmake --install`.
set(CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON) # as a component its files are packed in the order of their names
# The same build gives the same bytes.
configure_file(cmake/PackEach.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/generated/install/PackEach.cmake" @ONLY)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_BINARY_DIR}/generated/install/PackEach.cmake")
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_BINARY_DIR}/generated/install/PackEach.cmake")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_FILE_NAME "pneuma-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${PNEUMA_HOMEPAGE}")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# Pictures without a screen, and the font that they are made with.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "xvfb, xauth, libgl1-mesa-dri, fonts-inter")
# The engine of cohorts, their tables and plots.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "snakemake, python3-h5py, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Pneuma goes from a chest CT, or from surfaces of lobes, to an airway tree
that breathes: it finds the lungs, splits them into lobes along their
fissures, grows the bronchial tree by three published methods and moves
everything by an elastic model. Results are files for ParaView, tables,
pictures and reports.
.
Research use only; not a medical device.")
include(CPack)
