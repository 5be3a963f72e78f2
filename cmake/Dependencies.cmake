find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Qhull CONFIG REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(fmt 8 REQUIRED)

# The prefix that `make` fills from PyPI.
set(SWITCHYARD_PYPI ${PROJECT_SOURCE_DIR}/build/pypi CACHE PATH "Prefix of the PyPI packages")
