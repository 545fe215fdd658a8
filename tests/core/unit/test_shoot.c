/* frames/film/shoot.c without any script: frames are reported in order, with the same result
 * whatever the number of workers; equal frames are copied; a frame that fails ends the run unless
 * the run keeps going. Streams have the same bytes for any number of slots. */
#include "frames/film/shoot.h"

#include "base/context.h"
#include "frames/film/slots.h"
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

/* ---------------------------------------------------------------- streams */

enum { MOST_SLOTS = 6, STEPS = 3 };
enum { WIDTH = 32, HEIGHT = 24, FRAME_BYTES = 4 * WIDTH * HEIGHT };

/* A stream whose frame fails at one of its steps. Frame n shows scene n / 2 modulo SCENES, so that
 * every second frame equals the one before it. */
typedef struct stream {
  studio *scenes;
  cs_slots slots;
  enum { BUILDING, MAKING, GIVING } step;
  int fails_at; /* a frame, or NOWHERE */
  bool goes_on;
  unsigned char bytes[FRAMES][FRAME_BYTES]; /* in the order in which they were given */
  int given, reported, repeated, failed, faults;
  int64_t in_slot[MOST_SLOTS]; /* the number of the frame that was made there */
} stream;

static celspan_status fail_at(const stream *t, celspan_context *context, int step, int64_t number) {
  if (number != t->fails_at || step != (int)t->step)
    return CELSPAN_OK;
  return celspan_context_fail(context, CELSPAN_CALLBACK, "out of ink");
}

static celspan_status build_stream(void *user, int64_t number, cs_film_frame *out) {
  const stream *t = user;
  CS_TRY(fail_at(t, t->scenes->context, BUILDING, number));
  celspan_exposure exposure = {t->scenes->rostrums[number / 2 % SCENES], 1};
  return cs_film_frame_init(out, t->scenes->context, &exposure, 1);
}

static celspan_status put_in_slot(void *user, const cs_shoot_put *one) {
  stream *t = user;
  cs_shoot_frame *frame = one->frame;
  CS_TRY(fail_at(t, one->context, MAKING, frame->number));
  t->in_slot[one->slot] = frame->number;
  frame->digest[0] = (uint64_t)(frame->number / 2);
  return celspan_frame_pixels(one->context, one->desc, NULL, t->slots.frames[one->slot],
                              (size_t)4 * WIDTH, NULL);
}

static celspan_status give_slot(void *user, size_t slot) {
  stream *t = user;
  CS_TRY(fail_at(t, t->scenes->context, GIVING, t->in_slot[slot]));
  memcpy(t->bytes[t->given++], t->slots.frames[slot], FRAME_BYTES);
  return CELSPAN_OK;
}

static celspan_status repeat_last(void *user) {
  stream *t = user;
  int64_t number = t->reported; /* of the next report */
  CS_TRY(fail_at(t, t->scenes->context, GIVING, number));
  t->repeated++;
  memcpy(t->bytes[t->given], t->bytes[t->given - 1], FRAME_BYTES);
  t->given++;
  return CELSPAN_OK;
}

static celspan_status finished_stream(void *user, const cs_shoot_frame *frame,
                                      celspan_status status) {
  stream *t = user;
  t->faults += frame->number != t->reported++;
  if (status == CELSPAN_OK) {
    t->faults += frame->digest[0] != (uint64_t)(frame->number / 2);
    return status;
  }
  const char *sentence = celspan_context_error(t->scenes->context);
  CHECK(t->step == BUILDING || strncmp(sentence, "frame ", 6) == 0);
  CHECK(strstr(sentence, "out of ink") != NULL);
  t->failed++;
  return t->goes_on ? CELSPAN_OK : status;
}

static celspan_status shoot_stream(stream *t, int workers, size_t slots, bool keeps_nothing) {
  int64_t numbers[FRAMES];
  for (int i = 0; i < FRAMES; i++)
    numbers[i] = i;
  const cs_sequence frames = {.frames = numbers, .count = FRAMES};
  cs_shoot job = {.context = t->scenes->context,
                  .film = {.width = WIDTH, .height = HEIGHT, .frames_second = 24, .count = FRAMES},
                  .frames = &frames,
                  .frame = small_frame(),
                  .file = CELSPAN_FILE_DESC,
                  .keeps_going = t->goes_on,
                  .keeps_nothing = keeps_nothing,
                  .user = t,
                  .build = build_stream,
                  .put = put_in_slot,
                  .slots = slots,
                  .give = give_slot,
                  .repeat = repeat_last,
                  .finished = finished_stream};
  job.frame.workers = workers;
  studio_check(t->scenes, cs_slots_open(&t->slots, t->scenes->context, slots, FRAME_BYTES));
  celspan_status status = cs_shoot_run(&job);
  cs_slots_close(&t->slots, t->scenes->context);
  return status;
}

