find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Qhull CONFIG REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(fmt 8 REQUIRED)

# The prefixes that `make` fills from PyPI.
set(SWITCHYARD_PYPI ${PROJECT_SOURCE_DIR}/build/pypi CACHE PATH "Prefix of the PyPI packages")
set(SWITCHYARD_PINOCCHIO ${PROJECT_SOURCE_DIR}/build/pinocchio/cmeel.prefix CACHE PATH
    "Prefix of Pinocchio and its libraries")
set(SWITCHYARD_ROBOTS ${SWITCHYARD_PINOCCHIO}/share CACHE PATH
    "Folder of example-robot-data, robots for examples and tests")
