/* AVIF: a picture, or the pictures of a film.
 *
 *   picture --waits until it is known whether another one follows--> Y'CbCr 4:4:4 --libavif--> kept
 *
 * INVARIANT: bytes are put at the end, after libavif has read their head back.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <avif/avif.h>

#include "common/bytes.h"
#include "plugins/moving/moving.h"
#include "writers/exr/rate.h"

#define SPEED 6         /* from 0 to 10: slower ones make files a few per cent smaller */
#define LEAST_THREADS 2 /* one alone makes other bytes */
#define DEEP_BITS 12    /* where rows have 16, the file has the most that AVIF has */

typedef struct writing {
  cs_moving *moving;
  cs_picture_moving wanted; /* with tags */
  avifEncoder *encoder;
  unsigned char *waiting; /* the last whole picture, which is not encoded yet */
  int32_t time[2];        /* units in a second, and of a picture */
  bool has_waiting;       /* or there is none yet */
  bool has_several;       /* pictures */
} writing;

static celspan_status fail(const writing *avif, cs_picture_failure *failure, celspan_status status,
                           const char *what) {
  return cs_moving_fail(avif->moving, failure, status, what);
}

/* What a function of libavif returned, as a status. */
static celspan_status judge(const writing *avif, avifResult result, cs_picture_failure *failure) {
  char text[160];
  if (result == AVIF_RESULT_OK)
    return CELSPAN_OK;
  if (result == AVIF_RESULT_OUT_OF_MEMORY)
    return fail(avif, failure, CELSPAN_NO_MEMORY, "out of memory");
  snprintf(text, sizeof text, "cannot be written as AVIF: %s", avifResultToString(result));
  return fail(avif, failure, CELSPAN_OUTPUT, text);
}

/* ---------------------------------------------------------------- the picture */

static bool is_deep(const writing *avif) { return avif->moving->output.depth == CELSPAN_DEPTH_16; }

/* The numbers of ITU-T H.273 for a colour, where the output has none. */
static void resolve_tags(const char *colour, cs_picture_moving *wanted) {
  int curve = strcmp(colour, "rec709") == 0   ? AVIF_TRANSFER_CHARACTERISTICS_BT709
              : strcmp(colour, "linear") == 0 ? AVIF_TRANSFER_CHARACTERISTICS_LINEAR
                                              : AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  if (!wanted->primaries)
    wanted->primaries = AVIF_COLOR_PRIMARIES_BT709;
  if (!wanted->transfer)
    wanted->transfer = curve;
}

/* A still picture without loss has planes of R'G'B'. Films have the range of videos: Chromium shows
 * them so, whatever their tags say. */
static void tag(const writing *avif, bool is_lossless, avifImage *image) {
  image->colorPrimaries = (avifColorPrimaries)avif->wanted.primaries;
  image->transferCharacteristics = (avifTransferCharacteristics)avif->wanted.transfer;
  image->matrixCoefficients =
      is_lossless ? AVIF_MATRIX_COEFFICIENTS_IDENTITY : AVIF_MATRIX_COEFFICIENTS_BT709;
  image->yuvRange = avif->has_several ? AVIF_RANGE_LIMITED : AVIF_RANGE_FULL;
  image->alphaPremultiplied = !avif->moving->output.is_straight;
}

/* Whether alpha is 1 in all pixels, so that a file without alpha says the same. */
static bool is_opaque(const writing *avif) {
  size_t values = 4 * (size_t)avif->moving->output.width * (size_t)avif->moving->output.height;
  const uint16_t *deep = (const void *)avif->waiting;
  bool is_so = true;
  for (size_t i = 3; i < values && is_so; i += 4)
    is_so = is_deep(avif) ? deep[i] == UINT16_MAX : avif->waiting[i] == UINT8_MAX;
  return is_so;
}

/* The conversion is libavif's own, because libyuv's depends on the processor. A film whose first
 * picture is opaque may have alpha later. */
