/* Following a region through frames.
 *
 *   first frame          this frame
 *   +-----------+        +-----------+     1  a guess of the motion: what the last two frames say
 *   |  +-----+  |        |     __--+ |     2  each corner's patch, bent by the guess, is found near
 *   |  |. . .|  |   ->   |   +- .  / |        where the guess puts it, from coarse to fine
 *   |  |. . .|  |        |  / . . /  |     3  the motion that most of them agree on; 2 and 3 again
 *   |  +-----+  |        | +--___/   |        with it, finely
 *   +-----------+        +-----------+     4  each patch found is sought in the first frame again:
 *                                             what does not come back is left out
 *
 * Where that fails, some patches are searched for all around the last place, and the motion that
 * these agree on is the guess.
 *
 * INVARIANT: patches come from the first frame all the way, so that errors do not add up.
 */
#include <math.h>
#include <string.h>

#include "celspan/track.h"
#include "inside/description.h"
#include "inside/number.h"
#include "tools/track/grey.h"
#include "tools/track/motion.h"
#include "tools/track/patch.h"

CS_DESCRIBE(celspan_tracker_desc, region, )

enum { LEAST_REGION = 2 * CS_PATCH_RADIUS, MOST_SIDE = 1 << 16 };

/* the radius is in pixels of the coarsest level */
enum { SEARCHED_CORNERS = 60, SEARCH_RADIUS = 14 };

#define LEAST_LIKENESS 0.8     /* between a patch and the place where it is found */
#define LEAST_FAR_LIKENESS 0.6 /* the least likeness after a search over larger distances */
#define COARSE_TOLERANCE 3.0 /* pixels: the greatest distance of a corner from the common motion */
#define FINE_TOLERANCE 1.0
/* pixels between a corner and the place to which the search in the other direction leads */
#define FARTHEST_BACK 0.5
#define LEAST_SHARE 0.2 /* the least share of the corners in the frame that must agree */
#define MOST_ERROR 0.6  /* pixels: the greatest error of the corners that agree */

struct celspan_tracker {
  celspan_context *context;
  celspan_motion model;
  cs_grey_levels first;
  size_t count; /* the count of corners */
  celspan_point corners[CS_FEATURES_MOST];
  cs_patch *patches[CS_GREY_LEVELS];               /* by level, `count` of each */
  bool is_patch[CS_GREY_LEVELS][CS_FEATURES_MOST]; /* whether there is a patch at that level */
  /* the motions of the last two frames in which the region was found */
  celspan_matrix last, before_last;
};

/* ---------------------------------------------------------------- corners in a frame */

/* The place of a patch of level `level` around a corner under a motion, with the slopes of the
 * motion there. */
static bool place_patch(const celspan_matrix *matrix, celspan_point corner, int32_t level,
                        cs_patch_place *out) {
  const double *m = matrix->m;
  celspan_point there;
  if (!cs_motion_apply(matrix, corner, &there))
    return false;
  double w = m[6] * corner.x + m[7] * corner.y + m[8];
  *out = (cs_patch_place){.x = cs_grey_down(there.x, level),
                          .y = cs_grey_down(there.y, level),
                          .a = (m[0] - there.x * m[6]) / w,
                          .b = (m[1] - there.x * m[7]) / w,
                          .c = (m[3] - there.y * m[6]) / w,
                          .d = (m[4] - there.y * m[7]) / w};
  double size = fabs(out->a * out->d - out->b * out->c);
  return size > 0.04 && size < 25;
}

/* Finds a corner's patch from level `coarsest` down to level 0. place: before the call, a guess at
 * level 0; after it, the place that was found. */
static bool find_corner(const celspan_tracker *tracker, const cs_grey_levels *frame, size_t i,
                        int32_t coarsest, cs_patch_place *place) {
  double likeness = 0;
  for (int32_t level = coarsest; level >= 0; level--) {
    if (level >= frame->count || level >= tracker->first.count || !tracker->is_patch[level][i])
      continue;
    cs_patch_place there = *place;
    there.x = cs_grey_down(place->x, level);
    there.y = cs_grey_down(place->y, level);
    likeness = 0;
    bool is_found =
        cs_patch_find(&tracker->patches[level][i], &frame->levels[level], &there, &likeness);
    if (!is_found && level == 0)
      return false;
    if (!is_found || likeness < 0.5)
      continue;
    place->x = cs_grey_up(there.x, level);
    place->y = cs_grey_up(there.y, level);
  }
  return likeness >= LEAST_LIKENESS;
}

