/* The readers of option values: which values they accept, what these mean, and that a field stays
 * unchanged when a value is refused. */
#include <stdlib.h>

#include "program/options/argument.h"
#include "tests/support/check.h"
#include "writers/tiles/pyramid.h"

enum { FIELD_SIZE = 1024 };

typedef struct field {
  _Alignas(max_align_t) unsigned char bytes[FIELD_SIZE];
} field;

static bool reads(const cs_argument *kind, const char *text, field *out) {
  memset(out, 0, sizeof *out);
  return cs_argument_read(kind, text, out);
}

/* ---------------------------------------------------------------- refusals */

/* texts: separated by '|'; each of them must be refused. */
static void refuse(const char *what, const cs_argument *kind, const char *texts) {
  char text[512];
  for (const char *at = texts, *end; at; at = *end ? end + 1 : NULL) {
    end = at + strcspn(at, "|");
    snprintf(text, sizeof text, "%.*s", (int)(end - at), at);
    field before, after;
    memset(&before, 0x5a, sizeof before);
    /* Options that may be given several times are added to a list. */
    if (kind == &cs_argument_limits || kind == &cs_argument_picture_limits ||
        kind == &cs_argument_texts)
      memset(&before, 0, sizeof before);
    after = before;
    if (!CHECK(!cs_argument_read(kind, text, &after)) ||
        !CHECK(memcmp(&before, &after, sizeof before) == 0))
      fprintf(stderr, "  %s: '%s'\n", what, text);
  }
}
#define REFUSE(name, texts) refuse(#name, &cs_argument_##name, texts)

static void what_is_no_value_is_refused(void) {
  REFUSE(text, "");
  REFUSE(texts, "");
  REFUSE(integer, "| 1|\t1|1 |x|1x|1.0|99999999999999999999|2147483648|-2147483648");
  REFUSE(every, "|0|-1|one");
  REFUSE(count, "|-1|1k");
  REFUSE(memory, "|-1|1048577|1G");
  REFUSE(plays, "|-1|65536|x");
  REFUSE(quality, "|-1|101|50%");
  REFUSE(workers, "|0|1025|2.5");
  REFUSE(grid, "|6|6x|x4|6x4x2|0x4|6x101|6*4");
  REFUSE(onion, "|0,0|1|1,|17,1|1,17|-1,1|1,2,3");
  REFUSE(share, "|1|1/|0/4|5/4|1/4/4|/4");
  REFUSE(task, "|1|5/4|env|env/|env/0|env/4x|environment");
  REFUSE(size, "|4|0x4|4x0|4x1048577|4x4x4| 4x4|4x 4|4 x4");
  REFUSE(crop, "|1,2,3|0,0,0,4|0,0,4,0|-1,0,4,4|0,0,4,4,4");
  REFUSE(rows, "|1|5-2|1-1048576|-1-2|1-2-3");
  REFUSE(scale, "|0|-1|nan|1048577|1x");
  REFUSE(tolerance, "|-0.1|nan|inf|x");
  REFUSE(smooth, "|-0.1|16.1|nan|x");
  REFUSE(antialias, "|areas|area:4|box:|box:0|box:257|box:x|:4|a-name-of-sixteen:4");
  REFUSE(depth, "|12|32|Half|");
  REFUSE(colour, "");
  REFUSE(alpha, "|Straight|none");
  REFUSE(layout, "|DZI|zoom");
  REFUSE(progress, "|yes|JSON");
  REFUSE(model, "|affine|Perspective");
  REFUSE(tint, "|redd|#12|#11223380|1,1,1");
}

static void limits_are_known_and_finite(void) {
  REFUSE(limits,
         "|memory|memory=|memory=x|memory=-1|memory=1T|memory=1KK|memory=1K,|,time=1"
         "|time=1K|time=1e7|steps=1e16|steps=nan|print= 1|print=\t1|picture-time=1e7|heap=1");
  REFUSE(limits, "memory=1e15K|picture-memory=1e13G");
  REFUSE(picture_limits, "|memory=1|time=1|picture-memory=|picture-time=1,steps=1");
}

/* ---------------------------------------------------------------- arrays of farms */

