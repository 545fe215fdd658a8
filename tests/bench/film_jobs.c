#include "film_jobs.h"

#include <stdlib.h>
#include <string.h>

#include "drawing.h"
#include "film.h"
#include "measure.h"
#include "scene.h"

typedef struct film_job {
  bench_frame_job *job;
  celspan_cel *cels[BENCH_FILM_CELS]; /* in the unit square */
  int step;
} film_job;

/* A frame's rostrum: the cels in their places, which a film of 1 x 1 has as they are. */
static celspan_rostrum *set_up(const film_job *film, int number) {
  celspan_context *context = film->job->context;
  celspan_cel *placed[BENCH_FILM_CELS];
  for (int i = 0; i < BENCH_FILM_CELS; i++) {
    bench_place place = bench_film_place(number, i);
    celspan_matrix matrix = celspan_matrix_then(celspan_matrix_scaling(place.scale, place.scale),
                                                celspan_matrix_translation(place.x, place.y));
    bench_check(context, celspan_cel_transform(context, film->cels[i], &matrix, &placed[i]));
  }
  celspan_rostrum *rostrum = bench_rostrum(context, placed, BENCH_FILM_CELS, true);
  for (int i = 0; i < BENCH_FILM_CELS; i++)
    celspan_cel_unref(placed[i]);
  return rostrum;
}

static void draw_frame(const film_job *film, int number) {
  celspan_rostrum *rostrum = set_up(film, number);
  film->job->exposure.rostrum = rostrum;
  bench_job_render(film->job);
  film->job->exposure.rostrum = NULL;
  celspan_rostrum_unref(rostrum);
}

static void draw_film(void *user) {
  const film_job *film = user;
  for (int number = 0; number < BENCH_FILM_FRAMES; number += film->step)
    draw_frame(film, number);
}

static void look(const film_job *film) {
  celspan_rostrum *rostrum = set_up(film, BENCH_FILM_FRAMES / 2);
  film->job->exposure.rostrum = rostrum;
  bench_job_look(film->job);
  celspan_rostrum_unref(rostrum);
}

static void read_cels(film_job *film, char **words) {
  for (int i = 0; i < BENCH_FILM_CELS; i++) {
    bench_drawing drawing = bench_drawing_read(words[i]);
    film->cels[i] = bench_cel(film->job->context, &drawing, NULL);
    bench_drawing_free(&drawing);
  }
}

void bench_film(bench_frame_job *job, int count, char **words) {
  if (count != 7 || atoi(words[4]) < 1)
    bench_stop("film SHEET MIDDLE FRONT SIDE STEP first|again OUTPUT");
  film_job film = {.job = job, .step = atoi(words[4])};
  int side = atoi(words[3]), frames = (BENCH_FILM_FRAMES + film.step - 1) / film.step;
  bench_part one_frame = {.scale = 1.0 / frames};
  read_cels(&film, words);
  bench_job_open(job, side, side, "again", words[6], 1);
  bench_cost begun = bench_spent();
  draw_film(&film);
  if (strcmp(words[5], "first") == 0)
    bench_tell_cost(bench_since(begun), one_frame);
  else
    bench_measure_part(draw_film, &film, one_frame);
  if (job->pixels)
    look(&film);
  for (int i = 0; i < BENCH_FILM_CELS; i++)
    celspan_cel_unref(film.cels[i]);
}
