/* celspan_plane of the public header.
 *
 *   rostrum --compile, record--> borders --> bytes of a plane file --> plane --rows.c--> rows
 *
 * A plane in memory consists of the bytes of its file and of the values that a reader made from
 * them, so a new plane draws the same pixels as one that was read.
 */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/description.h"
#include "inside/files.h"
#include "inside/frames.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "writers/plane/plane.h"
#include "writers/plane/plane_data.h"
#include "writers/record/record.h"

CS_DESCRIBE(celspan_plane_desc, height, .depth = 16)

#define BYTES_MOST ((uint64_t)1 << 30) /* bytes of a file */

celspan_status cs_plane_report(celspan_context *context, planefile_status status) {
  if (status == PLANEFILE_OK)
    return CELSPAN_OK;
  if (status == PLANEFILE_BAD_ARGUMENT)
    return cs_fail(context, CELSPAN_INTERNAL, "plane: its borders are not in order");
  return cs_fail_memory(context);
}

celspan_status cs_plane_report_record(celspan_context *context, planefile_status status,
                                      const cs_recording *made) {
  return status == PLANEFILE_READ_FAILED ? made->status : cs_plane_report(context, status);
}

/* ---------------------------------------------------------------- life */

static celspan_status create(celspan_context *context, celspan_plane **out) {
  celspan_plane *plane;
  CS_TRY(CS_COUNTED_MAKE(context, plane));
  *out = plane;
  return CELSPAN_OK;
}

static void destroy(celspan_plane *plane) {
  cs_memory *memory = plane->memory;
  planefile_plane_destroy(plane->plane);
  if (!plane->whole)
    cs_mem_free(memory, plane->bytes, plane->capacity);
  celspan_plane_unref(plane->whole);
  cs_counted_free(memory, plane, sizeof *plane);
}

CS_COUNTED(celspan_plane)

void celspan_plane_size(const celspan_plane *plane, double *width, double *height) {
  planefile_info info = planefile_plane_info(plane->plane);
  *width = info.width;
  *height = info.height;
}

bool celspan_plane_is_opaque(const celspan_plane *plane) {
  return planefile_plane_info(plane->plane).is_opaque;
}

size_t celspan_plane_bytes(const celspan_plane *plane) { return plane->size; }

/* ---------------------------------------------------------------- bytes */

static bool read_bytes(void *user, uint64_t offset, void *bytes, size_t size) {
  const celspan_plane *plane = user;
  memcpy(bytes, plane->bytes + offset, size);
  return true;
}

/* The values of a frame in the bytes. */
static planefile_status load(celspan_plane *plane, uint32_t frame, planefile_fault *fault) {
  planefile_source source = {.read = read_bytes,
                             .user = plane,
                             .size = plane->size,
                             .resize = cs_mem_resize_of,
                             .resize_user = plane->memory};
  return planefile_read_frame(&source, frame, 0, PLANEFILE_SIDE, &plane->plane, fault);
}

/* ---------------------------------------------------------------- making */

/* Where a plane's bytes are appended. */
typedef struct appending {
  celspan_context *context;
  celspan_plane *plane;
} appending;

static bool append(void *user, const void *bytes, size_t size) {
  const appending *a = user;
  celspan_plane *plane = a->plane;
  if (CS_RESERVE(a->context, plane->bytes, plane->capacity, plane->size + size) != CELSPAN_OK)
    return false;
  memcpy(plane->bytes + plane->size, bytes, size);
  plane->size += size;
  return true;
}

/* Refuses a plan that depends on the raster: a plane has none. */
static celspan_status check_plan(celspan_context *context, const cs_plan *plan) {
  if (plan->is_crowded)
    return cs_fail(context, CELSPAN_LIMIT, "plane: more than %d dashes of strokes are in view",
                   CS_COMPILE_DASHES);
  if (plan->stack.procedure_count > 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: a scan-line procedure is in view; it cannot be drawn without a size");
  for (size_t k = 0; k < plan->defocus_count; k++)
    if (plan->defocus[k]->way == CS_DEFOCUS_SHIFTED)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "plane: an object is in view that is displaced, or blurred in a direction; it "
                     "is made of pixels, which a plane has not");
  return CELSPAN_OK;
}

