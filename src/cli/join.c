/* celspan join STRIP ... -o OUT: strips of a frame to the frame. */
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "cli/verbs.h"
#include "film/sequence.h"
#include "output/join/join.h"

enum { PATH_SIZE = 4096 };

typedef struct strip_list {
  celspan_context *context;
  char **paths; /* owned, as each of them is */
  size_t count, capacity;
} strip_list;

static celspan_status add(strip_list *list, const char *path) {
  size_t size = strlen(path) + 1;
  CS_TRY(cs_mem_reserve(list->context, (void **)&list->paths, &list->capacity, list->count + 1,
                        sizeof *list->paths));
  char *copy = cs_mem_array(list->context->memory, size, 1);
  if (!copy)
    return cs_fail_memory(list->context);
  list->paths[list->count++] = memcpy(copy, path, size);
  return CELSPAN_OK;
}

static void finish(strip_list *list) {
  for (size_t i = 0; i < list->count; i++)
    cs_mem_free(list->context->memory, list->paths[i], strlen(list->paths[i]) + 1);
  cs_mem_free(list->context->memory, list->paths, list->capacity * sizeof *list->paths);
}

static celspan_status add_numbered(strip_list *list, const char *pattern,
                                   const cs_sequence *numbers) {
  char path[PATH_SIZE];
  if (numbers->count == 0)
    return cs_fail(list->context, CELSPAN_INPUT, "%s: there are no files of this pattern", pattern);
  for (size_t i = 0; i < numbers->count; i++) {
    CS_TRY(cs_sequence_name(list->context, pattern, numbers->frames[i], path, sizeof path));
    CS_TRY(add(list, path));
  }
  return CELSPAN_OK;
}

static celspan_status add_pattern(strip_list *list, const char *pattern) {
  cs_sequence numbers = {0};
  CS_TRY(cs_sequence_list(list->context, pattern, &numbers));
  celspan_status status = add_numbered(list, pattern, &numbers);
  cs_sequence_finish(&numbers);
  return status;
}

static celspan_status join(celspan_context *context, const cs_request *request, strip_list *list) {
  for (size_t i = 0; i < request->operand_count; i++)
    CS_TRY(cs_sequence_has_number(request->operands[i]) ? add_pattern(list, request->operands[i])
                                                        : add(list, request->operands[i]));
  return cs_join(context, (const char *const *)list->paths, list->count, request->output);
}

cs_exit cs_verb_join(celspan_context *context, const cs_request *request) {
  if (!request->output)
    return cs_report_usage("where to? give -o with the name of the picture");
  strip_list list = {.context = context};
  celspan_status status = join(context, request, &list);
  finish(&list);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(context));
  return cs_report_failure(context, status, NULL);
}
