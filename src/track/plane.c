#include "track/plane.h"

#include <string.h>

enum { LEAST_SIDE = 16 };

static celspan_status allocate(celspan_context *context, int32_t width, int32_t height,
                               cs_planes *planes) {
  size_t count = (size_t)width * (size_t)height;
  float *values = cs_mem_array(planes->memory, count, sizeof *values);
  if (!values)
    return cs_fail_memory(context);
  planes->levels[planes->count++] = (cs_plane){width, height, values};
  return CELSPAN_OK;
}

static int32_t held(int32_t at, int32_t size) { return at < 0 ? 0 : at < size ? at : size - 1; }

/* The mean of the pixels 2 i - 1 .. 2 i + 2 of a line by the weights 1 3 3 1; `stride` is from one
 * to the next. */
static float halved(const float *line, int32_t size, ptrdiff_t stride, int32_t i) {
  float outer = line[held(2 * i - 1, size) * stride] + line[held(2 * i + 2, size) * stride];
  float inner = line[held(2 * i, size) * stride] + line[held(2 * i + 1, size) * stride];
  return (outer + 3 * inner) / 8;
}

static void halve_row(const cs_plane *from, int32_t y, float *lines, cs_plane *to) {
  const int32_t width = from->width;
  for (int32_t x = 0; x < width; x++)
    lines[x] = halved(from->values + x, from->height, width, y);
  for (int32_t x = 0; x < to->width; x++)
    to->values[(size_t)y * (size_t)to->width + (size_t)x] = halved(lines, width, 1, x);
}

static celspan_status append_level(celspan_context *context, cs_planes *planes) {
  const cs_plane from = planes->levels[planes->count - 1];
  float *lines = cs_mem_array(planes->memory, (size_t)from.width, sizeof *lines);
  if (!lines)
    return cs_fail_memory(context);
  celspan_status status = allocate(context, from.width / 2, from.height / 2, planes);
  if (status == CELSPAN_OK)
    for (int32_t y = 0; y < from.height / 2; y++)
      halve_row(&from, y, lines, &planes->levels[planes->count - 1]);
  cs_mem_free(planes->memory, lines, (size_t)from.width * sizeof *lines);
  return status;
}

static celspan_status fill(celspan_context *context, const float *values, int32_t width,
                           int32_t height, int32_t count, cs_planes *planes) {
  CS_TRY(allocate(context, width, height, planes));
  memcpy(planes->levels[0].values, values, (size_t)width * (size_t)height * sizeof *values);
  for (int32_t side = width < height ? width : height; planes->count < count; side /= 2) {
    if (side / 2 < LEAST_SIDE)
      break;
    CS_TRY(append_level(context, planes));
  }
  return CELSPAN_OK;
}

celspan_status cs_planes_make(celspan_context *context, const float *values, int32_t width,
                              int32_t height, int32_t count, cs_planes *out) {
  *out = (cs_planes){.memory = context->memory};
  celspan_status status = fill(context, values, width, height, count, out);
  if (status != CELSPAN_OK)
    cs_planes_finish(out);
  return status;
}

void cs_planes_finish(cs_planes *planes) {
  for (int32_t i = 0; i < planes->count; i++) {
    const cs_plane *plane = &planes->levels[i];
    cs_mem_free(planes->memory, plane->values,
                (size_t)plane->width * (size_t)plane->height * sizeof *plane->values);
  }
  *planes = (cs_planes){0};
}