/* Pushes what is drawn for an exposure, which plans borrow from. */
static celspan_status show(celspan_context *context, const celspan_exposure *exposure,
                           const cs_view *view, cs_plane_frame *out) {
  CS_TRY(CS_ARRAY_RESERVE(context, out->shown, out->shown_count + 1));
  CS_TRY(cs_rostrum_shown(context, exposure->rostrum, view->film_width, view->film_height, 0,
                          cs_space_inside(view->film_space, view->space),
                          &out->shown[out->shown_count]));
  out->shown_count++;
  return CELSPAN_OK;
}

/* A plan with defocused cels is kept: their nodes are read when the plane is written. */
static celspan_status record(celspan_context *context, const celspan_exposure *exposure,
                             const cs_view *view, const planefile_rounding *rounding,
                             cs_plane_frame *out) {
  const cs_antialias antialias = {.mode = CELSPAN_ANTIALIAS_AREA};
  cs_plan plan = {0};
  CS_TRY(CS_ARRAY_RESERVE(context, out->plans, out->plan_count + 1));
  CS_TRY(show(context, exposure, view, out));
  CS_TRY(cs_compile(context, out->shown[out->shown_count - 1], view, &antialias, 1, &plan));
  celspan_status status = check_plan(context, &plan);
  if (status == CELSPAN_OK)
    status = cs_record_put_plan(context, &plan, (float)exposure->weight, rounding, &out->record);
  if (plan.defocus_count > 0)
    out->plans[out->plan_count++] = plan;
  else
    cs_compile_free(&plan, context->memory);
  return status;
}

static celspan_status check_desc(celspan_context *context, const celspan_plane_desc *desc,
                                 size_t count) {
  CS_TRY(cs_check_positive(context, "plane", "width", desc->width));
  CS_TRY(cs_check_positive(context, "plane", "height", desc->height));
  if (desc->depth != 8 && desc->depth != 16)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "plane: the depth is %d; it is 8 or 16",
                   (int)desc->depth);
  CS_TRY(cs_check_choice(context, "plane", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  if (desc->depth == 8 && count != 1)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: a frame of %zu exposures is their sum, which has no 8-bit colours",
                   count);
  return CELSPAN_OK;
}

static celspan_status record_all(celspan_context *context, const celspan_exposure *exposures,
                                 size_t count, const celspan_plane_desc *desc,
                                 const planefile_rounding *rounding, cs_plane_frame *out) {
  const cs_view view = {.film_width = desc->width,
                        .film_height = desc->height,
                        .width = CS_RECORD_SIDE,
                        .height = CS_RECORD_SIDE,
                        .end_row = CS_RECORD_SIDE,
                        .end_column = CS_RECORD_SIDE,
                        .most_dashes = CS_COMPILE_DASHES,
                        .space = CELSPAN_SPACE_LINEAR,
                        .film_space = desc->space,
                        .unit = cs_record_unit(out->record.grid)};
  if (count != 1)
    CS_TRY(cs_record_begin_sum(context, &out->record));
  for (size_t i = 0; i < count; i++)
    CS_TRY(record(context, &exposures[i], &view, rounding, out));
  return CELSPAN_OK;
}

celspan_status cs_plane_record(celspan_context *context, const celspan_exposure *exposures,
                               size_t count, const celspan_plane_desc *desc, planefile_grid grid,
                               cs_plane_frame *out) {
  planefile_rounding *rounding = NULL;
  *out = (cs_plane_frame){.record.grid = grid};
  CS_TRY(check_desc(context, desc, count));
  if (desc->depth == 8) {
    rounding = planefile_rounding_create(cs_mem_resize_of, context->memory);
    if (!rounding)
      return cs_fail_memory(context);
  }
  celspan_status status = record_all(context, exposures, count, desc, rounding, out);
  planefile_rounding_destroy(rounding);
  return status;
}

void cs_plane_frame_finish(cs_plane_frame *frame, cs_memory *memory) {
  cs_record_finish(&frame->record, memory);
  for (size_t i = 0; i < frame->plan_count; i++)
    cs_compile_free(&frame->plans[i], memory);
  for (size_t i = 0; i < frame->shown_count; i++)
    celspan_rostrum_unref(frame->shown[i]);
  CS_ARRAYS_FREE(memory, frame, plans, shown);
  *frame = (cs_plane_frame){0};
}

