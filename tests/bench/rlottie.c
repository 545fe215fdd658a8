/* rlottie: the frames of a Lottie animation into memory, with times as in lottie.lua, or as files.
 *
 *   bench_rlottie FILE WIDTH HEIGHT FRAMES
 *   bench_rlottie show FILE OUT WIDTH HEIGHT FRAME...    over white, rows of RGBA: OUT.FRAME
 *
 * The first sums the processor time of all threads that rlottie starts. */
#include <rlottie_capi.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct canvas {
  Lottie_Animation *animation;
  uint32_t *pixels;
  size_t width, height;
} canvas;

static bool open_canvas(canvas *c, const char *file, const char *width, const char *height) {
  c->width = strtoul(width, NULL, 10), c->height = strtoul(height, NULL, 10);
  c->animation = lottie_animation_from_file(file);
  c->pixels = calloc(c->width * c->height, sizeof *c->pixels);
  return c->animation && c->pixels;
}

static void close_canvas(canvas *c) {
  free(c->pixels);
  if (c->animation)
    lottie_animation_destroy(c->animation);
}

static void draw(canvas *c, size_t frame) {
  lottie_animation_render(c->animation, frame, c->pixels, c->width, c->height, 4 * c->width);
}

/* ---------------------------------------------------------------- times */

static void draw_all(canvas *c, size_t frames) {
  double total = (double)lottie_animation_get_totalframe(c->animation);
  for (size_t i = 0; i < frames; i++)
    draw(c, (size_t)((double)i * total / (double)frames));
}

static void measure(canvas *c, size_t frames) {
  draw_all(c, frames);
  double wall = seconds(CLOCK_MONOTONIC), processor = seconds(CLOCK_PROCESS_CPUTIME_ID);
  draw_all(c, frames);
  wall = (seconds(CLOCK_MONOTONIC) - wall) / (double)frames;
  processor = (seconds(CLOCK_PROCESS_CPUTIME_ID) - processor) / (double)frames;
  printf("wall %.9f best_wall %.9f processor %.9f best_processor %.9f runs 1\n", wall, wall,
         processor, processor);
}

/* ---------------------------------------------------------------- files */

/* Premultiplied pixels over white, as bytes. */
static bool write_pixels(const canvas *c, FILE *file) {
  for (size_t i = 0; i < c->width * c->height; i++) {
    const uint32_t pixel = c->pixels[i], white = 255 - (pixel >> 24);
    const unsigned char bytes[] = {(unsigned char)((pixel >> 16 & 255) + white),
                                   (unsigned char)((pixel >> 8 & 255) + white),
                                   (unsigned char)((pixel & 255) + white), 255};
    if (fwrite(bytes, 1, sizeof bytes, file) != sizeof bytes)
      return false;
  }
  return true;
}

static bool show(canvas *c, const char *out, const char *frame) {
  char path[4096];
  snprintf(path, sizeof path, "%s.%s", out, frame);
  draw(c, strtoul(frame, NULL, 10));
  FILE *file = fopen(path, "wb");
  if (!file)
    return false;
  bool is_good = write_pixels(c, file);
  return fclose(file) == 0 && is_good;
}

int main(int argc, char **argv) {
  const bool shows = argc > 6 && strcmp(argv[1], "show") == 0;
  canvas c;
  if (!shows && argc != 5)
    return 2;
  const size_t frames = shows ? 1 : strtoul(argv[4], NULL, 10);
  if (frames == 0)
    return 2;
  char **const first = shows ? argv + 4 : argv + 2; /* the width */
  bool is_good = open_canvas(&c, argv[shows ? 2 : 1], first[0], first[1]);
  for (int i = 6; shows && is_good && i < argc; i++)
    is_good = show(&c, argv[3], argv[i]);
  if (is_good && !shows)
    measure(&c, frames);
  close_canvas(&c);
  return is_good ? 0 : 1;
}
