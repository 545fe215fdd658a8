#include "cli/picture_info.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "pictures/store.h"

enum { LINE = 512 };

/* The parts are printed after the lines of the picture itself, which need the first part's depth. */
typedef struct part_list {
  const cs_picture_header *header;
  celspan_context *context;
  celspan_status status;
  char depth[sizeof((cs_picture_part *)0)->depth];
  int subimage_count;
  char *text; /* lines; owned */
  size_t length, capacity;
} part_list;

/* Names come from the file: what could end a line is shown as a space. */
static void print_name(char *out, size_t size, const char *name) {
  snprintf(out, size, "%s%s", name[0] ? " " : "", name);
  for (char *at = out; *at; at++)
    if ((unsigned char)*at < ' ' || *at == 127)
      *at = ' ';
}

static bool add_part(void *user, const cs_picture_part *part) {
  part_list *list = user;
  char line[LINE], name[sizeof part->name + 1];
  print_name(name, sizeof name, part->name);
  if (part->subimage == 0)
    memcpy(list->depth, part->depth, sizeof list->depth);
  list->subimage_count += part->subimage >= 0;
  int size = part->subimage < 0
                 ? snprintf(line, sizeof line, "layer%s channels %d\n", name, part->channels)
                 : snprintf(line, sizeof line, "subimage %d size %dx%d channels %d depth %s%s%s\n",
                            part->subimage, (int)part->width, (int)part->height, part->channels,
                            part->depth, part->name[0] ? " layer" : "", name);
  list->status = cs_mem_reserve(list->context, (void **)&list->text, &list->capacity,
                                list->length + (size_t)size + 1, 1);
  if (list->status != CELSPAN_OK)
    return false;
  memcpy(list->text + list->length, line, (size_t)size + 1);
  list->length += (size_t)size;
  return true;
}

static const char *alpha_name(const cs_picture_header *header) {
  if (!header->info.has_alpha)
    return "none";
  return header->alpha == CS_PICTURE_ALPHA_CODED ? "premultiplied" : "straight";
}

static void print(const part_list *list) {
  const cs_picture_header *header = list->header;
  const celspan_picture_info *info = &header->info;
  printf("format %s\nsize %dx%d\nchannels %d\nalpha %s\ndepth %s\ncolour %s\nbytes %" PRId64
         "\nsubimages %d\n",
         info->format, (int)info->width, (int)info->height, info->channels, alpha_name(header),
         list->depth, info->colour, header->file_size, list->subimage_count);
  if (list->text)
    fputs(list->text, stdout);
}

static celspan_status inform(celspan_context *context, const char *path) {
  const cs_picture_module *module;
  const cs_picture_request request = {.file = path};
  cs_picture_header header;
  cs_picture_reader *reader;
  cs_picture_failure failure;
  part_list list = {.header = &header, .context = context, .status = CELSPAN_OK};
  CS_TRY(cs_store_module(context, CELSPAN_INPUT, &module));
  celspan_status status = module->open(&request, &reader, &header, &failure);
  if (status != CELSPAN_OK)
    return cs_fail(context, status, "%s", failure.text);
  status = module->list(reader, add_part, &list, &failure);
  module->close(reader);
  if (status != CELSPAN_OK)
    cs_fail(context, status, "%s", failure.text);
  else
    status = list.status;
  if (status == CELSPAN_OK)
    print(&list);
  cs_mem_free(context->memory, list.text, list.capacity);
  return status;
}

cs_exit cs_picture_info_print(celspan_context *context, const char *path) {
  return cs_report_failure(context, inform(context, path), NULL);
}
