# What `cmake --install` copies, and the packages CPack makes of it. No path is compiled in: the tree
# runs from wherever it is put.
include(GNUInstallDirs)
install(TARGETS dipper DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS dipper-dem dipper-mbs dipper-liggghts bench-cut place-rocks
        DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/dipper)

set(data ${CMAKE_INSTALL_DATADIR}/dipper)
install(DIRECTORY dem_in meshes cases DESTINATION ${data})
install(DIRECTORY mbs DESTINATION ${data} FILES_MATCHING PATTERN "*.yaml")
install(DIRECTORY analysis/effects analysis/gap analysis/logs analysis/runs analysis/study analysis/survey DESTINATION ${data}/analysis
        PATTERN "__pycache__" EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Dipper developers <dipper@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # libraries; below, what is started by name
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "liggghts, openmpi-bin, python3, python3-numpy, python3-scipy, python3-sklearn, python3-h5py, python3-yaml, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "chromium, ffmpeg")  # for report --poster and --video
include(CPack)
