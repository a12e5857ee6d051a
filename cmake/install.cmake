# Where the program and its files go (`cmake --install`), and the Debian package (`cpack -G DEB`).
include(GNUInstallDirs)

install(TARGETS lamplighter RUNTIME)
# Found by renderer/base/data_folder.cpp, relative to the program.
install(DIRECTORY shaders DESTINATION ${CMAKE_INSTALL_DATADIR}/lamplighter
  FILES_MATCHING PATTERN "*.glsl" PATTERN "*.h")
install(DIRECTORY assets/scenes assets/profiles assets/tutorial
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lamplighter/assets PATTERN "*.py" EXCLUDE)
install(FILES assets/desktop/lamplighter.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES assets/desktop/lamplighter.svg
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES docs/reference/lamplighter.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs PATTERN "*.1" EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "Lamplighter")
set(CPACK_PACKAGE_CONTACT "The Lamplighter developers <lamplighter@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "lighting editor for level designers")
set(CPACK_PACKAGE_DESCRIPTION
"Opens glTF levels, places and tunes lights, and shows soft shadows and several
bounces of indirect light while they are dragged. Bakes light maps.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# Libraries are found by dpkg-shlibdeps. libepoxy opens OpenGL when it runs, and fonts are files:
# these it cannot find.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1, libgl1-mesa-dri, fonts-inter, fonts-fork-awesome")
include(CPack)
