#include "frames/render/frame.h"

#include <math.h>

#include "base/number.h"
#include "frames/render/drawings.h"
#include "model/scene/check.h"
#include "output/sinks/pixels.h"

#define SIDE_LIMIT 1048576
#define WORKER_LIMIT 1024

/* ---------------------------------------------------------------- checking */

static celspan_status check_size(celspan_context *context, const celspan_frame_desc *desc) {
  if (desc->width < 1 || desc->height < 1 || desc->width > SIDE_LIMIT || desc->height > SIDE_LIMIT)
    return cs_fail(context, CELSPAN_LIMIT,
                   "frame: size is %d x %d; each side must be 1 to %d pixels", (int)desc->width,
                   (int)desc->height, SIDE_LIMIT);
  if (desc->film_width == 0 && desc->film_height == 0)
    return CELSPAN_OK;
  CS_TRY(cs_check_positive(context, "frame", "film width", desc->film_width));
  return cs_check_positive(context, "frame", "film height", desc->film_height);
}

/* Whether a run of pixels is not too long and has one of the pixels 0 .. side - 1. */
static bool meets(int32_t first, int32_t count, int32_t side) {
  return count >= 1 && count <= SIDE_LIMIT && first < side && (int64_t)first + count > 0;
}

static celspan_status check_crop(celspan_context *context, const celspan_frame_desc *desc) {
  if (desc->crop_width == 0 && desc->crop_height == 0)
    return CELSPAN_OK;
  if (!meets(desc->crop_x, desc->crop_width, desc->width) ||
      !meets(desc->crop_y, desc->crop_height, desc->height))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "frame: crop %d,%d,%d,%d has no pixel of the frame of %d x %d pixels, or more "
                   "than 1048576 a side",
                   (int)desc->crop_x, (int)desc->crop_y, (int)desc->crop_width,
                   (int)desc->crop_height, (int)desc->width, (int)desc->height);
  return CELSPAN_OK;
}

