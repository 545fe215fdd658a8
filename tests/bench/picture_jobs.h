/* Jobs of celspan with pictures. Each takes the words after its verb and leaves its line open.
 *
 *   picture JOB FOLDER OUTPUT      a raster job (pictures.h) on the files of FOLDER
 *   backed PICTURE SAMPLING SIDE OUTPUT FRONT [FILE]
 *       FRONT, a drawing (.txt) or a picture, over PICTURE, each as large as the frame; `-`: none
 *   planes FOLDER OUTPUT           twelve pictures, turned and clipped, each at a depth of its own
 *
 * The pictures are decoded before anything is measured.
 */
#pragma once

#include "frames.h"

void bench_picture(bench_frame_job *job, int count, char **words);
void bench_backed(bench_frame_job *job, int count, char **words);
void bench_planes(bench_frame_job *job, int count, char **words);
