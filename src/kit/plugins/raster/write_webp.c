/* WebP of the best quality with losses, by libwebp, which needs the whole picture. */
#include <stdlib.h>
#include <string.h>

#include <webp/encode.h>

#include "plugins/raster/write.h"

typedef struct writing {
  const cs_picture_output *output;
  cs_write_target *target;
  size_t done; /* bytes of `pixels` */
  unsigned char pixels[];
} writing;

static void *begin(const cs_picture_output *output, cs_write_target *target) {
  writing *w = malloc(sizeof *w + cs_write_row(output) * (size_t)output->height);
  if (w)
    *w = (writing){.output = output, .target = target};
  return w;
}

static bool put_rows(void *self, int32_t count, const unsigned char *rows) {
  writing *w = self;
  size_t size = (size_t)count * cs_write_row(w->output);
  memcpy(w->pixels + w->done, rows, size);
  w->done += size;
  return true;
}

static int put_bytes(const uint8_t *bytes, size_t size, const WebPPicture *picture) {
  return cs_write_put(picture->custom_ptr, bytes, size);
}

/* The same as OpenImageIO does, so that both modules write the same pixels. */
static bool end(void *self) {
  writing *w = self;
  WebPConfig config;
  WebPPicture picture;
  if (!WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, 100) || !WebPPictureInit(&picture))
    return false;
  config.method = 6;
  picture.width = w->output->width;
  picture.height = w->output->height;
  picture.writer = put_bytes;
  picture.custom_ptr = w->target;
  bool is_good = WebPPictureImportRGB(&picture, w->pixels, (int)cs_write_row(w->output)) &&
                 WebPEncode(&config, &picture);
  WebPPictureFree(&picture);
  return is_good;
}

const cs_write_format cs_write_webp = {"webp", begin, put_rows, end, free};
