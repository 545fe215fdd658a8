/* A video with a limit of bytes: the rate factor is found by encoding the master again and again.
 *
 *   rate factor   best ... 18 ... 24 25 ... worst        a greater factor makes a smaller file
 *   bytes         too many |     too many| fits          two neighbours: the right one is taken
 *
 * The size falls by half in about HALVING factors. So the next try is where the size would fit if
 * this were exact, and the neighbours are found after three or four tries. What does not depend on
 * the factor, such as sound, makes this wrong: after GUESSES tries the middle of what is left is
 * tried. Where noise takes most bytes, a whole step may leave much room: factors between the two
 * neighbours are then tried, if the encoder has some. A constant factor gives every frame the same
 * quality, and needs no record of a first pass.
 */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "video/video.h"

#define HALVING 6.0 /* steps of 51 in which the size halves; more if an encoder has more */
#define GUESSES 3
#define FULL 0.9 /* a file of this share of the limit is not made again */
#define FINER 3  /* times that the distance of the neighbours is halved */

typedef struct search {
  const cs_video *video;
  const char *master, *name;
  double over, fits; /* the greatest factor known to be over the limit, the least that fits */
  double made;       /* the factor of the file as it is */
  double bytes;      /* size of that file */
  double most_bytes; /* the most bytes of the files that fit; 0: none yet */
  int tries;
} search;

static celspan_status encode(search *s, double crf) {
  const cs_video *video = s->video;
  cs_video_options options = video->options;
  cs_arguments command;
  struct stat about;
  options.has_crf = true;
  options.crf = (int32_t)ceil(crf);
  options.crf_less = ceil(crf) - crf;
  cs_video_command_repeat(&command, video->format, &options, video->has_sound, s->master,
                          &video->extras, s->name);
  CS_TRY(cs_encoder_run(video->context, video->path, command.list));
  if (stat(s->name, &about) != 0)
    return cs_fail(video->context, CELSPAN_OUTPUT, "%s: cannot be read back: %s", video->path,
                   strerror(errno));
  s->made = crf;
  s->bytes = (double)about.st_size;
  return CELSPAN_OK;
}

static celspan_status try_factor(search *s, double crf) {
  CS_TRY(encode(s, crf));
  s->tries++;
  if (s->bytes > (double)s->video->most_bytes) {
    s->over = crf;
  } else {
    s->fits = crf;
    s->most_bytes = s->bytes;
  }
  return CELSPAN_OK;
}

/* Fills the room that the least whole factor leaves. */
static celspan_status try_finer(search *s) {
  bool is_fine = s->video->options.codec->has_fine_crf;
  for (int i = 0; is_fine && i < FINER && s->most_bytes < FULL * (double)s->video->most_bytes; i++)
    CS_TRY(try_factor(s, (s->over + s->fits) / 2));
  return CELSPAN_OK;
}

/* A factor between the two that are known, or one of the ends of the scale. */
static double next(const search *s) {
  const cs_video_codec *codec = s->video->options.codec;
  if (s->tries >= GUESSES)
    return s->over + floor((s->fits - s->over) / 2);
  double ratio = s->bytes / (double)s->video->most_bytes;
  double step = ceil(log2(ratio) * HALVING * codec->most_crf / 51);
  return fmax(s->over + 1, fmin(s->fits - 1, s->made + step));
}

celspan_status cs_video_limit(const cs_video *video, const char *master, const char *name) {
  const cs_video_codec *codec = video->options.codec;
  int32_t worst = codec->most_crf;
  search s = {
      .video = video, .master = master, .name = name, .over = codec->best - 1, .fits = worst + 1};
  double crf = round((codec->best + codec->worst) / 2);
  while (s.fits - s.over > 1) {
    CS_TRY(try_factor(&s, crf));
    crf = next(&s);
  }
  if (s.fits > worst)
    return cs_fail(video->context, CELSPAN_OUTPUT,
                   "%s: has %.0f bytes at the lowest quality, and may have %.0f: give a smaller "
                   "--size, fewer frames or a larger --max-size",
                   video->path, s.bytes, (double)video->most_bytes);
  if (s.over >= codec->best)
    CS_TRY(try_finer(&s));
  return s.made < s.fits || s.made > s.fits ? encode(&s, s.fits) : CELSPAN_OK;
}
