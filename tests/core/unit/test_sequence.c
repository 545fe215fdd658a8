/* Lists of frames and the names of their files: what lists mean, where they are wrong, and which
 * files match a pattern. */
#include <stdlib.h>
#include <unistd.h>

#include "frames/film/sequence.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

/* The frames of a list, separated by blanks, or the sentence of the refusal. */
static const char *read_list(celspan_context *context, const char *list, const cs_film_info *film,
                             char text[256]) {
  cs_sequence sequence = {0};
  size_t size = 0;
  if (cs_sequence_parse(context, list, film, &sequence) != CELSPAN_OK) {
    CHECK(sequence.count == 0 && !sequence.frames);
    return celspan_context_error(context);
  }
  text[0] = 0;
  for (size_t i = 0; i < sequence.count && size < 240; i++)
    size += (size_t)snprintf(text + size, 256 - size, "%s%lld", i ? " " : "",
                             (long long)sequence.frames[i]);
  cs_sequence_finish(&sequence);
  return text;
}

static bool is_same(const char *result, const char *wanted) { return strcmp(result, wanted) == 0; }

static bool contains(const char *result, const char *wanted) { return strstr(result, wanted); }

/* Pairs of a list and the expected frames or sentence. */
static void check_lists_of(celspan_context *context, const cs_film_info *film,
                           const char *const cases[][2], size_t count,
                           bool (*agrees)(const char *result, const char *wanted)) {
  char text[256];
  for (size_t i = 0; i < count; i++) {
    const char *result = read_list(context, cases[i][0], film, text);
    if (!CHECK(agrees(result, cases[i][1])))
      fprintf(stderr, "  '%s': '%s', not '%s'\n", cases[i][0], result, cases[i][1]);
  }
}

static void check_lists(celspan_context *context, const char *const cases[][2], size_t count,
                        bool (*agrees)(const char *result, const char *wanted)) {
  check_lists_of(context, NULL, cases, count, agrees);
}

static void lists_mean_frames(celspan_context *context) {
  static const char *const cases[][2] = {
      {"7", "7"},
      {"-7", "-7"},
      {" 1 , 3 ", "1 3"},
      {"1-4", "1 2 3 4"},
      {"-2--1", "-2 -1"},
      {"-1-1", "-1 0 1"},
      {"5-5", "5"},
      {"5-5:-3", "5"},
      {"1-9:3", "1 4 7"},
      {"9-1:-4", "9 5 1"},
      {"1\t-\t6 : 5,2", "1 6 2"},
      {"3,1,2", "3 1 2"},
      {"1000000000000", "1000000000000"},
  };
  check_lists(context, cases, sizeof cases / sizeof *cases, is_same);
}

static void lists_are_refused_where_they_are_wrong(celspan_context *context) {
  static const char *const cases[][2] = {
      {"", "a whole number is missing at character 1"},
      {"1,", "a whole number is missing at character 3"},
      {"1-", "a whole number is missing at character 3"},
      {"--1", "a whole number is missing at character 1"},
      {"1-4:", "a whole number is missing at character 5"},
      {"1-4:x", "a whole number is missing at character 5"},
      {"x", "a whole number is missing at character 1"},
      {"1.5", "an unexpected character at character 2"},
      {"1 2", "an unexpected character at character 3"},
      {"1-4:2:1", "an unexpected character at character 6"},
      {"1-4:0", "the step is 0"},
      {"4-1", "a range that goes down needs a step below 0"},
      {"4-1:2", "a range that goes down needs a step below 0"},
      {"1-4:-1", "a range that goes up needs a step above 0"},
      {"1-3,2", "frame 2 is listed twice"},
      {"5,-5,5", "frame 5 is listed twice"},
      {"1000000000001", "the number is too large"},
      {"1-99999999999999999999", "the number is too large"},
      {"1-10000001", "more than 10000000 frames in one list"},
      {"1-9999999,-1,-2", "more than 10000000 frames in one list"},
  };
  check_lists(context, cases, sizeof cases / sizeof *cases, contains);
}

static const cs_film_mark marks[] = {{.name = "title", .frame = 11},
                                     {.name = "the same", .frame = 11},
                                     {.name = "chase-2", .frame = 13},
                                     {.name = "part", .frame = 13, .last = 15, .has_last = true},
                                     {.name = "\xc3\xa9nd", .frame = 20}};