static avifResult convert(const writing *avif, avifImage *image) {
  avifRGBImage rgb;
  avifRGBImageSetDefaults(&rgb, image);
  rgb.depth = is_deep(avif) ? 16 : 8;
  rgb.format = AVIF_RGB_FORMAT_RGBA;
  rgb.avoidLibYUV = AVIF_TRUE;
  rgb.ignoreAlpha = avif->wanted.is_opaque || (!avif->has_several && is_opaque(avif));
  rgb.alphaPremultiplied = image->alphaPremultiplied;
  rgb.pixels = avif->waiting;
  rgb.rowBytes = (uint32_t)avif->moving->row;
  return avifImageRGBToYUV(image, &rgb);
}

/* ---------------------------------------------------------------- encoding */

static celspan_status add(const writing *avif, avifImage *image, cs_picture_failure *failure) {
  bool is_lossless = avif->wanted.quality == 0 && !avif->has_several;
  avifAddImageFlags flags =
      avif->has_several ? AVIF_ADD_IMAGE_FLAG_NONE : AVIF_ADD_IMAGE_FLAG_SINGLE;
  tag(avif, is_lossless, image);
  if (is_lossless)
    avif->encoder->maxQuantizer = 0;
  celspan_status status = judge(avif, convert(avif, image), failure);
  if (status != CELSPAN_OK)
    return status;
  return judge(avif, avifEncoderAddImage(avif->encoder, image, (uint64_t)avif->time[1], flags),
               failure);
}

/* Encodes the picture that waits. Only the last one can be the only one. */
static celspan_status encode(writing *avif, bool is_last, cs_picture_failure *failure) {
  const cs_picture_output *output = &avif->moving->output;
  avif->has_several = avif->has_several || !is_last;
  avifImage *image = avifImageCreate((uint32_t)output->width, (uint32_t)output->height,
                                     is_deep(avif) ? DEEP_BITS : 8, AVIF_PIXEL_FORMAT_YUV444);
  if (!image)
    return fail(avif, failure, CELSPAN_NO_MEMORY, "out of memory");
  const char *metadata = avif->moving->metadata;
  avifRWDataSet(&image->xmp, (const uint8_t *)metadata, strlen(metadata));
  celspan_status status = image->xmp.size > 0
                              ? add(avif, image, failure)
                              : fail(avif, failure, CELSPAN_NO_MEMORY, "out of memory");
  avifImageDestroy(image);
  return status;
}

static celspan_status take(cs_moving *moving, cs_picture_failure *failure) {
  writing *avif = moving->self;
  celspan_status status = avif->has_waiting ? encode(avif, false, failure) : CELSPAN_OK;
  unsigned char *spare = avif->waiting;
  avif->waiting = moving->pixels;
  moving->pixels = spare;
  avif->has_waiting = true;
  return status;
}

/* ---------------------------------------------------------------- times */

static bool is_one_of(const unsigned char *type, const char *types) {
  for (; *types; types += 4)
    if (memcmp(type, types, 4) == 0)
      return true;
  return false;
}

/* Clears when the file was made and changed, so that equal films have equal bytes. A box of ISO/IEC
 * 14496-12 is its size in 4 bytes, its type in 4, and contents, in these boxes a version and flags
 * in 4 bytes, then both times, each in 4 bytes, or in 8 where the version is 1. */
static void clear_times(unsigned char *bytes, size_t size) {
  for (size_t at = 0; size - at >= 8;) {
    unsigned char *box = bytes + at;
    size_t whole = cs_bytes_big32(box);
    if (whole < 8 || whole > size - at)
      return; /* the media, of 4 GB or more, come after these boxes */
    if (is_one_of(box + 4, "moovtrakmdia"))
      clear_times(box + 8, whole - 8);
    else if (is_one_of(box + 4, "mvhdtkhdmdhd") && whole >= 28)
      memset(box + 12, 0, box[8] == 1 ? 16 : 8);
    at += whole;
  }
}

/* ---------------------------------------------------------------- the file */

/* Reads back how many pictures the file has, and of which size. */
static bool is_readable(const writing *avif, const avifRWData *made) {
  avifDecoder *decoder = avifDecoderCreate();
  if (!decoder)
    return false;
  decoder->imageDimensionLimit = 0;
  bool is_good = avifDecoderSetIOMemory(decoder, made->data, made->size) == AVIF_RESULT_OK &&
                 avifDecoderParse(decoder) == AVIF_RESULT_OK &&
                 decoder->image->width == (uint32_t)avif->moving->output.width &&
                 decoder->image->height == (uint32_t)avif->moving->output.height &&
                 (decoder->imageCount > 1) == avif->has_several;
  avifDecoderDestroy(decoder);
  return is_good;
}