/* Whether the search in the other direction leads back to the corner: the pixels that were found
 * are searched for in the first frame, from an equally distant guess. */
static bool comes_back(const celspan_tracker *tracker, const cs_grey_levels *frame, size_t i,
                       const cs_patch_place *guess, const cs_patch_place *found) {
  double determinant = found->a * found->d - found->b * found->c;
  cs_patch_place back = {.a = found->d / determinant,
                         .b = -found->b / determinant,
                         .c = -found->c / determinant,
                         .d = found->a / determinant};
  double dx = guess->x - found->x, dy = guess->y - found->y;
  celspan_point corner = tracker->corners[i];
  cs_patch_place square = {found->x, found->y, 1, 0, 0, 1};
  back.x = corner.x + back.a * dx + back.b * dy;
  back.y = corner.y + back.c * dx + back.d * dy;
  cs_patch patch;
  double likeness;
  return cs_patch_take(&frame->levels[0], &square, &patch) &&
         cs_patch_find(&patch, &tracker->first.levels[0], &back, &likeness) &&
         cs_number_length(back.x - corner.x, back.y - corner.y) <= FARTHEST_BACK;
}

/* The pairs of corners and their places in the frame. in_frame: the number of corners that the
 * motion moves into the frame. */
static size_t find_pairs(const celspan_tracker *tracker, const cs_grey_levels *frame,
                         const celspan_matrix *motion, int32_t coarsest, bool is_checked,
                         cs_motion_pair *pairs, size_t *in_frame) {
  const cs_grey *grey = &frame->levels[0];
  size_t count = 0;
  *in_frame = 0;
  for (size_t i = 0; i < tracker->count; i++) {
    cs_patch_place guess, place;
    if (!place_patch(motion, tracker->corners[i], 0, &guess))
      continue;
    *in_frame += guess.x >= CS_PATCH_RADIUS && guess.x < grey->width - CS_PATCH_RADIUS &&
                 guess.y >= CS_PATCH_RADIUS && guess.y < grey->height - CS_PATCH_RADIUS;
    place = guess;
    if (!find_corner(tracker, frame, i, coarsest, &place) ||
        (is_checked && !comes_back(tracker, frame, i, &guess, &place)))
      continue;
    pairs[count++] = (cs_motion_pair){tracker->corners[i], {place.x, place.y}, false};
  }
  return count;
}

/* ---------------------------------------------------------------- a frame */

/* Moves a guess to the place of the pairs as a whole: turned and scaled, but without perspective,
 * which would need more exact places. */
static bool move_guess(const celspan_tracker *tracker, const cs_motion_pair *found, size_t count,
                       double tolerance, celspan_matrix *guess) {
  cs_motion_pair pairs[CS_FEATURES_MOST];
  cs_motion_verdict verdict;
  celspan_motion model = tracker->model;
  for (size_t i = 0; i < count; i++) {
    pairs[i] = found[i];
    if (!cs_motion_apply(guess, found[i].from, &pairs[i].from))
      return false;
  }
  if (model == CELSPAN_MOTION_PERSPECTIVE)
    model = CELSPAN_MOTION_SIMILARITY;
  if (!cs_motion_agree(model, pairs, count, tolerance, &verdict))
    return false;
  *guess = celspan_matrix_then(*guess, verdict.matrix);
  return true;
}

/* The motion, found from a guess; false if it is not reliable. */
static bool follow_guess(const celspan_tracker *tracker, const cs_grey_levels *frame,
                         celspan_matrix guess, celspan_sighting *out) {
  cs_motion_pair pairs[CS_FEATURES_MOST];
  cs_motion_verdict verdict;
  size_t in_frame;
  size_t count = find_pairs(tracker, frame, &guess, CS_GREY_LEVELS - 1, false, pairs, &in_frame);
  if (!move_guess(tracker, pairs, count, COARSE_TOLERANCE, &guess))
    return false;
  for (int32_t coarsest = 1; coarsest >= 0; coarsest--) {
    count = find_pairs(tracker, frame, &guess, coarsest, true, pairs, &in_frame);
    if (!cs_motion_agree(tracker->model, pairs, count, FINE_TOLERANCE, &verdict))
      return false;
    guess = verdict.matrix;
  }
  *out = (celspan_sighting){.is_found = true,
                            .matrix = verdict.matrix,
                            .corner_count = (uint32_t)tracker->count,
                            .agreeing_count = (uint32_t)verdict.agreeing,
                            .error = verdict.error};
  return (double)verdict.agreeing >= LEAST_SHARE * (double)in_frame && verdict.error <= MOST_ERROR;
}