static void marks_and_times_mean_frames_of_a_film(celspan_context *context) {
  const cs_film_info film = {
      .frames_second = 2, .first = 11, .count = 11, .marks = marks, .mark_count = 5};
  static const char *const cases[][2] = {
      {"title", "11 12"},
      {"the same", "11 12"},
      {" chase-2 :3, title", "13 16 19 11 12"},
      {"\xc3\xa9nd", "20 21"},
      {"12,title:2", "12 11"},
      {"part", "13 14 15"},
      {"1s-2s", "13 14"},
      {"0s - 1.5s : 2", "11 13"},
      {"0.1s-0.6s", "12"},
      {"1s", "13"},
      {"1.2s", "13"},
      {"1.5s,0.49s", "14 11"},
      {"4.5s-5.5s,12", "20 21 12"},
  };
  check_lists_of(context, &film, cases, sizeof cases / sizeof *cases, is_same);
}

/* The time of frame n is n / fps in floating point, and as users write it in decimals. */
static void times_are_those_of_frames(celspan_context *context) {
  static const double rates[] = {24, 24000 / 1001., 25, 30000 / 1001., 60};
  for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
    const cs_film_info film = {.frames_second = rates[i], .count = 1000000};
    for (int index = 0; index < 3000; index += 7) {
      char list[64], text[256], wanted[32];
      snprintf(list, sizeof list, "%.9fs", index / rates[i] + 1e-6);
      snprintf(wanted, sizeof wanted, "%d", index);
      CHECK(is_same(read_list(context, list, &film, text), wanted));
    }
  }
}

static void frames_are_seen_at_times(void) {
  const cs_film_info film = {.frames_second = 2, .first = 11, .count = 11};
  static const char *const none[] = {"",      "2",  "5.5s", "-1s", "1s-2s", "99999999999999s",
                                     "title", "1.", " 1s",  "1s "};
  int64_t frame = 0;
  CHECK(cs_sequence_at_time(&film, "0s", &frame) && frame == 11);
  CHECK(cs_sequence_at_time(&film, "1.49s", &frame) && frame == 13);
  CHECK(cs_sequence_at_time(&film, "1.5s", &frame) && frame == 14);
  CHECK(cs_sequence_at_time(&film, "5.49s", &frame) && frame == 21);
  for (size_t i = 0; i < sizeof none / sizeof *none; i++)
    CHECK(!cs_sequence_at_time(&film, none[i], &frame));
}

static void marks_and_times_are_refused_where_they_are_wrong(celspan_context *context) {
  const cs_film_info film = {
      .frames_second = 2, .first = 11, .count = 11, .marks = marks, .mark_count = 5};
  const cs_film_info bare = {.frames_second = 2, .first = 1, .count = 3};
  static const char *const cases[][2] = {
      {"titel", "the film has no mark \"titel\"; its marks are title, the same, chase-2, "},
      {"title, ", "a whole number is missing at character 8"},
      {"title:0", "the step is 0"},
      {"title:-1", "a range that goes up needs a step above 0"},
      {"title,12", "frame 12 is listed twice"},
      {"1s-2", "a time such as 4s is missing at character 4"},
      {"1-2s", "an unexpected character at character 4"},
      {"2s-1s", "no frame begins between the two times"},
      {"0.1s-0.2s", "no frame begins between the two times"},
      {"2sec", "an unexpected character at character 2"},
      {"99999999999999s", "the time is too late"},
  };
  static const char *const of_none[][2] = {
      {"title", "no mark \"title\"; write numbers like 1-10,20-30:2, or seconds like 2s-4s"}};
  check_lists_of(context, &film, cases, sizeof cases / sizeof *cases, contains);
  check_lists_of(context, &bare, of_none, 1, contains);
}

static void frames_lie_within_a_film(celspan_context *context) {
  cs_sequence all;
  if (!CHECK(cs_sequence_count(context, -3, 5, &all) == CELSPAN_OK))
    return;
  CHECK(all.count == 5 && all.frames[0] == -3 && all.frames[4] == 1);
  CHECK(cs_sequence_within(context, &all, -3, 5) == CELSPAN_OK);
  CHECK(cs_sequence_within(context, &all, -2, 9) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "frame -3 is outside"));
  CHECK(cs_sequence_within(context, &all, -3, 4) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "frame 1 is outside"));
  cs_sequence_finish(&all);
  CHECK(cs_sequence_count(context, 1, 10000001, &all) == CELSPAN_LIMIT);
}

