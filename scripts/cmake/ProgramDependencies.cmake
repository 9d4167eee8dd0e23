# Libraries that the program needs beside Dependencies.cmake, and its component gis.
find_package(CLI11 REQUIRED)
find_package(GDAL REQUIRED)
