/* The chapters of a video: the film's marks, as ffmpeg reads them.
 *
 *   marks      title 1, fight 49              the frame where each begins
 *   chapters   0 ms - 2000 ms - the end       from the first frame that is played
 *
 * The text is a format of ffmpeg, ffmetadata: https://ffmpeg.org/ffmpeg-formats.html#Metadata-1
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/utf8.h"
#include "program/outputs/video_target.h"

enum {
  MOST_BYTES = 120000, /* of an argument of a program, which Linux limits to 131,072 */
  MOST_NAME = 200      /* bytes of a title */
};

/* Copies a name, with a backslash before each character that has a meaning. */
static void write_name(const char *name, char out[2 * MOST_NAME + 1]) {
  size_t taken = cs_utf8_cut(name, MOST_NAME), length = 0;
  for (size_t i = 0; i < taken; i++) {
    if (strchr("=;#\\\n", name[i]))
      out[length++] = '\\';
    out[length++] = name[i];
  }
  out[length] = '\0';
}

/* Writes one chapter; returns its bytes, or 0 if it has no frames or there is no room. */
static size_t write_chapter(const char *name, double begin, double end, char *out, size_t size) {
  char title[2 * MOST_NAME + 1];
  if (end <= begin)
    return 0;
  write_name(name, title);
  int length = snprintf(out, size, "[CHAPTER]\nTIMEBASE=1/1000\nSTART=%.0f\nEND=%.0f\ntitle=%s\n",
                        round(begin * 1000), round(end * 1000), title);
  return length > 0 && (size_t)length < size ? (size_t)length : 0;
}

/* The frame where the next chapter begins, at most `end`. */
static int64_t next_begin(const cs_film_info *film, size_t mark, int64_t end) {
  for (size_t i = mark + 1; i < film->mark_count; i++)
    if (film->marks[i].frame > film->marks[mark].frame)
      return film->marks[i].frame < end ? film->marks[i].frame : end;
  return end;
}

static void write_chapters(const cs_film_info *film, int64_t first, int64_t end, char *out) {
  size_t length = (size_t)snprintf(out, MOST_BYTES, "data:text/plain,;FFMETADATA1\n");
  for (size_t i = 0; i < film->mark_count; i++) {
    int64_t begin = film->marks[i].frame > first ? film->marks[i].frame : first;
    int64_t stop = next_begin(film, i, end);
    length += write_chapter(film->marks[i].name, (double)(begin - first) / film->frames_second,
                            (double)(stop - first) / film->frames_second, out + length,
                            MOST_BYTES - length);
    out[length] = '\0';
  }
}

celspan_status cs_chapters_make(const cs_script *script, const cs_sequence *played, char **out) {
  const cs_film_info *film = &script->film;
  *out = NULL;
  if (film->mark_count == 0 || !cs_sequence_is_run(played))
    return CELSPAN_OK;
  *out = cs_mem_array(script->context->memory, MOST_BYTES, 1);
  if (!*out)
    return cs_fail_memory(script->context);
  write_chapters(film, played->frames[0], played->frames[played->count - 1] + 1, *out);
  return CELSPAN_OK;
}

void cs_chapters_free(const cs_script *script, char *chapters) {
  cs_mem_free(script->context->memory, chapters, MOST_BYTES);
}