static void names_have_their_number_in_one_place(celspan_context *context) {
  static const struct {
    const char *pattern;
    int64_t frame;
    const char *name;
  } cases[] = {
      {"a.#.png", 7, "a.7.png"},
      {"a.####.png", 7, "a.0007.png"},
      {"a.##.png", 12345, "a.12345.png"},
      {"a.####.png", -7, "a.-007.png"},
      {"#/##/b.##.##", 3, "#/##/b.##.03"},
      {"a.%04d.png", 7, "a.0007.png"},
      {"a.%d.png", 7, "a.7.png"},
      {"%d.%x.%1234d.%", 7, "7.%x.%1234d.%"},
      {"a.%099d", 7, "a.00000000000000000007"},
      {"########################", 7, "00000000000000000007"},
      {"one.png", 7, "one.png"},
  };
  char name[64], small[4];
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    CHECK(cs_sequence_name(context, cases[i].pattern, cases[i].frame, name, sizeof name) ==
          CELSPAN_OK);
    CHECK_TEXT(name, cases[i].name);
    const char *slash = strrchr(cases[i].pattern, '/');
    CHECK(cs_sequence_matches(slash ? slash + 1 : cases[i].pattern,
                              slash ? strrchr(name, '/') + 1 : name));
  }
  CHECK(!cs_sequence_has_number("a/#/one.png") && cs_sequence_has_number("a/one.%3d"));
  CHECK(cs_sequence_name(context, "a.##.png", 1, small, sizeof small) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), "the file name \"a.##.png...\" is too long");
  static const char *const others[] = {"a.png",    "a..png",   "b.07.png",
                                       "a.07.exr", "a.x7.png", "a.07.png.part"};
  for (size_t i = 1; i < sizeof others / sizeof *others; i++)
    CHECK(cs_sequence_matches("a.##.png", others[i]) == (strcmp(others[i], "a..png") == 0));
  CHECK(!cs_sequence_matches("a.##.png", others[0]) && !cs_sequence_matches("one.png", "two.png"));
}

static void make(const char *folder, const char *name) {
  char path[256];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "w");
  if (CHECK(file))
    fclose(file);
}

static void files_are_found_by_their_pattern(celspan_context *context) {
  static const char *const names[] = {"a.0010.png", "a.0002.png",  "a.-001.png", "a.12345.png",
                                      "a.2.png",    "a.00002.png", "a. 002.png", "a.0003.exr",
                                      "b.0004.png", "a..png",      "a.png"};
  char folder[] = "/tmp/celspan-sequence-XXXXXX", pattern[256], path[256];
  cs_sequence found;
  if (!CHECK(mkdtemp(folder)))
    return;
  snprintf(pattern, sizeof pattern, "%s/a.####.png", folder);
  if (CHECK(cs_sequence_list(context, pattern, &found) == CELSPAN_OK))
    CHECK(found.count == 0);
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    make(folder, names[i]);
  if (CHECK(cs_sequence_list(context, pattern, &found) == CELSPAN_OK)) {
    static const int64_t frames[] = {-1, 2, 10, 12345};
    CHECK(found.count == 4 && memcmp(found.frames, frames, sizeof frames) == 0);
    cs_sequence_finish(&found);
  }
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    snprintf(path, sizeof path, "%s/%s", folder, names[i]);
    CHECK(unlink(path) == 0);
  }
  CHECK(rmdir(folder) == 0);
  CHECK(cs_sequence_list(context, pattern, &found) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "its folder cannot be read: No such file"));
  char *longest = malloc(9000);
  memset(longest, 'x', 9000);
  strcpy(longest + 8000, "/#.png");
  CHECK(cs_sequence_list(context, longest, &found) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "File name too long"));
  free(longest);
}

/* Each allocation of a list fails once: they are the context's, and all are given back. */
static void lists_use_the_memory_of_the_context(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  celspan_status status = CELSPAN_NO_MEMORY;
  cs_sequence sequence = {0};
  size_t blocks = watch.blocks, first = watch.allocations, failed = 0;
  for (; status == CELSPAN_NO_MEMORY && failed < 9; failed++) {
    watch.fail_at = watch.allocations + failed + 1;
    status = cs_sequence_parse(context, "1-9,20-90,200", NULL, &sequence);
    CHECK(status == CELSPAN_OK || (watch.blocks == blocks && !sequence.frames));
  }
  CHECK(status == CELSPAN_OK && failed >= 3 && watch.allocations > first && sequence.count == 81);
  cs_sequence_finish(&sequence);
  CHECK(watch.blocks == blocks && watch.size_errors == 0);
  celspan_context_destroy(context);
}

int main(void) {
  celspan_context *context;
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  lists_mean_frames(context);
  lists_are_refused_where_they_are_wrong(context);
  marks_and_times_mean_frames_of_a_film(context);
  times_are_those_of_frames(context);
  frames_are_seen_at_times();
  marks_and_times_are_refused_where_they_are_wrong(context);
  frames_lie_within_a_film(context);
  names_have_their_number_in_one_place(context);
  files_are_found_by_their_pattern(context);
  celspan_context_destroy(context);
  lists_use_the_memory_of_the_context();
  return check_done();
}