static celspan_status write_record(celspan_context *context, cs_recording *made,
                                   const celspan_plane_desc *given, celspan_plane *plane) {
  appending a = {context, plane};
  const planefile_writer_desc desc = {.width = given->width,
                                      .height = given->height,
                                      .write = append,
                                      .user = &a,
                                      .resize = cs_mem_resize_of,
                                      .resize_user = context->memory,
                                      .is_coded = given->depth == 8};
  planefile_band band = cs_record_plane(made);
  CS_TRY(cs_plane_report_record(context, planefile_write(&desc, &band), made));
  return cs_plane_report(context, load(plane, 0, NULL));
}

celspan_status cs_plane_expose(celspan_context *context, const celspan_exposure *exposures,
                               size_t count, const celspan_plane_desc *desc, celspan_plane **out) {
  cs_plane_frame made;
  celspan_plane *plane;
  *out = NULL;
  CS_TRY(create(context, &plane));
  celspan_status status =
      cs_plane_record(context, exposures, count, desc, (planefile_grid){0, 0}, &made);
  if (status == CELSPAN_OK)
    status = write_record(context, &made.record, desc, plane);
  cs_plane_frame_finish(&made, context->memory);
  return CS_GIVE(status, plane, celspan_plane_unref, out);
}

celspan_status celspan_plane_create(celspan_context *context, const celspan_rostrum *rostrum,
                                    const celspan_plane_desc *desc, celspan_plane **out) {
  CS_READ(context, "plane", celspan_plane_desc, desc);
  const celspan_exposure whole = {.rostrum = (celspan_rostrum *)rostrum, .weight = 1};
  *out = NULL;
  CS_TRY(cs_check_given(context, "plane", "the rostrum", rostrum));
  return cs_plane_expose(context, &whole, 1, desc, out);
}

/* ---------------------------------------------------------------- files */

celspan_status celspan_plane_write(celspan_context *context, const celspan_plane *plane,
                                   const char *path) {
  cs_file *file;
  CS_TRY(cs_check_given(context, "plane", "the path", path));
  CS_TRY(cs_file_create(context, NULL, path, &file));
  celspan_status status = cs_file_write(file, context, plane->bytes, plane->size);
  return cs_file_end(file, context, status);
}

static celspan_status load_bytes(celspan_context *context, const char *path, int descriptor,
                                 celspan_plane *plane) {
  struct stat there;
  if (descriptor < 0 || fstat(descriptor, &there) != 0)
    return cs_fail(context, CELSPAN_INPUT, "%s: %s", path, strerror(errno));
  if (!S_ISREG(there.st_mode))
    return cs_fail(context, CELSPAN_INPUT, "%s: this is not a plane file", path);
  if ((uint64_t)there.st_size > BYTES_MOST)
    return cs_fail(context, CELSPAN_LIMIT, "%s: has more than %" PRIu64 " bytes", path, BYTES_MOST);
  size_t size = (size_t)there.st_size;
  CS_TRY(CS_RESERVE(context, plane->bytes, plane->capacity, size));
  errno = EIO; /* where the file has become shorter */
  if (cs_open_read_at(descriptor, plane->bytes, size, 0) != (ssize_t)size)
    return cs_fail(context, CELSPAN_INPUT, "%s: %s", path, strerror(errno));
  plane->size = size;
  return CELSPAN_OK;
}

static celspan_status load_file(celspan_context *context, const char *path, celspan_plane *plane) {
  planefile_fault fault;
  int descriptor = cs_open_to_read(path);
  celspan_status status = load_bytes(context, path, descriptor, plane);
  if (descriptor >= 0)
    close(descriptor);
  CS_TRY(status);
  planefile_status loaded = load(plane, 0, &fault);
  if (loaded == PLANEFILE_BAD_FILE)
    return cs_fail(context, CELSPAN_INPUT, "%s: byte %" PRIu64 ": %s", path, fault.offset,
                   fault.reason);
  return cs_plane_report(context, loaded);
}

