/* WebP, by libwebp. */
#include <webp/decode.h>

#include "plugins/raster/raster.h"

celspan_status cs_raster_webp(const cs_raster_file *file, cs_raster *out,
                              cs_picture_failure *failure) {
  WebPBitstreamFeatures found;
  if (WebPGetFeatures(file->bytes, file->size, &found) != VP8_STATUS_OK)
    return cs_raster_fail(failure, CELSPAN_INPUT, "is corrupt or truncated");
  if (found.has_animation)
    return cs_raster_fail(failure, CELSPAN_INPUT, "is an animation, which is not read");
  out->colour = "srgb";
  out->channels = found.has_alpha ? 4 : 3;
  out->bits = 8;
  celspan_status status =
      cs_raster_make(out, (uint64_t)found.width, (uint64_t)found.height, failure);
  if (status != CELSPAN_OK)
    return status;
  size_t row = cs_raster_row(out), size = row * (size_t)out->height;
  const unsigned char *done =
      found.has_alpha ? WebPDecodeRGBAInto(file->bytes, file->size, out->pixels, size, (int)row)
                      : WebPDecodeRGBInto(file->bytes, file->size, out->pixels, size, (int)row);
  return done ? CELSPAN_OK : cs_raster_fail(failure, CELSPAN_INPUT, "is corrupt or truncated");
}
