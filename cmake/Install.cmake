# What `cmake --install` puts in place beside the programs, which their own folders install.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/resources/airways" "${PROJECT_SOURCE_DIR}/resources/schemas"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/pneuma")
install(FILES LICENSE README.md CITATION.cff SECURITY.md packaging/linux/copyright DESTINATION "${CMAKE_INSTALL_DOCDIR}")
if(PNEUMA_BUILD_GUI)
  install(FILES packaging/linux/org.pneuma.Pneuma.desktop
          DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
  install(FILES packaging/linux/org.pneuma.Pneuma.metainfo.xml
          DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo")
  install(FILES packaging/linux/org.pneuma.Pneuma.xml
          DESTINATION "${CMAKE_INSTALL_DATADIR}/mime/packages")
  install(FILES resources/gui/icons/pneuma.svg RENAME org.pneuma.Pneuma.svg
          DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps")
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

 -- The Pneuma developers <maintainers@pneuma.example>  Fri, 27 Nov 2026 08:00:00 +0000
" @ONLY)
pneuma_install_gzipped("${generated}/changelog.Debian" changelog.Debian "${CMAKE_INSTALL_DOCDIR}")
if(PNEUMA_BUILD_GUI)
  pneuma_install_gzipped("${PROJECT_SOURCE_DIR}/packaging/linux/pneuma-desktop.1" pneuma-desktop.1
                         "${CMAKE_INSTALL_MANDIR}/man1")
endif()
