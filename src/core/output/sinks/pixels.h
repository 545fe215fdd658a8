/* Spans to rows of coded pixels, four channels each, in the machine's byte order (little endian):
 *
 *   depth     bytes of a pixel
 *   8         R G B A                     straight or premultiplied, along a transfer curve
 *   16        RR GG BB AA
 *   half      RR GG BB AA                 IEEE 754 binary16
 *   float     RRRR GGGG BBBB AAAA         IEEE 754 binary32
 *
 * INVARIANT: a pixel's bytes depend on its colour and the coding alone; not on the spans around it,
 * the length of its run, the address of the row or the set of instructions.
 */
#pragma once

#include <string.h>

#include "base/context.h"
#include "celspan/celspan.h"
#include "model/colour/primaries.h"

/* Checks that the numbers of a coding from a caller are values of their enumerations; NULL is
 * valid. Errors: BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_pixels_check(celspan_context *context,
                                               const celspan_coding *coding);
/* Reads a coding from outside: makes *coding, or NULL for the defaults, point to its copy *whole.
 * The numbers are checked only if there is a context for the message. */
CELSPAN_CHECKED celspan_status cs_pixels_read(celspan_context *context,
                                              const celspan_coding **coding, celspan_coding *whole);
/* Bytes of a pixel. */
size_t cs_pixels_size(const celspan_coding *coding);
/* A kind of alpha that only codings inside of celspan have: the light is divided by alpha and
 * coded, and the code is multiplied by alpha. Readers of files expect this. Where alpha is 0, the
 * light is coded as if it were opaque. */
#define CS_ALPHA_CODED ((celspan_alpha)(CELSPAN_ALPHA_PREMULTIPLIED + 1))

/* Another such kind, for files without alpha that a conversion codes: the light is that over black,
 * and is neither divided by alpha nor multiplied by it. */
#define CS_ALPHA_BLACK ((celspan_alpha)(CELSPAN_ALPHA_PREMULTIPLIED + 2))

/* The transfer of a resolved coding with a conversion. */
#define CS_TRANSFER_CONVERTED ((celspan_transfer)(CELSPAN_TRANSFER_CINEON + 1))

/* The name of a resolved coding's colours: "srgb", "linear", "rec709", "cineon", or of its
 * space. */
const char *cs_pixels_colour(const celspan_coding *coding);
/* The primaries of what is coded (model/colour/primaries.h); false: they are not known. */
bool cs_pixels_primaries(const celspan_coding *coding, float xy[CS_PRIMARIES]);
/* The coding with all defaults filled in, for integers and floats. 8_DITHER becomes 8:
 * output/sinks/dither.h does the rest. */
celspan_coding cs_pixels_resolve(const celspan_coding *coding, celspan_depth default_depth);

/* Writes one row of pixels: the spans cover [0, width) without gap. A single span is coded once and
 * repeated. Codes of arrays are copied: they are in this coding. coding: resolved. Threads: any. */
void cs_pixels_row(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
                   void *row);
/* Whether array spans may contain codes, which are already coded pixels, in this coding. coding:
 * resolved. */
bool cs_pixels_takes_codes(const celspan_coding *coding);
/* Columns [x, x + count) of a span, as a span from column 0. */
celspan_span cs_pixels_crop(const celspan_span *span, int32_t x, int32_t count);
/* One colour, linear and premultiplied, as the numbers from which integers are rounded: 1 is the
 * largest. */
void cs_pixels_encode(const celspan_coding *coding, const float rgba[4], float coded[4]);
/* One colour, linear premultiplied, to one coded pixel. */
void cs_pixels_code(const celspan_coding *coding, const float rgba[4], void *pixel);

/* The coded colours of single spans. Most spans of a drawn frame have one colour and few pixels;
 * coded together, their colours cost a fraction of the time that they cost one by one.
 *
 * INVARIANT: entry i belongs to span i of the last call; the entry of a span that is not single has
 * no meaning.
 */
enum { CS_SINGLE_COLOURS_MOST = 512 };

typedef struct cs_single_colours {
  float rgba[4 * CS_SINGLE_COLOURS_MOST];
  unsigned char coded[8 * CS_SINGLE_COLOURS_MOST];
} cs_single_colours;

/* count: at most CS_SINGLE_COLOURS_MOST. coding: resolved, not float. */
void cs_single_colours_code(cs_single_colours *colours, const celspan_coding *coding,
                            const celspan_span *spans, size_t count);

/* The coded pixel of span i, its first byte lowest. pixel_size: 4 or 8. */
static inline uint64_t cs_single_colours_pixel(const cs_single_colours *colours, size_t pixel_size,
                                               size_t i) {
  uint64_t eight;
  uint32_t four;
  if (pixel_size == 8)
    return memcpy(&eight, colours->coded + 8 * i, sizeof eight), eight;
  return memcpy(&four, colours->coded + 4 * i, sizeof four), four;
}
