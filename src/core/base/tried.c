#include "base/tried.h"

#include <string.h>

/* more than the number of fonts of a drawing, which are searched for before it is read */
enum { NOTES = 128 };

typedef struct note {
  char *path; /* the path, and after its end the other path */
  size_t size;
} note;

typedef struct notes {
  cs_service service;
  cs_memory *memory;
  size_t next; /* the place of the next note, which replaces the oldest one */
  note all[NOTES];
} notes;

static celspan_status create(celspan_context *context, cs_service **out) {
  notes *made;
  CS_TRY(CS_MAKE(context, made, 1));
  made->memory = context->memory;
  *out = &made->service;
  return CELSPAN_OK;
}

static void destroy(cs_service *service) {
  notes *kept = (notes *)service;
  for (size_t i = 0; i < NOTES; i++)
    cs_mem_free(kept->memory, kept->all[i].path, kept->all[i].size);
  cs_mem_free(kept->memory, kept, sizeof *kept);
}

static const cs_service_kind kind = {create, destroy, NULL};

static const char *find(const notes *kept, const char *path) {
  for (size_t i = 0; i < NOTES; i++)
    if (kept->all[i].path && strcmp(kept->all[i].path, path) == 0)
      return kept->all[i].path + strlen(path) + 1;
  return NULL;
}

void cs_tried_note(celspan_context *context, const char *path, const char *tried) {
  cs_service *service;
  if (cs_context_service(context, &kind, &service) != CELSPAN_OK)
    return;
  notes *kept = (notes *)service;
  const char *known = find(kept, path);
  if (known && strcmp(known, tried) == 0)
    return;
  size_t length = strlen(path) + 1, more = strlen(tried) + 1;
  char *text = cs_mem_array(kept->memory, length + more, 1);
  if (!text)
    return;
  memcpy(text, path, length);
  memcpy(text + length, tried, more);
  note *last = &kept->all[kept->next++ % NOTES];
  cs_mem_free(kept->memory, last->path, last->size);
  *last = (note){text, length + more};
}

const char *cs_tried_find(const celspan_context *context, const char *path) {
  const cs_service *service = cs_context_find_service(context, &kind);
  return service ? find((const notes *)service, path) : NULL;
}
