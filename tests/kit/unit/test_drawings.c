/* Krita documents with many layers that move: the memory for the drawings of a layer does not grow
 * with the members of the archive. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "celspan/layers.h"
#include "tests/support/check.h"

enum { MEMBERS = 20000, LAYERS = 500 };

#define LAYER "<layer nodetype='paintlayer' filename='f' keyframes='k'/>"

typedef struct member {
  char name[16];
  const char *text;
  long place;
} member;

static void put(FILE *file, size_t number, int bytes) {
  for (; bytes-- > 0; number >>= 8)
    fputc((int)(number & 255), file);
}

/* The fields that the table of an archive and the header of a member share. */
static void put_facts(FILE *file, const member *m) {
  size_t size = strlen(m->text);
  put(file, 20, 4); /* a version, no flags */
  put(file, 0, 6);  /* it is not packed, and has no time */
  put(file, crc32(0, (const Bytef *)m->text, (uInt)size), 4);
  put(file, size, 4);
  put(file, size, 4);
  put(file, strlen(m->name), 4);
}

static void write_archive(const char *path, member *members, size_t count) {
  FILE *file = fopen(path, "wb");
  for (size_t i = 0; i < count; i++) {
    members[i].place = ftell(file);
    fwrite("PK\3\4", 1, 4, file);
    put_facts(file, &members[i]);
    fprintf(file, "%s%s", members[i].name, members[i].text);
  }
  long place = ftell(file);
  for (size_t i = 0; i < count; i++) {
    fwrite("PK\1\2\24\0", 1, 6, file);
    put_facts(file, &members[i]);
    put(file, 0, 10);
    put(file, (size_t)members[i].place, 4);
    fputs(members[i].name, file);
  }
  long size = ftell(file) - place;
  fwrite("PK\5\6\0\0\0\0", 1, 8, file);
  put(file, count, 2);
  put(file, count, 2);
  put(file, (size_t)size, 4);
  put(file, (size_t)place, 4);
  put(file, 0, 2);
  fclose(file);
}

/* Layers that all show one drawing, and members that nothing names. */
static void write_document(const char *path) {
  static member members[MEMBERS] = {
      {"maindoc.xml", NULL, 0},
      {"a/layers/k",
       "<keyframes><channel name='content'><keyframe time='0' frame='f'/></channel></keyframes>",
       0},
      {"a/layers/f", "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA 0\n", 0}};
  static char document[LAYERS * sizeof LAYER + 128] =
      "<DOC><IMAGE name='a' width='8' height='8'><layers>";
  char *end = document + strlen(document);
  for (int i = 0; i < LAYERS; i++)
    end += sprintf(end, "%s", LAYER);
  strcpy(end, "</layers></IMAGE></DOC>");
  members[0].text = document;
  for (int i = 3; i < MEMBERS; i++) {
    sprintf(members[i].name, "a/%d", i);
    members[i].text = "";
  }
  write_archive(path, members, MEMBERS);
}

/* Counts all bytes that are ever requested. */
static void *resize(void *user, void *block, size_t old_size, size_t new_size) {
  (void)old_size;
  *(size_t *)user += new_size;
  if (new_size > 0)
    return realloc(block, new_size);
  free(block);
  return NULL;
}

static void check_requests(const char *path) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  celspan_context *context = NULL;
  celspan_painting *painting = NULL;
  size_t requested = 0;
  desc.resize = resize;
  desc.resize_user = &requested;
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  celspan_status status = celspan_painting_read(context, path, &painting);
  if (strstr(celspan_context_error(context), "celspan-type.so")) {
    check_skip(celspan_context_error(context));
  } else {
    CHECK(status == CELSPAN_OK && celspan_painting_layer_count(painting) == 2 * LAYERS);
    CHECK(requested < 64u << 20); /* tables of the members for each layer have 160 MB */
  }
  celspan_painting_unref(painting);
  celspan_context_destroy(context);
}

int main(void) {
  char path[] = "/tmp/celspan-drawings-XXXXXX";
  int descriptor = mkstemp(path);
  CHECK(descriptor >= 0);
  close(descriptor);
  write_document(path);
  check_requests(path);
  unlink(path);
  return check_done();
}
