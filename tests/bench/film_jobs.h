/* The film of film.h, drawn by celspan. */
#pragma once

#include "frames.h"

/* SHEET MIDDLE FRONT SIDE STEP first|again OUTPUT: the mean of every STEPth frame, with the making
 * of its cels and its rostrum. again: the film was shown before, so that its maps are kept. first:
 * it is shown once, and makes them. OUTPUT: row or whole, which prints the picture's cells, too. */
void bench_film(bench_frame_job *job, int count, char **words);