/* One array at a time: the variables of the others are not set. */
static void set_array(const char *index, const char *first, const char *last, const char *step) {
  setenv("SLURM_ARRAY_TASK_ID", index, 1);
  setenv("SLURM_ARRAY_TASK_MIN", first, 1);
  setenv("SLURM_ARRAY_TASK_MAX", last, 1);
  setenv("SLURM_ARRAY_TASK_STEP", step, 1);
}

static bool is_task(const char *text, int32_t number, int32_t count) {
  field f;
  const int32_t *task = (const int32_t *)(void *)f.bytes;
  return reads(&cs_argument_task, text, &f) && task[0] == number && task[1] == count;
}

static void a_task_is_found_in_the_environment(void) {
  CHECK(is_task("3/24", 3, 24));
  set_array("5", "1", "9", "2");
  CHECK(is_task("env", 3, 5));
  CHECK(is_task("env/7", 3, 7));
  REFUSE(task, "env/2"); /* there are fewer than the number of this task */
  set_array("0", "0", "3", "1");
  CHECK(is_task("env", 1, 4));
  set_array("0", "1", "3", "1");
  REFUSE(task, "env");
  set_array("x", "1", "3", "1");
  REFUSE(task, "env");
  unsetenv("SLURM_ARRAY_TASK_ID");
  setenv("SGE_TASK_ID", "undefined", 1); /* outside an array */
  REFUSE(task, "env");
  setenv("SGE_TASK_ID", "20", 1);
  setenv("SGE_TASK_FIRST", "10", 1);
  setenv("SGE_TASK_LAST", "40", 1);
  setenv("SGE_TASK_STEPSIZE", "10", 1);
  CHECK(is_task("env", 2, 4));
  unsetenv("SGE_TASK_ID");
  setenv("AWS_BATCH_JOB_ARRAY_INDEX", "2", 1);
  setenv("AWS_BATCH_JOB_ARRAY_SIZE", "3", 1);
  CHECK(is_task("env", 3, 3));
  unsetenv("AWS_BATCH_JOB_ARRAY_INDEX");
  setenv("JOB_COMPLETION_INDEX", "0", 1);
  REFUSE(task, "env"); /* Kubernetes does not say how many there are */
  CHECK(is_task("env/6", 1, 6));
  unsetenv("JOB_COMPLETION_INDEX");
}

/* ---------------------------------------------------------------- values */

static void numbers_are_what_they_say(void) {
  field f;
  const int32_t *whole = (const void *)f.bytes;
  const double *real = (const void *)f.bytes;
  CHECK(reads(&cs_argument_integer, "-2147483647", &f) && whole[0] == -INT32_MAX);
  CHECK(reads(&cs_argument_every, "1", &f) && whole[0] == 1);
  CHECK(reads(&cs_argument_count, "0", &f) && whole[0] == 0);
  CHECK(reads(&cs_argument_memory, "1048576", &f) && whole[0] == 1048576);
  CHECK(reads(&cs_argument_quality, "100", &f) && whole[0] == 100);
  CHECK(reads(&cs_argument_workers, "1024", &f) && whole[0] == 1024);
  CHECK(reads(&cs_argument_grid, "6x4", &f) && whole[0] == 6 && whole[1] == 4);
  CHECK(reads(&cs_argument_onion, "0,16", &f) && whole[0] == 0 && whole[1] == 16);
  CHECK(reads(&cs_argument_share, "24/24", &f) && whole[0] == 24 && whole[1] == 24);
  CHECK(reads(&cs_argument_size, "1x1048576", &f) && whole[0] == 1 && whole[1] == CS_SIDE_MAX);
  CHECK(reads(&cs_argument_crop, "1,2,3,4", &f) && whole[0] == 1 && whole[3] == 4);
  CHECK(reads(&cs_argument_rows, "7-7", &f) && whole[0] == 7 && whole[1] == 7);
  CHECK(reads(&cs_argument_scale, "1048576", &f) && real[0] == CS_SIDE_MAX);
  CHECK(reads(&cs_argument_tolerance, "0", &f) && real[0] == 0);
  CHECK(reads(&cs_argument_smooth, "16", &f) && real[0] == 16);
}

