/* WebP with the pictures of a film: of each picture, the patches that have changed.
 *
 *   picture --compared with--> changed patches --box around them--> libwebp --> a frame of the file
 *               shown                             both with and without loss: the smaller one
 *
 * The encoder of animations in libwebp compares each picture with the one before it, and leaves out
 * what differs by a few codes: a slow dissolve changes by less in every picture, and is never
 * shown. Here, a picture is compared with what the file shows.
 *
 * The container: https://developers.google.com/speed/webp/docs/riff_container
 *
 * INVARIANT: before losses of the encoder, no value of a picture differs from what the file shows
 * by more than `tolerance`. A frame is put when it is known how long it is shown, so one is held.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <webp/encode.h>

#include "common/bytes.h"
#include "plugins/moving/moving.h"

enum {
  PATCH = 16,    /* pixels a side, as in libwebp */
  PIXEL = 4,     /* bytes */
  PATIENCE = 15, /* frames for which no coding without loss is tried after one that was larger */
  HEAD = 44,     /* bytes in front of the frames */
  FRAME = 24     /* bytes in front of the pixels of a frame */
};
enum { HAS_ANIMATION = 0x02, HAS_METADATA = 0x04, HAS_ALPHA = 0x10, REPLACES = 0x02 };
#define MOST_BYTES 0xfffffff0u
#define MOST_TIME 0xffffff /* milliseconds of a frame */

/* Pixels from the first to before the last. */
typedef struct box {
  int32_t left, top, right, bottom;
} box;

typedef struct writing {
  cs_moving *moving;
  unsigned char *shown;
  unsigned char *changed; /* one of each patch: 1, or else 0 */
  int32_t across;         /* patches in a row */
  int tolerance;
  WebPMemoryWriter coded; /* the frame that is held; empty: there is none */
  unsigned char flags;    /* flags of that frame */
  box place;
  int64_t began; /* when it is shown first, milliseconds */
  int64_t count; /* pictures */
  int patience;
  uint64_t size; /* bytes that were put */
} writing;

static int32_t least(int32_t a, int32_t b) { return a < b ? a : b; }

static bool is_whole(const writing *w) { return w->moving->output.moving.quality > 100; }

/* ---------------------------------------------------------------- changes */

/* A patch of the picture. */
static box patch_at(const writing *w, int32_t column, int32_t row) {
  const cs_picture_output *output = &w->moving->output;
  return (box){column * PATCH, row * PATCH, least((column + 1) * PATCH, output->width),
               least((row + 1) * PATCH, output->height)};
}

static size_t place_of(const writing *w, int32_t x, int32_t y) {
  return (size_t)y * w->moving->row + (size_t)x * PIXEL;
}

static bool differs(const writing *w, box patch) {
  size_t size = (size_t)(patch.right - patch.left) * PIXEL;
  for (int32_t y = patch.top; y < patch.bottom; y++) {
    const unsigned char *a = w->moving->pixels + place_of(w, patch.left, y),
                        *b = w->shown + place_of(w, patch.left, y);
    for (size_t i = 0; i < size; i++)
      if (abs(a[i] - b[i]) > w->tolerance)
        return true;
  }
  return false;
}

static void copy(const writing *w, box patch, const unsigned char *from, unsigned char *to) {
  for (int32_t y = patch.top; y < patch.bottom; y++) {
    size_t at = place_of(w, patch.left, y);
    memcpy(to + at, from + at, (size_t)(patch.right - patch.left) * PIXEL);
  }
}

static bool is_opaque(const writing *w, box patch) {
  for (int32_t y = patch.top; y < patch.bottom; y++)
    for (int32_t x = patch.left; x < patch.right; x++)
      if (w->moving->pixels[place_of(w, x, y) + 3] != UINT8_MAX)
        return false;
  return true;
}

static void set_alpha(const writing *w, box patch, unsigned char alpha) {
  for (int32_t y = patch.top; y < patch.bottom; y++)
    for (int32_t x = patch.left; x < patch.right; x++)
      w->moving->pixels[place_of(w, x, y) + 3] = alpha;
}

static box joined(box a, box b) {
  if (a.right == 0)
    return b;
  return (box){least(a.left, b.left), least(a.top, b.top), a.right > b.right ? a.right : b.right,
               a.bottom > b.bottom ? a.bottom : b.bottom};
}

/* Marks the patches that are coded. *opaque: whether they all are. Returns the box around them. */
static box mark(writing *w, bool has_all, bool *opaque) {
  box around = {0};
  *opaque = true;
  for (int32_t row = 0; row * PATCH < w->moving->output.height; row++)
    for (int32_t column = 0; column < w->across; column++) {
      box patch = patch_at(w, column, row);
      bool is_changed = has_all || differs(w, patch);
      w->changed[(size_t)row * (size_t)w->across + (size_t)column] = is_changed;
      if (!is_changed)
        continue;
      *opaque = *opaque && is_opaque(w, patch);
      around = joined(around, patch);
      copy(w, patch, w->moving->pixels, w->shown);
    }
  return around;
}

