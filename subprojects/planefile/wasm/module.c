/* The decoder as a module of WebAssembly: for a page that has the bytes of one plane file.
 *
 *   reserve --> the page copies the file there --> open a frame --> draw, as often as it likes
 *
 * Addresses are those of the module's memory, of which the page makes its views again after each
 * call, because memory may have grown.
 */
#include "planefile.h"

#define EXPORT(name) __attribute__((export_name(name)))

static unsigned char *bytes; /* of the file */
static size_t byte_count;
static uint64_t file_size; /* of the file; of a nest it is more than byte_count, because only the
                           * outer plane is in memory */
static planefile_plane *plane;
static planefile_fault fault;
static unsigned char *pixels; /* of the latest view */
static size_t pixel_bytes;
static struct {
  uint32_t left, upper, right, lower;
} seen; /* the box around what is not clear of the latest view */

void *cs_wasm_resize(void *user, void *block, size_t old_size, size_t new_size);

/* Where the page writes the bytes of the file; 0: no memory. */
EXPORT("reserve") unsigned char *reserve(size_t size) {
  bytes = cs_wasm_resize(NULL, bytes, byte_count, size);
  file_size = byte_count = bytes ? size : 0;
  return bytes;
}

/* After reserve: the file is longer than that. */
EXPORT("extend") void extend(double size) { file_size = (uint64_t)size; }

static bool read_bytes(void *user, uint64_t offset, void *out, size_t size) {
  (void)user;
  if (offset > byte_count || size > byte_count - offset)
    return false;
  __builtin_memcpy(out, bytes + offset, size);
  return true;
}

/* Reads a frame, from 0. NULL: it is read; otherwise the reason, which ends with a zero. */
EXPORT("open") const char *open(uint32_t frame) {
  const planefile_source source = {.read = read_bytes, .size = file_size, .resize = cs_wasm_resize};
  planefile_status status = planefile_read_next(&source, frame, &plane, &fault);
  return status == PLANEFILE_OK ? NULL : fault.reason;
}

EXPORT("width") double width(void) { return planefile_plane_info(plane).width; }
EXPORT("height") double height(void) { return planefile_plane_info(plane).height; }

EXPORT("is_opaque") bool is_opaque(void) { return planefile_plane_info(plane).is_opaque; }

EXPORT("frames") uint32_t frames(void) { return planefile_plane_info(plane).frame_count; }
EXPORT("rate") double rate(void) { return planefile_plane_info(plane).frames_second; }

static bool make_room(const planefile_view *view) {
  size_t size = (size_t)4 * view->columns * view->rows;
  if (size <= pixel_bytes)
    return true;
  pixels = cs_wasm_resize(NULL, pixels, pixel_bytes, size);
  pixel_bytes = pixels ? size : 0;
  return pixels != NULL;
}

/* Widens the box by a row. */
static void see(const unsigned char *row, uint32_t y, const planefile_span *spans, size_t count) {
  uint32_t columns = spans[count - 1].end, left = row[3] ? 0 : spans[0].end, right = columns;
  if (row[(size_t)4 * columns - 1] == 0)
    right = count > 1 ? spans[count - 2].end : 0;
  if (left >= right)
    return;
  seen.left = left < seen.left ? left : seen.left;
  seen.right = right > seen.right ? right : seen.right;
  seen.upper = y < seen.upper ? y : seen.upper;
  seen.lower = y + 1;
}

static bool draw_rows(planefile_drawer *drawer, const planefile_view *view) {
  const planefile_span *spans;
  size_t count;
  seen.left = seen.upper = UINT32_MAX;
  seen.right = seen.lower = 0;
  for (uint32_t y = 0; y < view->rows; y++) {
    unsigned char *row = pixels + (size_t)4 * view->columns * y;
    if (planefile_drawer_row(drawer, &spans, &count) != PLANEFILE_OK)
      return false;
    planefile_span_pixels(plane, spans, count, row);
    see(row, y, spans, count);
  }
  return true;
}

/* The pixels of a crop of the frame at a size, 4 bytes each; NULL: no memory, or there is no such
 * view. */
EXPORT("draw")
const unsigned char *draw(uint32_t across, uint32_t down, uint32_t x, uint32_t y, uint32_t columns,
                          uint32_t rows) {
  const planefile_view view = {across, down, x, y, columns, rows, PLANEFILE_AREA};
  planefile_drawer *drawer;
  if (!make_room(&view) || planefile_drawer_create(plane, &view, &drawer) != PLANEFILE_OK)
    return NULL;
  bool is_drawn = draw_rows(drawer, &view);
  planefile_drawer_destroy(drawer);
  return is_drawn ? pixels : NULL;
}

/* After draw: the box, as columns and rows from and before; right is 0 where all is clear. */
EXPORT("seen") const void *seen_box(void) { return &seen; }
