/* The frame and its layers as pictures: x.0001.png, x.hand.0001.png, x.wall.0001.png. */
#include <stdio.h>
#include <string.h>

#include "writers/apart/apart.h"

/* Bytes of a file's name, of its temporary name more, and of the number behind an equal name. */
enum { NAME_MOST = 255, MORE = 24, NUMBER = 24 };

static celspan_status check(cs_apart_writing *w) {
  const char *slash = strrchr(w->path, '/');
  w->suffix = strlen(slash ? slash + 1 : w->path) + MORE;
  return w->suffix + NUMBER <= NAME_MOST
             ? CELSPAN_OK
             : cs_fail(w->context, CELSPAN_LIMIT, "%s: the name has no place for those of layers",
                       w->path);
}

/* The contents that are noted of a frame are in its own file. */
static celspan_status put_frame(cs_apart_writing *w, const celspan_frame_desc *picture,
                                const char *path, bool is_noted) {
  celspan_context *context = w->context;
  celspan_frame_desc frame = *picture;
  struct cs_file_contents *noted = context->contents;
  cs_apart_report_to(w, &frame);
  context->contents = is_noted ? noted : NULL;
  celspan_status status = celspan_frame_write(context, &frame, path, &w->file, NULL);
  context->contents = noted;
  return status;
}

/* The path of a layer has its name, which is new. */
static celspan_status put(cs_apart_writing *w, const celspan_frame_desc *picture, size_t index) {
  if (index == 0)
    return put_frame(w, picture, w->path, true);
  const char *layer = w->apart.layers[index - 1].name, *rest = w->path + w->contents.place;
  size_t size = strlen(w->path) + strlen(layer) + 2;
  char *path;
  CS_TRY(CS_MAKE(w->context, path, size));
  snprintf(path, size, "%.*s%s%s%s%s", (int)w->contents.place, w->path, *rest ? "" : ".", layer,
           *rest ? "." : "", rest);
  w->file.is_opaque = false; /* the frame may be */
  celspan_status status = put_frame(w, picture, path, false);
  cs_mem_free(w->context->memory, path, size);
  return status;
}

const cs_apart_format cs_apart_png = {.size = sizeof(cs_apart_writing), .check = check, .put = put};
