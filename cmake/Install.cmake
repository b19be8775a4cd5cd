# What `cmake --install` puts in place beside the programs, which their own folders install.
# The day of the newest release stands in the metainfo; packages and what is in them have that time, or the one of
# SOURCE_DATE_EPOCH, so that the same source gives the same bytes.
set(PNEUMA_HOMEPAGE "https://pneuma.example" CACHE STRING "Address that a published package names")
file(READ packaging/linux/org.pneuma.Pneuma.metainfo.xml.in metainfo)
if(NOT metainfo MATCHES "<release [^>]*date=\"([0-9-]+)\"")
  message(FATAL_ERROR "org.pneuma.Pneuma.metainfo.xml.in names no release with its date")
endif()
set(PNEUMA_EPOCH "$ENV{SOURCE_DATE_EPOCH}")
if(NOT PNEUMA_EPOCH)
  execute_process(COMMAND date -u -d "${CMAKE_MATCH_1}" +%s OUTPUT_VARIABLE PNEUMA_EPOCH
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()
execute_process(COMMAND env LC_ALL=C date -u -R -d "@${PNEUMA_EPOCH}" OUTPUT_VARIABLE releaseDate
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

install(DIRECTORY "${PROJECT_SOURCE_DIR}/resources/airways" "${PROJECT_SOURCE_DIR}/resources/schemas"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/pneuma")
install(FILES LICENSE README.md CITATION.cff SECURITY.md packaging/linux/copyright DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(PROGRAMS packaging/demo.sh DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples")
if(PNEUMA_BUILD_GUI)
  install(FILES packaging/linux/org.pneuma.Pneuma.desktop
          DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
  configure_file(packaging/linux/org.pneuma.Pneuma.metainfo.xml.in
                 "${CMAKE_CURRENT_BINARY_DIR}/generated/install/org.pneuma.Pneuma.metainfo.xml" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/generated/install/org.pneuma.Pneuma.metainfo.xml"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo")
  install(FILES packaging/linux/org.pneuma.Pneuma.xml
          DESTINATION "${CMAKE_INSTALL_DATADIR}/mime/packages")
  install(FILES packaging/linux/org.pneuma.Pneuma.thumbnailer
          DESTINATION "${CMAKE_INSTALL_DATADIR}/thumbnailers")
  add_subdirectory(packaging/icons)
endif()

# What the programs tell of themselves: made by them, so that it is never out of date.
set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated/install")
file(MAKE_DIRECTORY "${generated}")
set(told "")
function(pneuma_tell file)
  add_custom_command(
    OUTPUT "${generated}/${file}"
    COMMAND sh -c "\"$0\" \"$@\" >\"${generated}/${file}\"" $<TARGET_FILE:pneuma_cli> ${ARGN}
    DEPENDS pneuma_cli
    VERBATIM)
  set(told ${told} "${generated}/${file}" PARENT_SCOPE)
endfunction()
pneuma_tell(pneuma.1 help --man)
pneuma_tell(pneuma.bash completion bash)
pneuma_tell(pneuma.zsh completion zsh)
pneuma_tell(pneuma.fish completion fish)
add_custom_target(pneuma_told ALL DEPENDS ${told})
set(bash "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(FILES "${generated}/pneuma.bash" RENAME pneuma DESTINATION "${bash}")
install(FILES "${generated}/pneuma.zsh" RENAME _pneuma DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
install(FILES "${generated}/pneuma.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")

# Manual pages and changes as Debian has them.
find_program(PNEUMA_GZIP gzip REQUIRED)
function(pneuma_install_gzipped from name destination)
  set(to "${generated}/${name}.gz")
  add_custom_command(
    OUTPUT "${to}"
    COMMAND sh -c "\"${PNEUMA_GZIP}\" -9n <\"${from}\" >\"${to}\""
    DEPENDS "${from}" ${ARGN}
    VERBATIM)
  add_custom_target(pneuma_gzipped_${name} ALL DEPENDS "${to}")
  install(FILES "${to}" DESTINATION "${destination}")
endfunction()
pneuma_install_gzipped("${generated}/pneuma.1" pneuma.1 "${CMAKE_INSTALL_MANDIR}/man1" pneuma_told)
pneuma_install_gzipped("${PROJECT_SOURCE_DIR}/CHANGELOG.md" changelog "${CMAKE_INSTALL_DOCDIR}")
# The package's own history, in Debian's form.
file(CONFIGURE OUTPUT "${generated}/changelog.Debian" CONTENT "pneuma (@PROJECT_VERSION@-1) unstable; urgency=medium

  * See changelog.gz for what changed.

 -- The Pneuma developers <maintainers@pneuma.example>  @releaseDate@
" @ONLY)
pneuma_install_gzipped("${generated}/changelog.Debian" changelog.Debian "${CMAKE_INSTALL_DOCDIR}")
if(PNEUMA_BUILD_GUI)
  pneuma_install_gzipped("${PROJECT_SOURCE_DIR}/packaging/linux/pneuma-desktop.1" pneuma-desktop.1
                         "${CMAKE_INSTALL_MANDIR}/man1")
endif()

# What the programs link, as SPDX. Libraries of headers only are named here: a program does not tell of them.
find_program(PNEUMA_BASH bash REQUIRED)
set(programs $<TARGET_FILE:pneuma_cli>)
if(PNEUMA_BUILD_GUI)
  list(APPEND programs $<TARGET_FILE:pneuma_desktop>)
endif()
add_custom_command(
  OUTPUT "${generated}/sbom.spdx.json"
  COMMAND "${CMAKE_COMMAND}" -E env SOURCE_DATE_EPOCH=${PNEUMA_EPOCH} sh -c
          "\"$0\" \"$@\" >\"${generated}/sbom.spdx.json.part\" && mv \"${generated}/sbom.spdx.json.part\" \"${generated}/sbom.spdx.json\""
          "${PNEUMA_BASH}" "${PROJECT_SOURCE_DIR}/packaging/sbom.sh" ${PROJECT_VERSION} ${programs} --
          "Boost=${Boost_VERSION_STRING}=BSL-1.0=libboost-dev"
          "CGAL=${CGAL_VERSION}=GPL-3.0-or-later AND LGPL-3.0-or-later=libcgal-dev"
          "CLI11=${CLI11_VERSION}=BSD-3-Clause=libcli11-dev"
          "Eigen=${Eigen3_VERSION}=MPL-2.0=libeigen3-dev"
          "nanoflann=${nanoflann_VERSION}=BSD-2-Clause=libnanoflann-dev"
          "nlohmann-json=${nlohmann_json_VERSION}=MIT=nlohmann-json3-dev"
  DEPENDS pneuma_cli packaging/sbom.sh $<$<BOOL:${PNEUMA_BUILD_GUI}>:pneuma_desktop>
  VERBATIM)
add_custom_target(pneuma_sbom ALL DEPENDS "${generated}/sbom.spdx.json")
install(FILES "${generated}/sbom.spdx.json" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