/* Patches in the box that are not coded: clear, so that the pixels below remain, or as they are
 * shown where the box replaces everything. */
static void fill(const writing *w, box around, bool is_clear) {
  for (int32_t row = around.top / PATCH; row * PATCH < around.bottom; row++)
    for (int32_t column = around.left / PATCH; column * PATCH < around.right; column++)
      if (!w->changed[(size_t)row * (size_t)w->across + (size_t)column]) {
        if (is_clear)
          set_alpha(w, patch_at(w, column, row), 0);
        else
          copy(w, patch_at(w, column, row), w->shown, w->moving->pixels);
      }
}

/* ---------------------------------------------------------------- coding */

static bool configure(const writing *w, bool is_lossless, WebPConfig *config) {
  int32_t quality = least(w->moving->output.moving.quality, 100);
  if (!WebPConfigPreset(config, WEBP_PRESET_DEFAULT, is_lossless ? 75 : (float)quality))
    return false;
  config->lossless = is_lossless;
  config->method = is_lossless && !is_whole(w) ? 1 : 4;
  config->use_sharp_yuv = 1;
  config->exact =
      !is_lossless; /* a clear patch beside others keeps its colours, or shows in them */
  return true;
}

static celspan_status judge(const writing *w, WebPEncodingError error,
                            cs_picture_failure *failure) {
  char text[80];
  if (error == VP8_ENC_ERROR_OUT_OF_MEMORY || error == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY)
    return cs_moving_fail(w->moving, failure, CELSPAN_NO_MEMORY, "out of memory");
  snprintf(text, sizeof text, "cannot be written as WebP: error %d of libwebp", (int)error);
  return cs_moving_fail(w->moving, failure, CELSPAN_OUTPUT, text);
}

/* *out must be cleared, whatever this returns. */
static celspan_status encode(const writing *w, box place, bool is_lossless, WebPMemoryWriter *out,
                             cs_picture_failure *failure) {
  WebPConfig config;
  WebPPicture picture;
  WebPMemoryWriterInit(out);
  if (!configure(w, is_lossless, &config) || !WebPPictureInit(&picture))
    return judge(w, VP8_ENC_ERROR_INVALID_CONFIGURATION, failure);
  picture.use_argb = 1;
  picture.width = place.right - place.left;
  picture.height = place.bottom - place.top;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = out;
  bool is_good =
      WebPPictureImportRGBA(&picture, w->moving->pixels + place_of(w, place.left, place.top),
                            (int)w->moving->row) &&
      WebPEncode(&config, &picture);
  WebPEncodingError error = picture.error_code;
  WebPPictureFree(&picture);
  return is_good ? CELSPAN_OK : judge(w, error, failure);
}

/* Codes without loss, and takes that instead if it is smaller. */
static celspan_status improve(writing *w, cs_picture_failure *failure) {
  WebPMemoryWriter other;
  celspan_status status = encode(w, w->place, true, &other, failure);
  if (status == CELSPAN_OK && other.size <= w->coded.size) {
    WebPMemoryWriter larger = w->coded;
    w->coded = other;
    other = larger;
  } else
    w->patience = PATIENCE;
  WebPMemoryWriterClear(&other);
  return status;
}

static celspan_status code(writing *w, cs_picture_failure *failure) {
  celspan_status status = encode(w, w->place, is_whole(w), &w->coded, failure);
  if (status != CELSPAN_OK || is_whole(w))
    return status;
  if (w->patience > 0) {
    w->patience--;
    return CELSPAN_OK;
  }
  return improve(w, failure);
}

/* ---------------------------------------------------------------- the file */

static celspan_status append(writing *w, const void *bytes, size_t size,
                             cs_picture_failure *failure) {
  if (size > MOST_BYTES - w->size)
    return cs_moving_fail(w->moving, failure, CELSPAN_LIMIT,
                          "a WebP has at most 4 GiB: give a smaller --size or a lower --quality");
  w->size += size;
  return cs_moving_put(w->moving, w->size - size, bytes, size, failure);
}

/* Puts the frame that is held, which is shown until a time. */
static celspan_status flush(writing *w, int64_t until, cs_picture_failure *failure) {
  if (!w->coded.mem)
    return CELSPAN_OK;
  bool is_extended =
      memcmp(w->coded.mem + 12, "VP8X", 4) == 0; /* a header that frames do not have */
  size_t skipped = is_extended ? 30 : 12, size = w->coded.size - skipped;
  int64_t time = until - w->began < MOST_TIME ? until - w->began : MOST_TIME;
  unsigned char head[FRAME] = "ANMF";
  cs_bytes_put_little(head + 4, (uint32_t)(size + FRAME - 8), 4);
  cs_bytes_put_little(head + 8, (uint32_t)w->place.left / 2, 3);
  cs_bytes_put_little(head + 11, (uint32_t)w->place.top / 2, 3);
  cs_bytes_put_little(head + 14, (uint32_t)(w->place.right - w->place.left - 1), 3);
  cs_bytes_put_little(head + 17, (uint32_t)(w->place.bottom - w->place.top - 1), 3);
  cs_bytes_put_little(head + 20, (uint32_t)time, 3);
  head[23] = w->flags;
  celspan_status status = append(w, head, FRAME, failure);
  if (status == CELSPAN_OK)
    status = append(w, w->coded.mem + skipped, size, failure);
  WebPMemoryWriterClear(&w->coded);
  return status;
}

