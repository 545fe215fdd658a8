/* rlottie: the frames of a Lottie animation into memory, with times as in lottie.lua.
 *
 *   bench_rlottie FILE WIDTH HEIGHT FRAMES
 *
 * It sums the processor time of all threads that rlottie starts. */
#include <rlottie_capi.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void draw(Lottie_Animation *animation, uint32_t *pixels, size_t width, size_t height,
                 size_t frames) {
  double total = (double)lottie_animation_get_totalframe(animation);
  for (size_t i = 0; i < frames; i++)
    lottie_animation_render(animation, (size_t)((double)i * total / (double)frames), pixels, width,
                            height, 4 * width);
}

int main(int argc, char **argv) {
  if (argc != 5)
    return 2;
  size_t width = strtoul(argv[2], NULL, 10), height = strtoul(argv[3], NULL, 10);
  size_t frames = strtoul(argv[4], NULL, 10);
  Lottie_Animation *animation = lottie_animation_from_file(argv[1]);
  uint32_t *pixels = calloc(width * height, sizeof *pixels);
  if (!animation || !pixels || frames == 0)
    return 1;
  draw(animation, pixels, width, height, frames);
  double wall = seconds(CLOCK_MONOTONIC), processor = seconds(CLOCK_PROCESS_CPUTIME_ID);
  draw(animation, pixels, width, height, frames);
  wall = (seconds(CLOCK_MONOTONIC) - wall) / (double)frames;
  processor = (seconds(CLOCK_PROCESS_CPUTIME_ID) - processor) / (double)frames;
  printf("wall %.9f best_wall %.9f processor %.9f best_processor %.9f runs 1\n", wall, wall,
         processor, processor);
  free(pixels);
  lottie_animation_destroy(animation);
  return 0;
}