celspan_status celspan_plane_read(celspan_context *context, const char *path, celspan_plane **out) {
  celspan_plane *plane;
  *out = NULL;
  CS_TRY(cs_check_given(context, "plane", "the path", path));
  CS_TRY(create(context, &plane));
  celspan_status status = load_file(context, path, plane);
  return CS_GIVE(status, plane, celspan_plane_unref, out);
}

int32_t celspan_plane_frames(const celspan_plane *plane, double *frames_second) {
  planefile_info info = planefile_plane_info(plane->plane);
  *frames_second = info.frames_second;
  return info.frame_count < INT32_MAX ? (int32_t)info.frame_count : INT32_MAX;
}

/* name: of the file, or "plane". Frames are counted from 1 in messages. */
static celspan_status load_frame(celspan_context *context, const char *name, celspan_plane *plane,
                                 int32_t frame) {
  planefile_fault fault;
  planefile_status status = load(plane, (uint32_t)frame, &fault);
  if (status == PLANEFILE_BAD_FILE)
    return cs_fail(context, CELSPAN_INPUT, "%s: frame %d: byte %" PRIu64 ": %s", name,
                   (int)frame + 1, fault.offset, fault.reason);
  return cs_plane_report(context, status);
}

celspan_status cs_plane_choose(celspan_context *context, const char *name,
                               const celspan_plane *plane, int32_t frame, celspan_plane **out) {
  double rate;
  celspan_plane *other;
  *out = NULL;
  if (frame < 0 || frame >= celspan_plane_frames(plane, &rate))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "plane: frame %d: there are %d frames, from 0",
                   (int)frame, (int)celspan_plane_frames(plane, &rate));
  CS_TRY(create(context, &other));
  other->whole = celspan_plane_ref(plane->whole ? plane->whole : (celspan_plane *)plane);
  other->bytes = plane->bytes;
  other->size = plane->size;
  celspan_status status = load_frame(context, name, other, frame);
  return CS_GIVE(status, other, celspan_plane_unref, out);
}

celspan_status cs_plane_enter(celspan_context *context, const char *name,
                              const celspan_plane *plane, uint32_t index, celspan_plane **out) {
  celspan_plane *other;
  uint64_t offset, size;
  *out = NULL;
  planefile_plane_inner(plane->plane, index, &offset, &size);
  CS_TRY(create(context, &other));
  other->whole = celspan_plane_ref(plane->whole ? plane->whole : (celspan_plane *)plane);
  other->bytes = plane->bytes + offset;
  other->size = (size_t)size;
  celspan_status status = load_frame(context, name, other, 0);
  return CS_GIVE(status, other, celspan_plane_unref, out);
}

celspan_status celspan_plane_frame(celspan_context *context, const celspan_plane *plane,
                                   int32_t frame, celspan_plane **out) {
  return cs_plane_choose(context, "plane", plane, frame, out);
}

static bool begins_as_plane(const char *path) {
  unsigned char start[PLANEFILE_MAGIC_BYTES];
  int descriptor = cs_open_to_read(path);
  bool is_plane = descriptor >= 0 &&
                  cs_open_read_at(descriptor, start, sizeof start, 0) == (ssize_t)sizeof start &&
                  planefile_is(start, sizeof start);
  if (descriptor >= 0)
    close(descriptor);
  return is_plane;
}

bool cs_plane_accepts(const char *path) {
  return strcasecmp(cs_file_ending(path), "plane") == 0 || begins_as_plane(path);
}

cs_plane_facts cs_plane_count(const celspan_plane *plane) {
  planefile_info info = planefile_plane_info(plane->plane);
  cs_plane_facts facts = {.parts = info.band_count,
                          .pictures = info.picture_count,
                          .inner = info.inner_count,
                          .shown = info.window_count};
  for (uint32_t i = 0; i < info.band_count; i++) {
    const planefile_band *band = planefile_plane_band(plane->plane, i);
    size_t gradients = 0;
    for (uint32_t k = 0; band->programs && k < band->cell_count; k++)
      gradients += band->programs[k].step_count > 0;
    facts.borders += band->border_count;
    facts.curves += band->piece_count;
    facts.colours += band->cell_count - gradients;
    facts.gradients += gradients;
  }
  return facts;
}