/* When a picture is shown first. */
static int64_t time_of(const writing *w, int64_t picture) {
  double rate = w->moving->output.frames_second;
  return (int64_t)((double)picture * 1000 / (rate > 0 ? rate : 1) + 0.5);
}

static celspan_status take(cs_moving *moving, cs_picture_failure *failure) {
  writing *w = moving->self;
  const cs_picture_output *output = &moving->output;
  bool are_opaque; /* the blocks that are coded */
  if (output->moving.is_opaque)
    set_alpha(w, (box){0, 0, output->width, output->height}, UINT8_MAX);
  int64_t now = time_of(w, w->count++), next = time_of(w, w->count);
  box around = mark(w, !w->coded.mem || next - w->began > MOST_TIME, &are_opaque);
  if (around.right == 0)
    return CELSPAN_OK;
  celspan_status status = flush(w, now, failure);
  if (status != CELSPAN_OK)
    return status;
  fill(w, around, are_opaque);
  w->place = around;
  w->began = now;
  w->flags = are_opaque ? 0 : REPLACES;
  return code(w, failure);
}

static celspan_status put_metadata(writing *w, cs_picture_failure *failure) {
  const char *text = w->moving->metadata;
  size_t size = strlen(text);
  unsigned char head[8] = "XMP ";
  cs_bytes_put_little(head + 4, (uint32_t)size, 4);
  celspan_status status = append(w, head, sizeof head, failure);
  if (status == CELSPAN_OK)
    status = append(w, text, size + size % 2, failure); /* with its 0 where a byte must follow */
  return status;
}

/* A file may have clear pixels in its frames, and does where patches remain. */
static celspan_status put_head(const writing *w, cs_picture_failure *failure) {
  const cs_picture_output *output = &w->moving->output;
  int32_t plays = output->moving.plays;
  unsigned char head[HEAD] = "RIFF....WEBPVP8X";
  cs_bytes_put_little(head + 4, (uint32_t)w->size - 8, 4);
  cs_bytes_put_little(head + 16, 10, 4);
  head[20] = HAS_ANIMATION | HAS_METADATA | HAS_ALPHA;
  cs_bytes_put_little(head + 24, (uint32_t)output->width - 1, 3);
  cs_bytes_put_little(head + 27, (uint32_t)output->height - 1, 3);
  memcpy(head + 30, "ANIM", 4);
  cs_bytes_put_little(head + 34, 6, 4);
  cs_bytes_put_little(head + 42, (uint32_t)least(plays, UINT16_MAX), 2);
  return cs_moving_put(w->moving, 0, head, HEAD, failure);
}

static celspan_status end(cs_moving *moving, cs_picture_failure *failure) {
  writing *w = moving->self;
  if (!w->coded.mem)
    return cs_moving_fail(moving, failure, CELSPAN_BAD_ARGUMENT, "it has no picture");
  celspan_status status = flush(w, time_of(w, w->count), failure);
  if (status == CELSPAN_OK)
    status = put_metadata(w, failure);
  return status == CELSPAN_OK ? put_head(w, failure) : status;
}

/* ---------------------------------------------------------------- opening */

static void destroy(void *self) {
  writing *w = self;
  WebPMemoryWriterClear(&w->coded);
  free(w->changed);
  free(w->shown);
  free(w);
}

static celspan_status open(cs_moving *moving, cs_picture_failure *failure) {
  const unsigned char head[HEAD] = {0}; /* until it is known */
  const cs_picture_output *output = &moving->output;
  int32_t rows = (output->height + PATCH - 1) / PATCH, quality = output->moving.quality;
  writing *w = moving->self = calloc(1, sizeof *w);
  if (w) {
    w->moving = moving;
    w->across = (output->width + PATCH - 1) / PATCH;
    w->tolerance = quality > 100 ? 0 : 1 + (100 - quality) / 10;
    w->shown = malloc(moving->row * (size_t)output->height);
    w->changed = malloc((size_t)w->across * (size_t)rows);
  }
  if (!w || !w->shown || !w->changed)
    return cs_moving_fail(moving, failure, CELSPAN_NO_MEMORY, "out of memory");
  return append(w, head, HEAD, failure);
}

const cs_moving_format cs_moving_webp = {CS_PICTURE_WEBP, open, take, end, destroy};
