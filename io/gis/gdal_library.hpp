#pragma once

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

namespace quadloop::io {

// The functions used of GDAL's C interface.
// clang-format moves these lines about each time.
// clang-format off
#define QUADLOOP_FOR_EACH_GDAL_FUNCTION(DO)                                                                 \
  DO(CPLErrorReset)                                                                                         \
  DO(CPLGetLastErrorMsg) DO(CPLGetLastErrorType) DO(CPLPopErrorHandler) DO(CPLPushErrorHandler)             \
      DO(CPLQuietErrorHandler) DO(GDALAllRegister) DO(GDALClose) DO(GDALDatasetGetLayer)                    \
          DO(GDALDatasetGetLayerCount) DO(GDALOpenEx) DO(OGR_F_Destroy) DO(OGR_F_GetFID)                    \
              DO(OGR_F_GetFieldAsString) DO(OGR_F_GetFieldIndex) DO(OGR_F_GetGeometryRef)                   \
                  DO(OGR_F_IsFieldSetAndNotNull) DO(OGR_G_Clone) DO(OGR_G_DestroyGeometry)                  \
                      DO(OGR_G_GetGeometryCount) DO(OGR_G_GetGeometryRef) DO(OGR_G_GetGeometryType)         \
                          DO(OGR_G_GetLinearGeometry) DO(OGR_G_GetPointCount) DO(OGR_G_GetX) DO(OGR_G_GetY) \
                              DO(OGR_G_HasCurveGeometry) DO(OGR_GT_Flatten) DO(OGR_GT_IsSubClassOf)         \
                                  DO(OGR_L_GetName) DO(OGR_L_GetNextFeature) DO(OGR_L_GetSpatialRef)        \
                                      DO(OSRGetLinearUnits) DO(OSRIsGeographic)
// clang-format on

/// GDAL, loaded on first use: with its dependencies this takes longer than the rest of the program, and few
/// runs read maps. Its members are the functions of the same names.
class GdalLibrary {
 public:
  /// Throws InputError if GDAL is not installed, or not the version used at build time.
  static const GdalLibrary& instance();

#define QUADLOOP_DECLARE(function) decltype(&::function) function = nullptr;
  QUADLOOP_FOR_EACH_GDAL_FUNCTION(QUADLOOP_DECLARE)
#undef QUADLOOP_DECLARE

 private:
  GdalLibrary();
};

}  // namespace quadloop::io
