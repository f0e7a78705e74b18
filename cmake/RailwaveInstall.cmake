# cmake --install, and packages by cpack. docs/install.md says what goes where.
include(CMakePackageConfigHelpers)

set(RAILWAVE_PYTHON_DIR "lib/python3/dist-packages" CACHE STRING
  "Where the Python module is installed, below the prefix; this is the place of Debian's packages")
set(shared "${CMAKE_INSTALL_DATADIR}/railwave")
set(documents "${CMAKE_INSTALL_DATADIR}/doc/railwave")  # the package's name, not the project's

install(TARGETS railwave RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Drawing: the program calls it for sweeps, users call it as railwave-picture.
install(PROGRAMS scripts/picture DESTINATION ${shared}/scripts)
install(FILES scripts/standard_output.py scripts/number_table.py DESTINATION ${shared}/scripts)
install(DIRECTORY scripts/pictures DESTINATION ${shared}/scripts FILES_MATCHING PATTERN "*.py"
  PATTERN "__pycache__" EXCLUDE)
install(CODE "
  set(bin \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
  file(CREATE_LINK \"../${shared}/scripts/picture\" \"\${bin}/railwave-picture\" SYMBOLIC)")

# The page of reports, where scripts/setup --report has made it.
install(FILES build/report/report.html DESTINATION ${shared} OPTIONAL)

install(DIRECTORY cases DESTINATION ${documents}/examples)
install(DIRECTORY examples/ DESTINATION ${documents}/examples/library)
install(DIRECTORY data DESTINATION ${shared})
install(DIRECTORY docs DESTINATION ${documents} FILES_MATCHING PATTERN "*.md" PATTERN "case.schema.json"
  PATTERN "pictures" EXCLUDE)
install(FILES README.md CHANGELOG.md DESTINATION ${documents})
install(FILES LICENSE DESTINATION ${documents} RENAME copyright)

if(TARGET railwave_shared)
  install(TARGETS railwave_shared EXPORT RailwaveTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES src/library/simulation.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/railwave)
  set(config "${CMAKE_INSTALL_LIBDIR}/cmake/Railwave")
  install(EXPORT RailwaveTargets NAMESPACE Railwave:: DESTINATION ${config})
  configure_package_config_file(packaging/RailwaveConfig.cmake.in "${CMAKE_BINARY_DIR}/RailwaveConfig.cmake"
    INSTALL_DESTINATION ${config})
  write_basic_package_version_file("${CMAKE_BINARY_DIR}/RailwaveConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_BINARY_DIR}/RailwaveConfig.cmake" "${CMAKE_BINARY_DIR}/RailwaveConfigVersion.cmake"
    DESTINATION ${config})
  install(FILES "${CMAKE_BINARY_DIR}/packaging/railwave.completion"
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME railwave)
  install(FILES "${CMAKE_BINARY_DIR}/packaging/railwave.manual" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
    RENAME railwave.1)
endif()
if(TARGET railwave_python)
  install(TARGETS railwave_python LIBRARY DESTINATION ${RAILWAVE_PYTHON_DIR})
endif()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME railwave)
set(CPACK_PACKAGE_VERSION "${RAILWAVE_VERSION}")
set(CPACK_PACKAGE_VENDOR "the Railwave authors")
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "the Railwave authors <railwave@localhost>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-h5py, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "bash-completion, openmpi-bin, paraview")
include(CPack)