static celspan_status check_exposures(celspan_context *context, const celspan_frame_desc *desc) {
  CS_TRY(cs_check_list(context, "frame", "exposures", desc->exposures, desc->exposure_count,
                       CS_CHECK_ITEMS));
  for (size_t i = 0; i < desc->exposure_count; i++) {
    CS_TRY(cs_check_item(context, (cs_check_field){"frame", "exposures", i + 1, "weight"},
                         desc->exposures[i].weight, 0, CS_NUMBER_LIMIT));
    if (!desc->exposures[i].rostrum)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "frame: exposure %zu has no rostrum", i + 1);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the frame */

static void set_crop(cs_frame *frame, const celspan_frame_desc *desc) {
  bool is_whole = desc->crop_width == 0 && desc->crop_height == 0;
  frame->width = desc->width;
  frame->height = desc->height;
  frame->crop_x = is_whole ? 0 : desc->crop_x;
  frame->crop_y = is_whole ? 0 : desc->crop_y;
  frame->crop_width = is_whole ? desc->width : desc->crop_width;
  frame->crop_height = is_whole ? desc->height : desc->crop_height;
}

static bool sheets_stay_on_thread(const cs_map_frame *frame) {
  for (size_t i = 0; i < frame->count; i++)
    if (frame->sheets[i].plan && frame->sheets[i].plan->stays_on_thread)
      return true;
  return false;
}

/* Procedures and surfaces that must stay on the rendering thread allow only one worker. */
static bool needs_one_thread(const cs_frame *frame) {
  for (size_t i = 0; i < frame->count; i++)
    if (frame->plans[i].stays_on_thread || sheets_stay_on_thread(&frame->maps[i]))
      return true;
  return false;
}

int cs_frame_workers(celspan_context *context, int wanted) {
  return cs_context_workers(context, wanted, WORKER_LIMIT);
}

/* Makes strips of whole swaths, so that no swath is made twice if the crop begins with a whole
 * swath; in films of whole bands, because a band is held only if one worker makes it. */
static void choose_workers(celspan_context *context, cs_frame *frame,
                           const celspan_frame_desc *desc) {
  frame->workers = needs_one_thread(frame) ? 1 : cs_frame_workers(context, desc->workers);
  int32_t share = frame->crop_height / (frame->workers * 8);
  int32_t whole = desc->repeats ? CS_FRAME_BAND : 1;
  for (size_t i = 0; i < frame->count && whole == 1; i++)
    whole = cs_drawings_are_used(&frame->maps[i]) ? CS_MAP_ROWS : 1;
  share += (whole - share % whole) % whole;
  frame->strip_height = desc->strip_rows > 0 ? desc->strip_rows
                        : share < 4          ? 4
                        : share > 64         ? 64
                                             : share;
}

/* ---------------------------------------------------------------- compiling */

static const cs_antialias *antialias_of(const cs_frame *frame, size_t index) {
  return frame->has_antialias ? &frame->antialias : &frame->rostrums[index]->antialias;
}

/* Draws the exposures from maps that suit. */
static celspan_status find_drawings(celspan_context *context, const cs_frame *frame) {
  for (size_t i = 0; i < frame->count; i++) {
    const celspan_rostrum *other = frame->count > 1 ? frame->rostrums[i > 0 ? i - 1 : 1] : NULL;
    CS_TRY(cs_drawings_create(context, frame->rostrums[i], other, &frame->view,
                              antialias_of(frame, i), frame->repeats, &frame->maps[i]));
  }
  return CELSPAN_OK;
}

celspan_status cs_frame_compile(celspan_context *context, const cs_frame *frame,
                                const cs_view *view, int workers, cs_plan *plans,
                                bool *is_crowded) {
  cs_view rest = *view;
  *is_crowded = false;
  for (size_t i = 0; i < frame->count && !*is_crowded; i++) {
    const celspan_rostrum *rostrum = frame->rostrums[i];
    if (cs_drawings_are_enough(&frame->maps[i]))
      continue;
    CS_TRY(cs_compile(context, rostrum, &rest, antialias_of(frame, i), workers, &plans[i]));
    rest.most_dashes -= plans[i].dash_count;
    *is_crowded = plans[i].is_crowded;
  }
  return CELSPAN_OK;
}

void cs_frame_free_plans(const cs_frame *frame, cs_plan *plans, cs_memory *memory) {
  for (size_t i = 0; plans && i < frame->count; i++) {
    cs_compile_free(&plans[i], memory);
    plans[i] = (cs_plan){0};
  }
}

static void set_view(cs_frame *frame, const celspan_frame_desc *desc) {
  bool has_film = desc->film_width != 0;
  int32_t end_row = frame->crop_y + frame->crop_height;
  frame->view = (cs_view){.film_width = has_film ? desc->film_width : desc->width,
                          .film_height = has_film ? desc->film_height : desc->height,
                          .width = desc->width,
                          .height = desc->height,
                          .first_row = frame->crop_y > 0 ? frame->crop_y : 0,
                          .end_row = end_row < desc->height ? end_row : desc->height,
                          .end_column = desc->width,
                          .most_dashes = CS_COMPILE_DASHES,
                          .span_error = desc->has_tolerance ? (float)desc->tolerance : 0,
                          .space = cs_space_inside(desc->space, CELSPAN_SPACE_LINEAR)};
}

/* How far the pixel filter of an exposure reads beyond the frame, in film units. */
static double margin_of(const cs_frame *frame, const celspan_rostrum *rostrum) {
  const cs_view *view = &frame->view;
  const cs_antialias *antialias = frame->has_antialias ? &frame->antialias : &rostrum->antialias;
  return antialias->mode == CELSPAN_ANTIALIAS_FILTER
             ? (antialias->radius + 1) *
                   fmax(view->film_width / view->width, view->film_height / view->height)
             : 0;
}

/* The exposures of a weight above 0. */
static celspan_status set_rostrums(celspan_context *context, const celspan_frame_desc *desc,
                                   cs_frame *frame) {
  const cs_view *view = &frame->view;
  for (size_t i = 0; i < desc->exposure_count; i++)
    if (desc->exposures[i].weight != 0) {
      celspan_rostrum *rostrum = desc->exposures[i].rostrum;
      CS_TRY(cs_rostrum_shown(context, rostrum, view->film_width, view->film_height,
                              margin_of(frame, rostrum), view->space,
                              &frame->rostrums[frame->count]));
      frame->weights[frame->count++] = (float)desc->exposures[i].weight;
    }
  return CELSPAN_OK;
}

static celspan_status set_exposures(celspan_context *context, const celspan_frame_desc *desc,
                                    cs_frame *frame) {
  CS_TRY(CS_ARRAY_MAKE(context, frame->plans, desc->exposure_count));
  CS_TRY(CS_ARRAY_MAKE(context, frame->maps, desc->exposure_count));
  CS_TRY(CS_ARRAY_MAKE(context, frame->weights, desc->exposure_count));
  CS_TRY(CS_ARRAY_MAKE(context, frame->rostrums, desc->exposure_count));
  frame->repeats = desc->repeats;
  frame->has_antialias = desc->has_antialias;
  if (desc->has_antialias)
    CS_TRY(cs_antialias_make(context, "frame: antialias", desc->antialias, desc->filter,
                             &frame->antialias));
  return set_rostrums(context, desc, frame);
}

static celspan_status fill_frame(celspan_context *context, const celspan_frame_desc *desc,
                                 cs_frame *frame) {
  CS_TRY(set_exposures(context, desc, frame));
  CS_TRY(find_drawings(context, frame));
  CS_TRY(cs_frame_compile(context, frame, &frame->view, cs_frame_workers(context, desc->workers),
                          frame->plans, &frame->is_crowded));
  choose_workers(context, frame, desc);
  if (frame->is_crowded)
    cs_frame_free_plans(frame, frame->plans, context->memory);
  return CELSPAN_OK;
}

celspan_status cs_frame_check(celspan_context *context, const celspan_frame_desc *desc) {
  CS_TRY(check_size(context, desc));
  CS_TRY(check_crop(context, desc));
  if (desc->has_tolerance)
    CS_TRY(cs_check_item(context, (cs_check_field){"frame", "tolerance", 0, ""}, desc->tolerance,
                         1.0 / 1048576, 1));
  CS_TRY(cs_check_choice(context, "frame", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  return check_exposures(context, desc);
}

celspan_status cs_frame_create(celspan_context *context, const celspan_frame_desc *desc,
                               cs_frame *out) {
  CS_TRY(cs_frame_check(context, desc));
  cs_frame frame = {0};
  set_crop(&frame, desc);
  set_view(&frame, desc);
  celspan_status status = fill_frame(context, desc, &frame);
  if (status == CELSPAN_OK)
    *out = frame;
  else
    cs_frame_free(&frame, context->memory);
  return status;
}

celspan_status cs_frame_queue_row(celspan_context *context, const cs_frame *frame, int32_t y,
                                  const cs_row *row, cs_row_queue *out) {
  const cs_coder *coder = frame->coder;
  unsigned char *codes;
  if (!coder)
    return cs_row_queue_add(context, out, row->spans, row->count);
  int32_t width = frame->crop_width;
  size_t size = (size_t)width * cs_pixels_size(&coder->coding);
  CS_TRY(cs_row_queue_codes(context, out, width, size, &codes));
  cs_coder_row(coder, y, row->spans, row->count, codes);
  return CELSPAN_OK;
}

void cs_frame_free(cs_frame *frame, cs_memory *memory) {
  cs_frame_free_plans(frame, frame->plans, memory);
  for (size_t i = 0; frame->maps && i < frame->count; i++)
    cs_drawings_finish(&frame->maps[i], memory);
  for (size_t i = 0; i < frame->count; i++)
    celspan_rostrum_unref(frame->rostrums[i]);
  cs_antialias_free(&frame->antialias, memory);
  CS_ARRAYS_FREE(memory, frame, plans, rostrums);
  *frame = (cs_frame){0};
}