/* The first frames that were given, without those that failed, are what they are by themselves. */
static void check_bytes(const stream *t) {
  int lost = t->fails_at != NOWHERE && t->goes_on ? t->fails_at : FRAMES;
  for (int i = 0; i < t->given; i++) {
    unsigned char pixels[FRAME_BYTES];
    int number = i < lost ? i : i + 1;
    celspan_exposure exposure = {t->scenes->rostrums[number / 2 % SCENES], 1};
    celspan_frame_desc frame = small_frame();
    frame.exposures = &exposure;
    frame.exposure_count = 1;
    studio_check(t->scenes, celspan_frame_pixels(t->scenes->context, &frame, NULL, pixels,
                                                 (size_t)4 * WIDTH, NULL));
    CHECK(memcmp(pixels, t->bytes[i], FRAME_BYTES) == 0);
  }
}

static void check_stream(studio *s, int workers, size_t slots) {
  for (int keeps_nothing = 0; keeps_nothing < 2; keeps_nothing++) {
    stream t = {.scenes = s, .fails_at = NOWHERE};
    CHECK(shoot_stream(&t, workers, slots, keeps_nothing) == CELSPAN_OK);
    CHECK(t.given == FRAMES && t.reported == FRAMES && t.faults == 0);
    CHECK(t.repeated == (keeps_nothing ? 0 : FRAMES / 2));
    check_bytes(&t);
  }
}

/* A failure at each frame and step ends the run: the frames before it were given, no others. */
static void check_failed_stream(studio *s, int workers, size_t slots) {
  for (int at = 0; at < FRAMES * STEPS; at++) {
    int number = at / STEPS;
    if (!check_is_drawn(at + workers + (int)slots))
      continue;
    stream t = {.scenes = s, .fails_at = number, .step = at % STEPS};
    celspan_status status = shoot_stream(&t, workers, slots, true);
    CHECK(status == CELSPAN_CALLBACK && t.failed == 1);
    CHECK(t.given == number && t.reported == number + 1 && t.faults == 0);
    check_bytes(&t);
  }
}

/* When the run continues, all others are given; the second of two equal frames is made where the
 * first has failed. */
static void check_kept_going(studio *s, int workers, size_t slots) {
  for (int at = 0; at < FRAMES * STEPS; at++) {
    int number = at / STEPS;
    if (!check_is_drawn(at + workers + (int)slots))
      continue;
    stream t = {.scenes = s, .fails_at = number, .step = at % STEPS, .goes_on = true};
    bool is_repeat = number % 2 == 1;
    t.fails_at = is_repeat && t.step == MAKING ? NOWHERE : number;
    CHECK(shoot_stream(&t, workers, slots, false) == CELSPAN_OK);
    int lost = t.fails_at == NOWHERE ? 0 : 1;
    CHECK(t.failed == lost && t.given == FRAMES - lost);
    CHECK(t.reported == FRAMES && t.faults == 0 && t.repeated == FRAMES / 2 - lost);
    check_bytes(&t);
  }
}

static void check_streams(studio *s) {
  for (int workers = 1; workers <= 4; workers++)
    for (size_t slots = 1; slots <= MOST_SLOTS; slots++) {
      check_stream(s, workers, slots);
      check_failed_stream(s, workers, slots);
      check_kept_going(s, workers, slots);
    }
}

/* Slots are as many as the caches leave room for, at least one, and never many. */
static void check_slot_counts(void) {
  const size_t budgets[] = {0, (size_t)1 << 20, (size_t)768 << 20};
  const size_t frame = (size_t)300 << 10;
  for (int i = 0; i < 3; i++) {
    celspan_context *context;
    celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
    desc.picture_bytes = budgets[i];
    desc.defocus_bytes = 0;
    CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
    size_t two = cs_slots_count(context, frame, 2), many = cs_slots_count(context, frame, 64);
    CHECK(cs_slots_count(context, frame, 1) == 1);
    CHECK(two == (i == 0 ? 1 : i == 1 ? 3 : 4) && many == (i == 0 ? 1 : i == 1 ? 3 : 66));
    cs_slots slots;
    CHECK(cs_slots_open(&slots, context, two, frame) == CELSPAN_OK);
    CHECK(cs_slots_count(context, frame, 64) == (i < 2 ? 1 : 66));
    CHECK(cs_account_scene_bytes(context->memory) < frame);
    cs_slots_close(&slots, context);
    CHECK(cs_slots_count(context, frame, 64) == many);
    celspan_context_destroy(context);
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
  check_streams(&s);
  check_slot_counts();
  studio_finish(&s);
  celspan_context_destroy(s.context);
  return check_done();
}
