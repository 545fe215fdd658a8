/* TIFF compressed by zlib, by libtiff. */
#include <stdio.h>
#include <stdlib.h>

#include <tiffio.h>

#include "plugins/raster/write.h"

#define LARGE ((uint64_t)3 << 30) /* bytes from which on offsets need 64 bits */

typedef struct writing {
  cs_write_target *target;
  TIFF *tiff;
  size_t row;
  uint32_t done; /* rows */
} writing;

static tmsize_t refuse_bytes(thandle_t handle, void *out, tmsize_t size) {
  return (void)handle, (void)out, (void)size, 0;
}

static tmsize_t put_bytes(thandle_t handle, void *bytes, tmsize_t size) {
  return cs_write_put(((writing *)handle)->target, bytes, (size_t)size) ? size : -1;
}

static toff_t seek(thandle_t handle, toff_t offset, int from) {
  cs_write_target *target = ((writing *)handle)->target;
  uint64_t base = from == SEEK_CUR ? target->at : from == SEEK_END ? target->size : 0;
  return target->at = base + offset;
}

static int close_file(thandle_t handle) { return (void)handle, 0; }

static toff_t size_of(thandle_t handle) { return ((writing *)handle)->target->size; }

static void describe(TIFF *tiff, const cs_picture_output *output) {
  bool is_float = output->depth == CELSPAN_DEPTH_FLOAT;
  uint16_t kind = output->is_straight ? EXTRASAMPLE_UNASSALPHA : EXTRASAMPLE_ASSOCALPHA;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, (uint32_t)output->width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, (uint32_t)output->height);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, output->channels);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE,
               is_float                            ? 32
               : output->depth == CELSPAN_DEPTH_16 ? 16
                                                   : 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
               output->channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 32);
  TIFFSetField(tiff, TIFFTAG_SOFTWARE, output->software);
  if (output->channels % 2 == 0)
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind);
  if (output->title)
    TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, output->title);
}

static void *begin(const cs_picture_output *output, cs_write_target *target) {
  writing *w = calloc(1, sizeof *w);
  if (!w)
    return NULL;
  w->target = target;
  w->row = cs_write_row(output);
  TIFFSetErrorHandler(NULL);
  TIFFSetWarningHandler(NULL);
  w->tiff = TIFFClientOpen("picture", w->row * (uint64_t)output->height < LARGE ? "w" : "w8", w,
                           refuse_bytes, put_bytes, seek, close_file, size_of, NULL, NULL);
  if (w->tiff) {
    describe(w->tiff, output);
    return w;
  }
  free(w);
  return NULL;
}

static bool put_rows(void *self, int32_t count, const unsigned char *rows) {
  writing *w = self;
  for (int32_t i = 0; i < count; i++)
    if (TIFFWriteScanline(w->tiff, (void *)(size_t)(rows + (size_t)i * w->row), w->done++, 0) < 0)
      return false;
  return true;
}

static bool end(void *self) { return TIFFWriteDirectory(((writing *)self)->tiff) == 1; }

static void destroy(void *self) {
  TIFFClose(((writing *)self)->tiff);
  free(self);
}

const cs_write_format cs_write_tiff = {"tiff", begin, put_rows, end, destroy};
