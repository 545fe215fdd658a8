#include "tools/areas/nearest.h"

/* A part of a row in which the parabola of a column is the lowest. */
typedef struct part {
  int32_t column, first;
} part;

/* The rows of the nearest seeds of each column. */
static void fill_columns(const unsigned char *plane, unsigned char seed, size_t width,
                         size_t height, uint32_t *rows) {
  for (size_t i = 0; i < width * height; i++)
    rows[i] = plane[i] == seed ? (uint32_t)(i / width)
              : i < width      ? CS_NEAREST_NONE
                               : rows[i - width];
  for (size_t i = width * (height - 1); i-- > 0;) {
    const uint32_t y = (uint32_t)(i / width), below = rows[i + width];
    if (below != CS_NEAREST_NONE && (rows[i] == CS_NEAREST_NONE || y - rows[i] > below - y))
      rows[i] = below;
  }
}

static int64_t cost(const uint32_t *rows, int32_t y, int32_t column, int32_t x) {
  const int64_t down = (int64_t)rows[column] - y, along = x - column;
  return down * down + along * along;
}

/* The first x at which the parabola of a column is lower than that of one to the left of it. */
static int64_t turn(const uint32_t *rows, int32_t y, int32_t left, int32_t right) {
  const int64_t higher = cost(rows, y, right, 0) - cost(rows, y, left, 0);
  return 1 + higher / (2 * (int64_t)(right - left));
}

static void fill_row(uint32_t *out, const uint32_t *rows, part *parts, int32_t width, int32_t y) {
  int32_t count = 0;
  for (int32_t x = 0; x < width; x++) {
    if (rows[x] == CS_NEAREST_NONE)
      continue;
    while (count > 0 && cost(rows, y, parts[count - 1].column, parts[count - 1].first) >
                            cost(rows, y, x, parts[count - 1].first))
      count--;
    const int64_t first = count > 0 ? turn(rows, y, parts[count - 1].column, x) : 0;
    if (first < width)
      parts[count++] = (part){x, (int32_t)first};
  }
  for (int32_t x = width; x-- > 0 && count > 0;) {
    const int32_t column = parts[count - 1].column;
    out[x] = rows[column] * (uint32_t)width + (uint32_t)column;
    count -= x == parts[count - 1].first;
  }
}

celspan_status cs_nearest_find(celspan_context *context, const unsigned char *plane,
                               unsigned char seed, int32_t width, int32_t height,
                               uint32_t *nearest) {
  const size_t across = (size_t)width;
  uint32_t *rows = cs_mem_array(context->memory, across, sizeof *rows);
  part *parts = cs_mem_array(context->memory, across, sizeof *parts);
  const bool has_room = rows && parts;
  if (has_room)
    fill_columns(plane, seed, across, (size_t)height, nearest);
  for (int32_t y = 0; has_room && y < height; y++) {
    uint32_t *row = nearest + (size_t)y * across;
    for (size_t x = 0; x < across; x++)
      rows[x] = row[x];
    fill_row(row, rows, parts, width, y);
  }
  cs_mem_free(context->memory, rows, across * sizeof *rows);
  cs_mem_free(context->memory, parts, across * sizeof *parts);
  return has_room ? CELSPAN_OK : cs_fail_memory(context);
}
