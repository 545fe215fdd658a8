/* How often the pictures of a movie are decoded, and that they are the same in any order. ffmpeg
 * makes the movie and decodes it in a worker, of which this program is the zygote. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "plugins/footage/movie.h"
#include "plugins/isolate/isolate.h"
#include "plugins/isolate/zygote.h"
#include "tests/support/check.h"

enum { PICTURES = 96, WIDTH = 64, HEIGHT = 36, SIZE = WIDTH * HEIGHT * 3 / 2 };

#define MAKE                                                                                       \
  "ffmpeg -v error -y -f lavfi -i testsrc2=s=64x36:r=24:d=4 -c:v libx264 -pix_fmt yuv420p -g 12 "  \
  "-bf 2 -f mp4 "

/* Sees all pictures, with a step between two places. Returns the number of those that were decoded.
 * Their planes are written into `planes`, or compared with it. */
static uint64_t see(celspan_context *context, const char *path, int step, unsigned char *planes,
                    bool compares) {
  cs_movie *movie;
  cs_decode_picture *picture;
  if (!CHECK(cs_movie_open(context, path, NULL, &movie) == CELSPAN_OK))
    return 0;
  CHECK(movie->listing.count == PICTURES);
  for (int i = 0; i < PICTURES; i++) {
    size_t place = (size_t)(i * step % PICTURES);
    if (!CHECK(cs_decode_get(&movie->decode, context, place, &picture) == CELSPAN_OK))
      break;
    if (compares)
      CHECK(memcmp(planes + place * SIZE, picture->planes, SIZE) == 0);
    else
      memcpy(planes + place * SIZE, picture->planes, SIZE);
    cs_decode_release(context, picture);
  }
  uint64_t decoded = movie->decode.decoded;
  cs_movie_unref(movie);
  return decoded;
}

static void check_orders(celspan_context *context, const char *path, unsigned char *planes) {
  uint64_t sequential = see(context, path, 1, planes, false);
  CHECK(sequential == PICTURES);
  cs_context_trim(context);
  uint64_t scattered = see(context, path, 37, planes, true);
  printf("decoded: %llu in their order, %llu in any\n", (unsigned long long)sequential,
         (unsigned long long)scattered);
  CHECK(scattered > PICTURES && scattered <= 3 * PICTURES);
}

int main(int count, char **arguments) {
  if (cs_zygote_is_meant(count, arguments))
    cs_zygote_run(count, arguments);
  char path[] = "/tmp/celspan-footage-XXXXXX", command[256];
  if (system("ffmpeg -version >/dev/null 2>&1") != 0) {
    check_skip("there is no ffmpeg");
    return check_done();
  }
  int file = mkstemp(path);
  celspan_context *context;
  snprintf(command, sizeof command, MAKE "%s", path);
  unsigned char *planes = malloc((size_t)PICTURES * SIZE);
  const celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  if (CHECK(planes && system(command) == 0) &&
      CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK)) {
    cs_isolate_begin(context, &(cs_worker_limits){.seconds = 20});
    check_orders(context, path, planes);
    celspan_context_destroy(context);
    cs_isolate_finish();
  }
  free(planes);
  close(file);
  unlink(path);
  return check_done();
}
