# What `cmake --install` puts in place beside the programs, which their own folders install.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/resources/airways" "${PROJECT_SOURCE_DIR}/resources/schemas"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/pneuma")
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DOCDIR}")
if(PNEUMA_BUILD_GUI)
  install(FILES packaging/linux/org.pneuma.Pneuma.desktop
          DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
  install(FILES resources/gui/icons/pneuma.svg RENAME org.pneuma.Pneuma.svg
          DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps")
endif()