static celspan_status put(const writing *avif, const avifRWData *made,
                          cs_picture_failure *failure) {
  clear_times(made->data, made->size);
  if (!is_readable(avif, made))
    return fail(avif, failure, CELSPAN_OUTPUT,
                "what was written as AVIF cannot be read back, so it is not kept");
  return cs_moving_put(avif->moving, 0, made->data, made->size, failure);
}

static celspan_status complete(writing *avif, avifRWData *made, cs_picture_failure *failure) {
  if (!avif->has_waiting)
    return fail(avif, failure, CELSPAN_BAD_ARGUMENT, "it has no picture");
  celspan_status status = encode(avif, true, failure);
  if (status == CELSPAN_OK)
    status = judge(avif, avifEncoderFinish(avif->encoder, made), failure);
  return status == CELSPAN_OK ? put(avif, made, failure) : status;
}

static celspan_status end(cs_moving *moving, cs_picture_failure *failure) {
  avifRWData made = AVIF_DATA_EMPTY;
  celspan_status status = complete(moving->self, &made, failure);
  avifRWDataFree(&made);
  return status;
}

static void destroy(void *self) {
  writing *avif = self;
  if (avif->encoder)
    avifEncoderDestroy(avif->encoder);
  free(avif->waiting);
  free(avif);
}

/* ---------------------------------------------------------------- opening */

/* How often a film is played is kept since libavif 1.0. */
static celspan_status set_plays(const writing *avif, cs_picture_failure *failure) {
  int32_t plays = avif->wanted.plays;
#if AVIF_VERSION >= 1000000
  (void)failure;
  avif->encoder->repetitionCount = plays > 0 ? plays - 1 : AVIF_REPETITION_COUNT_INFINITE;
#else
  if (plays > 0)
    return fail(avif, failure, CELSPAN_BAD_ARGUMENT,
                "the libavif of this celspan is older than 1.0 and cannot say how often a film is "
                "played: leave --loop out, which plays it for ever, or write .webp");
#endif
  return CELSPAN_OK;
}

/* Alpha is kept without loss, as libavif before 1.0 does by default: edges need few bytes and show
 * errors. */
static celspan_status set_encoder(const writing *avif, cs_picture_failure *failure) {
  char crf[12];
  const cs_picture_moving *wanted = &avif->wanted;
  avifEncoder *encoder = avif->encoder;
  encoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
  encoder->maxThreads = wanted->threads < LEAST_THREADS ? LEAST_THREADS : wanted->threads;
  encoder->speed = SPEED;
  encoder->timescale = (uint64_t)avif->time[0];
  encoder->minQuantizer = 0;
  encoder->maxQuantizer = AVIF_QUANTIZER_WORST_QUALITY;
#if AVIF_VERSION >= 1000000
  encoder->qualityAlpha = AVIF_QUALITY_LOSSLESS;
#endif
  snprintf(crf, sizeof crf, "%d", (int)wanted->quality);
  avifEncoderSetCodecSpecificOption(encoder, "color:end-usage", "q");
  avifEncoderSetCodecSpecificOption(encoder, "color:cq-level", crf);
  return set_plays(avif, failure);
}

static celspan_status open(cs_moving *moving, cs_picture_failure *failure) {
  const cs_picture_output *output = &moving->output;
  writing *avif = moving->self = calloc(1, sizeof *avif);
  if (!avif)
    return cs_moving_fail(moving, failure, CELSPAN_NO_MEMORY, "out of memory");
  avif->moving = moving;
  avif->wanted = output->moving;
  resolve_tags(output->colour, &avif->wanted);
  avif->waiting = malloc(moving->row * (size_t)output->height);
  avif->encoder = avifEncoderCreate();
  if (!avif->waiting || !avif->encoder)
    return fail(avif, failure, CELSPAN_NO_MEMORY, "out of memory");
  if (!cs_rate_fraction(output->frames_second, avif->time))
    avif->time[0] = avif->time[1] = 1;
  return set_encoder(avif, failure);
}

const cs_moving_format cs_moving_avif = {CS_PICTURE_AVIF, open, take, end, destroy};
