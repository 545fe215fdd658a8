/* TIFF, by libtiff: rows and tiles of grey and colours in 8, 16 or 32 bits as they are stored; all
 * other forms as libtiff converts them, in 8 bits. Source: TIFF 6.0. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <tiffio.h>

#include "common/profile_name.h"
#include "plugins/raster/raster.h"

typedef struct reading {
  const cs_raster_file *file;
  toff_t at;
  TIFF *tiff;
  cs_raster *out;
  cs_picture_failure *failure;
} reading;

/* ---------------------------------------------------------------- the file in memory */

static tmsize_t read_bytes(thandle_t handle, void *out, tmsize_t size) {
  reading *r = handle;
  toff_t left = r->at < r->file->size ? r->file->size - r->at : 0;
  tmsize_t got = (toff_t)size < left ? size : (tmsize_t)left;
  memcpy(out, r->file->bytes + (got ? r->at : 0), (size_t)got);
  r->at += (toff_t)got;
  return got;
}

static tmsize_t refuse_bytes(thandle_t handle, void *bytes, tmsize_t size) {
  (void)handle, (void)bytes, (void)size;
  return -1;
}

static toff_t seek(thandle_t handle, toff_t offset, int from) {
  reading *r = handle;
  toff_t base = from == SEEK_CUR ? r->at : from == SEEK_END ? r->file->size : 0;
  return r->at = base + offset;
}

static int close_file(thandle_t handle) { return (void)handle, 0; }

static toff_t size_of(thandle_t handle) { return ((reading *)handle)->file->size; }

/* ---------------------------------------------------------------- its form */

static uint16_t field(const reading *r, uint32_t tag) {
  uint16_t value = 0;
  TIFFGetFieldDefaulted(r->tiff, tag, &value);
  return value;
}

/* The kind of the channel after grey or colours; 0: there is none. */
static uint16_t extra_kind(const reading *r) {
  uint16_t count = 0, *kinds = NULL;
  TIFFGetFieldDefaulted(r->tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds);
  return count == 1 && kinds ? kinds[0] : 0;
}

static double dpi_of(const reading *r) {
  float across = 0;
  uint16_t unit = field(r, TIFFTAG_RESOLUTIONUNIT);
  double inch = unit == RESUNIT_INCH ? 1 : unit == RESUNIT_CENTIMETER ? 2.54 : 0;
  return TIFFGetField(r->tiff, TIFFTAG_XRESOLUTION, &across) ? inch * (double)across : 0;
}

/* Whether rows can be read as they are stored; if so, sets the form. */
static bool choose_form(reading *r) {
  uint16_t kind = field(r, TIFFTAG_SAMPLEFORMAT), photometric = field(r, TIFFTAG_PHOTOMETRIC);
  uint16_t channels = field(r, TIFFTAG_SAMPLESPERPIXEL), bits = field(r, TIFFTAG_BITSPERSAMPLE);
  bool is_float = kind == SAMPLEFORMAT_IEEEFP && bits == 32;
  bool is_whole = kind == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16);
  int colours = photometric == PHOTOMETRIC_RGB ? 3 : photometric == PHOTOMETRIC_MINISBLACK ? 1 : 0;
  bool is_plain = colours && (channels == colours || channels == colours + 1) &&
                  (is_float || is_whole) && field(r, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG;
  r->out->orientation = field(r, TIFFTAG_ORIENTATION);
  r->out->dpi = dpi_of(r);
  r->out->colour = is_plain && is_float ? "linear" : "srgb";
  r->out->channels = is_plain ? channels : 4;
  r->out->bits = is_plain ? bits : 8;
  r->out->is_multiplied = !is_plain || extra_kind(r) == EXTRASAMPLE_ASSOCALPHA;
  return is_plain;
}

/* ---------------------------------------------------------------- pixels */

static celspan_status fail_pixels(const reading *r) {
  return cs_raster_fail(r->failure, CELSPAN_INPUT, "is corrupt or truncated");
}

static unsigned char *row_at(const reading *r, uint32_t y) {
  return (unsigned char *)r->out->pixels + (size_t)y * cs_raster_row(r->out);
}

static celspan_status read_rows(const reading *r) {
  if ((size_t)TIFFScanlineSize64(r->tiff) != cs_raster_row(r->out))
    return fail_pixels(r);
  for (uint32_t y = 0; y < (uint32_t)r->out->height; y++)
    if (TIFFReadScanline(r->tiff, row_at(r, y), y, 0) < 0)
      return fail_pixels(r);
  return CELSPAN_OK;
}