/* Searches for some corners around their guessed places, and moves the guess there. */
static bool search_around(const celspan_tracker *tracker, const cs_grey_levels *frame,
                          celspan_matrix *guess) {
  cs_motion_pair pairs[SEARCHED_CORNERS];
  const int32_t level = (frame->count < tracker->first.count ? frame : &tracker->first)->count - 1;
  size_t count = 0;
  for (size_t i = 0; i < tracker->count && count < SEARCHED_CORNERS; i++) {
    cs_patch_place place;
    double likeness;
    if (!tracker->is_patch[level][i] || !place_patch(guess, tracker->corners[i], level, &place))
      continue;
    cs_patch_search(&tracker->patches[level][i], &frame->levels[level], SEARCH_RADIUS, &place,
                    &likeness);
    celspan_point there = {cs_grey_up(place.x, level), cs_grey_up(place.y, level)};
    if (likeness >= LEAST_FAR_LIKENESS)
      pairs[count++] = (cs_motion_pair){tracker->corners[i], there, false};
  }
  return move_guess(tracker, pairs, count, 2.0 * (double)(1 << level), guess);
}

/* The next motion, if the movement between the last two frames continues. */
static celspan_matrix continued(const celspan_tracker *tracker) {
  celspan_matrix back;
  if (!celspan_matrix_inverse(tracker->before_last, &back))
    return tracker->last;
  return celspan_matrix_then(celspan_matrix_then(tracker->last, back), tracker->last);
}

static bool follow_guesses(const celspan_tracker *tracker, const cs_grey_levels *frame,
                           celspan_sighting *out) {
  celspan_matrix far_off = tracker->last;
  return follow_guess(tracker, frame, continued(tracker), out) ||
         follow_guess(tracker, frame, tracker->last, out) ||
         (search_around(tracker, frame, &far_off) && follow_guess(tracker, frame, far_off, out));
}

static void follow(celspan_tracker *tracker, const cs_grey_levels *frame, celspan_sighting *out) {
  if (follow_guesses(tracker, frame, out)) {
    tracker->before_last = tracker->last;
    tracker->last = out->matrix;
    return;
  }
  *out = (celspan_sighting){.corner_count = (uint32_t)tracker->count};
  tracker->before_last = tracker->last; /* it waits at the place where it was found last */
}

/* ---------------------------------------------------------------- the public face */

static celspan_status check_luma(celspan_context *context, const celspan_luma *luma) {
  if (!luma || !luma->values || luma->width < 1 || luma->height < 1 || luma->width > MOST_SIDE ||
      luma->height > MOST_SIDE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "track: a frame must have values and be 1 to %d pixels wide and high",
                   MOST_SIDE);
  for (size_t i = 0; i < (size_t)luma->width * (size_t)luma->height; i++)
    if (!isfinite(luma->values[i]))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "track: the value of pixel %zu is not finite",
                     i);
  return CELSPAN_OK;
}

static int32_t held(double at, int32_t size) { return at < 0 ? 0 : at > size ? size : (int32_t)at; }

static celspan_status check_region(celspan_context *context, const celspan_tracker_desc *desc,
                                   const celspan_luma *luma, cs_features_region *out) {
  const celspan_box *box = &desc->region;
  if ((unsigned)desc->model > CELSPAN_MOTION_PERSPECTIVE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "track: model %d does not exist",
                   (int)desc->model);
  if (!isfinite(box->x) || !isfinite(box->y))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "track: the region's place is not finite");
  if (!(box->width >= LEAST_REGION && box->height >= LEAST_REGION))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "track: the region is %g x %g pixels; it must be %d x %d or larger", box->width,
                   box->height, LEAST_REGION, LEAST_REGION);
  *out = (cs_features_region){held(floor(box->x), luma->width), held(floor(box->y), luma->height),
                              held(ceil(box->x + box->width), luma->width),
                              held(ceil(box->y + box->height), luma->height), desc->mask};
  if (out->x1 - out->x0 < LEAST_REGION || out->y1 - out->y0 < LEAST_REGION)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "track: of the region %d x %d pixels lie in the frame of %d x %d; %d x %d or "
                   "more must",
                   (int)(out->x1 - out->x0), (int)(out->y1 - out->y0), (int)luma->width,
                   (int)luma->height, LEAST_REGION, LEAST_REGION);
  return CELSPAN_OK;
}

