#include "readers/text/font_file.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <unistd.h>

#include "base/error_text.h"
#include "base/open.h"
#include "base/tried.h"
#include "readers/xml/type.h"

/* ---------------------------------------------------------------- reading */

/* Whether a text may be the name of an installed font. */
static bool is_family(const char *file) {
  const char *slash = strrchr(file, '/');
  return !strchr(slash ? slash : file, '.');
}

static celspan_status fail_missing(celspan_context *context, const char *file, int error) {
  const char *tried = cs_tried_find(context, file);
  char text[CS_ERROR_TEXT_SIZE];
  return cs_fail(context, CELSPAN_INPUT, "%s: %s%s%s%s", file, cs_error_text(error, text),
                 tried ? "; also looked for at " : "", tried ? tried : "",
                 is_family(file) ? "; a font is given by its file, such as \"arial.ttf\" "
                                   "beside the script, or one of the system's with "
                                   "--allow-system-fonts"
                                 : "");
}

celspan_status cs_font_file_stat(celspan_context *context, const char *file, struct stat *out) {
  if (stat(file, out) != 0)
    return fail_missing(context, file, errno);
  if (!S_ISREG(out->st_mode))
    return cs_fail(context, CELSPAN_INPUT, "%s: is not a file; a font must be one", file);
  if (out->st_size > (off_t)CS_FONT_FILE_BYTES)
    return cs_fail(context, CELSPAN_LIMIT, "%s: the font has %lld bytes; the limit is %zu", file,
                   (long long)out->st_size, CS_FONT_FILE_BYTES);
  return CELSPAN_OK;
}

/* Reads until `size` bytes are there; 0, or an errno: ENODATA when the file ends before. */
static int read_all(int descriptor, uint8_t *bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    ssize_t got = read(descriptor, bytes + done, size - done);
    if (got == 0)
      return ENODATA;
    if (got < 0 && errno != EINTR)
      return errno;
    done += got > 0 ? (size_t)got : 0;
  }
  return 0;
}

static int read_file(const char *file, uint8_t *bytes, size_t size) {
  int descriptor = cs_open_to_read(file);
  if (descriptor < 0)
    return errno;
  int error = read_all(descriptor, bytes, size);
  close(descriptor);
  return error;
}

celspan_status cs_font_file_read(celspan_context *context, const char *file, size_t size,
                                 uint8_t **bytes) {
  char text[CS_ERROR_TEXT_SIZE];
  uint8_t *made = cs_mem_array(context->memory, size, 1);
  if (!made && size > 0)
    return cs_fail_memory(context);
  int error = read_file(file, made, size);
  if (error) {
    cs_mem_free(context->memory, made, size);
    return cs_fail(context, CELSPAN_INPUT, "%s: %s", file, cs_error_text(error, text));
  }
  *bytes = made;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- checking */

typedef struct font_bytes {
  celspan_context *context;
  const char *file;
  const uint8_t *bytes;
  size_t size;
  size_t directory; /* offset of the font's directory */
} font_bytes;

static uint32_t number_at(const font_bytes *font, size_t at) {
  const uint8_t *b = font->bytes + at;
  return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static celspan_status fail_format(const font_bytes *font) {
  bool is_web = font->size >= 3 && memcmp(font->bytes, "wOF", 3) == 0;
  return cs_fail(font->context, CELSPAN_INPUT,
                 is_web ? "%s: the font is compressed for the web (WOFF); convert it to .ttf or "
                          ".otf"
                        : "%s: this is not a TrueType or OpenType font",
                 font->file);
}

static celspan_status fail_cut(const font_bytes *font, size_t wanted) {
  return cs_fail(font->context, CELSPAN_INPUT, "%s: the font is truncated: it has %zu bytes of %zu",
                 font->file, font->size, wanted);
}

bool cs_font_file_is_collection(const uint8_t *bytes, size_t size) {
  return size >= 4 && memcmp(bytes, "ttcf", 4) == 0;
}

/* In a collection, a table of offsets from byte 12 on leads to the directories of its fonts. */
static celspan_status find_face(font_bytes *font, uint32_t face) {
  uint32_t count = number_at(font, 8);
  if (count == 0)
    return fail_format(font);
  if (face >= count)
    return cs_fail(font->context, CELSPAN_BAD_ARGUMENT,
                   "%s: face %" PRIu64 " is not in the collection, which has 1 to %" PRIu32,
                   font->file, (uint64_t)face + 1, count);
  size_t entry = 12 + 4 * (size_t)face;
  if (entry + 4 > font->size)
    return fail_cut(font, entry + 4);
  font->directory = number_at(font, entry);
  return font->directory > font->size - 12 ? fail_cut(font, font->directory + 12) : CELSPAN_OK;
}

static celspan_status find_directory(font_bytes *font, uint32_t face) {
  if (font->size < 12)
    return fail_format(font);
  if (cs_font_file_is_collection(font->bytes, font->size))
    CS_TRY(find_face(font, face));
  uint32_t kind = number_at(font, font->directory);
  bool is_known = kind == 0x00010000 || kind == CS_TYPE_TAG('O', 'T', 'T', 'O') ||
                  kind == CS_TYPE_TAG('t', 'r', 'u', 'e');
  return is_known ? CELSPAN_OK : fail_format(font);
}

static const uint32_t outlines[] = {CS_TYPE_TAG('g', 'l', 'y', 'f'),
                                    CS_TYPE_TAG('C', 'F', 'F', ' '),
                                    CS_TYPE_TAG('C', 'F', 'F', '2'), 0};
static const uint32_t colours[] = {CS_TYPE_TAG('C', 'O', 'L', 'R'), CS_TYPE_TAG('C', 'B', 'D', 'T'),
                                   CS_TYPE_TAG('s', 'b', 'i', 'x'), CS_TYPE_TAG('S', 'V', 'G', ' '),
                                   0};

static bool is_among(uint32_t tag, const uint32_t *tags) {
  while (*tags && *tags != tag)
    tags++;
  return *tags;
}

celspan_status cs_font_file_check(celspan_context *context, const char *file, const uint8_t *bytes,
                                  size_t size, uint32_t face) {
  font_bytes font = {context, file, bytes, size, 0};
  CS_TRY(find_directory(&font, face));
  size_t count = number_at(&font, font.directory + 4) >> 16, end = font.directory + 12 + 16 * count;
  if (end > size)
    return fail_cut(&font, end);
  bool has_outlines = false, has_colours = false;
  for (size_t i = 0; i < count; i++) {
    size_t entry = font.directory + 12 + 16 * i;
    uint32_t tag = number_at(&font, entry);
    uint64_t last = (uint64_t)number_at(&font, entry + 8) + number_at(&font, entry + 12);
    if (last > size)
      return fail_cut(&font, last);
    has_outlines = has_outlines || is_among(tag, outlines);
    has_colours = has_colours || is_among(tag, colours);
  }
  if (has_colours)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: the font has coloured glyphs; use a font of plain outlines", file);
  if (!has_outlines)
    return cs_fail(context, CELSPAN_INPUT, "%s: the font has no outlines", file);
  return CELSPAN_OK;
}
