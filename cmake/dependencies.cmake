# The libraries brume stands on; all are Debian packages, listed with their reasons in ./dev. Each is used by one or two
# rooms, see the LIBRARIES in CMakeLists.txt.
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Imath REQUIRED)
find_package(OpenCL REQUIRED)
find_package(OpenCLHeaders REQUIRED)
find_package(OpenCLHeadersCpp REQUIRED)

find_package(PNG REQUIRED)
find_package(assimp REQUIRED)

# Debian's package names the folder of OpenCV's headers too, of which brume needs none.
find_package(OpenImageIO REQUIRED)
set_target_properties(OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util
                      PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR}")

# OpenVDB installs its find modules beside the other packages' files, where CMake does not look for modules.
find_path(OPENVDB_MODULES FindOpenVDB.cmake
          PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB lib/cmake/OpenVDB lib64/cmake/OpenVDB
          DOC "Folder of FindOpenVDB.cmake")
list(APPEND CMAKE_MODULE_PATH "${OPENVDB_MODULES}")
find_package(OpenVDB REQUIRED)
find_package(Blosc REQUIRED)
find_package(ZLIB REQUIRED)
list(REMOVE_ITEM CMAKE_MODULE_PATH "${OPENVDB_MODULES}")
