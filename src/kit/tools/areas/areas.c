#include "tools/areas/areas.h"

#include <string.h>

#include "tools/areas/nearest.h"
#include "tools/trace/regions.h"

/* ---------------------------------------------------------------- labels */

static celspan_status label_all(cs_ink_areas *a) {
  const cs_region_source source =
      cs_region_source_mask(a->walls, a->width, a->height, CS_CORNERS_PART);
  cs_regions regions;
  CS_TRY(cs_regions_make(a->context, &source, &regions));
  for (int32_t y = 0; y < a->height; y++)
    for (size_t i = regions.rows[y]; i < regions.rows[y + 1]; i++)
      for (int32_t x = regions.runs[i].x0; x < cs_regions_end(&regions, y, i); x++)
        a->labels[(size_t)y * (size_t)a->width + (size_t)x] = regions.runs[i].region;
  a->count = regions.count;
  cs_regions_finish(&regions, a->context);
  return CS_ARRAY_MAKE(a->context, a->boxes, a->count);
}

/* Gives walls the labels of the areas that are nearest to them. nearest: room for all places. */
static celspan_status share_walls(cs_ink_areas *a, uint32_t *nearest) {
  const size_t size = cs_ink_areas_size(a);
  celspan_status status =
      cs_nearest_find(a->context, a->walls, CS_WALL_NONE, a->width, a->height, nearest);
  for (size_t i = 0; status == CELSPAN_OK && i < size; i++)
    a->labels[i] = a->labels[nearest[i]];
  return status;
}

static void measure_boxes(cs_ink_areas *a) {
  for (size_t i = 0; i < a->count; i++)
    a->boxes[i] = (cs_area_box){a->width, a->height, 0, 0};
  for (int32_t y = 0; y < a->height; y++)
    for (int32_t x = 0; x < a->width; x++) {
      cs_area_box *box = &a->boxes[a->labels[(size_t)y * (size_t)a->width + (size_t)x]];
      box->x0 = x < box->x0 ? x : box->x0;
      box->x1 = x >= box->x1 ? x + 1 : box->x1;
      box->y0 = y < box->y0 ? y : box->y0;
      box->y1 = y + 1;
    }
}

static celspan_status divide(cs_ink_areas *a) {
  uint32_t *nearest;
  CS_TRY(label_all(a));
  CS_TRY(CS_MAKE(a->context, nearest, cs_ink_areas_size(a)));
  celspan_status status = share_walls(a, nearest);
  if (status == CELSPAN_OK)
    measure_boxes(a);
  cs_mem_free(a->context->memory, nearest, cs_ink_areas_size(a) * sizeof *nearest);
  return status;
}

/* ---------------------------------------------------------------- the whole */

static celspan_status fill(cs_ink_areas *a, const unsigned char *coverage, double gap) {
  const size_t size = cs_ink_areas_size(a);
  CS_TRY(CS_ARRAY_MAKE(a->context, a->coverage, size));
  CS_TRY(CS_ARRAY_MAKE(a->context, a->walls, size));
  CS_TRY(CS_ARRAY_MAKE(a->context, a->labels, size));
  memcpy(a->coverage, coverage, size);
  for (size_t i = 0; i < size; i++)
    a->walls[i] = coverage[i] >= 128 ? CS_WALL_INK : CS_WALL_NONE;
  CS_TRY(cs_ink_areas_close(a, gap));
  return divide(a);
}

celspan_status cs_ink_areas_create(celspan_context *context, const unsigned char *coverage,
                                   int32_t width, int32_t height, double gap, cs_ink_areas **out) {
  cs_ink_areas *areas;
  CS_TRY(CS_MAKE(context, areas, 1));
  *areas = (cs_ink_areas){.context = context, .width = width, .height = height};
  celspan_status status = fill(areas, coverage, gap);
  return CS_GIVE(status, areas, cs_ink_areas_destroy, out);
}

void cs_ink_areas_destroy(cs_ink_areas *areas) {
  if (!areas)
    return;
  cs_memory *memory = areas->context->memory;
  CS_ARRAYS_FREE(memory, areas, coverage, boxes);
  cs_mem_free(memory, areas, sizeof *areas);
}

void cs_ink_areas_measure(const cs_ink_areas *areas, double (*out)[CS_AREA_NUMBERS]) {
  double length = 0; /* of the pixels of one area, without walls, that end here */
  memset(out, 0, areas->count * sizeof *out);
  for (size_t i = 0; i < cs_ink_areas_size(areas); i++) {
    const size_t column = i % (size_t)areas->width;
    const double x = (double)column + 0.5, y = (double)(i / (size_t)areas->width) + 0.5;
    const double terms[] = {1, x, y, x * x, x * y, y * y};
    double *own = out[areas->labels[i]];
    for (size_t k = 0; k < sizeof terms / sizeof *terms; k++)
      own[k] += terms[k];
    const bool goes_on = column > 0 && areas->labels[i - 1] == areas->labels[i];
    length = areas->walls[i] ? 0 : goes_on ? length + 1 : 1;
    if (length > own[8]) {
      own[6] = x + 0.5 - length / 2;
      own[7] = y;
      own[8] = length;
    }
  }
}
