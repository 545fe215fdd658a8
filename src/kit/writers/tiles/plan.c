#include "writers/tiles/plan.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Pixels of a level that are made around a place: the size of a large screen. */
enum { PLACE_WIDTH = 2560, PLACE_HEIGHT = 1440, LINE_SIZE = 512 };

/* ---------------------------------------------------------------- places */

static celspan_status add_place(celspan_context *context, cs_tile_plan *plan, cs_tile_place place) {
  return CS_APPEND(context, plan->places, plan->place_count, plan->place_capacity, place);
}

/* "X Y WIDTH NAME"; the name extends to the end of the line. */
static bool parse_place(const char *line, const celspan_frame_desc *frame, cs_tile_place *out) {
  int name = 0;
  if (sscanf(line, "%lf %lf %lf %n", &out->x, &out->y, &out->width, &name) != 3 || !name ||
      !isfinite(out->width) || out->width <= 0)
    return false;
  size_t length = strcspn(line + name, "\r\n");
  if (length == 0 || length >= sizeof out->name)
    return false;
  memcpy(out->name, line + name, length);
  out->name[length] = '\0';
  return out->x >= 0 && out->x <= frame->film_width && out->y >= 0 && out->y <= frame->film_height;
}

static bool is_blank(const char *line) {
  line += strspn(line, " \t\r\n");
  return *line == '\0' || *line == '#';
}

static celspan_status read_places(celspan_context *context, FILE *file,
                                  const cs_tile_plan_desc *desc, cs_tile_plan *plan) {
  char line[LINE_SIZE];
  const celspan_frame_desc *frame = desc->frame;
  for (int number = 1; fgets(line, sizeof line, file); number++) {
    cs_tile_place place;
    if (is_blank(line))
      continue;
    if (!parse_place(line, frame, &place))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s:%d: a place is X Y WIDTH NAME, within the film of %g x %g units",
                     desc->places, number, frame->film_width, frame->film_height);
    CS_TRY(add_place(context, plan, place));
  }
  if (!ferror(file))
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_INPUT, "%s: cannot be read: %s", desc->places, strerror(errno));
}

static celspan_status load_places(celspan_context *context, const cs_tile_plan_desc *desc,
                                  cs_tile_plan *plan) {
  FILE *file = fopen(desc->places, "r");
  if (!file)
    return cs_fail(context, CELSPAN_INPUT, "%s: cannot be opened: %s", desc->places,
                   strerror(errno));
  celspan_status status = read_places(context, file, desc, plan);
  fclose(file);
  return status;
}

/* ---------------------------------------------------------------- levels */

static celspan_status add_job(celspan_context *context, cs_tile_plan *plan, cs_tile_job job) {
  return CS_APPEND(context, plan->jobs, plan->count, plan->capacity, job);
}

static int32_t clamped(double pixel, int32_t least, int32_t most) {
  return pixel < least ? least : pixel > most ? most : (int32_t)pixel;
}

/* The pixels of the frame that a screen shows around a place at a level. */
static cs_pyramid_box around(const cs_tile_place *place, const cs_pyramid *pyramid,
                             const celspan_frame_desc *frame, int32_t level) {
  double scale = ldexp(1, cs_pyramid_top(pyramid) - level);
  double x = place->x / frame->film_width * pyramid->width;
  double y = place->y / frame->film_height * pyramid->height;
  double across = scale * PLACE_WIDTH / 2, down = scale * PLACE_HEIGHT / 2;
  return (cs_pyramid_box){
      clamped(x - across, 0, pyramid->width - 1), clamped(y - down, 0, pyramid->height - 1),
      clamped(x + across, 1, pyramid->width), clamped(y + down, 1, pyramid->height)};
}

/* The crop of the frame; NULL: all of it. */
static const cs_pyramid_box *region_of(const celspan_frame_desc *frame, cs_pyramid_box *box) {
  *box = (cs_pyramid_box){frame->crop_x, frame->crop_y, frame->crop_x + frame->crop_width,
                          frame->crop_y + frame->crop_height};
  return frame->crop_width ? box : NULL;
}

static celspan_status add_level(celspan_context *context, cs_tile_plan *plan,
                                const cs_pyramid *pyramid, int32_t level,
                                const cs_pyramid_box *region) {
  return add_job(context, plan, (cs_tile_job){level, cs_pyramid_tiles(pyramid, level, region)});
}

celspan_status cs_tile_plan_make(celspan_context *context, const cs_tile_plan_desc *desc,
                                 cs_tile_plan *out) {
  cs_pyramid_box box;
  const cs_pyramid_box *region = region_of(desc->frame, &box);
  int32_t top = cs_pyramid_top(desc->pyramid);
  if (desc->places)
    CS_TRY(load_places(context, desc, out));
  for (int32_t level = desc->levels[0]; level <= desc->levels[1]; level++)
    CS_TRY(add_level(context, out, desc->pyramid, level, region));
  for (int32_t level = desc->levels[1] + 1; level <= top; level++)
    for (size_t i = 0; i < out->place_count; i++) {
      cs_pyramid_box near = around(&out->places[i], desc->pyramid, desc->frame, level);
      CS_TRY(add_level(context, out, desc->pyramid, level, &near));
    }
  return CELSPAN_OK;
}

int64_t cs_tile_plan_count(const cs_tile_plan *plan) {
  int64_t count = 0;
  for (size_t i = 0; i < plan->count; i++) {
    const cs_pyramid_box *tiles = &plan->jobs[i].tiles;
    count += (int64_t)(tiles->x1 - tiles->x0) * (tiles->y1 - tiles->y0);
  }
  return count;
}

int32_t cs_tile_plan_last_within(const cs_tile_plan_desc *desc, int64_t limit, int64_t *count) {
  cs_pyramid_box box;
  const cs_pyramid_box *region = region_of(desc->frame, &box);
  int32_t first = desc->levels[0], last = cs_pyramid_top(desc->pyramid);
  for (; last >= first; last--) {
    *count = cs_pyramid_count(desc->pyramid, first, last, region);
    if (*count <= limit)
      return last;
  }
  return -1;
}

void cs_tile_plan_free(celspan_context *context, cs_tile_plan *plan) {
  cs_mem_free(context->memory, plan->jobs, plan->capacity * sizeof *plan->jobs);
  cs_mem_free(context->memory, plan->places, plan->place_capacity * sizeof *plan->places);
  *plan = (cs_tile_plan){.count = 0};
}
