#include "cli/manual.h"

#include <string.h>

typedef struct term {
  const char *name, *meaning;
} term;

static const term EXIT_CODES[] = {
    {"0", "every frame asked for exists"},
    {"1", "some frames failed, or differ"},
    {"2", "wrong usage"},
    {"3", "the script or its scene failed"},
    {"4", "an input is missing or broken"},
    {"5", "an output cannot be written"},
    {"6", "a limit was hit"},
    {"33", "out of memory"},
    {"70", "internal error"},
    {"128+n", "ended by signal n"},
};

static const term ENVIRONMENT[] = {
    {"CELSPAN_PATH", "where require looks after the script's folder; scripts may read there"},
    {"CELSPAN_PICTURE_MODULE",
     "the file of the picture module, when it is not where celspan looks"},
    {"OCIO", "an OpenColorIO configuration: its colour spaces may be named in colour"},
};

#define COUNT(table) (sizeof(table) / sizeof *(table))

/* Two columns, from the top to the bottom of each. */
void cs_manual_exit_codes(FILE *stream) {
  size_t half = (COUNT(EXIT_CODES) + 1) / 2;
  for (size_t i = 0; i < half; i++) {
    const term *left = &EXIT_CODES[i], *right = &EXIT_CODES[i + half];
    fprintf(stream, "  %-3s %-33s %-6s %s\n", left->name, left->meaning, right->name,
            right->meaning);
  }
}

/* ---------------------------------------------------------------- roff */

/* How a character is written that would mean or look like something else; NULL: as it is. */
static const char *escape_of(char c, bool is_first) {
  static const struct {
    char character;
    const char *escape;
  } escapes[] = {{'-', "\\-"}, {'\\', "\\e"}, {'^', "\\(ha"}, {'~', "\\(ti"}, {'`', "\\(ga"}};
  for (size_t i = 0; i < COUNT(escapes); i++)
    if (c == escapes[i].character)
      return escapes[i].escape;
  if (is_first && (c == '.' || c == '\''))
    return c == '.' ? "\\&." : "\\&'";
  return NULL;
}

/* A text in which nothing is a request or an escape; every run of blanks is one. */
static void put_text(FILE *stream, const char *text, size_t size) {
  bool is_blank = true;
  for (const char *at = text; at < text + size; at++) {
    bool was_blank = is_blank;
    is_blank = *at == ' ' || *at == '\n';
    if (is_blank && was_blank)
      continue;
    const char *escape = escape_of(*at, at == text);
    if (escape)
      fputs(escape, stream);
    else
      putc(is_blank ? ' ' : *at, stream);
  }
}

static void put_line(FILE *stream, const char *text) {
  put_text(stream, text, strlen(text));
  putc('\n', stream);
}

/* Lines that begin with blanks stay as they are. */
static void put_notes(FILE *stream, const char *notes) {
  bool is_plain = true;
  for (const char *next; *notes; notes = next) {
    size_t size = strcspn(notes, "\n");
    bool is_indented = notes[0] == ' ';
    next = notes + size + (notes[size] == '\n');
    if (is_indented == is_plain)
      fputs(is_indented ? ".PP\n.nf\n" : ".fi\n.PP\n", stream);
    is_plain = !is_indented;
    put_text(stream, notes, size);
    putc('\n', stream);
  }
  if (!is_plain)
    fputs(".fi\n", stream);
}

static void put_terms(FILE *stream, const term *terms, size_t count) {
  for (size_t i = 0; i < count; i++) {
    fputs(".TP\n.B ", stream);
    put_line(stream, terms[i].name);
    put_line(stream, terms[i].meaning);
  }
}

/* ---------------------------------------------------------------- sections */

static void put_option(void *user, const char *name, const char *value, const char *help) {
  FILE *stream = user;
  fputs(".TP\n\\fB", stream);
  put_text(stream, name, strlen(name));
  fputs("\\fR", stream);
  if (value) {
    fputs(" \\fI", stream);
    put_text(stream, value, strlen(value));
    fputs("\\fR", stream);
  }
  putc('\n', stream);
  put_line(stream, help);
}

static void put_verb(FILE *stream, const cs_verb *verb) {
  bool has_script = (verb->self & CS_VERBS_WITH_SCRIPT) != 0;
  fprintf(stream, ".SS celspan %s ", verb->name);
  put_text(stream, verb->operands, strlen(verb->operands));
  fprintf(stream, " [options]%s\n", has_script ? " [\\-\\- ARGS]" : "");
  put_line(stream, verb->summary);
  if (verb->notes) {
    fputs(".PP\n", stream);
    put_notes(stream, verb->notes);
  }
  cs_request_list(verb, put_option, stream);
}

static void put_head(FILE *stream) {
  fprintf(stream, ".TH CELSPAN 1 \"\" \"celspan %s\" \"User Commands\"\n.nh\n", celspan_version());
  fputs(".SH NAME\n"
        "celspan \\- compositing for cel animation: Lua scripts in, frames out\n"
        ".SH SYNOPSIS\n"
        ".B celspan\n"
        ".I VERB\n"
        ".RI [ operands ]\n"
        ".RI [ options ]\n"
        ".RB [ \\-\\-\n"
        ".IR ARGS ]\n"
        ".br\n"
        ".B celspan help\n"
        ".RI [ VERB ]\n"
        ".br\n"
        ".B celspan \\-\\-version\n"
        ".br\n"
        ".B celspan \\-\\-man\n"
        ".SH DESCRIPTION\n"
        "A Lua script describes a film frame by frame; celspan turns the frames into files.\n"
        ".PP\n"
        "Options may stand before or after the operands; a value follows its option after a space\n"
        "or an equals sign. What follows \\-\\- arrives in the script as its arguments.\n"
        "Diagnostics go to standard error.\n"
        ".PP\n"
        "\\-\\-man prints this page.\n",
        stream);
}

void cs_manual_print(const cs_verb *verbs, size_t count, FILE *stream) {
  put_head(stream);
  fputs(".SH VERBS\n", stream);
  for (size_t i = 0; i < count; i++)
    put_verb(stream, &verbs[i]);
  fputs(".SH EXIT STATUS\n", stream);
  put_terms(stream, EXIT_CODES, COUNT(EXIT_CODES));
  fputs(".SH ENVIRONMENT\n", stream);
  put_terms(stream, ENVIRONMENT, COUNT(ENVIRONMENT));
}
