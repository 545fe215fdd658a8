/* How often the pictures of a movie are decoded, and that they are the same in any order. ffmpeg
 * makes the movie and decodes it in a worker, of which this program is the zygote. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "plugins/footage/movie.h"
#include "plugins/isolate/isolate.h"
#include "plugins/isolate/zygote.h"
#include "tests/support/check.h"

enum { PICTURES = 96, WIDTH = 64, HEIGHT = 36, SIZE = WIDTH * HEIGHT * 3 / 2, BYTES = 1 << 20 };

#define MAKE                                                                                       \
  "ffmpeg -v error -y -f lavfi -i testsrc2=s=64x36:r=24:d=4,noise=alls=40:allf=t "                 \
  "-pix_fmt yuv420p -threads 1 -c:v %s %s"

/* What decoding took. */
typedef struct effort {
  uint64_t pictures, workers;
} effort;

static celspan_context *context;
static char path[] = "/tmp/celspan-footage-XXXXXX";

static bool make(const char *coding) {
  char command[512];
  snprintf(command, sizeof command, MAKE, coding, path);
  return CHECK(system(command) == 0);
}

/* Sees all pictures, from `first` on with a step between two places. Their planes are written into
 * `planes`, or compared with it. */
static effort see(int first, int step, unsigned char *planes, bool compares) {
  cs_movie *movie;
  cs_decode_picture *picture;
  int differ = 0;
  cs_context_trim(context);
  if (!CHECK(cs_movie_open(context, path, NULL, &movie) == CELSPAN_OK))
    return (effort){0};
  CHECK(movie->listing.count == PICTURES);
  for (int i = 0; i < PICTURES; i++) {
    size_t place = (size_t)((first + i * step) % PICTURES);
    if (!CHECK(cs_decode_get(&movie->decode, context, place, &picture) == CELSPAN_OK))
      break;
    if (compares)
      differ += memcmp(planes + place * SIZE, picture->planes, SIZE) != 0;
    else
      memcpy(planes + place * SIZE, picture->planes, SIZE);
    cs_decode_release(context, picture);
  }
  CHECK(differ == 0);
  effort found = {movie->decode.decoded, movie->decode.begun};
  printf("%d pictures from %d in steps of %d: %llu decoded by %llu workers\n", PICTURES, first,
         step, (unsigned long long)found.pictures, (unsigned long long)found.workers);
  cs_movie_unref(movie);
  return found;
}

static void check_orders(unsigned char *planes) {
  if (!make("libx264 -g 12 -bf 2 -f mp4"))
    return;
  effort forwards = see(0, 1, planes, false);
  CHECK(forwards.pictures == PICTURES && forwards.workers == 1);
  effort scattered = see(0, 37, planes, true);
  CHECK(scattered.pictures > PICTURES && scattered.pictures <= 3 * PICTURES);
}

/* Pictures before the first one of a group need the group before. A worker that begins there says
 * words about them, which are no reason to begin at each group. */
static void check_open_groups(unsigned char *planes) {
  if (!make("libx264 -bf 3 -x264-params open-gop=1:keyint=12:scenecut=0 -f mp4"))
    return;
  effort forwards = see(0, 1, planes, false);
  CHECK(forwards.workers == 1);
  effort later = see(30, 1, planes, true);
  CHECK(later.workers <= 5);
  see(0, 37, planes, true);
  see(PICTURES - 1, PICTURES - 1, planes, true);
}

/* Changes the list of pictures where decoding can begin: its second entry, to `number`. */
static bool lie(unsigned char number) {
  static unsigned char bytes[BYTES];
  FILE *file = fopen(path, "r+b");
  size_t size = file ? fread(bytes, 1, BYTES, file) : 0, at = 0;
  while (at + 24 < size && memcmp(bytes + at, "stss", 4) != 0)
    at++;
  bool is_found = CHECK(at + 24 < size && bytes[at + 11] == 2);
  if (is_found) {
    fseek(file, (long)at + 19, SEEK_SET);
    fputc(number, file);
  }
  return (!file || fclose(file) == 0) && is_found;
}

/* The last part cannot be decoded from where it should: once a picture of it has come from the
 * beginning, the others do not begin there again. */
static void check_lies(unsigned char *planes, const char *damage) {
  char coding[128];
  snprintf(coding, sizeof coding, "ffv1 -g 48 -level 3 -slicecrc 1 %s -f mov", damage);
  if (!make(coding) || !lie(61))
    return;
  see(0, 1, planes, false);
  effort scattered = see(0, 37, planes, true);
  CHECK(scattered.pictures <= 6 * PICTURES && scattered.workers <= 12);
  effort backwards = see(PICTURES - 1, PICTURES - 1, planes, true);
  CHECK(backwards.pictures <= 6 * PICTURES && backwards.workers <= 12);
}

static void check_forms(void) {
  CHECK(cs_raw_is_foreign("xyz12le") && cs_raw_is_foreign("bayer_rggb8"));
  CHECK(!cs_raw_is_foreign("yuv420p") && !cs_raw_is_foreign("gbrp"));
}

int main(int count, char **arguments) {
  if (cs_zygote_is_meant(count, arguments))
    cs_zygote_run(count, arguments);
  if (system("ffmpeg -version >/dev/null 2>&1") != 0) {
    check_skip("there is no ffmpeg");
    return check_done();
  }
  check_forms();
  int file = mkstemp(path);
  unsigned char *planes = malloc((size_t)PICTURES * SIZE);
  const celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  if (CHECK(planes) && CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK)) {
    cs_isolate_begin(context, &(cs_worker_limits){.seconds = 20});
    check_orders(planes);
    check_open_groups(planes);
    check_lies(planes, "");
    check_lies(planes, "-bsf:v noise=amount=30000");
    celspan_context_destroy(context);
    cs_isolate_finish();
  }
  free(planes);
  close(file);
  unlink(path);
  return check_done();
}
