/* frames/film/shoot.c without any script: frames are reported in order, with the same result
 * whatever the number of workers; equal frames are copied; a frame that fails ends the run unless
 * the run keeps going. */
#include "frames/film/shoot.h"

#include "base/context.h"
#include "tests/support/scene.h"

enum { FRAMES = 12, SCENES = 5, NOWHERE = -1 };

typedef struct run {
  studio *scenes;
  int fails_at; /* a frame, or NOWHERE */
  bool goes_on;
  int reported, copied, failed;
  uint64_t digests[FRAMES][2];
  int faults; /* frames that were reported out of order */
} run;

/* Frame n shows scene n modulo SCENES. */
static celspan_status build(void *user, int64_t number, cs_film_frame *out) {
  const run *r = user;
  if (number == r->fails_at)
    return celspan_context_fail(r->scenes->context, CELSPAN_CALLBACK, "out of ink");
  celspan_exposure exposure = {r->scenes->rostrums[number % SCENES], 1};
  return cs_film_frame_init(out, r->scenes->context, &exposure, 1);
}

static celspan_status finished(void *user, const cs_shoot_frame *frame, celspan_status status) {
  run *r = user;
  r->faults += frame->number != r->reported++;
  if (status != CELSPAN_OK) {
    r->failed++;
    CHECK_TEXT(celspan_context_error(r->scenes->context), "out of ink");
    return r->goes_on ? CELSPAN_OK : status;
  }
  r->copied += frame->way == CS_SHOOT_COPIED;
  memcpy(r->digests[frame->number], frame->digest, sizeof frame->digest);
  return CELSPAN_OK;
}

static celspan_frame_desc small_frame(void) {
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.film_width = frame.width = 32;
  frame.film_height = frame.height = 24;
  return frame;
}

static celspan_status shoot(run *r, int workers, bool keeps_nothing) {
  int64_t numbers[FRAMES];
  for (int i = 0; i < FRAMES; i++)
    numbers[i] = i;
  const cs_sequence frames = {.frames = numbers, .count = FRAMES};
  cs_shoot job = {.context = r->scenes->context,
                  .film = {.width = 32, .height = 24, .frames_second = 24, .count = FRAMES},
                  .frames = &frames,
                  .frame = small_frame(),
                  .file = CELSPAN_FILE_DESC,
                  .has_digests = true,
                  .keeps_going = r->goes_on,
                  .keeps_nothing = keeps_nothing,
                  .user = r,
                  .build = build,
                  .finished = finished};
  job.frame.workers = workers;
  return cs_shoot_run(&job);
}

/* Every frame that did not fail has the digest that its scene has by itself. */
static void check_digests(const run *r) {
  for (int i = 0; i < FRAMES; i++) {
    uint64_t digest[2];
    celspan_exposure exposure = {r->scenes->rostrums[i % SCENES], 1};
    celspan_frame_desc frame = small_frame();
    frame.exposures = &exposure;
    frame.exposure_count = 1;
    studio_check(r->scenes, celspan_frame_digest(r->scenes->context, &frame, NULL, digest));
    CHECK(i == r->fails_at || memcmp(digest, r->digests[i], sizeof digest) == 0);
  }
}

static void check_whole_runs(studio *s) {
  for (int workers = 1; workers <= 4; workers++)
    for (int keeps_nothing = 0; keeps_nothing < 2; keeps_nothing++) {
      run r = {.scenes = s, .fails_at = NOWHERE};
      CHECK(shoot(&r, workers, keeps_nothing) == CELSPAN_OK);
      CHECK(r.reported == FRAMES && r.faults == 0 && r.failed == 0);
      CHECK(r.copied == (keeps_nothing ? 0 : FRAMES - SCENES));
      check_digests(&r);
    }
}

static void check_failed_frames(studio *s) {
  for (int workers = 1; workers <= 4; workers++) {
    run ended = {.scenes = s, .fails_at = 3};
    CHECK(shoot(&ended, workers, false) == CELSPAN_CALLBACK);
    CHECK(ended.reported == 4 && ended.faults == 0 && ended.failed == 1);
    run whole = {.scenes = s, .fails_at = 3, .goes_on = true};
    CHECK(shoot(&whole, workers, false) == CELSPAN_OK);
    CHECK(whole.reported == FRAMES && whole.faults == 0 && whole.failed == 1);
    CHECK(whole.copied == FRAMES - SCENES - 1); /* frame 8 is the first of its scene */
    check_digests(&whole);
  }
}

int main(void) {
  studio s = {.context = NULL};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_texture *texture = studio_paint(&s, celspan_paint_rgb(1, 0.5, 0.25, 1));
  for (int i = 0; i < SCENES; i++)
    studio_show(&s, studio_circle(&s, 16, 12, 3 + i, texture));
  check_whole_runs(&s);
  check_failed_frames(&s);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  return check_done();
}