/* The number of levels for which the region is at least a few patches wide on the coarsest one. */
static int32_t levels_for(const cs_features_region *region) {
  int32_t width = region->x1 - region->x0, height = region->y1 - region->y0, count = 1;
  for (int32_t side = width < height ? width : height;
       count < CS_GREY_LEVELS && side / 2 >= CS_PATCH_SIDE; side /= 2)
    count++;
  return count;
}

static void take_level(celspan_tracker *tracker, int32_t level) {
  for (size_t i = 0; i < tracker->count; i++) {
    cs_patch_place place = {cs_grey_down(tracker->corners[i].x, level),
                            cs_grey_down(tracker->corners[i].y, level),
                            1,
                            0,
                            0,
                            1};
    tracker->is_patch[level][i] =
        cs_patch_take(&tracker->first.levels[level], &place, &tracker->patches[level][i]);
  }
}

static celspan_status take_patches(celspan_tracker *tracker) {
  celspan_context *context = tracker->context;
  for (int32_t level = 0; level < tracker->first.count; level++) {
    CS_TRY(CS_MAKE(context, tracker->patches[level], tracker->count));
    take_level(tracker, level);
  }
  return CELSPAN_OK;
}

static celspan_status fill(celspan_tracker *tracker, const celspan_luma *luma,
                           const celspan_tracker_desc *desc) {
  celspan_context *context = tracker->context;
  cs_features_region region;
  CS_TRY(check_luma(context, luma));
  CS_TRY(check_region(context, desc, luma, &region));
  CS_TRY(cs_grey_levels_make(context, luma->values, luma->width, luma->height, levels_for(&region),
                             &tracker->first));
  CS_TRY(cs_features_find(context, &tracker->first.levels[0], &region, tracker->corners,
                          &tracker->count));
  if (tracker->count < cs_motion_least(desc->model))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "track: the region has too little texture: %zu corners were found, and %zu are "
                   "needed; take a larger one, or one with more contrast",
                   tracker->count, cs_motion_least(desc->model));
  return take_patches(tracker);
}

celspan_status celspan_tracker_create(celspan_context *context, const celspan_luma *first,
                                      const celspan_tracker_desc *desc, celspan_tracker **out) {
  CS_READ(context, "track", celspan_tracker_desc, desc);
  *out = NULL;
  celspan_tracker *tracker;
  CS_TRY(CS_MAKE(context, tracker, 1));
  tracker->context = context;
  tracker->model = desc->model;
  tracker->last = tracker->before_last = celspan_matrix_identity();
  celspan_status status = fill(tracker, first, desc);
  return CS_GIVE(status, tracker, celspan_tracker_destroy, out);
}

celspan_status celspan_tracker_follow(celspan_tracker *tracker, const celspan_luma *frame,
                                      celspan_sighting *out) {
  celspan_context *context = tracker->context;
  celspan_sighting found = {0};
  CS_TRY(CS_RESULT(context, "track", celspan_sighting, &found, out));
  CS_TRY(check_luma(context, frame));
  const cs_grey *first = &tracker->first.levels[0];
  if (frame->width != first->width || frame->height != first->height)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "track: the frame has %d x %d pixels, and the first one %d x %d", frame->width,
                   frame->height, first->width, first->height);
  cs_grey_levels levels;
  CS_TRY(cs_grey_levels_make(context, frame->values, frame->width, frame->height,
                             tracker->first.count, &levels));
  follow(tracker, &levels, &found);
  cs_grey_levels_finish(&levels);
  return CS_RESULT(context, "track", celspan_sighting, &found, out);
}

void celspan_tracker_rewind(celspan_tracker *tracker) {
  tracker->last = tracker->before_last = celspan_matrix_identity();
}

void celspan_tracker_destroy(celspan_tracker *tracker) {
  if (!tracker)
    return;
  cs_memory *memory = tracker->context->memory;
  for (int32_t level = 0; level < CS_GREY_LEVELS; level++)
    cs_mem_free(memory, tracker->patches[level], tracker->count * sizeof(cs_patch));
  cs_grey_levels_finish(&tracker->first);
  cs_mem_free(memory, tracker, sizeof *tracker);
}