/* Copies the part of a tile that is inside of the picture. */
static void put_tile(const reading *r, const unsigned char *tile, uint32_t x, uint32_t y,
                     const uint32_t side[2]) {
  size_t pixel = cs_raster_row(r->out) / (size_t)r->out->width;
  uint32_t width = (uint32_t)r->out->width - x, height = (uint32_t)r->out->height - y;
  width = width < side[0] ? width : side[0];
  height = height < side[1] ? height : side[1];
  for (uint32_t row = 0; row < height; row++)
    memcpy(row_at(r, y + row) + x * pixel, tile + (size_t)row * side[0] * pixel, width * pixel);
}

static celspan_status read_tiles(const reading *r) {
  uint32_t side[2] = {0, 0};
  TIFFGetField(r->tiff, TIFFTAG_TILEWIDTH, &side[0]);
  TIFFGetField(r->tiff, TIFFTAG_TILELENGTH, &side[1]);
  size_t pixel = cs_raster_row(r->out) / (size_t)r->out->width;
  tmsize_t size = TIFFTileSize(r->tiff);
  if (size <= 0 || !side[0] || !side[1] || (uint64_t)size != (uint64_t)side[0] * side[1] * pixel)
    return fail_pixels(r);
  unsigned char *tile = malloc((size_t)size);
  bool is_good = tile != NULL;
  for (uint32_t y = 0; is_good && y < (uint32_t)r->out->height; y += side[1])
    for (uint32_t x = 0; is_good && x < (uint32_t)r->out->width; x += side[0]) {
      is_good = TIFFReadTile(r->tiff, tile, x, y, 0, 0) >= 0;
      if (is_good)
        put_tile(r, tile, x, y, side);
    }
  celspan_status status = is_good ? CELSPAN_OK
                          : tile  ? fail_pixels(r)
                                  : cs_raster_fail(r->failure, CELSPAN_NO_MEMORY, "out of memory");
  free(tile);
  return status;
}

/* Rows are requested in their stored order, because libtiff can only flip pictures. */
static celspan_status read_shown(const reading *r) {
  char text[1024] = "";
  if (!TIFFRGBAImageOK(r->tiff, text))
    return cs_raster_fail(r->failure, CELSPAN_INPUT, "is of a kind that needs OpenImageIO: %s",
                          text);
  return TIFFReadRGBAImageOriented(r->tiff, (uint32_t)r->out->width, (uint32_t)r->out->height,
                                   r->out->pixels, r->out->orientation, 1)
             ? CELSPAN_OK
             : fail_pixels(r);
}

static void read_profile(const reading *r) {
  uint32_t size = 0;
  void *bytes = NULL;
  if (TIFFGetField(r->tiff, TIFFTAG_ICCPROFILE, &size, &bytes) && bytes)
    cs_profile_name_read(bytes, size, r->out->profile);
}

static celspan_status read_opened(reading *r) {
  uint32_t width = 0, height = 0;
  if (r->file->subimage && !TIFFSetDirectory(r->tiff, (tdir_t)r->file->subimage))
    return cs_raster_fail(r->failure, CELSPAN_INPUT, "has no subimage %d", r->file->subimage);
  TIFFGetField(r->tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(r->tiff, TIFFTAG_IMAGELENGTH, &height);
  read_profile(r);
  bool is_plain = choose_form(r);
  celspan_status status = cs_raster_make(r->out, width, height, r->failure);
  if (status != CELSPAN_OK)
    return status;
  return !is_plain ? read_shown(r) : TIFFIsTiled(r->tiff) ? read_tiles(r) : read_rows(r);
}

celspan_status cs_raster_tiff(const cs_raster_file *file, cs_raster *out,
                              cs_picture_failure *failure) {
  reading r = {.file = file, .out = out, .failure = failure};
  TIFFSetErrorHandler(NULL);
  TIFFSetWarningHandler(NULL);
  r.tiff = TIFFClientOpen("picture", "rm", &r, read_bytes, refuse_bytes, seek, close_file, size_of,
                          NULL, NULL);
  if (!r.tiff)
    return fail_pixels(&r);
  celspan_status status = read_opened(&r);
  TIFFClose(r.tiff);
  return status;
}
