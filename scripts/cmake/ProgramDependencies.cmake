# Libraries that the program needs beside Dependencies.cmake, and its component gis.
find_package(CLI11 REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
find_package(GDAL REQUIRED)
