#include "plugins/moving/moving.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/markup.h"

/* ---------------------------------------------------------------- formats */

static const struct {
  const char *name;
  const cs_moving_format *format; /* NULL: its library is missing */
  const char *lacks;
} formats[] = {
#ifdef CELSPAN_WITH_AVIF
    {CS_PICTURE_AVIF, &cs_moving_avif, ""},
#else
    {CS_PICTURE_AVIF, NULL, "this celspan was built without libavif; build it with -Davif=enabled"},
#endif
#ifdef CELSPAN_WITH_WEBP
    {CS_PICTURE_WEBP, &cs_moving_webp, ""},
#else
    {CS_PICTURE_WEBP, NULL, "this celspan was built without libwebp; build it with -Dwebp=enabled"},
#endif
};

enum { FORMATS = sizeof formats / sizeof *formats };

static size_t find(const char *name) {
  size_t i = 0;
  while (i < FORMATS && strcmp(formats[i].name, name) != 0)
    i++;
  return i;
}

bool cs_moving_has(const cs_picture_output *output) { return find(output->format) < FORMATS; }

/* ---------------------------------------------------------------- failures */

celspan_status cs_moving_fail(const cs_moving *moving, cs_picture_failure *failure,
                              celspan_status status, const char *what) {
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s: %s", moving->output.name, what);
  return status;
}

celspan_status cs_moving_put(const cs_moving *moving, uint64_t offset, const void *bytes,
                             size_t size, cs_picture_failure *failure) {
  return moving->output.put(moving->output.user, offset, bytes, size)
             ? CELSPAN_OK
             : cs_moving_fail(moving, failure, CELSPAN_OUTPUT, "cannot be written");
}

/* ---------------------------------------------------------------- metadata */

/* XMP: https://developer.adobe.com/xmp/docs/ */
static char *make_metadata(const cs_picture_output *output) {
  static const char head[] =
      "<?xpacket begin='\xef\xbb\xbf' id='W5M0MpCehiHzreSzNTczkc9d'?><x:xmpmeta "
      "xmlns:x='adobe:ns:meta/'><rdf:RDF "
      "xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'><rdf:Description rdf:about='' "
      "xmlns:xmp='http://ns.adobe.com/xap/1.0/' xmlns:dc='http://purl.org/dc/elements/1.1/'>"
      "<xmp:CreatorTool>",
                    maker_end[] = "</xmp:CreatorTool>",
                    title[] = "<dc:title><rdf:Alt><rdf:li xml:lang='x-default'>",
                    end[] = "</rdf:li></rdf:Alt></dc:title>",
                    tail[] = "</rdf:Description></rdf:RDF></x:xmpmeta><?xpacket end='r'?>";
  size_t texts = strlen(output->software) + (output->title ? strlen(output->title) : 0);
  char *made = malloc(sizeof head + sizeof maker_end + sizeof title + sizeof end + sizeof tail +
                      CS_MARKUP_MOST * texts);
  if (!made)
    return NULL;
  char *at = stpcpy(cs_markup_put(stpcpy(made, head), output->software), maker_end);
  if (output->title)
    at = stpcpy(cs_markup_put(stpcpy(at, title), output->title), end);
  stpcpy(at, tail);
  return made;
}

/* ---------------------------------------------------------------- the file */

static celspan_status prepare(cs_moving *moving, const cs_picture_output *output,
                              cs_picture_failure *failure) {
  size_t at = find(output->format);
  moving->output = *output;
  moving->format = formats[at].format;
  if (!moving->format)
    return cs_moving_fail(moving, failure, CELSPAN_OUTPUT, formats[at].lacks);
  moving->row = (size_t)output->width * 4 * (output->depth == CELSPAN_DEPTH_16 ? 2 : 1);
  moving->name = strdup(output->name);
  moving->metadata = make_metadata(output);
  moving->pixels = malloc(moving->row * (size_t)output->height);
  if (!moving->name || !moving->metadata || !moving->pixels)
    return cs_moving_fail(moving, failure, CELSPAN_NO_MEMORY, "out of memory");
  celspan_status status = moving->format->open(moving, failure);
  moving->output.name = moving->name;
  moving->output.title = NULL;
  return status;
}

celspan_status cs_moving_open(const cs_picture_output *output, cs_moving **out,
                              cs_picture_failure *failure) {
  cs_moving *moving = calloc(1, sizeof *moving);
  if (!moving)
    return cs_moving_fail(&(cs_moving){.output = *output}, failure, CELSPAN_NO_MEMORY,
                          "out of memory");
  celspan_status status = prepare(moving, output, failure);
  return CS_GIVE(status, moving, cs_moving_abandon, out);
}

static celspan_status take(cs_moving *moving, cs_picture_failure *failure) {
  moving->rows = 0;
  return moving->format->take(moving, failure);
}

celspan_status cs_moving_rows(cs_moving *moving, int32_t count, const void *rows,
                              cs_picture_failure *failure) {
  const unsigned char *from = rows;
  for (int32_t done = 0; done < count;) {
    int32_t room = moving->output.height - moving->rows,
            part = count - done < room ? count - done : room;
    memcpy(moving->pixels + (size_t)moving->rows * moving->row, from + (size_t)done * moving->row,
           (size_t)part * moving->row);
    moving->rows += part;
    done += part;
    celspan_status status =
        moving->rows == moving->output.height ? take(moving, failure) : CELSPAN_OK;
    if (status != CELSPAN_OK)
      return status;
  }
  return CELSPAN_OK;
}

celspan_status cs_moving_close(cs_moving *moving, cs_picture_failure *failure) {
  celspan_status status = moving->rows > 0 ? cs_moving_fail(moving, failure, CELSPAN_BAD_ARGUMENT,
                                                            "a picture ends before its last row")
                                           : moving->format->end(moving, failure);
  cs_moving_abandon(moving);
  return status;
}

void cs_moving_abandon(cs_moving *moving) {
  if (moving->self)
    moving->format->destroy(moving->self);
  free(moving->pixels);
  free(moving->metadata);
  free(moving->name);
  free(moving);
}
