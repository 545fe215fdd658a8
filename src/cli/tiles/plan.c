#include "cli/tiles/plan.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"

/* Pixels of a level that are made around a place: as many as a large screen shows. */
enum { PLACE_WIDTH = 2560, PLACE_HEIGHT = 1440, LIMIT_DEFAULT = 200000, LINE_SIZE = 512 };

/* ---------------------------------------------------------------- places */

static celspan_status add_place(celspan_context *context, cs_tile_plan *plan, cs_tile_place place) {
  CS_TRY(cs_mem_reserve(context, (void **)&plan->places, &plan->place_capacity,
                        plan->place_count + 1, sizeof *plan->places));
  plan->places[plan->place_count++] = place;
  return CELSPAN_OK;
}

/* "X Y WIDTH NAME", the name to the end of the line. */
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

static cs_exit read_places(celspan_context *context, FILE *file, const char *path,
                           const celspan_frame_desc *frame, cs_tile_plan *plan) {
  char line[LINE_SIZE];
  for (int number = 1; fgets(line, sizeof line, file); number++) {
    cs_tile_place place;
    if (is_blank(line))
      continue;
    if (!parse_place(line, frame, &place))
      return cs_report_usage("%s:%d: a place is X Y WIDTH NAME, within the film of %g x %g units",
                             path, number, frame->film_width, frame->film_height);
    celspan_status status = add_place(context, plan, place);
    if (status != CELSPAN_OK)
      return cs_report_failure(context, status, NULL);
  }
  if (!ferror(file))
    return CS_EXIT_OK;
  cs_report_error("%s: cannot be read: %s", path, strerror(errno));
  return CS_EXIT_INPUT;
}

static cs_exit load_places(celspan_context *context, const char *path,
                           const celspan_frame_desc *frame, cs_tile_plan *plan) {
  FILE *file = fopen(path, "r");
  if (!file) {
    cs_report_error("%s: cannot be opened: %s", path, strerror(errno));
    return CS_EXIT_INPUT;
  }
  cs_exit outcome = read_places(context, file, path, frame, plan);
  fclose(file);
  return outcome;
}

/* ---------------------------------------------------------------- levels */

static celspan_status add_job(celspan_context *context, cs_tile_plan *plan, cs_tile_job job) {
  CS_TRY(cs_mem_reserve(context, (void **)&plan->jobs, &plan->capacity, plan->count + 1,
                        sizeof *plan->jobs));
  plan->jobs[plan->count++] = job;
  return CELSPAN_OK;
}

static int32_t clamped(double pixel, int32_t least, int32_t most) {
  return pixel < least ? least : pixel > most ? most : (int32_t)pixel;
}

/* The part of the frame, in its own pixels, that a screen shows around a place at a level. */
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

static celspan_status add_level(celspan_context *context, cs_tile_plan *plan,
                                const cs_pyramid *pyramid, int32_t level,
                                const cs_pyramid_box *region) {
  return add_job(context, plan, (cs_tile_job){level, cs_pyramid_tiles(pyramid, level, region)});
}

static celspan_status add_levels(celspan_context *context, cs_tile_plan *plan,
                                 const cs_pyramid *pyramid, const celspan_frame_desc *frame,
                                 const int32_t levels[2], const cs_pyramid_box *region) {
  for (int32_t level = levels[0]; level <= levels[1]; level++)
    CS_TRY(add_level(context, plan, pyramid, level, region));
  int32_t top = cs_pyramid_top(pyramid);
  for (int32_t level = levels[1] + 1; level <= top; level++)
    for (size_t i = 0; i < plan->place_count; i++) {
      cs_pyramid_box near = around(&plan->places[i], pyramid, frame, level);
      CS_TRY(add_level(context, plan, pyramid, level, &near));
    }
  return CELSPAN_OK;
}

static int64_t count_tiles(const cs_tile_plan *plan) {
  int64_t count = 0;
  for (size_t i = 0; i < plan->count; i++) {
    const cs_pyramid_box *tiles = &plan->jobs[i].tiles;
    count += (int64_t)(tiles->x1 - tiles->x0) * (tiles->y1 - tiles->y0);
  }
  return count;
}

/* The deepest level down to which the limit allows all levels from the first; -1: not even the
 * first. */
static int32_t level_within(const cs_pyramid *pyramid, int32_t first, const cs_pyramid_box *region,
                            int64_t limit) {
  int32_t last = cs_pyramid_top(pyramid);
  while (last >= first && cs_pyramid_count(pyramid, first, last, region) > limit)
    last--;
  return last >= first ? last : -1;
}

static cs_exit check_limit(const cs_request *request, const cs_tile_plan *plan,
                           const cs_pyramid *pyramid, const int32_t levels[2],
                           const cs_pyramid_box *region) {
  int64_t limit = request->tile_limit.is_given ? request->tile_limit.value : LIMIT_DEFAULT;
  int64_t count = count_tiles(plan);
  if (count <= limit)
    return CS_EXIT_OK;
  int32_t last = level_within(pyramid, levels[0], region, limit);
  char advice[96] = "";
  if (last >= 0)
    snprintf(advice, sizeof advice, "give --levels %d-%d for %" PRId64 " of them, or ", levels[0],
             last, cs_pyramid_count(pyramid, levels[0], last, region));
  cs_report_error("levels %d to %d have %" PRId64 " tiles, and the limit is %" PRId64
                  ": %sraise --tiles-limit",
                  levels[0], plan->jobs[plan->count - 1].level, count, limit, advice);
  return CS_EXIT_LIMIT;
}

static cs_exit choose_levels(const cs_request *request, const cs_pyramid *pyramid,
                             int32_t levels[2]) {
  int32_t top = cs_pyramid_top(pyramid);
  levels[0] = pyramid->layout == CS_PYRAMID_IIIF ? cs_pyramid_single(pyramid) : 0;
  levels[1] = top;
  if (request->levels[1] < 0)
    return CS_EXIT_OK;
  levels[0] = request->levels[0];
  levels[1] = request->levels[1];
  return levels[1] <= top
             ? CS_EXIT_OK
             : cs_report_usage("--levels %d-%d: a frame of %d x %d pixels has levels "
                               "0 to %d",
                               levels[0], levels[1], pyramid->width, pyramid->height, top);
}

cs_exit cs_tile_plan_make(celspan_context *context, const cs_request *request,
                          const cs_pyramid *pyramid, const celspan_frame_desc *frame,
                          cs_tile_plan *out) {
  int32_t levels[2];
  cs_pyramid_box region = {frame->crop_x, frame->crop_y, frame->crop_x + frame->crop_width,
                           frame->crop_y + frame->crop_height};
  const cs_pyramid_box *wanted = frame->crop_width ? &region : NULL;
  cs_exit outcome = choose_levels(request, pyramid, levels);
  if (outcome == CS_EXIT_OK && request->places)
    outcome = load_places(context, request->places, frame, out);
  if (outcome != CS_EXIT_OK)
    return outcome;
  celspan_status status = add_levels(context, out, pyramid, frame, levels, wanted);
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  return check_limit(request, out, pyramid, levels, wanted);
}

void cs_tile_plan_free(celspan_context *context, cs_tile_plan *plan) {
  cs_mem_free(context->memory, plan->jobs, plan->capacity * sizeof *plan->jobs);
  cs_mem_free(context->memory, plan->places, plan->place_capacity * sizeof *plan->places);
  *plan = (cs_tile_plan){.count = 0};
}