static void names_are_what_they_say(void) {
  field f;
  const int *value = (const void *)f.bytes;
  const cs_given_antialias *antialias = (const void *)f.bytes;
  CHECK(reads(&cs_argument_depth, "half", &f) && *value == CELSPAN_DEPTH_HALF);
  CHECK(reads(&cs_argument_alpha, "premultiplied", &f) && *value == CELSPAN_ALPHA_PREMULTIPLIED);
  CHECK(reads(&cs_argument_layout, "iiif", &f) && *value == CS_PYRAMID_IIIF);
  CHECK(reads(&cs_argument_progress, "openjd", &f) && *value == CS_PROGRESS_OPENJD);
  CHECK(reads(&cs_argument_antialias, "none", &f) && antialias->mode == CELSPAN_ANTIALIAS_NONE);
  CHECK(reads(&cs_argument_antialias, "lanczos", &f) && antialias->filter.rows == 16 &&
        antialias->mode == CELSPAN_ANTIALIAS_FILTER);
  CHECK(reads(&cs_argument_antialias, "mitchell:256", &f) && antialias->filter.rows == 256 &&
        antialias->filter.kernel == CELSPAN_KERNEL_MITCHELL);
  CHECK(reads(&cs_argument_model, "translation", &f) && *value == 0);
  CHECK(reads(&cs_argument_model, "similarity", &f) && *value == 1);
  CHECK(reads(&cs_argument_model, "perspective", &f) && *value == 2);
}

static void colours_are_what_they_say(void) {
  field f;
  const float *tint = (const void *)f.bytes;
  CHECK(reads(&cs_argument_tint, "red", &f) && tint[0] == 1 && tint[1] == 0 && tint[2] == 0);
  CHECK(reads(&cs_argument_tint, "#0000ff", &f) && tint[0] == 0 && tint[2] == 1);
}

static void limits_are_what_they_say(void) {
  field f;
  const cs_given_limits *limits = (const void *)f.bytes;
  const double *values = limits->values;
  CHECK(reads(&cs_argument_limits,
              "memory=1.5K,steps=2e9,time=0,print=1M,picture-memory=2G,picture-time=0.5", &f));
  CHECK(limits->has[CS_LIMIT_MEMORY] && values[CS_LIMIT_MEMORY] == 1536);
  CHECK(limits->has[CS_LIMIT_STEPS] && values[CS_LIMIT_STEPS] == 2e9);
  CHECK(limits->has[CS_LIMIT_TIME] && values[CS_LIMIT_TIME] == 0);
  CHECK(limits->has[CS_LIMIT_PRINT] && values[CS_LIMIT_PRINT] == 1 << 20);
  CHECK(limits->has[CS_LIMIT_PICTURE_MEMORY] && values[CS_LIMIT_PICTURE_MEMORY] == 0x1p31);
  CHECK(limits->has[CS_LIMIT_PICTURE_TIME] && values[CS_LIMIT_PICTURE_TIME] == 0.5);
  CHECK(cs_argument_read(&cs_argument_limits, "time=7", &f) && values[CS_LIMIT_TIME] == 7 &&
        values[CS_LIMIT_MEMORY] == 1536);
  CHECK(reads(&cs_argument_picture_limits, "picture-time=1", &f) &&
        limits->has[CS_LIMIT_PICTURE_TIME] && !limits->has[CS_LIMIT_TIME]);
}

static void texts_are_kept_in_order(void) {
  field f;
  cs_given_texts *texts = (void *)f.bytes;
  CHECK(reads(&cs_argument_text, "a b", &f) && strcmp(*(const char **)(void *)f.bytes, "a b") == 0);
  memset(&f, 0, sizeof f);
  CHECK(cs_argument_read(&cs_argument_texts, "a", texts));
  CHECK(cs_argument_read(&cs_argument_texts, "b", texts) && texts->count == 2);
  CHECK_TEXT(texts->items[1], "b");
  while (texts->count < CS_TEXTS_MOST && cs_argument_read(&cs_argument_texts, "c", texts))
    continue;
  CHECK(texts->count == CS_TEXTS_MOST && !cs_argument_read(&cs_argument_texts, "d", texts));
}

int main(void) {
  _Static_assert(sizeof(cs_given_texts) <= FIELD_SIZE, "the largest field");
  what_is_no_value_is_refused();
  a_task_is_found_in_the_environment();
  limits_are_known_and_finite();
  numbers_are_what_they_say();
  names_are_what_they_say();
  colours_are_what_they_say();
  limits_are_what_they_say();
  texts_are_kept_in_order();
  return check_done();
}
